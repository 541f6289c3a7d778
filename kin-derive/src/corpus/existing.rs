//! The mechanisms of the repository: none is redundant by its structure, unless it says so.

use super::diagnosed;
use super::repository::{Found, mechanisms, mechanisms_of_pages};

/// Asserts that nothing is said about the mechanisms; gives their number.
fn no_alarm(all: Vec<Found>) -> usize {
    let mut seen = 0;
    for found in all {
        let (_, result) = crate::analyse::analyse(found.args.clone(), found.item.clone());
        if result.is_err() {
            // Written to be wrong.
            continue;
        }
        let errors = diagnosed(found.item.clone()).messages();
        assert!(errors.is_empty() || found.may_be_redundant(), "{}: {errors:?}", found.name);
        seen += 1;
    }
    seen
}

#[test]
fn no_alarm_at_the_mechanisms_of_the_tests_and_examples() {
    let seen = no_alarm(mechanisms());
    assert!(seen >= 100, "{seen}");
}

#[test]
fn no_alarm_at_the_mechanisms_of_the_pages() {
    let seen = no_alarm(mechanisms_of_pages());
    assert!(seen >= 20, "{seen}");
}

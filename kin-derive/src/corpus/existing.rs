//! The mechanisms of the repository: none has a redundant structure unless its flags allow it.

use super::diagnosed;
use super::repository::{Found, mechanisms, mechanisms_of_pages};

/// Asserts that the mechanisms have no structural errors; returns their number.
fn no_alarm(all: Vec<Found>) -> usize {
    let mut seen = 0;
    for found in all {
        let (_, result) = crate::analyse::analyse(found.args.clone(), found.item.clone());
        if result.is_err() {
            // This mechanism is an example of an error.
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

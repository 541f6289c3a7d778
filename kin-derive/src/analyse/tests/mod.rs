//! Parsing, resolution of names, and rules: the models of valid descriptions, and the errors of invalid ones.

mod families;
mod form;
mod guesses;
mod names;
mod rules;
mod units;
mod valid;

use super::{Broken, analyse};
use crate::lower::Lowered;
use proc_macro2::TokenStream;
use std::str::FromStr;

/// The tokens of a source text.
fn tokens(source: &str) -> TokenStream {
    TokenStream::from_str(source).unwrap()
}

/// The model of a valid description.
fn good(source: &str) -> Lowered {
    let (item, result) = analyse(TokenStream::new(), tokens(source));
    assert!(item.is_some());
    result.unwrap_or_else(|broken| panic!("{:?}", messages(broken)))
}

/// All errors of a description.
fn errors(source: &str) -> Vec<String> {
    analyse(TokenStream::new(), tokens(source)).1.map_or_else(messages, |_| Vec::new())
}

fn messages(broken: Broken) -> Vec<String> {
    broken.error.into_iter().map(|error| error.to_string()).collect()
}

/// Asserts that there is one error, which contains all of the `parts`.
#[track_caller]
fn one_error(source: &str, parts: &[&str]) {
    let errors = errors(source);
    assert_eq!(errors.len(), 1, "{errors:?}");
    for part in parts {
        assert!(errors[0].contains(part), "{part:?} is not in {:?}", errors[0]);
    }
}

/// A pendulum with one more attribute, which is valid without it.
fn pendulum(attribute: &str) -> String {
    format!(
        "#[bodies(crank)] #[revolute(A: ground @ (0, 0), crank @ (l, 0))] {attribute} \
         struct Pendulum {{ #[param(1)] l: f64, omega: f64 }}"
    )
}

/// A description by global equations with `expr` as the left side of one of them.
fn equation(expr: &str) -> String {
    format!("#[coordinates(u, v)] #[constraint(c: {expr} = u - v)] struct Loop {{ l1: f64, l2: f64 }}")
}

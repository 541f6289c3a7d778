//! Errors in a mechanism and their places in the source.
//!
//! This crate contains neither tokens nor spans. Every part of a [`Mechanism`](crate::mechanism::Mechanism) carries an
//! opaque [`Origin`], which the code that built the mechanism can map back to a place in the source.

use core::fmt;

/// A place in the source of a mechanism; its meaning is known only to the code that built the mechanism.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Origin(pub u32);

/// An error in a mechanism: its place and a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// The part of the mechanism that is wrong.
    pub origin: Origin,
    /// A sentence that says what is wrong and how to correct it.
    pub message: String,
}

impl ModelError {
    /// An error at `origin`.
    pub fn new(origin: Origin, message: impl Into<String>) -> Self {
        Self { origin, message: message.into() }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ModelError {}

/// The list `` `A`, `B` and `C` `` with `word` before the last name; a long one is shortened.
pub fn quoted<'a>(names: impl IntoIterator<Item = &'a str>, word: &str) -> String {
    const SHOWN: usize = 8;
    let mut quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    let total = quoted.len();
    if total > SHOWN {
        quoted.truncate(SHOWN);
        return format!("{}, … ({total} in all)", quoted.join(", "));
    }
    match (quoted.pop(), quoted.is_empty()) {
        (Some(last), false) => format!("{} {word} {last}", quoted.join(", ")),
        (last, _) => last.unwrap_or_default(),
    }
}

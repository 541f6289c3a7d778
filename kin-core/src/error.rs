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

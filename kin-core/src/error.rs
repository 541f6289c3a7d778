//! What can be wrong with a mechanism, and where.
//!
//! The core knows neither tokens nor spans: every part of a [`Mechanism`](crate::mechanism::Mechanism)
//! carries an opaque [`Origin`] that whoever built the model can turn back into a place in the source.

use core::fmt;

/// A place in whatever the model was written in; meaningful only to the builder of the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Origin(pub u32);

/// One mistake in a mechanism: where it is and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// The part of the description that is wrong.
    pub origin: Origin,
    /// One sentence on what is wrong, then what would be right.
    pub message: String,
}

impl ModelError {
    /// A mistake at `origin`.
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

//! Pieces of laws whose acceleration is a sine.

/// A piece with s″ = a sin θ, given by a sin θ, a cos θ, and θ′.
#[derive(Clone, Copy, Default)]
pub(super) struct Wave {
    pub(super) sine: f64,
    pub(super) cosine: f64,
    pub(super) omega: f64,
}

impl Wave {
    pub(super) fn new(amplitude: f64, (sin, cos): (f64, f64), omega: f64) -> Self {
        Self { sine: amplitude * sin, cosine: amplitude * cos, omega }
    }
}

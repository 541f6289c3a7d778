//! Where a first run has the sines and cosines at τ = 0 from.

use crate::scalar::Scalar;

/// Sines and cosines of all angles, in the order of the kernel.
pub(super) trait AtZero {
    /// Those of the next angles.
    fn next<const A: usize>(&mut self, angles: [f64; A]) -> [(f64, f64); A];
}

/// Computed from the angles.
pub(super) struct Computed;

impl AtZero for Computed {
    #[inline(always)]
    fn next<const A: usize>(&mut self, angles: [f64; A]) -> [(f64, f64); A] {
        <f64 as Scalar>::sin_cos_all(angles)
    }
}

/// Known before: sin, cos, sin, cos, ….
pub(super) struct Known<'a>(pub(super) &'a [f64]);

impl AtZero for Known<'_> {
    #[inline(always)]
    fn next<const A: usize>(&mut self, _: [f64; A]) -> [(f64, f64); A] {
        let (own, rest) = self.0.split_at_checked(2 * A).unwrap_or_default();
        self.0 = rest;
        let at = |k: usize| own.get(k).copied().unwrap_or(f64::NAN);
        core::array::from_fn(|a| (at(2 * a), at(2 * a + 1)))
    }
}

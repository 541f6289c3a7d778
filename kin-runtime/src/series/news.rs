//! What a later run knows of q and q̇: what the coefficient before changes by, and the new one, as far as it is known.

use crate::workspace::Array;

/// Coefficients of a coordinate and of its rate in a run; `C` is an array of n numbers, so that the compiler can see that
/// a kernel's places in it are in bounds.
pub(super) trait News {
    /// Of a coordinate.
    fn coordinate(&self, k: usize) -> [f64; 2];
    /// Of its rate.
    fn rate(&self, k: usize) -> [f64; 2];
}

/// For rows of position level: q_{k−1} has been found, q_k is what they are for.
pub(super) struct Found<'a, C>(pub(super) &'a C);

impl<C: Array<f64>> News for Found<'_, C> {
    #[inline(always)]
    fn coordinate(&self, k: usize) -> [f64; 2] {
        // What is not yet known counts as −0, which adds nothing to whatever stands beside it.
        [self.0.as_ref()[k], -0.0]
    }

    #[inline(always)]
    fn rate(&self, _: usize) -> [f64; 2] {
        [0.0; 2]
    }
}

/// For rows of velocity level, one order behind: with q_k the coefficient k − 1 of q̇ has been found.
pub(super) struct FoundRates<'a, C> {
    /// q_k.
    pub(super) found: &'a C,
    /// k.
    pub(super) order: usize,
}

impl<C: Array<f64>> News for FoundRates<'_, C> {
    #[inline(always)]
    fn coordinate(&self, k: usize) -> [f64; 2] {
        [0.0, self.found.as_ref()[k]]
    }

    #[inline(always)]
    fn rate(&self, k: usize) -> [f64; 2] {
        [self.order as f64 * self.found.as_ref()[k], 0.0]
    }
}

/// For observables: all is known, and nothing changes.
pub(super) struct Known<'a> {
    /// q⁽ᵏ⁾ and q⁽ᵏ⁺¹⁾.
    pub(super) derivatives: [&'a [f64]; 2],
    /// k!
    pub(super) factorial: f64,
}

impl News for Known<'_> {
    #[inline(always)]
    fn coordinate(&self, k: usize) -> [f64; 2] {
        [0.0, self.derivatives[0][k] / self.factorial]
    }

    #[inline(always)]
    fn rate(&self, k: usize) -> [f64; 2] {
        // (k + 1) q_{k+1}.
        [0.0, self.derivatives[1][k] / self.factorial]
    }
}

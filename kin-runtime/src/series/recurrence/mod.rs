//! How the coefficients of a function of series follow from one another.
//!
//! With x(τ) = Σ x_k τ^k every function of the language satisfies a differential equation with rational terms, and
//! comparing coefficients gives its k-th from the lower ones in O(k) operations (Griewank and Walther, *Evaluating
//! Derivatives*, 2008, chapter 13).
//!
//! A coefficient of q is found by an equation in which it is unknown at first, so that a run takes it as 0 and the next
//! run corrects by what it turned out to be. For k ≥ 1 the k-th coefficient of a function is linear in the k-th of its
//! operands, with the first derivatives at τ = 0 as factors: the correction is one product with a number.

mod algebraic;
mod inverse;
mod transcendental;
mod turning;

pub(super) use algebraic::{Absolute, Power, Product, Quotient, Root, Sign, Square};
pub(super) use inverse::{Arc, ArcTangent, ArcTangent2};
pub(super) use transcendental::{Exponential, Logarithm, Tangent};
pub(super) use turning::{KEPT, LANES, Pairs, Turning, lanes};

/// Sequences that an operation keeps, at most.
pub(super) const SEQUENCES: usize = 4;

/// The sequences that one operation keeps from order to order.
pub(super) trait Sequences {
    /// Number `i` of sequence `s`.
    fn get(&self, s: usize, i: usize) -> f64;
    /// Replaces it.
    fn set(&mut self, s: usize, i: usize, value: f64);
    /// Σ a_i b_{k−i} over i = first … last.
    fn convolution(&self, a: usize, b: usize, k: usize, first: usize, last: usize) -> f64;

    /// Adds to number `i` of sequence `s`.
    #[inline(always)]
    fn raise(&mut self, s: usize, i: usize, by: f64) {
        self.set(s, i, self.get(s, i) + by);
    }

    /// Σ a_i b_{k−i} over all i.
    #[inline(always)]
    fn whole(&self, a: usize, b: usize, k: usize) -> f64 {
        self.convolution(a, b, k, 0, k)
    }

    /// Σ a_i b_{k−i} over 0 < i < k.
    #[inline(always)]
    fn inner(&self, a: usize, b: usize, k: usize) -> f64 {
        self.convolution(a, b, k, 1, k - 1)
    }

    /// Σ a_i b_{k−i} over i > 0.
    #[inline(always)]
    fn rest(&self, a: usize, b: usize, k: usize) -> f64 {
        self.convolution(a, b, k, 1, k)
    }
}

/// A function of `I` series that gives `O`.
pub(super) trait Recurrence<const I: usize, const O: usize> {
    /// Sequences that it keeps.
    const KEPT: usize;
    /// The values at τ = 0.
    fn start(&self, x: [f64; I], s: &mut impl Sequences) -> [f64; O];
    /// The k-th coefficients, k ≥ 1, from those of the operands and all lower ones.
    fn step(&self, k: usize, x: [f64; I], s: &mut impl Sequences) -> [f64; O];
    /// What the k-th coefficients, k ≥ 1, change by when those of the operands change by `d`.
    fn correct(&self, k: usize, d: [f64; I], s: &mut impl Sequences) -> [f64; O];
}

//! Tangent, exponential, logarithm. Sequences of x hold i x_i, as x′ needs it.

use super::{Recurrence, Sequences};

/// t = tan x: from t′ = w x′ with w = 1 + t².
pub(in crate::series) struct Tangent;

impl Recurrence<1, 1> for Tangent {
    const KEPT: usize = 3;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let t = x.tan();
        s.set(0, 0, 0.0);
        s.set(1, 0, t);
        s.set(2, 0, 1.0 + t * t);
        [t]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, k as f64 * x);
        let t = s.rest(0, 2, k) / k as f64;
        s.set(1, k, t);
        s.set(2, k, s.whole(1, 1, k));
        [t]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let t = s.get(2, 0) * x;
        s.raise(0, k, k as f64 * x);
        s.raise(1, k, t);
        s.raise(2, k, 2.0 * s.get(1, 0) * t);
        [t]
    }
}

/// e = exp x: from e′ = e x′.
pub(in crate::series) struct Exponential;

impl Recurrence<1, 1> for Exponential {
    const KEPT: usize = 2;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, 0.0);
        s.set(1, 0, x.exp());
        [x.exp()]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, k as f64 * x);
        let e = s.rest(0, 1, k) / k as f64;
        s.set(1, k, e);
        [e]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let e = s.get(1, 0) * x;
        s.raise(0, k, k as f64 * x);
        s.raise(1, k, e);
        [e]
    }
}

/// l = ln x: from x l′ = x′. The second sequence holds i l_i.
pub(in crate::series) struct Logarithm;

impl Recurrence<1, 1> for Logarithm {
    const KEPT: usize = 2;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, x);
        s.set(1, 0, 0.0);
        [x.ln()]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, x);
        let l = (x - s.inner(1, 0, k) / k as f64) / s.get(0, 0);
        s.set(1, k, k as f64 * l);
        [l]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let l = x / s.get(0, 0);
        s.raise(0, k, x);
        s.raise(1, k, k as f64 * l);
        [l]
    }
}

//! Inverse trigonometric functions. The last sequence of each holds i y_i of the result.

use super::{Recurrence, Sequences};

/// y = atan x: from w y′ = x′ with w = 1 + x².
pub(in crate::series) struct ArcTangent;

impl Recurrence<1, 1> for ArcTangent {
    const KEPT: usize = 3;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, x);
        s.set(1, 0, 1.0 + x * x);
        s.set(2, 0, 0.0);
        [x.atan()]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, x);
        let y = (x - s.inner(2, 1, k) / k as f64) / s.get(1, 0);
        s.set(1, k, s.whole(0, 0, k));
        s.set(2, k, k as f64 * y);
        [y]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let y = x / s.get(1, 0);
        s.raise(0, k, x);
        s.raise(1, k, 2.0 * s.get(0, 0) * x);
        s.raise(2, k, k as f64 * y);
        [y]
    }
}

/// θ = atan2(y, x): from r θ′ = x y′ − y x′ with r = x² + y².
pub(in crate::series) struct ArcTangent2;

impl Recurrence<2, 1> for ArcTangent2 {
    const KEPT: usize = 4;

    #[inline(always)]
    fn start(&self, [y, x]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, y);
        s.set(1, 0, x);
        s.set(2, 0, x * x + y * y);
        s.set(3, 0, 0.0);
        [y.atan2(x)]
    }

    #[inline]
    fn step(&self, k: usize, [y, x]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, y);
        s.set(1, k, x);
        let turning = (1..=k).map(|i| i as f64 * (s.get(0, i) * s.get(1, k - i) - s.get(1, i) * s.get(0, k - i)));
        let theta = (turning.sum::<f64>() - s.inner(3, 2, k)) / (k as f64 * s.get(2, 0));
        s.set(2, k, s.whole(0, 0, k) + s.whole(1, 1, k));
        s.set(3, k, k as f64 * theta);
        [theta]
    }

    #[inline]
    fn correct(&self, k: usize, [y, x]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        let theta = (s.get(1, 0) * y - s.get(0, 0) * x) / s.get(2, 0);
        s.raise(0, k, y);
        s.raise(1, k, x);
        s.raise(2, k, 2.0 * (s.get(0, 0) * y + s.get(1, 0) * x));
        s.raise(3, k, k as f64 * theta);
        [theta]
    }
}

/// y = asin x, or acos x, whose derivatives are opposite: from u y′ = x′ with u² = 1 − x².
pub(in crate::series) struct Arc {
    pub(in crate::series) cosine: bool,
}

impl Arc {
    #[inline(always)]
    fn signed(&self, y: f64) -> [f64; 1] {
        [if self.cosine { -y } else { y }]
    }
}

impl Recurrence<1, 1> for Arc {
    const KEPT: usize = 3;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, x);
        s.set(1, 0, ((1.0 - x) * (1.0 + x)).sqrt());
        s.set(2, 0, 0.0);
        [if self.cosine { x.acos() } else { x.asin() }]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, x);
        let y = (x - s.inner(2, 1, k) / k as f64) / s.get(1, 0);
        s.set(1, k, -(s.whole(0, 0, k) + s.inner(1, 1, k)) / (2.0 * s.get(1, 0)));
        s.set(2, k, k as f64 * y);
        self.signed(y)
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let y = x / s.get(1, 0);
        s.raise(0, k, x);
        s.raise(1, k, -s.get(0, 0) * y);
        s.raise(2, k, k as f64 * y);
        self.signed(y)
    }
}

//! Products, quotients, powers, roots, absolute values.

use super::{Recurrence, Sequences};

/// c = a b: c_k = Σ a_i b_{k−i}.
pub(in crate::series) struct Product;

impl Recurrence<2, 1> for Product {
    const KEPT: usize = 2;

    #[inline(always)]
    fn start(&self, [a, b]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, a);
        s.set(1, 0, b);
        [a * b]
    }

    #[inline(always)]
    fn step(&self, k: usize, [a, b]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, a);
        s.set(1, k, b);
        [s.whole(0, 1, k)]
    }

    #[inline(always)]
    fn correct(&self, k: usize, [a, b]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.raise(0, k, a);
        s.raise(1, k, b);
        [s.get(0, 0) * b + s.get(1, 0) * a]
    }
}

/// c = a²: every product of two different coefficients counts twice.
pub(in crate::series) struct Square;

impl Recurrence<1, 1> for Square {
    const KEPT: usize = 1;

    #[inline(always)]
    fn start(&self, [a]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, a);
        [a * a]
    }

    #[inline(always)]
    fn step(&self, k: usize, [a]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, a);
        let half = s.convolution(0, 0, k, 0, (k - 1) / 2);
        let middle = s.get(0, k / 2);
        [half + half + if k.is_multiple_of(2) { middle * middle } else { 0.0 }]
    }

    #[inline(always)]
    fn correct(&self, k: usize, [a]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.raise(0, k, a);
        [2.0 * s.get(0, 0) * a]
    }
}

/// c = a/b: from c b = a.
pub(in crate::series) struct Quotient;

impl Recurrence<2, 1> for Quotient {
    const KEPT: usize = 2;

    #[inline(always)]
    fn start(&self, [a, b]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, b);
        s.set(1, 0, a / b);
        [a / b]
    }

    #[inline(always)]
    fn step(&self, k: usize, [a, b]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, b);
        let c = (a - s.rest(0, 1, k)) / s.get(0, 0);
        s.set(1, k, c);
        [c]
    }

    #[inline(always)]
    fn correct(&self, k: usize, [a, b]: [f64; 2], s: &mut impl Sequences) -> [f64; 1] {
        let c = (a - s.get(1, 0) * b) / s.get(0, 0);
        s.raise(0, k, b);
        s.raise(1, k, c);
        [c]
    }
}

/// r = √x: from r² = x. At x = 0 there is no derivative, and a quotient with 0 says so.
pub(in crate::series) struct Root;

impl Recurrence<1, 1> for Root {
    const KEPT: usize = 1;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, x.sqrt());
        [x.sqrt()]
    }

    #[inline(always)]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let root = (x - s.inner(0, 0, k)) / (2.0 * s.get(0, 0));
        s.set(0, k, root);
        [root]
    }

    #[inline(always)]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let root = x / (2.0 * s.get(0, 0));
        s.raise(0, k, root);
        [root]
    }
}

/// p = x^r: from x p′ = r p x′.
///
/// At x = 0 the derivatives of an order below r vanish, and those above do not exist unless x stays 0.
pub(in crate::series) struct Power {
    /// r.
    pub(in crate::series) exponent: f64,
    /// r, where it is an integer.
    pub(in crate::series) integer: Option<i32>,
}

impl Power {
    fn at_zero(&self, k: usize, s: &impl Sequences) -> f64 {
        let rests = (1..=k).all(|i| s.get(0, i) == 0.0);
        if (k as f64) < self.exponent || rests && self.exponent > 0.0 { 0.0 } else { f64::NAN }
    }
}

impl Recurrence<1, 1> for Power {
    const KEPT: usize = 3;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        let p = self.integer.map_or_else(|| x.powf(self.exponent), |n| x.powi(n));
        s.set(0, 0, x);
        s.set(1, 0, 0.0);
        s.set(2, 0, p);
        [p]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, x);
        s.set(1, k, k as f64 * x);
        let p = if s.get(0, 0) == 0.0 {
            self.at_zero(k, s)
        } else {
            ((self.exponent + 1.0) / k as f64 * s.rest(1, 2, k) - s.rest(0, 2, k)) / s.get(0, 0)
        };
        s.set(2, k, p);
        [p]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.raise(0, k, x);
        s.raise(1, k, k as f64 * x);
        let (first, before) = (s.get(0, 0), s.get(2, k));
        let p = if first == 0.0 { self.at_zero(k, s) - before } else { self.exponent * s.get(2, 0) / first * x };
        s.set(2, k, before + p);
        [p]
    }
}

/// |x|: x with the sign that it has at τ = 0. Where it is 0 there, and moves, there is no derivative.
pub(in crate::series) struct Absolute;

/// The sign of x where it has one, and where x stays 0.
fn sign(k: usize, s: &impl Sequences) -> f64 {
    match s.get(0, 0) {
        x if x != 0.0 => x.signum(),
        _ if (1..=k).all(|i| s.get(0, i) == 0.0) => 0.0,
        _ => f64::NAN,
    }
}

impl Recurrence<1, 1> for Absolute {
    const KEPT: usize = 1;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, x);
        [x.abs()]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, x);
        [sign(k, s) * x]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.raise(0, k, x);
        [sign(k, s) * x]
    }
}

/// The sign of x: constant, where it has a derivative.
pub(in crate::series) struct Sign;

impl Recurrence<1, 1> for Sign {
    const KEPT: usize = 1;

    #[inline(always)]
    fn start(&self, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, 0, x);
        [x.signum()]
    }

    #[inline]
    fn step(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.set(0, k, x);
        [0.0 * sign(k, s)]
    }

    #[inline]
    fn correct(&self, k: usize, [x]: [f64; 1], s: &mut impl Sequences) -> [f64; 1] {
        s.raise(0, k, x);
        [0.0 * sign(k, s)]
    }
}

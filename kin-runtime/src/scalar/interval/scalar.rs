//! Intervals as the scalar of generated code.

use super::rounding::integer;
use super::{Interval, elementary, trigonometry};
use crate::scalar::Scalar;

/// 2π.
const TURN: Interval = Interval { lower: core::f64::consts::TAU, upper: core::f64::consts::TAU.next_up() };

impl Scalar for Interval {
    /// The iterations of a plan have no enclosure. Without any correction they report that they did not converge.
    const CORRECTIONS: usize = 0;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::from(value)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        trigonometry::sin_cos(self)
    }

    /// Undefined where a pole is within.
    fn tan(self) -> Self {
        let (from, to) = (Self::from(self.lower).sin_cos(), Self::from(self.upper).sin_cos());
        let (_, cos) = self.sin_cos();
        // It increases between poles.
        if cos.contains(0.0) { Self::UNDEFINED } else { (from.0 / from.1).hull(to.0 / to.1) }
    }

    fn asin(self) -> Self {
        let at_point = |x: f64| {
            let x = Self::from(x);
            let one = Self::from(1.0);
            x.atan2(((one - x) * (one + x)).sqrt())
        };
        if self.lower >= -1.0 && self.upper <= 1.0 {
            at_point(self.lower).hull(at_point(self.upper))
        } else {
            Self::UNDEFINED
        }
    }

    fn acos(self) -> Self {
        let at_point = |x: f64| {
            let x = Self::from(x);
            let one = Self::from(1.0);
            ((one - x) * (one + x)).sqrt().atan2(x)
        };
        if self.lower >= -1.0 && self.upper <= 1.0 {
            at_point(self.lower).hull(at_point(self.upper))
        } else {
            Self::UNDEFINED
        }
    }

    fn atan(self) -> Self {
        self.atan2(Self::from(1.0))
    }

    fn atan2(self, x: Self) -> Self {
        trigonometry::atan2(self, x)
    }

    /// Undefined where the number of whole turns is not the same throughout the intervals.
    fn nearest(self, reference: Self) -> Self {
        if !(self.is_bounded() && reference.is_bounded()) {
            return Self::UNDEFINED;
        }
        let turns = integer((reference.midpoint() - self.midpoint()) / core::f64::consts::TAU);
        let turned = self + Self::from(turns) * TURN;
        if (turned - reference).magnitude() < core::f64::consts::PI { turned } else { Self::UNDEFINED }
    }

    #[inline]
    fn is_within(self, bound: f64) -> bool {
        self.magnitude() <= bound
    }

    #[inline]
    fn sqrt(self) -> Self {
        elementary::sqrt(self)
    }

    fn exp(self) -> Self {
        elementary::exp(self)
    }

    fn ln(self) -> Self {
        elementary::ln(self)
    }

    #[inline]
    fn abs(self) -> Self {
        match (self.lower >= 0.0, self.upper <= 0.0) {
            (true, _) => self,
            (_, true) => -self,
            _ if self.is_defined() => Self { lower: 0.0, upper: self.magnitude() },
            _ => Self::UNDEFINED,
        }
    }

    /// [−1, 1] where 0 is within: all slopes that [`abs`](Scalar::abs) has between two numbers.
    #[inline]
    fn signum(self) -> Self {
        match (self.lower > 0.0, self.upper < 0.0) {
            (true, _) => Self::from(1.0),
            (_, true) => Self::from(-1.0),
            _ if self.is_defined() => Self { lower: -1.0, upper: 1.0 },
            _ => Self::UNDEFINED,
        }
    }

    /// The squares of all numbers within, none of which is negative, as products of two of them may be.
    #[inline]
    fn square(self) -> Self {
        let products = self * self;
        if products.lower < 0.0 { Self { lower: 0.0, ..products } } else { products }
    }

    #[inline]
    fn powi(self, n: i32) -> Self {
        elementary::powi(self, n)
    }

    /// Undefined where there are numbers that are not positive.
    fn powf(self, n: f64) -> Self {
        (Self::from(n) * self.ln()).exp()
    }

    /// A supplied function can be evaluated at single numbers only; its results are taken as exact.
    fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
        if self.is_point() { f(self.lower).map(Self::from) } else { [Self::UNDEFINED; 3] }
    }
}

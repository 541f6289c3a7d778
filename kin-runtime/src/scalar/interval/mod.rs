//! Intervals as a scalar: the equations of a mechanism, evaluated with every rounding error enclosed.

mod elementary;
mod rounding;
mod scalar;
mod trigonometry;

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};
use rounding::{above, below, product_down, product_up, quotient_down, quotient_up, sum_down, sum_up};

/// All real numbers from a lower to an upper end, or [`UNDEFINED`](Self::UNDEFINED).
///
/// Every operation and every function gives an interval that holds the result for all numbers of its operands: ends are
/// rounded outwards, and functions come with error bounds of their own that do not depend on the platform's library.
/// Where an operand leaves the domain of an operation (division by an interval that holds 0, a root of one that has
/// negative numbers), or a function jumps within it, the result is `UNDEFINED`, and so is everything computed from it.
/// Therefore a result that is defined also proves that the formula is defined and continuous on all of the box it was
/// evaluated over.
///
/// One end may be infinite. Iterations inside of a solution plan have no enclosure: their margin is 0.
///
/// ```
/// use kin_runtime::scalar::Interval;
///
/// let third = Interval::from(1.0) / Interval::from(3.0);
/// assert!(third.lower() < third.upper() && third.upper() - third.lower() < 1e-15);
/// let wide = third * Interval::new(-3.0, 3.0) + Interval::from(2.0);
/// assert!(wide.contains(1.0) && wide.contains(3.0) && wide.radius() < 1.0 + 1e-14);
/// assert!(!(third / Interval::new(-1.0, 1.0)).is_defined());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// Nothing is known, not even whether there is a number. It is unequal to itself, as NaN is.
    pub const UNDEFINED: Self = Self { lower: f64::NAN, upper: f64::NAN };
    /// All real numbers.
    pub const ENTIRE: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };
    pub(crate) const ZERO: Self = Self { lower: 0.0, upper: 0.0 };

    /// All numbers from `lower` to `upper`; undefined unless `lower` ≤ `upper`, and where both are the same infinity.
    #[inline]
    pub const fn new(lower: f64, upper: f64) -> Self {
        if lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY {
            Self { lower, upper }
        } else {
            Self::UNDEFINED
        }
    }

    /// All numbers at most `radius` away from `centre`, rounded outwards.
    #[inline]
    pub fn around(centre: f64, radius: f64) -> Self {
        Self::new(sum_down(centre, -radius), sum_up(centre, radius))
    }

    /// The lower end; NaN where it is undefined.
    #[inline]
    pub const fn lower(self) -> f64 {
        self.lower
    }

    /// The upper end; NaN where it is undefined.
    #[inline]
    pub const fn upper(self) -> f64 {
        self.upper
    }

    /// False for [`UNDEFINED`](Self::UNDEFINED).
    #[inline]
    pub const fn is_defined(self) -> bool {
        self.lower <= self.upper
    }

    /// True where it is defined and both ends are finite.
    #[inline]
    pub const fn is_bounded(self) -> bool {
        self.lower.is_finite() && self.upper.is_finite()
    }

    /// A number about the middle of a bounded interval.
    #[inline]
    pub const fn midpoint(self) -> f64 {
        let middle = 0.5 * self.lower + 0.5 * self.upper;
        // Halves of subnormal numbers may round to a number outside.
        if middle < self.lower || middle > self.upper { self.lower } else { middle }
    }

    /// The largest distance of its numbers from its [`midpoint`](Self::midpoint), rounded up; NaN where it is
    /// undefined.
    #[inline]
    pub fn radius(self) -> f64 {
        let middle = self.midpoint();
        let (below, above) = (sum_up(middle, -self.lower), sum_up(self.upper, -middle));
        if below > above { below } else { above }
    }

    /// The largest absolute value of its numbers; NaN where it is undefined.
    #[inline]
    pub const fn magnitude(self) -> f64 {
        let (a, b) = (self.lower.abs(), self.upper.abs());
        if a > b { a } else { b }
    }

    /// True where `x` is one of its numbers.
    #[inline]
    pub const fn contains(self, x: f64) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// True where 0 is proven to be none of its numbers; false for [`UNDEFINED`](Self::UNDEFINED).
    #[cfg(feature = "std")]
    #[inline]
    pub(crate) const fn excludes_zero(self) -> bool {
        self.lower > 0.0 || self.upper < 0.0
    }

    /// The numbers that are in both; none where there is no such number, or where one of them is undefined.
    #[inline]
    pub fn intersection(self, other: Self) -> Option<Self> {
        if !(self.is_defined() && other.is_defined()) {
            return None;
        }
        let (lower, upper) = (self.lower.max(other.lower), self.upper.min(other.upper));
        (lower <= upper).then_some(Self { lower, upper })
    }

    /// The least interval that holds the numbers of both; undefined where one of them is.
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        if self.is_defined() && other.is_defined() {
            Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
        } else {
            Self::UNDEFINED
        }
    }

    /// True where it is one number alone.
    #[inline]
    const fn is_point(self) -> bool {
        self.lower == self.upper
    }

    /// The product for any ends: products with 0 are exact, even with an infinite end, which stands for numbers without
    /// a bound.
    #[cold]
    fn times(self, b: Self) -> Self {
        if !(self.is_defined() && b.is_defined()) {
            return Self::UNDEFINED;
        }
        let pairs = [(self.lower, b.lower), (self.lower, b.upper), (self.upper, b.lower), (self.upper, b.upper)];
        Self {
            lower: pairs.iter().fold(f64::INFINITY, |least, &(x, y)| least.min(product_down(x, y))),
            upper: pairs.iter().fold(f64::NEG_INFINITY, |most, &(x, y)| most.max(product_up(x, y))),
        }
    }
}

/// The lesser of two numbers, neither of which is NaN.
#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers, neither of which is NaN.
#[inline]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The number as an interval that contains nothing else; undefined if it is not finite.
impl From<f64> for Interval {
    #[inline]
    fn from(x: f64) -> Self {
        if x.is_finite() { Self { lower: x, upper: x } } else { Self::UNDEFINED }
    }
}

impl Neg for Interval {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl Add for Interval {
    type Output = Self;

    #[inline]
    fn add(self, b: Self) -> Self {
        Self { lower: sum_down(self.lower, b.lower), upper: sum_up(self.upper, b.upper) }
    }
}

impl Sub for Interval {
    type Output = Self;

    #[inline]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Interval {
    type Output = Self;

    #[inline]
    fn mul(self, b: Self) -> Self {
        // Neighbours have the order of the products, so that those of the least and the greatest are enough, unless one
        // of these is 0, which may be exact, or subnormal.
        let [p, q] = [self.lower * b.lower, self.upper * b.upper];
        let [r, s] = if b.is_point() { [q, p] } else { [self.lower * b.upper, self.upper * b.lower] };
        let (least, most) = (lesser(lesser(p, q), lesser(r, s)), greater(greater(p, q), greater(r, s)));
        // Not finite if a product is not.
        let all = (p + q) + (r + s);
        if least.abs() >= f64::MIN_POSITIVE && most.abs() >= f64::MIN_POSITIVE && all.is_finite() {
            return Self { lower: below(least), upper: above(most) };
        }
        self.times(b)
    }
}

impl Div for Interval {
    type Output = Self;

    #[inline]
    fn div(self, b: Self) -> Self {
        if !(self.is_defined() && b.is_defined()) || b.contains(0.0) {
            return Self::UNDEFINED;
        }
        if !self.is_bounded() || !b.is_bounded() {
            // An infinite end of b becomes 0.
            return self * Self { lower: quotient_down(1.0, b.upper), upper: quotient_up(1.0, b.lower) };
        }
        let pairs = [(self.lower, b.lower), (self.lower, b.upper), (self.upper, b.lower), (self.upper, b.upper)];
        Self {
            lower: pairs.iter().fold(f64::INFINITY, |least, &(x, y)| least.min(quotient_down(x, y))),
            upper: pairs.iter().fold(f64::NEG_INFINITY, |most, &(x, y)| most.max(quotient_up(x, y))),
        }
    }
}

/// `[0.1, 0.2]`, with all digits; `undefined`.
impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_defined() {
            return f.write_str("undefined");
        }
        write!(f, "[{:?}, {:?}]", self.lower, self.upper)
    }
}

/// Both ends as a list.
#[cfg(feature = "serde")]
impl serde::Serialize for Interval {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        [self.lower, self.upper].serialize(serializer)
    }
}

#[cfg(test)]
mod tests;

//! Numbers with their derivatives with respect to several parameters: one pass of the existing code computes all of
//! them (forward mode).

use super::Scalar;
use super::chain_rule::functions_by_chain_rule;
use crate::text::numbers;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};
#[cfg(feature = "simd")]
use wide::f64x4;

/// A value with its derivatives with respect to `W` parameters.
///
/// Generated code over it gives its results with their derivatives, each operation by the chain rule. Where an
/// iteration is part of that code (a step of a plan), it must start from its result over `f64`: one correction of
/// values that have converged is the linear solve of the implicit function theorem, x_p = −(∂F/∂x)⁻¹ ∂F/∂p.
///
/// At a place without a derivative, such as the root of 0, a derivative is not finite, unless that of the argument is
/// 0.
///
/// ```
/// use kin_runtime::Scalar;
/// use kin_runtime::scalar::Tangents;
///
/// // l sin φ, with its derivatives by l and φ.
/// let (l, phi) = (Tangents::<2>::variable(2.0, 0), Tangents::variable(0.5, 1));
/// let height = l * phi.sin_cos().0;
/// assert_eq!(2.0 * 0.5_f64.sin(), height.value());
/// assert_eq!([0.5_f64.sin(), 2.0 * 0.5_f64.cos()], height.by());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents<const W: usize> {
    value: f64,
    by: [f64; W],
}

/// Evaluates an expression of the derivatives of one or two numbers for every parameter: for four at once, and for the
/// rest one by one. Compilers do not form these lanes by themselves: they put derivatives and values into the same
/// vectors.
macro_rules! for_each_parameter {
    (|$a:ident| $f:expr, $by:expr) => {{
        let mut by = $by;
        #[cfg(feature = "simd")]
        let (fours, rest) = by.as_chunks_mut::<4>();
        #[cfg(feature = "simd")]
        for lanes in fours {
            let $a = f64x4::new(*lanes);
            *lanes = ($f).to_array();
        }
        #[cfg(not(feature = "simd"))]
        let rest = &mut by[..];
        for derivative in rest {
            let $a = *derivative;
            *derivative = $f;
        }
        by
    }};
    (|$a:ident, $b:ident| $f:expr, $by:expr, $others:expr) => {{
        let (mut by, others) = ($by, $others);
        #[cfg(feature = "simd")]
        let ((fours, rest), (other_fours, others)) = (by.as_chunks_mut::<4>(), others.as_chunks::<4>());
        #[cfg(feature = "simd")]
        for (lanes, other) in fours.iter_mut().zip(other_fours) {
            let ($a, $b) = (f64x4::new(*lanes), f64x4::new(*other));
            *lanes = ($f).to_array();
        }
        #[cfg(not(feature = "simd"))]
        let (rest, others) = (&mut by[..], &others[..]);
        for (derivative, other) in rest.iter_mut().zip(others) {
            let ($a, $b) = (*derivative, *other);
            *derivative = $f;
        }
        by
    }};
}

impl<const W: usize> Tangents<W> {
    /// How many parameters there are.
    pub const LANES: usize = W;

    /// A value with these derivatives.
    #[inline(always)]
    pub const fn new(value: f64, by: [f64; W]) -> Self {
        Self { value, by }
    }

    /// The parameter at `index` itself: its derivative is 1 there and 0 elsewhere.
    #[inline]
    pub fn variable(value: f64, index: usize) -> Self {
        Self::new(value, core::array::from_fn(|k| if k == index { 1.0 } else { 0.0 }))
    }

    /// The value.
    #[inline(always)]
    pub const fn value(self) -> f64 {
        self.value
    }

    /// The derivatives.
    #[inline(always)]
    pub const fn by(self) -> [f64; W] {
        self.by
    }

    /// A function with this value and slope. Where the argument's derivative is 0, so is that of the function, even if
    /// the slope is infinite.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, value: f64, slope: f64) -> Self {
        let by = if slope.is_finite() {
            for_each_parameter!(|by| slope * by, self.by)
        } else {
            self.by.map(|by| if by == 0.0 { 0.0 } else { slope * by })
        };
        Self { value, by }
    }

    #[inline(always)]
    fn turned(self, (sin, cos): (f64, f64)) -> (Self, Self) {
        let (sin_by, cos_by) =
            (for_each_parameter!(|by| cos * by, self.by), for_each_parameter!(|by| -sin * by, self.by));
        (Self { value: sin, by: sin_by }, Self { value: cos, by: cos_by })
    }

    /// The angle of the vector (x, y), whose value is known: θ_p = (x y_p − y x_p) / (x² + y²).
    #[inline(always)]
    fn angle((y, x): (Self, Self), value: f64) -> Self {
        let square = x.value * x.value + y.value * y.value;
        let (along, across) = (x.value / square, y.value / square);
        Self { value, by: for_each_parameter!(|y, x| along * y - across * x, y.by, x.by) }
    }
}

impl<const W: usize> Neg for Tangents<W> {
    type Output = Self;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self { value: -self.value, by: for_each_parameter!(|by| -by, self.by) }
    }
}

/// The value of an operation, and the derivative of its result in terms of those of its operands.
macro_rules! operators {
    ($($Operator:ident $operator:ident |$a:ident, $b:ident, $c:ident, $da:ident, $db:ident| $slope:expr;)*) => { $(
        impl<const W: usize> $Operator for Tangents<W> {
            type Output = Self;

            #[allow(clippy::suspicious_arithmetic_impl, reason = "the derivative of a quotient is none of quotients alone")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $operator(self, other: Self) -> Self {
                let ($a, $b) = (self.value, other.value);
                let $c = $Operator::$operator($a, $b);
                Self { value: $c, by: for_each_parameter!(|$da, $db| $slope, self.by, other.by) }
            }
        }
    )* };
}

operators! {
    Add add |a, b, c, da, db| da + db;
    Sub sub |a, b, c, da, db| da - db;
    Mul mul |a, b, c, da, db| da * b + a * db;
    Div div |a, b, c, da, db| (da - c * db) * (1.0 / b);
}

impl<const W: usize> Scalar for Tangents<W> {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self { value, by: [0.0; W] }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        self.turned(Scalar::sin_cos(self.value))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let values = <f64 as Scalar>::sin_cos_all(angles.map(Self::value));
        core::array::from_fn(|k| angles[k].turned(values[k]))
    }

    functions_by_chain_rule!();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        Self::angle((self, x), Scalar::atan2(self.value, x.value))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2_all<const N: usize>(vectors: [(Self, Self); N]) -> [Self; N] {
        let values = <f64 as Scalar>::atan2_all(vectors.map(|(y, x)| (y.value, x.value)));
        core::array::from_fn(|k| Self::angle(vectors[k], values[k]))
    }
}

/// The value, and its derivatives.
impl<const W: usize> fmt::Display for Tangents<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} by ", self.value)?;
        numbers(f, &self.by)
    }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use kin_core::vocabulary::UnknownKind;

    type Number = Tangents<2>;

    /// Compares the derivatives of a function of two numbers with central differences.
    fn check(f: impl Fn(Number, Number) -> Number, a: f64, b: f64) {
        const STEP: f64 = 1e-5;
        let found = f(Number::variable(a, 0), Number::variable(b, 1));
        let at = |a: f64, b: f64| f(Number::from_f64(a), Number::from_f64(b)).value();
        let exact =
            [(at(a + STEP, b) - at(a - STEP, b)) / (2.0 * STEP), (at(a, b + STEP) - at(a, b - STEP)) / (2.0 * STEP)];
        for (found, exact) in found.by().into_iter().zip(exact) {
            assert!((found - exact).abs() <= 1e-8 * (1.0 + exact.abs()), "{found} instead of {exact}");
        }
    }

    #[test]
    fn operations_follow_the_chain_rule() {
        let all: [fn(Number, Number) -> Number; 20] = [
            |a, b| a + b * a,
            |a, b| a - b * b,
            |a, b| -(a / b),
            |a, b| (a * b).sin_cos().0,
            |a, b| (a - b).sin_cos().1,
            |a, b| (a * b).tan(),
            |a, b| (a * b).asin(),
            |a, b| (a * b).acos(),
            |a, b| (a / b).atan(),
            |a, b| (a * b).sqrt(),
            |a, b| (a * b).exp(),
            |a, b| (a * b).ln(),
            |a, b| (b - a).abs() * (b - a).signum(),
            |a, b| (a - b).abs(),
            |a, b| a.atan2(-b),
            |a, b| (a * b).powi(-3) + a.powi(0),
            |a, b| (a * b).powf(1.7),
            |a, b| (a * b + Number::from_f64(10.0)).nearest(b),
            |a, b| (a * b).lift(|x| [x.sin(), x.cos(), -x.sin()])[1],
            |a, b| {
                (a * b).compose(
                    0,
                    |x| [x.powi(3), 3.0 * x * x, 6.0 * x],
                    |x, out| {
                        out.copy_from_slice(&[x.powi(3), 3.0 * x * x, 6.0 * x, 6.0]);
                        4
                    },
                )[2]
            },
        ];
        all.iter().for_each(|f| check(f, 0.7, 0.9));
        let together = |a: Number, b: Number| {
            let [(sin, _), (_, cos)] = Number::sin_cos_all([a, b]);
            let [first, second] = Number::atan2_all([(sin, cos), (a, b)]);
            first * second
        };
        check(together, 0.7, 0.9);
    }

    #[test]
    fn what_stands_still_has_no_derivative_where_there_is_none() {
        let [zero, moving] = [Number::from_f64(0.0), Number::variable(0.0, 1)];
        assert_eq!([0.0; 2], zero.sqrt().by());
        assert_eq!([0.0; 2], zero.abs().by());
        assert_eq!([0.0, f64::INFINITY], moving.sqrt().by());
        assert!(moving.abs().by()[1].is_nan());
        assert!(moving.lift(|x| [x, 1.0, 0.0])[2].by()[1].is_nan(), "a third derivative that nobody knows");
        assert_eq!("2 by (1, 0)", Number::variable(2.0, 0).to_string());
    }

    /// One correction of a value that has converged is enough.
    #[test]
    fn iterations_give_derivatives_of_the_root() {
        let square = Number::variable(4.0, 0);
        let mut x = [Number::from_f64(2.0)];
        let two = Number::from_f64(2.0);
        let good = crate::plan::iterate(&mut x, [0], [UnknownKind::Length], |[x]| [(*x * *x - square) / (two * *x)]);
        assert_eq!((1.0, 2.0, [0.25, 0.0]), (good.value(), x[0].value(), x[0].by()));
    }
}

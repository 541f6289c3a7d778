//! Truncated power series as scalars: all operations follow from one method that applies a recurrence to the
//! coefficients.

use super::Scalar;
use super::recurrence::Recurrence;

/// A power series in τ, with as many coefficients as it carries.
pub(crate) trait Expansion: Scalar {
    /// Its value where it does not depend on τ, such as a result of parameters alone.
    fn number(self) -> Option<f64>;
    /// The results of a recurrence.
    fn apply<const I: usize, const O: usize>(recurrence: impl Recurrence<I, O>, x: [Self; I]) -> [Self; O];
}

/// a + c for a number c.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn shifted<T: Expansion>(a: T, c: f64) -> T {
    let [sum] = T::apply(each(|k, [a]| if k == 0 { a + c } else { a }), [a]);
    sum
}

/// c a for a number c.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scaled<T: Expansion>(a: T, c: f64) -> T {
    let [product] = T::apply(each(|_, [a]| c * a), [a]);
    product
}

pub(crate) use super::recurrence::{
    Absolute, Arc, ArcTangent, Exponential, Logarithm, Power, Product, Quotient, Root, Sign, Tangent, each,
};

/// Implements [`Scalar`] and the operators for an [`Expansion`]; `own` are the items in which series differ.
///
/// Operators are inlined, so that the compiler sees which operands do not depend on τ; without optimisation that would
/// only make the stack of generated code large.
macro_rules! scalar_of_expansion {
    ([$($generics:tt)*] $Series:ty { $($own:item)* }) => {
        impl<$($generics)*> core::ops::Neg for $Series {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                match self.number() {
                    Some(a) => Self::from_f64(-a),
                    None => Self::apply(each(|_, [a]| -a), [self])[0],
                }
            }
        }

        impl<$($generics)*> core::ops::Add for $Series {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add(self, b: Self) -> Self {
                match (self.number(), b.number()) {
                    (Some(a), Some(b)) => Self::from_f64(a + b),
                    (Some(a), None) => shifted(b, a),
                    (None, Some(b)) => shifted(self, b),
                    (None, None) => Self::apply(each(|_, [a, b]| a + b), [self, b])[0],
                }
            }
        }

        impl<$($generics)*> core::ops::Sub for $Series {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub(self, b: Self) -> Self {
                match (self.number(), b.number()) {
                    (Some(a), Some(b)) => Self::from_f64(a - b),
                    (Some(a), None) => Self::apply(each(|k, [b]| if k == 0 { a - b } else { -b }), [b])[0],
                    (None, Some(b)) => shifted(self, -b),
                    (None, None) => Self::apply(each(|_, [a, b]| a - b), [self, b])[0],
                }
            }
        }

        impl<$($generics)*> core::ops::Mul for $Series {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul(self, b: Self) -> Self {
                match (self.number(), b.number()) {
                    (Some(a), Some(b)) => Self::from_f64(a * b),
                    (Some(a), None) => scaled(b, a),
                    (None, Some(b)) => scaled(self, b),
                    (None, None) => Self::apply(Product {}, [self, b])[0],
                }
            }
        }

        impl<$($generics)*> core::ops::Div for $Series {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn div(self, b: Self) -> Self {
                match (self.number(), b.number()) {
                    (Some(a), Some(b)) => Self::from_f64(a / b),
                    (None, Some(b)) => Self::apply(each(|_, [a]| a / b), [self])[0],
                    _ => Self::apply(Quotient {}, [self, b])[0],
                }
            }
        }

        impl<$($generics)*> Scalar for $Series {
            $($own)*

            scalar_of_expansion! { @functions
                tan Tangent, asin Arc { sign: 1.0 }, acos Arc { sign: -1.0 }, atan ArcTangent, sqrt Root, exp Exponential,
                ln Logarithm, abs Absolute, signum Sign
            }

            /// The same whole turns for all τ.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn nearest(self, reference: Self) -> Self {
                let (angle, reference) = (self.value(), reference.value());
                shifted(self, Scalar::nearest(angle, reference) - angle)
            }

            #[inline]
            fn powi(self, n: i32) -> Self {
                let (mut power, mut square, mut rest) = (Self::from_f64(1.0), self, n.unsigned_abs());
                while rest > 0 {
                    power = if rest & 1 == 1 { power * square } else { power };
                    square = if rest > 1 { square * square } else { square };
                    rest >>= 1;
                }
                if n < 0 { Self::from_f64(1.0) / power } else { power }
            }

            #[inline]
            fn powf(self, n: f64) -> Self {
                match self.number() {
                    Some(x) => Self::from_f64(Scalar::powf(x, n)),
                    None => Self::apply(Power { n }, [self])[0],
                }
            }

            fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
                let known = |x: f64, out: &mut [f64]| out.iter_mut().zip(f(x)).map(|(index, f)| *index = f).count();
                self.compose(usize::MAX, &f, known)
            }
        }
    };
    (@functions $($name:ident $Recurrence:ident $({ $field:ident: $value:expr })?),*) => { $(
        #[inline]
        fn $name(self) -> Self {
            match self.number() {
                Some(x) => Self::from_f64(Scalar::$name(x)),
                None => Self::apply($Recurrence { $($field: $value)? }, [self])[0],
            }
        }
    )* };
}
pub(crate) use scalar_of_expansion;

//! Truncated Taylor series as a scalar: generated code evaluated once gives all derivatives with respect to one
//! variable.

use super::Scalar;
use super::expansion::*;
use super::recurrence::{ArcTangent2, Recurrence, Turning, compose};
use crate::text::numbers;
use core::array;
use core::fmt;

/// The series x_0 + x_1 τ + … + x_{N−1} τ^{N−1} with x_k = x⁽ᵏ⁾/k!; N is at least 2.
///
/// Generated code over this scalar gives the derivatives of its results up to order N − 1. An iteration in that code (a
/// step of a plan) must start from its result over `f64`: then every correction doubles the number of correct
/// coefficients.
///
/// ```
/// use kin_runtime::Scalar;
/// use kin_runtime::scalar::Taylor;
///
/// // sin(τ²)/τ at τ = 2, and its derivative 2 cos τ² − sin(τ²)/τ².
/// let tau = Taylor::<2>::variable(2.0);
/// let [value, slope] = ((tau * tau).sin_cos().0 / tau).coefficients();
/// assert!((value - 4.0_f64.sin() / 2.0).abs() < 1e-15);
/// assert!((slope - 2.0 * 4.0_f64.cos() + 4.0_f64.sin() / 4.0).abs() < 1e-15);
/// ```
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor<const N: usize> {
    coefficients: [f64; N],
    /// Whether all coefficients except the first are 0.
    constant: bool,
}

impl<const N: usize> Taylor<N> {
    /// The series with these coefficients.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(coefficients: [f64; N]) -> Self {
        Self { coefficients, constant: false }
    }

    /// The series x_0 + τ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn variable(value: f64) -> Self {
        Self::new(array::from_fn(|k| match k {
            0 => value,
            1 => 1.0,
            _ => 0.0,
        }))
    }

    /// The coefficients x_0, x_1, ….
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn coefficients(self) -> [f64; N] {
        self.coefficients
    }

    /// The first coefficient x_0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    const fn value(self) -> f64 {
        self.coefficients[0]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned(self, at_zero: (f64, f64)) -> (Self, Self) {
        let [sin, cos] = match self.number() {
            Some(_) => [at_zero.0, at_zero.1].map(Self::from_f64),
            None => Self::apply(Turning { at_zero }, [self]),
        };
        (sin, cos)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn angle((y, x): (Self, Self), at_zero: f64) -> Self {
        match (y.number(), x.number()) {
            (Some(_), Some(_)) => Self::from_f64(at_zero),
            _ => Self::apply(ArcTangent2 { at_zero }, [y, x])[0],
        }
    }
}

impl<const N: usize> Expansion for Taylor<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn number(self) -> Option<f64> {
        self.constant.then(|| self.value())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn apply<const I: usize, const O: usize>(recurrence: impl Recurrence<I, O>, x: [Self; I]) -> [Self; O] {
        let x = x.map(|x| x.coefficients);
        let mut results = [[0.0; N]; O];
        for k in 0..N {
            let next = recurrence.coefficient(k, &x, &results);
            for o in 0..O {
                results[o][k] = next[o];
            }
        }
        results.map(Self::new)
    }
}

scalar_of_expansion! { [const N: usize] Taylor<N> {
    /// The number of corrections from a start with a correct first coefficient, and one more.
    const CORRECTIONS: usize = N.ilog2() as usize + 2;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_f64(value: f64) -> Self {
        Self { coefficients: array::from_fn(|k| if k == 0 { value } else { 0.0 }), constant: true }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        self.turned(Scalar::sin_cos(self.value()))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos_all<const A: usize>(angles: [Self; A]) -> [(Self, Self); A] {
        let at_zero = <f64 as Scalar>::sin_cos_all(angles.map(Self::value));
        array::from_fn(|a| angles[a].turned(at_zero[a]))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        Self::angle((self, x), Scalar::atan2(self.value(), x.value()))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2_all<const A: usize>(vectors: [(Self, Self); A]) -> [Self; A] {
        let at_zero = <f64 as Scalar>::atan2_all(vectors.map(|(y, x)| (y.value(), x.value())));
        array::from_fn(|a| Self::angle(vectors[a], at_zero[a]))
    }

    fn compose(
        self,
        _: usize,
        f: impl Fn(f64) -> [f64; 3],
        derivatives: impl Fn(f64, &mut [f64]) -> usize,
    ) -> [Self; 3] {
        if let Some(x) = self.number() {
            return f(x).map(Self::from_f64);
        }
        let (mut known, mut results) = ([[f64::NAN; N]; 2], [[0.0; N]; 3]);
        let known = known.as_flattened_mut();
        let count = derivatives(self.value(), known);
        known[count..].fill(f64::NAN);
        compose(&self.coefficients, known, &mut [0.0; N], &mut results.each_mut().map(|result| &mut result[..]));
        results.map(Self::new)
    }
} }

/// The coefficients.
impl<const N: usize> fmt::Display for Taylor<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        numbers(f, &self.coefficients)
    }
}

#[cfg(test)]
mod tests;

//! Polynomials.

use super::ScalarFunction;
use crate::scalar::Interval;
use crate::text::number;
use core::fmt;

/// f(x) = Σ c_k x^k, with coefficients from the constant term on: `Polynomial([c0, c1, c2])`, `Polynomial(vec![…])`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Polynomial<C>(pub C);

impl<C: AsRef<[f64]>> ScalarFunction for Polynomial<C> {
    #[inline]
    fn evaluate(&self, x: f64) -> [f64; 3] {
        horner(self.0.as_ref(), x)
    }

    fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
        all_derivatives(self.0.as_ref(), x, out)
    }

    fn enclose(&self, x: Interval) -> Interval {
        enclose(self.0.as_ref(), x)
    }
}

/// The values of Σ c_k x^k over an interval, by Horner's scheme; they are wider than need be where terms cancel.
pub(super) fn enclose(coefficients: &[f64], x: Interval) -> Interval {
    coefficients.iter().rev().fold(Interval::ZERO, |sum, c| sum * x + Interval::from(*c))
}

/// Σ c_k x^k with two derivatives, by Horner's scheme.
#[inline]
pub(super) fn horner(coefficients: &[f64], x: f64) -> [f64; 3] {
    let step = |[f, f1, half]: [f64; 3], c: &f64| [f * x + c, f1 * x + f, half * x + f1];
    let [f, f1, half] = coefficients.iter().rev().fold([0.0; 3], step);
    [f, f1, 2.0 * half]
}

/// Writes f, f′, f″, … of Σ c_k x^k, as many as fit, by Horner's scheme on the scaled derivatives f⁽ʲ⁾/j!.
pub(super) fn all_derivatives(coefficients: &[f64], x: f64, out: &mut [f64]) -> usize {
    out.fill(0.0);
    for c in coefficients.iter().rev() {
        let mut lower = *c;
        for place in out.iter_mut() {
            let before = *place;
            *place = before * x + lower;
            lower = before;
        }
    }
    let mut factorial = 1.0;
    for (j, place) in out.iter_mut().enumerate() {
        factorial *= j.max(1) as f64;
        *place *= factorial;
    }
    out.len()
}

/// For example `1 + 2 x + 3 x^2`.
impl<C: AsRef<[f64]>> fmt::Display for Polynomial<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let terms = self.0.as_ref();
        if terms.is_empty() {
            return f.write_str("0");
        }
        terms.iter().enumerate().try_for_each(|(k, term)| {
            f.write_str(if k == 0 { "" } else { " + " })?;
            number(f, term)?;
            match k {
                0 => Ok(()),
                1 => f.write_str(" x"),
                _ => write!(f, " x^{k}"),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_by_hand() {
        let f = Polynomial([1.0, -2.0, 0.0, 4.0]);
        assert_eq!(f.evaluate(0.5), [1.0 - 1.0 + 0.5, -2.0 + 3.0, 12.0]);
        assert_eq!(Polynomial::<[f64; 0]>([]).evaluate(2.0), [0.0; 3]);
        let mut all = [f64::NAN; 6];
        assert_eq!(f.derivatives(0.5, &mut all), 6);
        assert_eq!(all, [1.0 - 1.0 + 0.5, -2.0 + 3.0, 12.0, 24.0, 0.0, 0.0]);
        assert_eq!(f.derivatives(0.5, &mut all[..2]), 2);
    }
}

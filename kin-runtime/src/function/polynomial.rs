//! Constants and polynomials.

use super::ScalarFunction;

/// f(x) = c.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constant(pub f64);

impl ScalarFunction for Constant {
    #[inline]
    fn evaluate(&self, _: f64) -> [f64; 3] {
        [self.0, 0.0, 0.0]
    }
}

/// f(x) = Σ c_k x^k, coefficients from the constant term on: `Polynomial([c0, c1, c2])`, `Polynomial(vec![…])`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Polynomial<C>(pub C);

impl<C: AsRef<[f64]>> ScalarFunction for Polynomial<C> {
    #[inline]
    fn evaluate(&self, x: f64) -> [f64; 3] {
        horner(self.0.as_ref(), x)
    }
}

/// Σ c_k x^k with two derivatives, by Horner's scheme.
#[inline]
pub(super) fn horner(coefficients: &[f64], x: f64) -> [f64; 3] {
    let step = |[f, f1, half]: [f64; 3], c: &f64| [f * x + c, f1 * x + f, half * x + f1];
    let [f, f1, half] = coefficients.iter().rev().fold([0.0; 3], step);
    [f, f1, 2.0 * half]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_by_hand() {
        let f = Polynomial([1.0, -2.0, 0.0, 4.0]);
        assert_eq!(f.evaluate(0.5), [1.0 - 1.0 + 0.5, -2.0 + 3.0, 12.0]);
        assert_eq!(Polynomial::<[f64; 0]>([]).evaluate(2.0), [0.0; 3]);
        assert_eq!(Constant(3.0).evaluate(7.0), [3.0, 0.0, 0.0]);
    }
}

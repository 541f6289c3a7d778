//! Numbers whose computation is recorded: one backward pass gives the gradient of a result with respect to all
//! variables.

use super::Scalar;
use super::chain_rule::functions_by_chain_rule;
use core::cell::RefCell;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// The index of a number that does not depend on a variable.
const CONSTANT: u32 = u32::MAX;

/// A recorded operation: the indices of its operands in the record, and the derivatives of its result with respect to
/// them.
#[derive(Clone, Copy)]
struct Operation {
    operands: [u32; 2],
    slopes: [f64; 2],
}

thread_local! {
    /// The operations of this thread since the last [`variables`].
    static OPERATIONS: RefCell<Vec<Operation>> = const { RefCell::new(Vec::new()) };
}

/// A number with the index of the operation that gave it.
///
/// The derivative of one result with respect to a variable is the sum, over all paths from the result to the variable,
/// of the products of slopes, which one pass from the last operation to the first adds up (reverse accumulation;
/// Griewank and Walther, *Evaluating Derivatives*, 2008). Its cost does not depend on how many variables there are.
/// Operations are those of one thread since its last [`variables`]; numbers from before are invalid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recorded {
    value: f64,
    index: u32,
}

/// Begins a computation with these variables.
pub(crate) fn variables(values: &[f64]) -> Vec<Recorded> {
    OPERATIONS.with_borrow_mut(Vec::clear);
    values.iter().map(|value| Recorded::pushed(*value, [CONSTANT; 2], [0.0; 2])).collect()
}

/// Adds the derivatives of Σ weight · result with respect to the first variables to `gradient`.
pub(crate) fn accumulate(results: impl IntoIterator<Item = (Recorded, f64)>, gradient: &mut [f64]) {
    OPERATIONS.with_borrow(|operations| {
        let mut by = vec![0.0; operations.len()];
        let mut add = |index: u32, weight: f64| {
            if let Some(by) = by.get_mut(index as usize) {
                *by += weight;
            }
        };
        results.into_iter().for_each(|(result, weight)| add(result.index, weight));
        for (index, operation) in operations.iter().enumerate().rev() {
            let weight = by[index];
            if weight != 0.0 {
                for (operand, slope) in operation.operands.into_iter().zip(operation.slopes) {
                    if let Some(by) = by.get_mut(operand as usize) {
                        *by += slope * weight;
                    }
                }
            }
        }
        gradient.iter_mut().zip(&by).for_each(|(gradient, by)| *gradient += by);
    });
}

impl Recorded {
    /// The value.
    pub(crate) const fn value(self) -> f64 {
        self.value
    }

    fn pushed(value: f64, operands: [u32; 2], slopes: [f64; 2]) -> Self {
        OPERATIONS.with_borrow_mut(|operations| {
            let index = operations.len() as u32;
            operations.push(Operation { operands, slopes });
            Self { value, index }
        })
    }

    /// A function with this value and slope.
    #[inline]
    fn chain(self, value: f64, slope: f64) -> Self {
        match self.index {
            CONSTANT => Self { value, index: CONSTANT },
            index => Self::pushed(value, [index, CONSTANT], [slope, 0.0]),
        }
    }

    /// An operation on two numbers with this value and slopes.
    #[inline]
    fn pair(self, other: Self, value: f64, slopes: [f64; 2]) -> Self {
        match (self.index, other.index) {
            (CONSTANT, CONSTANT) => Self { value, index: CONSTANT },
            (a, b) => Self::pushed(value, [a, b], slopes),
        }
    }
}

impl Neg for Recorded {
    type Output = Self;

    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

/// The value of an operation, and its slopes with respect to both operands.
macro_rules! operators {
    ($($Operator:ident $operator:ident |$a:ident, $b:ident, $c:ident| $slopes:expr;)*) => { $(
        impl $Operator for Recorded {
            type Output = Self;

            fn $operator(self, other: Self) -> Self {
                let ($a, $b) = (self.value, other.value);
                let $c = $Operator::$operator($a, $b);
                self.pair(other, $c, $slopes)
            }
        }
    )* };
}

operators! {
    Add add |a, b, c| [1.0, 1.0];
    Sub sub |a, b, c| [1.0, -1.0];
    Mul mul |a, b, c| [b, a];
    Div div |a, b, c| [1.0 / b, -c / b];
}

impl Scalar for Recorded {
    fn from_f64(value: f64) -> Self {
        Self { value, index: CONSTANT }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Scalar::sin_cos(self.value);
        (self.chain(sin, cos), self.chain(cos, -sin))
    }

    functions_by_chain_rule!();

    fn atan2(self, x: Self) -> Self {
        let square = x.value * x.value + self.value * self.value;
        self.pair(x, Scalar::atan2(self.value, x.value), [x.value / square, -self.value / square])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Tangents;

    /// The same expression over both: reverse equals forward.
    fn both(f: impl Fn([Recorded; 2]) -> Recorded, g: impl Fn([Tangents<2>; 2]) -> Tangents<2>) {
        let (a, b) = (0.7, 0.9);
        let recorded = variables(&[a, b]);
        let found = f([recorded[0], recorded[1]]);
        let mut gradient = [0.0; 2];
        accumulate([(found, 2.0)], &mut gradient);
        let forward = g([Tangents::variable(a, 0), Tangents::variable(b, 1)]);
        assert!((found.value() - forward.value()).abs() < 1e-15);
        for (found, exact) in gradient.into_iter().zip(forward.by()) {
            assert!((found - 2.0 * exact).abs() <= 1e-13 * (1.0 + exact.abs()), "{found} instead of {}", 2.0 * exact);
        }
    }

    macro_rules! both {
        ($(|$a:ident, $b:ident| $f:expr;)*) => { $( both(|[$a, $b]| $f, |[$a, $b]| $f); )* };
    }

    #[test]
    fn backwards_is_forwards() {
        both! {
            |a, b| a + b * a;
            |a, b| a - b * b;
            |a, b| -(a / b);
            |a, b| (a * b).sin_cos().0 * a.sin_cos().1;
            |a, b| (a * b).tan();
            |a, b| (a * b).asin() + (a * b).acos() * a;
            |a, b| (a / b).atan();
            |a, b| (a * b).sqrt();
            |a, b| (a * b).exp() + (a * b).ln();
            |a, b| (b - a).abs() * (b - a).signum();
            |a, b| a.atan2(-b);
            |a, b| (a * b).powi(-3) + a.powi(0);
            |a, b| (a * b).powf(1.7);
            |a, b| Scalar::nearest(a * b + Scalar::from_f64(10.0), b);
            |a, b| (a * b).lift(|x| [x.sin(), x.cos(), -x.sin()])[1];
            |a, b| (a * b).compose(0, |x| [x.powi(3), 3.0 * x * x, 6.0 * x], |x, out| {
                out.copy_from_slice(&[x.powi(3), 3.0 * x * x, 6.0 * x, 6.0]);
                4
            })[2];
        }
    }

    #[test]
    fn what_is_constant_is_not_recorded() {
        let [x] = variables(&[2.0])[..] else { panic!("one variable") };
        let constant = Recorded::from_f64(3.0);
        let _ = (constant * constant).sqrt().sin_cos();
        assert_eq!(1, OPERATIONS.with_borrow(Vec::len));
        let mut gradient = [1.0];
        accumulate([(x * constant, 1.0), (constant, 5.0)], &mut gradient);
        assert_eq!([4.0], gradient);
    }
}

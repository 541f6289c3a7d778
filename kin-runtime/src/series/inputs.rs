//! Time and the inputs as power series.

use super::tape::Missing;
use crate::workspace::{Instant, Signal};

/// Coefficients of time and of the inputs in powers of τ.
pub(super) struct Inputs {
    pub(super) t: f64,
    /// Input by input; NaN where the derivative is not known.
    coefficients: Vec<f64>,
    /// Coefficients of one input.
    stride: usize,
}

/// k!
pub(super) fn factorial(k: usize) -> f64 {
    (1..=k).map(|i| i as f64).product()
}

impl Inputs {
    /// Room for series up to this order.
    pub(super) fn new(order: usize, inputs: usize) -> Self {
        // The first run looks at order 3 whatever is asked for, and rows may hold second derivatives of inputs.
        let stride = order.max(3) + 3;
        Self { t: 0.0, coefficients: vec![f64::NAN; inputs * stride], stride }
    }

    /// Begins at an instant. `further` has the derivatives of the inputs from the third on, as far as they are known.
    #[inline]
    pub(super) fn begin(&mut self, at: &Instant<'_>, further: &[&[f64]]) {
        for (k, series) in self.coefficients.chunks_exact_mut(self.stride).enumerate() {
            let Signal { value, rate, acceleration } = at.inputs.get(k).copied().unwrap_or_default();
            let higher = further.get(k).copied().unwrap_or_default();
            let known = [value, rate, acceleration].into_iter().chain(higher.iter().copied());
            series.fill(f64::NAN);
            let mut factorial = 1.0;
            for (order, (coefficient, derivative)) in series.iter_mut().zip(known).enumerate() {
                factorial *= order.max(1) as f64;
                *coefficient = derivative / factorial;
            }
        }
    }

    /// Coefficient `i` of the derivative of this order of an input.
    #[inline(always)]
    pub(super) fn input(&self, k: usize, order: usize, i: usize) -> f64 {
        let factor: f64 = (i + 1..=i + order).map(|m| m as f64).product();
        factor * self.coefficients[k * self.stride + i + order]
    }

    /// That an input is not known far enough.
    #[cold]
    pub(super) fn missing(&self, k: usize) -> Missing {
        let series = &self.coefficients[k * self.stride..][..self.stride];
        Missing::Input { index: k, known: series.iter().take_while(|c| !c.is_nan()).count().saturating_sub(1) }
    }
}

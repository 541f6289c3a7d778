//! What a kernel of series reads: the coefficients of q that are known, time and the inputs.

use super::tape::Missing;
use crate::workspace::{Instant, Signal};

/// Coefficients of q and of the inputs in powers of τ; q_k = q⁽ᵏ⁾/k!, 0 until it is known.
#[derive(Default)]
pub(super) struct Course {
    pub(super) t: f64,
    coordinates: usize,
    /// Order by order.
    q: Vec<f64>,
    /// Input by input; NaN where the derivative is not known.
    inputs: Vec<f64>,
    /// Coefficients of one input.
    stride: usize,
}

/// k!
pub(super) fn factorial(k: usize) -> f64 {
    (1..=k).map(|i| i as f64).product()
}

impl Course {
    /// Room for series up to this order.
    pub(super) fn new(order: usize, coordinates: usize, inputs: usize) -> Self {
        // The first run looks at order 3 whatever is asked for, rates one further, and derivatives of inputs two.
        let stride = order.max(3) + 3;
        Self {
            t: 0.0,
            coordinates,
            q: vec![0.0; coordinates * stride],
            inputs: vec![f64::NAN; inputs * stride],
            stride,
        }
    }

    /// Begins at an instant. `further` has the derivatives of the inputs from the third on, as far as they are known.
    pub(super) fn begin(&mut self, at: &Instant<'_>, further: &[&[f64]]) {
        self.t = at.t;
        self.q.fill(0.0);
        for (k, series) in self.inputs.chunks_exact_mut(self.stride).enumerate() {
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

    /// The coefficients of this order.
    #[inline(always)]
    pub(super) fn q(&self, order: usize) -> &[f64] {
        &self.q[order * self.coordinates..][..self.coordinates]
    }

    /// Takes the derivative of this order.
    pub(super) fn take(&mut self, order: usize, derivative: &[f64]) {
        let factorial = factorial(order);
        let place = order * self.coordinates;
        for (coefficient, value) in self.q[place..place + self.coordinates].iter_mut().zip(derivative) {
            *coefficient = value / factorial;
        }
    }

    /// Coefficient `i` of the derivative of this order of an input.
    #[inline(always)]
    pub(super) fn input(&self, k: usize, order: usize, i: usize) -> f64 {
        let factor: f64 = (i + 1..=i + order).map(|m| m as f64).product();
        factor * self.inputs[k * self.stride + i + order]
    }

    /// That an input is not known far enough.
    #[cold]
    pub(super) fn missing_input(&self, k: usize) -> Missing {
        let series = &self.inputs[k * self.stride..][..self.stride];
        Missing::Input { index: k, known: series.iter().take_while(|c| !c.is_nan()).count().saturating_sub(1) }
    }
}

//! What a kernel of series reads: the coefficients of q that are known, time and the inputs.

use super::tape::Missing;
use crate::workspace::{Array, Instant, Signal};

/// Coefficients of q and of the inputs in powers of τ; q_k = q⁽ᵏ⁾/k!, 0 until it is known. `C` is an array of n numbers,
/// so that the compiler can see that a kernel's places in it are in bounds.
pub(super) struct Course<C> {
    pub(super) t: f64,
    /// Order by order.
    q: Vec<C>,
    /// Input by input; NaN where the derivative is not known.
    inputs: Vec<f64>,
    /// Coefficients of one input.
    stride: usize,
}

/// k!
pub(super) fn factorial(k: usize) -> f64 {
    (1..=k).map(|i| i as f64).product()
}

impl<C: Array<f64>> Course<C> {
    /// Room for series up to this order.
    pub(super) fn new(order: usize, inputs: usize) -> Self {
        // The first run looks at order 3 whatever is asked for, rates one further, and derivatives of inputs two.
        let stride = order.max(3) + 3;
        Self { t: 0.0, q: vec![C::generate(|_| 0.0); stride], inputs: vec![f64::NAN; inputs * stride], stride }
    }

    /// Begins at an instant. `further` has the derivatives of the inputs from the third on, as far as they are known.
    pub(super) fn begin(&mut self, at: &Instant<'_>, further: &[&[f64]]) {
        self.t = at.t;
        self.q[..5].fill(C::generate(|_| 0.0));
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

    /// The coefficients of this order and the next ones.
    #[inline(always)]
    pub(super) fn from<const N: usize>(&self, order: usize) -> [&C; N] {
        core::array::from_fn(|k| &self.q[order + k])
    }

    /// Takes the derivative of this order, one further than the last, given the factorial of the order. Later ones
    /// are 0 as far as the next run looks.
    #[inline(always)]
    pub(super) fn take(&mut self, order: usize, factorial: f64, derivative: &[f64]) {
        let part = 1.0 / factorial;
        for (coefficient, value) in self.q[order].as_mut().iter_mut().zip(derivative) {
            *coefficient = part * value;
        }
        if order > 2
            && let Some(later) = self.q.get_mut(order + 2)
        {
            *later = C::generate(|_| 0.0);
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

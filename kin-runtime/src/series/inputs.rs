//! Time, the inputs and the coordinates as power series.

use super::tape::{Missing, Series, Tape};
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Coefficients of time and of the inputs in powers of τ.
pub(super) struct Inputs {
    pub(super) t: f64,
    /// Input by input; NaN where the derivative is not known.
    coefficients: Vec<f64>,
    /// Number of coefficients of one input.
    stride: usize,
}

/// k!, for all k for which it is an `f64`.
const FACTORIALS: [f64; 171] = {
    let (mut factorials, mut k) = ([1.0; 171], 1);
    while k < factorials.len() {
        factorials[k] = factorials[k - 1] * k as f64;
        k += 1;
    }
    factorials
};

/// k!
#[inline]
pub(super) fn factorial(k: usize) -> f64 {
    FACTORIALS.get(k).copied().unwrap_or(f64::INFINITY)
}

impl Inputs {
    /// Room for series up to this order, and two more coefficients for rows that contain derivatives of inputs.
    pub(super) fn new(order: usize, inputs: usize) -> Self {
        let stride = order + 3;
        Self { t: 0.0, coefficients: vec![f64::NAN; inputs * stride], stride }
    }

    /// Begins at an instant. `further` has the derivatives of the inputs from the third on, as far as they are known.
    pub(super) fn begin(&mut self, at: &Instant<'_>, further: &[&[f64]]) {
        self.t = at.t;
        for (k, series) in self.coefficients.chunks_exact_mut(self.stride).enumerate() {
            let Signal { value, rate, acceleration } = at.inputs.get(k).copied().unwrap_or_default();
            let higher = further.get(k).copied().unwrap_or_default();
            let known = [value, rate, acceleration].into_iter().chain(higher.iter().copied());
            series.fill(f64::NAN);
            for (order, (coefficient, derivative)) in series.iter_mut().zip(known).enumerate() {
                *coefficient = derivative / factorial(order);
            }
        }
    }

    /// Input `k` with its rate and its acceleration; `series` makes a series from a function that returns its
    /// coefficients.
    pub(super) fn signal<T>(&self, k: usize, mut series: impl FnMut(&dyn Fn(usize) -> f64) -> T) -> Signal<T> {
        let coefficients = &self.coefficients[k * self.stride..][..self.stride];
        // Coefficients that are not stored are unknown.
        let at = |i: usize| coefficients.get(i).copied().unwrap_or(f64::NAN);
        let [value, rate, acceleration] =
            [0, 1, 2].map(|order| series(&|i| (i + 1..=i + order).map(|m| m as f64).product::<f64>() * at(i + order)));
        Signal { value, rate, acceleration }
    }

    /// Time as a series on a tape.
    fn time_on<'t>(&self, tape: &'t Tape) -> Series<'t> {
        tape.leaf(&|k| match k {
            0 => self.t,
            1 => 1.0,
            _ => 0.0,
        })
    }

    /// Input `k` as a series on a tape.
    fn signal_on<'t>(&self, tape: &'t Tape, k: usize) -> Signal<Series<'t>> {
        self.signal(k, |series| tape.source(self.known(k), series))
    }

    /// The highest order to which an input is known.
    fn known(&self, k: usize) -> Missing {
        let series = &self.coefficients[k * self.stride..][..self.stride];
        Missing::Input { index: k, known: series.iter().take_while(|c| !c.is_nan()).count().saturating_sub(1) }
    }
}

/// The arguments of generated code that is evaluated on a tape.
pub(super) struct Setting<'t, M: Mechanism> {
    pub(super) parameters: M::Parameters<Series<'t>>,
    t: Series<'t>,
    inputs: M::Inputs<Series<'t>>,
    pub(super) q: M::Coordinates<Series<'t>>,
}

impl<'t, M: Mechanism> Setting<'t, M> {
    /// With q given by its derivatives, order by order.
    pub(super) fn new(mechanism: &M, inputs: &Inputs, derivatives: &[M::Coordinates<f64>], tape: &'t Tape) -> Self {
        Self {
            parameters: mechanism.parameters(),
            t: inputs.time_on(tape),
            inputs: Array::generate(Signal::constant(Series::from_f64(0.0)), |k| inputs.signal_on(tape, k)),
            q: coordinates::<M>(derivatives, tape),
        }
    }

    pub(super) fn at(&self) -> Instant<'_, Series<'t>> {
        Instant { t: self.t, inputs: self.inputs.as_ref() }
    }
}

/// Coordinates as series, from their derivatives order by order; their rates, if the derivatives begin with the first
/// order.
pub(super) fn coordinates<'t, M: Mechanism>(
    derivatives: &[M::Coordinates<f64>],
    tape: &'t Tape,
) -> M::Coordinates<Series<'t>> {
    Array::generate(Series::from_f64(0.0), |k| tape.leaf(&|order| derivatives[order].as_ref()[k] / factorial(order)))
}

//! The only generic code of proofs: a mechanism as an object that evaluates its rows over boxes.

use super::smooth::Smooth;
use crate::equations::system::Parts;
use crate::mechanism::{LengthError, Mechanism, Workspace};
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::workspace::{Array, Subset};
use core::borrow::Borrow;

/// The rows of a mechanism over boxes, at one instant or over an interval of t.
pub(crate) trait Enclosures {
    /// Sets t to an interval; inputs continue from the initial instant with constant acceleration.
    fn set_time(&mut self, t: Interval);

    /// Evaluates a subset over the box q and, for γ, q̇.
    fn evaluate(
        &mut self,
        subset: Subset,
        q: &[Interval],
        q_dot: &[Interval],
    ) -> Result<Parts<'_, Interval>, LengthError>;

    /// True if Φ_q is proven to have no jumps over the box q; across a jump its derivatives would not bound its change.
    fn is_smooth(&self, q: &[Interval]) -> bool;
}

/// A mechanism with its parameters and an instant as intervals.
pub(crate) struct OverBoxes<'m, M: Mechanism> {
    mechanism: &'m M,
    parameters: M::Parameters<Interval>,
    /// The initial instant.
    start: (Interval, M::Inputs<Interval>),
    t: Interval,
    inputs: M::Inputs<Interval>,
    workspace: Workspace<M, Interval>,
}

impl<'m, M: Mechanism> OverBoxes<'m, M> {
    /// At an instant with as many inputs as the mechanism has.
    pub(crate) fn new(mechanism: &'m M, at: &Instant<'_>) -> Self {
        let input = |k: usize| at.inputs.get(k).copied().unwrap_or_default();
        let inputs = M::Inputs::<Interval>::generate(Signal::constant(Interval::ZERO), |k| {
            input(k).map(<Interval as Scalar>::from_f64)
        });
        let t = Interval::from(at.t);
        Self { mechanism, parameters: mechanism.parameters(), start: (t, inputs), t, inputs, workspace: M::workspace() }
    }
}

impl<M: Mechanism> Enclosures for OverBoxes<'_, M> {
    fn set_time(&mut self, t: Interval) {
        let (start, inputs) = &self.start;
        let since = t - *start;
        self.t = t;
        self.inputs =
            M::Inputs::<Interval>::generate(Signal::constant(Interval::ZERO), |k| inputs.as_ref()[k].after(since));
    }

    fn evaluate(
        &mut self,
        subset: Subset,
        q: &[Interval],
        q_dot: &[Interval],
    ) -> Result<Parts<'_, Interval>, LengthError> {
        let inputs: &[Signal<Interval>] = self.inputs.as_ref();
        let at = Instant { t: self.t, inputs };
        let mechanism: &M = self.mechanism.borrow();
        mechanism.evaluate_with(self.parameters.as_ref(), subset, &at, q, q_dot, &mut self.workspace)?;
        Ok(Parts::of(&self.workspace))
    }

    fn is_smooth(&self, q: &[Interval]) -> bool {
        let parameters = self.mechanism.parameters::<Smooth>();
        let inputs = M::Inputs::<Smooth>::generate(Signal::constant(Smooth(Interval::ZERO)), |k| {
            self.inputs.as_ref()[k].map(Smooth)
        });
        let at = Instant { t: Smooth(self.t), inputs: inputs.as_ref() };
        let q: Vec<Smooth> = q.iter().copied().map(Smooth).collect();
        let still = vec![Smooth(Interval::ZERO); q.len()];
        let mut workspace = M::workspace::<Smooth>();
        let subset = Subset::JACOBIAN;
        let done = self.mechanism.evaluate_with(parameters.as_ref(), subset, &at, &q, &still, &mut workspace);
        done.is_ok() && workspace.phi_q().iter().all(|entry| entry.0.is_defined())
    }
}

/// A very large region, over which only constants have intervals of a single number.
pub(super) fn everywhere(region: &[Interval]) -> Vec<Interval> {
    region.iter().map(|x| x.hull(Interval::new(-1e6, 1e6))).collect()
}

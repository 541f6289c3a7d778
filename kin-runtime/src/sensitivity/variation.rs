//! The thin generic layer: a mechanism evaluated over numbers that carry their derivatives with respect to some of its
//! parameters.

use crate::equations::system::Parts;
use crate::mechanism::{LengthError, Mechanism, Observations, Workspace};
use crate::model::Model;
use crate::plan::{Depth, Solved};
use crate::planned::lists::{BranchValues, Modes};
use crate::results::varied::{Number, Varied, WIDTH};
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::workspace::{Array, Subset};

/// Largest number of coordinates whose numbers are on the stack: a plan computes about twenty values for each.
pub(crate) const MAX_STACK_COORDINATES: usize = 160;

/// If the two closures of a group are nearer to one another than this, the mode of a configuration is undecided.
const UNDECIDED: f64 = 1e-6;

/// A mechanism some of whose parameters vary.
pub(crate) trait Variation {
    /// Names, rows and patterns.
    fn model(&self) -> &'static Model;
    /// Varies these parameters at an instant.
    fn begin(&mut self, at: &Instant<'_>, parameters: &[usize]);
    /// q, q̇ and q̈ by the plan from the q of a state in its modes, with margins; false where these are not decided, and for
    /// a mechanism that is too large.
    fn solve(&mut self, state: &State, varied: &mut Varied) -> Result<bool, LengthError>;
    /// q and its rates up to `depth` by the plan, in these modes, from a q nearby; if a step iterates, from the
    /// solution itself.
    fn solve_from(
        &mut self,
        modes: &[f64],
        start: &[f64],
        depth: Depth,
        varied: &mut Varied,
    ) -> Result<(), LengthError>;
    /// Writes the numbers of the joints' geometry.
    fn write_geometry(&self, numbers: &mut Vec<Number>) -> Result<(), LengthError>;
    /// Evaluates Φ, Φ_q, Φ_t, γ, or a subset.
    fn evaluate(&mut self, subset: Subset, q: &[Number], q_dot: &[Number]) -> Result<Parts<'_, Number>, LengthError>;
    /// Evaluates the observables.
    fn observe(&mut self, q: &[Number], q_dot: &[Number]) -> Result<Parts<'_, Number>, LengthError>;
    /// r = Q − M q̈.
    fn generalized_forces(&self, varied: &Varied, generalized: &mut [Number]) -> Result<(), LengthError>;
    /// The numbers of forces, given λ where the closed forms do not compute it.
    fn forces(&self, varied: &Varied, multipliers: &[Number], forces: &mut [Number]) -> Result<(), LengthError>;
}

/// The [`Variation`] of a [`Mechanism`].
pub(crate) struct Varying<'m, M: Mechanism> {
    mechanism: &'m M,
    t: Number,
    parameters: M::Parameters<Number>,
    inputs: M::Inputs<Number>,
    workspace: Box<Workspace<M, Number>>,
    observations: Box<Observations<M, Number>>,
}

impl<'m, M: Mechanism> Varying<'m, M> {
    /// Takes the struct's parameters and makes workspaces.
    pub(crate) fn new(mechanism: &'m M) -> Self {
        Self {
            mechanism,
            t: Number::from_f64(0.0),
            parameters: mechanism.parameters(),
            inputs: M::Inputs::filled(Signal::constant(Number::from_f64(0.0))),
            workspace: Box::new(M::workspace()),
            observations: Box::new(M::observations()),
        }
    }

    /// Varies these parameters, at most `WIDTH` of them, around the values of all parameters.
    pub(crate) fn vary_around(&mut self, values: &[f64], at: &Instant<'_>, parameters: &[usize]) {
        self.t = Number::from_f64(at.t);
        for (k, input) in self.inputs.as_mut().iter_mut().enumerate() {
            *input = at.inputs.get(k).copied().unwrap_or_default().map(Number::from_f64);
        }
        write_numbers(values, self.parameters.as_mut());
        for (index, &parameter) in parameters.iter().take(WIDTH).enumerate() {
            if let Some(number) = self.parameters.as_mut().get_mut(parameter) {
                // A parameter may be listed more than once.
                let mut by = number.by();
                by[index] = 1.0;
                *number = Number::new(number.value(), by);
            }
        }
    }

    fn at(&self) -> Instant<'_, Number> {
        Instant { t: self.t, inputs: self.inputs.as_ref() }
    }
}

/// Writes values as numbers that do not vary, 0 where there is no value.
fn write_numbers(values: &[f64], numbers: &mut [Number]) {
    for (k, number) in numbers.iter_mut().enumerate() {
        *number = Number::from_f64(values.get(k).copied().unwrap_or(0.0));
    }
}

/// Makes a list of zeros.
fn zero(list: &mut Vec<Number>, length: usize) {
    list.clear();
    list.resize(length, Number::from_f64(0.0));
}

/// The signs of the modes of a state; none where a group is so near to its limit that they are not decided.
pub(super) fn modes_of<M: Mechanism>(mechanism: &M, state: &State) -> Result<Option<Modes<M>>, LengthError> {
    modes_at(mechanism, mechanism.parameters::<f64>().as_ref(), &state.instant(), &state.q)
}

/// As [`modes_of`], with these parameters.
pub(crate) fn modes_at<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    at: &Instant<'_>,
    q: &[f64],
) -> Result<Option<Modes<M>>, LengthError> {
    let branch_values = BranchValues::at(mechanism, parameters, at, q)?;
    let decided = branch_values.as_ref().iter().all(|closure| closure.abs() > UNDECIDED);
    Ok(decided.then(|| branch_values.modes()))
}

impl<M: Mechanism> Variation for Varying<'_, M> {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn begin(&mut self, at: &Instant<'_>, parameters: &[usize]) {
        self.vary_around(self.mechanism.parameters::<f64>().as_ref(), at, parameters);
    }

    fn solve(&mut self, state: &State, varied: &mut Varied) -> Result<bool, LengthError> {
        if M::COORDINATES > MAX_STACK_COORDINATES {
            return Ok(false);
        }
        let Some(modes) = modes_of(self.mechanism, state)? else { return Ok(false) };
        self.solve_from(modes.of_closures(), &state.q, Depth::Acceleration, varied)?;
        Ok(true)
    }

    fn solve_from(
        &mut self,
        modes: &[f64],
        start: &[f64],
        depth: Depth,
        varied: &mut Varied,
    ) -> Result<(), LengthError> {
        let [mut signs, mut first] = [M::Coordinates::<Number>::filled(Number::from_f64(0.0)); 2];
        write_numbers(modes, signs.as_mut());
        write_numbers(start, first.as_mut());
        let Varied { q, q_dot, q_ddot, margins, .. } = varied;
        zero(margins, M::model().plan.margins);
        for list in [&mut *q, &mut *q_dot, &mut *q_ddot] {
            zero(list, M::COORDINATES);
        }
        let solved = Solved { q, q_dot, q_ddot, margins };
        let signs = &signs.as_ref()[..M::model().plan.modes.len()];
        self.mechanism.solve_with(self.parameters.as_ref(), &self.at(), signs, first.as_ref(), depth, solved)
    }

    fn write_geometry(&self, numbers: &mut Vec<Number>) -> Result<(), LengthError> {
        zero(numbers, M::model().geometry);
        self.mechanism.write_geometry(self.parameters.as_ref(), &self.at(), numbers)
    }

    fn evaluate(&mut self, subset: Subset, q: &[Number], q_dot: &[Number]) -> Result<Parts<'_, Number>, LengthError> {
        let at = Instant { t: self.t, inputs: self.inputs.as_ref() };
        self.mechanism.evaluate_with(self.parameters.as_ref(), subset, &at, q, q_dot, &mut self.workspace)?;
        Ok(Parts::of(&self.workspace))
    }

    fn observe(&mut self, q: &[Number], q_dot: &[Number]) -> Result<Parts<'_, Number>, LengthError> {
        let at = Instant { t: self.t, inputs: self.inputs.as_ref() };
        self.mechanism.observe_with(self.parameters.as_ref(), &at, q, q_dot, &mut self.observations)?;
        Ok(Parts::of(&self.observations))
    }

    fn generalized_forces(&self, varied: &Varied, generalized: &mut [Number]) -> Result<(), LengthError> {
        let Varied { q, q_dot, q_ddot, .. } = varied;
        self.mechanism.generalized_forces_with(self.parameters.as_ref(), &self.at(), q, q_dot, q_ddot, generalized)
    }

    fn forces(&self, varied: &Varied, multipliers: &[Number], forces: &mut [Number]) -> Result<(), LengthError> {
        let Varied { q, q_dot, q_ddot, .. } = varied;
        self.mechanism.forces_with(self.parameters.as_ref(), &self.at(), q, q_dot, q_ddot, multipliers, forces)
    }
}

//! The thin generic layer: a mechanism as a trait object that evaluates in `f64`.
//!
//! All numerical methods work on `dyn System`, so that they are compiled once, in this crate, and not again for every
//! mechanism of the user.

use crate::course::InputFunction;
use crate::evaluation::curve::CurvePoint;
use crate::mechanism::{LengthError, Mechanism, Observations, Workspace};
use crate::model::{Model, Pattern};
use crate::plan::{Depth, Solved};
use crate::planned::PlanError;
use crate::planned::follower::{Control, PlanFollower, PlanSolution, StepsTaken};
use crate::planned::narrow_curves::{Resolution, narrow_curves_are_followed};
use crate::planned::parts::Span;
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::workspace::{Array, Evaluation, Subset};
use core::borrow::Borrow;

/// The values e of rows or observables, the non-zeros of their Jacobian, their time derivatives and the right-hand
/// sides of their accelerations.
pub(crate) struct Parts<'a, T = f64> {
    /// e, one number per row.
    pub(crate) phi: &'a [T],
    /// The non-zeros of e_q.
    pub(crate) phi_q: &'a [T],
    /// e_t.
    pub(crate) phi_t: &'a [T],
    /// −(e_q q̇)_q q̇ − 2 e_qt q̇ − e_tt.
    pub(crate) gamma: &'a [T],
}

impl<'a, T> Parts<'a, T> {
    /// The lists of an evaluation.
    #[inline]
    pub(crate) fn of<R: AsRef<[T]>, J: AsRef<[T]>>(evaluation: &'a Evaluation<R, J>) -> Self {
        Self { phi: evaluation.phi(), phi_q: evaluation.phi_q(), phi_t: evaluation.phi_t(), gamma: evaluation.gamma() }
    }
}

impl<'a, T: Scalar> Parts<'a, T> {
    /// The entries of a row of e_q with their indices in q; `pattern` is sorted by rows.
    pub(crate) fn gradient(&self, pattern: &Pattern, row: usize) -> impl Iterator<Item = (usize, T)> + use<'a, T> {
        let first = pattern.entries.partition_point(|&(r, _)| r < row);
        let (entries, numbers) = (&pattern.entries[first..], self.phi_q.get(first..).unwrap_or_default());
        let of_row = entries.iter().zip(numbers).take_while(move |((r, _), _)| *r == row);
        of_row.map(|(&(_, column), &entry)| (column, entry))
    }

    /// e, ė = e_q q̇ + e_t and ë = e_q q̈ − γ of a row, for parts evaluated at q and q̇ of the state.
    #[inline(always)]
    pub(crate) fn rates(&self, pattern: &Pattern, row: usize, q_dot: &[T], q_ddot: &[T]) -> Signal<T> {
        let still = Signal { value: self.phi[row], rate: self.phi_t[row], acceleration: -self.gamma[row] };
        self.gradient(pattern, row).fold(still, |sum, (k, entry)| Signal {
            rate: sum.rate + entry * q_dot[k],
            acceleration: sum.acceleration + entry * q_ddot[k],
            ..sum
        })
    }
}

/// A mechanism with its parameters and workspaces.
pub(crate) trait System {
    /// The names, rows and patterns of the mechanism.
    fn model(&self) -> &'static Model;
    /// The parameters.
    fn parameters(&self) -> &[f64];
    /// Evaluates Φ, Φ_q, Φ_t and γ, or a subset of them.
    fn evaluate(&mut self, subset: Subset, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<(), LengthError>;
    /// The results of the last [`evaluate`](Self::evaluate).
    fn constraints(&self) -> Parts<'_>;
    /// Evaluates the observables.
    fn observe(&mut self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<(), LengthError>;
    /// The results of the last [`observe`](Self::observe).
    fn observables(&self) -> Parts<'_>;
    /// A point of the curve of a joint.
    fn curve(&self, at: &Instant<'_>, joint: usize, s: f64) -> Option<CurvePoint>;
    /// Computes q, q̇ and q̈ by the plan.
    fn solve(
        &mut self,
        at: &Instant<'_>,
        modes: &[f64],
        start: &[f64],
        depth: Depth,
        solved: Solved<'_, f64>,
    ) -> Result<(), LengthError>;
    /// Writes the branch value of every group of the plan at q, whose sign distinguishes the branches.
    fn branches(&self, at: &Instant<'_>, q: &[f64], branch_values: &mut [f64]) -> Result<(), LengthError>;
    /// Writes for every coordinate how far the gradients of rows turn with it, in radians per unit (see
    /// [`Mechanism::turns_with`]).
    fn turns(&self, at: &Instant<'_>, q: &[f64], turns: &mut [f64]) -> Result<(), LengthError>;
    /// Writes for every row the sum of 1/d² over the distances d of points in it (see [`Mechanism::closeness_with`]).
    fn closeness(&self, at: &Instant<'_>, q: &[f64], closeness: &mut [f64]) -> Result<(), LengthError>;
    /// Whether the plan iterates on rows with curves.
    fn iterates_on_curves(&self) -> bool;
    /// See [`Mechanism::DISTANCES_IN_ROWS`].
    fn distances_in_rows(&self) -> bool;
    /// See [`Mechanism::CLOSED_ROWS_TURN`].
    fn closed_rows_turn(&self) -> bool;
    /// See [`Mechanism::KNOWN_VALUES_CURVE`].
    fn known_values_curve(&self) -> bool;
    /// Writes enclosures of the [`turns`](Self::turns) over a box; nothing where no rows with curves are iterated on.
    fn turns_over(&self, at: &Instant<'_, Interval>, q: &[Interval], turns: &mut [Interval])
    -> Result<(), LengthError>;
    /// True if `is_near` is true wherever known functions may have a narrow feature within a step between two instants.
    fn follows_narrow_curves(
        &self,
        instants: [&Instant<'_>; 2],
        span: Span<'_>,
        resolution: Resolution,
        is_near: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
    ) -> Result<bool, LengthError>;
    /// The local points, axes and values of joints.
    fn geometry(&self, at: &Instant<'_>) -> Result<Vec<f64>, LengthError> {
        let mut numbers = vec![0.0; self.model().geometry];
        self.write_geometry(at, &mut numbers)?;
        Ok(numbers)
    }
    /// Writes the local points, axes and values of joints, [`Model::geometry`] numbers.
    fn write_geometry(&self, at: &Instant<'_>, numbers: &mut [f64]) -> Result<(), LengthError>;
    /// Writes r = Q − M q̈ at a solved state.
    fn generalized_forces(&self, at: &Instant<'_>, state: &State, generalized: &mut [f64]) -> Result<(), LengthError>;
    /// Writes what loads exert on bodies at a state.
    fn loads(&self, at: &Instant<'_>, state: &State, loads: &mut [f64]) -> Result<(), LengthError>;
    /// Writes the numbers of all forces at a solved state; `multipliers` is λ where the closed forms do not compute it.
    fn forces(
        &self,
        at: &Instant<'_>,
        state: &State,
        multipliers: &[f64],
        forces: &mut [f64],
    ) -> Result<(), LengthError>;
    /// Places the follower of the plan at an instant, in the assembly modes of q.
    fn follow_from(&mut self, at: &Instant<'_>, q: &[f64]) -> Result<(), PlanError>;
    /// Moves the follower of the plan to another instant on its branch and writes q, q̇ and q̈ into the state; the inputs
    /// may be given as functions of time.
    fn follow(
        &mut self,
        at: &Instant<'_>,
        inputs: InputFunction<'_>,
        control: &Control,
        state: &mut State,
    ) -> Result<Followed, PlanError>;
    /// q at the limit that ended the last [`follow`](Self::follow), where the limit was located.
    fn q_at_limit(&self) -> Option<&[f64]>;
    /// Writes the solution that [`follow`](Self::follow) would find at an instant, without moving the follower.
    fn peek(
        &mut self,
        at: &Instant<'_>,
        inputs: InputFunction<'_>,
        control: &Control,
        state: &mut State,
    ) -> Result<Followed, PlanError>;
}

/// What the follower of the plan reports of a solution besides its numbers.
#[derive(Clone, Copy)]
pub(crate) struct Followed {
    /// The smallest margin.
    pub(crate) least_margin: f64,
    /// The steps from the previous solution to this one.
    pub(crate) steps: StepsTaken,
}

impl Followed {
    /// Writes the numbers of the last accepted state.
    fn write<M: Mechanism>(follower: &PlanFollower<M>, state: &mut State) -> Self {
        let PlanSolution { q, q_dot, q_ddot, margins } = follower.state();
        for (to, from) in [(&mut state.q, q), (&mut state.q_dot, q_dot), (&mut state.q_ddot, q_ddot)] {
            let from = from.as_ref();
            // The usual case has a length that the compiler knows.
            if to.len() == from.len() {
                to.copy_from_slice(from);
            } else {
                to.clear();
                to.extend_from_slice(from);
            }
        }
        Self { least_margin: margins.least(), steps: follower.steps() }
    }
}

/// The [`System`] of a [`Mechanism`], borrowed or owned.
pub(crate) struct Evaluator<B, M: Mechanism> {
    mechanism: B,
    parameters: M::Parameters<f64>,
    workspace: Box<Workspace<M>>,
    observations: Box<Observations<M>>,
    follower: Option<Box<PlanFollower<M>>>,
}

impl<B: Borrow<M>, M: Mechanism> Evaluator<B, M> {
    /// Copies the parameters of the struct and allocates workspaces.
    pub(crate) fn new(mechanism: B) -> Self {
        let parameters = mechanism.borrow().parameters();
        Self {
            mechanism,
            parameters,
            workspace: Box::new(M::workspace()),
            observations: Box::new(M::observations()),
            follower: None,
        }
    }
}

impl<B: Borrow<M>, M: Mechanism> System for Evaluator<B, M> {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn parameters(&self) -> &[f64] {
        self.parameters.as_ref()
    }

    fn evaluate(&mut self, subset: Subset, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().evaluate_with(self.parameters.as_ref(), subset, at, q, q_dot, &mut self.workspace)
    }

    fn constraints(&self) -> Parts<'_> {
        Parts::of(&self.workspace)
    }

    fn observe(&mut self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().observe_with(self.parameters.as_ref(), at, q, q_dot, &mut self.observations)
    }

    fn observables(&self) -> Parts<'_> {
        Parts::of(&self.observations)
    }

    fn curve(&self, at: &Instant<'_>, joint: usize, s: f64) -> Option<CurvePoint> {
        self.mechanism.borrow().curve_with(self.parameters.as_ref(), at, joint, s).ok().flatten()
    }

    fn solve(
        &mut self,
        at: &Instant<'_>,
        modes: &[f64],
        start: &[f64],
        depth: Depth,
        solved: Solved<'_, f64>,
    ) -> Result<(), LengthError> {
        self.mechanism.borrow().solve_with(self.parameters.as_ref(), at, modes, start, depth, solved)
    }

    fn branches(&self, at: &Instant<'_>, q: &[f64], branch_values: &mut [f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().branches_with(self.parameters.as_ref(), at, q, branch_values)
    }

    fn turns(&self, at: &Instant<'_>, q: &[f64], turns: &mut [f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().turns_with(self.parameters.as_ref(), at, q, turns)
    }

    fn closeness(&self, at: &Instant<'_>, q: &[f64], closeness: &mut [f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().closeness_with(self.parameters.as_ref(), at, q, closeness)
    }

    fn iterates_on_curves(&self) -> bool {
        M::ROWS_CURVE
    }

    fn distances_in_rows(&self) -> bool {
        M::DISTANCES_IN_ROWS
    }

    fn closed_rows_turn(&self) -> bool {
        M::CLOSED_ROWS_TURN
    }

    fn known_values_curve(&self) -> bool {
        M::KNOWN_VALUES_CURVE
    }

    fn turns_over(
        &self,
        at: &Instant<'_, Interval>,
        q: &[Interval],
        turns: &mut [Interval],
    ) -> Result<(), LengthError> {
        if M::ROWS_CURVE {
            let known: M::Parameters<Interval> =
                Array::generate(Interval::ZERO, |k| Interval::from_f64(self.parameters.as_ref()[k]));
            self.mechanism.borrow().turns_with(known.as_ref(), at, q, turns)?;
        }
        Ok(())
    }

    fn follows_narrow_curves(
        &self,
        instants: [&Instant<'_>; 2],
        span: Span<'_>,
        resolution: Resolution,
        is_near: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
    ) -> Result<bool, LengthError> {
        narrow_curves_are_followed(
            self.mechanism.borrow(),
            self.parameters.as_ref(),
            instants,
            span,
            resolution,
            is_near,
        )
    }

    fn generalized_forces(&self, at: &Instant<'_>, state: &State, generalized: &mut [f64]) -> Result<(), LengthError> {
        let (mechanism, parameters) = (self.mechanism.borrow(), self.parameters.as_ref());
        mechanism.generalized_forces_with(parameters, at, &state.q, &state.q_dot, &state.q_ddot, generalized)
    }

    fn loads(&self, at: &Instant<'_>, state: &State, loads: &mut [f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().loads_with(self.parameters.as_ref(), at, &state.q, &state.q_dot, loads)
    }

    fn forces(
        &self,
        at: &Instant<'_>,
        state: &State,
        multipliers: &[f64],
        forces: &mut [f64],
    ) -> Result<(), LengthError> {
        let (mechanism, parameters) = (self.mechanism.borrow(), self.parameters.as_ref());
        mechanism.forces_with(parameters, at, &state.q, &state.q_dot, &state.q_ddot, multipliers, forces)
    }

    fn follow_from(&mut self, at: &Instant<'_>, q: &[f64]) -> Result<(), PlanError> {
        let mechanism = self.mechanism.borrow();
        match &mut self.follower {
            Some(follower) => follower.restart(mechanism, at, q),
            None => {
                self.follower = Some(Box::new(PlanFollower::new(mechanism, at, q)?));
                Ok(())
            }
        }
    }

    fn follow(
        &mut self,
        at: &Instant<'_>,
        inputs: InputFunction<'_>,
        control: &Control,
        state: &mut State,
    ) -> Result<Followed, PlanError> {
        let Some(follower) = &mut self.follower else { return Err(PlanError::NoPlan { why: "nothing is followed" }) };
        let mechanism = self.mechanism.borrow();
        match inputs {
            Some(inputs) => follower.update_timed(mechanism, at, inputs, control)?,
            None => follower.update(mechanism, at, control)?,
        }
        Ok(Followed::write(follower, state))
    }

    fn q_at_limit(&self) -> Option<&[f64]> {
        self.follower.as_ref()?.q_at_limit()
    }

    fn peek(
        &mut self,
        at: &Instant<'_>,
        inputs: InputFunction<'_>,
        control: &Control,
        state: &mut State,
    ) -> Result<Followed, PlanError> {
        let before = self.follower.clone();
        let found = self.follow(at, inputs, control, state);
        self.follower = before;
        found
    }

    fn write_geometry(&self, at: &Instant<'_>, numbers: &mut [f64]) -> Result<(), LengthError> {
        self.mechanism.borrow().write_geometry(self.parameters.as_ref(), at, numbers)
    }
}

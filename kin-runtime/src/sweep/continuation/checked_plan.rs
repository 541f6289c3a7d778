//! Instants solved by the follower of the plan, checked with all rows of Φ, and completed to states.

use super::step::Node;
use crate::analysis::poses::poses;
use crate::analysis::refinement::{ACCURATE_MARGIN, refine};
use crate::equations::Equations;
use crate::equations::contact;
use crate::equations::residual::{RowSums, Tolerances, closed, closed_position, write_lengths, write_sizes};
use crate::equations::system::Followed;
use crate::error::{Degeneracy, SolveError};
use crate::options::Options;
use crate::planned::branch::FAR_FROM_LIMITS;
use crate::planned::follower::{Control, StepsTaken};
use crate::planned::{Limit, PlanError};
use crate::signal::Instant;
use crate::state::State;
use crate::workspace::Subset;

/// The plan as a solver of a sweep, whose solutions are compared with Φ.
#[derive(Clone, Debug)]
pub(super) struct CheckedPlan {
    control: Control,
    /// Whether the follower has been placed at the current configuration of the motion.
    pub(super) is_placed: bool,
    /// Why the plan had no solution at the last attempt; `None` after a success.
    pub(super) refused: Option<PlanError>,
    /// Whether the mechanism has curves, which may have no tangent or normal at some of their points.
    pub(super) has_curves: bool,
    /// The steps in which the follower reached the last state.
    pub(super) steps: StepsTaken,
    /// Buffers for the accumulated sums of every row, and 1 for every coordinate that is a length.
    rows: Vec<RowSums>,
    lengths: Vec<f64>,
    /// The sizes of the rows at the first state; empty until that state is known.
    sizes: Vec<f64>,
    /// The largest residual allowed, relative to these sizes.
    allowed: f64,
}

impl Control {
    /// The control parameters taken from the options of a solver.
    pub(crate) fn of(options: &Options) -> Self {
        Self {
            rotation: options.max_rotation_per_step,
            correction: options.prediction_tolerance,
            min_step: options.min_step,
            max_steps: options.max_steps,
        }
    }
}

impl CheckedPlan {
    /// `None` where the options disable the plan, the mechanism has none, or coordinates are prescribed.
    pub(super) fn new(equations: &Equations<'_>) -> Option<Self> {
        let used = equations.options.use_plan && equations.model.plan.exists() && equations.given() == 0;
        let rows = vec![RowSums::default(); equations.rows()];
        let mut lengths = vec![0.0; equations.coordinates()];
        write_lengths(equations.model, &mut lengths);
        used.then(|| Self {
            control: Control::of(&equations.options),
            is_placed: false,
            refused: None,
            has_curves: equations.model.has_curves,
            steps: StepsTaken::One,
            rows,
            lengths,
            sizes: Vec::new(),
            allowed: 0.0,
        })
    }

    /// The limit that caused the last refusal, if the plan found one.
    pub(super) fn limit(&self) -> Option<Limit> {
        self.refused.as_ref().and_then(PlanError::limit).copied()
    }

    /// True if the follower found that a row or an input jumps.
    pub(super) fn found_a_jump(&self) -> bool {
        matches!(self.refused, Some(PlanError::Jump { .. }))
    }

    /// Places the follower at the current state of the motion; false where the plan has no solution there.
    pub(super) fn start_at(&mut self, equations: &mut Equations<'_>, state: &State) -> bool {
        if !self.is_placed {
            self.refused = equations.system.follow_from(&state.instant(), &state.q).err();
            self.is_placed = self.refused.is_none();
        }
        self.is_placed
    }

    /// Writes the state at the instant of `equations`, on the branch of the follower; false where the plan has no
    /// solution that satisfies all rows.
    pub(super) fn solve(
        &mut self,
        equations: &mut Equations<'_>,
        before: &[f64],
        state: &mut State,
    ) -> Result<bool, SolveError> {
        let at = Instant { t: equations.t, inputs: &equations.inputs };
        let inputs = equations.input_function();
        match equations.system.follow(&at, inputs, &self.control, state) {
            Ok(Followed { least_margin, steps }) => {
                self.refused = None;
                self.steps = steps;
                // Far from limits rates need no check with their equations, because the follower has checked the branch.
                let is_good = least_margin > rates_are_accurate_above(equations)
                    && self.complete_by_position(equations, state)?;
                self.is_placed = is_good || self.complete_by_all_rows(equations, Some(before), least_margin, state)?;
            }
            Err(error) => {
                self.refused = Some(error);
                self.is_placed = false;
            }
        }
        Ok(self.is_placed)
    }

    /// Writes the state at the instant of `equations` without moving the follower.
    pub(super) fn peek(&mut self, equations: &mut Equations<'_>, state: &mut State) -> Option<()> {
        let at = Instant { t: equations.t, inputs: &equations.inputs };
        let inputs = equations.input_function();
        let Followed { least_margin, .. } = equations.system.peek(&at, inputs, &self.control, state).ok()?;
        self.complete_by_all_rows(equations, None, least_margin, state).ok()?.then_some(())
    }

    /// Completes a state far from all limits by checking Φ alone, because there the rates follow from a q that
    /// satisfies Φ = 0. Returns false where this is not certain.
    fn complete_by_position(&mut self, equations: &mut Equations<'_>, state: &mut State) -> Result<bool, SolveError> {
        if self.has_curves || self.sizes.is_empty() {
            return Ok(false);
        }
        let at = Instant { t: equations.t, inputs: &equations.inputs };
        equations.system.evaluate(Subset::PHI, &at, &state.q, &state.q_dot)?;
        let phi = equations.system.constraints().phi;
        let Some(residual) = closed_position(phi, &self.sizes, self.allowed) else {
            return Ok(false);
        };
        self.write_rest(equations, state, residual)?;
        Ok(true)
    }

    /// Writes everything that a state contains besides q, q̇ and q̈.
    fn write_rest(&self, equations: &mut Equations<'_>, state: &mut State, residual: f64) -> Result<(), SolveError> {
        state.t = equations.t;
        state.inputs.clone_from(&equations.inputs);
        state.residual = residual;
        state.iterations = 1;
        state.condition = None;
        state.degrees_of_freedom_left = 0;
        poses(equations, state)
    }

    /// Completes a state with given q, q̇ and q̈; false where they do not satisfy all rows. `before` is the q of the
    /// last state, which is needed where there are curves.
    fn complete_by_all_rows(
        &mut self,
        equations: &mut Equations<'_>,
        before: Option<&[f64]>,
        least_margin: f64,
        state: &mut State,
    ) -> Result<bool, SolveError> {
        if least_margin < rates_are_accurate_above(equations) {
            refine(equations, least_margin < ACCURATE_MARGIN, [&mut state.q, &mut state.q_dot, &mut state.q_ddot])?;
        }
        let at = Instant { t: equations.t, inputs: &equations.inputs };
        equations.system.evaluate(Subset::ALL, &at, &state.q, &state.q_dot)?;
        let tolerances =
            Tolerances { position: equations.options.tolerance, rates: equations.options.consistency_tolerance };
        let solution = [state.q.as_slice(), &state.q_dot, &state.q_ddot];
        let parts = equations.system.constraints();
        let found = closed(equations.model, &parts, solution, &self.lengths, tolerances, &mut self.rows);
        let Some(residual) = found else { return Ok(false) };
        if self.has_curves && !contact::is_regular(equations, before, &state.q)? {
            return Ok(false);
        }
        if self.sizes.is_empty() {
            self.sizes.resize(self.rows.len(), 0.0);
            let parts = equations.system.constraints();
            let (position, lengths) = (equations.options.tolerance, &self.lengths);
            let buffers = [&mut self.sizes[..], &mut vec![0.0; self.rows.len()][..]];
            self.allowed = write_sizes(equations.model, parts.phi_q, &state.q, lengths, position, buffers);
        }
        self.write_rest(equations, state, residual)?;
        Ok(true)
    }

    /// One step by the plan from a state to the place `s` of the course, or to `target` where `s` is too near to a place at
    /// which branches meet: steps are shorter only for the sake of conditions, and a motion that passes there without them
    /// passes with them. Returns the place reached; `None` where the plan has no solution.
    pub(super) fn step(
        &mut self,
        equations: &mut Equations<'_>,
        from: &State,
        to: &mut Node,
        [s, target]: [f64; 2],
    ) -> Result<Option<f64>, SolveError> {
        if self.step_to(equations, from, to, s)? {
            return Ok(Some(s));
        }
        if s == target || self.has_curves || !self.step_to(equations, from, to, target)? {
            return Ok(None);
        }
        // The conditions must not miss the motion that the step hides.
        self.is_placed = self.steps != StepsTaken::ManyForHiddenMotion;
        Ok(self.is_placed.then_some(target))
    }

    /// One step by the plan; false where it has no solution.
    fn step_to(
        &mut self,
        equations: &mut Equations<'_>,
        from: &State,
        to: &mut Node,
        s: f64,
    ) -> Result<bool, SolveError> {
        if !self.start_at(equations, from) {
            return Ok(false);
        }
        match equations.move_to(s) {
            // The plan may find a limit before the length is negative.
            Err(SolveError::DegenerateGeometry { fault: Degeneracy::NegativeLength { .. }, .. }) | Ok(()) => {}
            Err(error) => return Err(error),
        }
        to.s = s;
        to.basis = None;
        self.solve(equations, &from.q, &mut to.state)
    }
}

/// The margin above which the plan's rates need no refinement. A state without a preceding motion needs
/// [`FAR_FROM_LIMITS`] for its branch; with redundant rows the rates do.
fn rates_are_accurate_above(equations: &Equations<'_>) -> f64 {
    if equations.model.plan.has_redundant_rows() { FAR_FROM_LIMITS } else { ACCURATE_MARGIN }
}

//! Analyses of one instant by the plan, which is tried first wherever it applies.
//!
//! This avoids the set-up of the general path (common scale, order of elimination). The plan solves, and all rows are
//! evaluated at its solution; if one is not satisfied, or if there is no solution, the general path is used.
//!
//! A complete configuration determines the signs of all modes; from a partial guess
//! [`guessed_modes`](super::guessed_modes) determines them.

use super::guessed_modes::Guess;
use super::settings::all_guesses;
use super::{Position, Solver};
use crate::analysis::poses::{coordinate_motions, write_poses};
use crate::analysis::refinement::{ACCURATE_MARGIN, correct, refine};
use crate::equations::residual::{
    RowSums, Tolerances, certainly_closed, closed, closed_position, write_lengths, write_sizes,
};
use crate::equations::system::Parts;
use crate::mechanism::{Mechanism, Workspace};
use crate::model::Model;
use crate::motion::BodyMotion;
use crate::plan::{Depth, Solved};
#[cfg(feature = "design")]
use crate::planned::PlanError;
use crate::planned::accurate_solution::solve_accurately;
use crate::planned::branch::FAR_FROM_LIMITS;
use crate::planned::follower::{PlanFollower, PlanSolution};
use crate::planned::lists::{BranchValues, Margins, Modes};
use crate::planned::steep_rows::{first_steep, may_be_steep};
use crate::scalar::compare::{all_above, all_finite};
use crate::signal::Instant;
use crate::state::State;
use crate::workspace::{Array, Subset};

/// The start of a solution by the plan: the modes, and a configuration. The angles of the solution are within half a
/// turn of those of this configuration.
struct PlanStart<M: Mechanism> {
    q: M::Coordinates<f64>,
    modes: Modes<M>,
    /// Whether all coordinates are given, and not only those with guesses; others start at 0.
    is_complete: bool,
}

impl<M: Mechanism> Solver<'_, M> {
    /// The state near a complete start, or else the one that the guesses lead to; `None` if the general path must be used.
    pub(crate) fn state_by_plan(&self, at: &Instant<'_>, start: Option<&[f64]>) -> Option<State> {
        let (parameters, start) = self.start_by_plan(at, start)?;
        self.state_of(&parameters, at, &start)
    }

    /// As [`state_by_plan`](Self::state_by_plan), for the position alone.
    pub(crate) fn position_by_plan(&self, at: &Instant<'_>, start: Option<&[f64]>) -> Option<Position> {
        let (parameters, start) = self.start_by_plan(at, start)?;
        self.position_of(&parameters, at, &start)
    }

    /// The parameters, and the start of a solution by the plan; `None` if the general path must be used.
    #[inline(always)]
    fn start_by_plan(&self, at: &Instant<'_>, start: Option<&[f64]>) -> Option<(M::Parameters<f64>, PlanStart<M>)> {
        if !self.has_solution_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        let start = match start {
            Some(start) => self.start_of(&parameters, at, start)?,
            None => self.start_of_guess(&parameters, at)?,
        };
        Some((parameters, start))
    }

    /// The follower of the plan at the configuration that the guesses lead to, or why the plan has no solution there;
    /// none if the general path must be used.
    #[cfg(feature = "design")]
    pub(crate) fn follower(&self, at: &Instant<'_>) -> Option<Result<PlanFollower<M>, PlanError>> {
        if !self.goes_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        let PlanStart { q, modes, .. } = self.start_of_guess(&parameters, at)?;
        Some(PlanFollower::begin(self.mechanism, parameters, at, q.as_ref(), modes))
    }

    /// The modes of a configuration; `None` if numbers are not finite.
    pub(crate) fn modes_at(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, q: &[f64]) -> Option<Modes<M>> {
        self.start_of(parameters, at, q).map(|start| start.modes)
    }

    /// A complete start and its modes.
    fn start_of(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, start: &[f64]) -> Option<PlanStart<M>> {
        if !all_finite(parameters.as_ref()) || !all_finite(start) {
            return None;
        }
        // The orientations of iterations are those of the solution.
        let modes = match M::model().plan.modes {
            [] => Modes::filled(1.0),
            _ => BranchValues::at(self.mechanism, parameters.as_ref(), at, start).ok()?.modes(),
        };
        let q = *M::Coordinates::<f64>::view(start)?;
        Some(PlanStart { q, modes, is_complete: true })
    }

    /// The start that the guesses determine.
    fn start_of_guess(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>) -> Option<PlanStart<M>> {
        let guess = self.guessed(parameters)?;
        if !all_finite(parameters.as_ref()) {
            return None;
        }
        let mut start = guess;
        write_zeros(start.as_mut());
        let (mut modes, [mut plus, mut minus]) = (Modes::<M>::filled(1.0), [start; 2]);
        Guess { model: M::model(), q: guess.as_ref(), modes: &self.settings.modes }.write_modes(
            modes.of_closures_mut(),
            [plus.as_mut(), minus.as_mut()],
            &mut |modes, q| self.solved(parameters, at, start.as_ref(), modes, q, &mut Margins::filled(0.0)),
        )?;
        Some(PlanStart { q: start, modes, is_complete: false })
    }

    /// The guesses, NaN for coordinates without one; `None` if one is not finite or for a coordinate that does not
    /// exist.
    fn guessed(&self, parameters: &M::Parameters<f64>) -> Option<M::Coordinates<f64>> {
        // There are never more guesses than coordinates.
        let mut values = M::Coordinates::<f64>::filled(0.0);
        let values = values.as_mut().get_mut(..M::model().guesses.len())?;
        self.mechanism.write_guesses(parameters.as_ref(), values).ok()?;
        let mut guess = M::Coordinates::<f64>::filled(f64::NAN);
        write_guess(M::model(), values, &self.settings.guesses, guess.as_mut())?;
        Some(guess)
    }

    /// Writes q and the margins by the plan; the margins are not checked.
    pub(super) fn solved(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        start: &[f64],
        modes: &[f64],
        q: &mut [f64],
        margins: &mut Margins<M>,
    ) -> Option<()> {
        let [mut q_dot, mut q_ddot] = [M::Coordinates::<f64>::filled(0.0); 2];
        let solved = Solved { q, q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        // Margins of iterations and of redundant rows need velocities.
        let depth = if M::model().plan.iterates() { Depth::Velocity } else { Depth::Position };
        solve_accurately(self.mechanism, parameters.as_ref(), (at, modes), start, depth, solved).ok()
    }

    /// The state that the plan finds at an instant, if it satisfies all rows.
    fn state_of(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, start: &PlanStart<M>) -> Option<State> {
        let mut poses = PlanSolution::nothing();
        self.solve_poses(parameters, at, start, &mut poses)?;
        if !self.stays_near(parameters, at, (start.q.as_ref(), start.is_complete), poses.q.as_ref()) {
            return None;
        }
        self.finished(parameters, at, &poses)
    }

    /// Writes the solution of the plan at an instant; `None` if it has none.
    fn solve_poses(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        start: &PlanStart<M>,
        poses: &mut PlanSolution<M>,
    ) -> Option<()> {
        let PlanSolution { q, q_dot, q_ddot, margins } = poses;
        let solved =
            Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        let modes = start.modes.of_closures();
        let depth = Depth::Acceleration;
        solve_accurately(self.mechanism, parameters.as_ref(), (at, modes), start.q.as_ref(), depth, solved).ok()?;
        if !all_above(margins.as_ref(), FAR_FROM_LIMITS) {
            // Near a limit of the rows that the plan uses, redundant rows may determine the motion better.
            if M::model().plan.has_redundant_rows() {
                return None;
            }
            // Near a limit the checks of the follower decide.
            let follower = PlanFollower::begin(self.mechanism, *parameters, at, start.q.as_ref(), start.modes).ok()?;
            *poses = *follower.state();
            self.refine(at, poses)?;
        }
        Some(())
    }

    /// Refines a solution beside a limit of the plan's formulas; `None` if this fails.
    #[cold]
    fn refine(&self, at: &Instant<'_>, PlanSolution { q, q_dot, q_ddot, margins }: &mut PlanSolution<M>) -> Option<()> {
        if all_above(margins.as_ref(), ACCURATE_MARGIN) {
            return Some(());
        }
        let mut equations = self.equations(at).ok()?;
        refine(&mut equations, true, [q.as_mut(), q_dot.as_mut(), q_ddot.as_mut()]).ok()
    }

    /// The state with these rates, if it satisfies all rows.
    fn finished(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, poses: &PlanSolution<M>) -> Option<State> {
        let model = M::model();
        let solution = [poses.q.as_ref(), poses.q_dot.as_ref(), poses.q_ddot.as_ref()];
        let [q, q_dot, _] = solution;
        let mut workspace = M::workspace::<f64>();
        let residual = if !model.has_curves && all_above(poses.margins.as_ref(), FAR_FROM_LIMITS) {
            // Far from all limits, rates need no check if q satisfies the rows.
            self.position_residual(parameters, at, q, &mut workspace)?
        } else {
            self.mechanism.evaluate_with(parameters.as_ref(), Subset::ALL, at, q, q_dot, &mut workspace).ok()?;
            self.residual(&Parts::of(&workspace), solution)?
        };
        if !self.slopes_are_certain(parameters, at, solution) {
            return None;
        }
        if !solution.iter().all(|numbers| all_finite(numbers)) || model.has_curves && !self.touches(at, q) {
            return None;
        }
        if model.poses_are_coordinates() {
            return Some(state_with(model, at, solution, coordinate_motions(model, solution).collect(), residual));
        }
        let mut state = state_with(model, at, solution, Vec::with_capacity(model.bodies.len()), residual);
        let mut observations = M::observations::<f64>();
        self.mechanism.observe_with(parameters.as_ref(), at, q, q_dot, &mut observations).ok()?;
        write_poses(&Parts::of(&observations), &mut state).ok()?;
        Some(state)
    }

    /// True if rounding errors dominate no coordinate.
    #[inline]
    pub(super) fn slopes_are_certain(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        solution: [&[f64]; 3],
    ) -> bool {
        if !may_be_steep::<M>() {
            return true;
        }
        let mut turns = M::Coordinates::<f64>::filled(0.0);
        let counted = self.mechanism.turns_with(parameters.as_ref(), at, solution[0], turns.as_mut());
        counted.is_ok() && first_steep(M::model(), M::DISTANCES_IN_ROWS, turns.as_ref(), solution).is_none()
    }

    /// The largest residual if all rows of position level are satisfied; otherwise none.
    fn position_residual(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        q: &[f64],
        workspace: &mut Workspace<M, f64>,
    ) -> Option<f64> {
        let (model, tolerance) = (M::model(), self.settings.options.tolerance);
        let still = M::Coordinates::<f64>::filled(0.0);
        let evaluate = |subset: Subset, workspace: &mut Workspace<M, f64>| {
            self.mechanism.evaluate_with(parameters.as_ref(), subset, at, q, still.as_ref(), workspace).ok()
        };
        let mut lengths = M::Coordinates::<f64>::filled(0.0);
        write_lengths(model, lengths.as_mut());
        let lengths = lengths.as_ref();
        // Mostly residuals are so small that Φ_q need not be known.
        if !model.least_sizes.is_empty() {
            evaluate(Subset::PHI, workspace)?;
            if let Some(residual) = certainly_closed(model.least_sizes, workspace.phi(), [q, lengths], tolerance) {
                return Some(residual);
            }
        }
        let [mut sizes, mut angles] = [M::Rows::<f64>::filled(0.0); 2];
        evaluate(Subset::POSITION, workspace)?;
        let buffers = [sizes.as_mut(), angles.as_mut()];
        let allowed = write_sizes(model, workspace.phi_q(), q, lengths, tolerance, buffers);
        closed_position(workspace.phi(), sizes.as_ref(), allowed)
    }

    /// The largest residual if all rows are satisfied, for rates as well; otherwise none.
    fn residual(&self, parts: &Parts<'_>, solution: [&[f64]; 3]) -> Option<f64> {
        let model = M::model();
        let mut lengths = M::Coordinates::<f64>::filled(0.0);
        write_lengths(model, lengths.as_mut());
        let tolerances = Tolerances {
            position: self.settings.options.tolerance,
            rates: self.settings.options.consistency_tolerance,
        };
        all_closed(model, parts, solution, lengths.as_ref(), tolerances)
    }

    /// The position by the plan, if it satisfies all rows.
    fn position_of(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, start: &PlanStart<M>) -> Option<Position> {
        if M::model().plan.has_redundant_rows() || M::model().has_curves {
            // These are checked with rates.
            let State { q, residual, iterations, .. } = self.state_of(parameters, at, start)?;
            return Some(Position { q, iterations, residual });
        }
        let mut margins = Margins::filled(0.0);
        let mut q = M::Coordinates::<f64>::filled(0.0);
        self.solved(parameters, at, start.q.as_ref(), start.modes.of_closures(), q.as_mut(), &mut margins)?;
        let still = M::Coordinates::<f64>::filled(0.0);
        let solution = [q.as_ref(), still.as_ref(), still.as_ref()];
        if !margins.are_good()
            || !self.stays_near(parameters, at, (start.q.as_ref(), start.is_complete), q.as_ref())
            || !self.slopes_are_certain(parameters, at, solution)
        {
            return None;
        }
        if !all_above(margins.as_ref(), ACCURATE_MARGIN) {
            correct(&mut self.equations(at).ok()?, q.as_mut()).ok()?;
        }
        let mut workspace = M::workspace::<f64>();
        let q = q.as_ref();
        let residual = self.position_residual(parameters, at, q, &mut workspace)?;
        Some(Position { q: q.to_vec(), iterations: 1, residual })
    }
}

/// The number of rows for which there is room on the stack.
const STACK_ROWS: usize = 64;

/// Writes the mechanism's own guesses and those of the caller, which prevail; `None` if one of these is not finite or
/// for a coordinate that does not exist.
fn write_guess(model: &Model, values: &[f64], guesses: &[(usize, f64)], guess: &mut [f64]) -> Option<()> {
    for (coordinate, value) in all_guesses(model, values, guesses) {
        *guess.get_mut(coordinate)? = Some(value).filter(|value| value.is_finite())?;
    }
    Some(())
}

/// Writes 0 for coordinates without a guess, which are NaN.
fn write_zeros(guess: &mut [f64]) {
    guess.iter_mut().filter(|guess| guess.is_nan()).for_each(|guess| *guess = 0.0);
}

/// A state without points.
#[inline]
fn state_with(
    model: &'static Model,
    at: &Instant<'_>,
    solution: [&[f64]; 3],
    bodies: Vec<BodyMotion>,
    residual: f64,
) -> State {
    let [q, q_dot, q_ddot] = solution.map(<[f64]>::to_vec);
    State {
        model,
        t: at.t,
        inputs: at.inputs.to_vec(),
        q,
        q_dot,
        q_ddot,
        bodies,
        points: Vec::with_capacity(model.points.len()),
        residual,
        iterations: 1,
        condition: None,
        degrees_of_freedom_left: 0,
    }
}

/// The largest residual if all rows are satisfied; otherwise none.
pub(super) fn all_closed(
    model: &Model,
    parts: &Parts<'_>,
    solution: [&[f64]; 3],
    lengths: &[f64],
    tolerances: Tolerances,
) -> Option<f64> {
    // Usually the rows fit on the stack.
    let mut few = [RowSums::default(); STACK_ROWS];
    let mut many = Vec::new();
    let rows = match few.get_mut(..parts.phi.len()) {
        Some(rows) => rows,
        None => {
            many.resize(parts.phi.len(), RowSums::default());
            &mut many[..]
        }
    };
    closed(model, parts, solution, lengths, tolerances, rows)
}

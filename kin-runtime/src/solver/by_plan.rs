//! Analyses of one instant by the plan, which ordinary calls try first.
//!
//! This avoids the set-up of the general path (common scale, order of elimination). The plan solves, and all rows are
//! evaluated at its answer; if one is not satisfied, or if there is no answer, the general path is used.
//!
//! **What a guess means.** A complete configuration determines the signs of all modes. With a partial guess, every
//! group with guessed coordinates takes the closure that is nearer to them, group by group in the order of the plan. If
//! nothing is guessed of a group, the general path is used.

use super::{Position, Solver};
use crate::analysis::poses::{write_coordinates, write_poses};
use crate::equations::contact::has_curves;
use crate::equations::residual::{Row, Tolerances, closed, closed_position, write_lengths, write_sizes};
use crate::equations::system::Parts;
use crate::mechanism::Mechanism;
use crate::model::{Component, CoordinateKind, JointKind, Model, Role};
use crate::plan::{Depth, Solved, StepKind};
#[cfg(feature = "design")]
use crate::planned::PlanError;
use crate::planned::follower::{Follower, Poses};
use crate::planned::lists::{Closures, Margins, Modes};
use crate::state::State;
use crate::workspace::{Array, Evaluation, Instant, Subset};

/// The start of the plan: its modes, and a configuration within half a turn of which the angles of the result are.
struct Start<M: Mechanism> {
    q: M::Coordinates<f64>,
    modes: Modes<M>,
}

/// If the squared distances of both closures from a guess differ by less than this, the guess does not decide the mode.
const UNDECIDED: f64 = 1e-9;

impl<M: Mechanism> Solver<'_, M> {
    /// The state that the guesses lead to; none if the general path must be used.
    pub(crate) fn state_by_plan(&self, at: &Instant<'_>) -> Option<State> {
        if !self.goes_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        let start = self.start_of_guess(&parameters, at)?;
        self.state_of(&parameters, at, &start)
    }

    /// The state near a complete start; none if the general path must be used.
    pub(crate) fn state_near(&self, at: &Instant<'_>, start: &[f64]) -> Option<State> {
        if !self.goes_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        let start = self.start_of(&parameters, at, start)?;
        self.state_of(&parameters, at, &start)
    }

    /// The follower of the plan at the configuration that the guesses lead to, or why the plan has no solution there; none
    /// if the general path must be used.
    #[cfg(feature = "design")]
    pub(crate) fn follower(&self, at: &Instant<'_>) -> Option<Result<Follower<M>, PlanError>> {
        if !self.goes_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        let Start { q, modes } = self.start_of_guess(&parameters, at)?;
        Some(Follower::begin(self.mechanism, parameters, at, q.as_ref(), modes))
    }

    /// The position that the guesses lead to; none if the general path must be used.
    pub(crate) fn position_by_plan(&self, at: &Instant<'_>) -> Option<Position> {
        if !self.goes_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        self.position_of(&parameters, at, &self.start_of_guess(&parameters, at)?)
    }

    /// The position near a complete start; none if the general path must be used.
    pub(crate) fn position_near(&self, at: &Instant<'_>, start: &[f64]) -> Option<Position> {
        if !self.goes_by_plan(at) {
            return None;
        }
        let parameters = self.mechanism.parameters::<f64>();
        self.position_of(&parameters, at, &self.start_of(&parameters, at, start)?)
    }

    /// True if the plan determines all coordinates and the geometry of the joints is not degenerate.
    pub(super) fn goes_by_plan(&self, at: &Instant<'_>) -> bool {
        let plan = &M::model().plan;
        let usable = self.options.use_plan && plan.exists() && self.given.is_empty();
        let sound = || !has_curves(M::model()) && (!has_sizes(M::model()) || self.is_sound(at));
        let signals = at.inputs.iter().flat_map(|u| [u.value, u.rate, u.acceleration]);
        let finite = at.t.is_finite() && signals.into_iter().all(f64::is_finite);
        usable && finite && self.options.check().is_ok() && at.inputs.len() == M::INPUTS && sound()
    }

    /// True if no dimension of a joint is degenerate at these parameters.
    fn is_sound(&self, at: &Instant<'_>) -> bool {
        let model = M::model();
        let parameters = self.mechanism.parameters::<f64>();
        let mut numbers = vec![0.0; model.geometry];
        if self.mechanism.write_geometry(parameters.as_ref(), at, &mut numbers).is_err() {
            return false;
        }
        model.joints.iter().all(|joint| {
            let radii = joint.geometry.iter().filter(|piece| piece.role == Role::Radius);
            let sum: f64 = radii.filter_map(|piece| numbers.get(piece.offset)).sum();
            let has_centres = joint.kind != JointKind::RollingOnDisc || sum != 0.0;
            has_centres
                && joint.geometry.iter().all(|piece| match (piece.role, numbers.get(piece.offset..)) {
                    (Role::Axis, Some([x, y, ..])) => (x * x + y * y - 1.0).abs() <= 1e-9,
                    (Role::Radius, Some([radius, ..])) => *radius != 0.0,
                    (Role::Value, Some([value, ..])) => value.is_finite() && (*value >= 0.0 || !joint.keeps_distance()),
                    _ => true,
                })
        })
    }

    /// A complete start and its modes.
    fn start_of(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, start: &[f64]) -> Option<Start<M>> {
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        if !finite(parameters.as_ref()) || !finite(start) {
            return None;
        }
        let modes = Closures::at(self.mechanism, parameters.as_ref(), at, start).ok()?.modes();
        let q = *M::Coordinates::<f64>::view(start)?;
        Some(Start { q, modes })
    }

    /// The start that the guesses stand for.
    fn start_of_guess(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>) -> Option<Start<M>> {
        let plan = &M::model().plan;
        // NaN for coordinates without a guess.
        let guess = self.guessed(parameters)?;
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        let guesses = self.guesses.iter().all(|(_, guess)| guess.is_finite());
        if !finite(parameters.as_ref()) || !guesses {
            return None;
        }
        let start = M::Coordinates::<f64>::generate(|k| {
            let guess = guess.as_ref()[k];
            if guess.is_nan() { 0.0 } else { guess }
        });
        let is_guessed = |k: usize| !guess.as_ref()[k].is_nan();
        for step in plan.steps {
            if let StepKind::Newton(unknowns) = step.kind
                && !step.coordinates.iter().take(unknowns).all(|&(k, _)| is_guessed(k))
            {
                return None;
            }
        }
        if self.modes.iter().any(|(_, place, _)| place.is_none()) {
            return None;
        }
        let mut modes = Modes::filled(1.0);
        for (place, mode) in plan.modes.iter().enumerate() {
            if let Some((.., sign)) = self.modes.iter().rev().find(|(_, asked, _)| *asked == Some(place)) {
                modes.as_mut()[place] = sign.value();
                continue;
            }
            let coordinates = plan.steps.get(mode.step)?.coordinates;
            if !coordinates.iter().any(|&(k, _)| is_guessed(k)) {
                return None;
            }
            let [plus, minus] = [1.0, -1.0].map(|sign| {
                modes.as_mut()[place] = sign;
                let q = self.closed_in(parameters, at, &start, &modes)?;
                let guessed = coordinates.iter().map(|&(k, _)| k).filter(|&k| is_guessed(k));
                Some(guessed.map(|k| squared_distance::<M>(k, start.as_ref()[k], q.as_ref()[k])).sum::<f64>())
            });
            let (plus, minus) = (plus?, minus?);
            // False for NaN, too.
            let is_decided = (plus - minus).abs() > UNDECIDED;
            if !is_decided {
                return None;
            }
            modes.as_mut()[place] = if plus < minus { 1.0 } else { -1.0 };
        }
        Some(Start { q: start, modes })
    }

    /// The guesses, NaN for coordinates without one; none if there is one for a coordinate that does not exist.
    fn guessed(&self, parameters: &M::Parameters<f64>) -> Option<M::Coordinates<f64>> {
        let own = M::model().guesses;
        // There are never more guesses than coordinates.
        let mut values = M::Coordinates::<f64>::filled(0.0);
        let values = values.as_mut().get_mut(..own.len())?;
        self.mechanism.write_guesses(parameters.as_ref(), values).ok()?;
        let mut guess = M::Coordinates::<f64>::filled(f64::NAN);
        let all = own.iter().copied().zip(values.iter().copied()).chain(self.guesses.iter().copied());
        for (coordinate, value) in all {
            *guess.as_mut().get_mut(coordinate)? = value;
        }
        Some(guess)
    }

    /// q by the plan, whatever its margins.
    fn closed_in(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        start: &M::Coordinates<f64>,
        modes: &Modes<M>,
    ) -> Option<M::Coordinates<f64>> {
        self.solved(parameters, at, start, modes, &mut Margins::filled(0.0))
    }

    /// q by the plan, with the margins of positions.
    pub(super) fn solved(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        start: &M::Coordinates<f64>,
        modes: &Modes<M>,
        margins: &mut Margins<M>,
    ) -> Option<M::Coordinates<f64>> {
        let plan = &M::model().plan;
        let [mut q, mut q_dot, mut q_ddot] = [M::Coordinates::<f64>::filled(0.0); 3];
        let solved =
            Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        let modes = modes.of_closures();
        let (parameters, start) = (parameters.as_ref(), start.as_ref());
        // Margins of iterations and of redundant rows need velocities.
        let depth = if plan.orientations.is_empty() { Depth::Position } else { Depth::Velocity };
        self.mechanism.solve_with(parameters, at, modes, start, depth, solved).ok()?;
        Some(q)
    }

    /// The state that the plan finds at an instant, if it satisfies all rows.
    fn state_of(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, start: &Start<M>) -> Option<State> {
        let mut poses = Poses::nothing();
        self.solve_poses(parameters, at, start, &mut poses)?;
        self.finished(parameters, at, &poses)
    }

    /// Writes the solution of the plan at an instant; none if it has no answer.
    fn solve_poses(
        &self,
        parameters: &M::Parameters<f64>,
        at: &Instant<'_>,
        start: &Start<M>,
        poses: &mut Poses<M>,
    ) -> Option<()> {
        let Poses { q, q_dot, q_ddot, margins } = poses;
        let solved =
            Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        let modes = start.modes.of_closures();
        let depth = Depth::Acceleration;
        self.mechanism.solve_with(parameters.as_ref(), at, modes, start.q.as_ref(), depth, solved).ok()?;
        if !margins.as_ref().iter().fold(true, |all, margin| all & (*margin > FAR)) {
            // Near a limit, or if redundant rows contradict, the follower decides.
            let follower = Follower::begin(self.mechanism, *parameters, at, start.q.as_ref(), start.modes).ok()?;
            *poses = *follower.state();
        }
        Some(())
    }

    /// The state with these rates, if it satisfies all rows.
    fn finished(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, poses: &Poses<M>) -> Option<State> {
        let model = M::model();
        let solution = [poses.q.as_ref(), poses.q_dot.as_ref(), poses.q_ddot.as_ref()];
        let [q, q_dot, q_ddot] = solution;
        let mut workspace = M::workspace::<f64>();
        let residual = if poses.margins.as_ref().iter().all(|margin| *margin > FAR) {
            // Far from all limits, rates need no check if q satisfies the rows.
            self.mechanism.evaluate_with(parameters.as_ref(), Subset::POSITION, at, q, q_dot, &mut workspace).ok()?;
            self.position_residual(&parts(&workspace), q)?
        } else {
            self.mechanism.evaluate_with(parameters.as_ref(), Subset::ALL, at, q, q_dot, &mut workspace).ok()?;
            self.residual(&parts(&workspace), solution)?
        };
        if !solution.iter().all(|numbers| numbers.iter().fold(true, |all, x| all & x.is_finite())) {
            return None;
        }
        let mut state = State {
            model,
            t: at.t,
            inputs: at.inputs.to_vec(),
            q: q.to_vec(),
            q_dot: q_dot.to_vec(),
            q_ddot: q_ddot.to_vec(),
            bodies: Vec::with_capacity(model.bodies.len()),
            points: Vec::with_capacity(model.points.len()),
            residual,
            iterations: 1,
            condition: None,
            degrees_of_freedom_left: 0,
        };
        if model.poses_are_coordinates() {
            write_coordinates(&mut state);
        } else {
            let mut observations = M::observations::<f64>();
            self.mechanism.observe_with(parameters.as_ref(), at, q, q_dot, &mut observations).ok()?;
            write_poses(&parts(&observations), &mut state).ok()?;
        }
        Some(state)
    }

    /// The largest residual if all rows of position level are satisfied; otherwise none.
    fn position_residual(&self, parts: &Parts<'_>, q: &[f64]) -> Option<f64> {
        let model = M::model();
        let mut lengths = M::Coordinates::<f64>::filled(0.0);
        write_lengths(model, lengths.as_mut());
        let [mut sizes, mut angles] = [M::Rows::<f64>::filled(0.0); 2];
        let (tolerance, buffers) = (self.options.tolerance, [sizes.as_mut(), angles.as_mut()]);
        let allowed = write_sizes(model, parts.phi_q, q, lengths.as_ref(), tolerance, buffers);
        closed_position(parts.phi, sizes.as_ref(), allowed)
    }

    /// The largest residual if all rows are satisfied, for rates as well; otherwise none.
    fn residual(&self, parts: &Parts<'_>, solution: [&[f64]; 3]) -> Option<f64> {
        let model = M::model();
        let mut lengths = M::Coordinates::<f64>::filled(0.0);
        write_lengths(model, lengths.as_mut());
        let tolerances = Tolerances { position: self.options.tolerance, rates: self.options.consistency_tolerance };
        // Usually the rows fit on the stack.
        let mut few = [Row::default(); FEW];
        let mut many = Vec::new();
        let rows = match few.get_mut(..M::ROWS) {
            Some(rows) => rows,
            None => {
                many.resize(M::ROWS, Row::default());
                &mut many[..]
            }
        };
        closed(model, parts, solution, lengths.as_ref(), tolerances, rows)
    }

    /// The position by the plan, if it satisfies all rows.
    fn position_of(&self, parameters: &M::Parameters<f64>, at: &Instant<'_>, start: &Start<M>) -> Option<Position> {
        let model = M::model();
        let mut margins = Margins::filled(0.0);
        let q = self.solved(parameters, at, &start.q, &start.modes, &mut margins)?;
        // Rows that the plan leaves out are checked with rates, which positions alone do not have.
        if !margins.are_good() || model.plan.watched().next().is_some() {
            return None;
        }
        let mut workspace = M::workspace::<f64>();
        let still = M::Coordinates::<f64>::filled(0.0);
        let (q, still) = (q.as_ref(), still.as_ref());
        self.mechanism.evaluate_with(parameters.as_ref(), Subset::POSITION, at, q, still, &mut workspace).ok()?;
        let residual = self.position_residual(&parts(&workspace), q)?;
        Some(Position { q: q.to_vec(), iterations: 1, residual })
    }
}

/// With margins above this, rates are accurate enough even near crossings of branches.
const FAR: f64 = 1e-2;

/// Rows for which there is room on the stack.
const FEW: usize = 64;

/// An evaluation as slices.
fn parts<R: AsRef<[f64]>, J: AsRef<[f64]>>(evaluation: &Evaluation<R, J>) -> Parts<'_> {
    let (phi, phi_q) = (evaluation.phi(), evaluation.phi_q());
    Parts { phi, phi_q, phi_t: evaluation.phi_t(), gamma: evaluation.gamma() }
}

/// True if a joint has an axis, a radius or a length that may be degenerate for some parameters.
fn has_sizes(model: &Model) -> bool {
    let pieces = model.joints.iter().flat_map(|joint| joint.geometry);
    pieces.into_iter().any(|piece| matches!(piece.role, Role::Axis | Role::Radius | Role::Value))
}

/// The squared distance of a coordinate from its guess; of lengths relative to their size.
fn squared_distance<M: Mechanism>(k: usize, guess: f64, found: f64) -> f64 {
    let square = (guess - found) * (guess - found);
    match M::model().coordinates[k].kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => square,
        CoordinateKind::Pose { .. } => square / (guess * guess + found * found + f64::MIN_POSITIVE),
        CoordinateKind::Scalar => square / (1.0 + guess * guess),
    }
}

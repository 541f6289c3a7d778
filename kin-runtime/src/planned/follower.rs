//! The follower of a plan: a branch of the motion and the state reached on it, and limits of its step length.
//!
//! It moves from one instant to the next in [`update`](super::update), with as many steps as necessary in
//! [`substeps`](super::substeps). [`trial`](super::trial) checks whether a state is on the branch, and [`limit`](super::limit)
//! finds why and where a motion ends.

use super::branch::Branch;
use super::inputs::copy_inputs;
use super::lists::{Distances, Margins, Modes};
use crate::mechanism::Mechanism;
use crate::model::{CoordinateKind, Model};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Limits of the steps of a follower.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Control {
    /// Largest rotation of a body in one step by its velocity or by its acceleration alone, in radians.
    pub(crate) rotation: f64,
    /// Largest distance of a solution from its prediction, relative to the predicted motion.
    pub(crate) correction: f64,
    /// Smallest step, relative to the remaining distance or to the usual step, whichever is shorter.
    pub(crate) min_step: f64,
    /// Largest number of steps on the way to one instant.
    pub(crate) max_steps: usize,
}

impl Control {
    pub(crate) const USUAL: Self = Self { rotation: 0.3, correction: 0.1, min_step: 1e-13, max_steps: 200_000 };
}

/// Largest rotation in one step from a state whose nearest group has the distance w from its limit, in radians. Near
/// a crossing of branches it limits the effect of the rounding error of q̈, which is about ε q̇²/w³.
pub(crate) fn most_turn(control: &Control, w: f64) -> f64 {
    f64::min(control.rotation, 0.01 / f64::EPSILON * w * w * w)
}

/// Corrections up to this size (rad) are always accepted, for motions that start from rest.
pub(crate) const NEGLIGIBLE_CORRECTION: f64 = 1e-4;

/// A solution by the plan: q, q̇, q̈ and margins.
pub(crate) struct PlanSolution<M: Mechanism> {
    pub(crate) q: M::Coordinates<f64>,
    pub(crate) q_dot: M::Coordinates<f64>,
    pub(crate) q_ddot: M::Coordinates<f64>,
    pub(crate) margins: Margins<M>,
}

impl<M: Mechanism> Clone for PlanSolution<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for PlanSolution<M> {}

impl<M: Mechanism> PlanSolution<M> {
    /// A solution with all numbers zero.
    pub(crate) fn nothing() -> Self {
        let zeros = M::Coordinates::<f64>::filled(0.0);
        Self { q: zeros, q_dot: zeros, q_ddot: zeros, margins: Margins::filled(0.0) }
    }
}

/// The steps from one state to the next.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StepsTaken {
    /// One, which shows the motion between both.
    One,
    /// Several, or unknown.
    Many,
    /// Several, because the ends of one step did not show the motion between them.
    ManyForHiddenMotion,
}

/// A branch of the motion and the instant reached on it.
pub(crate) struct PlanFollower<M: Mechanism> {
    pub(super) parameters: M::Parameters<f64>,
    pub(super) branch: Branch<M>,
    pub(super) t: f64,
    pub(super) inputs: M::Inputs<f64>,
    /// The last accepted state and the trial state; before a trial the latter still is the state before the accepted one
    /// if `t_before` is a number, and gives the prediction its fourth and fifth order.
    pub(super) states: [PlanSolution<M>; 2],
    /// Index of the accepted state.
    pub(super) accepted: usize,
    /// The time of the state before the accepted one, if `states` still contains it; otherwise NaN.
    pub(super) t_before: f64,
    /// True if the next state is unrelated to the last one.
    pub(super) starts_anew: bool,
    /// 1 for every mode that the caller has requested since the last accepted state, otherwise 0.
    pub(super) requested: Modes<M>,
    pub(super) predicted: M::Coordinates<f64>,
    /// The smallest |w| of the accepted state.
    pub(super) nearest: f64,
    /// |w| of the groups of the trial state.
    pub(super) distances: Distances<M>,
    /// Factors that convert the coordinates to radians.
    pub(super) weights: M::Coordinates<f64>,
    /// The angles by which the gradients of rows turn per unit of each coordinate, at the accepted state; used if
    /// `rows_turn_alone`.
    pub(super) turns: M::Coordinates<f64>,
    /// See [`rows_turn_alone`].
    pub(super) rows_turn_alone: bool,
    /// Whether there are scalar coordinates, whose weights change with their values.
    pub(super) has_scalars: bool,
    /// Whether a group may change the sign of its determinant although the turns of bodies do not bring it near its
    /// limit.
    pub(super) checks_determinant_signs: bool,
    /// Whether a step to the accepted state was divided because its ends did not show the motion between them, such as a
    /// pulse between two instants at rest.
    pub(super) hides_motion: bool,
    /// q at the limit that ended the last motion, if it was located.
    pub(super) q_at_limit: Option<M::Coordinates<f64>>,
}

impl<M: Mechanism> Clone for PlanFollower<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for PlanFollower<M> {}

/// Why a step was rejected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rejection {
    /// A margin is not positive; its index.
    Margin(usize),
    /// It is not certain that this group has kept its sign; its index among the groups with a sign.
    Group(usize),
    /// The motion is too far from its prediction.
    Coarse,
    /// Rounding errors dominate this coordinate or its rates; its index.
    Rounded(usize),
    /// A number is not finite.
    NonFinite,
}

/// Whether the gradients of rows may turn faster than the bodies: a group is solved for lengths or scalars, or a row
/// contains a curve.
pub(crate) fn rows_turn_alone<M: Mechanism>() -> bool {
    M::ROWS_TURN || M::CLOSED_ROWS_TURN || iterates_lengths_or_scalars(M::model())
}

/// Whether a group is solved for lengths or scalars by iteration.
fn iterates_lengths_or_scalars(model: &Model) -> bool {
    model.plan.iterated_coordinates().any(|k| !model.coordinates[k].kind.is_angle())
}

/// Whether there are scalar coordinates.
pub(crate) fn has_scalars(model: &Model) -> bool {
    model.coordinates.iter().any(|coordinate| coordinate.kind == CoordinateKind::Scalar)
}

impl<M: Mechanism> PlanFollower<M> {
    /// A follower without any state.
    pub(super) fn empty(parameters: M::Parameters<f64>, t: f64) -> Self {
        let zeros = M::Coordinates::<f64>::filled(0.0);
        Self {
            parameters,
            branch: Branch { modes: Modes::filled(0.0), distances: Distances::filled(0.0) },
            t,
            inputs: M::Inputs::<f64>::filled(Signal::constant(0.0)),
            states: [PlanSolution::nothing(); 2],
            accepted: 0,
            t_before: f64::NAN,
            starts_anew: true,
            requested: Modes::filled(0.0),
            predicted: zeros,
            nearest: 1.0,
            distances: Distances::filled(0.0),
            weights: zeros,
            turns: zeros,
            rows_turn_alone: rows_turn_alone::<M>(),
            has_scalars: has_scalars(M::model()),
            checks_determinant_signs: rows_turn_alone::<M>() || M::model().plan.has_poles(),
            hides_motion: false,
            q_at_limit: None,
        }
    }

    /// A follower at a known state, without a previous one.
    #[cfg(all(feature = "simd", feature = "alloc"))]
    pub(crate) fn resume(
        mechanism: &M,
        parameters: M::Parameters<f64>,
        modes: Modes<M>,
        at: &Instant<'_>,
        [q, q_dot, q_ddot]: [M::Coordinates<f64>; 3],
        margins: Margins<M>,
    ) -> Self {
        let mut follower = Self::empty(parameters, at.t);
        follower.states[0] = PlanSolution { q, q_dot, q_ddot, margins };
        follower.branch.modes = modes;
        follower.starts_anew = false;
        super::predict::weights(M::model(), q.as_ref(), follower.weights.as_mut());
        follower.measure_turns(mechanism, at, &q);
        follower.keep_inputs(at.inputs);
        follower.nearest = margins.write_distances(&mut follower.branch.distances);
        follower
    }

    /// Accepts the trial state; `nearest` is the distance of its nearest group from the limit, and `in_one_step` is
    /// true if it was reached from the accepted state in one step.
    pub(super) fn accept(&mut self, at: &Instant<'_>, nearest: f64, in_one_step: bool) {
        self.t_before = if in_one_step { self.t } else { f64::NAN };
        self.hides_motion &= !in_one_step;
        self.branch.distances = self.distances;
        self.nearest = nearest;
        self.accepted = 1 - self.accepted;
        self.t = at.t;
        self.keep_inputs(at.inputs);
    }

    /// Computes `turns` at a configuration, if they are used, and the weights of scalars.
    #[inline]
    pub(super) fn measure_turns(&mut self, mechanism: &M, at: &Instant<'_>, q: &M::Coordinates<f64>) {
        if self.rows_turn_alone {
            let turns = mechanism.turns_with(self.parameters.as_ref(), at, q.as_ref(), self.turns.as_mut());
            debug_assert!(turns.is_ok(), "q and turns have n numbers");
        }
        if self.has_scalars {
            super::predict::weights(M::model(), q.as_ref(), self.weights.as_mut());
        }
    }

    /// q at the limit that ended the last motion, if it was located.
    pub(crate) fn q_at_limit(&self) -> Option<&[f64]> {
        self.q_at_limit.as_ref().map(AsRef::as_ref)
    }

    fn keep_inputs(&mut self, inputs: &[Signal]) {
        copy_inputs(self.inputs.as_mut(), inputs);
    }

    /// The last accepted state.
    #[inline]
    pub(crate) fn state(&self) -> &PlanSolution<M> {
        &self.states[self.accepted]
    }

    /// The trial state.
    #[inline]
    pub(super) fn trial(&self) -> &PlanSolution<M> {
        &self.states[1 - self.accepted]
    }

    /// The time of the last accepted state.
    pub(crate) const fn t(&self) -> f64 {
        self.t
    }

    /// The steps that led to that state from the previous one.
    #[cfg(feature = "std")]
    pub(crate) const fn steps(&self) -> StepsTaken {
        match self.hides_motion {
            true => StepsTaken::ManyForHiddenMotion,
            false if self.t_before.is_nan() => StepsTaken::Many,
            false => StepsTaken::One,
        }
    }

    /// The modes of the branch.
    pub(crate) const fn modes(&self) -> &Modes<M> {
        &self.branch.modes
    }
}

#[cfg(test)]
mod tests {
    use super::{Control, most_turn};

    /// Near a crossing the rounding error of q̈ is ε q̇²/w³; its effect on a step must be less than a hundredth of
    /// the step.
    #[test]
    fn a_step_is_shorter_where_rounding_would_decide_its_end() {
        let control = Control::USUAL;
        assert_eq!([0.3; 3], [1.0, 0.1, 2e-5].map(|w| most_turn(&control, w)));
        for w in [1e-5, 1e-6] {
            let expected = 0.01 / f64::EPSILON * f64::powi(w, 3);
            assert!(expected < 0.3 && (most_turn(&control, w) / expected - 1.0).abs() < 1e-14, "{w}");
        }
        let shorter = Control { rotation: 0.1, ..control };
        assert_eq!(0.1, most_turn(&shorter, 1.0));
    }
}

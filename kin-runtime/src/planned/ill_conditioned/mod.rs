//! Detection of states so near to a crossing of branches that rounding errors dominate their rates.

use super::error::PlanError;
use super::follower::{PlanFollower, PlanSolution};
use super::group_limit::{Limit, LimitKind, Located};
use super::lists::{BranchValues, Distances};
use super::rates::{is_angle, largest_angle, largest_of};
use super::step::Step;
use super::substeps::Blocked;
use crate::course::Around;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::plan::{Depth, Plan, PlanStep, Solved};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Distances √margin below which the accuracy of the rates is checked.
pub(super) const CHECKED_DISTANCE: f64 = 0.1;

/// Upper bound of √margin where rounding errors may dominate the rates beside a crossing: (ε/[`MAX_ACCELERATION_NOISE`])^⅓
/// for the smallest share of the drive, and six times that for motions in which w changes faster than bodies turn.
#[cfg(all(feature = "simd", feature = "alloc"))]
const NEAR_CROSSING: f64 = 1e-2;

/// Ratio √margin / |w| below which the outer pins of a group nearly coincide while its closures are apart.
const PINS: f64 = 0.5;

/// √margin of a group whose outer pins are the length of its terms apart: the weight of the terms is 10⁻⁶.
const PINS_APART: f64 = 1e3;

/// Smallest √margin of a group with nearly coinciding pins; its angles then still have nine digits.
const MIN_DISTANCE_OF_COINCIDING_PINS: f64 = 2e-4;

/// Largest accepted rounding error of q̈ near a crossing of branches, relative to the square of the rate of the group's
/// *drive*: the bodies placed by earlier steps of the plan.
pub(crate) const MAX_ACCELERATION_NOISE: f64 = 4e-6;

/// The least rate of a group whose outer pins pass each other at a small distance, relative to its drive: it turns by
/// half a turn on the way past.
const FAST_PASSAGE: f64 = 30.0;

/// The same as `MAX_ACCELERATION_NOISE` where the outer pins of a group pass each other, relative to q̈ or q̇² of the
/// group where these are larger: the group turns fast there, and its rates have almost as many digits as its angles.
const NOISE_OF_PINS: f64 = 2.2e-4;

/// Angle (rad) of the difference quotients that give ẇ and the rates of √margin: so small that the motion over it is
/// straight.
pub(crate) const QUOTIENT_ANGLE: f64 = 1e-6;

/// Lower bound of the ratio of the rate of the drive to the rate of the group; below it the drive is about to reverse.
const LEAST_SHARE: f64 = 0.05;

/// Ratio of the rates of a group and of its drive below which the group counts as standing still.
const STANDING_RATIO: f64 = 1e-2;

/// Ratio of the rates of a group and of the whole mechanism below which the group's rate is a rounding error.
const TURNING: f64 = 1e-9;

/// At a fold the product of a group's rate and its angle from the limit stays about as large as the rate of its drive,
/// however near the fold is; at a crossing it goes to 0. If this product is below `CROSSING_RATIO` times the drive's
/// rate, the limit is not a fold; above `FOLD_RATIO` times it is one.
const CROSSING_RATIO: f64 = 1e-4;
const FOLD_RATIO: f64 = 0.1;

/// Below this ratio of |w q̈| to q̇² the limit counts as a crossing: at a fold the ratio stays about 1, at a crossing
/// it goes to 0, since q̇ and q̈ are finite while w goes to 0.
const FOLD: f64 = 0.03;

impl<M: Mechanism> PlanFollower<M> {
    /// True where the trial state is so near to a crossing of branches that rounding errors dominate its rates.
    #[inline]
    pub(super) fn is_ill_conditioned(&self, mechanism: &M, at: &Instant<'_>) -> bool {
        self.distances.as_ref().iter().any(|w| *w < CHECKED_DISTANCE) && self.ill_conditioned(mechanism, at).is_some()
    }

    /// The group that is so near to a crossing of branches that rounding errors dominate the rates.
    #[cold]
    #[inline(never)]
    pub(super) fn ill_conditioned(&self, mechanism: &M, at: &Instant<'_>) -> Option<usize> {
        let tried = self.trial();
        let (q, q_dot) = (tried.q.as_ref(), tried.q_dot.as_ref());
        // A configuration ahead, so near that the motion to it is straight: ẇ is the difference quotient.
        let turns = if self.rows_turn_alone { self.turns.as_ref() } else { &[] };
        let further = QUOTIENT_ANGLE / largest_angle(M::model(), turns, q_dot);
        let mut ahead = self.trial().q;
        advance(ahead.as_mut(), q_dot, further);
        let branch_values_at = |q: &[f64]| BranchValues::<M>::at(mechanism, self.parameters.as_ref(), at, q).ok();
        let (now, mut rates) = (branch_values_at(q)?, branch_values_at(ahead.as_ref())?);
        write_slopes(rates.as_mut(), now.as_ref(), further);
        let mut approaches = Distances::<M>::filled(0.0);
        // Where nothing turns, nothing approaches anything.
        if further.is_finite() {
            approaches = self.distances_after(mechanism, at, further, ahead.as_ref())?;
            write_slopes(approaches.as_mut(), self.distances.as_ref(), at.t + further - at.t);
        }
        let groups = [now.as_ref(), rates.as_ref()];
        let distances = [self.distances.as_ref(), approaches.as_ref()];
        ill_conditioned_group(M::model(), groups, distances, [q_dot, tried.q_ddot.as_ref()], turns)
    }

    /// √margin of all groups a time `dt` after the instant, solved from a configuration.
    fn distances_after(&self, mechanism: &M, at: &Instant<'_>, dt: f64, start: &[f64]) -> Option<Distances<M>> {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        inputs.as_mut().iter_mut().zip(at.inputs).for_each(|(then, now)| *then = now.after(dt));
        let later = Instant { t: at.t + dt, inputs: inputs.as_ref() };
        let mut found = *self.trial();
        let PlanSolution { q, q_dot, q_ddot, margins } = &mut found;
        let solved =
            Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        let modes = self.branch.modes.of_closures();
        mechanism.solve_with(self.parameters.as_ref(), &later, modes, start, Depth::Position, solved).ok()?;
        let mut distances = Distances::filled(1.0);
        found.margins.write_distances(&mut distances);
        Some(distances)
    }

    /// The error for a trial state whose rates are dominated by rounding.
    #[cold]
    pub(super) fn explain_ill_conditioned(&mut self, mechanism: &M, at: &Instant<'_>) -> PlanError {
        let t = at.t;
        let group = self.ill_conditioned(mechanism, at);
        let place = group.and_then(|group| M::model().plan.margin_of_group(group)).unwrap_or(0);
        let solution = *self.trial();
        let margin = solution.margins.as_ref()[place];
        // The crossing may lie before or after this instant.
        let blocked = Blocked { interval: [t, t], state: solution, fault: None };
        let mut found = None;
        for side in [-1.0, 1.0] {
            let course = Around { instant: *at, from: t + side * (1.0 + t.abs()) };
            if let (None, Some(group)) = (&found, group) {
                found = self.extrapolate(mechanism, &course, (group, t), &blocked);
            }
        }
        self.q_at_limit = found.as_ref().map(|found| found.q);
        // If it could not be located, the kind of the limit is known only for groups in closed form.
        let closes = group.is_some_and(|group| group < M::model().plan.modes.len());
        let unknown = (t, closes.then_some(LimitKind::BranchPoint));
        let (crossing, kind) = found.map_or(unknown, |found| (found.s, found.kind));
        match Step::of_margin(M::model(), place) {
            Some(step) => {
                let limit = Limit { step, margin, located: Some(Located { at: crossing, kind }) };
                PlanError::Limit { t, limit }
            }
            None => PlanError::NonFinite { what: "margins", index: place, name: "", t },
        }
    }
}

/// Whether [`ill_conditioned_group`] may refuse a group with this √margin and this branch value.
#[cfg(all(feature = "simd", feature = "alloc"))]
pub(crate) fn may_be_ill_conditioned(distance: f64, branch_value: f64) -> bool {
    distance < NEAR_CROSSING || distance < CHECKED_DISTANCE.min(PINS * branch_value.abs())
}

/// Moves a configuration along its rates.
fn advance(q: &mut [f64], q_dot: &[f64], by: f64) {
    q.iter_mut().zip(q_dot).for_each(|(q, rate)| *q += by * rate);
}

/// Replaces numbers by their slopes on the way from earlier ones, `width` before.
fn write_slopes(values_ahead: &mut [f64], now: &[f64], width: f64) {
    values_ahead.iter_mut().zip(now).for_each(|(values_ahead, now)| *values_ahead = (*values_ahead - now) / width);
}

/// The indices of the steps of all groups, in the order of their signs.
fn groups_of(plan: &Plan) -> impl Iterator<Item = usize> {
    plan.modes.iter().chain(plan.orientations).map(|group| group.step)
}

/// The group that is so near to a crossing of branches that rounding errors dominate the rates. The arguments are w and
/// ẇ of every group, √margin of every group (`distances`) and its rate (`approaches`), q̇ and q̈, and the angles by
/// which the gradients of iterated rows turn per unit of every coordinate (`turns`, which may be empty): a body that
/// slides without turning moves its group, too.
///
/// With x = q̇ w/ẇ, the angle between the group and the crossing, the rounding of w² causes an error of about ε/(w x²)
/// in q̈/q̇². Where √margin is much smaller than |w|, the closures are apart and the outer pins of the group nearly
/// coincide. With δ, their distance relative to the terms of which it is the difference, the error of q̈ is about ε/δ³
/// times the square of the rate of the drive. Where the pins do not meet before the drive has turned by a radian at
/// their present rate, |δ̇| ≤ δ times the rate of the drive, the group is small, and the error of q̈ is only about ε/δ
/// of the larger one of q̈ and q̇².
pub(crate) fn ill_conditioned_group(
    model: &Model,
    [groups, rates_of_groups]: [&[f64]; 2],
    [distances, approaches]: [&[f64]; 2],
    [q_dot, q_ddot]: [&[f64]; 2],
    turns: &[f64],
) -> Option<usize> {
    let plan = &model.plan;
    let indices = |step: &'static PlanStep| step.coordinates.iter().map(|&(k, _)| k);
    let largest_of_step = |step: usize, rates: &[f64]| {
        largest_of(model, turns, &mut plan.steps.iter().skip(step).take(1).flat_map(indices), rates)
    };
    // The rate of the steps that drive a group; groups near their own limits are left out, since they move as fast as
    // this one.
    let is_near =
        |step: usize| groups_of(plan).enumerate().any(|(k, other)| other == step && distances[k] < CHECKED_DISTANCE);
    let drive = |step: usize| {
        let steps = plan.steps.iter().take(step).enumerate().filter(|(step, _)| !is_near(*step));
        largest_of(model, turns, &mut steps.flat_map(|(_, step)| indices(step)), q_dot)
    };
    let meet = |group: &usize| {
        let distance = distances[*group];
        if distance >= CHECKED_DISTANCE.min(PINS * groups[*group].abs()) {
            return false;
        }
        let step = plan.modes[*group].step;
        let (before, moves) = (drive(step), largest_of_step(step, q_dot));
        let apart = distance / PINS_APART;
        let noise = f64::EPSILON / (apart * apart * apart) * before * before;
        let largest = largest_of_step(step, q_ddot).max(moves * moves).max(before * before);
        // The comparisons are written so that NaN counts as not clear. A drive that turns nothing has no rate to
        // compare with.
        let passes = before > 0.0 && moves >= FAST_PASSAGE * before && noise <= NOISE_OF_PINS * largest;
        let keeps_apart = approaches[*group].abs() <= before * distance && (before > 0.0 || moves == 0.0);
        !(distance >= MIN_DISTANCE_OF_COINCIDING_PINS && (passes || keeps_apart))
    };
    if let Some(group) = (0..plan.modes.len()).find(meet) {
        return Some(group);
    }
    let fastest = largest_angle(model, turns, q_dot);
    // The error of a linear system is only ε/w.
    let is_linear = |step: usize| plan.steps.get(step).is_some_and(PlanStep::is_linear);
    let mut near =
        groups_of(plan).enumerate().filter(|(group, step)| distances[*group] < CHECKED_DISTANCE && !is_linear(*step));
    near.find_map(|(group, step)| {
        let (before, mut moves, acceleration) =
            (drive(step), largest_of_step(step, q_dot), largest_of_step(step, q_ddot));
        if moves <= TURNING * fastest {
            moves = 0.0;
        }
        let distance = distances[group];
        // Where pins nearly coincide, the margin does not measure the distance of the closures.
        if distance < PINS * groups[group].abs() && group < plan.modes.len() {
            return None;
        }
        let any = |of_kind: &dyn Fn(usize) -> bool| plan.steps.iter().skip(step).take(1).flat_map(indices).any(of_kind);
        let (has_angles, turns_rows) =
            (any(&|k| is_angle(model, k)), any(&|k| turns.get(k).is_some_and(|turn| *turn > 0.0)));
        let angle = |velocity: f64| velocity * (distance / rates_of_groups[group]).abs();
        // A group may stand still while the bodies that drive it move.
        let is_still = moves <= STANDING_RATIO * before;
        let velocity = if is_still { before } else { moves };
        // Lengths alone are measured by the turn of their rows, and w, the sine of an angle of the rows, changes no
        // faster than the rows turn. ẇ may be larger only because the size to which w is relative changes.
        let x = if turns_rows && !has_angles { angle(velocity).max(distance) } else { angle(velocity) };
        // A group that only slides has no angle from its limit. Its w² is proportional to the distance from a fold.
        let slides = !has_angles && !turns_rows;
        let bend = if slides { (distance * rates_of_groups[group]).abs() } else { moves * angle(moves) };
        // This criterion holds for any acceleration of the drive; without a drive, the acceleration of the group
        // decides.
        let (is_slow, is_fast) = (bend <= CROSSING_RATIO * before, before > 0.0 && bend > FOLD_RATIO * before);
        let crosses = is_slow || !is_fast && distance * acceleration <= FOLD * velocity * velocity;
        // The tolerance is relative to the motion of the drive where that is slower.
        let share = if before > 0.0 { (before / velocity).clamp(LEAST_SHARE, 1.0) } else { 1.0 };
        // The comparison is written so that NaN counts as not clear.
        let is_clear = MAX_ACCELERATION_NOISE * distance * x * x * share * share >= f64::EPSILON;
        // If nothing moves, there are no rates to check.
        (velocity > 0.0 && crosses && !is_clear).then_some(group)
    })
}

#[cfg(test)]
mod tests;

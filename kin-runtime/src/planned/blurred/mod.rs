//! States so near to a crossing of branches that rounding decides their rates.

use super::error::{Limit, LimitKind, Located, PlanError};
use super::follower::Follower;
use super::lists::Closures;
use super::step::Step;
use super::walk::Blocked;
use crate::course::Around;
use crate::mechanism::Mechanism;
use crate::model::{Component, CoordinateKind, Model};
use crate::plan::{Plan, PlanStep};
use crate::signal::Instant;
use crate::workspace::Array;

/// Distances |w| below which it is asked whether rates have lost too many digits.
pub(super) const NEAR: f64 = 0.1;

/// √margin over |w| below which pins meet.
const PINS: f64 = 0.5;

/// What rounding may make of q̈ beside a crossing of branches, relative to the square of the drive's rate.
const NOISE: f64 = 4e-6;

/// An angle so small that configurations go along a straight line.
const LITTLE: f64 = 1e-6;

/// What drives a group may be slower than it by this much; where it is slower still, it is about to turn round.
const LEAST_SHARE: f64 = 0.05;

/// Of the rate of what drives it, by how much a group moves at least that does not stand still.
const STILL: f64 = 1e-2;

/// At a fold the product of a group's rate and its angle from the limit stays about what the rate of its drive is, however
/// near it is; at a crossing it goes to 0. Below the first of these it is no fold, above the second it is one.
const SLOW: f64 = 1e-4;
const FAST: f64 = 0.1;

/// At a fold |w q̈| is about q̇², however near it is. At a crossing both are finite while w goes to 0.
const FOLD: f64 = 0.03;

impl<M: Mechanism> Follower<M> {
    /// True where the state that is being tried is so near to a crossing of branches that its rates mean nothing.
    #[inline]
    pub(super) fn is_blurred(&self, mechanism: &M, at: &Instant<'_>) -> bool {
        self.distances.as_ref().iter().any(|w| *w < NEAR) && self.blurred(mechanism, at).is_some()
    }

    /// The group that is so near to a crossing of branches that rates mean nothing.
    #[cold]
    #[inline(never)]
    pub(super) fn blurred(&self, mechanism: &M, at: &Instant<'_>) -> Option<usize> {
        let tried = &self.states[1 - self.good];
        let (q, q_dot) = (tried.q.as_ref(), tried.q_dot.as_ref());
        // A little further on, as far as that goes along a straight line.
        let further = LITTLE / largest_angle(M::model(), q_dot);
        let ahead = M::Coordinates::<f64>::generate(|k| q[k] + further * q_dot[k]);
        let of = |q: &[f64]| Closures::<M>::at(mechanism, self.parameters.as_ref(), at, q).ok();
        let (now, mut rates) = (of(q)?, of(ahead.as_ref())?);
        rates.as_mut().iter_mut().zip(now.as_ref()).for_each(|(then, now)| *then = (*then - now) / further);
        let groups = [now.as_ref(), rates.as_ref()];
        blurred_group(M::model(), groups, self.distances.as_ref(), [q_dot, tried.q_ddot.as_ref()])
    }

    /// That rates mean nothing at the state that is being tried.
    #[cold]
    pub(super) fn explain_blurred(&mut self, mechanism: &M, at: &Instant<'_>) -> PlanError {
        let t = at.t;
        let group = self.blurred(mechanism, at);
        let place = group.and_then(|group| M::model().plan.margin_of_sign(group)).unwrap_or(0);
        let here = self.states[1 - self.good];
        let margin = here.margins.as_ref()[place];
        // The crossing lies on one side or the other.
        let blocked = Blocked { places: [t, t], here, fault: None };
        let found = [-1.0, 1.0].into_iter().find_map(|side| {
            let course = Around { instant: *at, from: t + side * (1.0 + t.abs()) };
            self.extrapolate(mechanism, &course, (group?, t), &blocked)
        });
        self.limit = found.as_ref().map(|found| found.q);
        // Of an iteration it is not known otherwise.
        let closes = group.is_some_and(|group| group < M::model().plan.modes.len());
        let unknown = (t, closes.then_some(LimitKind::BranchPoint));
        let (crossing, kind) = found.map_or(unknown, |found| (found.place, found.kind));
        match Step::of_margin(M::model(), place) {
            Some(step) => {
                let limit = Limit { step, margin, located: Some(Located { at: crossing, kind }) };
                PlanError::Limit { t, limit }
            }
            None => PlanError::NonFinite { what: "margins", index: place, name: "", t },
        }
    }
}

/// The largest rate of an angle, or of a scalar.
pub(crate) fn largest_angle(model: &Model, rates: &[f64]) -> f64 {
    largest_of(model, &mut (0..rates.len()), rates)
}

fn largest_of(model: &Model, places: &mut dyn Iterator<Item = usize>, rates: &[f64]) -> f64 {
    let turns = |k: &usize| {
        !matches!(model.coordinates[*k].kind, CoordinateKind::Pose { component: Component::X | Component::Y, .. })
    };
    places.filter(turns).map(|k| rates[k].abs()).fold(0.0, f64::max)
}

/// The steps of all groups.
fn groups_of(plan: &Plan) -> impl Iterator<Item = usize> {
    plan.modes.iter().chain(plan.orientations).map(|group| group.step)
}

/// The group that is so near to a crossing of branches that rates mean nothing, given w and ẇ of every group, and √margin.
///
/// With x = q̇ w/ẇ, the angle by which the group is from the crossing, rounding of w² makes about ε/(w x²) of q̈/q̇². Where
/// √margin is much less than |w|, both closures are apart, and it is the pins at both ends of the group that meet.
pub(crate) fn blurred_group(
    model: &Model,
    [groups, rates_of_groups]: [&[f64]; 2],
    distances: &[f64],
    [q_dot, q_ddot]: [&[f64]; 2],
) -> Option<usize> {
    let plan = &model.plan;
    let meet = |sign: &usize| distances[*sign] < NEAR.min(PINS * groups[*sign].abs());
    if let Some(sign) = (0..plan.modes.len()).find(meet) {
        return Some(sign);
    }
    groups_of(plan).enumerate().filter(|(sign, _)| distances[*sign] < NEAR).find_map(|(sign, step)| {
        let of = |step: &'static PlanStep| step.coordinates.iter().map(|&(k, _)| k);
        let own = |rates: &[f64]| largest_of(model, &mut plan.steps.iter().skip(step).take(1).flat_map(of), rates);
        // Of what drives it: a group that is near its own limit moves as fast as this one.
        let is_near = |step: usize| groups_of(plan).enumerate().any(|(k, other)| other == step && distances[k] < NEAR);
        let steps = plan.steps.iter().take(step).enumerate().filter(|(step, _)| !is_near(*step));
        let before = largest_of(model, &mut steps.flat_map(|(_, step)| of(step)), q_dot);
        let (moves, acceleration, w) = (own(q_dot), own(q_ddot), distances[sign]);
        let angle = |velocity: f64| velocity * (w / rates_of_groups[sign]).abs();
        // A group may stand still while what drives it moves.
        let is_still = moves <= STILL * before;
        let velocity = if is_still { before } else { moves };
        let x = angle(velocity);
        // Whatever the drive does just there; without one, accelerations tell.
        let bend = moves * angle(moves);
        let (is_slow, is_fast) = (bend <= SLOW * before, before > 0.0 && bend > FAST * before);
        let crosses = is_slow || !is_fast && w * acceleration <= FOLD * velocity * velocity;
        // Beside the motion of what drives it, where that is slower.
        let share = if before > 0.0 { (before / velocity).clamp(LEAST_SHARE, 1.0) } else { 1.0 };
        // NaN, where it is as good as there, is not clear.
        let is_clear = NOISE * w * x * x * share * share >= f64::EPSILON;
        // Where nothing moves, there are no rates to be spoilt.
        (velocity > 0.0 && crosses && !is_clear).then_some(sign)
    })
}

#[cfg(test)]
mod tests;

//! The motion from one instant to another, in as many steps as are needed to stay on the branch.
//!
//! A step h is accepted if no body turns by more than [`Control::rotation`] by velocity or acceleration alone, the plan
//! has a solution at its end, the solution is near the prediction by the parabola, and every group has the predicted
//! distance from its limit. Otherwise the step is halved. So a group whose two closures come near one another is
//! followed in steps that resolve the bend, and a group that reaches its limit stops the walk just before it.

use super::branch::{first_dip, may_have_touched_limit, resolves};
use super::follower::{Control, NEGLIGIBLE_CORRECTION, PlanFollower, PlanSolution, Rejection, most_turn};
use super::lists::{BranchValues, Modes};
use super::predict::{parabola, turned};
use super::rates::{largest_angle, turning};
use super::step_length::{growth, next_parameter, shortest_step};
use crate::course::Course;
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::plan::{PlanStep, StepKind};
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Where on the course a walk was stopped.
pub(crate) struct Blocked<M: Mechanism> {
    /// The last parameter of the course that was reached, and the next one, which could not be reached.
    pub(super) interval: [f64; 2],
    /// The state at the last one reached.
    pub(super) state: PlanSolution<M>,
    /// The reason; `None` where there were too many steps.
    pub(super) fault: Option<Rejection>,
}

/// If no step is short enough, the limit of a group is the reason if the group is nearer to it than this.
const BLAMED_DISTANCE: f64 = 1e-3;

/// Rates grow without bound if the length of a step that they allow, relative to the rest of the course, is below this.
const UNBOUNDED: f64 = 1e-4;

impl<M: Mechanism> PlanFollower<M> {
    /// Moves along the course and solves at the instant at its end; the result is the trial state.
    pub(super) fn walk(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        control: &Control,
    ) -> Result<(), Blocked<M>> {
        self.hides_motion = false;
        let [mut s, end] = course.ends();
        let mut state = self.states[self.accepted];
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        if course.is_frozen() || !course.has_rates_of_end() {
            // The rates at the start must be those along the course.
            self.predicted = state.q;
            let good = self.solve_at(mechanism, course, s, &mut inputs).unwrap_or(false);
            if good {
                state = *self.trial();
            }
        }
        let (mut proposed, mut smallest, mut nearest) = (f64::INFINITY, f64::NAN, self.nearest);
        // The end of the last step that hides motion. Steps do not grow before it, so that they do not step over that.
        let (mut refused, direction) = (s, (end - s).signum());
        // The last round only finds that the end was reached.
        for _ in 0..=control.max_steps {
            let remaining = end - s;
            if remaining == 0.0 {
                return self.arrive(mechanism, course, at, state);
            }
            let rates = [state.q_dot.as_ref(), state.q_ddot.as_ref()];
            let mut natural = natural_step(rates, self.weights.as_ref(), most_turn(control, nearest));
            if self.rows_turn_alone {
                natural = natural.min(natural_step(rates, self.turns.as_ref(), control.rotation));
            }
            if smallest.is_nan() {
                smallest = shortest_step(control.min_step, natural, [s, end]);
            }
            let (next, share) = next_parameter([s, end], natural.min(proposed));
            let blocked = |fault| Blocked { interval: [s, next], state, fault: Some(fault) };
            if next == s {
                return Err(blocked(self.fault_of_short_steps(&state, natural / remaining.abs())));
            }
            let walked = (next - s).abs();
            let before = core::mem::replace(&mut self.hides_motion, false);
            let result = self.step(mechanism, course, [s, next], &mut inputs, (&state, nearest), control);
            let hides = self.hides_motion;
            self.hides_motion |= before;
            match result {
                Ok(growth) => {
                    state = *self.trial();
                    self.branch.distances = self.distances;
                    nearest = self.measure();
                    s = next;
                    let t = course.at(s, inputs.as_mut());
                    self.measure_turns(mechanism, &Instant { t, inputs: inputs.as_ref() }, &state.q);
                    let growth = if (s - refused) * direction >= 0.0 { growth } else { growth.min(1.0) };
                    // A step cut short by the end is no reason to reduce the longer step proposed before.
                    proposed = if share <= 2.0 { proposed.max(growth * walked) } else { growth * walked };
                }
                Err(fault) => {
                    if 0.5 * walked < smallest {
                        let is_coarse = fault == Rejection::Coarse;
                        let share = natural / remaining.abs();
                        return Err(blocked(if is_coarse { self.fault_of_short_steps(&state, share) } else { fault }));
                    }
                    proposed = 0.5 * walked;
                    self.hides_motion |= fault == Rejection::Coarse;
                    if hides {
                        refused = next;
                    }
                }
            }
        }
        Err(Blocked { interval: [s, end], state, fault: None })
    }

    /// Solves at the instant at the end of the course.
    fn arrive(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        at: &Instant<'_>,
        state: PlanSolution<M>,
    ) -> Result<(), Blocked<M>> {
        let end = course.ends()[1];
        let blocked = |fault| Blocked { interval: [end, end], state, fault: Some(fault) };
        if !course.has_rates_of_end() {
            self.predicted = state.q;
            if !self.solve_in_modes(mechanism, at).unwrap_or(false) {
                return Err(blocked(self.fault()));
            }
            self.measure();
        }
        if let Some(group) = self.ill_conditioned(mechanism, at) {
            return Err(blocked(Rejection::Group(group)));
        }
        match self.first_steep_unknown(&self.turns) {
            Some(k) => Err(blocked(Rejection::Rounded(k))),
            None => Ok(()),
        }
    }

    /// Takes one step; returns the factor by which the next one may be longer.
    fn step(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        [s, next]: [f64; 2],
        inputs: &mut M::Inputs<f64>,
        (state, nearest): (&PlanSolution<M>, f64),
        control: &Control,
    ) -> Result<f64, Rejection> {
        let h = next - s;
        let rates = [state.q.as_ref(), state.q_dot.as_ref(), state.q_ddot.as_ref()];
        let weights = self.weights;
        let turn = parabola(self.predicted.as_mut(), rates, weights.as_ref(), h);
        let modes = self.branch.modes;
        let allowed = control.correction * turn + NEGLIGIBLE_CORRECTION;
        let turn = self.with_rows(turn, state, h);
        let judged = self.judge(mechanism, course, [s, next], inputs, (state, &modes), [allowed, turn, nearest]);
        let result = judged.and_then(|effort| {
            let mut from = *inputs;
            course.at(s, from.as_mut());
            let t = course.at(next, inputs.as_mut());
            let end = Instant { t, inputs: inputs.as_ref() };
            let followed = self.rows_are_followed(mechanism, &end, state, (from.as_ref(), h), control)? && {
                let hides = !self.hides_nothing(mechanism, course, [s, next], (state, &modes), control)?;
                self.hides_motion |= hides;
                !hides
            };
            if followed { Ok(effort) } else { Err(Rejection::Coarse) }
        });
        if result.is_err() {
            self.branch.modes = modes;
        }
        Ok(growth(result?))
    }

    /// Solves at the end of a step and checks it; returns its correction relative to the largest one allowed.
    fn judge(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        [s, next]: [f64; 2],
        inputs: &mut M::Inputs<f64>,
        (state, modes_before): (&PlanSolution<M>, &Modes<M>),
        [allowed, turn, nearest]: [f64; 3],
    ) -> Result<f64, Rejection> {
        let mut good = self.solve_at(mechanism, course, next, inputs)?;
        let t = course.at(next, inputs.as_mut());
        if !good {
            good = self.retry_in_other_modes(mechanism, &Instant { t, inputs: inputs.as_ref() })?;
            // On a frozen course the rates are those in time as yet.
            good = good && (!course.is_frozen() || self.solve_at(mechanism, course, next, inputs)?);
        }
        if !good {
            return Err(self.fault());
        }
        let nearest = f64::min(self.measure(), nearest);
        let tried = self.trial();
        let away = turned(tried.q.as_ref(), self.predicted.as_ref(), self.weights.as_ref());
        // The comparisons are written so that NaN is rejected.
        let (is_expected, is_resolved) = (away <= allowed, resolves(nearest, turn) >= 0.0);
        if !is_expected {
            return Err(Rejection::Coarse);
        }
        if !is_resolved {
            return Err(Rejection::Group(self.nearest_group()));
        }
        let at = Instant { t, inputs: inputs.as_ref() };
        if let Some(group) = self.uncertain(mechanism, &at, self.predicted.as_ref())? {
            return Err(Rejection::Group(group));
        }
        if may_have_touched_limit(self.branch.distances.as_ref(), self.distances.as_ref()) {
            let mut middle = M::Coordinates::<f64>::filled(0.0);
            let rates = [state.q.as_ref(), state.q_dot.as_ref(), state.q_ddot.as_ref()];
            parabola(middle.as_mut(), rates, self.weights.as_ref(), 0.5 * (next - s));
            let (found, parameters) = (self.trial().q, self.parameters);
            // Branch values are compared with one another, as distances of iterated groups may be several times larger.
            let mut branch_values_at = |s: f64, q: &M::Coordinates<f64>| {
                let t = course.at(s, inputs.as_mut());
                let at = Instant { t, inputs: inputs.as_ref() };
                BranchValues::<M>::at(mechanism, parameters.as_ref(), &at, q.as_ref())
            };
            let [before, middle, after] = [
                branch_values_at(s, &state.q)?,
                branch_values_at(s + 0.5 * (next - s), &middle)?,
                branch_values_at(next, &found)?,
            ];
            let modes = [self.branch.modes.as_ref(), modes_before.as_ref()];
            if let Some(group) = first_dip([before.as_ref(), after.as_ref()], middle.as_ref(), modes) {
                return Err(Rejection::Group(group));
            }
        }
        Ok(away / allowed)
    }

    /// Solves from the prediction at a parameter of the course, with rates along the course; true where the solution is
    /// valid. The trial state and, on a frozen course, those of two more solutions are overwritten.
    pub(super) fn solve_at(
        &mut self,
        mechanism: &M,
        course: &dyn Course,
        s: f64,
        inputs: &mut M::Inputs<f64>,
    ) -> Result<bool, LengthError> {
        let t = course.at(s, inputs.as_mut());
        let good = self.solve_in_modes(mechanism, &Instant { t, inputs: inputs.as_ref() })?;
        if !good || !course.is_frozen() {
            return Ok(good);
        }
        // Removes the contribution of time itself: velocities are linear in the rates of the inputs, accelerations
        // quadratic.
        let along = *self.trial();
        let (mut reversed, mut good) = ([along; 2], true);
        for (other, factor) in reversed.iter_mut().zip([0.0, -1.0]) {
            let mut changed = *inputs;
            scale_rates(changed.as_mut(), factor);
            good &= self.solve_in_modes(mechanism, &Instant { t, inputs: changed.as_ref() })?;
            *other = *self.trial();
        }
        let [still, back] = &reversed;
        let tried = &mut self.states[1 - self.accepted];
        *tried = along;
        let rates = [tried.q_dot.as_mut(), tried.q_ddot.as_mut()];
        without_time(rates, [still.q_dot.as_ref(), still.q_ddot.as_ref()], back.q_ddot.as_ref());
        Ok(good)
    }

    /// The reason why no step from `state` is short enough: a group beside its limit or, if `share`, the length of a
    /// step by the rates relative to the rest of the course, is so small that rates grow without bound, the first
    /// group with a determinant that has such rates. (The distance of an iteration of one unknown may stay large up to
    /// its limit.)
    fn fault_of_short_steps(&self, state: &PlanSolution<M>, share: f64) -> Rejection {
        let distances = self.branch.distances.as_ref();
        let group = index_of_least(distances);
        if distances.get(group).is_some_and(|distance| *distance < BLAMED_DISTANCE) {
            return Rejection::Group(group);
        }
        let unbounded = if share < UNBOUNDED { self.first_of_largest_rate(state) } else { None };
        unbounded.map_or(Rejection::Coarse, Rejection::Group)
    }

    /// The first group with a determinant whose unknowns have about the largest rates of all coordinates, in radians.
    fn first_of_largest_rate(&self, state: &PlanSolution<M>) -> Option<usize> {
        let turns = if self.rows_turn_alone { self.turns.as_ref() } else { &[] };
        first_of_largest_rate(M::model(), turns, state.q_dot.as_ref())
    }

    /// The group of the trial state that is nearest to its limit.
    fn nearest_group(&self) -> usize {
        index_of_least(self.distances.as_ref())
    }

    /// The reason why the trial state is not valid.
    pub(super) fn fault(&self) -> Rejection {
        self.trial().margins.first_bad().map_or(Rejection::NonFinite, Rejection::Margin)
    }
}

impl From<LengthError> for Rejection {
    fn from(_: LengthError) -> Self {
        Self::NonFinite
    }
}

/// The first group with a determinant whose unknowns have about the largest rates of all coordinates.
fn first_of_largest_rate(model: &Model, turns: &[f64], q_dot: &[f64]) -> Option<usize> {
    let plan = &model.plan;
    let largest = largest_angle(model, turns, q_dot);
    let has_it = |step: &PlanStep| {
        let unknowns = match step.kind {
            StepKind::Newton(unknowns) => unknowns,
            _ => step.coordinates.len(),
        };
        step.coordinates.iter().take(unknowns).any(|&(k, _)| turning(model, turns, q_dot, k) >= 0.1 * largest)
    };
    let found = plan.orientations.iter().position(|group| plan.steps.get(group.step).is_some_and(has_it));
    found.map(|oriented| plan.modes.len() + oriented)
}

/// Multiplies the rates of inputs; their accelerations become 0.
fn scale_rates(inputs: &mut [Signal], factor: f64) {
    inputs.iter_mut().for_each(|u| *u = Signal::new(u.value, factor * u.rate, 0.0));
}

/// Subtracts the contribution of time itself from q̇ and q̈: `still` are the rates with inputs at rest, and `back` is
/// q̈ with inputs that move backwards.
fn without_time([q_dot, q_ddot]: [&mut [f64]; 2], still: [&[f64]; 2], back: &[f64]) {
    q_dot.iter_mut().zip(still[0]).for_each(|(v, still)| *v -= still);
    for (a, (still, back)) in q_ddot.iter_mut().zip(still[1].iter().zip(back)) {
        *a = 0.5 * (*a + back) - still;
    }
}

fn index_of_least(distances: &[f64]) -> usize {
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    distances.iter().position(|w| *w <= least).unwrap_or(0)
}

/// The longest step in which no body turns by more than `most`.
pub(super) fn natural_step([q_dot, q_ddot]: [&[f64]; 2], weights: &[f64], most: f64) -> f64 {
    let largest =
        |rates: &[f64]| rates.iter().zip(weights).map(|(rate, weight)| (rate * weight).abs()).fold(0.0, f64::max);
    let by_velocity = most / largest(q_dot);
    let by_acceleration = Scalar::sqrt(2.0 * most / largest(q_ddot));
    by_velocity.min(by_acceleration)
}

#[cfg(test)]
mod tests;

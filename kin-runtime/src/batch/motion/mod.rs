//! The motion of eight sets of parameters from instant to instant.
//!
//! Eight sets take the usual step of the follower together: predict, solve, and compare the result with the prediction.
//! A set for which this step is not accepted repeats it with the scalar follower, so that every set moves as it would
//! alone.

mod rows;

use super::block_solution::{BlockSolution, Limits, Question, copy_lane};
use super::checks::least_length;
use super::end::{End, Outcome};
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Plan};
use crate::planned::branch::{FAR_FROM_LIMITS, OUT_OF_REACH, certainty_of, resolves};
use crate::planned::follower::{Control, NEGLIGIBLE_CORRECTION, PlanFollower, has_scalars, rows_turn_alone};
use crate::planned::inputs::write_lane_of_inputs;
use crate::planned::lists::{BranchValues, Distances, Margins, Modes};
use crate::planned::mode_changes::DIPPING_VALUE;
use crate::planned::predict::{parabola, turned, weights};
use crate::planned::steep_rows::may_be_steep;
use crate::planned::{Limit, PlanError, Step};
use crate::scalar::Scalar;
use crate::scalar::compare::{Compare, least_or_nan, write_lane};
use crate::scalar::lanes::{Lanes, Octet};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Eight sets that move together.
pub(super) struct BlockMotion<M: Mechanism> {
    pub(super) parameters: M::Parameters<Octet>,
    pub(super) modes: Modes<M, Octet>,
    /// Whether the modes are those of the start of the first instant, which an iteration must keep.
    pub(super) modes_of_start: bool,
    pub(super) predicted: M::Coordinates<Octet>,
    distances: Distances<M, Octet>,
    margins: Margins<M, Octet>,
    /// The state at the last instant and the trial state.
    poses: [BlockSolution<M::Coordinates<Octet>>; 2],
    good: usize,
    /// The margins at the last instant, and its inputs, which all sets share.
    margins_before: Margins<M, Octet>,
    inputs: M::Inputs<f64>,
    t: f64,
    /// The weight of each coordinate in every set: radians per unit.
    weights: M::Coordinates<Octet>,
    /// The angles by which the gradients of rows turn per unit of each coordinate, for both states; used if
    /// `rows_turn_alone`.
    turns: [M::Coordinates<Octet>; 2],
    rows_turn_alone: bool,
    /// Whether there are scalar coordinates, whose weights change with their values.
    has_scalars: bool,
}

/// For every set without a solution the margin to report, and the step of the plan that is the reason, if there is one.
type Refusals = [Option<(f64, Option<Limit>)>; Octet::COUNT];

impl<M: Mechanism> BlockMotion<M> {
    /// Buffers without a state.
    pub(super) fn nothing() -> Self {
        let nothing = Octet::default();
        Self {
            parameters: Array::filled(nothing),
            modes: Modes::filled(nothing),
            modes_of_start: false,
            predicted: Array::filled(nothing),
            distances: Distances::filled(nothing),
            margins: Margins::filled(nothing),
            poses: [BlockSolution::nothing(); 2],
            good: 0,
            margins_before: Margins::filled(nothing),
            inputs: Array::filled(Signal::constant(0.0)),
            t: 0.0,
            weights: Array::filled(nothing),
            turns: [Array::filled(nothing); 2],
            rows_turn_alone: rows_turn_alone::<M>(),
            has_scalars: has_scalars(M::model()),
        }
    }

    /// The state of the last instant.
    pub(super) fn poses(&self) -> &BlockSolution<M::Coordinates<Octet>> {
        &self.poses[self.good]
    }

    /// Solves the first instant, from the start in `predicted`.
    pub(super) fn begin(&mut self, mechanism: &M, at: &Instant<'_, Octet>) -> Option<Refusals> {
        let mut limits = self.solve(mechanism, at);
        let question = question(self.parameters.as_ref(), at, &self.modes, self.predicted.as_ref());
        let trial = &mut self.poses[1 - self.good];
        let rounded = trial.check(mechanism, &question, (&self.modes, self.modes_of_start), &self.margins);
        self.orient(mechanism, at);
        if self.poses[1 - self.good].good != [true; Octet::COUNT] {
            limits.get_or_insert([None; Octet::COUNT]);
        }
        self.measure_turns(mechanism, at);
        self.keep(at);
        weights(M::model(), self.poses[self.good].q.as_ref(), self.weights.as_mut());
        let poses = self.poses();
        let limits = limits?;
        let limit = |lane: usize| rounded[lane].or_else(|| limit_of::<M>(limits[lane]));
        let refused = |lane: usize| (!poses.is_good(lane)).then(|| (poses.margin.lane(lane), limit(lane)));
        Some(core::array::from_fn(refused))
    }

    /// The branch values of all groups at the trial state.
    fn found(&self, mechanism: &M, at: &Instant<'_, Octet>) -> BranchValues<M, Octet> {
        self.branch_values(mechanism, at, self.poses[1 - self.good].q.as_ref())
    }

    fn branch_values(&self, mechanism: &M, at: &Instant<'_, Octet>, q: &[Octet]) -> BranchValues<M, Octet> {
        let branch_values = BranchValues::at(mechanism, self.parameters.as_ref(), at, q);
        debug_assert!(branch_values.is_ok(), "the columns have been counted");
        branch_values.unwrap_or_else(|_| BranchValues::filled(Octet::default()))
    }

    /// Takes the orientations from the trial state.
    fn orient(&mut self, mechanism: &M, at: &Instant<'_, Octet>) {
        let plan = &M::model().plan;
        if !plan.orientations.is_empty() {
            let found = self.found(mechanism, at);
            let modes = self.modes.as_mut().iter_mut().zip(found.as_ref());
            modes.skip(plan.modes.len()).for_each(|(mode, found)| *mode = found.direction());
        }
    }

    /// Negative in lanes in which a group has another orientation than before.
    #[cold]
    #[inline(never)]
    fn kept_orientation(&self, mechanism: &M, at: &Instant<'_, Octet>) -> Octet {
        let plan = &M::model().plan;
        let found = self.found(mechanism, at);
        let modes = self.modes.as_ref().iter().zip(found.as_ref()).skip(plan.modes.len());
        modes.fold(Octet::from_f64(1.0), |least, (mode, found)| least.least(*mode * *found))
    }

    /// Advances to the next instant; returns the sets that have no solution there.
    #[inline(always)]
    pub(super) fn advance(&mut self, mechanism: &M, at: &Instant<'_, Octet>, t: f64) -> Option<Refusals> {
        let h = t - self.t;
        let BlockSolution { q, q_dot, q_ddot, .. } = &self.poses[self.good];
        let rates = [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()];
        let turn = parabola(self.predicted.as_mut(), rates, self.weights.as_ref(), h);
        let limits = self.solve(mechanism, at);
        let plan = &M::model().plan;
        let tried = &self.poses[1 - self.good];
        let away = turned(tried.q.as_ref(), self.predicted.as_ref(), self.weights.as_ref());
        let control = Control::USUAL;
        let allowed = Octet::from_f64(control.correction) * turn + Octet::from_f64(NEGLIGIBLE_CORRECTION);
        // The least of all numbers that must not be negative.
        let rotation = Octet::from_f64(control.rotation) - turn;
        let mut least = rotation.least(allowed - away);
        if self.rows_turn_alone {
            least = least.least(self.certainty_of_rows(mechanism, at, h, &control));
        }
        if M::KNOWN_VALUES_CURVE || M::INPUTS_CURVE {
            least = least.least(self.certainty_within(mechanism, at, t, allowed));
        }
        if M::LENGTHS > 0 {
            // The follower reports a negative length.
            least = least.least(least_length(mechanism, self.parameters.as_ref(), at));
        }
        let nearer = tried.margin.least(self.poses[self.good].margin);
        let turn = if self.rows_turn_alone && !plan.iterates() { turn.greatest(self.turn_of_rows(h)) } else { turn };
        let reach = Octet::from_f64(OUT_OF_REACH) * turn;
        let beyond = nearer - reach * reach;
        if !is_positive(beyond) || plan.iterates() {
            let certain = self.certainty_of_prediction(mechanism, at, nearer.abs().sqrt(), turn);
            // If all limits are out of reach, the comparison with the prediction is not needed.
            least = least.least(certain.greatest(beyond));
        }
        if !plan.orientations.is_empty() {
            least = least.least(self.kept_orientation(mechanism, at));
        }
        // No group is so near to its limit that rates are inaccurate, and no number is NaN.
        let far = (nearer - Octet::from_f64(1.0)).is_within(1.0 - FAR_FROM_LIMITS);
        self.measure_turns(mechanism, at);
        if may_be_steep::<M>() {
            least = least_or_nan(least, self.certainty_of_slopes());
        }
        if limits.is_none() & far & is_positive(least) {
            self.keep(at);
            return None;
        }
        let refusals = self.alone(mechanism, at, least);
        self.measure_turns(mechanism, at);
        self.keep(at);
        refusals
    }

    /// Not negative in lanes in which the branch values at the prediction show that all groups have stayed on their
    /// branches.
    #[inline(never)]
    fn certainty_of_prediction(
        &mut self,
        mechanism: &M,
        at: &Instant<'_, Octet>,
        nearest: Octet,
        turn: Octet,
    ) -> Octet {
        self.margins.write_distances(&mut self.distances);
        let foretold = self.branch_values(mechanism, at, self.predicted.as_ref());
        let groups = foretold.as_ref().iter().zip(self.modes.as_ref()).zip(self.distances.as_ref());
        // If a group may have reached its limit and returned, the scalar follower checks the step.
        let start = resolves(nearest, turn).least(nearest - Octet::from_f64(DIPPING_VALUE));
        groups.fold(start, |least, ((w, mode), now)| least.least(certainty_of(*now, *mode * *w)))
    }

    #[inline(never)]
    fn solve(&mut self, mechanism: &M, at: &Instant<'_, Octet>) -> Option<Limits> {
        let question = question(self.parameters.as_ref(), at, &self.modes, self.predicted.as_ref());
        self.poses[1 - self.good].solve(mechanism, &question, &mut self.margins)
    }

    /// Computes the turns of the gradients of rows at the trial state, if they are used.
    #[inline(always)]
    fn measure_turns(&mut self, mechanism: &M, at: &Instant<'_, Octet>) {
        if self.rows_turn_alone {
            let trial = 1 - self.good;
            let (q, to) = (self.poses[trial].q.as_ref(), self.turns[trial].as_mut());
            let turns = mechanism.turns_with(self.parameters.as_ref(), at, q, to);
            debug_assert!(turns.is_ok(), "q and turns have n numbers");
        }
    }

    /// Accepts the trial state.
    #[inline(always)]
    fn keep(&mut self, at: &Instant<'_, Octet>) {
        self.margins_before = self.margins;
        self.good = 1 - self.good;
        self.t = at.t.lane(0);
        write_lane_of_inputs(self.inputs.as_mut(), at.inputs, 0);
        if self.has_scalars {
            weights(M::model(), self.poses[self.good].q.as_ref(), self.weights.as_mut());
        }
    }

    /// Repeats the step of the sets for which it was not accepted, one by one.
    #[cold]
    #[inline(never)]
    fn alone(&mut self, mechanism: &M, at: &Instant<'_, Octet>, least: Octet) -> Option<Refusals> {
        let mut refusals: Refusals = [None; Octet::COUNT];
        for (lane, refusal) in refusals.iter_mut().enumerate() {
            let margin = self.poses[1 - self.good].margin.lane(lane);
            let nearer = margin.min(self.poses[self.good].margin.lane(lane));
            let counts =
                self.poses[1 - self.good].is_good(lane) && nearer >= FAR_FROM_LIMITS && least.lane(lane) >= 0.0;
            if counts {
                continue;
            }
            if let Err(error) = self.one(mechanism, at, lane) {
                let limit = error.limit().copied();
                // If the instant itself has a solution, there is a limit before it.
                let margin = match error {
                    PlanError::NegativeLength { .. } => 0.0,
                    _ => limit.map_or(margin, |limit| limit.margin),
                };
                let margin = if margin > Plan::SMALLEST_MARGIN && limit.is_some() { 0.0 } else { margin };
                *refusal = Some((if margin.is_finite() { margin } else { 0.0 }, limit));
                self.poses[1 - self.good].refuse(lane);
            }
        }
        refusals.iter().any(Option::is_some).then_some(refusals)
    }

    /// Moves one set by the scalar follower.
    fn one(&mut self, mechanism: &M, at: &Instant<'_, Octet>, lane: usize) -> Result<(), PlanError> {
        let before = &self.poses[self.good];
        let mut parameters = M::Parameters::<f64>::filled(0.0);
        write_lane(parameters.as_mut(), self.parameters.as_ref(), lane);
        let mut margins = Margins::filled(0.0);
        write_lane(margins.as_mut(), self.margins_before.as_ref(), lane);
        let mut state = [M::Coordinates::<f64>::filled(0.0); 3];
        write_lane(state[0].as_mut(), before.q.as_ref(), lane);
        write_lane(state[1].as_mut(), before.q_dot.as_ref(), lane);
        write_lane(state[2].as_mut(), before.q_ddot.as_ref(), lane);
        let from = Instant { t: self.t, inputs: self.inputs.as_ref() };
        let modes = Modes::lane_of(&self.modes, lane);
        let mut follower = PlanFollower::<M>::resume(mechanism, parameters, modes, &from, state, margins);
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        write_lane_of_inputs(inputs.as_mut(), at.inputs, lane);
        let at = Instant { t: at.t.lane(lane), inputs: inputs.as_ref() };
        follower.update(mechanism, &at, &Control::USUAL)?;
        let found = follower.state();
        let tried = &mut self.poses[1 - self.good];
        set_lane(tried.q.as_mut(), found.q.as_ref(), lane);
        set_lane(tried.q_dot.as_mut(), found.q_dot.as_ref(), lane);
        set_lane(tried.q_ddot.as_mut(), found.q_ddot.as_ref(), lane);
        tried.accept(lane, found.margins.least());
        set_lane(self.margins.as_mut(), found.margins.as_ref(), lane);
        set_lane(self.modes.as_mut(), follower.modes().as_ref(), lane);
        Ok(())
    }

    /// Ends the sets that have no solution; their lanes then repeat the lane of a set that has one. False if no set has
    /// one.
    #[cold]
    #[inline(never)]
    pub(super) fn mask<S>(&mut self, instant: usize, refusals: &Refusals, out: &mut [Outcome<S>]) -> bool {
        // Lanes after the last set are padding: nothing is copied from them.
        let mut ended = [true; Octet::COUNT];
        let mut lane = 0;
        for (_, ends) in out {
            for end in ends {
                if let (None, Some((margin, limit))) = (&*end, refusals[lane]) {
                    *end = Some(End { instant, margin, limit });
                }
                ended[lane] = end.is_some();
                lane += 1;
            }
        }
        let Some(first) = ended.iter().position(|ended| !ended) else { return false };
        for lane in (0..Octet::COUNT).filter(|lane| ended[*lane]) {
            // Prefer a lane of the same group of four, since each group is shown to `visit` by itself.
            let group = lane - lane % Lanes::COUNT;
            let other = (group..group + Lanes::COUNT).find(|other| !ended[*other]).unwrap_or(first);
            self.repeat(other, lane);
        }
        true
    }

    /// Copies lane `from` to lane `to`.
    fn repeat(&mut self, from: usize, to: usize) {
        fn copy(numbers: &mut (impl AsRef<[Octet]> + AsMut<[Octet]> + Copy), from: usize, to: usize) {
            let source = *numbers;
            copy_lane(numbers.as_mut(), source.as_ref(), from, to);
        }
        copy(&mut self.parameters, from, to);
        copy(&mut self.modes, from, to);
        copy(&mut self.margins_before, from, to);
        copy(&mut self.weights, from, to);
        copy(&mut self.turns[self.good], from, to);
        let poses = &mut self.poses[self.good];
        let source = *poses;
        poses.copy_lane(&source, from, to);
        poses.accept(to, source.margin.lane(from));
    }
}

/// The problem of q, q̇ and q̈ of a block.
fn question<'b, M: Mechanism>(
    parameters: &'b [Octet],
    at: &'b Instant<'b, Octet>,
    modes: &'b Modes<M, Octet>,
    start: &'b [Octet],
) -> Question<'b> {
    Question { parameters, at, modes: modes.of_closures(), start, depth: Depth::Acceleration }
}

/// Sets one lane of every number.
fn set_lane(to: &mut [Octet], from: &[f64], lane: usize) {
    to.iter_mut().zip(from).for_each(|(to, x)| to.set(lane, *x));
}

/// True if the numbers of all lanes are finite and not negative.
#[inline(always)]
fn is_positive(x: Octet) -> bool {
    let half = Octet::from_f64(0.5);
    // The minimum of NaN and 1 may be 1, so NaN is detected by multiplication with 0.
    (x.least(Octet::from_f64(1.0)) - half).is_within(0.5) & (x * Octet::default()).is_within(0.0)
}

/// The limit that a margin reports: the step of the plan to which it belongs.
fn limit_of<M: Mechanism>(found: Option<(usize, f64)>) -> Option<Limit> {
    let (place, margin) = found?;
    Step::of_margin(M::model(), place).map(|step| Limit::new(step, margin))
}

#[cfg(test)]
mod tests;

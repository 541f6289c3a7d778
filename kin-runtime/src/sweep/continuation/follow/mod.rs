//! Step control: follows one branch of the motion from one instant to another.

mod watch;

use super::between::StepMethod;
use super::checked_plan::CheckedPlan;
use super::global_error::GlobalError;
use super::groups;
use super::integrate::integrate;
use super::nodes::{at_instant, basis_with, complete_basis, natural_step, rates};
use super::refusal::refusal;
use super::step::{Fault, Node, StepBuffers, StepStart, step};
use crate::analysis::poses::poses;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::{Refusal, SolveError};
use crate::events::EventWatch;
use crate::linear::Factorization;
use crate::planned::LimitKind;
use crate::planned::follower::StepsTaken;
use crate::planned::step_length::{next_parameter, shortest_step};
use crate::signal::Instant;
use crate::state::State;
use crate::trajectory::Fallback;
use crate::workspace::Subset;

/// Condition of Φ_q above which a configuration that the plan calls a limit is one of the mechanism, too.
const SINGULAR_CONDITION: f64 = 1e5;

/// A branch and the instant reached on it. Nodes and buffers are reused from step to step.
pub(crate) struct Continuation {
    /// The last instant reached. Nodes are boxed so that swapping them is cheap.
    node: Box<Node>,
    /// The parameter of that node on the current course, and the derivatives of q along the course.
    s: f64,
    q_dot: Vec<f64>,
    q_ddot: Vec<f64>,
    /// The last accepted internal step on the way to the next instant, and the step being tried.
    accepted: Box<Node>,
    next: Box<Node>,
    /// The solution plan, where one is used.
    plan: Option<CheckedPlan>,
    /// How full Newton finds the next node: by continuation of Φ, or by integration of the velocities.
    step: StepMethod,
    /// The errors of an integrated motion at the instant reached and at the last accepted internal step.
    errors: [GlobalError; 2],
    /// Length of the next internal step.
    proposed: f64,
    scratch: StepBuffers,
    /// The unilateral conditions, where there are any to watch.
    pub(crate) watch: Option<EventWatch>,
    /// Internal steps that the plan could not solve and that full Newton took.
    pub(crate) fallbacks: Vec<Fallback>,
}

/// What has been reached on the way to the next instant: a node, and the derivatives of q along the course there.
struct ReachedNode<'c> {
    node: &'c Node,
    rates: [&'c [f64]; 2],
    s: f64,
}

impl Continuation {
    /// Starts at a state of the current instant. `factor` is the factorisation of Φ_q, which was evaluated there last;
    /// without it the state was solved by the plan.
    pub(crate) fn new(
        equations: &mut Equations<'_>,
        state: State,
        factor: Option<Factorization>,
    ) -> Result<Self, SolveError> {
        let plan = CheckedPlan::new(equations);
        let mut node = Box::new(Node { s: state.t, state, basis: None });
        if let Some(factor) = factor {
            node.basis = Some(basis_with(equations, &node.state, factor)?);
        }
        let integrates = !equations.rows_where(|e, row| !e.holonomic(row)).is_empty();
        Ok(Self {
            s: node.s,
            q_dot: node.state.q_dot.clone(),
            q_ddot: node.state.q_ddot.clone(),
            accepted: node.clone(),
            next: node.clone(),
            plan,
            step: if integrates { integrate } else { step },
            proposed: f64::INFINITY,
            errors: Default::default(),
            scratch: StepBuffers::new(equations),
            watch: None,
            fallbacks: Vec::new(),
            node,
        })
    }

    /// The instant reached.
    pub(crate) const fn state(&self) -> &State {
        &self.node.state
    }

    /// Starts a course whose parameter is time from the instant reached, and resets the proposed step length.
    pub(crate) fn depart_in_time(&mut self) {
        let state = &self.node.state;
        self.s = state.t;
        self.q_dot.clone_from(&state.q_dot);
        self.q_ddot.clone_from(&state.q_ddot);
        self.proposed = f64::INFINITY;
    }

    /// Starts a course whose parameter is not time, at `s`, from the instant reached; computes the derivatives of q
    /// along that course.
    pub(crate) fn depart(&mut self, equations: &mut Equations<'_>, s: f64) -> Result<(), SolveError> {
        self.s = s;
        self.proposed = f64::INFINITY;
        let Self { node, q_dot, q_ddot, .. } = self;
        equations.by_time(|equations| complete_basis(equations, node))?;
        equations.move_to(s)?;
        equations.evaluate(Subset::VELOCITY, &node.state.q, None)?;
        let Some(basis) = &node.basis else { return Ok(()) };
        rates(equations, &node.state.q, &basis.factor, q_dot, q_ddot)
    }

    /// Goes to `at` by the plan alone; false where the plan has no solution. The caller has checked `at`, whose inputs
    /// may differ arbitrarily from the last ones.
    pub(crate) fn advance_by_plan(
        &mut self,
        equations: &mut Equations<'_>,
        at: &Instant<'_>,
    ) -> Result<bool, SolveError> {
        let Self { node, accepted, plan, .. } = self;
        let Some(plan) = plan else { return Ok(false) };
        equations.by_time(|equations| {
            if !plan.start_at(equations, &node.state) {
                return Ok(false);
            }
            equations.set_checked_instant(at);
            accepted.basis = None;
            if plan.solve(equations, &node.state.q, &mut accepted.state)? {
                if plan.has_curves && plan.steps != StepsTaken::One {
                    // The side of a roller is checked from step to step, so a move of several steps is refused.
                    plan.is_placed = false;
                    return Ok(false);
                }
                accepted.s = at.t;
                core::mem::swap(node, accepted);
                return Ok(true);
            }
            Ok(false)
        })
    }

    /// Goes to the place `target` of the course in internal steps, or past the first event if the sweep is to stop
    /// there; by full Newton alone unless `by_plan`. After an error the instant reached is unchanged.
    pub(crate) fn advance(
        &mut self,
        equations: &mut Equations<'_>,
        target: f64,
        by_plan: bool,
    ) -> Result<(), SolveError> {
        if self.take_steps(equations, target, by_plan)? {
            if self.accepted.basis.is_some() {
                poses(equations, &mut self.accepted.state)?;
            }
            core::mem::swap(&mut self.node, &mut self.accepted);
            self.s = self.node.s;
            self.keep_errors();
            self.q_dot.clone_from(&self.node.state.q_dot);
            self.q_ddot.clone_from(&self.node.state.q_ddot);
        } else {
            self.node.state.iterations = 0;
        }
        Ok(())
    }

    /// The errors at the last internal step become those at the instant reached; only integrated motions have any.
    fn keep_errors(&mut self) {
        if self.scratch.local_error.is_some() {
            self.errors.swap(0, 1);
        }
    }

    /// As [`advance`](Self::advance), by full Newton to the end of a course whose parameter is not time. Writes the
    /// rates in time of the instant `at`.
    pub(crate) fn arrive(
        &mut self,
        equations: &mut Equations<'_>,
        target: f64,
        at: &Instant<'_>,
    ) -> Result<(), SolveError> {
        if !self.take_steps(equations, target, false)? {
            return self.stay(equations, at);
        }
        let Node { state, basis, .. } = &mut *self.accepted;
        if let Some(basis) = basis {
            at_instant(equations, at, state, &basis.factor)?;
        }
        poses(equations, state)?;
        core::mem::swap(&mut self.node, &mut self.accepted);
        self.keep_errors();
        Ok(())
    }

    /// Computes the rates of the instant `at` at the configuration reached, for a change of neither time nor input
    /// values.
    pub(crate) fn stay(&mut self, equations: &mut Equations<'_>, at: &Instant<'_>) -> Result<(), SolveError> {
        equations.by_time(|equations| complete_basis(equations, &mut self.node))?;
        let spare = &mut self.accepted.state;
        spare.clone_from(&self.node.state);
        spare.iterations = 0;
        if let Some(basis) = &self.node.basis {
            at_instant(equations, at, spare, &basis.factor)?;
        }
        poses(equations, spare)?;
        core::mem::swap(&mut self.node.state, spare);
        Ok(())
    }

    /// Takes internal steps to `target` and leaves the last of them in `accepted`; false when no step was needed. While
    /// `moved` is false, `accepted` has no meaning and steps start from `node`.
    fn take_steps(&mut self, equations: &mut Equations<'_>, target: f64, by_plan: bool) -> Result<bool, SolveError> {
        let options = equations.options;
        let mut iterations = 0;
        let mut smallest = None;
        let mut moved = false;
        let has_curves = self.plan.as_ref().is_some_and(|plan| plan.has_curves);
        let needs_every_step = self.watch.is_some() || equations.observed.is_there() || has_curves;
        let mut by_plan = by_plan && self.plan.is_some();
        // The longest step that the plan has taken at once where conditions are watched.
        let mut at_once = f64::INFINITY;
        // The end of the step refused last. What made it too long lies before, so steps do not grow until then.
        let mut refused = self.s;
        let direction = (target - self.s).signum();
        let has_passed = |s: f64, refused: f64| (s - refused) * direction >= 0.0;
        // The last round only finds that the target was reached.
        for _ in 0..=options.max_steps {
            let ReachedNode { s: from, .. } = self.reached(moved);
            if from == target {
                if self.accepted.basis.is_some() {
                    self.accepted.state.iterations = iterations;
                }
                return Ok(moved);
            }
            let aim = if by_plan { target } else { self.limit_between(equations, from, target).unwrap_or(target) };
            // The plan's follower divides a step itself where that is necessary, so one call leads to the target.
            let length = match by_plan {
                true if !needs_every_step => f64::INFINITY,
                true => self.longest_step(equations, moved).min(at_once),
                false => self.longest_step(equations, moved).min(self.proposed),
            };
            let smallest = *smallest.get_or_insert_with(|| shortest_step(options.min_step, length, [from, target]));
            let (mut s, share) = next_parameter([from, aim], length);
            if by_plan {
                let reached = self.step_by_plan(equations, moved, [s, target])?;
                by_plan = reached.is_some();
                let Some(reached) = reached else { continue }; // Full Newton takes the next round.
                s = reached;
                if let Some(plan) = self.plan.as_mut().filter(|plan| plan.steps == StepsTaken::ManyForHiddenMotion)
                    && self.watch.is_some()
                    && (s - from).abs() > smallest
                {
                    // The conditions must not miss the motion that the step hides.
                    plan.is_placed = false;
                    (at_once, refused) = (0.5 * (s - from).abs(), s);
                    continue;
                }
                if has_passed(s, refused) {
                    at_once *= 2.0;
                }
                self.watch_step(equations, moved, from)?;
            } else {
                let limit = self.plan.as_ref().and_then(CheckedPlan::limit);
                let jumps = self.plan.as_ref().is_some_and(CheckedPlan::found_a_jump);
                let Self { node, accepted, next, q_dot, q_ddot, scratch, errors, .. } = self;
                complete_basis(equations, if moved { &mut *accepted } else { &mut *node })?;
                let last_instant = &node.state;
                let node = if moved { &*accepted } else { &*node };
                let Some(basis) = &node.basis else { continue };
                let rates = if moved { [&node.state.q_dot, &node.state.q_ddot] } else { [&*q_dot, &*q_ddot] };
                let start = StepStart { node, basis, s: from, q_dot: rates[0], q_ddot: rates[1] };
                let is_pole = limit.and_then(|limit| limit.kind()) == Some(LimitKind::Pole);
                if s == from || is_pole && !equations.model.plan.has_redundant_rows() {
                    // The step is shorter than the spacing of floating-point numbers, or the coordinates grow without
                    // bound, so that no step is short enough.
                    let fault = Fault::Coarse(0.5);
                    return Err(refusal(equations, (last_instant, &start), [target; 2], fault, (limit, jumps)));
                }
                // The iteration must also converge fully at a limit that the plan has found: two solutions may meet there.
                let stepped = (self.step)(equations, scratch, start, next, s, s == aim);
                if stepped.is_ok()
                    && let Some(local) = &scratch.local_error
                {
                    match errors[usize::from(moved)].after(equations, start, next, local) {
                        Ok(after) => errors[1] = after,
                        Err(fault) => {
                            return Err(refusal(equations, (last_instant, &start), [s, target], fault, (limit, jumps)));
                        }
                    }
                }
                match stepped {
                    Ok(_)
                        if s == aim && s != target && next.state.condition.is_some_and(|c| c > SINGULAR_CONDITION) =>
                    {
                        let fault = Fault::Coarse(0.5);
                        return Err(refusal(equations, (last_instant, &start), [s, target], fault, (limit, jumps)));
                    }
                    Ok(growth) => {
                        iterations += self.next.state.iterations;
                        if let Some(plan) = &mut self.plan {
                            plan.is_placed = false;
                            self.fallbacks.push(Fallback { t: self.next.state.t, limit });
                        }
                        self.watch_step(equations, moved, from)?;
                        let walked = (s - from).abs();
                        let growth = if has_passed(s, refused) { growth } else { growth.min(1.0) };
                        // A step cut short by the target is no reason to reduce the longer step proposed before.
                        self.proposed = if share <= 2.0 { self.proposed.max(growth * walked) } else { growth * walked };
                    }
                    Err(fault) => {
                        let factor = if let Fault::Coarse(factor) = fault { factor } else { 0.5 };
                        let shorter = factor * (s - from).abs();
                        if shorter < smallest {
                            return Err(refusal(equations, (last_instant, &start), [s, target], fault, (limit, jumps)));
                        }
                        (self.proposed, refused) = (shorter, s);
                        continue;
                    }
                }
            }
            core::mem::swap(&mut self.accepted, &mut self.next);
            moved = true;
            if self.stopped(equations).is_some() {
                return Ok(moved);
            }
            if s != target {
                equations.observed.pass(self.accepted.state.t)?;
            }
        }
        let last = if moved { &self.accepted } else { &self.node };
        Err(SolveError::StepRefused {
            t: last.state.t,
            t_refused: equations.time_at(target),
            row_name: "",
            joint: "",
            reason: Refusal::TooManySteps,
            limit: None,
        })
    }

    /// What has been reached on the way to the next instant: after the last internal step, if there was one.
    fn reached(&self, moved: bool) -> ReachedNode<'_> {
        let Self { node, accepted, q_dot, q_ddot, s, .. } = self;
        match moved {
            true => {
                ReachedNode { node: accepted, rates: [&accepted.state.q_dot, &accepted.state.q_ddot], s: accepted.s }
            }
            false => ReachedNode { node, rates: [q_dot, q_ddot], s: *s },
        }
    }

    /// The time of the limit at which the plan had no further solution, if it lies between two times. Full Newton
    /// stops there, as in one step it might pass two limits and arrive on another branch.
    fn limit_between(&self, equations: &Equations<'_>, from: f64, target: f64) -> Option<f64> {
        let in_time = [from, target].map(|s| equations.time_at(s)) == [from, target];
        let at = self.plan.as_ref().filter(|_| in_time)?.limit()?.at()?;
        (from.min(target) < at && at < from.max(target)).then_some(at)
    }

    /// The longest step from there in which no body turns by more than the options allow.
    fn longest_step(&self, equations: &mut Equations<'_>, moved: bool) -> f64 {
        let ReachedNode { node, rates, .. } = self.reached(moved);
        if !equations.scale.is_known {
            equations.scale = Scale::around(equations, &node.state.q);
        }
        // With redundant rows a motion may pass limits of the rows that the plan uses, so their distance does not
        // shorten the step.
        let basis = node.basis.as_ref();
        let near = basis.filter(|_| !equations.model.plan.has_redundant_rows());
        let turns = basis.map_or(&[][..], |basis| &basis.turns);
        natural_step(
            equations,
            [&node.state.q, rates[0], rates[1]],
            near.map_or(1.0, |basis| groups::nearest(&basis.groups)),
            turns,
        )
    }

    /// One step by the plan, as [`CheckedPlan::step`].
    fn step_by_plan(
        &mut self,
        equations: &mut Equations<'_>,
        moved: bool,
        to: [f64; 2],
    ) -> Result<Option<f64>, SolveError> {
        let Self { node, accepted, next, plan, .. } = self;
        let Some(plan) = plan else { return Ok(None) };
        let from = if moved { &accepted.state } else { &node.state };
        plan.step(equations, from, next, to)
    }
}

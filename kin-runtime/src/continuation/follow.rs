//! Step control: from one instant to another on the same branch.

use super::branch::Orientation;
use super::integrate::integrate;
use super::refusal::refusal;
use super::step::{Fault, Node, Scratch, Start, step};
use crate::acceleration::acceleration;
use crate::by_plan;
use crate::equations::Equations;
use crate::error::{Refusal, SolveError};
use crate::events::Watch;
use crate::linear::Factorization;
use crate::motion::poses;
use crate::state::State;
use crate::trajectory::Fallback;
use crate::velocity;
use crate::workspace::{Instant, Subset};

/// One step to a place, which writes the node there and gives by how much the next step may be longer. The flag says that
/// the place was asked for.
type Step = fn(&mut Equations<'_>, &mut Scratch, Start<'_>, &mut Node, f64, bool) -> Result<f64, Fault>;

/// A branch and the instant reached on it. All nodes and buffers are used again for the next one.
pub(crate) struct Follower {
    /// The instant reached.
    node: Node,
    /// Its place on the course ahead, and its rates along it.
    s: f64,
    q_dot: Vec<f64>,
    q_ddot: Vec<f64>,
    /// The last internal step towards the next instant, and the one being tried.
    here: Node,
    next: Node,
    /// How the next node is found: continuation of Φ, or integration of the velocities.
    step: Step,
    /// Length of the next internal step.
    proposed: f64,
    scratch: Scratch,
    /// The unilateral conditions, where they are watched.
    pub(crate) watch: Option<Watch>,
    /// Internal steps that the plan had no answer for.
    pub(crate) fallbacks: Vec<Fallback>,
}

impl Follower {
    /// Starts at a state of the current instant, where Φ_q was evaluated last and has the factorisation `factor`.
    pub(crate) fn new(equations: &Equations<'_>, state: State, factor: Factorization) -> Result<Self, SolveError> {
        let (t, rank) = (state.t, factor.rank);
        let singular = || SolveError::Singular {
            t,
            rank: rank.saturating_sub(1),
            expected_rank: rank,
            rows: Vec::new(),
            condition: f64::INFINITY,
            limit: None,
        };
        let orientation = Orientation::here(equations, &factor).ok_or_else(singular)?;
        let scratch = Scratch::new(equations);
        let mut modes = Vec::new();
        if scratch.answer.is_some() {
            by_plan::modes(equations, &state.q, &mut modes);
        }
        let node = Node { s: t, state, orientation, factor, modes, fallback: None };
        let step = if equations.rows_where(|e, row| !e.holonomic(row)).is_empty() { step } else { integrate };
        Ok(Self {
            s: t,
            q_dot: node.state.q_dot.clone(),
            q_ddot: node.state.q_ddot.clone(),
            here: node.clone(),
            next: node.clone(),
            step,
            proposed: f64::INFINITY,
            scratch,
            watch: None,
            fallbacks: Vec::new(),
            node,
        })
    }

    /// The first event, when the sweep is to end there and it was passed.
    pub(crate) fn stopped(&self, equations: &Equations<'_>) -> Option<&State> {
        let watch = self.watch.as_ref().filter(|_| equations.options.stop_at_events)?;
        watch.events().first().map(|event| &event.state)
    }

    /// The instant reached.
    pub(crate) const fn state(&self) -> &State {
        &self.node.state
    }

    /// Puts the instant reached at the start of a course in time, and forgets the length of earlier steps.
    pub(crate) fn depart_in_time(&mut self) {
        let state = &self.node.state;
        self.s = state.t;
        self.q_dot.clone_from(&state.q_dot);
        self.q_ddot.clone_from(&state.q_ddot);
        self.proposed = f64::INFINITY;
    }

    /// Puts the instant reached at the start `s` of a course along which rates are others than in time.
    pub(crate) fn depart(&mut self, equations: &mut Equations<'_>, s: f64) -> Result<(), SolveError> {
        self.s = s;
        self.proposed = f64::INFINITY;
        equations.move_to(s)?;
        let Node { state, factor, .. } = &self.node;
        equations.evaluate(Subset::VELOCITY, &state.q, None)?;
        rates(equations, &state.q, factor, &mut self.q_dot, &mut self.q_ddot)
    }

    /// Goes to the place `target` of the course, in internal steps, or past the first event when the sweep is to end
    /// there. After an error the instant reached stays what it was.
    pub(crate) fn advance(&mut self, equations: &mut Equations<'_>, target: f64) -> Result<(), SolveError> {
        if self.follow(equations, target)? {
            poses(equations, &mut self.here.state)?;
            core::mem::swap(&mut self.node, &mut self.here);
            self.s = self.node.s;
            self.q_dot.clone_from(&self.node.state.q_dot);
            self.q_ddot.clone_from(&self.node.state.q_ddot);
        } else {
            self.node.state.iterations = 0;
        }
        Ok(())
    }

    /// As [`advance`](Self::advance) to the end of a course along which rates are others than in time; those of the
    /// instant `at` there are written.
    pub(crate) fn arrive(
        &mut self,
        equations: &mut Equations<'_>,
        target: f64,
        at: &Instant<'_>,
    ) -> Result<(), SolveError> {
        if !self.follow(equations, target)? {
            return self.stay(equations, at);
        }
        let Node { state, factor, .. } = &mut self.here;
        at_instant(equations, at, state, factor)?;
        poses(equations, state)?;
        core::mem::swap(&mut self.node, &mut self.here);
        Ok(())
    }

    /// New rates at the place reached, where neither time nor a value has changed.
    pub(crate) fn stay(&mut self, equations: &mut Equations<'_>, at: &Instant<'_>) -> Result<(), SolveError> {
        let spare = &mut self.here.state;
        spare.clone_from(&self.node.state);
        spare.iterations = 0;
        at_instant(equations, at, spare, &self.node.factor)?;
        poses(equations, spare)?;
        core::mem::swap(&mut self.node.state, spare);
        Ok(())
    }

    /// Internal steps to `target`, the last of which is left in `here`; false when none was needed.
    fn follow(&mut self, equations: &mut Equations<'_>, target: f64) -> Result<bool, SolveError> {
        let options = equations.options;
        let mut iterations = 0;
        let mut smallest = None;
        let mut moved = false;
        for _ in 0..options.max_steps {
            let start = if moved {
                Start::at(&self.here)
            } else {
                Start { node: &self.node, s: self.s, q_dot: &self.q_dot, q_ddot: &self.q_ddot }
            };
            let from = start.s;
            let remaining = target - from;
            if remaining == 0.0 {
                self.here.state.iterations = iterations;
                return Ok(moved);
            }
            let natural = natural_step(equations, &start);
            let smallest = *smallest.get_or_insert_with(|| {
                let shortest = options.min_step * natural.min(remaining.abs());
                shortest.max(4.0 * f64::EPSILON * from.abs().max(target.abs()))
            });
            let length = natural.min(self.proposed);
            // The last two steps are of equal length, so that none is a sliver.
            let share = remaining.abs() / length;
            let s = match share {
                share if share <= 1.0 => target,
                share if share < 2.0 => from + 0.5 * remaining,
                _ => from + length.copysign(remaining),
            };
            if s == from {
                // Between neighbouring numbers there is no step to take.
                return Err(refusal(equations, &start, target, Fault::Coarse(0.5)));
            }
            match (self.step)(equations, &mut self.scratch, start, &mut self.next, s, s == target) {
                Ok(growth) => {
                    iterations += self.next.state.iterations;
                    self.fallbacks.extend(self.next.fallback.take());
                    if let Some(watch) = &mut self.watch {
                        let (state, scratch, step) = (&self.next.state, &mut self.scratch, self.step);
                        let mut between =
                            |equations: &mut Equations<'_>, s| state_between(equations, step, scratch, start, s);
                        watch.pass(equations, state, &mut between)?;
                        if options.stop_at_events {
                            watch.keep_first();
                        }
                    }
                    core::mem::swap(&mut self.here, &mut self.next);
                    moved = true;
                    if self.stopped(equations).is_some() {
                        return Ok(moved);
                    }
                    if s != target {
                        equations.observed.pass(self.here.state.t)?;
                    }
                    let walked = (s - from).abs();
                    // A step cut short by the target says nothing against the longer one proposed before.
                    self.proposed = if share <= 2.0 { self.proposed.max(growth * walked) } else { growth * walked };
                }
                Err(fault) => {
                    let factor = if let Fault::Coarse(factor) = fault { factor } else { 0.5 };
                    let shorter = factor * (s - from).abs();
                    if shorter < smallest {
                        return Err(refusal(equations, &start, s, fault));
                    }
                    self.proposed = shorter;
                }
            }
        }
        let last = if moved { &self.here } else { &self.node };
        Err(SolveError::StepRefused {
            t: last.state.t,
            t_refused: equations.time_at(target),
            row_name: "",
            joint: "",
            reason: Refusal::TooManySteps,
            limit: None,
        })
    }
}

impl<'n> Start<'n> {
    /// A node on the course.
    fn at(node: &'n Node) -> Self {
        Self { node, s: node.s, q_dot: &node.state.q_dot, q_ddot: &node.state.q_ddot }
    }
}

/// The state at `s` on the way from a node to one that was reached in one step; it is closed to the end.
fn state_between(
    equations: &mut Equations<'_>,
    step: Step,
    scratch: &mut Scratch,
    from: Start<'_>,
    s: f64,
) -> Option<State> {
    let mut reached = from.node.clone();
    if step(equations, scratch, from, &mut reached, s, true).is_err() {
        let mut middle = from.node.clone();
        step(equations, scratch, from, &mut middle, from.s + 0.5 * (s - from.s), false).ok()?;
        step(equations, scratch, Start::at(&middle), &mut reached, s, true).ok()?;
    }
    Some(reached.state)
}

/// The state's rates at an instant, its q being that of the instant.
fn at_instant(
    equations: &mut Equations<'_>,
    at: &Instant<'_>,
    state: &mut State,
    factor: &Factorization,
) -> Result<(), SolveError> {
    equations.set_instant(at)?;
    equations.by_time(|equations| {
        equations.evaluate(Subset::VELOCITY, &state.q, None)?;
        rates(equations, &state.q, factor, &mut state.q_dot, &mut state.q_ddot)
    })?;
    state.t = at.t;
    state.inputs.clone_from(&equations.inputs);
    Ok(())
}

/// q̇ and q̈ at q, where Φ_q and Φ_t were evaluated last and Φ_q has the factorisation `factor`.
fn rates(
    equations: &mut Equations<'_>,
    q: &[f64],
    factor: &Factorization,
    q_dot: &mut Vec<f64>,
    q_ddot: &mut Vec<f64>,
) -> Result<(), SolveError> {
    let solution = velocity::solve(equations, factor)?;
    q_dot.clear();
    q_dot.extend_from_slice(solution.as_slice());
    *q_ddot = acceleration(equations, q, q_dot, factor)?;
    Ok(())
}

/// The step within which nothing turns by more than is allowed.
pub(super) fn natural_step(equations: &Equations<'_>, start: &Start<'_>) -> f64 {
    let scale = &equations.scale;
    let most = equations.options.max_rotation_per_step;
    let by_velocity = most / scale.turn(start.q_dot);
    let by_acceleration = (2.0 * most / scale.turn(start.q_ddot)).sqrt();
    by_velocity.min(by_acceleration)
}

//! Step control: from one instant to the next on the same branch.

use super::integrate::integrate;
use super::step::{Fault, Node, step};
use crate::equations::Equations;
use crate::error::{Refusal, SolveError};
use crate::events::Watch;
use crate::linear::{Factorization, null_space};
use crate::singular::dependent_rows;
use crate::state::State;
use crate::workspace::Subset;

/// Pivots below this, at the last configuration before a refused step, say that the motion ends in a singular one.
const NEARLY_SINGULAR: f64 = 1e-4;

/// One step from a node to a time: the node there, and by how much the next step may be longer. The flag says that the
/// time was asked for.
type Step = fn(&mut Equations<'_>, &Node, f64, bool) -> Result<(Node, f64), Fault>;

/// A branch and the place reached on it.
pub(crate) struct Follower<'e, 'a> {
    pub(crate) equations: &'e mut Equations<'a>,
    node: Node,
    /// How the next node is found: continuation of Φ, or integration of the velocities.
    step: Step,
    /// Length of the next internal step.
    proposed: f64,
    /// The unilateral conditions, where there are any.
    pub(crate) watch: Option<Watch>,
}

impl<'e, 'a> Follower<'e, 'a> {
    /// Starts at `node`.
    pub(crate) fn new(equations: &'e mut Equations<'a>, node: Node, watch: Option<Watch>) -> Self {
        let step = if equations.rows_where(|e, row| !e.holonomic(row)).is_empty() { step } else { integrate };
        Self { equations, node, step, proposed: f64::INFINITY, watch }
    }

    /// Goes to `target`, in internal steps, and gives the state there, or that at the first event when it is to stop there.
    pub(crate) fn advance(&mut self, target: f64) -> Result<State, SolveError> {
        let options = self.equations.options;
        let mut iterations = 0;
        let mut smallest = None;
        for _ in 0..options.max_steps {
            let from = self.node.state.t;
            let remaining = target - from;
            if remaining == 0.0 {
                self.node.state.iterations = iterations;
                return Ok(self.node.state.clone());
            }
            let natural = self.natural_step();
            let smallest = *smallest.get_or_insert_with(|| {
                let shortest = options.min_step * natural.min(remaining.abs());
                shortest.max(4.0 * f64::EPSILON * from.abs().max(target.abs()))
            });
            let length = natural.min(self.proposed);
            // The last two steps are of equal length, so that none is a sliver.
            let share = remaining.abs() / length;
            let t = match share {
                share if share <= 1.0 => target,
                share if share < 2.0 => from + 0.5 * remaining,
                _ => from + length.copysign(remaining),
            };
            match (self.step)(self.equations, &self.node, t, t == target) {
                Ok((node, growth)) => {
                    iterations += node.state.iterations;
                    let before = std::mem::replace(&mut self.node, node);
                    if let Some(state) = self.pass(&before)? {
                        return Ok(state);
                    }
                    let walked = (t - from).abs();
                    // A step cut short by the target says nothing against the longer one proposed before.
                    self.proposed = if share <= 2.0 { self.proposed.max(growth * walked) } else { growth * walked };
                }
                Err(fault) => {
                    let factor = if let Fault::Coarse(factor) = fault { factor } else { 0.5 };
                    let shorter = factor * (t - from).abs();
                    if shorter < smallest {
                        return Err(self.refusal(t, fault));
                    }
                    self.proposed = shorter;
                }
            }
        }
        Err(SolveError::StepRefused {
            t: self.node.state.t,
            t_refused: target,
            row_name: "",
            joint: "",
            reason: Refusal::TooManySteps,
        })
    }

    /// Looks for events since `before`; the state at the first one, when the sweep is to end there.
    fn pass(&mut self, before: &Node) -> Result<Option<State>, SolveError> {
        let Some(watch) = &mut self.watch else { return Ok(None) };
        let step = self.step;
        watch.pass(self.equations, &self.node.state, &mut |equations, t| state_between(equations, step, before, t))?;
        if !self.equations.options.stop_at_events {
            return Ok(None);
        }
        watch.keep_first();
        Ok(watch.events().first().map(|event| event.state.clone()))
    }

    /// True when an event ended the sweep.
    pub(crate) fn stopped(&self) -> bool {
        self.equations.options.stop_at_events && self.watch.as_ref().is_some_and(|watch| !watch.events().is_empty())
    }

    /// The step within which nothing turns by more than is allowed.
    fn natural_step(&self) -> f64 {
        let state = &self.node.state;
        let scale = &self.equations.scale;
        let most = self.equations.options.max_rotation_per_step;
        let by_velocity = most / scale.turn(&state.q_dot);
        let by_acceleration = (2.0 * most / scale.turn(&state.q_ddot)).sqrt();
        by_velocity.min(by_acceleration)
    }

    /// Why there is no way on from here.
    fn refusal(&mut self, t_refused: f64, fault: Fault) -> SolveError {
        let state = &self.node.state;
        let t = state.t;
        let (row, reason) = match fault {
            Fault::Error(error) => return error,
            Fault::Open(row) => (Some(row), Refusal::NotAssembled),
            Fault::Jump(row) => (Some(row), Refusal::WouldJump),
            Fault::Coarse(_) => (None, Refusal::StepTooSmall),
        };
        let evaluated = self.equations.set_time(t).and_then(|()| {
            let q = &state.q;
            self.equations.evaluate(Subset::VELOCITY, q, None)
        });
        if let Err(error) = evaluated {
            return error;
        }
        let all: Vec<usize> = (0..self.equations.rows()).collect();
        let columns = &self.equations.scale.columns;
        let factor = Factorization::revealing(&self.equations.scaled_rows(&all), columns, NEARLY_SINGULAR);
        if factor.rank < self.node.rank {
            let left = null_space(&self.equations.scaled(&all).transpose(), NEARLY_SINGULAR);
            return SolveError::Singular {
                t,
                rank: factor.rank,
                expected_rank: self.node.rank,
                rows: dependent_rows(self.equations, &left),
                condition: factor.full_condition,
            };
        }
        let names = |row| (self.equations.row_name(row), self.equations.joint_name(row));
        let (row_name, joint) = row.map_or(("", ""), names);
        SolveError::StepRefused { t, t_refused, row_name, joint, reason }
    }
}

/// The state at `t` on the way from a node to one that was reached in one step; it is closed to the end.
fn state_between(equations: &mut Equations<'_>, step: Step, from: &Node, t: f64) -> Option<State> {
    let directly = step(equations, from, t, true).ok();
    let reached = directly.or_else(|| {
        let (middle, _) = step(equations, from, from.state.t + 0.5 * (t - from.state.t), false).ok()?;
        step(equations, &middle, t, true).ok()
    });
    reached.map(|(node, _)| node.state)
}

//! Step control: from one instant to the next on the same branch.

use super::step::{Fault, Node, step};
use crate::equations::Equations;
use crate::error::{Refusal, SolveError};
use crate::linear::{Factorization, null_space};
use crate::singular::dependent_rows;
use crate::state::State;
use crate::workspace::Subset;

/// Pivots below this, at the last configuration before a refused step, say that the motion ends in a singular one.
const NEARLY_SINGULAR: f64 = 1e-4;

/// A branch and the place reached on it.
pub(crate) struct Follower<'e, 'a> {
    pub(crate) equations: &'e mut Equations<'a>,
    node: Node,
    /// Length of the next internal step.
    proposed: f64,
}

impl<'e, 'a> Follower<'e, 'a> {
    /// Starts at `node`.
    pub(crate) fn new(equations: &'e mut Equations<'a>, node: Node) -> Self {
        Self { equations, node, proposed: f64::INFINITY }
    }

    /// Goes to `target`, in internal steps, and gives the state there.
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
            match step(self.equations, &self.node, t, t == target) {
                Ok((node, effort)) => {
                    iterations += node.state.iterations;
                    self.node = node;
                    let growth = (0.3 / effort.max(1e-3)).cbrt().clamp(0.5, 4.0);
                    let walked = (t - from).abs();
                    // A step cut short by the target says nothing against the longer one proposed before.
                    self.proposed = if share <= 2.0 { self.proposed.max(growth * walked) } else { growth * walked };
                }
                Err(fault) => {
                    let halved = 0.5 * (t - from).abs();
                    if halved < smallest {
                        return Err(self.refusal(t, fault));
                    }
                    self.proposed = halved;
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
            Fault::Open(row) => (row, Refusal::NotAssembled),
            Fault::Jump(row) => (row, Refusal::WouldJump),
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
        let (row_name, joint) = (self.equations.row_name(row), self.equations.joint_name(row));
        SolveError::StepRefused { t, t_refused, row_name, joint, reason }
    }
}

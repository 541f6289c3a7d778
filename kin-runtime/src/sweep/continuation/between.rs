//! States between two nodes, at which unilateral conditions are evaluated.

use super::step::{Fault, Node, StepBuffers, StepStart};
use crate::equations::Equations;
use crate::state::State;

/// One step by full Newton to a given place: writes the node there and returns the factor by which the next step may be
/// longer. The flag is true if the node must be converged fully, because the caller requested this place, or because
/// the plan has a limit there.
pub(super) type StepMethod =
    fn(&mut Equations<'_>, &mut StepBuffers, StepStart<'_>, &mut Node, f64, bool) -> Result<f64, Fault>;

impl<'n> StepStart<'n> {
    /// The start of a step at a node with a basis, with its rates in time.
    fn at(node: &'n Node) -> Option<Self> {
        let State { q_dot, q_ddot, .. } = &node.state;
        Some(Self { node, basis: node.basis.as_ref()?, s: node.s, q_dot, q_ddot })
    }
}

/// The state at `s` between a node and the next one, which was reached in one step; it is fully converged. Where one
/// step fails, two half steps are tried.
pub(super) fn state_between(
    equations: &mut Equations<'_>,
    step: StepMethod,
    scratch: &mut StepBuffers,
    from: StepStart<'_>,
    s: f64,
) -> Option<State> {
    let mut reached = from.node.clone();
    if step(equations, scratch, from, &mut reached, s, true).is_err() {
        let mut middle = from.node.clone();
        step(equations, scratch, from, &mut middle, from.s + 0.5 * (s - from.s), false).ok()?;
        reached = middle.clone();
        step(equations, scratch, StepStart::at(&middle)?, &mut reached, s, true).ok()?;
    }
    Some(reached.state)
}

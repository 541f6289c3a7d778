//! States at equal distances along the solution curve.

use super::bordered::{ArcNode, Bordered};
use super::places::between;
use crate::analysis::acceleration::acceleration;
use crate::analysis::poses::poses;
use crate::analysis::rounding::settle_rates;
use crate::analysis::velocity::velocity;
use crate::arc::{ArcEnd, ArcPlace, SolutionArc};
use crate::equations::Equations;
use crate::error::SolveError;
use crate::state::State;
use crate::workspace::Subset;

/// Places nearer to one another than this along the arc are the same.
const SAME_PLACE: f64 = 1e-9;

/// `steps` + 1 states at equal distances, a single one if the curve is a point, and the special places and ends of the
/// curve.
pub(super) fn states(
    equations: &mut Equations<'_>,
    bordered: &Bordered,
    mut nodes: Vec<ArcNode>,
    mut places: Vec<ArcPlace>,
    ends: [ArcEnd; 2],
    steps: usize,
) -> Result<(Vec<State>, SolutionArc), SolveError> {
    // Lengths begin at the first place.
    let first = nodes.first().map_or(0.0, |node| node.s);
    nodes.iter_mut().for_each(|node| node.s -= first);
    places.iter_mut().for_each(|place| place.s -= first);
    let length = nodes.last().map_or(0.0, |node| node.s);
    let mut states = Vec::new();
    let count = if length > SAME_PLACE { steps } else { 0 };
    for k in 0..=count {
        let s = if k > 0 && k == count { length } else { length * k as f64 / count.max(1) as f64 };
        let next = nodes.partition_point(|node| node.s < s - SAME_PLACE).min(nodes.len() - 1);
        let node = match next.checked_sub(1) {
            Some(before) if nodes[next].s > s + SAME_PLACE => {
                let (a, b) = (&nodes[before], &nodes[next]);
                // Near a crossing of branches there may be no place in between, so the nearer neighbour is used.
                between(equations, bordered, a, b, s)
                    .unwrap_or_else(|| if s - a.s < b.s - s { a.clone() } else { b.clone() })
            }
            _ => nodes[next].clone(),
        };
        let state = state(equations, &node)?;
        equations.observed.finish(state.t, Some(&state))?;
        states.push(state);
    }
    Ok((states, SolutionArc { length, places, ends }))
}

/// The state at a place; rates are NaN where the driver does not determine them, and where rounding errors dominate them.
fn state(equations: &mut Equations<'_>, node: &ArcNode) -> Result<State, SolveError> {
    equations.move_to(node.t())?;
    let q = node.q().to_vec();
    equations.evaluate(Subset::POSITION, &q, None)?;
    let residual = equations.phi.iter().fold(0.0, |most: f64, phi| most.max(phi.abs()));
    let rates = velocity(equations, &q, None).and_then(|(mut q_dot, factor)| {
        let mut q_ddot = acceleration(equations, &q, &q_dot, &factor)?;
        let condition = factor.condition;
        settle_rates(equations, [&mut q.clone(), &mut q_dot, &mut q_ddot], &factor)?;
        Ok((q_dot, q_ddot, condition))
    });
    let still = || vec![0.0; q.len()];
    let (q_dot, q_ddot, condition) = match rates {
        Ok((q_dot, q_ddot, condition)) => (q_dot, q_ddot, Some(condition)),
        Err(_) => (still(), still(), None),
    };
    let mut state = State {
        model: equations.model,
        t: node.t(),
        inputs: equations.inputs.clone(),
        q,
        q_dot,
        q_ddot,
        bodies: Vec::new(),
        points: Vec::new(),
        residual,
        iterations: 1,
        condition,
        degrees_of_freedom_left: 0,
    };
    poses(equations, &mut state)?;
    if condition.is_none() {
        state.forget_rates();
    }
    Ok(state)
}

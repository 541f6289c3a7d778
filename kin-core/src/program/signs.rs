//! Chooses which vectors and differences to compute with the opposite sign, so that few explicit negations are needed.
//!
//! During lowering every value carries a sign at no cost; a negation is emitted only if an output needs the opposite of
//! the computed value. A rotated body vector can be negated at no cost if its leading component is a literal or has a
//! literal factor (−l/2 costs no more than l/2), a difference by swapping its operands. For every vector and
//! difference, the outputs whose sign it determines are counted as votes for one of the two signs.

use crate::expr::{ExprId, Graph, IdMap, Node, Rotation};
use crate::hash::FastMap;

/// The chosen signs.
#[derive(Debug, Default)]
pub(super) struct ChosenSigns {
    /// Rotated vectors ρ that are computed as −ρ.
    pub(super) negated: FastMap<Rotation, ()>,
    /// Differences a − b that are computed as b − a.
    pub(super) swapped: IdMap<()>,
}

/// Chooses the signs for the given outputs.
pub(super) fn choose(graph: &Graph, outputs: impl Iterator<Item = ExprId>) -> ChosenSigns {
    let outputs: Vec<ExprId> = outputs.collect();
    let votes = Votes::count(graph, &outputs);
    let mut signs = ChosenSigns::default();
    for (rotation, vote) in votes.vectors {
        // Negating the leading component costs an operation unless it has a literal factor.
        let leading = if graph.is_zero(rotation.x) { rotation.y } else { rotation.x };
        let cost = i32::from(!is_free(graph, leading));
        if vote < -cost {
            signs.negated.insert(rotation, ());
        }
    }
    for (id, _) in votes.differences.iter().filter(|(_, vote)| **vote < 0) {
        signs.swapped.insert(id, ());
    }
    signs
}

/// True if the negative of `id` costs no more than `id`.
pub(super) fn is_free(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Number(_) | Node::Neg(_) => true,
        Node::Mul(a, _) => graph.literal(a).is_some(),
        _ => false,
    }
}

/// The sums of the votes on the signs of vectors and differences.
#[derive(Debug, Default)]
struct Votes {
    vectors: FastMap<Rotation, i32>,
    differences: IdMap<i32>,
}

impl Votes {
    /// Every output casts one vote for its own sign. The vote is passed to the operands that determine the sign: to
    /// both terms of a sum, to one factor of a product. Operands have smaller ids than their users, so one pass in
    /// descending order suffices.
    fn count(graph: &Graph, outputs: &[ExprId]) -> Self {
        let order = graph.reachable(outputs.iter().copied());
        let decides = deciding(graph, &order);
        let mut pending = vec![0_i32; graph.len()];
        outputs.iter().for_each(|output| pending[output.index()] = 1);
        let mut votes = Self::default();
        for &id in order.iter().rev() {
            let vote = pending[id.index()];
            let mut pass = |to: ExprId, vote: i32| {
                pending[to.index()] = pending[to.index()].saturating_add(vote);
            };
            match graph.node(id) {
                _ if vote == 0 => {}
                Node::Neg(a) => pass(a, vote.saturating_neg()),
                Node::RotX(rotation) | Node::RotY(rotation) => {
                    // The x component of a vector (0, y) is −y sin φ, whose sign is already the opposite.
                    let turned_round = matches!(graph.node(id), Node::RotX(_)) && graph.is_zero(rotation.x);
                    let total = votes.vectors.entry(rotation).or_default();
                    *total = total.saturating_add(if turned_round { vote.saturating_neg() } else { vote });
                }
                Node::Add(a, b) if decides[a.index()] && decides[b.index()] => {
                    pass(a, vote);
                    pass(b, vote);
                }
                Node::Sub(..) | Node::Cross(_) => {
                    votes.differences.insert(id, vote);
                }
                Node::Mul(a, b) => {
                    if let Some(factor) = [a, b].into_iter().find(|factor| decides[factor.index()]) {
                        pass(factor, vote);
                    }
                }
                // u·d changes its sign if both components of d do.
                Node::Dot(t) if decides[id.index()] => t.d.into_iter().for_each(|d| pass(d, vote)),
                Node::Div(a, _) => pass(a, vote),
                _ => {}
            }
        }
        votes
    }
}

/// For every expression, whether its sign can be chosen at no cost.
fn deciding(graph: &Graph, order: &[ExprId]) -> Vec<bool> {
    let mut decides = vec![false; graph.len()];
    for &id in order {
        let decides_sign = |id: ExprId| decides[id.index()];
        decides[id.index()] = match graph.node(id) {
            Node::RotX(_) | Node::RotY(_) | Node::Sub(..) | Node::Cross(_) => true,
            Node::Neg(a) | Node::Div(a, _) => decides_sign(a),
            Node::Mul(a, b) => decides_sign(a) || decides_sign(b),
            Node::Add(a, b) => decides_sign(a) && decides_sign(b),
            Node::Dot(t) => t.d.into_iter().all(decides_sign),
            _ => false,
        };
    }
    decides
}

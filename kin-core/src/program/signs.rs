//! Signs: which atoms to compute negated, so that the fewest negations are needed.
//!
//! During lowering a sign travels with every value for free; it costs a negation only where an output needs the
//! opposite of what was computed. The sign of a rotated body vector is free to choose when its components hold a
//! literal factor (−l/2 costs no more than l/2), and the sign of a difference by swapping its operands. Each output
//! votes for the signs of the atoms and differences that decide its own.

use crate::expr::{ExprId, Graph, Node, Rotation};
use std::collections::{HashMap, HashSet};

/// Choices of sign.
#[derive(Debug, Default)]
pub(super) struct Signs {
    /// Rotated vectors that are computed as −ρ.
    pub(super) negated: HashSet<Rotation>,
    /// Differences that are computed the other way round.
    pub(super) swapped: HashSet<ExprId>,
}

/// Chooses signs for these outputs.
pub(super) fn choose(graph: &Graph, outputs: impl Iterator<Item = ExprId>) -> Signs {
    let mut votes = Votes { graph, vectors: HashMap::new(), order: Vec::new(), differences: HashMap::new() };
    let mut counted = HashSet::new();
    for output in outputs {
        if counted.insert(output) {
            votes.cast(output, 1);
        }
    }
    let mut signs = Signs::default();
    for rotation in &votes.order {
        // Negating a component without a literal factor costs one operation each.
        let cost: i32 = [rotation.x, rotation.y].iter().map(|id| i32::from(!is_free(graph, *id))).sum();
        if votes.vectors[rotation] < -cost {
            signs.negated.insert(*rotation);
        }
    }
    signs.swapped = votes.differences.into_iter().filter(|(_, vote)| *vote < 0).map(|(id, _)| id).collect();
    signs
}

/// True when −id costs no more than id.
pub(super) fn is_free(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Number(_) | Node::Neg(_) => true,
        Node::Mul(a, _) => graph.literal(a).is_some(),
        _ => false,
    }
}

struct Votes<'g> {
    graph: &'g Graph,
    vectors: HashMap<Rotation, i32>,
    order: Vec<Rotation>,
    differences: HashMap<ExprId, i32>,
}

impl Votes<'_> {
    /// `sign` is what the output wants of `id`. A sum wants it of both its parts, a product of one factor.
    fn cast(&mut self, id: ExprId, sign: i32) {
        match self.graph.node(id) {
            Node::Neg(a) => self.cast(a, -sign),
            Node::RotX(rotation) | Node::RotY(rotation) => {
                if !self.vectors.contains_key(&rotation) {
                    self.order.push(rotation);
                }
                *self.vectors.entry(rotation).or_default() += sign;
            }
            Node::Add(a, b) => {
                if self.decides(a) && self.decides(b) {
                    self.cast(a, sign);
                    self.cast(b, sign);
                }
            }
            Node::Sub(..) | Node::Cross(_) => *self.differences.entry(id).or_default() += sign,
            Node::Mul(a, b) => {
                if let Some(factor) = [a, b].into_iter().find(|factor| self.decides(*factor)) {
                    self.cast(factor, sign);
                }
            }
            Node::Div(a, _) => self.cast(a, sign),
            _ => {}
        }
    }

    /// True when the sign of `id` can be chosen.
    fn decides(&self, id: ExprId) -> bool {
        match self.graph.node(id) {
            Node::RotX(_) | Node::RotY(_) | Node::Sub(..) | Node::Cross(_) => true,
            Node::Neg(a) | Node::Div(a, _) => self.decides(a),
            Node::Mul(a, b) => self.decides(a) || self.decides(b),
            Node::Add(a, b) => self.decides(a) && self.decides(b),
            _ => false,
        }
    }
}

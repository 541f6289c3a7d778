//! Φ_qᵀ λ = r along the tree of a plan.
//!
//! A plan solves Φ_q x = b as expressions that are linear in b. With weights r the sum Σ rᵢ xᵢ is rᵀ Φ_q⁻¹ b, and its
//! derivative with respect to b_k is λ_k. Reverse accumulation, from the results back to the b_k, takes one product for
//! every product of the solution, and expressions in Φ_q alone are shared.

use crate::expr::{ExprId, Graph, IdMap, Node, Symbol};

/// λ for `rows` rows. `solution` is x for right-hand sides that are the symbols [`Symbol::Right`]; `None` if an
/// operation on them in x is not linear.
pub(super) fn transpose(graph: &mut Graph, solution: &[ExprId], r: &[ExprId], rows: usize) -> Option<Vec<ExprId>> {
    let order = graph.reachable(solution.iter().copied());
    let mut linear: IdMap<bool> = IdMap::default();
    for &id in &order {
        let node = graph.node(id);
        let mut holds = matches!(node, Node::Symbol(Symbol::Right(_)));
        node.for_each_operand(|operand| holds |= linear.or(operand, false));
        linear.insert(id, holds);
    }
    let holds = |id: ExprId| linear.or(id, false);
    let zero = graph.zero();
    let mut weights: IdMap<ExprId> = IdMap::default();
    let add = |graph: &mut Graph, weights: &mut IdMap<ExprId>, id: ExprId, weight: ExprId| {
        if holds(id) {
            let sum = graph.add(weights.or(id, zero), weight);
            weights.insert(id, sum);
        }
    };
    for (x, weight) in solution.iter().zip(r) {
        add(graph, &mut weights, *x, *weight);
    }
    let mut lambda = vec![zero; rows];
    for &id in order.iter().rev() {
        if !holds(id) || !weights.contains(id) {
            continue;
        }
        let weight = weights.or(id, zero);
        match graph.node(id) {
            Node::Symbol(Symbol::Right(k)) => *lambda.get_mut(k as usize)? = weight,
            Node::Neg(a) => {
                let weight = graph.neg(weight);
                add(graph, &mut weights, a, weight);
            }
            Node::Opaque(a) => {
                let weight = graph.opaque(weight);
                add(graph, &mut weights, a, weight);
            }
            Node::Add(a, b) => {
                add(graph, &mut weights, a, weight);
                add(graph, &mut weights, b, weight);
            }
            Node::Sub(a, b) => {
                add(graph, &mut weights, a, weight);
                let weight = graph.neg(weight);
                add(graph, &mut weights, b, weight);
            }
            Node::Mul(a, b) if holds(a) != holds(b) => {
                let (factor, linear) = if holds(a) { (b, a) } else { (a, b) };
                let weight = graph.mul(factor, weight);
                add(graph, &mut weights, linear, weight);
            }
            Node::Div(a, b) if !holds(b) => {
                let weight = graph.div(weight, b);
                add(graph, &mut weights, a, weight);
            }
            _ => return None,
        }
    }
    Some(lambda)
}

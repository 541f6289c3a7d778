//! Derivatives of rows of velocity level, by the same rules as for positions but with q̇_k as the variables.

use super::graph::Graph;
use super::jet::{Jet, constant, derivatives, rate_of_given};
use super::node::{ExprId, Symbol};

/// The derivatives of a row η(q, q̇, t) of velocity level: η̇ = Σ_k ∂η/∂q̇_k q̈_k + (η_q q̇ + η_t).
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityJet {
    /// ∂η/∂q̇_k for every rate that appears, by ascending k: the coefficients of q̈_k, and the row of B if η is linear
    /// in q̇.
    pub gradient: Vec<(u32, ExprId)>,
    /// η_q q̇ + η_t, the derivative for constant q̇, which is −γ.
    pub rest: ExprId,
}

/// The first derivatives of `roots`, which may contain q̇, with respect to q̇ and t.
pub fn velocity_derivatives(graph: &mut Graph, roots: &[ExprId]) -> Vec<VelocityJet> {
    let jets = derivatives(graph, roots, of_symbol_at_velocity_level);
    jets.into_iter().map(|jet| VelocityJet { gradient: jet.gradient, rest: jet.partial_t }).collect()
}

/// The derivatives of a symbol: q̇_k contributes to the gradient, everything else to the rest. Second derivatives are
/// set to 0, because they are not needed.
fn of_symbol_at_velocity_level(graph: &mut Graph, symbol: Symbol) -> Jet {
    let mut jet = Jet { partial_t: rate_of_given(graph, symbol), ..constant(graph) };
    match symbol {
        Symbol::Coordinate(k) => jet.partial_t = graph.symbol(Symbol::Rate(k)),
        Symbol::Rate(k) => jet.gradient.push((k, graph.number(1.0))),
        _ => {}
    }
    jet
}

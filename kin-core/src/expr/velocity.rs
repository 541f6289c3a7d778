//! Derivatives of rows of velocity level, by the same rules with other variables: q̇_k stands where q_k stood.

use super::graph::Graph;
use super::jet::{Jet, constant, derivatives, rate_of_given};
use super::node::{ExprId, Symbol};

/// η̇ of a row of velocity level: η̇ = Σ_k ∂η/∂q̇_k q̈_k + (η_q q̇ + η_t).
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityJet {
    /// ∂η/∂q̇_k for every rate that appears, by k: B where η is linear in q̇, and the coefficients of q̈_k.
    pub gradient: Vec<(u32, ExprId)>,
    /// η_q q̇ + η_t at fixed q̇, which is −γ.
    pub rest: ExprId,
}

/// The derivatives of `roots`, which may hold q̇: first derivatives only, with q̇_k in the place of q_k.
pub fn velocity_derivatives(graph: &mut Graph, roots: &[ExprId]) -> Vec<VelocityJet> {
    let jets = derivatives(graph, roots, of_symbol_at_velocity_level);
    jets.into_iter().map(|jet| VelocityJet { gradient: jet.gradient, rest: jet.partial_t }).collect()
}

/// Only the first derivatives: q̇_k gives the gradient, everything else the rest. Second derivatives are all 0, so that
/// nothing is built that nobody reads.
fn of_symbol_at_velocity_level(graph: &mut Graph, symbol: Symbol) -> Jet {
    let mut jet = Jet { partial_t: rate_of_given(graph, symbol), ..constant(graph) };
    match symbol {
        Symbol::Coordinate(k) => jet.partial_t = graph.symbol(Symbol::Rate(k)),
        Symbol::Rate(k) => jet.gradient.push((k, graph.number(1.0))),
        _ => {}
    }
    jet
}

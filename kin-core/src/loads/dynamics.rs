//! M and Q of M q̈ + Φ_qᵀ λ = Q as formulas for people.
//!
//! For masses m with the coordinates x of their centres, and moments of inertia J with the angles φ of their bodies,
//! ```text
//! M_jk = Σ m ∂x/∂q_j ∂x/∂q_k + Σ J ∂φ/∂q_j ∂φ/∂q_k        Q = (Q − M q̈) where q̈ = 0
//! ```
//! so that terms that are quadratic in the rates are part of Q.

use super::equilibrium::Equilibrium;
use super::forces::all_acting;
use super::free_bodies::FreeBodies;
use crate::expr::{ExprId, Graph, IdMap, Shown, Symbol, total_derivatives};
use crate::mechanism::Mechanism;
use crate::plan::{Substitution, rewrite};
use crate::system::KinematicSystem;
use std::collections::BTreeMap;

/// M and Q, printed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrintedDynamics {
    /// The non-zero entries of the symmetric matrix M with row ≤ column: row, column, entry.
    pub mass: Vec<(usize, usize, String)>,
    /// Q, one entry for each coordinate.
    pub forces: Vec<String>,
}

/// The equations of motion of a mechanism; `None` if it has neither masses nor loads.
pub fn dynamics(mechanism: &Mechanism, system: &KinematicSystem) -> Option<PrintedDynamics> {
    if mechanism.loads.is_empty() {
        return None;
    }
    let set = &system.set;
    let mut bodies = FreeBodies::new(mechanism, set, set.graph.clone());
    let (acting, _) = all_acting(&mut bodies);
    let equilibrium = Equilibrium::new(&mut bodies, set, &acting);
    let inertial: Vec<(ExprId, ExprId)> = acting.iter().flat_map(|acting| acting.inertial.iter().copied()).collect();
    let graph = &mut bodies.a.graph;
    let mass = mass_matrix(graph, &inertial);
    let mut known = IdMap::default();
    let forces = equilibrium.posed.iter().map(|r| rewrite(graph, *r, &mut known, &mut AtRest)).collect::<Vec<_>>();
    let show = |id| Shown { graph, names: set, id }.to_string();
    Some(PrintedDynamics {
        mass: mass.into_iter().map(|((row, column), entry)| (row as usize, column as usize, show(entry))).collect(),
        forces: forces.into_iter().map(show).collect(),
    })
}

/// Σ factor · ∂quantity/∂q_j · ∂quantity/∂q_k, where it is not 0.
fn mass_matrix(graph: &mut Graph, inertial: &[(ExprId, ExprId)]) -> BTreeMap<(u32, u32), ExprId> {
    let quantities: Vec<ExprId> = inertial.iter().map(|(quantity, _)| *quantity).collect();
    let jets = total_derivatives(graph, &quantities);
    let mut entries = BTreeMap::new();
    for ((_, factor), jet) in inertial.iter().zip(jets) {
        for (index, (j, first)) in jet.gradient.iter().enumerate() {
            for (k, second) in &jet.gradient[index..] {
                let product = graph.mul_all([*factor, *first, *second]);
                let zero = graph.zero();
                let sum = entries.entry(((*j).min(*k), (*j).max(*k))).or_insert(zero);
                *sum = graph.add(*sum, product);
            }
        }
    }
    entries.retain(|_, entry| !graph.is_zero(*entry));
    entries
}

/// The substitution q̈ = 0.
struct AtRest;

impl Substitution for AtRest {
    fn symbol(&mut self, graph: &mut Graph, symbol: Symbol) -> Option<ExprId> {
        matches!(symbol, Symbol::Acceleration(_)).then(|| graph.zero())
    }
}

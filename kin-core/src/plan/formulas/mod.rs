//! Writes the closed forms of a plan as they would be derived by hand, from the same tree as the programs: for each
//! step its coordinates, then their rates and accelerations, each in terms of quantities that come before.
//!
//! ```text
//! tree → items in order of solution (collect) → derivatives of all items → lines (write, share)
//! ```
//!
//! Known coordinates appear by name, so that the lines of a step do not repeat the expressions of earlier steps. Long
//! expressions are split: a part that occurs several times or is itself long gets a name and a separate line (see
//! `share`).

mod collect;
mod line;
mod share;
mod write;

pub use line::{Formulas, Line};

use super::steps::StepList;
use super::tree::Block;
use crate::expr::Graph;
use crate::system::KinematicSystem;

/// The formulas of the steps of a tree.
pub(super) fn formulas(system: &KinematicSystem, graph: Graph, listed: &StepList, tree: &Block) -> Vec<Formulas> {
    let mut graph = graph;
    let (items, roots) = collect::collect(&mut graph, listed, tree);
    write::write(system, graph, listed, &items, &roots)
}

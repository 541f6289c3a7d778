//! The closed forms of a plan as a person would derive them, from the tree that the programs are built from: per step what
//! gives its coordinates, then their rates and accelerations, each by what stands before it.
//!
//! ```text
//! tree → items in the order of the solution (gather) → derivatives of all at once → lines (write, with names for what is shared)
//! ```
//!
//! Coordinates that are known stand as themselves, so every line is about its own step. Long expressions are taken apart:
//! what occurs in them more than once, and what is long in itself, has a line and a name of its own (see `share`).

mod gather;
mod line;
mod share;
mod write;

pub use line::{Formulas, Line};

use super::steps::Listed;
use super::tree::Block;
use crate::expr::Graph;
use crate::system::KinematicSystem;

/// The closed forms of a tree.
pub(super) fn formulas(system: &KinematicSystem, graph: Graph, listed: &Listed, tree: &Block) -> Vec<Formulas> {
    let mut graph = graph;
    let (items, roots) = gather::gather(&mut graph, listed, tree);
    write::write(system, graph, listed, &items, &roots)
}

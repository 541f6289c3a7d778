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
mod share;
mod write;

use super::steps::Listed;
use super::tree::Block;
use crate::expr::Graph;
use crate::system::KinematicSystem;

/// What a step computes, in the user's names; a step whose coordinates come at several places is there several times.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Formulas {
    /// Place in [`SolutionPlan::steps`](super::SolutionPlan::steps).
    pub step: usize,
    /// What it is, in words.
    pub what: String,
    /// Lines for q, q̇ and q̈.
    pub lines: [Vec<Line>; 3],
}

/// A line; expressions are written as [`ConstraintSet::show`](crate::ConstraintSet::show) writes them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// What a name is.
    Equation {
        /// A coordinate, a rate or acceleration of one (`_dot`, `_ddot`), or a name that later lines use.
        left: String,
        /// Its value.
        right: String,
    },
    /// What an iteration brings to zero.
    Zero {
        /// Its name.
        left: String,
        /// Its value.
        right: String,
    },
    /// matrix · unknowns = right.
    System {
        /// Row by row.
        matrix: Vec<Vec<String>>,
        /// Coordinates, or their rates or accelerations.
        unknowns: Vec<String>,
        /// As many as rows.
        right: Vec<String>,
    },
}

/// The closed forms of a tree.
pub(super) fn formulas(system: &KinematicSystem, graph: Graph, listed: &Listed, tree: &Block) -> Vec<Formulas> {
    let mut graph = graph;
    let (items, roots) = gather::gather(&mut graph, listed, tree);
    write::write(system, graph, listed, &items, &roots)
}

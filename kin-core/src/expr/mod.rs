//! Expressions: a hash-consed graph, local simplification, total time derivatives, a generic fold.
//!
//! This module depends only on the list of built-in functions.

mod display;
mod fold;
mod graph;
mod jet;
mod map;
mod node;
mod simplify;
mod vectors;
mod velocity;

pub(crate) use display::suffix;
pub use display::{Names, Shown};
pub(crate) use fold::Algebra;
pub use graph::Graph;
pub use jet::{Jet, partial, total_derivatives};
pub(crate) use map::IdMap;
pub use node::{Bits, Depends, ExprId, MAX_ORDER, Node, Rotation, Symbol, Turning};
pub(crate) use vectors::quarter_turns;
pub use velocity::{VelocityJet, velocity_derivatives};

/// The relative error of a number that has been computed from literals, as 0.1 + 0.2.
pub(crate) const ROUNDING: f64 = 8.0 * f64::EPSILON;

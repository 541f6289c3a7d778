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
pub use velocity::{VelocityJet, velocity_derivatives};

//! Vector notation, as the lecture and textbooks write the equation of a joint: what it is made of, and how it is printed
//! as text, LaTeX and MathML.

mod equation;
mod terms;
mod write;

pub use equation::NamedJoint;
pub(crate) use equation::{Equation, Piece, Symbol};
pub(crate) use terms::{Terms, equals, zero};
pub(crate) use write::write;

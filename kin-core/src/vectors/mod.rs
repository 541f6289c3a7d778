//! Vector notation for the equations of joints, as in textbooks: their terms, and their output as text, LaTeX and
//! MathML.

mod equation;
mod terms;
mod write;

pub use equation::NamedJoint;
pub(crate) use equation::{Equation, EquationPiece, Letter};
pub(crate) use terms::{Terms, equals, zero};
pub(crate) use write::write;

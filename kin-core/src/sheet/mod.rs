//! The derivation as a document (a *sheet*): for each joint its vector equations, then its rows of Φ, Φ_q, Φ_t and γ;
//! then the steps of the solution plan; as text, as LaTeX, as an HTML page, and as documentation of the struct.
//!
//! The formulas of a sheet come from the graph from which the code is generated: directly by [`Sheet::of_system`] at
//! compile time, or from the tables of a compiled mechanism.

mod assembled;
mod content;
mod docs;
mod dynamics;
mod html;
mod latex;
mod lines;
mod of_system;
mod shown;
mod steps;
mod symbols;
mod text;

pub use content::{Dynamics, Joint, Rows, Sheet};
pub use shown::{Row, ShownFormula};
pub use steps::{SheetStep, StepLine};

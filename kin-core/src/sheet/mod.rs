//! The derivation for people: joint by joint, each with its own equation first, then its rows of Φ, Φ_q, Φ_t and γ, and
//! how the solution plan solves them; as text, LaTeX, a page, and documentation of the struct.
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
mod text;

pub use content::{Dynamics, Joint, Rows, Sheet};
pub use shown::{Row, Shown};
pub use steps::{Line, Step};

//! Symbolic kinematics of planar mechanisms: what `#[mechanism]` does between parsing and emitting code.
//!
//! ```text
//! Mechanism → ConstraintSet → KinematicSystem → Program
//!    assemble      differentiate       lower
//! ```
//!
//! - [`mechanism`]: what the user said, names resolved; its rules.
//! - [`constraint`]: Φ, one constraint type per file.
//! - [`expr`]: the hash-consed expressions, and the one place that differentiates.
//! - [`notation`]: formulas as Unicode text, LaTeX and MathML.
//! - [`system`]: Φ_q, Φ_t, γ and the class of every row.
//! - [`structure`]: what the equations say before any number is known: generic rank, redundant rows.
//! - [`program`]: straight-line code shared by all outputs, with an interpreter as oracle.
//! - [`rows`]: the program of Φ, Φ_q, Φ_t and γ.
//! - [`sheet`]: the derivation for people.
//!
//! Each room imports only those above it in this list's reading (`constraint` uses `mechanism` and `expr`; `program`
//! uses `expr` alone). There are no tokens, no spans and no I/O here.

pub mod check;
pub mod constraint;
pub mod error;
pub mod expr;
mod hash;
pub mod joints;
pub mod mechanism;
pub mod notation;
pub mod plan;
pub mod program;
pub mod rows;
pub mod sheet;
pub mod structure;
pub mod system;
pub mod units;
pub mod vectors;
pub mod vocabulary;

pub use constraint::ConstraintSet;
pub use error::{ModelError, Origin};
pub use joints::assemble;
pub use mechanism::Mechanism;
pub use plan::{SolutionPlan, plan};
pub use program::Program;
pub use structure::{Structure, diagnose};
pub use system::{KinematicSystem, differentiate};

//! Symbolic kinematics of planar mechanisms: what `#[mechanism]` does between parsing and emitting code.
//!
//! ```text
//! Mechanism → ConstraintSet → KinematicSystem → SolutionPlan → Kernels
//!    assemble      differentiate        plan        kernels
//! ```
//!
//! Each arrow is one function from one named type to the next, and none calls back into an earlier one.
//!
//! - [`vocabulary`]: the words that kin-runtime shares; all that there is without the feature `compiler`.
//! - [`expr`]: the hash-consed expressions, the one place that differentiates, and the one fold that walks them.
//! - [`mechanism`]: what the user said, names resolved: a joint is the operands in the slots of its form.
//! - [`constraint`]: the constraint set Φ with everything that is reported, and the state in which rows are written.
//! - [`notation`], [`vectors`]: formulas, and the vector equations of joints, as Unicode text, LaTeX and MathML.
//! - [`joints`]: one kind of joint per file: operands, rows of Φ, rules, vector equations; and assembly.
//! - [`check`], [`units`]: the rules of a mechanism, and whether its units agree.
//! - [`system`]: Φ_q, Φ_t, γ and the class of every row.
//! - [`structure`]: what the equations say before any number is known: generic rank, redundant rows.
//! - [`program`]: straight-line code shared by all outputs, and what repeats in it as loops.
//! - [`mod@plan`]: how the mechanism is solved, step by step.
//! - [`mod@kernels`]: every program of the mechanism, finished: what generated code consists of.
//! - [`sheet`]: the derivation for people.
//!
//! Each room imports only those before it in this list. There are no tokens, no spans and no I/O here.

#![cfg_attr(not(feature = "units"), no_std)]

#[cfg(feature = "compiler")]
pub mod check;
#[cfg(feature = "compiler")]
pub mod constraint;
#[cfg(feature = "compiler")]
pub mod error;
#[cfg(feature = "compiler")]
pub mod expr;
#[cfg(feature = "compiler")]
mod hash;
#[cfg(feature = "compiler")]
pub mod joints;
#[cfg(feature = "compiler")]
pub mod kernels;
#[cfg(feature = "compiler")]
pub mod loads;
#[cfg(feature = "compiler")]
pub mod mechanism;
#[cfg(feature = "compiler")]
pub mod notation;
#[cfg(feature = "compiler")]
pub mod plan;
#[cfg(feature = "compiler")]
pub mod program;
#[cfg(feature = "compiler")]
pub mod sheet;
#[cfg(feature = "compiler")]
pub mod structure;
#[cfg(feature = "compiler")]
pub mod system;
#[cfg(feature = "units")]
pub mod units;
#[cfg(feature = "compiler")]
pub mod vectors;
pub mod vocabulary;

#[cfg(feature = "compiler")]
pub use {
    constraint::ConstraintSet,
    error::{ModelError, Origin},
    joints::assemble,
    kernels::{Kernels, kernels},
    mechanism::Mechanism,
    plan::{SolutionPlan, plan},
    program::Program,
    structure::{Structure, diagnose},
    system::{KinematicSystem, differentiate},
};

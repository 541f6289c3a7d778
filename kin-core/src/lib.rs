//! Symbolic kinematics of planar mechanisms: the part of `#[mechanism]` between parsing and emitting code.
//!
//! ```text
//! Mechanism → ConstraintSet → KinematicSystem → SolutionPlan (→ Forces) → Kernels
//!    assemble      differentiate        plan          forces      kernels
//! ```
//!
//! Each arrow is one function from one type to the next; no stage calls an earlier one. The modules need the feature
//! `compiler`, which the macro enables, unless the list says otherwise.
//!
//! - [`vocabulary`]: the kinds and names shared with kin-runtime; needs no feature.
//! - `hash`, [`error`]: hash tables that are fast in unoptimised builds; errors with their places in the source.
//! - [`expr`]: hash-consed expressions, their total derivatives, and the fold that evaluates and rewrites them.
//! - [`mechanism`]: the mechanism as the user declared it, with names resolved; a joint is a list of operands for its
//!   slots.
//! - [`constraint`]: the constraint set Φ with everything that is reported, and the assembly state for writing rows.
//! - [`notation`], [`vectors`]: formulas, and the vector equations of joints, as Unicode text, LaTeX and MathML.
//! - [`joints`]: one file for each kind of joint (operands, rows of Φ, rules, vector equations), and the assembly.
//! - [`check`], [`units`]: the rules of a mechanism, and the consistency of its units; reading units needs only the
//!   feature `units`.
//! - [`system`]: Φ_q, Φ_t, γ and the class of every row.
//! - [`structure`]: structural analysis without numbers: generic rank, redundant rows.
//! - [`program`]: straight-line programs in which every value is computed once, and loops for repeated parts.
//! - [`mod@plan`]: how the mechanism is solved, step by step.
//! - [`loads`]: masses and loads, the multipliers λ along the plan, and the forces that drivers and joints exert.
//! - [`mod@kernels`]: all programs of the mechanism in final form, of which the generated code consists.
//! - [`sheet`]: the derivation as a document.
//!
//! Each module depends only on those before it in this list. The crate has no tokens, no spans and no I/O.

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

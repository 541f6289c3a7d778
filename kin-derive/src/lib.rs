//! The `#[mechanism]` attribute of kin. Use it through `kin_runtime::mechanism`, which documents the language.
//!
//! ```text
//! tokens → Description → Mechanism → ConstraintSet → KinematicSystem → SolutionPlan → Kernels → tokens
//!     parse        lower       assemble       differentiate        plan       kernels    expand
//! ```
//!
//! Errors come from three stages: parsing and lowering, the rules of `kin_core::check`, and the structural analysis of
//! the equations by `kin_core::structure`. Expansion cannot fail. For a description with errors, `fallback` emits the
//! struct and empty items beside the errors.

mod analyse;
mod ast;
#[cfg(test)]
mod corpus;
mod derive;
mod documentation;
mod expand;
mod fallback;
mod function;
#[cfg(test)]
mod fuzz;
mod lower;
#[cfg(test)]
#[path = "../../kin-core/tests/oracle/mod.rs"]
mod oracle;
mod parse;
mod report;
mod suggest;
#[cfg(test)]
mod tests;

use derive::derive;
use proc_macro::TokenStream;

/// Derives the kinematics of a planar mechanism from its description; see `kin_runtime::mechanism`.
#[proc_macro_attribute]
pub fn mechanism(args: TokenStream, item: TokenStream) -> TokenStream {
    derive(args.into(), item.into()).into()
}

/// The equations of a mechanism as documentation of its struct, called by the code that [`macro@mechanism`] generates.
#[cfg(feature = "equations")]
#[doc(hidden)]
#[proc_macro]
pub fn documentation(input: TokenStream) -> TokenStream {
    proc_macro::TokenTree::Literal(proc_macro::Literal::string(&documentation::text(input.into()))).into()
}

//! The `#[mechanism]` attribute of kin. Use it through `kin_runtime::mechanism`, which documents the language.
//!
//! ```text
//! tokens → Description → Mechanism → ConstraintSet → KinematicSystem → tokens
//!     parse        lower       assemble      differentiate       expand
//! ```
//!
//! Parsing and lowering collect every mistake; the rules of `kin_core::mechanism::check` are the second gate, and what
//! `kin_core::structure` proves of the equations the third; after it expansion cannot fail. With mistakes, `fallback` emits the struct and empty items beside the errors.

mod analyse;
mod ast;
#[cfg(test)]
mod corpus;
mod expand;
mod fallback;
mod lower;
mod parse;
mod report;
mod suggest;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod timing;

use analyse::Broken;
use lower::Lowered;
use proc_macro::TokenStream;
use proc_macro2::{Span, TokenStream as TokenStream2};

/// Derives the kinematics of a planar mechanism from its description; see `kin_runtime::mechanism`.
#[proc_macro_attribute]
pub fn mechanism(args: TokenStream, item: TokenStream) -> TokenStream {
    derive(args.into(), item.into()).into()
}

/// The attribute on token streams of any origin, so that tests can call it.
fn derive(args: TokenStream2, item: TokenStream2) -> TokenStream2 {
    let (cleaned, lowered) = analyse::analyse(args, item.clone());
    let derived = lowered.and_then(|lowered| match system(&lowered) {
        Ok((system, _)) => Ok(expand::expand(&lowered, &system)),
        Err(error) => Err(Broken { error, lowered: Some(Box::new(lowered)) }),
    });
    derived.unwrap_or_else(|broken| fallback::fallback(cleaned.as_ref(), item, &broken))
}

/// The differentiated equations and what their structure says; errors where the rules of the model were not enough.
fn system(lowered: &Lowered) -> syn::Result<(kin_core::KinematicSystem, kin_core::Structure)> {
    let spanned = |errors: Vec<kin_core::ModelError>| {
        let spanned = errors.into_iter().map(|error| {
            let span = lowered.spans.get(error.origin.0 as usize).copied().unwrap_or_else(Span::call_site);
            syn::Error::new(span, error)
        });
        spanned.reduce(|mut all, error| {
            all.combine(error);
            all
        })
    };
    let system = kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate).map_err(|errors| {
        spanned(errors).unwrap_or_else(|| syn::Error::new(Span::call_site(), "the mechanism cannot be assembled"))
    })?;
    let structure = kin_core::diagnose(&system);
    if !lowered.flags.allow_redundant {
        let errors = kin_core::structure::explain(&lowered.mechanism, &system, &structure);
        spanned(errors).map_or(Ok(()), Err)?;
    }
    Ok((system, structure))
}

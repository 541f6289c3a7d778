//! The equations in the generated documentation of the struct.

#[cfg(any(feature = "equations", test))]
use crate::analyse::{analyse, derive_equations};
use proc_macro2::TokenStream;
use quote::quote;

/// An attribute that adds the equations to the documentation of the struct. It contains the description as the argument
/// of a macro that only rustdoc expands, so that no other build typesets the equations.
pub(crate) fn attribute(args: &TokenStream, item: &TokenStream) -> TokenStream {
    // In tests it is empty, so that snapshots do not depend on the features that other crates of a workspace enable.
    if !cfg!(feature = "equations") || cfg!(test) {
        return TokenStream::new();
    }
    quote! { #[cfg_attr(doc, doc = ::kin_runtime::private::documentation!((#args) #item))] }
}

/// The equations of `#[mechanism(args)] item` as documentation; empty for a description with errors.
#[cfg(any(feature = "equations", test))]
pub(crate) fn text(input: TokenStream) -> String {
    let mut tokens = input.into_iter();
    let Some(proc_macro2::TokenTree::Group(args)) = tokens.next() else { return String::new() };
    let (_, Ok(lowered)) = analyse(args.stream(), tokens.collect()) else { return String::new() };
    let Ok((system, structure)) = derive_equations(&lowered) else { return String::new() };
    let plan = kin_core::plan::plan_with_formulas(&system, structure.rank);
    let sections = kin_core::sheet::Sheet::of_system(&lowered.mechanism, &system, &plan).docs(&lowered.docs.rows);
    // Lists of items show the first paragraph of the documentation, which must not be a heading.
    let first = if lowered.docs.mechanism.is_empty() { "A planar mechanism." } else { "" };
    format!("{first}{sections}")
}

#[cfg(test)]
mod tests;

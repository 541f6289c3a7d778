//! The equations in the documentation of the struct.

#[cfg(any(feature = "equations", test))]
use crate::analyse::{analyse, system};
use proc_macro2::TokenStream;
use quote::quote;

/// What adds the equations to the documentation of the struct. The description goes along, for a macro that only a run of
/// rustdoc calls: no other build typesets anything, or carries it.
pub(crate) fn attribute(args: &TokenStream, item: &TokenStream) -> TokenStream {
    // Snapshots are the same whichever features the rest of a workspace asks for.
    if !cfg!(feature = "equations") || cfg!(test) {
        return TokenStream::new();
    }
    quote! { #[cfg_attr(doc, doc = ::kin_runtime::private::documentation!((#args) #item))] }
}

/// The equations of `#[mechanism(args)] item` as documentation; nothing where they are not to be had.
#[cfg(any(feature = "equations", test))]
pub(crate) fn text(input: TokenStream) -> String {
    let mut tokens = input.into_iter();
    let Some(proc_macro2::TokenTree::Group(args)) = tokens.next() else { return String::new() };
    let (_, Ok(lowered)) = analyse(args.stream(), tokens.collect()) else { return String::new() };
    let Ok((system, structure)) = system(&lowered) else { return String::new() };
    let plan = kin_core::plan::plan_with_formulas(&system, structure.rank);
    let sections = kin_core::sheet::Sheet::of_system(&system, &plan).docs();
    // The first paragraph is what lists show of the struct; a heading says nothing there.
    let first = if lowered.docs.mechanism.is_empty() { "A planar mechanism." } else { "" };
    format!("{first}{sections}")
}

#[cfg(test)]
mod tests;

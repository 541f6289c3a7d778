//! Generic parameters of the struct, as implementations and kernels repeat them.

use super::functions;
use crate::lower::Lowered;
use crate::parse::mentioned;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};
use syn::{GenericParam, Generics, parse_quote};

/// The type parameters that are types of numbers, each once, in the order of the fields.
pub(super) fn scalars(lowered: &Lowered) -> Vec<&Ident> {
    let mut scalars = Vec::new();
    for scalar in lowered.fields.iter().filter_map(|field| field.scalar.as_ref()) {
        if !scalars.contains(&scalar) {
            scalars.push(scalar);
        }
    }
    scalars
}

/// The generics of the struct, with a trait bound from the generated code on the type parameters that are types of
/// numbers.
pub(crate) fn bounded(lowered: &Lowered, bound: &str) -> Generics {
    let mut generics = lowered.item.generics.clone();
    let bound = Ident::new(bound, Span::call_site());
    for scalar in scalars(lowered) {
        generics.make_where_clause().predicates.push(parse_quote! { #scalar: __kin::#bound });
    }
    add_functions(lowered, &mut generics);
    generics
}

/// The generics of the struct, with the bounds for supplied functions only.
pub(crate) fn of_functions(lowered: &Lowered) -> Generics {
    let mut generics = lowered.item.generics.clone();
    add_functions(lowered, &mut generics);
    generics
}

/// A supplied function may have any type that implements the trait, including a type parameter of the struct.
fn add_functions(lowered: &Lowered, generics: &mut Generics) {
    let types: Vec<Ident> = generics.type_params().map(|parameter| parameter.ident.clone()).collect();
    for ty in functions::types(lowered).filter(|ty| mentioned(ty.to_token_stream(), &types).is_some()) {
        generics.make_where_clause().predicates.push(parse_quote! { #ty: __kin::ScalarFunction });
    }
}

/// The generic arguments with `f64` for numbers and the defaults of other parameters.
pub(crate) fn in_numbers(lowered: &Lowered) -> TokenStream {
    let scalars = scalars(lowered);
    let arguments: Vec<TokenStream> = (lowered.item.generics.params.iter())
        .filter_map(|parameter| match parameter {
            GenericParam::Lifetime(_) => Some(quote! { 'static }),
            GenericParam::Type(parameter) if scalars.contains(&&parameter.ident) => Some(quote! { f64 }),
            GenericParam::Type(parameter) => parameter.default.as_ref().map(|(_, default)| quote! { #default }),
            GenericParam::Const(parameter) => parameter.default.as_ref().map(|(_, default)| quote! { #default }),
        })
        .collect();
    if arguments.is_empty() {
        TokenStream::new()
    } else {
        quote! { <#(#arguments),*> }
    }
}

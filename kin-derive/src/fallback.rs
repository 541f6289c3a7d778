//! The expansion of a description with errors: the struct, its handles and empty items beside the errors, so that the
//! compiler reports no errors that follow from missing items.

use crate::analyse::Broken;
use crate::expand::{mentions, placeholder, placeholders};
use crate::parse::{derived_default, near_param, without_ours};
use proc_macro2::TokenStream;
use quote::quote;
use syn::{Attribute, Field, Ident, ItemStruct, Meta};

/// The errors, the struct, and an implementation of the trait for an empty mechanism.
///
/// `item` is what the user wrote; `cleaned` is the same struct without the attributes of kin, or `None` for another
/// item.
pub(crate) fn fallback(cleaned: Option<&ItemStruct>, item: TokenStream, broken: &Broken) -> TokenStream {
    let errors = broken.error.to_compile_error();
    let Some(cleaned) = cleaned else {
        let item = without_ours(item);
        return quote! { #errors #item };
    };
    let name = &cleaned.ident;
    let (impl_generics, type_generics, where_clause) = cleaned.generics.split_for_impl();
    let empty = |name: &str| {
        let name = Ident::new(name, proc_macro2::Span::call_site());
        quote! { type #name<__T: __kin::Scalar> = [__T; 0]; }
    };
    let arrays = [
        "Parameters",
        "Coordinates",
        "Rows",
        "NonZeros",
        "Observables",
        "ObservableNonZeros",
        "Factors",
        "KnownCurves",
    ];
    let types = arrays.map(empty);
    let default = promises_default(item).then(|| {
        quote! {
            #[automatically_derived]
            impl #impl_generics __kin::Default for #name #type_generics #where_clause {
                fn default() -> Self {
                    ::core::unimplemented!()
                }
            }
        }
    });
    let (handles, mentions, generic) = match &broken.lowered {
        Some(lowered) => (placeholders(lowered), mentions(lowered), placeholder(lowered)),
        None => Default::default(),
    };
    let nothing = quote! { -> __kin::Result<(), __kin::LengthError> { __kin::Ok(()) } };
    quote! {
        #errors
        // Warnings beside an error would only distract.
        #[allow(dead_code)]
        #cleaned
        const _: () = {
            use ::kin_runtime::private as __kin;
            #[allow(non_upper_case_globals, dead_code, missing_docs)]
            impl #impl_generics #name #type_generics #where_clause {
                #handles
            }
            #[automatically_derived]
            impl #impl_generics __kin::Mechanism for #name #type_generics #where_clause {
                const COORDINATES: usize = 0;
                const ROWS: usize = 0;
                const PARAMETERS: usize = 0;
                const INPUTS: usize = 0;
                #(#types)*
                type Inputs<__T: __kin::Scalar> = [__kin::Signal<__T>; 0];
                fn model() -> &'static __kin::Model { ::core::unimplemented!() }
                fn parameters<__T: __kin::Scalar>(&self) -> [__T; 0] { [] }
                fn set_parameter(&mut self, _: usize, _: f64) -> bool { #mentions false }
                fn evaluate_with<__T: __kin::Scalar>(
                    &self, _: &[__T], _: __kin::Subset, _: &__kin::Instant<'_, __T>, _: &[__T], _: &[__T],
                    _: &mut __kin::Workspace<Self, __T>,
                ) #nothing
                fn observe_with<__T: __kin::Scalar>(
                    &self, _: &[__T], _: &__kin::Instant<'_, __T>, _: &[__T], _: &[__T],
                    _: &mut __kin::Observations<Self, __T>,
                ) #nothing
            }
            #generic
            #default
        };
    }
}

/// True when every field of the struct has a default, even one that cannot be read, so that the user may rely on
/// `Default`.
fn promises_default(item: TokenStream) -> bool {
    let Ok(item) = syn::parse2::<ItemStruct>(item) else { return false };
    let gives_default = |attribute: &Attribute| {
        let is_given = match &attribute.meta {
            Meta::Path(_) => false,
            Meta::NameValue(_) => true,
            Meta::List(list) => {
                let first = list.tokens.clone().into_iter().next();
                first.is_some_and(|first| first.to_string() != "unit")
            }
        };
        is_given && near_param(attribute)
    };
    let has_default = |field: &Field| field.attrs.iter().any(gives_default);
    item.attrs.iter().find_map(derived_default).is_none() && item.fields.iter().all(has_default)
}

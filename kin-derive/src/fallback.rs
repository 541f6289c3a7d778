//! Useful while broken: the struct and empty items beside the errors, so that the real mistakes are the only red lines.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ItemStruct;

/// The errors, the struct, and an implementation of the trait for a mechanism without anything in it.
pub(crate) fn fallback(item: Option<&ItemStruct>, has_default: bool, error: &syn::Error) -> TokenStream {
    let errors = error.to_compile_error();
    let Some(item) = item else { return errors };
    let name = &item.ident;
    let (impl_generics, type_generics, where_clause) = item.generics.split_for_impl();
    let empty = |name: &str| {
        let name = syn::Ident::new(name, proc_macro2::Span::call_site());
        quote! { type #name<T: __kin::Scalar> = [T; 0]; }
    };
    let types = ["Parameters", "Coordinates", "Rows", "NonZeros", "Observables", "ObservableNonZeros"].map(empty);
    let default = has_default.then(|| {
        quote! {
            #[automatically_derived]
            impl #impl_generics __kin::Default for #name #type_generics #where_clause {
                fn default() -> Self {
                    ::core::unimplemented!()
                }
            }
        }
    });
    let nothing = quote! { -> __kin::Result<(), __kin::LengthError> { __kin::Ok(()) } };
    quote! {
        #errors
        #[allow(dead_code)]
        #item
        const _: () = {
            use ::kin_runtime::private as __kin;
            #[automatically_derived]
            impl #impl_generics __kin::Mechanism for #name #type_generics #where_clause {
                const COORDINATES: usize = 0;
                const ROWS: usize = 0;
                const PARAMETERS: usize = 0;
                const INPUTS: usize = 0;
                #(#types)*
                fn model() -> &'static __kin::Model { ::core::unimplemented!() }
                fn parameters<T: __kin::Scalar>(&self) -> [T; 0] { [] }
                fn set_parameter(&mut self, _: usize, _: f64) -> bool { false }
                fn evaluate_with<T: __kin::Scalar>(
                    &self, _: &[T], _: __kin::Subset, _: &__kin::Instant<'_, T>, _: &[T], _: &[T],
                    _: &mut __kin::Workspace<Self, T>,
                ) #nothing
                fn observe_with<T: __kin::Scalar>(
                    &self, _: &[T], _: &__kin::Instant<'_, T>, _: &[T], _: &[T],
                    _: &mut __kin::Observations<Self, T>,
                ) #nothing
                fn write_geometry<T: __kin::Scalar>(
                    &self, _: &[T], _: &__kin::Instant<'_, T>, _: &mut [T],
                ) #nothing
                fn write_guesses<T: __kin::Scalar>(&self, _: &[T], _: &mut [T]) #nothing
            }
            #default
        };
    }
}

/// True when every field of the struct has a default, so that the user may count on `Default`.
pub(crate) fn promises_default(item: TokenStream) -> bool {
    let Ok(item) = syn::parse2::<ItemStruct>(item) else { return false };
    let derived = |attribute: &syn::Attribute| {
        attribute.path().is_ident("derive") && quote!(#attribute).to_string().contains("Default")
    };
    let has_default = |field: &syn::Field| {
        let tokens = field.attrs.iter().find(|a| a.path().is_ident("param")).and_then(|a| match &a.meta {
            syn::Meta::List(list) => Some(list.tokens.clone()),
            _ => None,
        });
        let first = tokens.and_then(|tokens| tokens.into_iter().next());
        first.is_some_and(|first| first.to_string() != "unit")
    };
    !item.attrs.iter().any(derived) && item.fields.iter().all(has_default)
}

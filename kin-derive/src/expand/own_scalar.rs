//! Evaluation in the struct's own scalar type.

use super::generics::{bounded, scalars};
use super::parameters;
use super::rows::{Evaluations, lengths};
use crate::lower::Lowered;
use proc_macro2::TokenStream;
use quote::quote;

/// An implementation without rows, for a description with errors.
pub(crate) fn placeholder(lowered: &Lowered) -> TokenStream {
    let scalars = scalars(lowered);
    let &[scalar] = scalars.as_slice() else { return TokenStream::new() };
    let name = &lowered.item.ident;
    let generics = bounded(lowered, "Scalar");
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let at = quote! { _: &__kin::Instant<'_, #scalar>, _: &[#scalar], _: &[#scalar] };
    let room = quote! { __kin::Evaluation<[#scalar; 0], [#scalar; 0]> };
    let nothing = quote! { -> __kin::Result<(), __kin::LengthError> { __kin::Ok(()) } };
    quote! {
        #[automatically_derived]
        impl #impl_generics __kin::GenericMechanism for #name #type_generics #where_clause {
            type Scalar = #scalar;
            type Parameters = [#scalar; 0];
            type Workspace = #room;
            type Observations = #room;
            fn own_workspace() -> #room { ::core::unimplemented!() }
            fn own_observations() -> #room { ::core::unimplemented!() }
            fn own_parameters(&self) -> [#scalar; 0] { [] }
            fn evaluate_own(&self, _: __kin::Subset, #at, _: &mut #room) #nothing
            fn observe_own(&self, #at, _: &mut #room) #nothing
        }
    }
}

/// Evaluation in the struct's own scalar type, if it has exactly one such type parameter.
pub(super) fn own(lowered: &Lowered, evaluations: &Evaluations) -> TokenStream {
    let scalars = scalars(lowered);
    let &[scalar] = scalars.as_slice() else { return TokenStream::new() };
    let name = &lowered.item.ident;
    let generics = bounded(lowered, "Scalar");
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let [p, s, entries, seen, seen_entries] = evaluations.counts;
    let Evaluations { evaluate, observe, .. } = evaluations;
    let (lengths, own_parameters) = (lengths(scalar), parameters::own(lowered, scalar));
    quote! {
        #[automatically_derived]
        impl #impl_generics __kin::GenericMechanism for #name #type_generics #where_clause {
            type Scalar = #scalar;
            type Parameters = [#scalar; #p];
            type Workspace = __kin::Evaluation<[#scalar; #s], [#scalar; #entries]>;
            type Observations = __kin::Evaluation<[#scalar; #seen], [#scalar; #seen_entries]>;

            fn own_workspace() -> Self::Workspace { __kin::Evaluation::new(&__MODEL.constraint_pattern) }

            fn own_observations() -> Self::Observations { __kin::Evaluation::new(&__MODEL.observable_pattern) }

            #own_parameters

            fn evaluate_own(
                &self,
                subset: __kin::Subset,
                at: &__kin::Instant<'_, #scalar>,
                q: &[#scalar],
                q_dot: &[#scalar],
                workspace: &mut Self::Workspace,
            ) -> __kin::Result<(), __kin::LengthError> {
                let parameters: &[#scalar] = &__kin::GenericMechanism::own_parameters(self);
                #lengths
                #evaluate
                __kin::Ok(())
            }

            fn observe_own(
                &self,
                at: &__kin::Instant<'_, #scalar>,
                q: &[#scalar],
                q_dot: &[#scalar],
                observations: &mut Self::Observations,
            ) -> __kin::Result<(), __kin::LengthError> {
                let parameters: &[#scalar] = &__kin::GenericMechanism::own_parameters(self);
                #lengths
                #observe
                __kin::Ok(())
            }
        }
    }
}

//! The methods that evaluate rows, for any scalar type and for the struct's own.

use super::kernel::kernel;
use crate::lower::Lowered;
use kin_core::kernels::Kernels;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// Statements that check the lengths of an evaluation's arguments, with rates or for a position alone.
pub(super) fn lengths(scalar: &Ident) -> TokenStream {
    let position = position_lengths(scalar, "q");
    quote! {
        #position
        let q_dot: &__Coordinates<#scalar> = __kin::fixed("q_dot", q_dot)?;
    }
}

pub(super) fn position_lengths(scalar: &Ident, q: &str) -> TokenStream {
    let name = Ident::new(q, Span::call_site());
    quote! {
        let p: &__Parameters<#scalar> = __kin::fixed("parameters", parameters)?;
        let u: &__Inputs<#scalar> = __kin::fixed("inputs", at.inputs)?;
        let #name: &__Coordinates<#scalar> = __kin::fixed(#q, #name)?;
    }
}

/// A method of the trait that takes parameters and an instant before its `arguments`, and reports wrong lengths.
pub(super) fn method(
    inline: &TokenStream,
    name: &str,
    arguments: &TokenStream,
    statements: &TokenStream,
) -> TokenStream {
    let name = Ident::new(name, Span::call_site());
    quote! {
        #inline
        fn #name<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            #arguments
        ) -> __kin::Result<(), __kin::LengthError> {
            #statements
        }
    }
}

/// Functions beside the trait's implementation, and the statements that call them.
pub(super) struct Evaluations {
    pub(super) items: TokenStream,
    /// Evaluates Φ alone, so that scalar types that need only Φ (dual numbers) compile nothing else.
    pub(super) values: TokenStream,
    /// Evaluates a subset of Φ, Φ_q, Φ_t and γ.
    pub(super) evaluate: TokenStream,
    /// Evaluates all four parts of the observables.
    pub(super) observe: TokenStream,
    /// The numbers of parameters, rows, non-zeros, observables, and non-zeros of the observables.
    pub(super) counts: [usize; 5],
}

/// The evaluations of rows.
pub(super) fn evaluations(lowered: &Lowered, kernels: &Kernels, parameters: usize) -> Evaluations {
    let Kernels { values, values_and_jacobian, jacobian_and_rates, everything, observe, .. } = kernels;
    let [values, position, velocity, all, observe] =
        [values, values_and_jacobian, jacobian_and_rates, everything, observe].map(|program| kernel(lowered, program));
    let items = [&values, &position, &velocity, &all, &observe].map(|kernel| &kernel.item);
    let items = quote! { #(#items)* };
    let (values, observe) = (values.call, observe.call);
    let [position, velocity, all] = [position, velocity, all].map(|kernel| kernel.call);
    let [rows, observables] = [&kernels.constraint_pattern, &kernels.observable_pattern];
    Evaluations {
        items,
        evaluate: quote! {
            let (phi, phi_q, phi_t, gamma) = workspace.parts_mut();
            let _ = (p, u, q, q_dot, &phi, &phi_q, &phi_t, &gamma);
            if subset.gamma || subset.phi && subset.phi_t {
                #all
            } else if subset.phi_t {
                #velocity
            } else if subset.phi_q {
                #position
            } else if subset.phi {
                #values
            }
        },
        observe: quote! {
            let (phi, phi_q, phi_t, gamma) = observations.parts_mut();
            let _ = (p, u, q, q_dot, &phi, &phi_q, &phi_t, &gamma);
            #observe
        },
        values,
        counts: [parameters, rows.rows, rows.entries.len(), observables.rows, observables.entries.len()],
    }
}

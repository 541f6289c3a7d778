//! The methods that write lists of numbers, and points of curves.

use super::kernel::kernel;
use crate::lower::Lowered;
use kin_core::expr::Symbol;
use kin_core::kernels::{Given, Kernels, List};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// One method for every list.
pub(super) fn lists(lowered: &Lowered, kernels: &Kernels) -> TokenStream {
    kernels.lists.iter().map(|of| list(lowered, of)).collect()
}

fn list(lowered: &Lowered, list: &List) -> TokenStream {
    let printed = kernel(lowered, &list.kernel);
    let (item, call, length, name) = (printed.item, printed.call, list.length, list.name);
    let [method, argument] = [list.method, name].map(|name| Ident::new(name, Span::call_site()));
    let known = [
        (
            Given::Parameters,
            quote! { parameters: &[__T] },
            quote! { p: &__Parameters<__T> },
            "parameters",
            quote! { parameters },
        ),
        (
            Given::Instant,
            quote! { at: &__kin::Instant<'_, __T> },
            quote! { u: &__Inputs<__T> },
            "inputs",
            quote! { at.inputs },
        ),
        (Given::Position, quote! { q: &[__T] }, quote! { q: &__Coordinates<__T> }, "q", quote! { q }),
        (Given::Velocity, quote! { q_dot: &[__T] }, quote! { w: &__Coordinates<__T> }, "q_dot", quote! { q_dot }),
        (
            Given::Acceleration,
            quote! { q_ddot: &[__T] },
            quote! { acceleration: &__Coordinates<__T> },
            "q_ddot",
            quote! { q_ddot },
        ),
        (Given::Multipliers, quote! { right: &[__T] }, quote! { right: &__Rows<__T> }, "multipliers", quote! { right }),
    ];
    let known = || known.iter().filter(|(given, ..)| *given <= list.given);
    let arguments = known().map(|(_, argument, ..)| argument);
    // If the multipliers are not read, they may be an empty list.
    let is_read = |given: Given| given != Given::Multipliers || list.kernel.reads().contains(&Symbol::Right(0));
    let lengths = known()
        .filter(|(given, ..)| is_read(*given))
        .map(|(_, _, local, what, value)| quote! { let #local = __kin::fixed(#what, #value)?; });
    let locals = ["p", "u", "q", "w", "acceleration", "right"].map(|local| Ident::new(local, Span::call_site()));
    let locals = known().zip(&locals).map(|(_, local)| local);
    quote! {
        #[inline]
        fn #method<__T: __kin::Scalar>(
            &self, #(#arguments,)* #argument: &mut [__T],
        ) -> __kin::Result<(), __kin::LengthError> {
            #item
            #(#lengths)*
            let out: &mut [__T; #length] = __kin::fixed_mut(#name, #argument)?;
            let _ = (#(#locals,)* &out);
            #call
            __kin::Ok(())
        }
    }
}

/// The method that evaluates the curves of joints, for drawings; empty for a mechanism without curves.
pub(super) fn curves(lowered: &Lowered, kernels: &Kernels) -> TokenStream {
    if kernels.curves.is_empty() {
        return TokenStream::new();
    }
    let arms = kernels.curves.iter().map(|(joint, of)| {
        let printed = kernel(lowered, of);
        let (item, call) = (printed.item, printed.call);
        quote! { #joint => { #item #call } }
    });
    quote! {
        fn curve_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            joint: usize,
            s: __T,
        ) -> __kin::Result<__kin::Option<__kin::CurvePoint<__T>>, __kin::LengthError> {
            let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
            let u: &__Inputs<__T> = __kin::fixed("inputs", at.inputs)?;
            let out: &mut [__T; 4] = &mut [<__T as __kin::Scalar>::from_f64(0.0); 4];
            let _ = (p, u, s);
            match joint {
                #(#arms)*
                _ => return __kin::Ok(__kin::None),
            }
            __kin::Ok(__kin::Some(__kin::CurvePoint { r: [out[0], out[1]], tangent: [out[2], out[3]] }))
        }
    }
}

//! The methods that write lists of numbers, and points of curves.

use super::kernel::kernel;
use crate::lower::Lowered;
use kin_core::expr::Symbol;
use kin_core::kernels::{Given, Kernels, List};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// One method for every list.
pub(super) fn lists(lowered: &Lowered, kernels: &Kernels) -> TokenStream {
    kernels.lists.iter().map(|list_of_kernels| list(lowered, list_of_kernels)).collect()
}

/// The data from which lists are computed: for each the argument, the local variable and the type of the array with the
/// right length, and the name in the error about a wrong length.
const KNOWN: [(Given, [&str; 3], &str); 6] = [
    (Given::Parameters, ["parameters", "p", "__Parameters"], "parameters"),
    (Given::Instant, ["at", "u", "__Inputs"], "inputs"),
    (Given::Position, ["q", "q", "__Coordinates"], "q"),
    (Given::Velocity, ["q_dot", "q_dot", "__Coordinates"], "q_dot"),
    (Given::Acceleration, ["q_ddot", "q_ddot", "__Coordinates"], "q_ddot"),
    (Given::Multipliers, ["right", "right", "__Rows"], "multipliers"),
];

fn list(lowered: &Lowered, list: &List) -> TokenStream {
    let printed = kernel(lowered, &list.kernel);
    let (item, call, length, name) = (printed.item, printed.call, list.length, list.name);
    let (item, call) = match list.of_multipliers.as_ref().map(|multipliers_kernel| kernel(lowered, multipliers_kernel))
    {
        None => (item, call),
        Some(given) => {
            let (of_given, call_given) = (given.item, given.call);
            let either = quote! {
                if right.is_empty() { #item #call } else {
                    let right: &__Rows<__T> = __kin::fixed("multipliers", right)?;
                    #of_given
                    #call_given
                }
            };
            (TokenStream::new(), either)
        }
    };
    let [method, argument] = [list.method, name].map(|name| Ident::new(name, Span::call_site()));
    let (mut arguments, mut lengths, mut locals) = (Vec::new(), Vec::new(), Vec::new());
    for (given, names, words) in KNOWN.iter().filter(|(given, ..)| *given <= list.given) {
        let [argument, local, array] = names.map(|name| Ident::new(name, Span::call_site()));
        let (ty, value) = match given {
            Given::Instant => (quote! { &__kin::Instant<'_, __T> }, quote! { #argument.inputs }),
            _ => (quote! { &[__T] }, quote! { #argument }),
        };
        arguments.push(quote! { #argument: #ty });
        // If the multipliers are not read, they may be an empty list.
        if *given != Given::Multipliers || list.kernel.reads().contains(&Symbol::Right(0)) {
            lengths.push(quote! { let #local: &#array<__T> = __kin::fixed(#words, #value)?; });
        }
        locals.push(local);
    }
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
    let arms = kernels.curves.iter().map(|(joint, program)| {
        let printed = kernel(lowered, program);
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

//! Kernels as functions beside the trait's implementation, and their calls.

use super::code::body;
use super::functions::{Supplied, functions};
use super::instructions::{argument, function_names, target_name};
use crate::lower::Lowered;
use kin_core::expr::Symbol;
use kin_core::kernels::Kernel;
use kin_core::program::Slot;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

/// A kernel printed as a function item, and a call of it.
pub(crate) struct Printed {
    pub(crate) item: TokenStream,
    pub(crate) call: TokenStream,
}

/// Prints a kernel.
///
/// The function is outside of the implementation, without the generics of the struct. It therefore takes supplied
/// functions as arguments of generic types. A function that is not inlined is compiled for several instruction sets if
/// the scalar type gains by it; inlined ones are compiled with their caller.
pub(crate) fn kernel(lowered: &Lowered, kernel: &Kernel) -> Printed {
    let ident = |name: &str| Ident::new(name, Span::call_site());
    let (name, writes) = (ident(&kernel.name), kernel.writes());
    let (mut names, mut arguments, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for symbol in kernel.reads() {
        let Some(ty) = type_of(symbol, kernel, &writes) else { continue };
        let argument = ident(argument(symbol));
        names.push(argument.clone());
        arguments.push(quote! { #argument: #ty });
        values.push(if symbol == Symbol::Time {
            quote! { at.t }
        } else {
            quote! { #argument }
        });
    }
    let (mut types, called) = (Vec::new(), kernel.functions());
    let functions = if called.is_empty() { Vec::new() } else { functions(lowered) };
    for number in called {
        let Some(function) = functions.get(number as usize) else { continue };
        let [argument, higher] = function_names(number);
        let [ty, higher_ty] = [format_ident!("__Function{number}"), format_ident!("__Derivatives{number}")];
        arguments.push(quote! { #argument: &#ty, #higher: &#higher_ty });
        names.extend([argument.clone(), higher.clone()]);
        let Supplied { value, derivatives } = function;
        values.push(quote! { &#value, &#derivatives });
        types.push(quote! { #ty: ::core::ops::Fn(f64) -> [f64; 3] });
        types.push(quote! { #higher_ty: ::core::ops::Fn(f64, &mut [f64]) -> usize });
    }
    for (slot, length) in writes {
        let target = ident(target_name(slot));
        names.push(target.clone());
        arguments.push(quote! { #target: &mut [__T; #length] });
        values.push(quote! { #target });
    }
    if arguments.is_empty() {
        return Printed { item: TokenStream::new(), call: TokenStream::new() };
    }
    let statements = body(&kernel.code);
    let head = quote! { <__T: __kin::Scalar #(, #types)*>(#(#arguments),*) };
    let item = if kernel.inlined {
        quote! {
            #[inline(always)]
            fn #name #head { #statements }
        }
    } else {
        // The inner function is needed because the compiler knows that the arguments of a function do not overlap, but
        // not that the captures of a closure do not.
        quote! {
            #[inline]
            fn #name #head {
                #[inline(always)]
                fn body #head { #statements }
                <__T as __kin::Scalar>::dispatch(#[inline(always)] || body(#(#names),*))
            }
        }
    };
    Printed { item, call: quote! { #name(#(#values),*); } }
}

/// The type of the argument from which a symbol is read; `None` where there is no argument.
fn type_of(symbol: Symbol, kernel: &Kernel, writes: &[(Slot, usize)]) -> Option<TokenStream> {
    Some(match symbol {
        Symbol::Coarseness => return None,
        // An array that a kernel both reads and writes is a single argument.
        Symbol::Saved(_) if writes.iter().any(|(slot, _)| matches!(slot, Slot::Saved(_))) => return None,
        Symbol::Saved(_) => {
            let saved = kernel.saved;
            quote! { &[__T; #saved] }
        }
        Symbol::Time | Symbol::ARGUMENT => quote! { __T },
        Symbol::Parameter(_) => quote! { &__Parameters<__T> },
        Symbol::Input(..) => quote! { &__Inputs<__T> },
        Symbol::Mode(_) => quote! { &__Modes<__T> },
        Symbol::Right(_) => quote! { &__Rows<__T> },
        Symbol::Coordinate(_) | Symbol::Rate(_) | Symbol::Acceleration(_) | Symbol::Start(_) | Symbol::Unknown(_) => {
            quote! { &__Coordinates<__T> }
        }
    })
}

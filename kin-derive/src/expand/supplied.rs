//! The items for supplied functions: a private trait with a method for each, and the methods that evaluate them by
//! index.

use super::functions::{calls, derivatives_helper, element_type, enclosure_helper, fields, helper};
use super::generics::of_functions;
use crate::lower::Lowered;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// A private trait with one method for every field of functions.
///
/// All evaluations of a function go through its method, so that a type that does not implement `ScalarFunction` is
/// reported once.
pub(crate) fn helpers(lowered: &Lowered) -> TokenStream {
    let (mut heads, mut bodies) = (Vec::new(), Vec::new());
    for (number, field) in fields(lowered).enumerate().filter(|(_, field)| field.len != Some(0)) {
        let (helper, ident, ty) = (helper(number), &field.ident, element_type(field));
        let derivatives = derivatives_helper(number);
        let (index, function) = match field.len {
            None => (None, quote! { &self.#ident }),
            Some(len) => {
                let all_but_last = (0..len - 1).map(Literal::usize_unsuffixed);
                let last = Literal::usize_unsuffixed(len - 1);
                let function =
                    quote! { match k { #(#all_but_last => &self.#ident[#all_but_last],)* _ => &self.#ident[#last] } };
                (Some(quote! { k: usize, }), function)
            }
        };
        let head = quote! { fn #helper(&self, #index x: f64) -> [f64; 3] };
        bodies.push(quote! { #[inline] #head { <#ty as __kin::ScalarFunction>::evaluate(#function, x) } });
        heads.push(head);
        let head = quote! { fn #derivatives(&self, #index x: f64, out: &mut [f64]) -> usize };
        bodies.push(quote! { #[inline] #head { <#ty as __kin::ScalarFunction>::derivatives(#function, x, out) } });
        heads.push(head);
        let enclosure = enclosure_helper(number);
        let head = quote! { fn #enclosure(&self, #index x: __kin::Interval) -> __kin::Interval };
        bodies.push(quote! { #[inline] #head { <#ty as __kin::ScalarFunction>::enclose(#function, x) } });
        heads.push(head);
    }
    if heads.is_empty() {
        return TokenStream::new();
    }
    let name = &lowered.item.ident;
    let generics = of_functions(lowered);
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    quote! {
        trait __Functions {
            #(#heads;)*
        }

        #[automatically_derived]
        impl #impl_generics __Functions for #name #type_generics #where_clause {
            #(#bodies)*
        }
    }
}

/// The methods `evaluate_function` and `enclose_function`, if there is a supplied function.
pub(crate) fn access(lowered: &Lowered) -> TokenStream {
    let [values, enclosures] = [helper, enclosure_helper].map(|helper| calls(lowered, helper, &quote! { x }));
    if values.is_empty() {
        return TokenStream::new();
    }
    let arms = values.iter().enumerate().map(|(number, call)| quote! { #number => __kin::Some(#call), });
    let enclosing = enclosures.iter().enumerate().map(|(number, call)| quote! { #number => #call, });
    quote! {
        fn evaluate_function(&self, index: usize, x: f64) -> __kin::Option<[f64; 3]> {
            match index {
                #(#arms)*
                _ => { let _ = x; __kin::None }
            }
        }

        fn enclose_function(&self, index: usize, x: __kin::Interval) -> __kin::Interval {
            match index {
                #(#enclosing)*
                _ => { let _ = x; __kin::Interval::UNDEFINED }
            }
        }
    }
}

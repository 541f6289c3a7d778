//! Supplied functions: fields whose types implement `ScalarFunction`.

use super::kernel::Supplied;
use super::list;
use crate::lower::{Field, FieldRole, Lowered};
use kin_core::expr::{ExprId, Node};
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use syn::Type;

/// The fields with supplied functions, in the order of the constraint set.
fn fields(lowered: &Lowered) -> impl Iterator<Item = &Field> {
    let field_of = |number: usize| lowered.fields.iter().find(move |field| field.role == FieldRole::Function(number));
    (0..lowered.mechanism.functions.len()).filter_map(field_of)
}

/// Calls of what [`helpers`] writes, element by element: `helper` names the method of a field, `arguments` are its last.
fn calls(lowered: &Lowered, helper: fn(usize) -> Ident, arguments: &TokenStream) -> Vec<TokenStream> {
    let elements = fields(lowered).enumerate().flat_map(|(number, field)| {
        let helper = helper(number);
        (0..field.len.unwrap_or(1)).map(move |k| match field.len {
            None => quote! { __Functions::#helper(self, #arguments) },
            Some(_) => quote! { __Functions::#helper(self, #k, #arguments) },
        })
    });
    elements.collect()
}

fn helper(number: usize) -> Ident {
    format_ident!("function_{number}")
}

fn derivatives_helper(number: usize) -> Ident {
    format_ident!("derivatives_{number}")
}

/// One method for every field with functions, in a trait that nobody sees.
///
/// Whatever evaluates a function goes through it, so that a type that is no function is used, and told so, once.
pub(crate) fn helpers(lowered: &Lowered) -> TokenStream {
    let (mut heads, mut bodies) = (Vec::new(), Vec::new());
    for (number, field) in fields(lowered).enumerate().filter(|(_, field)| field.len != Some(0)) {
        let (helper, ident, ty) = (helper(number), &field.ident, function_type(field));
        let derivatives = derivatives_helper(number);
        let (place, function) = match field.len {
            None => (None, quote! { &self.#ident }),
            Some(len) => {
                let others = (0..len - 1).map(Literal::usize_unsuffixed);
                let last = Literal::usize_unsuffixed(len - 1);
                let function = quote! { match k { #(#others => &self.#ident[#others],)* _ => &self.#ident[#last] } };
                (Some(quote! { k: usize, }), function)
            }
        };
        let head = quote! { fn #helper(&self, #place x: f64) -> [f64; 3] };
        bodies.push(quote! { #[inline] #head { <#ty as __kin::ScalarFunction>::evaluate(#function, x) } });
        heads.push(head);
        let head = quote! { fn #derivatives(&self, #place x: f64, out: &mut [f64]) -> usize };
        bodies.push(quote! { #[inline] #head { <#ty as __kin::ScalarFunction>::derivatives(#function, x, out) } });
        heads.push(head);
    }
    if heads.is_empty() {
        return TokenStream::new();
    }
    let name = &lowered.item.ident;
    let generics = super::generics::of_functions(lowered);
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

/// The type of the elements of an array.
fn element(ty: &Type) -> &Type {
    match ty {
        Type::Array(array) => &array.elem,
        Type::Group(group) => element(&group.elem),
        Type::Paren(paren) => element(&paren.elem),
        _ => ty,
    }
}

/// The types of all supplied functions.
pub(crate) fn types(lowered: &Lowered) -> impl Iterator<Item = &Type> {
    let is_function = |role| matches!(role, FieldRole::Function(_));
    lowered.fields.iter().filter(move |field| is_function(field.role)).map(function_type)
}

fn function_type(field: &Field) -> &Type {
    if field.len.is_some() { element(&field.ty) } else { &field.ty }
}

/// The supplied functions as closures over `self`.
pub(crate) fn functions(lowered: &Lowered) -> Vec<Supplied> {
    let values = calls(lowered, helper, &quote! { x });
    let derivatives = calls(lowered, derivatives_helper, &quote! { x, out });
    let closures = |(value, derivatives)| Supplied {
        value: quote! { |x: f64| #value },
        derivatives: quote! { |x: f64, out: &mut [f64]| #derivatives },
    };
    values.into_iter().zip(derivatives).map(closures).collect()
}

/// Every (function, argument) at which a supplied function is evaluated, once.
pub(crate) fn arguments(system: &KinematicSystem) -> Vec<(u32, ExprId)> {
    let (set, graph) = (&system.set, &system.set.graph);
    let equations = system.equations.iter().chain(&system.observables);
    let differentiated = equations.flat_map(|equation| {
        let entries = equation.phi_q.iter().map(|(_, entry)| *entry);
        entries.chain([equation.phi, equation.phi_t, equation.gamma])
    });
    let others = set.geometry.iter().copied().chain(set.guesses.iter().map(|(_, value)| *value));
    let mut all = Vec::new();
    for id in graph.reachable(differentiated.chain(others)) {
        if let Node::Supplied(function, _, argument) = graph.node(id)
            && !all.contains(&(function, argument))
        {
            all.push((function, argument));
        }
    }
    all
}

/// `fn evaluate_function` and `fn write_arguments`, where there is a supplied function.
pub(crate) fn access(lowered: &Lowered, system: &KinematicSystem) -> TokenStream {
    let calls = calls(lowered, helper, &quote! { x });
    if calls.is_empty() {
        return TokenStream::new();
    }
    let arms = calls.iter().enumerate().map(|(number, call)| quote! { #number => __kin::Some(#call), });
    let arguments = list(lowered, system, arguments(system).into_iter().map(|(_, argument)| argument));
    quote! {
        fn evaluate_function(&self, index: usize, x: f64) -> __kin::Option<[f64; 3]> {
            match index {
                #(#arms)*
                _ => { let _ = x; __kin::None }
            }
        }

        fn write_arguments<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            q: &[__T],
            arguments: &mut [__T],
        ) -> __kin::Result<(), __kin::LengthError> {
            let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
            let u: &__Inputs<__T> = __kin::fixed("inputs", at.inputs)?;
            let q: &__Coordinates<__T> = __kin::fixed("q", q)?;
            let out = __kin::fixed_mut("arguments", arguments)?;
            let _ = (p, u, q);
            #arguments
            __kin::Ok(())
        }
    }
}

//! Supplied functions: fields whose types implement `ScalarFunction`.

use super::kernel::Supplied;
use super::list;
use crate::lower::{FieldRole, Lowered};
use kin_core::expr::{ExprId, Node};
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::Type;

/// A supplied function: its type as the user wrote it, where a type that is none is told so, and where it is.
struct Place<'a> {
    ty: &'a Type,
    place: TokenStream,
}

/// All supplied functions, element by element, in the order of the constraint set.
fn places(lowered: &Lowered) -> Vec<Place<'_>> {
    let field_of = |number: usize| lowered.fields.iter().find(|field| field.role == FieldRole::Function(number));
    let fields = (0..lowered.mechanism.functions.len()).filter_map(field_of);
    let elements = fields.flat_map(|field| {
        let ident = &field.ident;
        (0..field.len.unwrap_or(1)).map(move |k| match field.len {
            None => Place { ty: &field.ty, place: quote! { self.#ident } },
            Some(_) => Place { ty: element(&field.ty), place: member(ident, k) },
        })
    });
    elements.collect()
}

fn member(ident: &Ident, k: usize) -> TokenStream {
    let k = Literal::usize_unsuffixed(k);
    quote! { self.#ident[#k] }
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
    let fields = lowered.fields.iter().filter(move |field| is_function(field.role));
    fields.map(|field| if field.len.is_some() { element(&field.ty) } else { &field.ty })
}

/// The supplied functions as closures over `self`.
pub(crate) fn functions(lowered: &Lowered) -> Vec<Supplied> {
    let closure = |Place { ty, place }: Place<'_>| Supplied {
        closure: quote! { |x: f64| <#ty as __kin::ScalarFunction>::evaluate(&#place, x) },
    };
    places(lowered).into_iter().map(closure).collect()
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
    let places = places(lowered);
    if places.is_empty() {
        return TokenStream::new();
    }
    let arms = places.iter().enumerate().map(|(number, Place { ty, place })| {
        quote! { #number => __kin::Some(<#ty as __kin::ScalarFunction>::evaluate(&#place, x)), }
    });
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

//! Supplied functions: fields whose types implement `ScalarFunction`.

use crate::lower::{Field, FieldRole, Lowered};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::Type;

/// The fields with supplied functions, in the order of the constraint set.
pub(super) fn fields(lowered: &Lowered) -> impl Iterator<Item = &Field> {
    let field_of = |number: usize| lowered.fields.iter().find(move |field| field.role == FieldRole::Function(number));
    (0..lowered.mechanism.functions.len()).filter_map(field_of)
}

/// Calls of the methods that [`helpers`] writes, one per element: `helper` gives the method of a field, `arguments` are
/// the last arguments.
pub(super) fn calls(lowered: &Lowered, helper: fn(usize) -> Ident, arguments: &TokenStream) -> Vec<TokenStream> {
    let elements = fields(lowered).enumerate().flat_map(|(number, field)| {
        let helper = helper(number);
        (0..field.len.unwrap_or(1)).map(move |k| match field.len {
            None => quote! { __Functions::#helper(self, #arguments) },
            Some(_) => quote! { __Functions::#helper(self, #k, #arguments) },
        })
    });
    elements.collect()
}

pub(super) fn helper(number: usize) -> Ident {
    format_ident!("function_{number}")
}

pub(super) fn derivatives_helper(number: usize) -> Ident {
    format_ident!("derivatives_{number}")
}

pub(super) fn enclosure_helper(number: usize) -> Ident {
    format_ident!("enclosure_{number}")
}

/// The element type of an array type.
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
    lowered.fields.iter().filter(move |field| is_function(field.role)).map(element_type)
}

/// The type of a field, or of the elements of an array field.
pub(super) fn element_type(field: &Field) -> &Type {
    if field.len.is_some() { element(&field.ty) } else { &field.ty }
}

/// A supplied function for generated code: closures that evaluate a field, or an element of an array field.
pub(crate) struct Supplied {
    /// The closure `|x| …` over `self`, which returns (f, f′, f″).
    pub(crate) value: TokenStream,
    /// The closure `|x, out| …`, which writes f, f′, f″, … as far as they are known.
    pub(crate) derivatives: TokenStream,
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

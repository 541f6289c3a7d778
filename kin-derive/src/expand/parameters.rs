//! The parameters of a mechanism: from fields to numbers, and back.

use super::functions::element_type;
use super::generics::bounded;
use super::handles::mentions;
use super::instructions::literal;
use crate::lower::{FieldRole, Lowered};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// A field with the indices of its parameters.
struct ParameterField<'a> {
    ident: &'a proc_macro2::Ident,
    /// The type of its numbers with the user's span, where the compiler reports a type that is not a number.
    ty: &'a syn::Type,
    len: Option<usize>,
    first: usize,
    default: Option<&'a [f64]>,
    /// The type parameter that is the type of the field's numbers.
    scalar: Option<&'a proc_macro2::Ident>,
}

fn fields(lowered: &Lowered) -> Vec<ParameterField<'_>> {
    let mut first = 0;
    (lowered.fields.iter())
        .filter_map(|field| match field.role {
            FieldRole::Parameter(k) => Some((field, lowered.mechanism.parameters.get(k)?)),
            FieldRole::Function(_) => None,
        })
        .map(|(field, parameter)| {
            let of_parameter = ParameterField {
                ident: &field.ident,
                ty: element_type(field),
                len: parameter.len,
                first,
                default: parameter.default.as_deref(),
                scalar: field.scalar.as_ref(),
            };
            first += parameter.len.unwrap_or(1);
            of_parameter
        })
        .collect()
}

/// The method `parameters`.
pub(crate) fn read(lowered: &Lowered) -> TokenStream {
    let fields = fields(lowered);
    let total: usize = lowered.mechanism.parameters.iter().map(|p| p.len.unwrap_or(1)).sum();
    let reads = fields.iter().map(|field| {
        let (ident, first) = (field.ident, Literal::usize_unsuffixed(field.first));
        let ty = field.ty;
        let get = quote! { <#ty as __kin::Parameter>::get };
        match field.len {
            None => quote! { out[#first] = <__T as __kin::Scalar>::from_f64(#get(&self.#ident)); },
            Some(len) => quote! {
                for k in 0..#len {
                    out[#first + k] = <__T as __kin::Scalar>::from_f64(#get(&self.#ident[k]));
                }
            },
        }
    });
    let body = if total == 0 {
        quote! { [] }
    } else {
        quote! {
            let mut out = [<__T as __kin::Scalar>::from_f64(0.0); #total];
            #(#reads)*
            out
        }
    };
    quote! {
        #[inline]
        fn parameters<__T: __kin::Scalar>(&self) -> [__T; #total] { #body }
    }
}

/// The method `own_parameters`: fields of the scalar type are copied, the others are converted.
pub(crate) fn own(lowered: &Lowered, scalar: &proc_macro2::Ident) -> TokenStream {
    let total: usize = lowered.mechanism.parameters.iter().map(|p| p.len.unwrap_or(1)).sum();
    let values = fields(lowered).into_iter().flat_map(|field| {
        let (ident, ty) = (field.ident, field.ty);
        (0..field.len.unwrap_or(1)).map(move |k| match (field.scalar, field.len) {
            (Some(_), None) => quote! { self.#ident },
            (Some(_), Some(_)) => quote! { self.#ident[#k] },
            (None, len) => {
                let index = len.map(|_| quote! { [#k] });
                quote! { <#scalar as __kin::Scalar>::from_f64(<#ty as __kin::Parameter>::get(&self.#ident #index)) }
            }
        })
    });
    quote! {
        #[inline]
        fn own_parameters(&self) -> [#scalar; #total] { [#(#values),*] }
    }
}

/// The method `set_parameter`. It also mentions all names, because it is rarely called and uses the fields.
pub(crate) fn write(lowered: &Lowered) -> TokenStream {
    let mentions = mentions(lowered);
    let arms = fields(lowered).into_iter().filter(|field| field.len != Some(0)).map(|field| {
        let (ident, first) = (field.ident, field.first);
        let last = first + field.len.unwrap_or(1);
        let (ty, index) = (field.ty, field.len.map(|_| quote! { [index - #first] }));
        quote! { #first..#last => { <#ty as __kin::Parameter>::set(&mut self.#ident #index, value); true } }
    });
    quote! {
        fn set_parameter(&mut self, index: usize, value: f64) -> bool {
            #mentions
            match index {
                #(#arms)*
                _ => { let _ = value; false }
            }
        }
    }
}

/// The implementation of `Default`, if every field has a default value and the struct does not derive it.
pub(crate) fn default(lowered: &Lowered) -> TokenStream {
    let fields = fields(lowered);
    let complete = fields.len() == lowered.fields.len() && fields.iter().all(|field| field.default.is_some());
    if !complete || lowered.derives_default {
        return TokenStream::new();
    }
    let name = &lowered.item.ident;
    let generics = bounded(lowered, "Scalar");
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let values = fields.iter().map(|field| {
        let (ident, values) = (field.ident, field.default.unwrap_or_default());
        let values = values.iter().map(|value| literal(*value));
        let ty = field.ty;
        match (field.scalar, field.len) {
            (None, None) => quote! { #ident: #(<#ty as __kin::Parameter>::from_value(#values))*, },
            (None, Some(_)) => quote! { #ident: [#(#values),*].map(<#ty as __kin::Parameter>::from_value), },
            (Some(scalar), None) => quote! { #ident: #(<#scalar as __kin::Scalar>::from_f64(#values))*, },
            (Some(scalar), Some(_)) => quote! { #ident: [#(<#scalar as __kin::Scalar>::from_f64(#values)),*], },
        }
    });
    quote! {
        #[automatically_derived]
        impl #impl_generics __kin::Default for #name #type_generics #where_clause {
            fn default() -> Self {
                Self { #(#values)* }
            }
        }
    }
}

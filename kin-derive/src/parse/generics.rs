//! Type parameters of the struct: `struct FourBar<T> { l1: T, l: [T; 3] }`.

use crate::ast::{FieldDecl, text};
use crate::report::Report;
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Error, GenericParam, Generics, Ident, ItemStruct, Result, Type};

/// Names that generated code uses: neither the struct nor its parameters may have one of them.
const RESERVED: [&str; 7] = ["__T", "__Parameters", "__Inputs", "__Coordinates", "__Functions", "__MODEL", "__kin"];

/// Reports names that are reserved for generated code; true if there is one.
pub(super) fn reserved(item: &ItemStruct, report: &Report) -> bool {
    let before = report.count();
    let parameters = item.generics.params.iter().filter_map(|parameter| match parameter {
        GenericParam::Type(parameter) => Some(&parameter.ident),
        GenericParam::Const(parameter) => Some(&parameter.ident),
        GenericParam::Lifetime(_) => None,
    });
    for ident in parameters.chain([&item.ident]) {
        if RESERVED.contains(&text(ident).as_str()) {
            report.error(ident.span(), format!("`{ident}` is a name of the generated code; choose another one"));
        }
    }
    report.count() > before
}

/// Checks that the test of `#[mechanism(cross_check)]` can name a concrete type.
pub(super) fn testable(item: &ItemStruct, fields: &[FieldDecl], report: &Report) {
    for parameter in &item.generics.params {
        let ident = match parameter {
            GenericParam::Type(parameter) if parameter.default.is_none() => &parameter.ident,
            GenericParam::Const(parameter) if parameter.default.is_none() => &parameter.ident,
            _ => continue,
        };
        if !fields.iter().any(|field| field.scalar.as_ref() == Some(ident)) {
            let message = format!(
                "`cross_check` tests the mechanism with its defaults, and `{ident}` has none; give it one, or call \
                 `Kinematics::cross_check` in a test of your own"
            );
            report.error(ident.span(), message);
        }
    }
}

/// The names of the type parameters.
pub(super) fn type_parameters(generics: &Generics) -> Vec<Ident> {
    generics.type_params().map(|parameter| parameter.ident.clone()).collect()
}

/// The type parameter that is the type of a field's numbers: `T` for `T` and `[T; 3]`.
pub(super) fn scalar_parameter(ty: &Type, types: &[Ident]) -> Result<Option<Ident>> {
    match ty {
        Type::Group(group) => scalar_parameter(&group.elem, types),
        Type::Paren(paren) => scalar_parameter(&paren.elem, types),
        Type::Array(array) => scalar_parameter(&array.elem, types),
        Type::Path(path) if path.path.get_ident().is_some_and(|ident| types.contains(ident)) => {
            Ok(path.path.get_ident().cloned())
        }
        _ => match mentioned(ty.to_token_stream(), types) {
            None => Ok(None),
            Some(name) => Err(Error::new_spanned(
                ty,
                format!("a parameter is a number such as `{name}` or an array of numbers such as `[{name}; 10]`"),
            )),
        },
    }
}

/// The first type parameter in the tokens of a type.
pub(crate) fn mentioned(tokens: TokenStream, types: &[Ident]) -> Option<Ident> {
    tokens.into_iter().find_map(|tree| match tree {
        TokenTree::Ident(ident) => types.iter().find(|name| **name == ident).cloned(),
        TokenTree::Group(group) => mentioned(group.stream(), types),
        _ => None,
    })
}

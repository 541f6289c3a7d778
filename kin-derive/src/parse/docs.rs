//! Documentation of the struct, of its fields, and of names inside the parentheses of an attribute.

use syn::parse::ParseStream;
use syn::{Attribute, Error, Expr, ExprLit, Lit, Meta, Result};

/// The first paragraph of the doc comments among `attributes`, on one line.
pub(super) fn first_paragraph(attributes: &[Attribute]) -> String {
    let lines: Vec<String> = attributes.iter().filter_map(doc).collect();
    let text = lines.join("\n");
    text.lines()
        .map(str::trim)
        .skip_while(|line| line.is_empty())
        .take_while(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// Parses doc comments before a name inside the parentheses of an attribute.
pub(super) fn inner_doc(input: ParseStream) -> Result<String> {
    let attributes = Attribute::parse_outer(input)?;
    for attribute in &attributes {
        if !attribute.path().is_ident("doc") {
            let message = "only a doc comment, `/// …`, can stand here";
            return Err(Error::new_spanned(attribute, message));
        }
    }
    Ok(first_paragraph(&attributes))
}

fn doc(attribute: &Attribute) -> Option<String> {
    match &attribute.meta {
        Meta::NameValue(meta) if meta.path.is_ident("doc") => match &meta.value {
            Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

//! Reading on after a mistake: the parts of an attribute are separated by commas, and each is read for itself.

use super::flatten::flatten;
use super::reject::here;
use crate::report::Report;
use proc_macro2::TokenTree;
use syn::parse::ParseStream;
use syn::{Attribute, Ident, MacroDelimiter, Meta, MetaList, Result, Token};

/// Runs `read` over what stands in the brackets of our attribute; `form` shows how it is written.
///
/// `None` when there are no brackets or when `read` gave up; both are reported. A value with reported mistakes in it
/// is a value.
pub(super) fn inside<T>(
    attribute: &Attribute,
    keyword: &Ident,
    form: &str,
    report: &Report,
    read: impl FnOnce(ParseStream) -> Result<T>,
) -> Option<T> {
    let Meta::List(list) = &attribute.meta else {
        report.error(keyword.span(), format!("`{keyword}` is written `{form}`"));
        return None;
    };
    if !matches!(list.delimiter, MacroDelimiter::Paren(_)) {
        report.error(list.delimiter.span().open(), format!("`{keyword}` is written with parentheses: `{form}`"));
        return None;
    }
    let list = MetaList { tokens: flatten(list.tokens.clone()), ..list.clone() };
    let before = report.count();
    let mut value = None;
    let result = list.parse_args_with(|input: ParseStream| {
        value = Some(read(input)?);
        Ok(())
    });
    // Tokens that were skipped after a reported mistake come back as "unexpected token" at the end.
    match result {
        Err(error) if value.is_none() || report.count() == before => {
            report.push(error);
            None
        }
        _ => value,
    }
}

/// Reads parts separated by commas; false when one of them returned an error, which is reported.
pub(super) fn list(input: ParseStream, report: &Report, mut part: impl FnMut(ParseStream) -> Result<()>) -> bool {
    let mut complete = true;
    while !input.is_empty() {
        let before = report.count();
        complete &= report.ok(part(input)).is_some();
        if report.count() == before {
            report.ok(end_of_part(input));
        }
        skip_part(input);
        comma(input);
    }
    complete
}

/// An error unless a comma or the end follows.
pub(super) fn end_of_part(input: ParseStream) -> Result<()> {
    if input.is_empty() || input.peek(Token![,]) {
        Ok(())
    } else if input.peek(Token![=]) {
        Err(here(input, "an `=` too many; expected a comma"))
    } else {
        Err(here(input, "expected a comma before this"))
    }
}

/// Moves to the next comma or the end.
pub(super) fn skip_part(input: ParseStream) {
    skip_to(input, |input| input.peek(Token![,]));
}

/// Moves to the first token for which `stop` holds, or to the end.
pub(super) fn skip_to(input: ParseStream, stop: impl Fn(ParseStream) -> bool) {
    while !input.is_empty() && !stop(input) {
        // The second half of `==` is no `=`.
        let is_double =
            input.peek(Token![==]) || input.peek(Token![!=]) || input.peek(Token![<=]) || input.peek(Token![>=]);
        for _ in 0..1 + usize::from(is_double) {
            if input.parse::<TokenTree>().is_err() {
                return;
            }
        }
    }
}

/// Consumes a comma, if one follows.
pub(super) fn comma(input: ParseStream) {
    if input.peek(Token![,]) {
        // A comma that was seen can be read.
        _ = input.parse::<Token![,]>();
    }
}

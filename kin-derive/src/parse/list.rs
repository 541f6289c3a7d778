//! Error recovery: the parts of an attribute are separated by commas, and each part is parsed on its own.

use super::flatten::flatten;
use super::reject::here;
use crate::report::Report;
use proc_macro2::TokenTree;
use syn::parse::ParseStream;
use syn::{Attribute, Ident, MacroDelimiter, Meta, MetaList, Result, Token};

/// Calls `read` on the contents of an attribute's parentheses; `form` is an example for the message.
///
/// Returns `None` if there are no parentheses or `read` fails; both are reported. A value that was read despite
/// reported errors is returned.
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
    // Tokens that were skipped after a reported error cause the error "unexpected token" at the end, which is ignored.
    match result {
        Err(error) if value.is_none() || report.count() == before => {
            report.push(error);
            None
        }
        _ => value,
    }
}

/// Parses parts separated by commas; false when one of them failed, which is reported.
pub(super) fn list(input: ParseStream, report: &Report, mut part: impl FnMut(ParseStream) -> Result<()>) -> bool {
    let mut complete = true;
    while !input.is_empty() {
        let before = report.count();
        complete &= report.ok(part(input)).is_some();
        if report.count() == before && report.ok(end_of_part(input)).is_none() && input.peek(Ident) {
            // Only the comma is missing: another part follows.
            continue;
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

/// Skips to the next comma or to the end.
pub(super) fn skip_part(input: ParseStream) {
    skip_to(input, |input| input.peek(Token![,]));
}

/// Skips to the first token at which `stop` is true, or to the end.
pub(super) fn skip_to(input: ParseStream, stop: impl Fn(ParseStream) -> bool) {
    while !input.is_empty() && !stop(input) {
        // Operators of two characters are skipped as a whole, so that the second character of `==` is not taken for
        // `=`.
        let is_double =
            input.peek(Token![==]) || input.peek(Token![!=]) || input.peek(Token![<=]) || input.peek(Token![>=]);
        for _ in 0..1 + usize::from(is_double) {
            if input.parse::<TokenTree>().is_err() {
                return;
            }
        }
    }
}

/// Skips a comma, if one follows.
pub(super) fn comma(input: ParseStream) {
    if input.peek(Token![,]) {
        // The comma has been peeked, so parsing it cannot fail.
        _ = input.parse::<Token![,]>();
    }
}

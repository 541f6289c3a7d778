//! Parsing of the name of a statement or condition.

use super::index;
use crate::ast::NewName;
use crate::report::Report;
use syn::parse::ParseStream;
use syn::{Error, Ident, Result, Token};

/// Parses `name:` if it follows, and uses the keyword as the name otherwise.
pub(super) fn row_name_or_keyword(input: ParseStream, keyword: &Ident, report: &Report) -> Result<NewName> {
    let (ahead, unread) = (input.fork(), Report::new());
    let is_name = index::new_name(&ahead, &unread).is_ok() && ahead.peek(Token![:]) && !ahead.peek(Token![::]);
    unread.discard();
    if is_name {
        return row_name(input, keyword, "", report);
    }
    Ok(NewName { ident: keyword.clone(), bracket: None, doc: String::new() })
}

/// Parses `name:` at the beginning of a statement or condition.
pub(super) fn row_name(input: ParseStream, keyword: &Ident, example: &str, report: &Report) -> Result<NewName> {
    let nameless = |span| Error::new(span, format!("a `{keyword}` begins with its name and a colon: `{example}`"));
    if input.is_empty() {
        return Err(nameless(keyword.span()));
    }
    let start = input.span();
    let name = index::new_name(input, report)?;
    if !input.peek(Token![:]) || input.peek(Token![::]) {
        return Err(nameless(start));
    }
    input.parse::<Token![:]>()?;
    Ok(name)
}

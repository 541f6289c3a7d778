//! Parsing of `#[mechanism(cross_check, allow_redundant, check_units)]`.

use super::flatten::flatten;
use super::index::identifier;
use super::keyword::{self, Keyword};
use super::list::list;
use super::reject::here;
use crate::ast::{Flags, text};
use crate::report::Report;
use crate::suggest::did_you_mean;
use proc_macro2::TokenStream;
use syn::parse::{ParseStream, Parser};
use syn::{Error, Result, Token};

/// The flags in the arguments of the attribute.
pub(super) fn flags(args: TokenStream, report: &Report) -> Flags {
    let mut flags = Flags::default();
    let before = report.count();
    let read = |input: ParseStream| {
        list(input, report, |input| flag(input, &mut flags));
        Ok(())
    };
    // Tokens that were skipped after a reported error cause the error "unexpected token" at the end, which is ignored.
    if let Err(error) = read.parse2(flatten(args))
        && report.count() == before
    {
        report.push(error);
    }
    flags
}

fn flag(input: ParseStream, flags: &mut Flags) -> Result<()> {
    const NAMES: [&str; 3] = ["cross_check", "allow_redundant", "check_units"];
    let word = identifier(input)?;
    let name = text(&word);
    let slot = match name.as_str() {
        "cross_check" => &mut flags.cross_check,
        "allow_redundant" => &mut flags.allow_redundant,
        "check_units" => &mut flags.check_units,
        _ => {
            let hint = match keyword::find(&name) {
                Some(Keyword::Statement(form)) => format!("; write `{}` below", form.example()),
                Some(_) => format!("; write `#[{name}(…)]` below"),
                None => did_you_mean(&name, NAMES),
            };
            let message =
                format!("no flag `{name}`; the flags are `cross_check`, `allow_redundant` and `check_units`{hint}");
            return Err(Error::new(word.span(), message));
        }
    };
    let is_set = std::mem::replace(slot, true);
    if input.peek(Token![=]) {
        return Err(here(input, format!("a flag stands alone: `#[mechanism({name})]`")));
    }
    if is_set {
        return Err(Error::new(word.span(), format!("`{name}` is given twice; once is enough")));
    }
    Ok(())
}

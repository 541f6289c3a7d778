//! Unilateral conditions: `limit: slider.x < stroke`.

use super::expr::{end_of_expr, expr};
use super::list::skip_to;
use super::reject::here;
use super::row_name::row_name;
use super::written::{between, written};
use crate::ast::{ConditionDecl, Expr};
use crate::report::Report;
use kin_core::mechanism::Relation;
use syn::parse::ParseStream;
use syn::{Ident, Result, Token};

/// An example of a condition.
pub(super) const EXAMPLE: &str = "#[unilateral(limit: slider.x < stroke)]";

/// Parses the contents of the attribute; a side with an error becomes a hole, so that the other side is still read.
pub(super) fn condition(input: ParseStream, keyword: &Ident, report: &Report) -> Result<ConditionDecl> {
    let name = row_name(input, keyword, EXAMPLE, report)?;
    let start = input.fork();
    let left = report.ok(side(input));
    let between_sides = input.fork();
    let relation = match &left {
        Some(_) => report.ok(relation(input)),
        // After an error any tokens may follow; the next comparison is taken as the one that is meant.
        None => {
            skip_to(input, is_comparison);
            relation(input).ok()
        }
    };
    if relation.is_none() {
        skip_operator(input);
    }
    let behind_operator = input.fork();
    let right = if relation.is_none() && input.is_empty() { None } else { report.ok(side(input)) };
    let text = |from, to| written(between(from, to));
    let (first, second) = (text(&start, &between_sides), text(&behind_operator, input));
    if right.is_some() {
        report.ok(end(input));
    }
    skip_to(input, |_| false);
    let hole = || Expr::hole(keyword.span());
    Ok(ConditionDecl {
        keyword: keyword.clone(),
        name,
        text: relation.map_or_else(String::new, |relation| format!("{first} {relation} {second}")),
        left: left.unwrap_or_else(hole),
        relation,
        right: right.unwrap_or_else(hole),
    })
}

/// Parses one side; an error if it is missing before a comparison.
fn side(input: ParseStream) -> Result<Expr> {
    if is_comparison(input) {
        return Err(here(input, "expected an expression before this"));
    }
    expr(input)
}

/// Parses `>` or `<`; for any other token the error says what to write.
fn relation(input: ParseStream) -> Result<Relation> {
    for (is_there, operator, other) in [(input.peek(Token![>=]), ">", ">="), (input.peek(Token![<=]), "<", "<=")] {
        if is_there {
            let message =
                format!("`{other}` is not available, because equality lasts only an instant; write `{operator}`");
            return Err(here(input, message));
        }
    }
    if input.peek(Token![==]) || input.peek(Token![=]) || input.peek(Token![!=]) {
        let message = "a unilateral condition is an inequality, written with `>` or `<`; an equation is a `constraint`";
        return Err(here(input, message));
    }
    if is_strange(input) {
        return Err(here(input, format!("a unilateral condition has one `>` or `<`: `{EXAMPLE}`")));
    }
    if input.peek(Token![>]) {
        input.parse::<Token![>]>().map(|_| Relation::Greater)
    } else if input.peek(Token![<]) {
        input.parse::<Token![<]>().map(|_| Relation::Less)
    } else if end_of_expr(input).is_ok() {
        Err(here(input, format!("expected `>` or `<` and the other side of the condition: `{EXAMPLE}`")))
    } else {
        end_of_expr(input).map(|()| Relation::Greater)
    }
}

/// Checks that nothing follows the right side.
fn end(input: ParseStream) -> Result<()> {
    if input.is_empty() {
        return Ok(());
    }
    if is_comparison(input) {
        return Err(here(
            input,
            "a unilateral condition compares two sides; a range is two conditions, each with a name of its own",
        ));
    }
    if input.peek(Token![,]) {
        if input.peek2(syn::parse::End) {
            return Ok(());
        }
        return Err(here(input, format!("a unilateral condition has no options: `{EXAMPLE}`")));
    }
    end_of_expr(input)
}

/// True for operators of two characters that begin like a comparison but are none.
fn is_strange(input: ParseStream) -> bool {
    input.peek(Token![<<]) || input.peek(Token![>>]) || input.peek(Token![=>])
}

fn is_comparison(input: ParseStream) -> bool {
    input.peek(Token![>]) || input.peek(Token![<]) || input.peek(Token![=]) || input.peek(Token![!=])
}

/// Skips an operator that has been reported; without an operator the rest is skipped, because the other side cannot be
/// found.
fn skip_operator(input: ParseStream) {
    if !is_comparison(input) {
        return skip_to(input, |_| false);
    }
    // The token has been peeked, so parsing it cannot fail.
    while is_comparison(input) || input.peek(Token![!]) {
        _ = input.parse::<proc_macro2::TokenTree>();
    }
}

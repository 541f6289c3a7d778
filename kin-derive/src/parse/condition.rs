//! Unilateral conditions: `limit: slider.x < stroke`.

use super::expr::{end_of_expr, expr};
use super::list::{skip_part, skip_to};
use super::reject::here;
use super::row_name;
use crate::ast::{ConditionDecl, Expr};
use crate::report::Report;
use kin_core::mechanism::Relation;
use syn::parse::ParseStream;
use syn::{Ident, Result, Token};

/// A condition as the user writes it.
pub(super) const EXAMPLE: &str = "#[unilateral(limit: slider.x < stroke)]";

/// Everything in the brackets; a side with a mistake is a hole, so that the other one is read, too.
pub(super) fn condition(input: ParseStream, keyword: &Ident, report: &Report) -> Result<ConditionDecl> {
    let name = row_name(input, keyword, EXAMPLE, report)?;
    let hole = || Expr::hole(keyword.span());
    let left = report.ok(expr(input));
    let left_is_read = left.is_some();
    if !left_is_read {
        skip_to(input, is_comparison);
    }
    // Without its left side or its operator the condition is lost; what is wrong with the rest is told nevertheless.
    let relation = match relation(input) {
        Ok(relation) => Some(relation),
        Err(error) => {
            if left_is_read {
                report.push(error);
            }
            if is_comparison(input) {
                skip_operator(input);
            } else {
                skip_to(input, |_| false);
            }
            None
        }
    };
    let is_lost = relation.is_none();
    let right = if is_lost && input.is_empty() { None } else { report.ok(expr(input)) };
    let end = if right.is_some() { end(input) } else { Ok(()) };
    report.ok(end);
    skip_to(input, |_| false);
    Ok(ConditionDecl {
        keyword: keyword.clone(),
        name,
        left: left.unwrap_or_else(hole),
        relation: relation.unwrap_or(Relation::Greater),
        right: right.filter(|_| !is_lost).unwrap_or_else(hole),
    })
}

/// `>` or `<`; of everything else it is said what to write.
fn relation(input: ParseStream) -> Result<Relation> {
    for (is_there, operator, other) in [(input.peek(Token![>=]), ">", ">="), (input.peek(Token![<=]), "<", "<=")] {
        if is_there {
            let message =
                format!("a motion passes its limit in an instant, so that there is no `{other}`; write `{operator}`");
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

/// After the right side nothing follows.
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

/// Operators of two characters that begin like a comparison and are none.
fn is_strange(input: ParseStream) -> bool {
    input.peek(Token![<<]) || input.peek(Token![>>]) || input.peek(Token![=>])
}

fn is_comparison(input: ParseStream) -> bool {
    input.peek(Token![>]) || input.peek(Token![<]) || input.peek(Token![=]) || input.peek(Token![!=])
}

/// Consumes an operator that was reported, and what stands between it and the other side.
fn skip_operator(input: ParseStream) {
    while is_comparison(input) || input.peek(Token![!]) {
        if input.parse::<proc_macro2::TokenTree>().is_err() {
            return skip_part(input);
        }
    }
}

//! Points and pairs: `body @ (x, y)`, a named point, `(vx, vy)`.

use super::expr::{deeper, end_of_expr, nested};
use super::index::name_use;
use super::reject::{self, here};
use crate::ast::{AxisExpr, Expr, NameUse, PointExpr, RadiiExpr};
use proc_macro2::{Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::{Error, Ident, Result, Token, parenthesized, token};

/// A point operand.
pub(super) fn point(input: ParseStream) -> Result<PointExpr> {
    point_at_depth(input, 0).map(|(point, _)| point)
}

/// A point and the height of its coordinates, inside brackets that are `depth` levels deep.
pub(super) fn point_at_depth(input: ParseStream, depth: usize) -> Result<(PointExpr, usize)> {
    if !input.peek(Ident::peek_any) {
        return Err(here(input, "expected a point: `body @ (x, y)` or the name of a `point`"));
    }
    let name = name_use(input)?;
    if input.peek(Token![.]) {
        return Err(here(input, "a point is `body @ (x, y)` or the name of a `point`, without a component"));
    }
    if input.peek(token::Paren) {
        let error = here(input, "a point is written `body @ (x, y)`");
        input.parse::<TokenTree>()?;
        return Err(error);
    }
    if !input.peek(Token![@]) {
        return Ok((PointExpr::Named(name), 0));
    }
    input.parse::<Token![@]>()?;
    let (x, y, _) = pair(input, deeper(input, depth)?, "a point is written `body @ (x, y)`")?;
    let height = x.height.max(y.height);
    Ok((PointExpr::At { body: name, x: Box::new(x), y: Box::new(y) }, height))
}

/// A body operand.
pub(super) fn body(input: ParseStream) -> Result<NameUse> {
    if !input.peek(Ident::peek_any) {
        return Err(here(input, "expected the name of a body"));
    }
    let name = name_use(input)?;
    if input.peek(Token![@]) {
        return Err(here(input, "here stands a body, not a point: the name alone"));
    }
    if input.peek(Token![.]) {
        return Err(here(input, "here stands a body, not its coordinate: the name alone"));
    }
    Ok(name)
}

/// The value of `axis`.
pub(super) fn axis(input: ParseStream) -> Result<AxisExpr> {
    let (x, y, span) = pair(input, 0, "an axis is a pair in the frame of its body: `axis = (1, 0)`")?;
    Ok(AxisExpr { x, y, span })
}

/// The value of `radii`.
pub(super) fn radii(input: ParseStream) -> Result<RadiiExpr> {
    let (i, j, span) = pair(input, 0, "radii are a pair, in the order of the operands: `radii = (r1, r2)`")?;
    Ok(RadiiExpr { i, j, span })
}

/// The name of a scalar coordinate.
pub(super) fn scalar(input: ParseStream) -> Result<NameUse> {
    const FORM: &str = "here stands the name of a scalar coordinate, declared with `#[coordinates(psi)]`";
    if !input.peek(Ident::peek_any) {
        return Err(here(input, FORM));
    }
    let name = name_use(input)?;
    if input.is_empty() || input.peek(Token![,]) { Ok(name) } else { Err(here(input, FORM)) }
}

/// `(x, y)`, inside brackets that are `depth` levels deep.
pub(super) fn pair(input: ParseStream, depth: usize, form: &str) -> Result<(Expr, Expr, Span)> {
    if !input.peek(token::Paren) {
        let error = here(input, form);
        skip_bare_pair(input, depth);
        return Err(error);
    }
    let content;
    let parens = parenthesized!(content in input);
    let span = parens.span.join();
    if content.is_empty() {
        return Err(Error::new(span, form));
    }
    let x = coordinate(&content, depth)?;
    if content.is_empty() {
        return Err(Error::new(span, format!("{form}; the second component is missing")));
    }
    content.parse::<Token![,]>()?;
    if content.is_empty() {
        return Err(Error::new(span, format!("{form}; the second component is missing")));
    }
    let y = coordinate(&content, depth)?;
    if content.peek(Token![,]) {
        content.parse::<Token![,]>()?;
    }
    if content.is_empty() { Ok((x, y, span)) } else { Err(here(&content, "a pair has two components")) }
}

/// Skips `x, y` without brackets, so that `y` is not taken for what follows the pair.
fn skip_bare_pair(input: ParseStream, depth: usize) {
    let ahead = input.fork();
    let pair = nested(&ahead, depth).and_then(|_| ahead.parse::<Token![,]>()).and_then(|_| nested(&ahead, depth));
    if pair.is_ok() && (ahead.is_empty() || ahead.peek(Token![,])) {
        input.advance_to(&ahead);
    }
}

fn coordinate(content: ParseStream, depth: usize) -> Result<Expr> {
    let expr = nested(content, depth)?;
    end_of_expr(content)?;
    if content.peek(Token![=]) {
        return Err(reject::after_expr(content));
    }
    Ok(expr)
}

//! Parsing of operands and options that are points, bodies, scalars or pairs.

use super::expr::{pair, point_at_depth};
use super::index::name_use;
use super::reject::here;
use crate::ast::{AxisExpr, NameUse, PointExpr, RadiiExpr};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Ident, Result, Token};

/// Parses a point.
pub(super) fn point(input: ParseStream) -> Result<PointExpr> {
    point_at_depth(input, 0).map(|(point, _)| point)
}

/// Parses a body.
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

/// Parses the value of `axis`.
pub(super) fn axis(input: ParseStream) -> Result<AxisExpr> {
    let (x, y, span) = pair(input, 0, "an axis is a pair in the frame of its body: `axis = (1, 0)`")?;
    Ok(AxisExpr { x, y, span })
}

/// Parses the components of a force.
pub(super) fn vector(input: ParseStream) -> Result<AxisExpr> {
    let (x, y, span) = pair(input, 0, "a force is a pair of components: `(fx, fy)`")?;
    Ok(AxisExpr { x, y, span })
}

/// Parses the value of `radii`.
pub(super) fn radii(input: ParseStream) -> Result<RadiiExpr> {
    let (i, j, span) = pair(input, 0, "radii are a pair, in the order of the operands: `radii = (r1, r2)`")?;
    Ok(RadiiExpr { i, j, span })
}

/// Parses the name of a scalar coordinate.
pub(super) fn scalar(input: ParseStream) -> Result<NameUse> {
    const FORM: &str = "here stands the name of a scalar coordinate, declared with `#[coordinates(psi)]`";
    if !input.peek(Ident::peek_any) {
        return Err(here(input, FORM));
    }
    let name = name_use(input)?;
    if input.is_empty() || input.peek(Token![,]) { Ok(name) } else { Err(here(input, FORM)) }
}

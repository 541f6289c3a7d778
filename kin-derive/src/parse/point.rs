//! Parsing of operands and of the values of options.

use super::expr::{end_of_expr, expr, pair, point_at_depth};
use super::index::name_use;
use super::reject::here;
use crate::ast::{BodyExpr, NameUse, OperandExpr, PairExpr, PointExpr};
use kin_core::mechanism::OperandType;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Ident, Result, Token};

/// Parses one operand, or the value of an option.
pub(super) fn operand(input: ParseStream, takes: OperandType) -> Result<OperandExpr> {
    let pair = |form| pair(input, 0, form).map(|(x, y, span)| OperandExpr::Pair(PairExpr { x, y, span }));
    match takes {
        OperandType::Point | OperandType::Points => point(input).map(OperandExpr::Point),
        OperandType::Body | OperandType::Carrier | OperandType::Bodies => {
            body(input).map(|body| OperandExpr::Body(BodyExpr::Named(body)))
        }
        OperandType::Scalar(_) => scalar(input).map(|name| OperandExpr::Scalar(Some(name))),
        OperandType::Vector => pair("a force is a pair of components: `(fx, fy)`"),
        OperandType::Axis => pair("an axis is a pair in the frame of its body: `axis = (1, 0)`"),
        OperandType::Radii => pair("radii are a pair, in the order of the operands: `radii = (r1, r2)`"),
        _ => {
            let value = expr(input)?;
            end_of_expr(input)?;
            Ok(OperandExpr::Value(value))
        }
    }
}

/// Parses a point.
pub(super) fn point(input: ParseStream) -> Result<PointExpr> {
    point_at_depth(input, 0).map(|(point, _)| point)
}

/// Parses a body.
fn body(input: ParseStream) -> Result<NameUse> {
    if !input.peek(Ident::peek_any) {
        return Err(here(input, "expected the name of a body"));
    }
    let name = name_use(input)?;
    if input.peek(Token![@]) {
        return Err(here(input, "a body is needed here, not a point: its name alone"));
    }
    if input.peek(Token![.]) {
        return Err(here(input, "a body is needed here, not its coordinate: its name alone"));
    }
    Ok(name)
}

/// Parses the name of a scalar coordinate.
fn scalar(input: ParseStream) -> Result<NameUse> {
    const FORM: &str = "the name of a scalar coordinate is needed here, declared with `#[coordinates(psi)]`";
    if !input.peek(Ident::peek_any) {
        return Err(here(input, FORM));
    }
    let name = name_use(input)?;
    if input.is_empty() || input.peek(Token![,]) { Ok(name) } else { Err(here(input, FORM)) }
}

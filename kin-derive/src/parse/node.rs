//! Nodes of expressions: their height limit, numbers, and long sums and products as balanced trees.

use crate::ast::{Expr, ExprKind, Operator};
use kin_core::units;
use proc_macro2::Span;
use quote::ToTokens;
use syn::parse::ParseStream;
use syn::{Error, Lit, Result};

impl Expr {
    /// An expression with `children` of these heights, unless it gets too high.
    pub(super) fn over(kind: ExprKind, span: Span, children: &[usize]) -> Result<Self> {
        let height = 1 + children.iter().copied().max().unwrap_or(0);
        if height > Self::MAX_HEIGHT {
            return Err(too_deep(span));
        }
        Ok(Self { kind, span, height })
    }
}

pub(super) fn too_deep(span: Span) -> Error {
    let limit = Expr::MAX_HEIGHT;
    Error::new(span, format!("an expression is at most {limit} levels deep; give a part of it a name with `define`"))
}

/// Number of operands up to which a sum or a product remains a chain from left to right.
const LONGEST_AS_WRITTEN: usize = 16;

/// A sum or a product of many operands. A long one becomes a balanced tree, because passes over expressions recurse
/// over its height. `inverse` is the inverse operator, − for a sum and / for a product.
pub(super) fn chain(first: Expr, rest: Vec<(Operator, Expr)>, inverse: Operator) -> Result<Expr> {
    if rest.len() < LONGEST_AS_WRITTEN {
        return rest.into_iter().try_fold(first, |left, (operator, right)| binary(operator, left, right));
    }
    let mut operands: Vec<(Operator, Expr)> = core::iter::once((plain(inverse), first)).chain(rest).collect();
    if inverse == Operator::Div {
        // Factors come before divisors, since / b * c is not / (b / c) where c is 0. The terms of a sum keep their order,
        // which determines the rounding errors; a negation has none.
        operands.sort_by_key(|(operator, _)| *operator == inverse);
    }
    // Neighbours are paired until one operand is left. A pair keeps the operator before its first operand; if this is
    // the inverse operator, the operator inside the pair is exchanged: − b − c = −(b + c), − b + c = −(b − c).
    while operands.len() > 1 {
        let mut paired = Vec::with_capacity(operands.len().div_ceil(2));
        let mut waiting = operands.into_iter();
        while let Some((before, left)) = waiting.next() {
            paired.push(match waiting.next() {
                None => (before, left),
                Some((between, right)) => {
                    let inner = match before == between {
                        true => plain(inverse),
                        false => inverse,
                    };
                    (before, binary(inner, left, right)?)
                }
            });
        }
        operands = paired;
    }
    // No inverse operator precedes the first operand.
    operands.pop().map(|(_, whole)| whole).ok_or_else(|| Error::new(Span::call_site(), "an expression is missing"))
}

/// The operator of which `inverse` is the inverse.
fn plain(inverse: Operator) -> Operator {
    if inverse == Operator::Sub { Operator::Add } else { Operator::Mul }
}

fn binary(operator: Operator, left: Expr, right: Expr) -> Result<Expr> {
    let span = join(left.span, right.span);
    let heights = [left.height, right.height];
    Expr::over(ExprKind::Binary(operator, Box::new(left), Box::new(right)), span, &heights)
}

pub(super) fn number(literal: Lit) -> Result<Expr> {
    let span = literal.span();
    let (digits, suffix) = match &literal {
        Lit::Int(int) => (int.base10_digits(), int.suffix()),
        Lit::Float(float) => (float.base10_digits(), float.suffix()),
        Lit::Str(_) => {
            return Err(Error::new(span, "a number is written without quotes; angles are in radians"));
        }
        _ => return Err(Error::new(span, "expected a number, a name or a function")),
    };
    if !matches!(suffix, "" | "f64") {
        return Err(Error::new(span, with_suffix(&literal, digits, suffix)));
    }
    let is_zero = digits.split(['e', 'E']).next().is_none_or(|digits| !digits.contains(|c| matches!(c, '1'..='9')));
    match digits.parse::<f64>() {
        Ok(0.0) if !is_zero => {
            Err(Error::new(span, "this number is too small and would become 0; the smallest is about 5e-324"))
        }
        Ok(value) if value.is_finite() => Ok(Expr::number(value, span)),
        _ => Err(Error::new(span, "this number is too large; the largest is about 1.8e308")),
    }
}

/// An error if a default value begins with a number that has a unit as its suffix, `1.1m`.
pub(super) fn no_unit_in_default(input: ParseStream) -> Result<()> {
    let (span, digits, suffix) = match input.fork().parse() {
        Ok(Lit::Int(int)) => (int.span(), int.base10_digits().to_owned(), int.suffix().to_owned()),
        Ok(Lit::Float(float)) => (float.span(), float.base10_digits().to_owned(), float.suffix().to_owned()),
        _ => return Ok(()),
    };
    if suffix.is_empty() || suffix.ends_with("rad") || suffix == "deg" || units::parse(&suffix).is_err() {
        return Ok(());
    }
    let message = format!("numbers have no units; the unit stands beside: `default = {digits}, unit = \"{suffix}\"`");
    Err(Error::new(span, message))
}

/// The message for a number with a suffix: a unit, a factor, or a type.
fn with_suffix(literal: &Lit, digits: &str, suffix: &str) -> String {
    let is_type = matches!(suffix.as_bytes(), [b'f' | b'i' | b'u', b'0'..=b'9', ..] | b"isize" | b"usize");
    // The letters of 0x1p3 are no name.
    let is_decimal = literal.to_token_stream().to_string().as_bytes().get(1).is_none_or(|c| !b"xob".contains(c));
    match suffix {
        "deg" | "degree" | "degrees" => {
            format!("angles are in radians: {digits} degrees are written `{digits}*pi/180`")
        }
        "rad" | "radian" | "radians" => format!("angles are in radians, which are not written: `{digits}`"),
        _ if units::parse(suffix).is_ok() => {
            let message =
                format!("numbers have no units; a parameter has one, `#[param({digits}, unit = \"{suffix}\")]`");
            // A single letter may also be a name.
            let or_product =
                if suffix.len() == 1 { format!("; a product is written `{digits}*{suffix}`") } else { String::new() };
            message + &or_product
        }
        _ if is_type || !is_decimal || matches!(suffix, "e" | "E") => {
            format!("the suffix `{suffix}` has no meaning here; numbers are written `40`, `0.1` or `1e-3`")
        }
        _ => format!("a product is written with `*`: `{digits}*{suffix}`"),
    }
}

/// The joined span where the compiler can join them, otherwise the first.
pub(super) fn join(first: Span, last: Span) -> Span {
    first.join(last).unwrap_or(first)
}

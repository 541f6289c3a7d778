//! Expressions: a Pratt parser for the arithmetic of the language.
//!
//! Precedence is that of Rust: methods bind tightest, then unary minus, `*` and `/`, `+` and `-`.

use super::call;
use super::index::{identifier, name_use};
use super::reject::{self, here};
use crate::ast::{Expr, ExprKind, Operator, text};
use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Ident, Lit, Result, Token, parenthesized, token};

/// An expression up to the first token that cannot continue it.
pub(super) fn expr(input: ParseStream) -> Result<Expr> {
    sum(input, 0)
}

/// An expression inside brackets that are `depth` levels deep.
pub(super) fn nested(input: ParseStream, depth: usize) -> Result<Expr> {
    sum(input, depth)
}

/// An error unless the expression that was just read ends here: at the end of its brackets, a comma or an `=`.
pub(super) fn end_of_expr(input: ParseStream) -> Result<()> {
    let is_equals = input.peek(Token![=]) && !input.peek(Token![==]) && !input.peek(Token![=>]);
    if input.is_empty() || input.peek(Token![,]) || is_equals {
        return Ok(());
    }
    Err(reject::after_expr(input))
}

impl Expr {
    /// An expression over `children`, unless it gets too tall.
    pub(super) fn over(kind: ExprKind, span: Span, children: &[usize]) -> Result<Self> {
        let height = 1 + children.iter().copied().max().unwrap_or(0);
        if height > Self::MAX_HEIGHT {
            return Err(too_deep(span));
        }
        Ok(Self { kind, span, height })
    }
}

fn too_deep(span: Span) -> Error {
    let limit = Expr::MAX_HEIGHT;
    Error::new(span, format!("an expression is at most {limit} levels deep; give a part of it a name with `define`"))
}

/// Checks the depth before a parser recurses.
pub(super) fn deeper(input: ParseStream, depth: usize) -> Result<usize> {
    if depth < Expr::MAX_HEIGHT { Ok(depth + 1) } else { Err(too_deep(input.span())) }
}

fn sum(input: ParseStream, depth: usize) -> Result<Expr> {
    let first = product(input, depth)?;
    let mut rest = Vec::new();
    loop {
        let operator = if input.peek(Token![+]) {
            input.parse::<Token![+]>()?;
            Operator::Add
        } else if input.peek(Token![-]) {
            input.parse::<Token![-]>()?;
            Operator::Sub
        } else {
            return chain(first, rest, Operator::Sub);
        };
        rest.push((operator, product(input, depth)?));
    }
}

fn product(input: ParseStream, depth: usize) -> Result<Expr> {
    let first = unary(input, depth)?;
    let mut rest = Vec::new();
    loop {
        let operator = if input.peek(Token![*]) {
            input.parse::<Token![*]>()?;
            if input.peek(Token![*]) {
                return Err(here(input, "powers are written `pow(a, n)` or `a.powi(n)`"));
            }
            Operator::Mul
        } else if input.peek(Token![/]) {
            input.parse::<Token![/]>()?;
            Operator::Div
        } else {
            return chain(first, rest, Operator::Div);
        };
        rest.push((operator, unary(input, depth)?));
    }
}

/// Operands of one sum or product up to which it stays as it was written, from left to right.
const LONGEST_AS_WRITTEN: usize = 16;

/// A sum or a product of many operands. A longer one becomes a balanced tree, since it is long and not deep: passes over
/// expressions recurse. `inverse` is the operator that takes away, − of a sum and / of a product.
fn chain(first: Expr, rest: Vec<(Operator, Expr)>, inverse: Operator) -> Result<Expr> {
    if rest.len() < LONGEST_AS_WRITTEN {
        return rest.into_iter().try_fold(first, |left, (operator, right)| binary(operator, left, right));
    }
    // Neighbours are paired until one operand is left: a ∘ b, and under an inverse operator a ∘ (b ∘⁻¹ c), which takes away
    // b and what was added to it.
    let mut operands: Vec<(Operator, Expr)> = core::iter::once((plain(inverse), first)).chain(rest).collect();
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
    // The first operand is never taken away.
    operands.pop().map(|(_, whole)| whole).ok_or_else(|| Error::new(Span::call_site(), "an expression is missing"))
}

/// The operator that puts together what its inverse takes away.
fn plain(inverse: Operator) -> Operator {
    if inverse == Operator::Sub { Operator::Add } else { Operator::Mul }
}

fn binary(operator: Operator, left: Expr, right: Expr) -> Result<Expr> {
    let span = join(left.span, right.span);
    let heights = [left.height, right.height];
    Expr::over(ExprKind::Binary(operator, Box::new(left), Box::new(right)), span, &heights)
}

fn unary(input: ParseStream, depth: usize) -> Result<Expr> {
    if !input.peek(Token![-]) {
        return postfix(input, depth);
    }
    let minus: Token![-] = input.parse()?;
    let operand = unary(input, deeper(input, depth)?)?;
    let (span, height) = (join(minus.span, operand.span), operand.height);
    Expr::over(ExprKind::Neg(Box::new(operand)), span, &[height])
}

/// A primary expression with its components and methods.
fn postfix(input: ParseStream, depth: usize) -> Result<Expr> {
    let mut value = primary(input, depth)?;
    while input.peek(Token![.]) && !input.peek(Token![..]) {
        input.parse::<Token![.]>()?;
        if !input.peek(Ident::peek_any) {
            return Err(here(
                input,
                "expected a component (`x`, `y`, `phi`) or a method such as `.sin()` after the dot",
            ));
        }
        let name = Ident::parse_any(input)?;
        value =
            if input.peek(token::Paren) { call::method(value, name, input, depth)? } else { component(value, name)? };
    }
    Ok(value)
}

fn component(value: Expr, name: Ident) -> Result<Expr> {
    let span = join(value.span, name.span());
    match value.kind {
        ExprKind::Name(of) => Ok(Expr { kind: ExprKind::Component(of, name), span, height: 0 }),
        _ => {
            let message = format!(
                "`.{}` belongs to a body or a named point; a function is called with brackets, `.sin()`",
                text(&name)
            );
            Err(Error::new(name.span(), message))
        }
    }
}

fn primary(input: ParseStream, depth: usize) -> Result<Expr> {
    if input.peek(token::Paren) {
        return parentheses(input, deeper(input, depth)?);
    }
    if let Some(error) = reject::keyword(input) {
        return Err(error);
    }
    if input.peek(Ident::peek_any) {
        if input.peek2(token::Paren) && input.peek(Ident) {
            let name = identifier(input)?;
            return call::function(name, input, deeper(input, depth)?);
        }
        if input.peek2(Token![::]) || input.peek2(Token![!]) && !input.peek2(Token![!=]) {
            return Err(here(input, "an expression has names, numbers and functions; paths and macros are not read"));
        }
        let name = name_use(input)?;
        if name.index.is_some() && input.peek(token::Paren) {
            return call::member(name, input, deeper(input, depth)?);
        }
        if name.index.is_none() && (input.peek(Ident) || input.peek(Lit)) {
            call::has_brackets(&name.ident)?;
        }
        let span = name.ident.span();
        return Ok(Expr { kind: ExprKind::Name(name), span, height: 0 });
    }
    if let Ok(literal) = input.step(|cursor| cursor.literal().ok_or_else(|| cursor.error("no literal"))) {
        return number(Lit::new(literal));
    }
    Err(reject::no_expr(input))
}

fn parentheses(input: ParseStream, depth: usize) -> Result<Expr> {
    let content;
    let parens = parenthesized!(content in input);
    let mut inner = sum(&content, depth)?;
    if content.peek(Token![,]) {
        return Err(here(&content, "a pair stands behind `@` and in `axis` only: `crank @ (l1/2, 0)`"));
    }
    if !content.is_empty() {
        return Err(reject::after_expr(&content));
    }
    inner.span = parens.span.join();
    Ok(inner)
}

fn number(literal: Lit) -> Result<Expr> {
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
        let message = format!("the suffix `{suffix}` has no meaning here; numbers are written `40`, `0.1` or `1e-3`");
        return Err(Error::new(span, message));
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

/// Both spans where the compiler can join them, else the first.
pub(super) fn join(first: Span, last: Span) -> Span {
    first.join(last).unwrap_or(first)
}

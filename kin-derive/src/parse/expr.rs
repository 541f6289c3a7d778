//! A Pratt parser for the expressions of the language, including the arguments of functions and the points in
//! expressions, which contain expressions themselves.
//!
//! Precedence is that of Rust: methods bind tightest, followed by unary minus, `*` and `/`, `+` and `-`.

use super::call;
use super::index::{identifier, name_use};
use super::list::comma;
use super::node::{chain, join, number, too_deep};
use super::reject::{self, here};
use crate::ast::{Expr, ExprKind, NameUse, Operator, PointExpr, text};
use proc_macro2::{Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::{Error, Ident, Lit, Result, Token, parenthesized, token};

/// Parses an expression up to the first token that cannot continue it.
pub(super) fn expr(input: ParseStream) -> Result<Expr> {
    sum(input, 0)
}

/// An error unless the expression that was just parsed ends here: at the end of its brackets, a comma or an `=`.
pub(super) fn end_of_expr(input: ParseStream) -> Result<()> {
    let is_equals = input.peek(Token![=]) && !input.peek(Token![==]) && !input.peek(Token![=>]);
    if input.is_empty() || input.peek(Token![,]) || is_equals {
        return Ok(());
    }
    Err(reject::after_expr(input))
}

/// Checks the depth before a recursion of the parser.
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

fn unary(input: ParseStream, depth: usize) -> Result<Expr> {
    if !input.peek(Token![-]) {
        return postfix(input, depth);
    }
    let minus: Token![-] = input.parse()?;
    let operand = unary(input, deeper(input, depth)?)?;
    let (span, height) = (join(minus.span, operand.span), operand.height);
    Expr::over(ExprKind::Neg(Box::new(operand)), span, &[height])
}

/// Parses a primary expression with its components and methods.
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
        value = if input.peek(token::Paren) { method(value, name, input, depth)? } else { component(value, name)? };
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
            return function(name, input, deeper(input, depth)?);
        }
        if input.peek2(Token![::]) || input.peek2(Token![!]) && !input.peek2(Token![!=]) {
            return Err(here(input, "an expression has names, numbers and functions; paths and macros are not read"));
        }
        let name = name_use(input)?;
        if name.index.is_some() && input.peek(token::Paren) {
            return member(name, input, deeper(input, depth)?);
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
        return Err(here(&content, "a pair is written after `@` and in `axis` only: `crank @ (l1/2, 0)`"));
    }
    if !content.is_empty() {
        return Err(reject::after_expr(&content));
    }
    inner.span = parens.span.join();
    Ok(inner)
}

/// Parses `name(…)` from the parenthesis on.
fn function(name: Ident, input: ParseStream, depth: usize) -> Result<Expr> {
    let content;
    let parens = parenthesized!(content in input);
    let span = join(name.span(), parens.span.join());
    if text(&name) == "distance" {
        return distance(&name, &content, depth);
    }
    call::is_function(&name)?;
    let arguments = arguments(&content, depth).map_err(|error| {
        let ends_at_point = content.peek(Token![@]);
        ends_at_point.then(|| call::of_points(&name)).flatten().unwrap_or(error)
    });
    call::function(name, arguments?, span)
}

/// Parses `name[i](…)`, a member of an array of supplied functions, from the parenthesis on.
fn member(name: NameUse, input: ParseStream, depth: usize) -> Result<Expr> {
    let content;
    let parens = parenthesized!(content in input);
    let span = join(name.ident.span(), parens.span.join());
    call::supplied(name, arguments(&content, depth)?, span)
}

/// Parses `value.name(…)` from the parenthesis on.
fn method(value: Expr, name: Ident, input: ParseStream, depth: usize) -> Result<Expr> {
    let depth = deeper(input, depth)?;
    let content;
    let parens = parenthesized!(content in input);
    let span = join(value.span, parens.span.join());
    call::method(value, name, arguments(&content, depth)?, span)
}

fn arguments(content: ParseStream, depth: usize) -> Result<Vec<Expr>> {
    let mut arguments = Vec::new();
    while !content.is_empty() {
        arguments.push(sum(content, depth)?);
        end_of_expr(content)?;
        if content.is_empty() {
            break;
        }
        content
            .parse::<Token![,]>()
            .map_err(|error| Error::new(error.span(), "an `=` cannot stand inside the brackets of a function"))?;
    }
    Ok(arguments)
}

fn distance(name: &Ident, content: ParseStream, depth: usize) -> Result<Expr> {
    let wrong = || Error::new(name.span(), "`distance` takes two points: `distance(P, Q)`, `distance(a @ (0, 0), Q)`");
    if content.is_empty() {
        return Err(wrong());
    }
    let (p, p_height) = point_at_depth(content, depth)?;
    if content.is_empty() {
        return Err(wrong());
    }
    content.parse::<Token![,]>().map_err(|error| Error::new(error.span(), "expected a comma between two points"))?;
    if content.is_empty() {
        return Err(wrong());
    }
    let (q, q_height) = point_at_depth(content, depth)?;
    comma(content);
    if !content.is_empty() {
        return Err(wrong());
    }
    Expr::over(ExprKind::Distance(p, q), name.span(), &[p_height, q_height])
}

/// Parses a point inside brackets of depth `depth`. Returns also the height of its coordinates.
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

/// Parses `(x, y)` inside brackets of depth `depth`.
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
    comma(&content);
    if content.is_empty() { Ok((x, y, span)) } else { Err(here(&content, "a pair has two components")) }
}

/// Skips `x, y` without parentheses, so that `y` is not mistaken for the part after the pair.
fn skip_bare_pair(input: ParseStream, depth: usize) {
    let ahead = input.fork();
    let pair = sum(&ahead, depth).and_then(|_| ahead.parse::<Token![,]>()).and_then(|_| sum(&ahead, depth));
    if pair.is_ok() && (ahead.is_empty() || ahead.peek(Token![,])) {
        input.advance_to(&ahead);
    }
}

fn coordinate(content: ParseStream, depth: usize) -> Result<Expr> {
    let expr = sum(content, depth)?;
    end_of_expr(content)?;
    if content.peek(Token![=]) {
        return Err(reject::after_expr(content));
    }
    Ok(expr)
}

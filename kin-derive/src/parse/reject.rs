//! Errors for unexpected tokens.

use crate::function::other_function;
use core::fmt::Display;
use proc_macro2::{Spacing, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Ident, Token, token};

/// The message for angles in degrees.
pub(super) const RADIANS: &str = "angles are in radians: 90 degrees are `pi/2`";

/// An error with `message` at the next token, including operators such as `==`, or at the bracket that ends the stream.
pub(super) fn here(input: ParseStream, message: impl Display) -> Error {
    let ahead = input.fork();
    let mut operator = TokenStream::new();
    while let Ok(TokenTree::Punct(punct)) = ahead.parse::<TokenTree>() {
        let is_joint = punct.spacing() == Spacing::Joint;
        operator.extend([TokenTree::Punct(punct)]);
        if !is_joint {
            return Error::new_spanned(operator, message);
        }
    }
    Error::new(input.span(), message)
}

/// The message of the first case that applies.
fn first<'m>(cases: &[(bool, &'m str)]) -> Option<&'m str> {
    cases.iter().find(|(is_there, _)| *is_there).map(|(_, message)| *message)
}

/// The error for a token after an expression that can neither continue nor end it.
pub(super) fn after_expr(input: ParseStream) -> Error {
    let message = operator(input).or_else(|| {
        first(&[
            (input.is_empty() || input.peek(token::Paren), "expected an operator; a product is written with `*`"),
            (input.peek(Token![=]), "there is one `=` at most, between the sides of an equation"),
            (
                input.peek(Token![@]),
                "a point is written `body @ (x, y)`; in an expression, name it with `point(p = …)` and use `p.x`, `p.y`",
            ),
            (is_angle_unit(input), RADIANS),
            (
                is_unit(input),
                "expected an operator or a comma before this; a product is written with `*`, and a unit belongs to a \
                 parameter: `#[param(0.1, unit = \"m\")]`",
            ),
            (
                input.peek(Ident) || input.peek(syn::Lit),
                "expected an operator or a comma before this; a product is written with `*`",
            ),
        ])
    });
    here(input, message.unwrap_or("expected `+`, `-`, `*`, `/` or the end of the expression"))
}

/// The error for a token that cannot begin an expression.
pub(super) fn no_expr(input: ParseStream) -> Error {
    let is_equals = input.peek(Token![=]) && !input.peek(Token![==]) && !input.peek(Token![=>]);
    let ends = input.is_empty() || input.peek(Token![,]) || is_equals;
    let message = first(&[
        (ends, "expected an expression before this"),
        (input.peek(Token![+]), "expected a value; there is no unary plus"),
        (input.peek(token::Bracket), "an array cannot stand here; one element of an array parameter is written `l[3]`"),
        (input.peek(token::Brace), "a block cannot stand here; parts of an expression get a name with `define`"),
        (input.peek(Token![.]) && input.peek2(syn::Lit), "a number begins with a digit: `0.5`, not `.5`"),
    ]);
    here(input, message.or_else(|| operator(input)).unwrap_or("expected a number, a name or a function"))
}

/// The error for a keyword of Rust that is meaningless in an expression, even as a raw identifier.
pub(super) fn keyword(input: ParseStream) -> Option<Error> {
    if input.peek(Ident) {
        return None;
    }
    let word = Ident::parse_any(&input.fork()).ok()?;
    match word.to_string().as_str() {
        "true" | "false" => Some(here(input, "expected a number, a name or a function")),
        "mod" if input.peek2(token::Paren) => other_function("mod").map(|right| here(input, right)),
        "if" | "match" | "loop" | "while" | "for" => Some(here(
            input,
            format!("an expression has no branches and no loops; a name `{word}` is written `r#{word}`"),
        )),
        _ => None,
    }
}

fn is_angle_unit(input: ParseStream) -> bool {
    let word = input.fork().parse::<Ident>();
    word.is_ok_and(|word| is_angle_word(&word.to_string()))
}

fn is_unit(input: ParseStream) -> bool {
    input.fork().parse::<Ident>().is_ok_and(|word| kin_core::units::parse(&word.to_string()).is_ok())
}

/// True for names of angle units and conversions in other languages.
pub(super) fn is_angle_word(word: &str) -> bool {
    matches!(word, "deg" | "degree" | "degrees" | "rad" | "radian" | "radians" | "to_radians" | "to_degrees")
}

/// The message for an operator of another language, which says how to write the operation.
fn operator(input: ParseStream) -> Option<&'static str> {
    let is_logical = input.peek(Token![&]) || input.peek(Token![|]) || input.peek(Token![!]) || input.peek(Token![?]);
    first(&[
        (input.peek(Token![^]), "powers are written `pow(a, n)` or `a.powi(n)`"),
        (input.peek(Token![%]), "there is no remainder operator: angles are continuous, and sin and cos are periodic"),
        (input.peek(Token![==]) || input.peek(Token![=>]) || input.peek(Token![!=]), "an equation has a single `=`"),
        (
            input.peek(Token![<]) || input.peek(Token![>]),
            "comparisons have no place in an expression; an equation has a single `=`",
        ),
        (is_logical, "the operators are `+`, `-`, `*` and `/`"),
        (input.peek(Token![as]), "every number is a real number; no cast is needed"),
        (input.peek(Token![..]), "a range is written after the name of a row only: `N[i in 0..10]: …`"),
    ])
}

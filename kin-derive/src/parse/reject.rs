//! What to say about a token that does not belong where it stands.

use core::fmt::Display;
use syn::parse::ParseStream;
use syn::{Error, Token, token};

/// `message` on the next token, or on the bracket that ends the stream.
pub(super) fn here(input: ParseStream, message: impl Display) -> Error {
    Error::new(input.span(), message)
}

/// A token follows an expression that can neither continue nor end it.
pub(super) fn after_expr(input: ParseStream) -> Error {
    if let Some(message) = operator(input) {
        return here(input, message);
    }
    if input.is_empty() || input.peek(token::Paren) {
        return here(input, "expected an operator; a product is written with `*`");
    }
    if input.peek(Token![=]) {
        return here(input, "there is one `=` at most, between the sides of an equation");
    }
    if input.peek(Token![@]) {
        return here(
            input,
            "a point is written `body @ (x, y)`; in an expression, name it with `point(p = …)` and use `p.x`, `p.y`",
        );
    }
    if input.peek(syn::Ident) || input.peek(syn::Lit) {
        return here(input, "expected an operator or a comma before this; a product is written with `*`");
    }
    here(input, "expected `+`, `-`, `*`, `/` or the end of the expression")
}

/// A token stands where an expression begins and cannot begin one.
pub(super) fn no_expr(input: ParseStream) -> Error {
    let is_equals = input.peek(Token![=]) && !input.peek(Token![==]) && !input.peek(Token![=>]);
    if input.is_empty() || input.peek(Token![,]) || is_equals {
        return here(input, "expected an expression before this");
    }
    if input.peek(Token![+]) {
        return here(input, "expected a value; there is no unary plus");
    }
    if input.peek(token::Bracket) {
        return here(input, "an array cannot stand here; one element of an array parameter is written `l[3]`");
    }
    if input.peek(token::Brace) {
        return here(input, "a block cannot stand here; parts of an expression get a name with `define`");
    }
    operator(input)
        .map_or_else(|| here(input, "expected a number, a name or a function"), |message| here(input, message))
}

/// The right way to write what an operator of another language means.
fn operator(input: ParseStream) -> Option<&'static str> {
    if input.peek(Token![^]) {
        Some("powers are written `pow(a, n)` or `a.powi(n)`")
    } else if input.peek(Token![%]) {
        Some("there is no remainder: angles are continuous, periods are the business of sin and cos")
    } else if input.peek(Token![==]) || input.peek(Token![=>]) || input.peek(Token![!=]) {
        Some("an equation has a single `=`")
    } else if input.peek(Token![<]) || input.peek(Token![>]) {
        Some("comparisons have no place in an expression; an equation has a single `=`")
    } else if input.peek(Token![&]) || input.peek(Token![|]) || input.peek(Token![!]) || input.peek(Token![?]) {
        Some("the operators are `+`, `-`, `*` and `/`")
    } else if input.peek(Token![as]) {
        Some("every number is a real number; no cast is needed")
    } else if input.peek(Token![..]) {
        Some("a range stands behind the name of a row only: `N[i in 0..10]: …`")
    } else {
        None
    }
}

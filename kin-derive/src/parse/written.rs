//! The text of tokens as an author would write it, on one line.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::parse::ParseStream;

/// The tokens between two positions of one stream.
pub(super) fn between(from: ParseStream, to: ParseStream) -> TokenStream {
    let (mut cursor, end) = (from.cursor(), to.cursor());
    let mut tokens = TokenStream::new();
    while cursor != end {
        let Some((tree, next)) = cursor.token_tree() else { break };
        tokens.extend([tree]);
        cursor = next;
    }
    tokens
}

/// The text of tokens, for example `a*x + b`: with spaces only around `+` and `-` and after commas.
pub(super) fn written(tokens: TokenStream) -> String {
    let mut text = String::new();
    // True where an operand begins, so that a minus is a sign.
    let mut begins = true;
    for tree in tokens {
        match tree {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Parenthesis | Delimiter::None => ["(", ")"],
                };
                text.extend([open, &written(group.stream()), close]);
                begins = false;
            }
            TokenTree::Punct(punct) => {
                match punct.as_char() {
                    ',' => text.push_str(", "),
                    sign @ ('+' | '-') if !begins => text.extend([' ', sign, ' ']),
                    '@' => text.push_str(" @ "),
                    other => text.push(other),
                }
                begins = true;
            }
            TokenTree::Ident(ident) => {
                text.push_str(ident.to_string().trim_start_matches("r#"));
                begins = false;
            }
            TokenTree::Literal(literal) => {
                text.push_str(&literal.to_string());
                begins = false;
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::quote;

    #[test]
    fn expressions_are_written_on_one_line() {
        let tokens = quote!(-a [ i + 1 ].x+(b - -2.5 * sin(r#type)) / pow(c, 2) - distance(p @ (0, -1), q));
        let text = "-a[i + 1].x + (b - -2.5*sin(type))/pow(c, 2) - distance(p @ (0, -1), q)";
        assert_eq!(written(tokens), text);
    }
}

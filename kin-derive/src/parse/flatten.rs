//! Preparation of token streams: invisible groups are made visible, and deeply nested streams are rejected.

use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};

/// The deepest accepted nesting of brackets: parsers recurse, and macros run unoptimised on small stacks.
pub(crate) const MAX_NESTING: usize = 48;

/// The span of a group that is nested too deeply for a recursive parser, if there is one.
pub(crate) fn too_deep(tokens: &TokenStream) -> Option<Span> {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(level) = open.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) if open.len() > MAX_NESTING => return Some(group.span()),
            Some(TokenTree::Group(group)) => open.push(group.stream().into_iter()),
            Some(_) => {}
            None => _ = open.pop(),
        }
    }
    None
}

/// The span of a token after too many nested prefixes or type arguments, `&&&…` or `Vec<Vec<…`, which would overflow
/// the stack of a recursive parser; the contents of attributes are not counted.
pub(super) fn too_tangled(item: &TokenStream) -> Option<Span> {
    const MAX_PREFIXES: usize = 32;
    const MAX_TOKENS: usize = 400;
    let mut open = vec![item.clone()];
    while let Some(level) = open.pop() {
        let (mut prefixes, mut tokens, mut after_pound) = (0, 0, false);
        for tree in level {
            tokens += 1;
            let was_pound = std::mem::take(&mut after_pound);
            match &tree {
                TokenTree::Group(_) if was_pound => (prefixes, tokens) = (0, 0),
                TokenTree::Group(group) => open.push(group.stream()),
                TokenTree::Punct(punct) => match punct.as_char() {
                    ',' | ';' => (prefixes, tokens) = (0, 0),
                    '#' => after_pound = true,
                    '<' | '&' | '*' | '-' => prefixes += 1,
                    _ => {}
                },
                _ => {}
            }
            if prefixes > MAX_PREFIXES || tokens > MAX_TOKENS {
                return Some(tree.span());
            }
        }
    }
    None
}

/// Replaces the invisible groups of `macro_rules!` fragments: a single token replaces its group, several tokens are put
/// in parentheses, so that `$l:expr` binds as the user expects.
pub(super) fn flatten(tokens: TokenStream) -> TokenStream {
    let mut flat = TokenStream::new();
    for tree in tokens {
        let TokenTree::Group(group) = tree else {
            flat.extend([tree]);
            continue;
        };
        let inner = flatten(group.stream());
        if group.delimiter() != Delimiter::None {
            flat.extend([regroup(group.delimiter(), inner, group.span())]);
        } else if inner.clone().into_iter().count() <= 1 {
            flat.extend(inner);
        } else {
            flat.extend([regroup(Delimiter::Parenthesis, inner, group.span())]);
        }
    }
    flat
}

/// A group with a given span.
pub(super) fn regroup(delimiter: Delimiter, stream: TokenStream, span: Span) -> TokenTree {
    let mut group = Group::new(delimiter, stream);
    group.set_span(span);
    group.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::quote;

    fn invisible(tokens: TokenStream) -> TokenTree {
        Group::new(Delimiter::None, tokens).into()
    }

    #[test]
    fn invisible_groups_become_tokens_or_parentheses() {
        let single = invisible(quote!(l1));
        let nested = invisible(invisible(quote!(2)).into());
        let sum = invisible(quote!(a + b));
        let flat = flatten(quote!(#single * #sum, [#nested]));
        assert_eq!(flat.to_string(), quote!(l1 * (a + b), [2]).to_string());
    }

    #[test]
    fn types_are_bounded() {
        let field =
            |ty: String| format!("struct S {{ #[a({})] a: {ty}, b: V<f64> }}", "&".repeat(900)).parse().unwrap();
        assert!(too_tangled(&field(format!("{}f64{}", "V<".repeat(9), ">".repeat(9)))).is_none());
        for ty in [format!("{}f64{}", "V<".repeat(99), ">".repeat(99)), "&'a ".repeat(99), "if a ".repeat(999)] {
            assert!(too_tangled(&field(ty)).is_some());
        }
    }

    #[test]
    fn nesting_is_bounded() {
        let mut tokens = quote!(x);
        for _ in 0..MAX_NESTING {
            tokens = TokenTree::from(Group::new(Delimiter::Parenthesis, tokens)).into();
        }
        assert!(too_deep(&tokens).is_none());
        let tokens = TokenTree::from(Group::new(Delimiter::Bracket, tokens)).into();
        assert!(too_deep(&tokens).is_some());
    }
}

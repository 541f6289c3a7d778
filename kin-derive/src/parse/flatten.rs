//! Token streams before parsing: invisible groups made visible, bottomless ones refused.

use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};

/// The deepest nesting of brackets that is read: parsers recurse, and macros run unoptimised on small stacks.
pub(crate) const MAX_NESTING: usize = 64;

/// The group that is nested too deep for a recursive parser, if there is one.
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

/// Replaces the invisible groups that `macro_rules!` fragments arrive in: one token stands for itself, several
/// become a parenthesis, so that `$l:expr` binds as the user sees it.
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

fn regroup(delimiter: Delimiter, stream: TokenStream, span: Span) -> TokenTree {
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

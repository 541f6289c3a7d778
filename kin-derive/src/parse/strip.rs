//! Removal of the attributes of kin from an item that could not be read as a mechanism.

use super::flatten::{regroup, too_deep};
use super::keyword;
use proc_macro2::{TokenStream, TokenTree};

/// `item` without the attributes of kin and near misses of them, so that the compiler does not report them as unknown.
pub(crate) fn without_ours(item: TokenStream) -> TokenStream {
    if too_deep(&item).is_some() { TokenStream::new() } else { strip(item) }
}

fn strip(tokens: TokenStream) -> TokenStream {
    let mut out = TokenStream::new();
    let mut tokens = tokens.into_iter().peekable();
    while let Some(tree) = tokens.next() {
        let is_pound = matches!(&tree, TokenTree::Punct(punct) if punct.as_char() == '#');
        if is_pound && tokens.peek().is_some_and(is_ours) {
            tokens.next();
            continue;
        }
        out.extend([match tree {
            TokenTree::Group(group) => regroup(group.delimiter(), strip(group.stream()), group.span()),
            leaf => leaf,
        }]);
    }
    out
}

/// True for the brackets of an attribute of kin.
fn is_ours(tree: &TokenTree) -> bool {
    let TokenTree::Group(group) = tree else { return false };
    match group.stream().into_iter().next() {
        Some(TokenTree::Ident(word)) => {
            let word = word.to_string();
            keyword::find(&word).is_some() || keyword::near_miss(&word).is_some()
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::quote;

    #[test]
    fn only_ours_go() {
        let item = quote! {
            #[bodies(a)] #[revolut(A: a, b)] #[derive(Clone)]
            enum E { #[param(1)] #[serde(skip)] A, }
        };
        assert_eq!(
            without_ours(item).to_string(),
            quote! { #[derive(Clone)] enum E { #[serde(skip)] A, } }.to_string()
        );
    }
}

//! The statements of a function's body, divided into blocks.
//!
//! With debug information, rustc overflows its stack on functions with thousands of `let`s. Statements are therefore
//! grouped in nested blocks that return only the values that later blocks need.

use kin_core::program::ValueId;
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::HashMap;

/// The number of statements in one block.
pub(super) const BLOCK: usize = 500;

/// A statement: the values that it defines with their names, the values that it reads, and its tokens.
#[derive(Default)]
pub(super) struct EmittedStatement {
    pub(super) defines: Vec<(ValueId, Vec<Ident>)>,
    pub(super) uses: Vec<ValueId>,
    pub(super) tokens: TokenStream,
}

/// Statements in blocks of bounded length, each of which returns the values that later blocks read.
pub(super) fn blocks(statements: &[EmittedStatement]) -> TokenStream {
    if statements.len() <= BLOCK {
        return statements.iter().map(|s| &s.tokens).cloned().collect();
    }
    let last_use: HashMap<ValueId, usize> = (statements.chunks(BLOCK).enumerate())
        .flat_map(|(number, block)| block.iter().flat_map(move |s| s.uses.iter().map(move |value| (*value, number))))
        .collect();
    let mut out = TokenStream::new();
    for (number, block) in statements.chunks(BLOCK).enumerate() {
        let tokens = block.iter().map(|s| &s.tokens);
        let leaving: Vec<&Ident> = (block.iter().flat_map(|s| &s.defines))
            .filter(|(value, _)| last_use.get(value).is_some_and(|last| *last > number))
            .flat_map(|(_, names)| names)
            .collect();
        out.extend(if leaving.is_empty() {
            quote! { { #(#tokens)* } }
        } else {
            quote! { let [#(#leaving),*] = { #(#tokens)* [#(#leaving),*] }; }
        });
    }
    out
}

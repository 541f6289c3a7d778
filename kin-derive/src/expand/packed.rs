//! Long tables as one text, a few kinds, and numbers; `kin_runtime::tables` unpacks them.
//!
//! Short tables stay struct literals, which are easier to read.

use kin_core::constraint::Frame;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use std::fmt::Write;

/// Entries from which on a table is packed.
const LONG: usize = 64;

/// True for a table that is packed.
pub(super) fn is_long(entries: usize) -> bool {
    entries >= LONG
}

/// A table as it is packed, entry by entry.
pub(super) struct Packed<K> {
    entries: usize,
    text: String,
    words: String,
    kinds: Vec<K>,
}

impl<K: PartialEq> Packed<K> {
    /// A table of so many entries.
    pub(super) fn new(entries: usize) -> Self {
        Self { entries, text: String::new(), words: String::new(), kinds: Vec::new() }
    }

    /// Number of entries.
    pub(super) const fn entries(&self) -> usize {
        self.entries
    }

    pub(super) fn word(&mut self, word: usize) {
        // Writing to a string never fails.
        let _ = write!(self.words, "{word},");
    }

    pub(super) fn name(&mut self, name: &str) {
        self.word(name.len());
        self.text.push_str(name);
    }

    pub(super) fn place(&mut self, place: Option<usize>) {
        self.word(place.map_or(0, |k| k + 1));
    }

    pub(super) fn frame(&mut self, frame: Option<Frame>) {
        self.word(match frame {
            None => 0,
            Some(Frame::Ground) => 1,
            Some(Frame::Body(k)) => k + 2,
        });
    }

    pub(super) fn kind(&mut self, kind: K) {
        let known = self.kinds.iter().position(|other| *other == kind);
        self.word(known.unwrap_or(self.kinds.len()));
        if known.is_none() {
            self.kinds.push(kind);
        }
    }

    /// The array, unpacked by `function`; kinds as `tokens` writes them.
    pub(super) fn with_kinds(&self, function: &str, tokens: impl Fn(&K) -> TokenStream) -> TokenStream {
        let kinds = self.kinds.iter().map(tokens);
        self.unpacked(function, &quote! { , &[#(#kinds),*] })
    }

    /// The array, unpacked by `function` with more arguments.
    pub(super) fn unpacked(&self, function: &str, arguments: &TokenStream) -> TokenStream {
        let (function, entries) = (Ident::new(function, Span::call_site()), self.entries);
        let text = &self.text;
        // Numbers and commas; from text, because that is one step and not one for each of them.
        let words: TokenStream = self.words.parse().unwrap_or_default();
        quote! { __kin::tables::#function::<#entries>(#text, &[#words] #arguments) }
    }

    /// The kinds, for a table that is packed beside this one's words.
    pub(super) fn kinds(&self, tokens: impl Fn(&K) -> TokenStream) -> TokenStream {
        let kinds = self.kinds.iter().map(tokens);
        quote! { &[#(#kinds),*] }
    }
}

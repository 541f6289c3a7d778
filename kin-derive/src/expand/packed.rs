//! Long tables as one text, a few kinds, and numbers in bytes; `kin_runtime::tables` unpacks them.
//!
//! A text and a string of bytes are one token each, however much they hold. Short tables stay struct literals, which are
//! easier to read.

use kin_core::constraint::Frame;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

/// Entries from which on a table is packed, and every other table of its mechanism with it.
const LONG: usize = 64;

/// True where tables of so many entries are packed.
pub(super) fn any_is_long(entries: &[usize]) -> bool {
    entries.iter().any(|count| *count >= LONG)
}

/// A table as it is packed, entry by entry.
pub(super) struct Packed<K> {
    entries: usize,
    text: String,
    bytes: Vec<u8>,
    kinds: Vec<K>,
}

impl<K: PartialEq> Packed<K> {
    /// A table of so many entries.
    pub(super) fn new(entries: usize) -> Self {
        Self { entries, text: String::new(), bytes: Vec::new(), kinds: Vec::new() }
    }

    /// Seven bits in a byte, the lowest first; all but the last are above 127.
    pub(super) fn word(&mut self, mut word: usize) {
        while word > 127 {
            self.bytes.push(word as u8 | 128);
            word >>= 7;
        }
        self.bytes.push(word as u8);
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

    /// The table, unpacked as `table`; kinds as `tokens` writes them.
    pub(super) fn with_kinds(&self, table: &str, tokens: impl Fn(&K) -> TokenStream) -> TokenStream {
        let kinds = self.kinds(tokens);
        self.unpacked(table, &quote! { , #kinds })
    }

    /// The table, unpacked as `table` with more arguments.
    pub(super) fn unpacked(&self, table: &str, arguments: &TokenStream) -> TokenStream {
        let (table, entries) = (Ident::new(table, Span::call_site()), Literal::usize_unsuffixed(self.entries));
        let (text, bytes) = (&self.text, Literal::byte_string(&self.bytes));
        quote! { __kin::tables::unpack!(#table, #entries, #text, #bytes #arguments) }
    }

    /// The kinds, for a table that has other arguments, too.
    pub(super) fn kinds(&self, tokens: impl Fn(&K) -> TokenStream) -> TokenStream {
        let kinds = self.kinds.iter().map(tokens);
        quote! { &[#(#kinds),*] }
    }
}

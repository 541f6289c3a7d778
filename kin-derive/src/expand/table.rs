//! The writer of static tables, which prints every one from one description: its entries as struct literals, or, where
//! some table of the mechanism is long, as one text, a few kinds, and numbers in bytes, which `kin_runtime::tables` unpacks.
//!
//! A text and a string of bytes are one token each, however much they hold. Short tables are easier to read as literals.

use super::entries::{frame, optional};
use kin_core::constraint::Frame;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote};

/// Entries from which on a table is packed, and every other table of its mechanism with it.
const LONG: usize = 64;

/// What differs from entry to entry of one kind.
#[derive(Clone)]
pub(super) enum Cell<'a> {
    Name(&'a str),
    Word(usize),
    Place(Option<usize>),
    Frame(Frame),
    /// The frame that a joint has there, if any.
    End(Option<Frame>),
    /// The frame that carries an origin, if any.
    Origin(Option<Frame>),
    /// A list of so many entries of another table, as it is written where it belongs.
    List(usize, TokenStream),
}

impl Cell<'_> {
    fn literal(&self) -> TokenStream {
        match self {
            Cell::Name(name) => name.to_token_stream(),
            Cell::Word(word) => word.to_token_stream(),
            Cell::Place(place) => optional(*place),
            Cell::Frame(of) => frame(*of),
            Cell::End(of) => optional(of.map(frame)),
            Cell::Origin(None) => quote! { __kin::OriginKind::Free },
            Cell::Origin(Some(of)) => {
                let of = frame(*of);
                quote! { __kin::OriginKind::Carried(#of) }
            }
            Cell::List(_, tokens) => tokens.clone(),
        }
    }

    /// What stands in its place in a kind.
    fn blank(&self) -> TokenStream {
        match self {
            Cell::Name(_) => Cell::Name("").literal(),
            Cell::Word(_) => Cell::Word(0).literal(),
            Cell::Place(_) => Cell::Place(None).literal(),
            Cell::Frame(_) => Cell::Frame(Frame::Ground).literal(),
            Cell::End(_) => Cell::End(None).literal(),
            Cell::Origin(_) => Cell::Origin(None).literal(),
            Cell::List(..) => quote! { &[] },
        }
    }
}

/// Text and numbers of a packed table.
#[derive(Default)]
struct Packed {
    text: String,
    bytes: Vec<u8>,
}

impl Packed {
    /// Seven bits in a byte, the lowest first; all but the last are above 127.
    fn word(&mut self, mut word: usize) {
        while word > 127 {
            self.bytes.push(word as u8 | 128);
            word >>= 7;
        }
        self.bytes.push(word as u8);
    }

    fn cell(&mut self, cell: &Cell<'_>) {
        let word = match *cell {
            Cell::Name(name) => {
                self.text.push_str(name);
                name.len()
            }
            Cell::Word(word) | Cell::List(word, _) => word,
            Cell::Place(place) => place.map_or(0, |k| k + 1),
            Cell::Frame(Frame::Ground) | Cell::End(Some(Frame::Ground)) | Cell::Origin(Some(Frame::Ground)) => 1,
            Cell::Frame(Frame::Body(k)) | Cell::End(Some(Frame::Body(k))) | Cell::Origin(Some(Frame::Body(k))) => k + 2,
            Cell::End(None) | Cell::Origin(None) => 0,
        };
        self.word(word);
    }
}

/// Lists of which each belongs to an entry of another table.
pub(super) struct Lists {
    /// The cells of those entries.
    pub(super) cells: Vec<Cell<'static>>,
    /// All lists one after another, where tables are packed.
    pub(super) whole: TokenStream,
}

/// Writes the tables of a mechanism.
#[derive(Clone, Copy)]
pub(super) struct Writer {
    pub(super) packed: bool,
}

impl Writer {
    /// A writer for tables of so many entries.
    pub(super) fn of(entries: &[usize]) -> Self {
        Self { packed: entries.iter().any(|count| *count >= LONG) }
    }

    /// A table of entries of several kinds: `tokens` is an entry of a kind with cells.
    pub(super) fn table<'a, K: PartialEq, const N: usize>(
        self,
        name: &str,
        entries: impl IntoIterator<Item = (K, [Cell<'a>; N])>,
        tokens: impl Fn(&K, [TokenStream; N]) -> TokenStream,
    ) -> TokenStream {
        self.with_lists(name, entries, [], tokens)
    }

    /// A table of entries of one kind.
    pub(super) fn alike<'a, const N: usize>(
        self,
        name: &str,
        entries: impl IntoIterator<Item = [Cell<'a>; N]>,
        tokens: impl Fn([TokenStream; N]) -> TokenStream,
    ) -> TokenStream {
        self.with_lists(name, entries.into_iter().map(|cells| ((), cells)), [], |(), cells| tokens(cells))
    }

    /// A table with lists in its entries, all of them in `lists`.
    pub(super) fn with_lists<'a, K: PartialEq, const N: usize>(
        self,
        name: &str,
        entries: impl IntoIterator<Item = (K, [Cell<'a>; N])>,
        lists: impl IntoIterator<Item = TokenStream>,
        tokens: impl Fn(&K, [TokenStream; N]) -> TokenStream,
    ) -> TokenStream {
        let entries = entries.into_iter();
        if !self.packed {
            let entries = entries.map(|(kind, cells)| tokens(&kind, cells.each_ref().map(Cell::literal)));
            return quote! { &[#(#entries),*] };
        }
        // Entries of one kind need not say which.
        let has_kinds = size_of::<K>() > 0;
        let (mut packed, mut kinds, mut count) = (Packed::default(), Vec::<(K, TokenStream)>::new(), 0_usize);
        for (kind, cells) in entries {
            count += 1;
            if has_kinds {
                let place = kinds.iter().position(|(other, _)| *other == kind).unwrap_or(kinds.len());
                packed.word(place);
                if place == kinds.len() {
                    let blank = tokens(&kind, cells.each_ref().map(Cell::blank));
                    kinds.push((kind, blank));
                }
            }
            cells.iter().for_each(|cell| packed.cell(cell));
        }
        let (name, count) = (Ident::new(name, Span::call_site()), Literal::usize_unsuffixed(count));
        let (text, bytes) = (packed.text, Literal::byte_string(&packed.bytes));
        let kinds = kinds.iter().map(|(_, tokens)| tokens);
        let kinds = has_kinds.then(|| quote! { &[#(#kinds),*] });
        let arguments = kinds.into_iter().chain(lists);
        quote! { __kin::tables::unpack!(#name, #count, #text, #bytes #(, #arguments)*) }
    }

    /// Lists for [`with_lists`](Self::with_lists).
    pub(super) fn lists<'a, K: PartialEq, const N: usize>(
        self,
        name: &str,
        lists: impl IntoIterator<Item = Vec<(K, [Cell<'a>; N])>>,
        tokens: impl Fn(&K, [TokenStream; N]) -> TokenStream,
    ) -> Lists {
        let (mut cells, mut all) = (Vec::new(), Vec::new());
        for list in lists {
            let count = list.len();
            if self.packed {
                cells.push(Cell::List(count, TokenStream::new()));
                all.extend(list);
            } else {
                cells.push(Cell::List(count, self.table(name, list, &tokens)));
            }
        }
        let whole = if self.packed { self.table(name, all, tokens) } else { TokenStream::new() };
        Lists { cells, whole }
    }
}

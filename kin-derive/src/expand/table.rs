//! The writer of static tables. It prints every table from one description: as struct literals or, if any table of the
//! mechanism is long, in packed form as one text, a list of the distinct kinds, and numbers in bytes, which
//! `kin_runtime::tables` unpacks.
//!
//! A text and a byte string are one token each, whatever their length. Short tables are printed as literals, which are
//! easier to read.

use super::entries::{frame, optional};
use kin_core::constraint::Frame;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote};

/// Number of entries from which on a table is packed, together with all other tables of its mechanism.
const MIN_PACKED_ENTRIES: usize = 64;

/// A part of an entry that differs between entries of the same kind.
#[derive(Clone)]
pub(super) enum Cell<'a> {
    Name(&'a str),
    Word(usize),
    Place(Option<usize>),
    Frame(Frame),
    /// The frame of one end of a joint, if it has one.
    End(Option<Frame>),
    /// The frame that carries a body's origin, if there is one.
    Origin(Option<Frame>),
    /// The length of a list in another table, and the list as a literal.
    List(usize, TokenStream),
}

impl Cell<'_> {
    fn literal(&self) -> TokenStream {
        match self {
            Cell::Name(name) => name.to_token_stream(),
            Cell::Word(word) => word.to_token_stream(),
            Cell::Place(place) => optional(*place),
            Cell::Frame(body) => frame(*body),
            Cell::End(end) => optional(end.map(frame)),
            Cell::Origin(None) => quote! { __kin::OriginKind::Free },
            Cell::Origin(Some(carrier)) => {
                let carrier = frame(*carrier);
                quote! { __kin::OriginKind::Carried(#carrier) }
            }
            Cell::List(_, tokens) => tokens.clone(),
        }
    }

    /// The placeholder for this cell in the description of a kind.
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

/// The text and the bytes of a packed table.
#[derive(Default)]
struct Packed {
    text: String,
    bytes: Vec<u8>,
}

impl Packed {
    /// Appends a number in groups of seven bits, the lowest first; all bytes except the last are above 127.
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

/// Lists, each of which belongs to an entry of another table.
pub(super) struct Lists {
    /// The cells that refer to the lists.
    pub(super) cells: Vec<Cell<'static>>,
    /// The concatenation of all lists, for packed tables.
    pub(super) whole: TokenStream,
}

/// The writer of the tables of a mechanism.
#[derive(Clone, Copy)]
pub(super) struct Writer {
    pub(super) packed: bool,
}

impl Writer {
    /// A writer for tables with these numbers of entries.
    pub(super) fn of(entries: &[usize]) -> Self {
        Self { packed: entries.iter().any(|count| *count >= MIN_PACKED_ENTRIES) }
    }

    /// A table of entries of several kinds; `tokens` prints an entry from its kind and cells.
    pub(super) fn table<'a, K: PartialEq, const N: usize>(
        self,
        name: &str,
        entries: impl IntoIterator<Item = (K, [Cell<'a>; N])>,
        tokens: impl Fn(&K, [TokenStream; N]) -> TokenStream,
    ) -> TokenStream {
        self.with_lists(name, entries, [], tokens)
    }

    /// A table of entries of a single kind.
    pub(super) fn alike<'a, const N: usize>(
        self,
        name: &str,
        entries: impl IntoIterator<Item = [Cell<'a>; N]>,
        tokens: impl Fn([TokenStream; N]) -> TokenStream,
    ) -> TokenStream {
        self.with_lists(name, entries.into_iter().map(|cells| ((), cells)), [], |(), cells| tokens(cells))
    }

    /// A table whose entries contain lists, which are given in `lists`.
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
        // A table with a single kind stores no index of the kind.
        let has_kinds = size_of::<K>() > 0;
        let (mut packed, mut kinds, mut count) = (Packed::default(), Vec::<(K, TokenStream)>::new(), 0_usize);
        for (kind, cells) in entries {
            count += 1;
            if has_kinds {
                let index = kinds.iter().position(|(other, _)| *other == kind).unwrap_or(kinds.len());
                packed.word(index);
                if index == kinds.len() {
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

    /// The lists of a table, for [`with_lists`](Self::with_lists).
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

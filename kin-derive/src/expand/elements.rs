//! Names for the elements of a kernel's arrays, and for its literals.
//!
//! ```text
//! let [__q0, _, __q2, ..] = q;        in place of q[0] and q[2]
//! let __n0 = T::from_f64(2.0);        for a literal that is used several times
//! ```
//!
//! rustc takes ten times as long to check the type of an index expression as that of a name, and four times as long for a
//! literal; a kernel reads and writes little else. An element is bound by reference, so it is read and written at the same
//! places as by its index.

use super::instructions::{argument, number, target_name};
use kin_core::expr::Symbol;
use kin_core::program::{Instruction, Piece, Rolled, Slot, Source, Step, Value};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

/// The longest pattern for an array, as a multiple of the elements that it names.
const PATTERN: usize = 8;

/// The elements and literals that have names.
#[derive(Default)]
pub(super) struct Elements {
    arrays: BTreeMap<&'static str, BTreeSet<usize>>,
    /// The bits of the literals, each with its number.
    literals: BTreeMap<u64, usize>,
}

impl Elements {
    /// The elements that a program reads and writes at constant indices.
    ///
    /// Left out are arrays of which it uses few elements, and those that it writes and whose elements a loop reads or
    /// writes one by one: one name would forbid all other access.
    pub(super) fn of(rolled: &Rolled) -> Self {
        let (mut named, mut written, mut by_index) = (Self::default(), BTreeSet::new(), BTreeSet::new());
        let mut literals: BTreeMap<u64, usize> = BTreeMap::new();
        for piece in &rolled.pieces {
            let (is_loop, steps) = match piece {
                Piece::Straight(steps) => (false, steps),
                Piece::Loop { body, .. } => (true, body),
            };
            let mut uses = |array: &'static str, index: usize, step: i64| {
                if is_loop && step != 0 {
                    by_index.insert(array);
                } else {
                    named.arrays.entry(array).or_default().insert(index);
                }
            };
            for step in steps {
                for_each_source(rolled, step, |source| match source {
                    Source::Load(symbol, step) if is_array(symbol) => {
                        uses(argument(symbol), symbol.index() as usize, step);
                    }
                    Source::Number(bits) => *literals.entry(bits.value().to_bits()).or_insert(0) += 1,
                    _ => {}
                });
                if let Step::Write { slot, step, .. } = step {
                    written.insert(target_name(*slot));
                    uses(target_name(*slot), slot.index(), *step);
                }
            }
        }
        named.arrays.retain(|array, elements| {
            let length = elements.last().map_or(0, |last| last + 1);
            length <= PATTERN * elements.len() && !(written.contains(array) && by_index.contains(array))
        });
        let several = literals.into_iter().filter(|(_, uses)| *uses > 1);
        named.literals = several.enumerate().map(|(number, (bits, _))| (bits, number)).collect();
        named
    }

    /// The statements that bind the names.
    pub(super) fn bindings(&self) -> TokenStream {
        let bindings = self.arrays.iter().map(|(array, elements)| {
            let length = elements.last().map_or(0, |last| last + 1);
            let patterns = (0..length).map(|index| {
                if elements.contains(&index) {
                    let name = element(array, index);
                    quote! { #name }
                } else {
                    quote! { _ }
                }
            });
            let array = Ident::new(array, Span::call_site());
            quote! { let [#(#patterns,)* ..] = #array; }
        });
        let literals = self.literals.iter().map(|(bits, place)| {
            let (name, value) = (literal_name(*place), number(f64::from_bits(*bits)));
            quote! { let #name = #value; }
        });
        bindings.chain(literals).collect()
    }

    /// The name of the element from which a symbol is read, if it has one.
    pub(super) fn read(&self, symbol: Symbol) -> Option<Ident> {
        self.name(argument(symbol), symbol.index() as usize)
    }

    /// The name of the element to which a slot is written, if it has one.
    pub(super) fn write(&self, slot: Slot) -> Option<Ident> {
        self.name(target_name(slot), slot.index())
    }

    /// A literal: its name, if it has one.
    pub(super) fn literal(&self, value: f64) -> TokenStream {
        match self.literals.get(&value.to_bits()) {
            Some(place) => literal_name(*place).into_token_stream(),
            None => number(value),
        }
    }

    fn name(&self, array: &'static str, index: usize) -> Option<Ident> {
        self.arrays.get(array)?.contains(&index).then(|| element(array, index))
    }
}

fn literal_name(place: usize) -> Ident {
    format_ident!("__n{place}")
}

fn element(array: &str, index: usize) -> Ident {
    format_ident!("__{array}{index}")
}

/// Whether a symbol is an element of an argument that is an array.
fn is_array(symbol: Symbol) -> bool {
    !matches!(symbol, Symbol::Time | Symbol::ARGUMENT | Symbol::Coarseness)
}

/// The sources of all values that a step reads.
fn for_each_source(rolled: &Rolled, step: &Step, mut read: impl FnMut(Source)) {
    let mut value = |value: Value| read(rolled.sources[value.index()]);
    match step {
        // Parts of a value that another step has computed.
        Step::Compute {
            instruction: Instruction::SinOf(_) | Instruction::CosOf(_) | Instruction::SuppliedOf(..),
            ..
        } => {}
        Step::Compute { instruction, .. } => instruction.for_each_operand(value),
        Step::Write { source, .. } => value(*source),
    }
}

//! Names for the elements of a kernel's arrays.
//!
//! ```text
//! let [__q0, _, __q2, ..] = q;        in place of q[0] and q[2]
//! ```
//!
//! rustc takes ten times as long to check the type of an index expression as that of a name, and most operands and
//! results of a kernel are elements of arrays. An element is bound by reference, so it is read and written at the same
//! points of the program as by its index.

use super::instructions::{argument, target_name};
use kin_core::expr::Symbol;
use kin_core::program::{Instruction, OperandSource, Piece, Rolled, RolledStep, Slot, ValueId};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

/// The longest pattern for an array, as a multiple of the elements that it names.
const PATTERN: usize = 8;

/// The elements that have names.
#[derive(Default)]
pub(super) struct Elements(BTreeMap<&'static str, BTreeSet<usize>>);

impl Elements {
    /// The elements that a program reads and writes at constant indices.
    ///
    /// Left out are arrays of which the program uses few elements. Also left out are arrays that it writes and that a
    /// loop accesses at a varying index: while an element is borrowed mutably, Rust allows no index into its array.
    pub(super) fn of(rolled: &Rolled) -> Self {
        let (mut named, mut written, mut by_index) = (Self::default(), BTreeSet::new(), BTreeSet::new());
        for piece in &rolled.pieces {
            let (is_loop, steps) = match piece {
                Piece::Straight(steps) => (false, steps),
                Piece::Loop { body, .. } => (true, body),
            };
            let mut uses = |array: &'static str, index: usize, step: i64| {
                if is_loop && step != 0 {
                    by_index.insert(array);
                } else {
                    named.0.entry(array).or_default().insert(index);
                }
            };
            for step in steps {
                for_each_source(rolled, step, |source| {
                    if let OperandSource::Load(symbol, step) = source
                        && is_array(symbol)
                    {
                        uses(argument(symbol), symbol.index() as usize, step);
                    }
                });
                if let RolledStep::Write { slot, step, .. } = step {
                    written.insert(target_name(*slot));
                    uses(target_name(*slot), slot.index(), *step);
                }
            }
        }
        named.0.retain(|array, elements| {
            let length = elements.last().map_or(0, |last| last + 1);
            length <= PATTERN * elements.len() && !(written.contains(array) && by_index.contains(array))
        });
        named
    }

    /// The statements that bind the names.
    pub(super) fn bindings(&self) -> TokenStream {
        let bindings = self.0.iter().map(|(array, elements)| {
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
        bindings.collect()
    }

    /// The name of the element from which a symbol is read, if it has one.
    pub(super) fn read(&self, symbol: Symbol) -> Option<Ident> {
        self.name(argument(symbol), symbol.index() as usize)
    }

    /// The name of the element to which a slot is written, if it has one.
    pub(super) fn write(&self, slot: Slot) -> Option<Ident> {
        self.name(target_name(slot), slot.index())
    }

    fn name(&self, array: &'static str, index: usize) -> Option<Ident> {
        self.0.get(array)?.contains(&index).then(|| element(array, index))
    }
}

fn element(array: &str, index: usize) -> Ident {
    format_ident!("__{array}{index}")
}

/// Whether a symbol is an element of an argument that is an array.
fn is_array(symbol: Symbol) -> bool {
    !matches!(symbol, Symbol::Time | Symbol::ARGUMENT | Symbol::Coarseness)
}

/// The sources of all values that a step reads.
fn for_each_source(rolled: &Rolled, step: &RolledStep, mut read: impl FnMut(OperandSource)) {
    let mut value = |value: ValueId| read(rolled.sources[value.index()]);
    match step {
        // Parts of a value that another step has computed.
        RolledStep::Compute {
            instruction: Instruction::SinOf(_) | Instruction::CosOf(_) | Instruction::SuppliedOf(..),
            ..
        } => {}
        RolledStep::Compute { instruction, .. } => instruction.for_each_operand(value),
        RolledStep::Write { source, .. } => value(*source),
    }
}

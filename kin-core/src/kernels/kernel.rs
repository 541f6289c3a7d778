//! A kernel: a program in its final form, with everything that is needed to emit it as a function.

use crate::expr::Symbol;
use crate::program::{Instruction, OperandSource, Piece, Program, Rolled, RolledStep, Slot, finished};
use std::collections::BTreeSet;

/// A program in its final form, which becomes a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The name of the function.
    pub name: String,
    /// The code of the function.
    pub code: Rolled,
    /// The arrays that the function may write, each given by its first slot and its length.
    pub arrays: Vec<(Slot, usize)>,
    /// The length of the array of saved values that the function reads.
    pub saved: usize,
    /// Whether the function is always inlined into its caller.
    pub inlined: bool,
}

impl Kernel {
    /// The kernel of a program that writes to `arrays`.
    pub(super) fn new(name: impl Into<String>, program: &Program, arrays: &[(Slot, usize)]) -> Self {
        Self { name: name.into(), code: finished(program), arrays: arrays.to_vec(), saved: 0, inlined: false }
    }

    /// Sets the length of the array of saved values.
    pub(super) fn with_saved(self, saved: usize) -> Self {
        Self { saved, ..self }
    }

    fn steps(&self) -> impl Iterator<Item = &RolledStep> {
        self.code.pieces.iter().flat_map(|piece| match piece {
            Piece::Straight(steps) | Piece::Loop { body: steps, .. } => steps,
        })
    }

    /// The arrays that the function reads, each given by its first symbol, in order.
    pub fn reads(&self) -> BTreeSet<Symbol> {
        let first = |source: &OperandSource| match *source {
            OperandSource::Load(Symbol::ARGUMENT, _) => Some(Symbol::ARGUMENT),
            OperandSource::Load(Symbol::Input(..), _) => Some(Symbol::Input(0, 0)),
            OperandSource::Load(symbol, _) => Some(symbol.at(0)),
            _ => None,
        };
        self.code.sources.iter().filter_map(first).collect()
    }

    /// The supplied functions that the function calls.
    pub fn functions(&self) -> BTreeSet<u32> {
        let function = |step: &RolledStep| match step {
            RolledStep::Compute { instruction: Instruction::Supplied(function, _), .. } => Some(*function),
            _ => None,
        };
        self.steps().filter_map(function).collect()
    }

    /// The arrays that the function actually writes, each given by its first slot and its length.
    pub fn writes(&self) -> Vec<(Slot, usize)> {
        let written: BTreeSet<Slot> = self
            .steps()
            .filter_map(|step| if let RolledStep::Write { slot, .. } = step { Some(slot.at(0)) } else { None })
            .collect();
        self.arrays.iter().copied().filter(|(slot, _)| written.contains(slot)).collect()
    }
}

//! A kernel: a finished program with what a function of its own needs to know.

use crate::expr::Symbol;
use crate::program::{Instruction, Piece, Program, Rolled, Slot, Source, Step, finished};
use std::collections::BTreeSet;

/// A finished program that becomes a function of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The name of the function.
    pub name: String,
    /// What it does.
    pub code: Rolled,
    /// The arrays that it may write, by the first slot of each, with their lengths.
    pub arrays: Vec<(Slot, usize)>,
    /// How many values stand in the array from which it takes what earlier parts of a solution have held.
    pub held: usize,
    /// Whether it is always inlined into its caller.
    pub inlined: bool,
}

impl Kernel {
    /// Finishes a program that writes to `arrays`.
    pub(super) fn new(name: impl Into<String>, program: &Program, arrays: &[(Slot, usize)]) -> Self {
        Self { name: name.into(), code: finished(program), arrays: arrays.to_vec(), held: 0, inlined: false }
    }

    /// The same kernel among so many values that earlier parts of a solution hold.
    pub(super) fn holding(self, held: usize) -> Self {
        Self { held, ..self }
    }

    fn steps(&self) -> impl Iterator<Item = &Step> {
        self.code.pieces.iter().flat_map(|piece| match piece {
            Piece::Straight(steps) | Piece::Loop { body: steps, .. } => steps,
        })
    }

    /// What it reads: the first symbol of every array, in their order.
    pub fn reads(&self) -> BTreeSet<Symbol> {
        let first = |source: &Source| match *source {
            Source::Load(Symbol::ARGUMENT, _) => Some(Symbol::ARGUMENT),
            Source::Load(Symbol::Input(..), _) => Some(Symbol::Input(0, 0)),
            Source::Load(symbol, _) => Some(symbol.at(0)),
            _ => None,
        };
        self.code.sources.iter().filter_map(first).collect()
    }

    /// The supplied functions that it calls.
    pub fn functions(&self) -> BTreeSet<u32> {
        let function = |step: &Step| match step {
            Step::Compute { instruction: Instruction::Supplied(function, _), .. } => Some(*function),
            _ => None,
        };
        self.steps().filter_map(function).collect()
    }

    /// The arrays that it does write, by the first slot of each, with their lengths.
    pub fn writes(&self) -> Vec<(Slot, usize)> {
        let written: BTreeSet<Slot> = self
            .steps()
            .filter_map(|step| if let Step::Write { slot, .. } = step { Some(slot.at(0)) } else { None })
            .collect();
        self.arrays.iter().copied().filter(|(slot, _)| written.contains(slot)).collect()
    }
}

//! Programs with loops.

use crate::expr::{Bits, Symbol};
use crate::program::{Instruction, Slot, ValueId};
use crate::vocabulary::OperationCount;

/// A part of the result of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ResultPart {
    /// The only value of the instruction.
    Whole,
    /// The sine of a sine–cosine pair.
    Sin,
    /// The cosine of a sine–cosine pair.
    Cos,
    /// The value (0), first (1) or second (2) derivative of a supplied function.
    Derivative(u8),
}

/// The source of an operand in iteration k of its loop (k = 0 in straight code).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperandSource {
    /// A literal.
    Number(Bits),
    /// Entry k of a table of literals.
    Table(usize),
    /// A symbol whose index is advanced by `step`·k.
    Load(Symbol, i64),
    /// A part of a value that this iteration or earlier straight code has computed.
    Local(ValueId, ResultPart),
    /// Element `first + step·k` of an array.
    Element {
        /// The array, as an index of [`Rolled::arrays`].
        array: usize,
        /// The index of the element for iteration 0.
        first: usize,
        /// The step of the index per iteration.
        step: i64,
    },
}

/// The storage of a part of a value in an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keep {
    /// The part that is stored.
    pub part: ResultPart,
    /// The array, as an index of [`Rolled::arrays`].
    pub array: usize,
    /// The index of the element for iteration 0; iteration k writes element `first + k`.
    pub first: usize,
}

/// A step of straight code or of an iteration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RolledStep {
    /// Computes a value.
    Compute {
        /// The name of the value: the value of the original program that straight code or iteration 0 computes.
        value: ValueId,
        /// The instruction; its operands are indices of [`Rolled::sources`].
        instruction: Instruction,
        /// The arrays that store the value.
        keeps: Vec<Keep>,
    },
    /// Writes an output.
    Write {
        /// The slot that iteration 0 writes.
        slot: Slot,
        /// The step of the slot's index per iteration.
        step: i64,
        /// The value, as an index of [`Rolled::sources`].
        source: ValueId,
    },
}

/// A piece of a rolled program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Steps that are executed once.
    Straight(Vec<RolledStep>),
    /// Steps that are executed `count` times.
    Loop {
        /// The number of iterations.
        count: usize,
        /// The steps of an iteration.
        body: Vec<RolledStep>,
    },
}

/// A program with loops.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rolled {
    /// The pieces in order of execution.
    pub pieces: Vec<Piece>,
    /// The sources of the operands of all steps.
    pub sources: Vec<OperandSource>,
    /// The length of every array.
    pub arrays: Vec<usize>,
    /// The tables of literals that differ between iterations.
    pub tables: Vec<Vec<Bits>>,
}

impl Rolled {
    /// The operation count of one run, over all iterations.
    pub fn operations(&self) -> OperationCount {
        let mut count = OperationCount::default();
        for piece in &self.pieces {
            let (times, steps) = match piece {
                Piece::Straight(steps) => (1, steps),
                Piece::Loop { count, body } => (*count, body),
            };
            for step in steps {
                if let RolledStep::Compute { instruction, .. } = step {
                    instruction.count(&mut count, times);
                }
            }
        }
        count
    }
}

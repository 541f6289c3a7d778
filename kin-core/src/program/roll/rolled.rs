//! Programs with loops.

use crate::expr::{Bits, Symbol};
use crate::program::{Instruction, Slot, Value};
use crate::vocabulary::OperationCount;

/// A part of what an instruction computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Part {
    /// Its only value.
    Whole,
    /// The sine of a pair.
    Sin,
    /// The cosine of a pair.
    Cos,
    /// The value (0), first (1) or second (2) derivative of a supplied function.
    Derivative(u8),
}

/// Where an operand comes from, in iteration k of its loop; k = 0 in straight code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A literal.
    Number(Bits),
    /// The literal k of a table.
    Table(usize),
    /// A symbol, its index `step`·k further on.
    Load(Symbol, i64),
    /// What this iteration has computed under this name, or straight code before.
    Local(Value, Part),
    /// Element `first + step·k` of an array.
    Element {
        /// Place in [`Rolled::arrays`].
        array: usize,
        /// Element of iteration 0.
        first: usize,
        /// Elements per iteration.
        step: i64,
    },
}

/// A part of a value that is kept in an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keep {
    /// What is kept.
    pub part: Part,
    /// Place in [`Rolled::arrays`].
    pub array: usize,
    /// Its element of iteration 0; iteration k writes element `first + k`.
    pub first: usize,
}

/// A step of straight code or of an iteration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Computes a value.
    Compute {
        /// Its name: the value of the program that straight code or iteration 0 computes.
        value: Value,
        /// What to do; its operands are places in [`Rolled::sources`].
        instruction: Instruction,
        /// The arrays that remember it.
        keeps: Vec<Keep>,
    },
    /// Writes an output.
    Write {
        /// The output of iteration 0.
        slot: Slot,
        /// Slots per iteration.
        step: i64,
        /// Place in [`Rolled::sources`].
        source: Value,
    },
}

/// A piece of a rolled program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Steps that are done once.
    Straight(Vec<Step>),
    /// Steps that are done `count` times.
    Loop {
        /// Number of iterations.
        count: usize,
        /// The steps of one.
        body: Vec<Step>,
    },
}

/// A program with loops.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rolled {
    /// What is done, in order.
    pub pieces: Vec<Piece>,
    /// Where the operands of all steps come from.
    pub sources: Vec<Source>,
    /// The length of every array.
    pub arrays: Vec<usize>,
    /// Literals that differ from iteration to iteration.
    pub tables: Vec<Vec<Bits>>,
}

impl Rolled {
    /// The operations of one run: those of every iteration.
    pub fn operations(&self) -> OperationCount {
        let mut count = OperationCount::default();
        for piece in &self.pieces {
            let (times, steps) = match piece {
                Piece::Straight(steps) => (1, steps),
                Piece::Loop { count, body } => (*count, body),
            };
            for step in steps {
                if let Step::Compute { instruction, .. } = step {
                    instruction.count(&mut count, times);
                }
            }
        }
        count
    }
}

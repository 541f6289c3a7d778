//! Programs without repetition: one straight piece in which atan2 instructions are grouped.

use super::rolled::{Part, Piece, Rolled, Source, Step};
use super::stream::{Action, actions};
use crate::program::{Instruction, Program, Value, group_atan2};

/// `program` as one straight piece.
pub(super) fn straight(program: &Program) -> Rolled {
    let program = group_atan2(program);
    let taken_together =
        |instruction: &Instruction| matches!(instruction, Instruction::SinCos(_) | Instruction::Atan2(..));
    let steps = actions(&program, taken_together).into_iter().map(|action| match action {
        Action::Compute(value) => {
            Step::Compute { value, instruction: program.instructions[value.index()], keeps: Vec::new() }
        }
        Action::Write(slot, source) => Step::Write { slot, step: 0, source },
    });
    let sources = program.instructions.iter().enumerate().map(|(index, instruction)| match *instruction {
        Instruction::Number(bits) => Source::Number(bits),
        Instruction::Load(symbol) => Source::Load(symbol, 0),
        Instruction::SinOf(pair) => Source::Local(pair, Part::Sin),
        Instruction::CosOf(pair) => Source::Local(pair, Part::Cos),
        Instruction::SuppliedOf(triple, order) => Source::Local(triple, Part::Derivative(order)),
        _ => Source::Local(Value(index as u32), Part::Whole),
    });
    Rolled { pieces: vec![Piece::Straight(steps.collect())], sources: sources.collect(), ..Rolled::default() }
}

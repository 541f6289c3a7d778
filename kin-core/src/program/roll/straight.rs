//! Programs without repetition: one straight piece in which atan2 instructions are grouped.

use super::rolled::{OperandSource, Piece, ResultPart, Rolled, RolledStep};
use super::stream::{Action, actions};
use crate::program::{Instruction, Program, ValueId, group_atan2};

/// `program` as one straight piece.
pub(super) fn straight(program: &Program) -> Rolled {
    let program = group_atan2(program);
    let taken_together =
        |instruction: &Instruction| matches!(instruction, Instruction::SinCos(_) | Instruction::Atan2(..));
    let steps = actions(&program, taken_together).into_iter().map(|action| match action {
        Action::Compute(value) => {
            RolledStep::Compute { value, instruction: program.instructions[value.index()], keeps: Vec::new() }
        }
        Action::Write(slot, source) => RolledStep::Write { slot, step: 0, source },
    });
    let sources = program.instructions.iter().enumerate().map(|(index, instruction)| match *instruction {
        Instruction::Number(bits) => OperandSource::Number(bits),
        Instruction::Load(symbol) => OperandSource::Load(symbol, 0),
        Instruction::SinOf(pair) => OperandSource::Local(pair, ResultPart::Sin),
        Instruction::CosOf(pair) => OperandSource::Local(pair, ResultPart::Cos),
        Instruction::SuppliedOf(triple, order) => OperandSource::Local(triple, ResultPart::Derivative(order)),
        _ => OperandSource::Local(ValueId(index as u32), ResultPart::Whole),
    });
    Rolled { pieces: vec![Piece::Straight(steps.collect())], sources: sources.collect(), ..Rolled::default() }
}

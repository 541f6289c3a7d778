//! Local value numbering: equal instructions share one value.

use super::{Instruction, ValueId};
use crate::hash::{Table, hash_of};

/// A list of instructions without duplicates.
#[derive(Default)]
pub(super) struct ValueNumbering {
    pub(super) instructions: Vec<Instruction>,
    values: Table,
}

impl ValueNumbering {
    /// The value of an instruction, which is appended if it is new. The operands of sums and products are brought into
    /// a fixed order, literals last, so that a + b and b + a are equal.
    pub(super) fn emit(&mut self, instruction: Instruction) -> ValueId {
        let in_order = |a: ValueId, b: ValueId| {
            let is_literal = |value: ValueId| matches!(self.instructions[value.index()], Instruction::Number(_));
            if (is_literal(b), a) > (is_literal(a), b) { (b, a) } else { (a, b) }
        };
        let canonical = match instruction {
            Instruction::Add(a, b) => {
                let (a, b) = in_order(a, b);
                Instruction::Add(a, b)
            }
            Instruction::Mul(a, b) => {
                let (a, b) = in_order(a, b);
                Instruction::Mul(a, b)
            }
            other => other,
        };
        let hash = hash_of(&canonical);
        if let Some(index) = self.values.find(hash, |index| self.instructions[index] == canonical) {
            return ValueId(index as u32);
        }
        let value = ValueId(self.instructions.len() as u32);
        self.instructions.push(canonical);
        self.values.insert(hash, value.index());
        value
    }
}

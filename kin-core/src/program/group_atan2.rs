//! Groups independent atan2 instructions, because several of them evaluated together cost little more than one.
//!
//! This applies to straight-line code only; in a program from which loops are formed it would destroy the repetition.

use super::{Instruction, Program, ValueId};

/// Maximum distance between two instructions of a group.
const MAX_GROUP_DISTANCE: usize = 96;

/// Reorders `program` so that independent atan2 instructions follow one another, where no SinCos lies between them.
pub fn group_atan2(program: &Program) -> Program {
    program.reordered(&order(&program.instructions))
}

impl Program {
    /// The instructions in another order, in which operands still come first; instructions that `order` omits are
    /// dropped.
    pub(super) fn reordered(&self, order: &[usize]) -> Self {
        let mut renumbered = vec![ValueId(0); self.instructions.len()];
        for (new, old) in order.iter().enumerate() {
            renumbered[*old] = ValueId(new as u32);
        }
        let to = |value: ValueId| renumbered[value.index()];
        Self {
            instructions: order.iter().map(|old| self.instructions[*old].map_operands(to)).collect(),
            outputs: self.outputs.iter().map(|(slot, value)| (*slot, to(*value))).collect(),
        }
    }
}

fn order(instructions: &[Instruction]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..instructions.len()).collect();
    let is_atan2 = |index: usize| matches!(instructions[index], Instruction::Atan2(..));
    let mut after_atan2 = vec![false; instructions.len()];
    let mut first = 0;
    while first < order.len() {
        if !is_atan2(order[first]) {
            first += 1;
            continue;
        }
        let window = order[first..].iter().take(MAX_GROUP_DISTANCE);
        let window: Vec<usize> =
            window.copied().take_while(|&index| !matches!(instructions[index], Instruction::SinCos(_))).collect();
        let (mut free, mut grouped, mut after) = (Vec::new(), Vec::new(), Vec::new());
        for &index in &window {
            let mut needs = false;
            instructions[index].for_each_operand(|operand| needs |= after_atan2[operand.index()]);
            let group = match needs {
                true => &mut after,
                false if is_atan2(index) => &mut grouped,
                false => &mut free,
            };
            group.push(index);
            after_atan2[index] = needs || is_atan2(index);
        }
        window.iter().for_each(|&index| after_atan2[index] = false);
        let next = first + if grouped.len() > 1 { free.len() + grouped.len() } else { 1 };
        if grouped.len() > 1 {
            let grouped = free.into_iter().chain(grouped).chain(after);
            order[first..first + window.len()].iter_mut().zip(grouped).for_each(|(index, new)| *index = new);
        }
        first = next;
    }
    order
}

//! Reorders the terms of sums so that terms that depend on the result of a function are added last.
//!
//! A row of a joint is the difference of two points, (r + A s) − (r′ + A′ s′). In this order all additions depend on
//! sines and cosines; in (r − r′) + A s − A′ s′ the difference of the origins does not. The rows of a joint then become
//! chains of the same form, which a compiler vectorises.

use super::value_numbering::ValueNumbering;
use super::{Instruction, Program, ValueId};

/// A term of a sum: the index of its instruction, and whether it is subtracted.
type Term = (usize, bool);

/// Reorders every sum of at least three terms whose partial sums have no other use. The number of operations is
/// unchanged.
pub(super) fn early_terms_first(program: Program) -> Program {
    let instructions = &program.instructions;
    let (depends_on_function, partial_sums) = (depends_on_function(instructions), partial_sums(&program));
    // Partial sums are removed only where the sum is reordered.
    let mut orders = vec![None; instructions.len()];
    let mut part_of_ordered = vec![false; instructions.len()];
    let has_parts = |index: usize| match instructions[index] {
        Instruction::Add(a, b) | Instruction::Sub(a, b) => partial_sums[a.index()] || partial_sums[b.index()],
        _ => false,
    };
    for index in (0..instructions.len()).filter(|index| !partial_sums[*index] && has_parts(*index)) {
        let (terms, parts) = terms(instructions, &partial_sums, index);
        orders[index] = ordered(terms, &depends_on_function);
        if orders[index].is_some() {
            parts.into_iter().for_each(|part| part_of_ordered[part] = true);
        }
    }
    if !part_of_ordered.contains(&true) {
        return program;
    }
    let mut renumbered = vec![ValueId(0); instructions.len()];
    let mut value_numbering = ValueNumbering::default();
    for (index, order) in orders.into_iter().enumerate().filter(|(index, _)| !part_of_ordered[*index]) {
        renumbered[index] = match order {
            None => value_numbering.emit(instructions[index].map_operands(|value| renumbered[value.index()])),
            Some((first, others)) => others.into_iter().fold(renumbered[first], |sum, (term, minus)| {
                let term = renumbered[term];
                value_numbering.emit(if minus { Instruction::Sub(sum, term) } else { Instruction::Add(sum, term) })
            }),
        };
    }
    let outputs = program.outputs.iter().map(|(slot, value)| (*slot, renumbered[value.index()])).collect();
    Program { instructions: value_numbering.instructions, outputs }
}

/// For every instruction, whether it depends on the result of a function such as a sine or cosine.
fn depends_on_function(instructions: &[Instruction]) -> Vec<bool> {
    let mut depends_on_function = vec![false; instructions.len()];
    for (index, instruction) in instructions.iter().enumerate() {
        let mut depends = matches!(
            instruction,
            Instruction::SinCos(_) | Instruction::Call(..) | Instruction::Atan2(..) | Instruction::Supplied(..)
        );
        instruction.for_each_operand(|operand| depends |= depends_on_function[operand.index()]);
        depends_on_function[index] = depends;
    }
    depends_on_function
}

/// For every instruction, whether it is a sum whose only use is as a term of another sum.
fn partial_sums(program: &Program) -> Vec<bool> {
    let is_sum = |instruction: &Instruction| matches!(instruction, Instruction::Add(..) | Instruction::Sub(..));
    let mut uses = vec![0_u32; program.instructions.len()];
    let mut in_sum = vec![false; program.instructions.len()];
    for instruction in &program.instructions {
        instruction.for_each_operand(|operand| {
            uses[operand.index()] += 1;
            in_sum[operand.index()] |= is_sum(instruction);
        });
    }
    program.outputs.iter().for_each(|(_, value)| uses[value.index()] += 2);
    let instructions = program.instructions.iter().zip(uses.into_iter().zip(in_sum));
    instructions.map(|(instruction, (uses, in_sum))| is_sum(instruction) && uses == 1 && in_sum).collect()
}

/// The terms of a sum from left to right, and the partial sums that it is made of.
fn terms(instructions: &[Instruction], partial_sums: &[bool], root: usize) -> (Vec<Term>, Vec<usize>) {
    let (mut terms, mut parts) = (Vec::new(), Vec::new());
    let mut open = vec![(root, false)];
    while let Some((index, minus)) = open.pop() {
        let operands = match instructions[index] {
            Instruction::Add(a, b) if index == root || partial_sums[index] => [(a, minus), (b, minus)],
            Instruction::Sub(a, b) if index == root || partial_sums[index] => [(a, minus), (b, !minus)],
            _ => {
                terms.push((index, minus));
                continue;
            }
        };
        if index != root {
            parts.push(index);
        }
        let [first, second] = operands.map(|(value, minus)| (value.index(), minus));
        open.extend([second, first]);
    }
    (terms, parts)
}

/// The first term, which is not subtracted, and the remaining terms, those that depend on a function last. `None` if
/// the order would gain nothing.
fn ordered(mut terms: Vec<Term>, depends_on_function: &[bool]) -> Option<(usize, Vec<Term>)> {
    let waiting = terms.iter().filter(|(index, _)| depends_on_function[*index]).count();
    if terms.len() < 3 || waiting == 0 || waiting == terms.len() {
        return None;
    }
    terms.sort_by_key(|(index, _)| depends_on_function[*index]);
    // There is always a term that is added: the leftmost one.
    let first = terms.iter().position(|(_, minus)| !minus)?;
    let (first, _) = terms.remove(first);
    Some((first, terms))
}

//! Sums in the order in which their terms are there: what waits for a function comes last.
//!
//! A row of a joint is a difference of two points, (r + A s) − (r′ + A′ s′). Taken as it stands, everything in it but two
//! operations waits for sines and cosines; as (r − r′) + A s − A′ s′ the origins do not, and the rows of a joint are chains
//! of one kind, which a compiler packs into vectors.

use super::numbered::Numbered;
use super::{Instruction, Program, Value};

/// A term of a sum: its place, and whether it is subtracted.
type Term = (usize, bool);

/// `program` with every sum of three terms or more, whose parts nobody else uses, taken from the earliest term to the latest;
/// as many operations as before.
pub(super) fn early_terms_first(program: Program) -> Program {
    let instructions = &program.instructions;
    let (late, inner) = (late(instructions), inner(&program));
    // Sums that stay as they are keep their parts.
    let mut orders = vec![None; instructions.len()];
    let mut part_of_ordered = vec![false; instructions.len()];
    let has_parts = |place: usize| match instructions[place] {
        Instruction::Add(a, b) | Instruction::Sub(a, b) => inner[a.index()] || inner[b.index()],
        _ => false,
    };
    for place in (0..instructions.len()).filter(|place| !inner[*place] && has_parts(*place)) {
        let (terms, parts) = terms(instructions, &inner, place);
        orders[place] = ordered(terms, &late);
        if orders[place].is_some() {
            parts.into_iter().for_each(|part| part_of_ordered[part] = true);
        }
    }
    if !part_of_ordered.contains(&true) {
        return program;
    }
    let mut renumbered = vec![Value(0); instructions.len()];
    let mut numbered = Numbered::default();
    for (place, order) in orders.into_iter().enumerate().filter(|(place, _)| !part_of_ordered[*place]) {
        renumbered[place] = match order {
            None => numbered.emit(instructions[place].map_operands(|value| renumbered[value.index()])),
            Some((first, others)) => others.into_iter().fold(renumbered[first], |sum, (term, minus)| {
                let term = renumbered[term];
                numbered.emit(if minus { Instruction::Sub(sum, term) } else { Instruction::Add(sum, term) })
            }),
        };
    }
    let outputs = program.outputs.iter().map(|(slot, value)| (*slot, renumbered[value.index()])).collect();
    Program { instructions: numbered.instructions, outputs }
}

/// What waits for a function.
fn late(instructions: &[Instruction]) -> Vec<bool> {
    let mut late = vec![false; instructions.len()];
    for (place, instruction) in instructions.iter().enumerate() {
        let mut own = matches!(
            instruction,
            Instruction::SinCos(_) | Instruction::Call(..) | Instruction::Atan2(..) | Instruction::Supplied(..)
        );
        instruction.for_each_operand(|operand| own |= late[operand.index()]);
        late[place] = own;
    }
    late
}

/// Sums that are used once, in another sum.
fn inner(program: &Program) -> Vec<bool> {
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
    let own = program.instructions.iter().zip(uses.into_iter().zip(in_sum));
    own.map(|(instruction, (uses, in_sum))| is_sum(instruction) && uses == 1 && in_sum).collect()
}

/// The terms of a sum from left to right, and the sums that are parts of it.
fn terms(instructions: &[Instruction], inner: &[bool], root: usize) -> (Vec<Term>, Vec<usize>) {
    let (mut terms, mut parts) = (Vec::new(), Vec::new());
    let mut open = vec![(root, false)];
    while let Some((place, minus)) = open.pop() {
        let operands = match instructions[place] {
            Instruction::Add(a, b) if place == root || inner[place] => [(a, minus), (b, minus)],
            Instruction::Sub(a, b) if place == root || inner[place] => [(a, minus), (b, !minus)],
            _ => {
                terms.push((place, minus));
                continue;
            }
        };
        if place != root {
            parts.push(place);
        }
        let [first, second] = operands.map(|(value, minus)| (value.index(), minus));
        open.extend([second, first]);
    }
    (terms, parts)
}

/// The term that begins, which is not subtracted, and the others: early before late, otherwise as they stood. None where
/// there is nothing to gain.
fn ordered(mut terms: Vec<Term>, late: &[bool]) -> Option<(usize, Vec<Term>)> {
    let waiting = terms.iter().filter(|(place, _)| late[*place]).count();
    if terms.len() < 3 || waiting == 0 || waiting == terms.len() {
        return None;
    }
    terms.sort_by_key(|(place, _)| late[*place]);
    // The leftmost term of all is never subtracted.
    let first = terms.iter().position(|(_, minus)| !minus)?;
    let (first, _) = terms.remove(first);
    Some((first, terms))
}

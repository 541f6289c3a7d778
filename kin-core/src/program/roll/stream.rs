//! A program as a stream of items in which repetition can be detected.
//!
//! An item is an instruction that computes a value, or the writing of an output. An operand has an address: the number
//! of the item that computes it, the index of a symbol, or the index of a slot. All other properties of an item form
//! its kind. Items of the same kind therefore have the same code, and the differences of their addresses are the steps
//! of a loop.

use super::rolled::ResultPart;
use crate::expr::{Bits, Symbol};
use crate::hash::{Table, hash_of};
use crate::program::{Instruction, Program, Slot, ValueId};

/// The action of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Action {
    /// Computes a value of the program.
    Compute(ValueId),
    /// Writes a value of the program to an output.
    Write(Slot, ValueId),
}

/// The actions of a program in order. Every output is written directly after the instruction that computes it; outputs
/// that are literals or inputs come first. Consecutive instructions for which `taken_together` holds are kept
/// together, and their outputs follow the group.
pub(super) fn actions(program: &Program, taken_together: impl Fn(&Instruction) -> bool) -> Vec<Action> {
    let (mut actions, mut after) = (Vec::new(), vec![Vec::new(); program.instructions.len()]);
    for &(slot, value) in &program.outputs {
        match program.instructions[value.index()] {
            Instruction::Number(_) | Instruction::Load(_) => actions.push(Action::Write(slot, value)),
            _ => after[holder(program, value).index()].push(Action::Write(slot, value)),
        }
    }
    let mut waiting = Vec::new();
    for (index, instruction) in program.instructions.iter().enumerate() {
        if is_operand(instruction) {
            continue;
        }
        let alone = !taken_together(instruction);
        if alone {
            actions.append(&mut waiting);
        }
        actions.push(Action::Compute(ValueId(index as u32)));
        let written = if alone { &mut actions } else { &mut waiting };
        written.append(&mut after[index]);
    }
    actions.append(&mut waiting);
    actions
}

/// An operand of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ItemOperand {
    Number(Bits),
    Load(Symbol),
    /// A part of the result of another item.
    Item(usize, ResultPart),
    /// The index of the slot that is written.
    Slot(usize),
}

/// The properties that items with the same code have in common.
#[derive(PartialEq, Eq, Hash)]
struct ItemKind {
    head: Head,
    operands: [OperandKind; MAX_OPERANDS],
}

/// The operation of an item without its operands.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Head {
    Compute(Instruction),
    Write(Slot),
}

/// An operand without its address.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum OperandKind {
    Number,
    Load(Symbol),
    Item(ResultPart),
}

/// Maximum number of operands of an item.
const MAX_OPERANDS: usize = 2;

pub(super) struct Stream {
    pub(super) actions: Vec<Action>,
    /// The kind of each item; items of the same kind have equal numbers.
    pub(super) kinds: Vec<u32>,
    /// The operands of item k are `operands[starts[k]..starts[k + 1]]`.
    pub(super) starts: Vec<usize>,
    operands: Vec<ItemOperand>,
    pub(super) addresses: Vec<i64>,
}

impl Stream {
    /// The stream of a program.
    pub(super) fn of(program: &Program) -> Self {
        let mut builder = Builder {
            program,
            positions: vec![usize::MAX; program.instructions.len()],
            kinds: Vec::new(),
            places: Table::default(),
            stream: Self {
                actions: Vec::new(),
                kinds: Vec::new(),
                starts: vec![0],
                operands: Vec::new(),
                addresses: Vec::new(),
            },
        };
        for action in actions(program, |instruction| matches!(instruction, Instruction::SinCos(_))) {
            match action {
                Action::Compute(value) => builder.compute(value),
                Action::Write(slot, value) => builder.write(slot, value),
            }
        }
        builder.stream
    }

    /// The number of items.
    pub(super) fn len(&self) -> usize {
        self.actions.len()
    }

    /// The operands of an item; the first operand of a written output is its slot.
    pub(super) fn operands(&self, item: usize) -> &[ItemOperand] {
        &self.operands[self.starts[item]..self.starts[item + 1]]
    }

    /// The addresses of an item's operands; the address of a literal is 0.
    pub(super) fn addresses(&self, item: usize) -> &[i64] {
        &self.addresses[self.starts[item]..self.starts[item + 1]]
    }
}

/// True for instructions that are not items but are written as operands where they are used.
fn is_operand(instruction: &Instruction) -> bool {
    matches!(
        instruction,
        Instruction::Number(_)
            | Instruction::Load(_)
            | Instruction::SinOf(_)
            | Instruction::CosOf(_)
            | Instruction::SuppliedOf(..)
    )
}

/// The value that an item computes: the value itself, or the pair or triple that it is a component of.
fn holder(program: &Program, value: ValueId) -> ValueId {
    match program.instructions[value.index()] {
        Instruction::SinOf(whole) | Instruction::CosOf(whole) | Instruction::SuppliedOf(whole, _) => whole,
        _ => value,
    }
}

struct Builder<'p> {
    program: &'p Program,
    /// The item that computes each value.
    positions: Vec<usize>,
    kinds: Vec<ItemKind>,
    /// Finds a kind by its hash.
    places: Table,
    stream: Stream,
}

impl Builder<'_> {
    fn compute(&mut self, value: ValueId) {
        let instruction = self.program.instructions[value.index()];
        let (mut operands, mut count) = ([ItemOperand::Slot(0); MAX_OPERANDS], 0);
        instruction.for_each_operand(|operand| {
            operands[count] = self.operand(operand);
            count += 1;
        });
        let blank = instruction.map_operands(|_| ValueId(0));
        self.positions[value.index()] = self.stream.len();
        self.push(Action::Compute(value), Head::Compute(blank), &operands[..count]);
    }

    fn write(&mut self, slot: Slot, value: ValueId) {
        let operands = [ItemOperand::Slot(slot.index()), self.operand(value)];
        self.push(Action::Write(slot, value), Head::Write(slot.at(0)), &operands);
    }

    fn push(&mut self, action: Action, head: Head, operands: &[ItemOperand]) {
        let stream = &mut self.stream;
        let mut kind = ItemKind { head, operands: [OperandKind::Number; MAX_OPERANDS] };
        let mut k = 0;
        while k < operands.len() {
            kind.operands[k] = operand_kind(&operands[k]);
            stream.addresses.push(address(&operands[k]));
            stream.operands.push(operands[k]);
            k += 1;
        }
        let hash = hash_of(&kind);
        let number = self.places.find(hash, |index| self.kinds[index] == kind).unwrap_or_else(|| {
            self.places.insert(hash, self.kinds.len());
            self.kinds.push(kind);
            self.kinds.len() - 1
        });
        stream.kinds.push(number as u32);
        stream.actions.push(action);
        stream.starts.push(stream.operands.len());
    }

    fn operand(&self, value: ValueId) -> ItemOperand {
        let item = |value: ValueId, part| ItemOperand::Item(self.positions[value.index()], part);
        match self.program.instructions[value.index()] {
            Instruction::Number(bits) => ItemOperand::Number(bits),
            Instruction::Load(symbol) => ItemOperand::Load(symbol),
            Instruction::SinOf(pair) => item(pair, ResultPart::Sin),
            Instruction::CosOf(pair) => item(pair, ResultPart::Cos),
            Instruction::SuppliedOf(triple, order) => item(triple, ResultPart::Derivative(order)),
            _ => item(value, ResultPart::Whole),
        }
    }
}

fn operand_kind(operand: &ItemOperand) -> OperandKind {
    match *operand {
        ItemOperand::Number(_) | ItemOperand::Slot(_) => OperandKind::Number,
        ItemOperand::Load(symbol) => OperandKind::Load(symbol.at(0)),
        ItemOperand::Item(_, part) => OperandKind::Item(part),
    }
}

fn address(operand: &ItemOperand) -> i64 {
    match *operand {
        ItemOperand::Number(_) => 0,
        ItemOperand::Load(symbol) => i64::from(symbol.index()),
        ItemOperand::Item(item, _) => item as i64,
        ItemOperand::Slot(index) => index as i64,
    }
}

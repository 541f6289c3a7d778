//! Turns the loops of a stream into a rolled program by assigning arrays, tables and sources of operands.

use super::detect::Span;
use super::rolled::{Keep, OperandSource, Piece, ResultPart, Rolled, RolledStep};
use super::stream::{Action, ItemOperand, Stream};
use crate::program::{Program, ValueId};
use std::collections::{BTreeMap, BTreeSet};

/// The loop that an item belongs to: the corresponding item of the first iteration (the template) and the loop's
/// period.
#[derive(Clone, Copy)]
struct LoopMember {
    template: usize,
    period: usize,
}

/// The array for one part of the items `template + k·period`, if this part is read outside the iteration that computes
/// it.
#[derive(Clone, Copy, Debug)]
struct LoopArray {
    number: usize,
    /// The range of iterations, including items that straight code computes before and after the loop.
    first: i64,
    last: i64,
}

pub(super) fn resolve(program: &Program, stream: &Stream, loops: &[Span]) -> Rolled {
    let mut resolver = Resolver {
        program,
        stream,
        members: vec![None; stream.len()],
        ranges: BTreeMap::new(),
        outside: BTreeSet::new(),
        keeps: BTreeMap::new(),
        rolled: Rolled::default(),
    };
    for span in loops {
        for item in span.start..span.end() {
            let template = span.start + (item - span.start) % span.period;
            resolver.members[item] = Some(LoopMember { template, period: span.period });
        }
    }
    resolver.find_arrays(loops);
    resolver.lay_out();
    resolver.write(loops);
    resolver.rolled
}

struct Resolver<'a> {
    program: &'a Program,
    stream: &'a Stream,
    /// For items in loops, their template and period.
    members: Vec<Option<LoopMember>>,
    /// The arrays by template and part.
    ranges: BTreeMap<(usize, ResultPart), LoopArray>,
    /// Items of straight code that are stored as elements of a loop's array: (item, template, part, iteration).
    outside: BTreeSet<(usize, usize, ResultPart, i64)>,
    /// The arrays in which parts of an item are stored.
    keeps: BTreeMap<usize, Vec<Keep>>,
    rolled: Rolled,
}

/// All pieces of a program; straight code is represented as a loop of one iteration.
fn pieces(stream: &Stream, loops: &[Span]) -> Vec<Span> {
    let mut out = Vec::new();
    let mut at = 0;
    let straight = |from: usize, to: usize| Span { start: from, period: to - from, count: 1 };
    for span in loops {
        if span.start > at {
            out.push(straight(at, span.start));
        }
        out.push(*span);
        at = span.end();
    }
    if at < stream.len() {
        out.push(straight(at, stream.len()));
    }
    out
}

impl Resolver<'_> {
    /// The step of an operand's address from one iteration to the next.
    fn step(&self, span: Span, item: usize, operand: usize) -> i64 {
        if span.count < 2 {
            return 0;
        }
        self.stream.addresses(item + span.period)[operand] - self.stream.addresses(item)[operand]
    }

    /// The template of the items `first`, `first + step`, …; `None` if each value is computed in the iteration that
    /// reads it, or all of them by straight code.
    fn array(&self, span: Span, first: usize, step: i64) -> Option<LoopMember> {
        if step == 0 {
            return self.members[first];
        }
        let is_itself = (span.start..span.start + span.period).contains(&first) && step == span.period as i64;
        let at = |k: usize| (first as i64 + k as i64 * step) as usize;
        if is_itself { None } else { (0..span.count).find_map(|k| self.members[at(k)]) }
    }

    fn find_arrays(&mut self, loops: &[Span]) {
        for span in pieces(self.stream, loops) {
            for item in span.start..span.start + span.period {
                for (index, operand) in self.stream.operands(item).iter().enumerate() {
                    let ItemOperand::Item(first, part) = *operand else { continue };
                    let step = self.step(span, item, index);
                    let Some(member) = self.array(span, first, step) else { continue };
                    let iteration =
                        |k: usize| (first as i64 + k as i64 * step - member.template as i64) / member.period as i64;
                    let (first_iteration, last_iteration) = (iteration(0), iteration(span.count - 1));
                    let number = self.ranges.len();
                    let range =
                        self.ranges.entry((member.template, part)).or_insert(LoopArray { number, first: 0, last: 0 });
                    range.first = range.first.min(first_iteration).min(last_iteration);
                    range.last = range.last.max(first_iteration).max(last_iteration);
                    for k in 0..span.count {
                        let read = (first as i64 + k as i64 * step) as usize;
                        if self.members[read].is_none() {
                            self.outside.insert((read, member.template, part, iteration(k)));
                        }
                    }
                }
            }
        }
        for span in loops {
            for template in span.start..span.start + span.period {
                for (_, range) in
                    self.ranges.range_mut((template, ResultPart::Whole)..(template + 1, ResultPart::Whole))
                {
                    range.last = range.last.max(span.count as i64 - 1);
                }
            }
        }
    }

    /// Sets the lengths of the arrays and the elements that each item is stored in.
    fn lay_out(&mut self) {
        self.rolled.arrays = vec![0; self.ranges.len()];
        let keep = |(template, part), iteration: i64| {
            let range: &LoopArray = &self.ranges[&(template, part)];
            Keep { part, array: range.number, first: (iteration - range.first) as usize }
        };
        for (&(template, part), range) in &self.ranges {
            self.rolled.arrays[range.number] = (range.last - range.first + 1) as usize;
            self.keeps.entry(template).or_default().push(keep((template, part), 0));
        }
        for &(item, template, part, iteration) in &self.outside {
            self.keeps.entry(item).or_default().push(keep((template, part), iteration));
        }
    }

    fn write(&mut self, loops: &[Span]) {
        for span in pieces(self.stream, loops) {
            let body = (span.start..span.start + span.period).map(|item| self.write_step(span, item)).collect();
            self.rolled.pieces.push(match span.count {
                1 => Piece::Straight(body),
                count => Piece::Loop { count, body },
            });
        }
    }

    fn write_step(&mut self, span: Span, item: usize) -> RolledStep {
        let mut operands = Vec::new();
        for place in 0..self.stream.operands(item).len() {
            let source = self.source(span, item, place);
            operands.push(ValueId(self.rolled.sources.len() as u32));
            self.rolled.sources.push(source);
        }
        match self.stream.actions[item] {
            Action::Compute(value) => {
                let next = core::cell::Cell::new(0);
                let instruction = self.program.instructions[value.index()].map_operands(|_| {
                    next.set(next.get() + 1);
                    operands[next.get() - 1]
                });
                RolledStep::Compute { value, instruction, keeps: self.keeps.get(&item).cloned().unwrap_or_default() }
            }
            // The first operand of a written output is its slot.
            Action::Write(slot, _) => RolledStep::Write { slot, step: self.step(span, item, 0), source: operands[1] },
        }
    }

    fn source(&mut self, span: Span, item: usize, index: usize) -> OperandSource {
        let step = self.step(span, item, index);
        match self.stream.operands(item)[index] {
            ItemOperand::Slot(_) => OperandSource::Number(crate::expr::Bits::new(0.0)),
            ItemOperand::Load(symbol) => OperandSource::Load(symbol, step),
            ItemOperand::Number(bits) => {
                let literal = |k: usize| match self.stream.operands(item + k * span.period)[index] {
                    ItemOperand::Number(bits) => bits,
                    _ => bits,
                };
                let literals: Vec<_> = (0..span.count).map(literal).collect();
                if literals.iter().all(|other| *other == bits) {
                    return OperandSource::Number(bits);
                }
                let tables = &mut self.rolled.tables;
                let known = tables.iter().position(|table| *table == literals);
                OperandSource::Table(known.unwrap_or_else(|| {
                    tables.push(literals);
                    tables.len() - 1
                }))
            }
            ItemOperand::Item(first, part) => match self.array(span, first, step) {
                None => OperandSource::Local(self.value(first), part),
                Some(member) => {
                    let range = self.ranges[&(member.template, part)];
                    let period = member.period as i64;
                    let iteration = (first as i64 - member.template as i64) / period;
                    OperandSource::Element {
                        array: range.number,
                        first: (iteration - range.first) as usize,
                        step: step / period,
                    }
                }
            },
        }
    }

    /// The value that an item computes.
    fn value(&self, item: usize) -> ValueId {
        match self.stream.actions[item] {
            Action::Compute(value) => value,
            Action::Write(..) => ValueId(0),
        }
    }
}

//! A straight-line program as the body of a function.

use super::instructions::{ANGLES, definition, ident, load, name, names_of, number, target};
use super::rolled;
use super::statements::{Statement, blocks};
use kin_core::expr::Symbol;
use kin_core::program::{Instruction, Program, Value, Worth, gather, roll};
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::BTreeSet;

/// Which of a kernel's arguments its program reads.
#[derive(Clone, Default)]
pub(crate) struct Reads {
    pub(crate) parameters: bool,
    pub(crate) time: bool,
    pub(crate) inputs: bool,
    pub(crate) coordinates: bool,
    pub(crate) rates: bool,
    pub(crate) modes: bool,
    pub(crate) start: bool,
    pub(crate) unknowns: bool,
    pub(crate) held: bool,
    pub(crate) right: bool,
    /// Numbers of the supplied functions.
    pub(crate) functions: BTreeSet<u32>,
    pub(crate) argument: bool,
}

impl Reads {
    pub(crate) fn of(program: &Program) -> Self {
        let mut reads = Self::default();
        for instruction in &program.instructions {
            match instruction {
                Instruction::Load(Symbol::Parameter(_)) => reads.parameters = true,
                Instruction::Load(Symbol::Time) => reads.time = true,
                Instruction::Load(Symbol::Input(..)) => reads.inputs = true,
                Instruction::Load(Symbol::ARGUMENT) => reads.argument = true,
                Instruction::Load(Symbol::Coordinate(_)) => reads.coordinates = true,
                Instruction::Load(Symbol::Rate(_)) => reads.rates = true,
                Instruction::Load(Symbol::Mode(_)) => reads.modes = true,
                Instruction::Load(Symbol::Start(_)) => reads.start = true,
                Instruction::Load(Symbol::Unknown(_)) => reads.unknowns = true,
                Instruction::Load(Symbol::Held(_)) => reads.held = true,
                Instruction::Load(Symbol::Right(_)) => reads.right = true,
                Instruction::Supplied(function, _) => _ = reads.functions.insert(*function),
                _ => {}
            }
        }
        reads
    }
}

/// The statements that compute `program` and write its outputs to `phi`, `phi_q`, `phi_t`, `gamma` or `out`; regular
/// repetition as loops. Supplied functions are arguments of the kernel.
pub(crate) fn body(program: &Program) -> TokenStream {
    if let Some(rolled) = roll(program, Worth::default()) {
        return rolled::body(&rolled);
    }
    let emitter = Emitter { program: &gather(program) };
    let mut statements = emitter.statements();
    emitter.place_outputs(&mut statements);
    blocks(&statements)
}

struct Emitter<'p> {
    program: &'p Program,
}

impl Emitter<'_> {
    fn instruction(&self, value: Value) -> Instruction {
        self.program.instructions[value.index()]
    }

    /// The value whose statement defines `value`: itself, or the pair or triple that it is part of.
    fn holder(&self, value: Value) -> Value {
        match self.instruction(value) {
            Instruction::SinOf(whole) | Instruction::CosOf(whole) | Instruction::SuppliedOf(whole, _) => whole,
            _ => value,
        }
    }

    /// The values that an instruction reads; parts of pairs and triples have no statement of their own: whoever uses a
    /// part uses the whole.
    fn uses(&self, value: Value) -> Vec<Value> {
        let mut uses = Vec::new();
        self.instruction(value).for_each_operand(|operand| uses.push(self.holder(operand)));
        uses
    }

    /// `value` as an operand.
    fn operand(&self, value: Value) -> TokenStream {
        match self.instruction(value) {
            Instruction::Number(bits) => number(bits.value()),
            Instruction::Load(symbol) => load(symbol),
            Instruction::SinOf(pair) => ident(name('s', pair)),
            Instruction::CosOf(pair) => ident(name('c', pair)),
            Instruction::SuppliedOf(triple, order) => ident(name(['d', 'e', 'f'][usize::from(order.min(2))], triple)),
            _ => ident(name('v', value)),
        }
    }

    fn statements(&self) -> Vec<Statement> {
        let mut out = Vec::new();
        let mut place = 0;
        while place < self.program.instructions.len() {
            let angles: Vec<(Value, Value)> = (self.program.instructions[place..].iter().zip(place..))
                .map_while(|(instruction, place)| match instruction {
                    Instruction::SinCos(angle) => Some((Value(place as u32), *angle)),
                    _ => None,
                })
                .take(ANGLES)
                .collect();
            let vectors: Vec<(Value, [Value; 2])> = (self.program.instructions[place..].iter().zip(place..))
                .map_while(|(instruction, place)| match instruction {
                    Instruction::Atan2(y, x) => Some((Value(place as u32), [*y, *x])),
                    _ => None,
                })
                .take(ANGLES)
                .collect();
            if !vectors.is_empty() {
                place += vectors.len();
                out.push(self.atan2(&vectors));
            } else if angles.is_empty() {
                out.extend(self.statement(Value(place as u32)));
                place += 1;
            } else {
                place += angles.len();
                out.push(self.sin_cos(&angles));
            }
        }
        out
    }

    fn sin_cos(&self, angles: &[(Value, Value)]) -> Statement {
        let names = angles.iter().map(|(pair, _)| {
            let (s, c) = (name('s', *pair), name('c', *pair));
            quote! { (#s, #c) }
        });
        let operands = angles.iter().map(|(_, angle)| self.operand(*angle));
        let tokens = quote! { let [#(#names),*] = __kin::Scalar::sin_cos_all([#(#operands),*]); };
        let defines = angles.iter().map(|(pair, _)| (*pair, names_of(*pair, &self.instruction(*pair)))).collect();
        Statement { defines, uses: angles.iter().map(|(_, angle)| self.holder(*angle)).collect(), tokens }
    }

    fn atan2(&self, vectors: &[(Value, [Value; 2])]) -> Statement {
        let names = vectors.iter().map(|(angle, _)| name('v', *angle));
        let operands = vectors.iter().map(|(_, [y, x])| {
            let (y, x) = (self.operand(*y), self.operand(*x));
            quote! { (#y, #x) }
        });
        let tokens = quote! { let [#(#names),*] = __kin::Scalar::atan2_all([#(#operands),*]); };
        let defines = vectors.iter().map(|(angle, _)| (*angle, names_of(*angle, &self.instruction(*angle)))).collect();
        Statement { defines, uses: vectors.iter().flat_map(|(angle, _)| self.uses(*angle)).collect(), tokens }
    }

    fn statement(&self, value: Value) -> Option<Statement> {
        let tokens = definition(value, &self.instruction(value), |operand| self.operand(operand))?;
        let defines = vec![(value, names_of(value, &self.instruction(value)))];
        Some(Statement { defines, uses: self.uses(value), tokens })
    }

    /// Writes every output right after the statement that computes it; what needs no statement is written first.
    fn place_outputs(&self, statements: &mut Vec<Statement>) {
        let mut after: Vec<Vec<TokenStream>> = vec![Vec::new(); self.program.instructions.len()];
        let mut first = Vec::new();
        for (slot, value) in &self.program.outputs {
            let (place, operand) = (target(*slot), self.operand(*value));
            let tokens = quote! { #place = #operand; };
            match self.instruction(*value) {
                Instruction::Number(_) | Instruction::Load(_) => {
                    first.push(Statement { tokens, ..Statement::default() });
                }
                _ => after[self.holder(*value).index()].push(tokens),
            }
        }
        let mut placed = first;
        for mut statement in statements.drain(..) {
            for (value, _) in &statement.defines {
                // In one statement with what it writes, so that no block ends between the two.
                statement.tokens.extend(std::mem::take(&mut after[value.index()]));
            }
            placed.push(statement);
        }
        *statements = placed;
    }
}

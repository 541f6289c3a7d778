//! A straight-line program as the body of a function.
//!
//! rustc overflows its stack on functions with thousands of `let`s when debug information is on, so that statements
//! are grouped in nested blocks that hand out only what later blocks need.

use kin_core::expr::Symbol;
use kin_core::mechanism::Function;
use kin_core::program::{Instruction, Program, Slot, Value};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeSet;

/// Statements in one block.
const BLOCK: usize = 500;
/// Angles in one call of `sin_cos_all`.
const ANGLES: usize = 64;

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

/// A statement: what it defines, and its tokens.
struct Statement {
    defines: Vec<Value>,
    tokens: TokenStream,
}

/// The statements that compute `program` and write its outputs to `phi`, `phi_q`, `phi_t`, `gamma` or `out`.
/// Supplied functions are arguments of the kernel.
pub(crate) fn body(program: &Program) -> TokenStream {
    let emitter = Emitter { program };
    let mut statements = emitter.statements();
    emitter.place_outputs(&mut statements);
    if statements.len() <= BLOCK {
        return statements.into_iter().map(|s| s.tokens).collect();
    }
    // The block in which each value is used last decides whether it must leave its own.
    let mut block_of = vec![0_usize; program.instructions.len()];
    for (number, block) in statements.chunks(BLOCK).enumerate() {
        for value in block.iter().flat_map(|s| &s.defines) {
            block_of[value.index()] = number;
        }
    }
    let mut last_use = vec![0_usize; program.instructions.len()];
    for (place, instruction) in program.instructions.iter().enumerate() {
        let user = block_of[place];
        // Parts of pairs and triples have no statement of their own: whoever uses a part uses the whole.
        instruction.for_each_operand(|operand| {
            let operand = emitter.holder(operand);
            last_use[operand.index()] = last_use[operand.index()].max(user);
        });
    }
    let mut out = TokenStream::new();
    let mut rest = statements.as_slice();
    let mut number = 0;
    while !rest.is_empty() {
        let (block, tail) = rest.split_at(rest.len().min(BLOCK));
        let tokens = block.iter().map(|s| &s.tokens);
        let leaving: Vec<Ident> = (block.iter().flat_map(|s| &s.defines))
            .filter(|value| last_use[value.index()] > number)
            .flat_map(|value| emitter.names(*value))
            .collect();
        out.extend(if leaving.is_empty() {
            quote! { { #(#tokens)* } }
        } else {
            quote! { let [#(#leaving),*] = { #(#tokens)* [#(#leaving),*] }; }
        });
        rest = tail;
        number += 1;
    }
    out
}

struct Emitter<'p> {
    program: &'p Program,
}

/// The argument of a kernel that is supplied function `number`.
pub(crate) fn function_name(number: u32) -> Ident {
    format_ident!("__function{number}")
}

/// A local of its own; see `kin_runtime::private::locals` for why no user's constant may have its name.
fn name(prefix: char, value: Value) -> Ident {
    Ident::new(&format!("__{prefix}{}", value.0), Span::call_site())
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

    /// The identifiers that a statement gives to `value`.
    fn names(&self, value: Value) -> Vec<Ident> {
        match self.instruction(value) {
            Instruction::SinCos(_) => vec![name('s', value), name('c', value)],
            Instruction::Supplied(..) => vec![name('d', value), name('e', value), name('f', value)],
            _ => vec![name('v', value)],
        }
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
            if angles.is_empty() {
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
        let tokens = if angles.len() == 1 {
            quote! { let #(#names)* = __kin::Scalar::sin_cos(#(#operands)*); }
        } else {
            quote! { let [#(#names),*] = __kin::Scalar::sin_cos_all([#(#operands),*]); }
        };
        Statement { defines: angles.iter().map(|(pair, _)| *pair).collect(), tokens }
    }

    fn statement(&self, value: Value) -> Option<Statement> {
        let v = |value: Value| self.operand(value);
        let expression = match self.instruction(value) {
            Instruction::Number(_)
            | Instruction::Load(_)
            | Instruction::SinOf(_)
            | Instruction::CosOf(_)
            | Instruction::SinCos(_)
            | Instruction::SuppliedOf(..) => return None,
            Instruction::Neg(a) => {
                let a = v(a);
                quote! { -#a }
            }
            Instruction::Add(a, b) => binary(v(a), quote! { + }, v(b)),
            Instruction::Sub(a, b) => binary(v(a), quote! { - }, v(b)),
            Instruction::Mul(a, b) => binary(v(a), quote! { * }, v(b)),
            Instruction::Div(a, b) => binary(v(a), quote! { / }, v(b)),
            Instruction::Call(f, a) => {
                let (f, a) = (function(f), v(a));
                quote! { __kin::Scalar::#f(#a) }
            }
            Instruction::Sign(a) => {
                let a = v(a);
                quote! { __kin::Scalar::signum(#a) }
            }
            Instruction::Atan2(y, x) => {
                let (y, x) = (v(y), v(x));
                quote! { __kin::Scalar::atan2(#y, #x) }
            }
            Instruction::Nearest(a, b) => {
                let (a, b) = (v(a), v(b));
                quote! { __kin::Scalar::nearest(#a, #b) }
            }
            Instruction::Powi(a, n) => {
                let (a, n) = (v(a), Literal::i32_suffixed(n));
                quote! { __kin::Scalar::powi(#a, #n) }
            }
            Instruction::Powf(a, n) => {
                let (a, n) = (v(a), literal(n.value()));
                quote! { __kin::Scalar::powf(#a, #n) }
            }
            Instruction::Supplied(f, a) => {
                let (function, a) = (function_name(f), v(a));
                let names = self.names(value);
                let tokens = quote! { let [#(#names),*] = __kin::Scalar::lift(#a, #function); };
                return Some(Statement { defines: vec![value], tokens });
            }
        };
        let defined = name('v', value);
        Some(Statement { defines: vec![value], tokens: quote! { let #defined = #expression; } })
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
                    first.push(Statement { defines: Vec::new(), tokens });
                }
                _ => after[self.holder(*value).index()].push(tokens),
            }
        }
        let mut placed = first;
        for mut statement in statements.drain(..) {
            for value in &statement.defines {
                // In one statement with what it writes, so that no block ends between the two.
                statement.tokens.extend(std::mem::take(&mut after[value.index()]));
            }
            placed.push(statement);
        }
        *statements = placed;
    }
}

fn ident(ident: Ident) -> TokenStream {
    quote! { #ident }
}

fn binary(a: TokenStream, operator: TokenStream, b: TokenStream) -> TokenStream {
    quote! { #a #operator #b }
}

/// A literal with its sign; finite by construction.
pub(crate) fn literal(value: f64) -> TokenStream {
    let magnitude = Literal::f64_suffixed(value.abs());
    if value.is_sign_negative() && value != 0.0 {
        quote! { -#magnitude }
    } else {
        quote! { #magnitude }
    }
}

fn number(value: f64) -> TokenStream {
    let value = literal(value);
    quote! { <__T as __kin::Scalar>::from_f64(#value) }
}

fn load(symbol: Symbol) -> TokenStream {
    let at = |k: u32| Literal::usize_unsuffixed(k as usize);
    match symbol {
        Symbol::Parameter(k) => {
            let k = at(k);
            quote! { p[#k] }
        }
        Symbol::Time => quote! { t },
        Symbol::Input(k, order) => {
            let (k, part) = (at(k), format_ident!("{}", ["value", "rate", "acceleration"][usize::from(order.min(2))]));
            quote! { u[#k].#part }
        }
        Symbol::ARGUMENT => quote! { s },
        Symbol::Coordinate(k) => {
            let k = at(k);
            quote! { q[#k] }
        }
        Symbol::Rate(k) => {
            let k = at(k);
            quote! { w[#k] }
        }
        Symbol::Mode(k) => {
            let k = at(k);
            quote! { modes[#k] }
        }
        Symbol::Start(k) => {
            let k = at(k);
            quote! { start[#k] }
        }
        Symbol::Unknown(k) => {
            let k = at(k);
            quote! { unknowns[#k] }
        }
        Symbol::Held(k) => {
            let k = at(k);
            quote! { held[#k] }
        }
        Symbol::Right(k) => {
            let k = at(k);
            quote! { right[#k] }
        }
    }
}

fn function(f: Function) -> Ident {
    Ident::new(f.name(), Span::call_site())
}

fn target(slot: Slot) -> TokenStream {
    let at = Literal::usize_unsuffixed;
    match slot {
        Slot::Phi(k) => {
            let k = at(k);
            quote! { phi[#k] }
        }
        Slot::PhiQ(k) => {
            let k = at(k);
            quote! { phi_q[#k] }
        }
        Slot::PhiT(k) => {
            let k = at(k);
            quote! { phi_t[#k] }
        }
        Slot::Gamma(k) => {
            let k = at(k);
            quote! { gamma[#k] }
        }
        Slot::Entry(k) => {
            let k = at(k);
            quote! { out[#k] }
        }
        Slot::Position(k) => {
            let k = at(k);
            quote! { position[#k] }
        }
        Slot::Velocity(k) => {
            let k = at(k);
            quote! { velocity[#k] }
        }
        Slot::Acceleration(k) => {
            let k = at(k);
            quote! { acceleration[#k] }
        }
        Slot::Margin(k) => {
            let k = at(k);
            quote! { margins[#k] }
        }
        Slot::Held(k) => {
            let k = at(k);
            quote! { held[#k] }
        }
    }
}

//! A rolled program as the body of a function: straight parts as they are, loops as `for`.
//!
//! Arrays have the loops' lengths and every index is affine in the loop's variable, so that the compiler can see that
//! it is in bounds. The sines and cosines of a loop whose angles are known before it are taken several members at a time.

use super::program::{ANGLES, definition, literal, load_at, name, names_of, target_at};
use super::statements::{Statement, blocks};
use kin_core::program::{Instruction, Keep, Part, Piece, Rolled, Source, Step, Value};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// Angles that a loop takes together: a few times as many as the widest lanes hold.
const GATHERED: usize = 16;

/// The statements that compute `rolled` and write its outputs.
pub(super) fn body(rolled: &Rolled) -> TokenStream {
    let lengths = rolled.arrays.iter().enumerate().map(|(number, length)| {
        let array = array(number);
        quote! { let mut #array = [<__T as __kin::Scalar>::from_f64(0.0); #length]; }
    });
    let tables = rolled.tables.iter().enumerate().map(|(number, literals)| {
        let (table, length) = (table(number), literals.len());
        let literals = literals.iter().map(|bits| literal(bits.value()));
        quote! { static #table: [f64; #length] = [#(#literals),*]; }
    });
    let mut statements = Vec::new();
    for piece in &rolled.pieces {
        match piece {
            Piece::Straight(steps) => statements.extend(Emitter { rolled, member: Member::ONE }.steps(steps)),
            Piece::Loop { count, body } => statements.push(repeated(rolled, *count, body)),
        }
    }
    let statements = blocks(&statements);
    quote! { #(#tables)* #(#lengths)* #statements }
}

pub(super) fn array(number: usize) -> Ident {
    format_ident!("__a{number}")
}

pub(super) fn table(number: usize) -> Ident {
    format_ident!("__TABLE{number}")
}

/// A loop as a statement.
fn repeated(rolled: &Rolled, count: usize, body: &[Step]) -> Statement {
    if known_before(rolled, body) {
        return gathered(rolled, count, body);
    }
    let emitter = Emitter { rolled, member: Member { each: 1, offset: 0, varies: true } };
    let statements = emitter.steps(body);
    let (uses, tokens) = (uses(&statements), blocks(&statements));
    let count = Literal::usize_unsuffixed(count);
    Statement { uses, tokens: quote! { for __k in 0..#count { #tokens } }, ..Statement::default() }
}

/// True for a loop that takes sines and cosines and nothing else, of angles that it does not compute itself.
fn known_before(rolled: &Rolled, body: &[Step]) -> bool {
    let mut angles = Vec::new();
    let mut own = Vec::new();
    for step in body {
        let Step::Compute { instruction: Instruction::SinCos(angle), keeps, .. } = step else { return false };
        angles.push(rolled.sources[angle.index()]);
        own.extend(keeps.iter().map(|keep| keep.array));
    }
    angles.iter().all(|angle| match angle {
        Source::Element { array, .. } => !own.contains(array),
        Source::Local(_, part) => *part == Part::Whole,
        _ => true,
    })
}

/// A loop that takes sines and cosines and nothing else: several members at a time.
fn gathered(rolled: &Rolled, count: usize, body: &[Step]) -> Statement {
    let each = (GATHERED / body.len()).clamp(1, count);
    let members = |offsets: core::ops::Range<usize>, each: usize, varies: bool| {
        let mut angles = TokenStream::new();
        let mut kept = TokenStream::new();
        let mut number = 0;
        for offset in offsets {
            let emitter = Emitter { rolled, member: Member { each, offset, varies } };
            for step in body {
                let Step::Compute { instruction: Instruction::SinCos(angle), keeps, .. } = step else { continue };
                let (angle, place) = (emitter.operand(*angle), Literal::usize_unsuffixed(number));
                angles.extend(quote! { #angle, });
                kept.extend(keeps.iter().map(|keep| {
                    let part = Literal::usize_unsuffixed(usize::from(keep.part == Part::Cos));
                    emitter.keep(keep, &quote! { __pairs[#place].#part })
                }));
                number += 1;
            }
        }
        quote! { let __pairs = <__T as __kin::Scalar>::sin_cos_all([#angles]); #kept }
    };
    let chunks = count / each;
    let (chunk, chunks_literal) = (members(0..each, each, true), Literal::usize_unsuffixed(chunks));
    let mut tokens = quote! { for __k in 0..#chunks_literal { #chunk } };
    if chunks * each < count {
        let rest = members(chunks * each..count, 1, false);
        tokens.extend(quote! { { #rest } });
    }
    let uses = body.iter().flat_map(|step| step_uses(rolled, step)).collect();
    Statement { uses, tokens, ..Statement::default() }
}

pub(super) fn uses(statements: &[Statement]) -> Vec<Value> {
    statements.iter().flat_map(|statement| &statement.uses).copied().collect()
}

/// The values that a step reads under their names.
pub(super) fn step_uses(rolled: &Rolled, step: &Step) -> Vec<Value> {
    let mut uses = Vec::new();
    let mut read = |operand: Value| {
        if let Source::Local(value, _) = rolled.sources[operand.index()] {
            uses.push(value);
        }
    };
    match step {
        Step::Compute { instruction, .. } => instruction.for_each_operand(read),
        Step::Write { source, .. } => read(*source),
    }
    uses
}

/// The member of a loop that is written: iteration `each`·k + `offset`.
#[derive(Clone, Copy)]
pub(super) struct Member {
    pub(super) each: usize,
    pub(super) offset: usize,
    /// False where k is 0.
    pub(super) varies: bool,
}

impl Member {
    /// Straight code.
    pub(super) const ONE: Self = Self { each: 1, offset: 0, varies: false };

    /// The index `first` + `step`·iteration.
    pub(super) fn index(self, first: usize, step: i64) -> TokenStream {
        let start_is = (first as i64 + step * self.offset as i64) as usize;
        let start = Literal::usize_unsuffixed(start_is);
        let advance = step * self.each as i64;
        if !self.varies || advance == 0 {
            return quote! { #start };
        }
        let size = Literal::usize_unsuffixed(advance.unsigned_abs() as usize);
        let multiple = if advance.abs() == 1 {
            quote! { __k }
        } else {
            quote! { #size * __k }
        };
        match (start_is, advance) {
            (0, 1..) => multiple,
            (_, 1..) => quote! { #multiple + #start },
            _ => quote! { #start - #multiple },
        }
    }
}

struct Emitter<'r> {
    rolled: &'r Rolled,
    member: Member,
}

impl Emitter<'_> {
    fn steps(&self, steps: &[Step]) -> Vec<Statement> {
        let mut out = Vec::new();
        let mut rest = steps;
        while let [step, tail @ ..] = rest {
            let mut pairs: Vec<(Value, Value, &Vec<Keep>)> = Vec::new();
            for step in rest.iter().take(ANGLES) {
                let Step::Compute { value, instruction: Instruction::SinCos(angle), keeps } = step else { break };
                if step_uses(self.rolled, step).iter().any(|used| pairs.iter().any(|(pair, ..)| pair == used)) {
                    break;
                }
                pairs.push((*value, *angle, keeps));
            }
            if pairs.len() > 1 {
                let uses = rest[..pairs.len()].iter().flat_map(|step| step_uses(self.rolled, step)).collect();
                rest = &rest[pairs.len()..];
                out.push(Statement { uses, ..self.pairs(&pairs) });
            } else {
                rest = tail;
                out.extend(self.step(step));
            }
        }
        out
    }

    /// Sines and cosines that stand together.
    fn pairs(&self, pairs: &[(Value, Value, &Vec<Keep>)]) -> Statement {
        let names = pairs.iter().map(|(value, ..)| {
            let (s, c) = (name('s', *value), name('c', *value));
            quote! { (#s, #c) }
        });
        let angles = pairs.iter().map(|(_, angle, _)| self.operand(*angle));
        let mut tokens = quote! { let [#(#names),*] = __kin::Scalar::sin_cos_all([#(#angles),*]); };
        let mut defines = Vec::new();
        for (value, angle, keeps) in pairs {
            tokens.extend(keeps.iter().map(|keep| self.keep_local(keep, *value)));
            defines.push((*value, names_of(*value, &Instruction::SinCos(*angle))));
        }
        Statement { defines, tokens, uses: Vec::new() }
    }

    fn step(&self, step: &Step) -> Option<Statement> {
        let uses = step_uses(self.rolled, step);
        Some(match step {
            Step::Compute { value, instruction, keeps } => {
                let mut tokens = definition(*value, instruction, |operand| self.operand(operand))?;
                tokens.extend(keeps.iter().map(|keep| self.keep_local(keep, *value)));
                Statement { defines: vec![(*value, names_of(*value, instruction))], uses, tokens }
            }
            Step::Write { slot, step, source } => {
                let target = target_at(*slot, &self.member.index(slot.index(), *step));
                let source = self.operand(*source);
                Statement { uses, tokens: quote! { #target = #source; }, ..Statement::default() }
            }
        })
    }

    fn keep_local(&self, keep: &Keep, value: Value) -> TokenStream {
        let name = local(value, keep.part);
        self.keep(keep, &quote! { #name })
    }

    fn keep(&self, keep: &Keep, value: &TokenStream) -> TokenStream {
        let (array, place) = (array(keep.array), self.member.index(keep.first, 1));
        quote! { #array[#place] = #value; }
    }

    fn operand(&self, source: Value) -> TokenStream {
        match self.rolled.sources[source.index()] {
            Source::Number(bits) => {
                let value = literal(bits.value());
                quote! { <__T as __kin::Scalar>::from_f64(#value) }
            }
            Source::Table(number) => {
                let (table, place) = (table(number), self.member.index(0, 1));
                quote! { <__T as __kin::Scalar>::from_f64(#table[#place]) }
            }
            Source::Load(symbol, step) => load_at(symbol, &self.member.index(symbol.index() as usize, step)),
            Source::Local(value, part) => {
                let name = local(value, part);
                quote! { #name }
            }
            Source::Element { array: number, first, step } => {
                let (array, place) = (array(number), self.member.index(first, step));
                quote! { #array[#place] }
            }
        }
    }
}

/// The name of a part of a value.
pub(super) fn local(value: Value, part: Part) -> Ident {
    let prefix = match part {
        Part::Whole => 'v',
        Part::Sin => 's',
        Part::Cos => 'c',
        Part::Derivative(order) => ['d', 'e', 'f'][usize::from(order.min(2))],
    };
    name(prefix, value)
}

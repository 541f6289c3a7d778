//! The emitter: prints a finished program as the body of a function, with straight pieces as statements and loops as
//! `for`.
//!
//! Consecutive sines and cosines are computed in one call, and so are consecutive angles of vectors. The statements of
//! all pieces are divided into blocks that are small enough for rustc.
//!
//! Arrays have the lengths of the loops and every index is an affine function of the loop's variable, so that the
//! compiler can eliminate bounds checks. If the angles of a loop are known before the loop, their sines and cosines are
//! computed for all members at once.

use super::elements::Elements;
use super::instructions::{definition, literal, load_at, load_of, name, names_of, number, target_at};
use super::statements::{EmittedStatement, blocks};
use kin_core::program::{Angles, Instruction, Keep, OperandSource, Piece, ResultPart, Rolled, RolledStep, ValueId};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

/// The largest number of angles in one call.
const ANGLES: usize = 64;

/// The statements that compute a program and write its outputs. Supplied functions are arguments of the kernel.
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
    let elements = &Elements::of(rolled);
    let straight = Emitter { rolled, elements, member: Member::ONE };
    let emitter = Emitter { rolled, elements, member: Member { varies: true } };
    let mut statements = Vec::new();
    let mut pieces = rolled.pieces.as_slice();
    while let [piece, tail @ ..] = pieces {
        let gathers = gathers(rolled, pieces);
        pieces = if gathers.is_empty() { tail } else { &pieces[gathers.len()..] };
        match piece {
            _ if !gathers.is_empty() => statements.push(emitter.gathered(&gathers)),
            Piece::Straight(steps) => statements.extend(straight.steps(steps)),
            Piece::Loop { count, body } => statements.push(emitter.repeated(*count, body)),
        }
    }
    let (bindings, statements) = (elements.bindings(), blocks(&statements));
    quote! { #(#tables)* #(#lengths)* #bindings #statements }
}

fn array(number: usize) -> Ident {
    format_ident!("__a{number}")
}

fn table(number: usize) -> Ident {
    format_ident!("__TABLE{number}")
}

/// A loop with the body `tokens` over all members.
fn members(count: usize, tokens: &TokenStream) -> TokenStream {
    let count = Literal::usize_unsuffixed(count);
    quote! { for __k in 0..#count { __kin::one_by_one(); #tokens } }
}

/// The loops at the beginning of `pieces` that only compute sines and cosines.
fn gathers<'r>(rolled: &Rolled, pieces: &'r [Piece]) -> Vec<(usize, Vec<Angles<'r>>)> {
    pieces.iter().map_while(|piece| rolled.angles(piece)).collect()
}

/// The array elements from which a call reads angles and to which it writes sines and cosines.
struct Call {
    /// Array and first element; `None` where the result is not needed.
    sines: Option<(usize, usize)>,
    cosines: Option<(usize, usize)>,
    count: usize,
}

impl Call {
    /// True if the elements of `next` directly follow these in the same arrays.
    fn is_before(&self, next: &Self) -> bool {
        let behind = |early: Option<(usize, usize)>, late: Option<(usize, usize)>| {
            early.is_some() && early.map(|(array, first)| (array, first + self.count)) == late
        };
        behind(self.sines, next.sines) && behind(self.cosines, next.cosines)
    }
}

/// The array that keeps a result and the first element there; a temporary array for a result that is not needed.
fn kept_in(place: Option<(usize, usize)>) -> (Ident, usize) {
    place.map_or_else(|| (format_ident!("__spare"), 0), |(number, first)| (array(number), first))
}

/// The index range of `count` elements of an array.
fn places(first: usize, count: usize) -> TokenStream {
    let [first, end] = [first, first + count].map(Literal::usize_unsuffixed);
    quote! { #first..#end }
}

fn uses(statements: &[EmittedStatement]) -> Vec<ValueId> {
    statements.iter().flat_map(|statement| &statement.uses).copied().collect()
}

/// The value that an operand reads from a local variable.
fn local_value(rolled: &Rolled, operand: ValueId) -> Option<ValueId> {
    match rolled.sources[operand.index()] {
        OperandSource::Local(value, _) => Some(value),
        _ => None,
    }
}

/// The values that a step reads from local variables.
fn step_uses(rolled: &Rolled, step: &RolledStep) -> Vec<ValueId> {
    let mut uses = Vec::new();
    let mut read = |operand: ValueId| uses.extend(local_value(rolled, operand));
    match step {
        RolledStep::Compute { instruction, .. } => instruction.for_each_operand(read),
        RolledStep::Write { source, .. } => read(*source),
    }
    uses
}

/// The current member of a loop, with index k, or straight code.
#[derive(Clone, Copy)]
struct Member {
    /// False in straight code, where k is 0.
    varies: bool,
}

impl Member {
    /// Straight code.
    const ONE: Self = Self { varies: false };

    /// The index `first` + `step`·k.
    fn index(self, first: usize, step: i64) -> TokenStream {
        let start = Literal::usize_unsuffixed(first);
        if !self.varies || step == 0 {
            return quote! { #start };
        }
        let size = Literal::usize_unsuffixed(step.unsigned_abs() as usize);
        let multiple = if step.abs() == 1 {
            quote! { __k }
        } else {
            quote! { #size * __k }
        };
        match (first, step) {
            (0, 1..) => multiple,
            (_, 1..) => quote! { #multiple + #start },
            _ => quote! { #start - #multiple },
        }
    }
}

struct Emitter<'r> {
    rolled: &'r Rolled,
    elements: &'r Elements,
    member: Member,
}

impl Emitter<'_> {
    /// A loop as a statement.
    fn repeated(&self, count: usize, body: &[RolledStep]) -> EmittedStatement {
        let statements = self.steps(body);
        let (uses, tokens) = (uses(&statements), blocks(&statements));
        EmittedStatement { uses, tokens: members(count, &tokens), ..EmittedStatement::default() }
    }

    /// The statement for loops that only compute sines and cosines: one call for the angles of all members, which works
    /// in the arrays that keep the results.
    fn gathered(&self, loops: &[(usize, Vec<Angles<'_>>)]) -> EmittedStatement {
        let mut uses = Vec::new();
        let mut calls: Vec<(Call, TokenStream)> = Vec::new();
        for (count, Angles { angle, keeps }) in
            loops.iter().flat_map(|(count, steps)| steps.iter().map(|step| (*count, step)))
        {
            uses.extend(local_value(self.rolled, *angle));
            let array_of =
                |part: ResultPart| keeps.iter().find(|keep| keep.part == part).map(|keep| (keep.array, keep.first));
            let call = Call { sines: array_of(ResultPart::Sin), cosines: array_of(ResultPart::Cos), count };
            let (angles, first) = kept_in(call.sines);
            let (place, angle) = (self.member.index(first, 1), self.operand(*angle));
            let fill = members(count, &quote! { #angles[#place] = #angle; });
            match calls.last_mut() {
                Some((last, fills)) if last.is_before(&call) => {
                    last.count += count;
                    fills.extend(fill);
                }
                _ => calls.push((call, fill)),
            }
        }
        let tokens = calls.iter().map(|(call, fills)| {
            let Call { sines, cosines, count } = *call;
            // At least one of the two is kept; the other one is written to a temporary array.
            let spare = (sines.is_none() || cosines.is_none()).then(|| {
                let length = Literal::usize_unsuffixed(count);
                quote! { let mut __spare = [<__T as __kin::Scalar>::from_f64(0.0); #length]; }
            });
            let ((sines, first), (cosines, first_cosine)) = (kept_in(sines), kept_in(cosines));
            let [sine_places, cosine_places] = [first, first_cosine].map(|first| places(first, count));
            quote! { {
                #spare
                #fills
                __kin::Scalar::sin_cos_in_place(&mut #sines[#sine_places], &mut #cosines[#cosine_places]);
            } }
        });
        EmittedStatement { tokens: tokens.collect(), uses, ..EmittedStatement::default() }
    }

    fn steps(&self, steps: &[RolledStep]) -> Vec<EmittedStatement> {
        let mut out = Vec::new();
        let mut rest = steps;
        while let [step, tail @ ..] = rest {
            match self.alike(rest) {
                0 => {
                    out.extend(self.step(step));
                    rest = tail;
                }
                count => {
                    out.push(self.at_once(&rest[..count]));
                    rest = &rest[count..];
                }
            }
        }
        out
    }

    /// The number of steps at the beginning of `steps` that are all sines and cosines, or all angles of vectors, and do
    /// not depend on one another.
    fn alike(&self, steps: &[RolledStep]) -> usize {
        let kind = |step: &RolledStep| match step {
            RolledStep::Compute { value, instruction: Instruction::SinCos(_), .. } => Some((*value, false)),
            RolledStep::Compute { value, instruction: Instruction::Atan2(..), .. } => Some((*value, true)),
            _ => None,
        };
        let Some((_, first)) = steps.first().and_then(kind) else { return 0 };
        let mut taken: Vec<ValueId> = Vec::new();
        for step in steps.iter().take(ANGLES) {
            match kind(step) {
                Some((value, other))
                    if other == first && !step_uses(self.rolled, step).iter().any(|used| taken.contains(used)) =>
                {
                    taken.push(value);
                }
                _ => break,
            }
        }
        taken.len()
    }

    /// The statement for steps of one kind that are computed in one call.
    fn at_once(&self, steps: &[RolledStep]) -> EmittedStatement {
        let (mut names, mut operands, mut keep) = (Vec::new(), Vec::new(), TokenStream::new());
        let (mut defines, mut function) = (Vec::new(), "sin_cos_all");
        for step in steps {
            let RolledStep::Compute { value, instruction, keeps } = step else { continue };
            let results = names_of(*value, instruction);
            if let Instruction::Atan2(y, x) = *instruction {
                let (y, x) = (self.operand(y), self.operand(x));
                operands.push(quote! { (#y, #x) });
                names.push(quote! { #(#results),* });
                function = "atan2_all";
            } else {
                instruction.for_each_operand(|angle| operands.push(self.operand(angle)));
                names.push(quote! { (#(#results),*) });
            }
            keep.extend(keeps.iter().map(|keep| self.keep(keep, *value)));
            defines.push((*value, results));
        }
        let function = Ident::new(function, Span::call_site());
        let tokens = quote! { let [#(#names),*] = __kin::Scalar::#function([#(#operands),*]); #keep };
        EmittedStatement { defines, uses: steps.iter().flat_map(|step| step_uses(self.rolled, step)).collect(), tokens }
    }

    fn step(&self, step: &RolledStep) -> Option<EmittedStatement> {
        let uses = step_uses(self.rolled, step);
        Some(match step {
            RolledStep::Compute { value, instruction, keeps } => {
                let mut tokens = definition(*value, instruction, |operand| self.operand(operand))?;
                tokens.extend(keeps.iter().map(|keep| self.keep(keep, *value)));
                EmittedStatement { defines: vec![(*value, names_of(*value, instruction))], uses, tokens }
            }
            RolledStep::Write { slot, step, source } => {
                let constant = !self.member.varies || *step == 0;
                let target = match self.elements.write(*slot).filter(|_| constant) {
                    Some(element) => quote! { *#element },
                    None => target_at(*slot, &self.member.index(slot.index(), *step)),
                };
                let source = self.operand(*source);
                EmittedStatement { uses, tokens: quote! { #target = #source; }, ..EmittedStatement::default() }
            }
        })
    }

    fn keep(&self, keep: &Keep, value: ValueId) -> TokenStream {
        let (name, array, place) = (local(value, keep.part), array(keep.array), self.member.index(keep.first, 1));
        quote! { #array[#place] = #name; }
    }

    fn operand(&self, source: ValueId) -> TokenStream {
        match self.rolled.sources[source.index()] {
            OperandSource::Number(bits) => number(bits.value()),
            OperandSource::Table(number) => {
                let (table, index) = (table(number), self.member.index(0, 1));
                quote! { <__T as __kin::Scalar>::from_f64(#table[#index]) }
            }
            OperandSource::Load(symbol, step) => {
                let constant = !self.member.varies || step == 0;
                match self.elements.read(symbol).filter(|_| constant) {
                    Some(element) => load_of(symbol, &element),
                    None => load_at(symbol, &self.member.index(symbol.index() as usize, step)),
                }
            }
            OperandSource::Local(value, part) => {
                let name = local(value, part);
                quote! { #name }
            }
            OperandSource::Element { array: number, first, step } => {
                let (array, index) = (array(number), self.member.index(first, step));
                quote! { #array[#index] }
            }
        }
    }
}

/// The local variable of a part of a value.
fn local(value: ValueId, part: ResultPart) -> Ident {
    let prefix = match part {
        ResultPart::Whole => 'v',
        ResultPart::Sin => 's',
        ResultPart::Cos => 'c',
        ResultPart::Derivative(order) => ['d', 'e', 'f'][usize::from(order.min(2))],
    };
    name(prefix, value)
}

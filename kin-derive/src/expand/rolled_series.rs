//! Kernels of power series with loops.
//!
//! What depends on parameters alone is a program of its own, whose results the other one loads; each is rolled by
//! itself.

use super::program::{literal, load_at, names_of};
use super::rolled::{Member, array, local, step_uses, table, uses};
use super::statements::{Statement, blocks};
use kin_core::expr::Symbol;
use kin_core::program::{Instruction, Piece, Program, Rolled, Slot, Source, Step, Value, Worth, roll};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeMap;

/// The statements of `program`; nothing where it has no repetition, or supplied functions, which are written straight.
pub(super) fn body(program: &Program) -> Option<TokenStream> {
    if program.instructions.iter().any(|instruction| matches!(instruction, Instruction::Supplied(..))) {
        return None;
    }
    let (numbers, values) = parted(program);
    let rolled = roll(&values, Worth::default())?;
    let held = numbers.outputs.len();
    let numbers = (held > 0).then(|| {
        let body = super::program::body(&numbers);
        quote! {
            fn constants<__T: __kin::Scalar>(p: &__Parameters<__T>, held: &mut [__T; #held]) {
                let _ = p;
                #body
            }
            let held: [f64; #held] = __kin::Arithmetic::constants(x, || {
                let mut held = [0.0; #held];
                constants(p, &mut held);
                held
            });
        }
    });
    let lengths = rolled.arrays.iter().enumerate().map(|(number, length)| {
        let array = array(number);
        quote! { let mut #array = [<__X as __kin::Arithmetic>::constant(0.0); #length]; }
    });
    let tables = rolled.tables.iter().enumerate().map(|(number, literals)| {
        let (table, length) = (table(number), literals.len());
        let literals = literals.iter().map(|bits| literal(bits.value()));
        quote! { static #table: [f64; #length] = [#(#literals),*]; }
    });
    let mut statements = Vec::new();
    for piece in &rolled.pieces {
        match piece {
            Piece::Straight(steps) => {
                let emitter = Emitter { rolled: &rolled, member: Member::ONE };
                statements.extend(steps.iter().map(|step| emitter.step(step)));
            }
            Piece::Loop { count, body } => {
                let member = Member { varies: true };
                let emitter = Emitter { rolled: &rolled, member };
                let body: Vec<Statement> = body.iter().map(|step| emitter.step(step)).collect();
                let (uses, tokens) = (uses(&body), blocks(&body));
                let count = Literal::usize_unsuffixed(*count);
                let tokens = quote! { for __k in 0..#count { #tokens } };
                statements.push(Statement { uses, tokens, ..Statement::default() });
            }
        }
    }
    let statements = blocks(&statements);
    Some(quote! { #numbers #(#tables)* #(#lengths)* #statements })
}

/// The program of what depends on parameters alone, and that of everything else, which loads its results.
fn parted(program: &Program) -> (Program, Program) {
    let constant = program.parametric();
    let is_leaf = |value: Value| {
        matches!(program.instructions[value.index()], Instruction::Number(_) | Instruction::Load(Symbol::Parameter(_)))
    };
    let mut held: BTreeMap<Value, u32> = BTreeMap::new();
    let mut leaves: Vec<Value> = Vec::new();
    let mut needs = |value: Value| {
        if constant[value.index()] && is_leaf(value) {
            leaves.push(value);
        } else if constant[value.index()] {
            let next = held.len() as u32;
            held.entry(value).or_insert(next);
        }
    };
    for (place, instruction) in program.instructions.iter().enumerate() {
        if !constant[place] {
            instruction.for_each_operand(&mut needs);
        }
    }
    program.outputs.iter().for_each(|(_, value)| needs(*value));
    leaves.sort_unstable();
    leaves.dedup();
    let mut numbers = Program::default();
    let mut places = vec![Value(0); program.instructions.len()];
    for (place, instruction) in program.instructions.iter().enumerate().filter(|(place, _)| constant[*place]) {
        places[place] = Value(numbers.instructions.len() as u32);
        numbers.instructions.push(instruction.map_operands(|value| places[value.index()]));
    }
    numbers.outputs = held.iter().map(|(value, k)| (Slot::Held(*k as usize), places[value.index()])).collect();
    numbers.outputs.sort_unstable();
    let mut values = Program::default();
    let mut places = vec![Value(0); program.instructions.len()];
    for value in leaves {
        places[value.index()] = Value(values.instructions.len() as u32);
        values.instructions.push(program.instructions[value.index()]);
    }
    for (value, k) in &held {
        places[value.index()] = Value(values.instructions.len() as u32);
        values.instructions.push(Instruction::Load(Symbol::Held(*k)));
    }
    for (place, instruction) in program.instructions.iter().enumerate().filter(|(place, _)| !constant[*place]) {
        places[place] = Value(values.instructions.len() as u32);
        values.instructions.push(instruction.map_operands(|value| places[value.index()]));
    }
    values.outputs = program.outputs.iter().map(|(slot, value)| (*slot, places[value.index()])).collect();
    (numbers, values)
}

struct Emitter<'r> {
    rolled: &'r Rolled,
    member: Member,
}

/// An operand: a number, or a value of the arithmetic.
struct Operand {
    tokens: TokenStream,
    constant: bool,
}

impl Operand {
    /// As a value of the arithmetic.
    fn dynamic(&self) -> TokenStream {
        let tokens = &self.tokens;
        if self.constant {
            quote! { <__X as __kin::Arithmetic>::constant(#tokens) }
        } else {
            tokens.clone()
        }
    }
}

impl Emitter<'_> {
    fn step(&self, step: &Step) -> Statement {
        let uses = step_uses(self.rolled, step);
        let mut loads = TokenStream::new();
        match step {
            Step::Write { slot, step, source } => {
                let (row, value) =
                    (self.member.index(slot.index(), *step), self.operand(*source, &mut loads).dynamic());
                let tokens = quote! { { #loads __kin::Arithmetic::row(x, #row, #value); } };
                Statement { uses, tokens, ..Statement::default() }
            }
            Step::Compute { value, instruction, keeps } => {
                let mut operands = Vec::new();
                instruction.for_each_operand(|operand| operands.push(self.operand(operand, &mut loads)));
                let names = names_of(*value, instruction);
                let expression = match (*instruction, operands.as_slice()) {
                    (Instruction::Mul(a, b), [operand, _]) if self.same(a, b) && !operand.constant => {
                        let operand = &operand.tokens;
                        quote! { __kin::Arithmetic::square(x, #operand) }
                    }
                    _ => expression(instruction, &operands),
                };
                let pattern = match instruction {
                    Instruction::SinCos(_) => quote! { [(#(#names),*)] },
                    _ => quote! { #(#names)* },
                };
                let mut tokens = quote! { let #pattern = { #loads #expression }; };
                tokens.extend(keeps.iter().map(|keep| {
                    let (array, place) = (array(keep.array), self.member.index(keep.first, 1));
                    let name = local(*value, keep.part);
                    quote! { #array[#place] = #name; }
                }));
                Statement { defines: vec![(*value, names)], uses, tokens }
            }
        }
    }

    /// True when two operands are one value.
    fn same(&self, a: Value, b: Value) -> bool {
        self.rolled.sources[a.index()] == self.rolled.sources[b.index()]
    }

    /// An operand; what the arithmetic supplies is asked of it first, by a statement among `loads`.
    fn operand(&self, source: Value, loads: &mut TokenStream) -> Operand {
        let number = |tokens| Operand { tokens, constant: true };
        let value = |tokens| Operand { tokens, constant: false };
        match self.rolled.sources[source.index()] {
            Source::Number(bits) => number(literal(bits.value())),
            Source::Table(k) => {
                let (table, place) = (table(k), self.member.index(0, 1));
                number(quote! { #table[#place] })
            }
            Source::Load(symbol, step) => {
                let at = self.member.index(symbol.index() as usize, step);
                if matches!(symbol, Symbol::Parameter(_) | Symbol::Held(_)) {
                    return number(load_at(symbol, &at));
                }
                let name = format_ident!("__l{}", source.0);
                let load = match symbol {
                    Symbol::Input(_, order) => {
                        let order = Literal::usize_unsuffixed(usize::from(order));
                        quote! { __kin::Arithmetic::input(x, #at, #order) }
                    }
                    Symbol::Coordinate(_) => quote! { __kin::Arithmetic::coordinate(x, #at) },
                    Symbol::Rate(_) => quote! { __kin::Arithmetic::rate(x, #at) },
                    _ => quote! { __kin::Arithmetic::time(x) },
                };
                loads.extend(quote! { let #name = #load; });
                value(quote! { #name })
            }
            Source::Local(of, part) => {
                let name = local(of, part);
                value(quote! { #name })
            }
            Source::Element { array: k, first, step } => {
                let (array, place) = (array(k), self.member.index(first, step));
                value(quote! { #array[#place] })
            }
        }
    }
}

/// An instruction in the arithmetic; products with numbers are no products of series.
fn expression(instruction: &Instruction, operands: &[Operand]) -> TokenStream {
    let apply = |method: &str, operands: &[&TokenStream]| {
        let method = Ident::new(method, Span::call_site());
        quote! { __kin::Arithmetic::#method(x #(, #operands)*) }
    };
    let number = |k: usize| operands.get(k).is_some_and(|operand| operand.constant);
    let v = |k: usize| operands.get(k).map_or_else(TokenStream::new, |operand| operand.tokens.clone());
    let dynamic = |k: usize| operands.get(k).map_or_else(TokenStream::new, Operand::dynamic);
    match *instruction {
        Instruction::Neg(_) => apply("neg", &[&v(0)]),
        Instruction::Add(..) if number(0) => apply("shift", &[&v(1), &v(0)]),
        Instruction::Add(..) if number(1) => apply("shift", &[&v(0), &v(1)]),
        Instruction::Add(..) => apply("add", &[&v(0), &v(1)]),
        Instruction::Sub(..) if number(0) => apply("below", &[&v(1), &v(0)]),
        Instruction::Sub(..) if number(1) => {
            let b = v(1);
            apply("shift", &[&v(0), &quote! { -(#b) }])
        }
        Instruction::Sub(..) => apply("sub", &[&v(0), &v(1)]),
        Instruction::Mul(..) if number(0) => apply("scale", &[&v(1), &v(0)]),
        Instruction::Mul(..) if number(1) => apply("scale", &[&v(0), &v(1)]),
        Instruction::Mul(..) => apply("mul", &[&v(0), &v(1)]),
        Instruction::Div(..) if number(1) => apply("over", &[&v(0), &v(1)]),
        Instruction::Div(..) => apply("div", &[&dynamic(0), &v(1)]),
        Instruction::SinCos(_) => {
            let angle = v(0);
            quote! { __kin::Arithmetic::sin_cos(x, [#angle]) }
        }
        Instruction::Call(f, _) => apply(f.name(), &[&v(0)]),
        Instruction::Sign(_) => apply("signum", &[&v(0)]),
        Instruction::Atan2(..) => apply("atan2", &[&dynamic(0), &dynamic(1)]),
        Instruction::Powi(_, n) => {
            let n = Literal::i32_suffixed(n);
            apply("powi", &[&v(0), &quote! { #n }])
        }
        Instruction::Powf(_, n) => apply("powf", &[&v(0), &literal(n.value())]),
        // Supplied functions are written straight, and plans alone take nearest angles.
        _ => TokenStream::new(),
    }
}

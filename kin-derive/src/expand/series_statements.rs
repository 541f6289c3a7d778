//! The statements of a program in an arithmetic of the caller's: numbers for what is constant, values for the rest.

use super::program::{ANGLES, function_name, literal};
use kin_core::expr::Symbol;
use kin_core::mechanism::Function;
use kin_core::program::{Instruction, Program, Slot, Value};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

/// A statement: what it defines, and its tokens.
pub(super) struct Statement {
    pub(super) defines: Vec<Value>,
    pub(super) tokens: TokenStream,
}

/// Writes the statements of one program.
pub(super) struct Emitter<'p> {
    program: &'p Program,
    /// Values that depend on parameters alone.
    pub(super) constant: Vec<bool>,
}

fn name(prefix: char, value: Value) -> Ident {
    Ident::new(&format!("__{prefix}{}", value.0), Span::call_site())
}

impl<'p> Emitter<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        Self { program, constant: program.parametric() }
    }

    fn instruction(&self, value: Value) -> Instruction {
        self.program.instructions[value.index()]
    }

    /// The value whose statement defines `value`: itself, or the pair or triple that it is part of.
    pub(super) fn holder(&self, value: Value) -> Value {
        match self.instruction(value) {
            Instruction::SinOf(whole) | Instruction::CosOf(whole) | Instruction::SuppliedOf(whole, _) => whole,
            _ => value,
        }
    }

    /// The identifiers that a statement gives to `value`.
    pub(super) fn names(&self, value: Value) -> Vec<Ident> {
        match self.instruction(value) {
            Instruction::SinCos(_) => vec![name('s', value), name('c', value)],
            Instruction::Supplied(..) => vec![name('d', value), name('e', value), name('f', value)],
            _ => vec![name('v', value)],
        }
    }

    /// `value` as an operand of its own kind: a number where it is constant.
    fn operand(&self, value: Value) -> TokenStream {
        match self.instruction(value) {
            Instruction::Number(bits) => literal(bits.value()),
            Instruction::Load(Symbol::Parameter(k)) => {
                let k = Literal::usize_unsuffixed(k as usize);
                quote! { p[#k] }
            }
            Instruction::SinOf(pair) => ident(name('s', pair)),
            Instruction::CosOf(pair) => ident(name('c', pair)),
            Instruction::SuppliedOf(triple, order) => ident(name(['d', 'e', 'f'][usize::from(order.min(2))], triple)),
            _ => ident(name('v', value)),
        }
    }

    /// `value` as a value of the arithmetic.
    fn dynamic(&self, value: Value) -> TokenStream {
        let operand = self.operand(value);
        if self.constant[value.index()] {
            quote! { <__X as __kin::Arithmetic>::constant(#operand) }
        } else {
            operand
        }
    }

    /// Writes every row right after the statement that computes it, and those that are constants at the end.
    pub(super) fn place_outputs(&self, statements: &mut Vec<Statement>) {
        let mut after: Vec<TokenStream> = vec![TokenStream::new(); self.program.instructions.len()];
        let mut last = TokenStream::new();
        for (slot, value) in &self.program.outputs {
            let (Slot::Phi(row) | Slot::Entry(row)) = *slot else { continue };
            let (row, operand) = (Literal::usize_unsuffixed(row), self.dynamic(*value));
            let place = if self.constant[value.index()] { &mut last } else { &mut after[self.holder(*value).index()] };
            place.extend(quote! { __kin::Arithmetic::row(x, #row, #operand); });
        }
        for statement in statements.iter_mut() {
            for value in &statement.defines {
                statement.tokens.extend(std::mem::take(&mut after[value.index()]));
            }
        }
        if !last.is_empty() {
            statements.push(Statement { defines: Vec::new(), tokens: last });
        }
    }

    /// The statements of constants, and all others.
    pub(super) fn statements(&self) -> (Vec<Statement>, Vec<Statement>) {
        let (mut constants, mut others) = (Vec::new(), Vec::new());
        let mut place = 0;
        while place < self.program.instructions.len() {
            let value = Value(place as u32);
            if self.constant[place] {
                constants.extend(self.constant_statement(value));
                place += 1;
                continue;
            }
            let angles: Vec<(Value, Value)> = (self.program.instructions[place..].iter().zip(place..))
                .map_while(|(instruction, place)| match instruction {
                    Instruction::SinCos(angle) if !self.constant[place] => Some((Value(place as u32), *angle)),
                    _ => None,
                })
                .take(ANGLES)
                .collect();
            if angles.is_empty() {
                others.extend(self.statement(value));
                place += 1;
            } else {
                place += angles.len();
                others.push(self.sin_cos(&angles));
            }
        }
        (constants, others)
    }

    fn sin_cos(&self, angles: &[(Value, Value)]) -> Statement {
        let names = angles.iter().map(|(pair, _)| {
            let (s, c) = (name('s', *pair), name('c', *pair));
            quote! { (#s, #c) }
        });
        let operands = angles.iter().map(|(_, angle)| self.operand(*angle));
        let tokens = quote! { let [#(#names),*] = __kin::Arithmetic::sin_cos(x, [#(#operands),*]); };
        Statement { defines: angles.iter().map(|(pair, _)| *pair).collect(), tokens }
    }

    /// A number.
    fn constant_statement(&self, value: Value) -> Option<Statement> {
        let v = |value: Value| self.operand(value);
        let expression = match self.instruction(value) {
            Instruction::SinCos(a) => {
                let (a, names) = (v(a), self.names(value));
                let tokens = quote! { let (#(#names),*) = __kin::Scalar::sin_cos(#a); };
                return Some(Statement { defines: vec![value], tokens });
            }
            Instruction::Neg(a) => {
                let a = v(a);
                quote! { -(#a) }
            }
            Instruction::Add(a, b) => binary(v(a), quote! { + }, v(b)),
            Instruction::Sub(a, b) => binary(v(a), quote! { - }, v(b)),
            Instruction::Mul(a, b) => binary(v(a), quote! { * }, v(b)),
            Instruction::Div(a, b) => binary(v(a), quote! { / }, v(b)),
            Instruction::Call(f, a) => call(quote! { __kin::Scalar }, function(f), &[v(a)]),
            Instruction::Sign(a) => call(quote! { __kin::Scalar }, method_name("signum"), &[v(a)]),
            Instruction::Atan2(y, x) => call(quote! { __kin::Scalar }, method_name("atan2"), &[v(y), v(x)]),
            Instruction::Powi(a, n) => call(quote! { __kin::Scalar }, method_name("powi"), &[v(a), integer(n)]),
            Instruction::Powf(a, n) => call(quote! { __kin::Scalar }, method_name("powf"), &[v(a), literal(n.value())]),
            // Plans alone take nearest angles, no row does.
            Instruction::Number(_)
            | Instruction::Load(_)
            | Instruction::SinOf(_)
            | Instruction::CosOf(_)
            | Instruction::Nearest(..)
            | Instruction::Supplied(..)
            | Instruction::SuppliedOf(..) => return None,
        };
        let defined = name('v', value);
        Some(Statement { defines: vec![value], tokens: quote! { let #defined = #expression; } })
    }

    /// A value of the arithmetic.
    fn statement(&self, value: Value) -> Option<Statement> {
        let v = |value: Value| self.operand(value);
        let is_constant = |value: Value| self.constant[value.index()];
        let apply = |method: &str, operands: &[TokenStream]| {
            let method = method_name(method);
            quote! { __kin::Arithmetic::#method(x #(, #operands)*) }
        };
        let expression = match self.instruction(value) {
            Instruction::Number(_)
            | Instruction::SinOf(_)
            | Instruction::CosOf(_)
            | Instruction::SinCos(_)
            | Instruction::Nearest(..)
            | Instruction::SuppliedOf(..) => return None,
            Instruction::Load(symbol) => load(symbol),
            Instruction::Neg(a) => apply("neg", &[v(a)]),
            Instruction::Add(a, b) if is_constant(a) => apply("shift", &[v(b), v(a)]),
            Instruction::Add(a, b) if is_constant(b) => apply("shift", &[v(a), v(b)]),
            Instruction::Add(a, b) => apply("add", &[v(a), v(b)]),
            Instruction::Sub(a, b) if is_constant(a) => apply("below", &[v(b), v(a)]),
            Instruction::Sub(a, b) if is_constant(b) => {
                let b = v(b);
                apply("shift", &[v(a), quote! { -(#b) }])
            }
            Instruction::Sub(a, b) => apply("sub", &[v(a), v(b)]),
            Instruction::Mul(a, b) if is_constant(a) => apply("scale", &[v(b), v(a)]),
            Instruction::Mul(a, b) if is_constant(b) => apply("scale", &[v(a), v(b)]),
            Instruction::Mul(a, b) if a == b => apply("square", &[v(a)]),
            Instruction::Mul(a, b) => apply("mul", &[v(a), v(b)]),
            Instruction::Div(a, b) if is_constant(b) => apply("over", &[v(a), v(b)]),
            Instruction::Div(a, b) => apply("div", &[self.dynamic(a), v(b)]),
            Instruction::Call(f, a) => apply(f.name(), &[v(a)]),
            Instruction::Sign(a) => apply("signum", &[v(a)]),
            Instruction::Atan2(y, x) => apply("atan2", &[self.dynamic(y), self.dynamic(x)]),
            Instruction::Powi(a, n) => apply("powi", &[v(a), integer(n)]),
            Instruction::Powf(a, n) => apply("powf", &[v(a), literal(n.value())]),
            Instruction::Supplied(f, a) => return Some(self.supplied(value, f, a)),
        };
        let defined = name('v', value);
        Some(Statement { defines: vec![value], tokens: quote! { let #defined = #expression; } })
    }

    /// A supplied function, with as many of its derivatives as the program uses.
    fn supplied(&self, value: Value, function: u32, argument: Value) -> Statement {
        let used = self.program.instructions.iter().filter_map(|instruction| match instruction {
            Instruction::SuppliedOf(triple, order) if *triple == value => Some(usize::from(*order)),
            _ => None,
        });
        let (used, number) = (Literal::usize_unsuffixed(used.max().unwrap_or(0)), function as usize);
        let (names, argument, function) = (self.names(value), self.dynamic(argument), function_name(function));
        let tokens = quote! {
            let [#(#names),*] = __kin::Arithmetic::supplied(x, #number, #used, #argument, #function);
        };
        Statement { defines: vec![value], tokens }
    }
}

fn ident(ident: Ident) -> TokenStream {
    quote! { #ident }
}

fn binary(a: TokenStream, operator: TokenStream, b: TokenStream) -> TokenStream {
    quote! { #a #operator #b }
}

fn call(path: TokenStream, function: Ident, arguments: &[TokenStream]) -> TokenStream {
    quote! { #path::#function(#(#arguments),*) }
}

fn integer(n: i32) -> TokenStream {
    let n = Literal::i32_suffixed(n);
    quote! { #n }
}

fn method_name(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

fn function(f: Function) -> Ident {
    method_name(f.name())
}

/// What the caller supplies.
fn load(symbol: Symbol) -> TokenStream {
    let at = |k: u32| Literal::usize_unsuffixed(k as usize);
    match symbol {
        // Parameters are numbers; the others are a plan's.
        Symbol::Parameter(_)
        | Symbol::Mode(_)
        | Symbol::Start(_)
        | Symbol::Unknown(_)
        | Symbol::Held(_)
        | Symbol::Right(_)
        | Symbol::Coarseness => TokenStream::new(),
        Symbol::Time => quote! { __kin::Arithmetic::time(x) },
        Symbol::Input(k, order) => {
            let (k, order) = (at(k), at(u32::from(order)));
            quote! { __kin::Arithmetic::input(x, #k, #order) }
        }
        Symbol::Coordinate(k) => {
            let k = at(k);
            quote! { __kin::Arithmetic::coordinate(x, #k) }
        }
        Symbol::Rate(k) => {
            let k = at(k);
            quote! { __kin::Arithmetic::rate(x, #k) }
        }
    }
}

//! The interpreter: runs a program in double precision, as an oracle of the emitted code.

use super::Environment;
use kin_core::expr::Symbol;
use kin_core::mechanism::Function;
use kin_core::program::{Instruction, Program, Slot, ValueId};

/// The outputs of `program`.
pub fn interpret(program: &Program, environment: &impl Environment) -> Vec<(Slot, f64)> {
    // Pairs and triples keep their parts here, at the place of their instruction.
    let mut values = vec![[0.0; 3]; program.instructions.len()];
    for (place, instruction) in program.instructions.iter().enumerate() {
        values[place] = match *instruction {
            Instruction::Number(value) => [value.value(), 0.0, 0.0],
            Instruction::Load(Symbol::Coarseness) => [1.0, 0.0, 0.0],
            Instruction::Load(symbol) => [environment.symbol(symbol), 0.0, 0.0],
            Instruction::SinOf(pair) => [values[pair.index()][0], 0.0, 0.0],
            Instruction::CosOf(pair) => [values[pair.index()][1], 0.0, 0.0],
            Instruction::SuppliedOf(triple, order) => [values[triple.index()][usize::from(order)], 0.0, 0.0],
            _ => compute(instruction, environment, |value| values[value.index()][0]),
        };
    }
    program.outputs.iter().map(|(slot, value)| (*slot, values[value.index()][0])).collect()
}

/// What an instruction computes of its operands; a pair has the sine first. Loads and parts are no computation.
pub fn compute(instruction: &Instruction, environment: &impl Environment, v: impl Fn(ValueId) -> f64) -> [f64; 3] {
    match *instruction {
        Instruction::Number(_)
        | Instruction::Load(_)
        | Instruction::SinOf(_)
        | Instruction::CosOf(_)
        | Instruction::SuppliedOf(..) => [f64::NAN; 3],
        Instruction::Neg(a) => [-v(a), 0.0, 0.0],
        Instruction::Add(a, b) => [v(a) + v(b), 0.0, 0.0],
        Instruction::Sub(a, b) => [v(a) - v(b), 0.0, 0.0],
        Instruction::Mul(a, b) => [v(a) * v(b), 0.0, 0.0],
        Instruction::Div(a, b) => [v(a) / v(b), 0.0, 0.0],
        Instruction::SinCos(a) => [v(a).sin(), v(a).cos(), 0.0],
        Instruction::Call(f, a) => [function(f, v(a)), 0.0, 0.0],
        Instruction::Sign(a) => [v(a).signum(), 0.0, 0.0],
        Instruction::Atan2(y, x) => [v(y).atan2(v(x)), 0.0, 0.0],
        Instruction::Nearest(a, b) => [nearest(v(a), v(b)), 0.0, 0.0],
        Instruction::Powi(a, n) => [v(a).powi(n), 0.0, 0.0],
        Instruction::Powf(a, n) => [v(a).powf(n.value()), 0.0, 0.0],
        Instruction::Supplied(f, a) => std::array::from_fn(|order| environment.supplied(f, order as u8, v(a))),
    }
}

/// A function of the user's language.
pub(super) fn function(f: Function, x: f64) -> f64 {
    match f {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Sqrt => x.sqrt(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Abs => x.abs(),
    }
}

/// The angle `a` + 2πn that is nearest to `b`.
pub(super) fn nearest(a: f64, b: f64) -> f64 {
    a + core::f64::consts::TAU * ((b - a) / core::f64::consts::TAU).round()
}

//! Prints programs: one line for every instruction that computes something; literals and loads appear as operands.

use super::{Instruction, Program, ValueId};
use crate::expr::{Names, Symbol};
use core::fmt;

/// An operand as it is printed: a literal, a symbol, a component of a pair, or the number of the line that computes
/// it.
struct PrintedOperand<'p>(&'p Program, ValueId);

impl fmt::Display for PrintedOperand<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(program, value) = *self;
        match program.instructions.get(value.index()) {
            Some(Instruction::Number(bits)) => write!(f, "{}", bits.value()),
            Some(Instruction::Load(symbol)) => f.write_str(&loaded(*symbol)),
            Some(Instruction::SinOf(pair)) => write!(f, "sin{}", pair.0),
            Some(Instruction::CosOf(pair)) => write!(f, "cos{}", pair.0),
            Some(Instruction::SuppliedOf(triple, order)) => {
                write!(f, "f{}{}", triple.0, "'".repeat(usize::from(*order)))
            }
            _ => write!(f, "v{}", value.0),
        }
    }
}

fn loaded(symbol: Symbol) -> String {
    ().symbol(symbol)
}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, instruction) in self.instructions.iter().enumerate() {
            let v = |value: ValueId| PrintedOperand(self, value);
            match *instruction {
                Instruction::Number(_)
                | Instruction::Load(_)
                | Instruction::SinOf(_)
                | Instruction::CosOf(_)
                | Instruction::SuppliedOf(..) => {}
                Instruction::Neg(a) => writeln!(f, "v{index} = -{}", v(a))?,
                Instruction::Add(a, b) => writeln!(f, "v{index} = {} + {}", v(a), v(b))?,
                Instruction::Sub(a, b) => writeln!(f, "v{index} = {} - {}", v(a), v(b))?,
                Instruction::Mul(a, b) => writeln!(f, "v{index} = {} * {}", v(a), v(b))?,
                Instruction::Div(a, b) => writeln!(f, "v{index} = {} / {}", v(a), v(b))?,
                Instruction::SinCos(a) => writeln!(f, "(sin{index}, cos{index}) = sin_cos({})", v(a))?,
                Instruction::Call(g, a) => writeln!(f, "v{index} = {}({})", g.name(), v(a))?,
                Instruction::Sign(a) => writeln!(f, "v{index} = sign({})", v(a))?,
                Instruction::Atan2(y, x) => writeln!(f, "v{index} = atan2({}, {})", v(y), v(x))?,
                Instruction::Nearest(a, b) => writeln!(f, "v{index} = nearest({}, {})", v(a), v(b))?,
                Instruction::Powi(a, n) => writeln!(f, "v{index} = {}^{n}", v(a))?,
                Instruction::Powf(a, n) => writeln!(f, "v{index} = {}^{}", v(a), n.value())?,
                Instruction::Supplied(g, a) => {
                    writeln!(f, "(f{index}, f{index}', f{index}'') = supplied {g}({})", v(a))?;
                }
            }
        }
        for (slot, value) in &self.outputs {
            writeln!(f, "{slot} = {}", PrintedOperand(self, *value))?;
        }
        Ok(())
    }
}

//! Values of a program as expressions again.

use super::{Instruction, Program, Value};
use crate::expr::{ExprId, Graph, Symbol};

impl Program {
    /// For every value whether it depends on parameters alone. What a supplied function gives never does: it has
    /// derivatives that a program does not know.
    pub fn parametric(&self) -> Vec<bool> {
        let mut parametric = vec![false; self.instructions.len()];
        for (place, instruction) in self.instructions.iter().enumerate() {
            parametric[place] = match instruction {
                Instruction::Load(symbol) => matches!(symbol, Symbol::Parameter(_)),
                Instruction::Supplied(..) => false,
                _ => {
                    let mut all = true;
                    instruction.for_each_operand(|operand| all &= parametric[operand.index()]);
                    all
                }
            };
        }
        parametric
    }

    /// The angles of which it takes sine and cosine, in its order, but for those that depend on parameters alone.
    pub fn angles(&self, graph: &mut Graph) -> Vec<ExprId> {
        let parametric = self.parametric();
        let angles = self.instructions.iter().enumerate().filter_map(|(place, instruction)| match instruction {
            Instruction::SinCos(angle) if !parametric[place] => Some(*angle),
            _ => None,
        });
        let angles: Vec<Value> = angles.collect();
        let mut needed = vec![false; self.instructions.len()];
        angles.iter().for_each(|angle| needed[angle.index()] = true);
        for (place, instruction) in self.instructions.iter().enumerate().rev() {
            if needed[place] {
                instruction.for_each_operand(|operand| needed[operand.index()] = true);
            }
        }
        let mut raised = vec![graph.zero(); self.instructions.len()];
        for (place, instruction) in self.instructions.iter().enumerate().filter(|(place, _)| needed[*place]) {
            raised[place] = self.raise(graph, instruction, &raised);
        }
        angles.into_iter().map(|angle| raised[angle.index()]).collect()
    }

    /// An instruction as an expression, given those of its operands.
    fn raise(&self, graph: &mut Graph, instruction: &Instruction, raised: &[ExprId]) -> ExprId {
        let v = |value: Value| raised[value.index()];
        match *instruction {
            Instruction::Number(bits) => graph.number(bits.value()),
            Instruction::Load(symbol) => graph.symbol(symbol),
            Instruction::Neg(a) => graph.neg(v(a)),
            Instruction::Add(a, b) => graph.add(v(a), v(b)),
            Instruction::Sub(a, b) => graph.sub(v(a), v(b)),
            Instruction::Mul(a, b) => graph.mul(v(a), v(b)),
            Instruction::Div(a, b) => graph.div(v(a), v(b)),
            // Pairs and triples stand for their argument, of which the parts are taken.
            Instruction::SinCos(a) | Instruction::Supplied(_, a) => v(a),
            Instruction::SinOf(pair) => graph.sin(v(pair)),
            Instruction::CosOf(pair) => graph.cos(v(pair)),
            Instruction::SuppliedOf(triple, order) => match self.instructions[triple.index()] {
                Instruction::Supplied(function, _) => graph.supplied(function, order, v(triple)),
                _ => v(triple),
            },
            Instruction::Call(f, a) => graph.call(f, v(a)),
            Instruction::Sign(a) => graph.sign(v(a)),
            Instruction::Atan2(y, x) => graph.atan2(v(y), v(x)),
            Instruction::Nearest(a, b) => graph.nearest(v(a), v(b)),
            Instruction::Powi(a, n) => graph.powi(v(a), n),
            Instruction::Powf(a, n) => graph.powf(v(a), n.value()),
        }
    }
}

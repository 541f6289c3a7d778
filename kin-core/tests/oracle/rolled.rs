//! The interpreter of rolled programs: what the loops say, and nothing of the program they came from.

use super::Environment;
use super::program::compute;
use kin_core::expr::Symbol;
use kin_core::program::{OperandSource, Piece, ResultPart, Rolled, RolledStep, Slot, ValueId};
use std::collections::HashMap;

/// The outputs of `rolled`, in the order in which it writes them.
pub fn interpret_rolled(rolled: &Rolled, environment: &impl Environment) -> Vec<(Slot, f64)> {
    let arrays = rolled.arrays.iter().map(|length| vec![f64::NAN; *length]).collect();
    let mut state = State { rolled, environment, arrays, locals: HashMap::new(), outputs: Vec::new() };
    for piece in &rolled.pieces {
        match piece {
            Piece::Straight(steps) => state.run(steps, 0),
            Piece::Loop { count, body } => (0..*count).for_each(|k| state.run(body, k)),
        }
    }
    state.outputs
}

struct State<'r, E> {
    rolled: &'r Rolled,
    environment: &'r E,
    arrays: Vec<Vec<f64>>,
    locals: HashMap<ValueId, [f64; 3]>,
    outputs: Vec<(Slot, f64)>,
}

fn part(whole: [f64; 3], part: ResultPart) -> f64 {
    match part {
        ResultPart::Whole | ResultPart::Sin => whole[0],
        ResultPart::Cos => whole[1],
        ResultPart::Derivative(order) => whole[usize::from(order)],
    }
}

impl<E: Environment> State<'_, E> {
    fn run(&mut self, steps: &[RolledStep], k: usize) {
        for step in steps {
            match step {
                RolledStep::Compute { value, instruction, keeps } => {
                    let whole = compute(instruction, self.environment, |operand| self.read(operand, k));
                    for keep in keeps {
                        self.arrays[keep.array][keep.first + k] = part(whole, keep.part);
                    }
                    self.locals.insert(*value, whole);
                }
                RolledStep::Write { slot, step, source } => {
                    let index = slot.index() as i64 + step * k as i64;
                    self.outputs.push((slot.at(index as usize), self.read(*source, k)));
                }
            }
        }
    }

    fn read(&self, source: ValueId, k: usize) -> f64 {
        let advanced = |first: usize, step: i64| (first as i64 + step * k as i64) as usize;
        match self.rolled.sources[source.index()] {
            OperandSource::Number(bits) => bits.value(),
            OperandSource::Table(table) => self.rolled.tables[table][k].value(),
            OperandSource::Load(Symbol::Coarseness, _) => 1.0,
            OperandSource::Load(symbol, step) => {
                self.environment.symbol(symbol.at(advanced(symbol.index() as usize, step) as u32))
            }
            OperandSource::Local(value, of) => self.locals.get(&value).map_or(f64::NAN, |whole| part(*whole, of)),
            OperandSource::Element { array, first, step } => self.arrays[array][advanced(first, step)],
        }
    }
}

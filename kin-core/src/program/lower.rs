//! Lowers expressions to a straight-line program.
//!
//! Local value numbering merges equal instructions into one value. A sign is carried along with every value (see
//! `signs.rs`). Finally the instructions are ordered so that sines and cosines that can be computed together are
//! adjacent.

use super::reassociate;
use super::signs::{self, ChosenSigns};
use super::value_numbering::ValueNumbering;
use super::{Instruction, Program, Slot, ValueId};
use crate::expr::{Bits, ExprId, Graph, IdMap, Node, Rotation};
use crate::vocabulary::Function;

/// A value with a sign: the expression equals the value or its negative.
#[derive(Clone, Copy)]
struct SignedValue {
    value: ValueId,
    negative: bool,
}

/// Lowers the expressions of `outputs`.
pub fn lower(graph: &Graph, outputs: &[(Slot, ExprId)]) -> Program {
    let signs = signs::choose(graph, outputs.iter().map(|(_, id)| *id));
    let mut lowering = Lowering { graph, signs, known: IdMap::default(), out: ValueNumbering::default() };
    let mut written = Vec::with_capacity(outputs.len());
    for (slot, id) in outputs {
        lowering.reach(*id);
        let value = lowering.positive(*id);
        written.push((*slot, value));
    }
    reassociate::early_terms_first(schedule(Program { instructions: lowering.out.instructions, outputs: written }))
}

struct Lowering<'g> {
    graph: &'g Graph,
    signs: ChosenSigns,
    known: IdMap<SignedValue>,
    out: ValueNumbering,
}

impl Lowering<'_> {
    /// Lowers everything that `root` depends on, operands first, without recursion.
    fn reach(&mut self, root: ExprId) {
        let mut stack = vec![(root, false)];
        while let Some((id, ready)) = stack.pop() {
            if self.known.contains(id) {
                continue;
            }
            if ready {
                let signed = self.node(id);
                self.known.insert(id, signed);
                continue;
            }
            stack.push((id, true));
            // The operands are pushed in reverse, so that the first one is on top of the stack.
            let (mut operands, mut count) = ([id; 5], 0);
            self.graph.node(id).for_each_operand(|operand| {
                operands[count] = operand;
                count += 1;
            });
            while count > 0 {
                count -= 1;
                if !self.known.contains(operands[count]) {
                    stack.push((operands[count], false));
                }
            }
        }
    }

    fn emit(&mut self, instruction: Instruction) -> ValueId {
        self.out.emit(instruction)
    }

    fn number(&mut self, value: f64) -> ValueId {
        self.emit(Instruction::Number(Bits::new(value)))
    }

    fn signed(&self, id: ExprId) -> SignedValue {
        self.known.or(id, SignedValue { value: ValueId(0), negative: false })
    }

    /// The value that equals `id`, negated explicitly if necessary.
    fn positive(&mut self, id: ExprId) -> ValueId {
        let SignedValue { value, negative } = self.signed(id);
        if negative { self.negate(value) } else { value }
    }

    /// −value. The sign is absorbed by a literal if there is one; −(a + a) becomes −2a.
    fn negate(&mut self, value: ValueId) -> ValueId {
        match self.out.instructions[value.index()] {
            Instruction::Number(number) => self.number(-number.value()),
            Instruction::Neg(inner) => inner,
            Instruction::Add(a, b) if a == b => {
                let minus_two = self.number(-2.0);
                self.emit(Instruction::Mul(a, minus_two))
            }
            Instruction::Mul(a, b) => match (self.out.instructions[a.index()], self.out.instructions[b.index()]) {
                (Instruction::Number(number), _) => {
                    let opposite = self.number(-number.value());
                    self.emit(Instruction::Mul(opposite, b))
                }
                (_, Instruction::Number(number)) => {
                    let opposite = self.number(-number.value());
                    self.emit(Instruction::Mul(a, opposite))
                }
                _ => self.emit(Instruction::Neg(value)),
            },
            _ => self.emit(Instruction::Neg(value)),
        }
    }

    fn add(&mut self, a: SignedValue, b: SignedValue, swap: bool) -> SignedValue {
        match (a.negative, b.negative) {
            (false, true) if swap => {
                SignedValue { value: self.emit(Instruction::Sub(b.value, a.value)), negative: true }
            }
            (true, false) if swap => {
                SignedValue { value: self.emit(Instruction::Sub(a.value, b.value)), negative: true }
            }
            (false, true) => SignedValue { value: self.emit(Instruction::Sub(a.value, b.value)), negative: false },
            (true, false) => SignedValue { value: self.emit(Instruction::Sub(b.value, a.value)), negative: false },
            (negative, _) => SignedValue { value: self.emit(Instruction::Add(a.value, b.value)), negative },
        }
    }

    fn mul(&mut self, a: SignedValue, b: SignedValue) -> SignedValue {
        SignedValue { value: self.emit(Instruction::Mul(a.value, b.value)), negative: a.negative != b.negative }
    }

    /// The value that equals `id`, and is +0 where that is 0. For x < 0, atan2(+0, x) is π and atan2(−0, x) is −π, and
    /// the sign of a zero would otherwise depend on the sign with which a difference is computed.
    fn positive_zero(&mut self, id: ExprId) -> ValueId {
        let SignedValue { value, negative } = self.signed(id);
        let zero = self.number(0.0);
        match self.out.instructions[value.index()] {
            Instruction::Number(_) => self.positive(id),
            _ if negative => self.emit(Instruction::Sub(zero, value)),
            _ => self.emit(Instruction::Add(value, zero)),
        }
    }

    /// The value that equals the angle `id` up to whole turns: of π and −π, either will do.
    fn up_to_whole_turns(&mut self, id: ExprId) -> ValueId {
        let Node::Atan2(y, x) = self.graph.node(id) else { return self.positive(id) };
        let (SignedValue { value: y, negative }, x) = (self.signed(y), self.positive(x));
        let angle = self.emit(Instruction::Atan2(y, x));
        if negative { self.negate(angle) } else { angle }
    }

    fn opposite(a: SignedValue) -> SignedValue {
        SignedValue { negative: !a.negative, ..a }
    }

    fn node(&mut self, id: ExprId) -> SignedValue {
        let swap = self.signs.swapped.contains(id);
        let plain = |value| SignedValue { value, negative: false };
        match self.graph.node(id) {
            Node::Number(bits) if bits.value() < 0.0 => {
                SignedValue { value: self.number(-bits.value()), negative: true }
            }
            Node::Number(bits) => plain(self.number(bits.value())),
            Node::Symbol(symbol) => plain(self.emit(Instruction::Load(symbol))),
            Node::Neg(a) => Self::opposite(self.signed(a)),
            Node::Add(a, b) => self.add(self.signed(a), self.signed(b), swap),
            Node::Sub(a, b) => self.add(self.signed(a), Self::opposite(self.signed(b)), swap),
            Node::Mul(a, b) => self.mul(self.signed(a), self.signed(b)),
            Node::Div(a, b) => {
                let (a, b) = (self.signed(a), self.signed(b));
                SignedValue { value: self.emit(Instruction::Div(a.value, b.value)), negative: a.negative != b.negative }
            }
            Node::Powi(a, n) => self.power(a, n),
            Node::Powf(a, n) => {
                let a = self.positive(a);
                plain(self.emit(Instruction::Powf(a, n)))
            }
            Node::Call(Function::Sin, a) => self.sin_cos(a).0,
            Node::Call(Function::Cos, a) => self.sin_cos(a).1,
            Node::Call(f @ (Function::Tan | Function::Asin | Function::Atan), a) => {
                let SignedValue { value, negative } = self.signed(a);
                SignedValue { value: self.emit(Instruction::Call(f, value)), negative }
            }
            Node::Call(Function::Abs, a) => {
                let value = self.signed(a).value;
                plain(self.emit(Instruction::Call(Function::Abs, value)))
            }
            Node::Call(f, a) => {
                let a = self.positive(a);
                plain(self.emit(Instruction::Call(f, a)))
            }
            Node::Sign(a) => {
                let SignedValue { value, negative } = self.signed(a);
                SignedValue { value: self.emit(Instruction::Sign(value)), negative }
            }
            Node::Atan2(y, x) => {
                let (y, x) = (self.positive_zero(y), self.positive(x));
                plain(self.emit(Instruction::Atan2(y, x)))
            }
            Node::Opaque(a) => self.signed(a),
            Node::Nearest(a, b) => {
                let (a, b) = (self.up_to_whole_turns(a), self.positive(b));
                plain(self.emit(Instruction::Nearest(a, b)))
            }
            Node::RotX(r) => self.rotation(r, true),
            Node::RotY(r) => self.rotation(r, false),
            Node::Dot(t) => self.products([(t.u[0], t.d[0]), (t.u[1], t.d[1])], false, swap),
            Node::Cross(t) => self.products([(t.u[0], t.d[1]), (t.u[1], t.d[0])], true, swap),
            Node::Supplied(f, order, a) => {
                let a = self.positive(a);
                let triple = self.emit(Instruction::Supplied(f, a));
                plain(self.emit(Instruction::SuppliedOf(triple, order)))
            }
        }
    }

    /// sin a and cos a, with sin(−a) = −sin a and cos(−a) = cos a.
    fn sin_cos(&mut self, a: ExprId) -> (SignedValue, SignedValue) {
        let SignedValue { value, negative } = self.signed(a);
        let pair = self.emit(Instruction::SinCos(value));
        let sin = SignedValue { value: self.emit(Instruction::SinOf(pair)), negative };
        let cos = SignedValue { value: self.emit(Instruction::CosOf(pair)), negative: false };
        (sin, cos)
    }

    /// A component of A(φ)s. A component of s that is literally 0 needs no operation, and one that is literally ±1 no
    /// multiplication.
    ///
    /// To compute −ρ only the first non-zero component of s is negated: its term comes first, and the other term is
    /// added or subtracted.
    fn rotation(&mut self, r: Rotation, is_x: bool) -> SignedValue {
        let (sin, cos) = self.sin_cos(r.angle);
        let negated = self.signs.negated.contains_key(&r);
        let (with_x, with_y) = if is_x { (cos, Self::opposite(sin)) } else { (sin, cos) };
        let x_is_zero = self.graph.is_zero(r.x);
        let terms = [(with_x, r.x, true), (with_y, r.y, x_is_zero)].map(|(factor, id, leads)| {
            if self.graph.is_zero(id) {
                return None;
            }
            let component = self.signed(id);
            if self.graph.literal(id).map(f64::abs) == Some(1.0) {
                let negative = factor.negative ^ component.negative ^ negated;
                return Some(SignedValue { value: factor.value, negative });
            }
            if !negated {
                return Some(self.mul(factor, component));
            }
            let component = Self::opposite(component);
            Some(match (leads, component.negative) {
                (true, true) => {
                    let value = self.negate(component.value);
                    self.mul(factor, SignedValue { value, negative: false })
                }
                _ => self.mul(factor, component),
            })
        });
        let sum = match terms {
            [Some(a), Some(b)] => self.add(a, b, false),
            [Some(a), None] | [None, Some(a)] => a,
            [None, None] => SignedValue { value: self.number(0.0), negative: false },
        };
        if negated { Self::opposite(sum) } else { sum }
    }

    /// a·b ± c·d without terms that are literally zero and without multiplications by ±1.
    fn products(&mut self, pairs: [(ExprId, ExprId); 2], minus: bool, swap: bool) -> SignedValue {
        let terms = pairs.map(|(a, b)| {
            if self.graph.is_zero(a) || self.graph.is_zero(b) {
                return None;
            }
            Some(match (self.graph.literal(a).map(f64::abs), self.graph.literal(b).map(f64::abs)) {
                (Some(1.0), _) => {
                    let (a, b) = (self.signed(a), self.signed(b));
                    SignedValue { value: b.value, negative: a.negative != b.negative }
                }
                (_, Some(1.0)) => {
                    let (a, b) = (self.signed(a), self.signed(b));
                    SignedValue { value: a.value, negative: a.negative != b.negative }
                }
                _ => self.mul(self.signed(a), self.signed(b)),
            })
        });
        let second = terms[1].map(|term| if minus { Self::opposite(term) } else { term });
        match (terms[0], second) {
            (Some(a), Some(b)) => self.add(a, b, swap),
            (Some(a), None) | (None, Some(a)) => a,
            (None, None) => SignedValue { value: self.number(0.0), negative: false },
        }
    }

    /// An integer power: by repeated squaring up to the exponent ±32, which is cheaper than a function call.
    fn power(&mut self, a: ExprId, n: i32) -> SignedValue {
        let SignedValue { value, negative } = self.signed(a);
        let negative = negative && n % 2 != 0;
        if n.unsigned_abs() > 32 {
            return SignedValue { value: self.emit(Instruction::Powi(value, n)), negative };
        }
        let (mut square, mut product, mut exponent) = (value, None, n.unsigned_abs());
        while exponent > 0 {
            if exponent % 2 == 1 {
                product = Some(match product {
                    None => square,
                    Some(product) => self.emit(Instruction::Mul(product, square)),
                });
            }
            exponent /= 2;
            if exponent > 0 {
                square = self.emit(Instruction::Mul(square, square));
            }
        }
        let one = self.number(1.0);
        let power = product.unwrap_or(one);
        let value = if n < 0 { self.emit(Instruction::Div(one, power)) } else { power };
        SignedValue { value, negative }
    }
}

impl Program {
    /// The program for the outputs that `keep` accepts. The values are bitwise equal to those of the whole program.
    pub fn only(&self, keep: impl Fn(Slot) -> bool) -> Self {
        let outputs = self.outputs.iter().copied().filter(|(slot, _)| keep(*slot)).collect();
        schedule(Self { instructions: self.instructions.clone(), outputs })
    }
}

/// Drops unused instructions and orders the rest. The instructions that compute angles come first, grouped by the
/// number of nested sines and cosines on which the angles depend, so that the sines and cosines of a group are
/// adjacent; every other instruction follows in its original order.
fn schedule(program: Program) -> Program {
    let Program { instructions, outputs } = program;
    let is_pair = |index: usize| matches!(instructions[index], Instruction::SinCos(_));
    let mut depth = vec![0_usize; instructions.len()];
    for (index, instruction) in instructions.iter().enumerate() {
        let mut level = 0;
        instruction.for_each_operand(|operand| {
            level = level.max(depth[operand.index()] + usize::from(is_pair(operand.index())));
        });
        depth[index] = level;
    }
    // The lowest depth of a SinCos that depends on an instruction; `LAST` if none does.
    const LAST: usize = usize::MAX;
    let mut needed = vec![false; instructions.len()];
    let mut serves = vec![LAST; instructions.len()];
    outputs.iter().for_each(|(_, value)| needed[value.index()] = true);
    for index in (0..instructions.len()).rev() {
        if needed[index] {
            let level = if is_pair(index) { depth[index] } else { serves[index] };
            instructions[index].for_each_operand(|operand| {
                needed[operand.index()] = true;
                serves[operand.index()] = serves[operand.index()].min(level);
            });
        }
    }
    let phase = |index: usize| if is_pair(index) { (depth[index], true) } else { (serves[index], false) };
    let mut order: Vec<usize> = (0..instructions.len()).filter(|index| needed[*index]).collect();
    order.sort_by_key(|index| phase(*index));
    Program { instructions, outputs }.reordered(&order)
}

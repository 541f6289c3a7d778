//! The fold over expressions: one walk, of which evaluation, residues and rewriting are algebras.

use super::graph::Graph;
use super::map::IdMap;
use super::node::{ExprId, Node, Rotation, Symbol, Turning};

/// What the operations of expressions become. Methods are given the values of operands, or operands whose values are
/// [`known`](Self::known).
pub(crate) trait Algebra {
    /// What an expression becomes.
    type Value: Copy + Default;

    /// The graph that is folded.
    fn graph(&self) -> &Graph;
    /// The values so far.
    fn known(&mut self) -> &mut IdMap<Self::Value>;

    /// The value of an expression that is found without those of its operands.
    fn at_once(&mut self, _id: ExprId) -> Option<Self::Value> {
        None
    }
    /// A literal.
    fn number(&mut self, id: ExprId, value: f64) -> Self::Value;
    /// A symbol.
    fn symbol(&mut self, id: ExprId, symbol: Symbol) -> Self::Value;
    /// −a.
    fn neg(&mut self, a: Self::Value) -> Self::Value;
    /// a + b.
    fn add(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// a + a.
    fn double(&mut self, a: Self::Value) -> Self::Value {
        self.add(a, a)
    }
    /// a − b.
    fn sub(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// a · b.
    fn mul(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// a / b.
    fn div(&mut self, id: ExprId, a: Self::Value, b: Self::Value) -> Self::Value;
    /// aⁿ.
    fn powi(&mut self, id: ExprId, a: Self::Value, n: i32) -> Self::Value;
    /// a as one thing.
    fn whole(&mut self, a: Self::Value) -> Self::Value {
        a
    }
    /// A(φ)·s.
    fn rotate(&mut self, rotation: Rotation) -> [Self::Value; 2];
    /// u·d.
    fn dot(&mut self, Turning { u, d, .. }: Turning) -> Self::Value {
        let ([ux, uy], [dx, dy]) = (u.map(|id| self.value(id)), d.map(|id| self.value(id)));
        let (x, y) = (self.mul(ux, dx), self.mul(uy, dy));
        self.add(x, y)
    }
    /// u_x d_y − u_y d_x.
    fn cross(&mut self, Turning { u, d, .. }: Turning) -> Self::Value {
        let ([ux, uy], [dx, dy]) = (u.map(|id| self.value(id)), d.map(|id| self.value(id)));
        let (x, y) = (self.mul(ux, dy), self.mul(uy, dx));
        self.sub(x, y)
    }
    /// Everything else: functions, signs, angles of vectors, powers that are no integers.
    fn function(&mut self, id: ExprId, node: Node) -> Self::Value;

    /// The value of an operand.
    fn value(&mut self, id: ExprId) -> Self::Value {
        self.known().or(id, Self::Value::default())
    }

    /// The value of `root`: its operands first, without recursion, each expression once.
    fn fold(&mut self, root: ExprId) -> Self::Value {
        let mut open = vec![(root, false)];
        while let Some((id, ready)) = open.pop() {
            if self.known().contains(id) {
                continue;
            }
            if let Some(value) = self.at_once(id) {
                self.known().insert(id, value);
            } else if ready {
                let value = self.node(id);
                self.known().insert(id, value);
            } else {
                open.push((id, true));
                self.graph().node(id).for_each_operand(|operand| open.push((operand, false)));
            }
        }
        self.value(root)
    }

    /// The value of an expression from those of its operands.
    fn node(&mut self, id: ExprId) -> Self::Value {
        let node = self.graph().node(id);
        match node {
            Node::Number(bits) => self.number(id, bits.value()),
            Node::Symbol(symbol) => self.symbol(id, symbol),
            Node::Neg(a) => {
                let a = self.value(a);
                self.neg(a)
            }
            Node::Add(a, b) if a == b => {
                let a = self.value(a);
                self.double(a)
            }
            Node::Add(a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                self.add(a, b)
            }
            Node::Sub(a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                self.sub(a, b)
            }
            Node::Mul(a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                self.mul(a, b)
            }
            Node::Div(a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                self.div(id, a, b)
            }
            Node::Powi(a, n) => {
                let a = self.value(a);
                self.powi(id, a, n)
            }
            Node::Whole(a) => {
                let a = self.value(a);
                self.whole(a)
            }
            Node::RotX(rotation) => self.rotate(rotation)[0],
            Node::RotY(rotation) => self.rotate(rotation)[1],
            Node::Dot(turning) => self.dot(turning),
            Node::Cross(turning) => self.cross(turning),
            Node::Powf(..)
            | Node::Call(..)
            | Node::Sign(_)
            | Node::Atan2(..)
            | Node::Nearest(..)
            | Node::Supplied(..) => self.function(id, node),
        }
    }
}

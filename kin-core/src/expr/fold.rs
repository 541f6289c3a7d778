//! The fold over expressions; evaluation, residues and rewriting are algebras of it.

use super::graph::Graph;
use super::map::IdMap;
use super::node::{ExprId, Node, Rotation, Symbol, Turning};

/// An interpretation of the operations of expressions. Methods receive the values of operands, or operands whose values
/// can be read with [`value`](Self::value).
pub(crate) trait Algebra {
    /// The result for an expression.
    type Value: Copy + Default;

    /// The graph that is folded.
    fn graph(&self) -> &Graph;
    /// The values that have been computed.
    fn known(&mut self) -> &mut IdMap<Self::Value>;

    /// The value of an expression if it is known without visiting the operands.
    fn at_once(&mut self, _id: ExprId) -> Option<Self::Value> {
        None
    }
    /// The value of a literal.
    fn number(&mut self, id: ExprId, value: f64) -> Self::Value;
    /// The value of a symbol.
    fn symbol(&mut self, id: ExprId, symbol: Symbol) -> Self::Value;
    /// The value of −a.
    fn neg(&mut self, a: Self::Value) -> Self::Value;
    /// The value of a + b.
    fn add(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// The value of a + a.
    fn double(&mut self, a: Self::Value) -> Self::Value {
        self.add(a, a)
    }
    /// The value of a − b.
    fn sub(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// The value of a · b.
    fn mul(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// The value of a / b.
    fn div(&mut self, id: ExprId, a: Self::Value, b: Self::Value) -> Self::Value;
    /// The value of aⁿ.
    fn powi(&mut self, id: ExprId, a: Self::Value, n: i32) -> Self::Value;
    /// The value of an opaque expression, see [`Node::Opaque`].
    fn opaque(&mut self, a: Self::Value) -> Self::Value {
        a
    }
    /// The rotated vector A(φ)·s.
    fn rotate(&mut self, rotation: Rotation) -> [Self::Value; 2];
    /// The value of u·d.
    fn dot(&mut self, Turning { u, d, .. }: Turning) -> Self::Value {
        let ([ux, uy], [dx, dy]) = (u.map(|id| self.value(id)), d.map(|id| self.value(id)));
        let (x, y) = (self.mul(ux, dx), self.mul(uy, dy));
        self.add(x, y)
    }
    /// The value of u_x d_y − u_y d_x.
    fn cross(&mut self, Turning { u, d, .. }: Turning) -> Self::Value {
        let ([ux, uy], [dx, dy]) = (u.map(|id| self.value(id)), d.map(|id| self.value(id)));
        let (x, y) = (self.mul(ux, dy), self.mul(uy, dx));
        self.sub(x, y)
    }
    /// The value of any other node: functions, signs, atan2, non-integer powers.
    fn function(&mut self, id: ExprId, node: Node) -> Self::Value;

    /// The value of an operand that has been folded.
    fn value(&mut self, id: ExprId) -> Self::Value {
        self.known().or(id, Self::Value::default())
    }

    /// The value of `root`. Operands are visited first, each expression once, without recursion.
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

    /// The value of a node whose operands have been folded.
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
            Node::Opaque(a) => {
                let a = self.value(a);
                self.opaque(a)
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

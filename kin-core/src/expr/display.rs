//! Prints expressions with the user's names.

use super::graph::Graph;
use super::node::{ExprId, Node, Symbol};
use core::fmt;

/// Names for symbols, functions and parts of expressions.
pub trait Names {
    /// The name of `symbol`, e.g. `crank.phi` or `crank.phi_dot`.
    fn symbol(&self, symbol: Symbol) -> String;
    /// The name of a supplied function.
    fn function(&self, index: u32) -> String {
        format!("f{index}")
    }
    /// A name that replaces an expression wherever it is part of another one.
    fn part(&self, _id: ExprId) -> Option<&str> {
        None
    }
}

/// Numbered names: `q0`, `p1`, ….
impl Names for () {
    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Parameter(k) => format!("p{k}"),
            Symbol::Time => "t".to_owned(),
            Symbol::Input(k, order) => format!("u{k}{}", suffix(order)),
            Symbol::Coordinate(k) => format!("q{k}"),
            Symbol::Rate(k) => format!("q{k}_dot"),
            other => other.of_plan(),
        }
    }
}

/// `_dot` or `_ddot` for rates and accelerations.
pub(crate) const fn suffix(order: u8) -> &'static str {
    match order {
        0 => "",
        1 => "_dot",
        _ => "_ddot",
    }
}

/// An expression with everything needed to print it.
pub struct Shown<'a, N: Names> {
    /// The graph of the expression.
    pub graph: &'a Graph,
    /// The names.
    pub names: &'a N,
    /// The expression.
    pub id: ExprId,
}

/// Binding strengths of operations, from loose to tight.
const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const UNARY: u8 = 3;
const POWER: u8 = 4;
const ATOM: u8 = 5;

/// Maximum number of operands that are printed. Shared parts are written out at every use, so the text of a small
/// graph can become exponentially long; beyond this limit it is cut with an ellipsis.
const MAX_OPERANDS: usize = 50_000;

/// An item that remains to be written.
enum PendingItem {
    Text(&'static str),
    Owned(String),
    /// An expression, put in parentheses if it binds less tightly than the given strength.
    Operand(ExprId, u8),
}

use PendingItem::{Operand, Owned, Text};

impl<N: Names> fmt::Display for Shown<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A stack of the items that remain to be written; long sums and deep nesting cannot overflow the call stack.
        let mut waiting = vec![Operand(self.id, 0)];
        let mut operands = 0;
        while let Some(piece) = waiting.pop() {
            match piece {
                Text(text) => f.write_str(text)?,
                Owned(text) => f.write_str(&text)?,
                Operand(..) if operands == MAX_OPERANDS => return f.write_str("…"),
                Operand(id, outer_precedence) => {
                    operands += 1;
                    let part = if operands > 1 { self.names.part(id) } else { None };
                    if let Some(name) = part {
                        f.write_str(name)?;
                        continue;
                    }
                    let (precedence, pieces) = self.pieces(id);
                    let parentheses = precedence < outer_precedence;
                    waiting.extend(parentheses.then_some(Text(")")));
                    waiting.extend(pieces.into_iter().rev());
                    waiting.extend(parentheses.then_some(Text("(")));
                }
            }
        }
        Ok(())
    }
}

impl<N: Names> Shown<'_, N> {
    /// The binding strength of `id`, and the pieces of its text.
    fn pieces(&self, id: ExprId) -> (u8, Vec<PendingItem>) {
        match self.graph.node(id) {
            Node::Number(bits) if bits.value() < 0.0 => (UNARY, vec![Owned(bits.value().to_string())]),
            Node::Number(bits) => (ATOM, vec![Owned(bits.value().to_string())]),
            Node::Symbol(symbol) => (ATOM, vec![Owned(self.names.symbol(symbol))]),
            Node::Neg(a) => (UNARY, vec![Text("-"), Operand(a, UNARY)]),
            // a + a is cheaper to compute, but 2*a is easier to read.
            Node::Add(a, b) if a == b => (PRODUCT, vec![Text("2*"), Operand(a, UNARY)]),
            Node::Add(a, b) => match self.minus_sine(b) {
                Some(term) => (SUM, [vec![Operand(a, SUM), Text(" - ")], term].into_iter().flatten().collect()),
                None => (SUM, vec![Operand(a, SUM), Text(" + "), Operand(b, SUM)]),
            },
            Node::Sub(a, b) => match self.minus_sine(b) {
                Some(term) => (SUM, [vec![Operand(a, SUM), Text(" + ")], term].into_iter().flatten().collect()),
                None => (SUM, vec![Operand(a, SUM), Text(" - "), Operand(b, PRODUCT)]),
            },
            Node::Mul(a, b) => (PRODUCT, vec![Operand(a, PRODUCT), Text("*"), Operand(b, UNARY)]),
            Node::Div(a, b) => (PRODUCT, vec![Operand(a, PRODUCT), Text("/"), Operand(b, POWER)]),
            Node::Powi(a, n) => (POWER, vec![Operand(a, ATOM), Owned(format!("^{n}"))]),
            Node::Powf(a, n) => (POWER, vec![Operand(a, ATOM), Owned(format!("^{}", n.value()))]),
            Node::Call(function, a) => (ATOM, call(function.name().to_owned(), &[a])),
            Node::Sign(a) => (ATOM, call("sign".to_owned(), &[a])),
            Node::Atan2(y, x) => (ATOM, call("atan2".to_owned(), &[y, x])),
            Node::Opaque(a) => self.pieces(a),
            Node::Nearest(a, b) => (ATOM, call("nearest".to_owned(), &[a, b])),
            Node::RotX(r) => match (self.term(r.x, "cos", r.angle), self.minus_sine(id)) {
                (x, Some(y)) if x.is_empty() => (UNARY, [vec![Text("-")], y].into_iter().flatten().collect()),
                (x, _) => joined(x, " - ", self.term(r.y, "sin", r.angle)),
            },
            Node::RotY(r) => joined(self.term(r.x, "sin", r.angle), " + ", self.term(r.y, "cos", r.angle)),
            Node::Dot(t) => (SUM, products([(t.u[0], t.d[0]), (t.u[1], t.d[1])], " + ")),
            Node::Cross(t) => (SUM, products([(t.u[0], t.d[1]), (t.u[1], t.d[0])], " - ")),
            Node::Supplied(function, order, a) => {
                (ATOM, call(self.names.function(function) + &"'".repeat(usize::from(order)), &[a]))
            }
        }
    }

    /// `factor*of(angle)`; empty for a literal zero.
    fn term(&self, factor: ExprId, function: &'static str, angle: ExprId) -> Vec<PendingItem> {
        match self.graph.literal(factor) {
            Some(0.0) => Vec::new(),
            Some(1.0) => call(function.to_owned(), &[angle]),
            _ => [Operand(factor, UNARY), Text("*")].into_iter().chain(call(function.to_owned(), &[angle])).collect(),
        }
    }

    /// The term y*sin(φ) if `id` is −y*sin(φ), the x component of a rotated vector (0, y).
    fn minus_sine(&self, id: ExprId) -> Option<Vec<PendingItem>> {
        match self.graph.node(id) {
            Node::RotX(r) if self.graph.is_zero(r.x) && !self.graph.is_zero(r.y) => {
                Some(self.term(r.y, "sin", r.angle))
            }
            _ => None,
        }
    }
}

fn call(name: String, arguments: &[ExprId]) -> Vec<PendingItem> {
    let mut pieces = vec![Owned(name), Text("(")];
    for (index, argument) in arguments.iter().enumerate() {
        pieces.extend((index > 0).then_some(Text(", ")));
        pieces.push(Operand(*argument, 0));
    }
    pieces.push(Text(")"));
    pieces
}

/// Two terms joined by an operator; either may be empty.
fn joined(a: Vec<PendingItem>, operator: &'static str, b: Vec<PendingItem>) -> (u8, Vec<PendingItem>) {
    match (a.is_empty(), b.is_empty()) {
        (true, true) => (ATOM, vec![Text("0")]),
        (_, true) => (PRODUCT, a),
        (true, _) => (PRODUCT, b),
        _ => (SUM, a.into_iter().chain([Text(operator)]).chain(b).collect()),
    }
}

fn products(pairs: [(ExprId, ExprId); 2], operator: &'static str) -> Vec<PendingItem> {
    let product = |(a, b)| [Operand(a, UNARY), Text("*"), Operand(b, UNARY)];
    product(pairs[0]).into_iter().chain([Text(operator)]).chain(product(pairs[1])).collect()
}

//! Expressions as text, with the user's names.

use super::graph::Graph;
use super::node::{ExprId, Node, Symbol};
use core::fmt;

/// Names of the symbols.
pub trait Names {
    /// The name of `symbol`, e.g. `crank.phi` or `crank.phi_dot`.
    fn symbol(&self, symbol: Symbol) -> String;
    /// The name of a supplied function.
    fn function(&self, index: u32) -> String {
        format!("f{index}")
    }
}

/// Plain numbered names.
impl Names for () {
    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Parameter(k) => format!("p{k}"),
            Symbol::Time => "t".to_owned(),
            Symbol::Input(k, order) => format!("u{k}{}", suffix(order)),
            Symbol::Coordinate(k) => format!("q{k}"),
            Symbol::Rate(k) => format!("q{k}_dot"),
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

/// An expression that can be printed.
pub struct Shown<'a, N: Names> {
    /// Its graph.
    pub graph: &'a Graph,
    /// The names.
    pub names: &'a N,
    /// The expression.
    pub id: ExprId,
}

/// How tightly an operation binds.
const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const UNARY: u8 = 3;
const POWER: u8 = 4;

impl<N: Names> fmt::Display for Shown<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(self.id, 0, f)
    }
}

impl<N: Names> Shown<'_, N> {
    fn write(&self, id: ExprId, outer: u8, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let own = match self.graph.node(id) {
            Node::Add(..) | Node::Sub(..) | Node::Dot(_) | Node::Cross(_) => SUM,
            Node::Mul(..) | Node::Div(..) => PRODUCT,
            Node::Neg(_) => UNARY,
            Node::Powi(..) | Node::Powf(..) => POWER,
            Node::Number(bits) if bits.value() < 0.0 => UNARY,
            Node::RotX(r) | Node::RotY(r) if self.graph.is_zero(r.x) || self.graph.is_zero(r.y) => PRODUCT,
            Node::RotX(_) | Node::RotY(_) => SUM,
            _ => u8::MAX,
        };
        if own < outer {
            f.write_str("(")?;
        }
        match self.graph.node(id) {
            Node::Number(bits) => write!(f, "{}", bits.value())?,
            Node::Symbol(symbol) => f.write_str(&self.names.symbol(symbol))?,
            Node::Neg(a) => {
                f.write_str("-")?;
                self.write(a, UNARY, f)?;
            }
            Node::Add(a, b) => self.binary(a, " + ", b, SUM, SUM, f)?,
            Node::Sub(a, b) => self.binary(a, " - ", b, SUM, PRODUCT, f)?,
            Node::Mul(a, b) => self.binary(a, "*", b, PRODUCT, UNARY, f)?,
            Node::Div(a, b) => self.binary(a, "/", b, PRODUCT, POWER, f)?,
            Node::Powi(a, n) => {
                self.write(a, u8::MAX, f)?;
                write!(f, "^{n}")?;
            }
            Node::Powf(a, n) => {
                self.write(a, u8::MAX, f)?;
                write!(f, "^{}", n.value())?;
            }
            Node::Call(function, a) => self.call(function.name(), &[a], f)?,
            Node::Sign(a) => self.call("sign", &[a], f)?,
            Node::Atan2(y, x) => self.call("atan2", &[y, x], f)?,
            Node::RotX(r) => self.turned(r.angle, ("cos", r.x), ("sin", r.y), " - ", f)?,
            Node::RotY(r) => self.turned(r.angle, ("sin", r.x), ("cos", r.y), " + ", f)?,
            Node::Dot(t) => self.products([(t.u[0], t.d[0]), (t.u[1], t.d[1])], " + ", f)?,
            Node::Cross(t) => self.products([(t.u[0], t.d[1]), (t.u[1], t.d[0])], " - ", f)?,
            Node::Supplied(function, order, a) => {
                let primes = "'".repeat(usize::from(order));
                self.call(&format!("{}{primes}", self.names.function(function)), &[a], f)?;
            }
        }
        if own < outer {
            f.write_str(")")?;
        }
        Ok(())
    }

    fn binary(
        &self,
        a: ExprId,
        operator: &str,
        b: ExprId,
        left: u8,
        right: u8,
        f: &mut fmt::Formatter<'_>,
    ) -> fmt::Result {
        self.write(a, left, f)?;
        f.write_str(operator)?;
        self.write(b, right, f)
    }

    fn call(&self, name: &str, arguments: &[ExprId], f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{name}(")?;
        for (place, argument) in arguments.iter().enumerate() {
            if place > 0 {
                f.write_str(", ")?;
            }
            self.write(*argument, 0, f)?;
        }
        f.write_str(")")
    }

    /// `x*cos(φ) − y*sin(φ)`, without the terms that are literally zero.
    fn turned(
        &self,
        angle: ExprId,
        (of_x, x): (&str, ExprId),
        (of_y, y): (&str, ExprId),
        operator: &str,
        f: &mut fmt::Formatter<'_>,
    ) -> fmt::Result {
        let (no_x, no_y) = (self.graph.is_zero(x), self.graph.is_zero(y));
        if !no_x {
            self.write(x, UNARY, f)?;
            f.write_str("*")?;
            self.call(of_x, &[angle], f)?;
        }
        if !no_y {
            match (no_x, operator) {
                (true, " - ") => f.write_str("-")?,
                (true, _) => {}
                (false, operator) => f.write_str(operator)?,
            }
            self.write(y, UNARY, f)?;
            f.write_str("*")?;
            self.call(of_y, &[angle], f)?;
        }
        if no_x && no_y { f.write_str("0") } else { Ok(()) }
    }

    fn products(&self, pairs: [(ExprId, ExprId); 2], operator: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.binary(pairs[0].0, "*", pairs[0].1, UNARY, UNARY, f)?;
        f.write_str(operator)?;
        self.binary(pairs[1].0, "*", pairs[1].1, UNARY, UNARY, f)
    }
}

//! Expressions evaluated over numbers of any kind: plain, with a rounding bound, or dual.

use kin_core::expr::{ExprId, Graph, Node, Symbol};
use kin_core::mechanism::Function;
use num_dual::{Dual2_64, Dual64, DualNum};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that expressions can be evaluated with.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    fn real(value: f64) -> Self;
    /// f(self) where f, f′, f″ at the real part are known.
    fn chain(self, f: [f64; 3]) -> Self;
    fn value(self) -> f64;
    /// True where a function with an edge of its domain or a jump at `edge` cannot be told apart from that edge.
    fn near(self, edge: f64) -> bool;
    /// Infinitely uncertain.
    fn lost(self) -> Self;
    /// As uncertain as an angle is: a multiple of π is not one exactly.
    fn as_angle(self) -> Self {
        self
    }

    fn powi(self, n: i32) -> Self {
        let (x, m) = (self.value(), f64::from(n));
        let first = if n == 0 { 0.0 } else { m * x.powi(n - 1) };
        let second = if n == 0 || n == 1 { 0.0 } else { m * (m - 1.0) * x.powi(n - 2) };
        self.chain([x.powi(n), first, second])
    }

    fn powf(self, n: f64) -> Self {
        let x = self.value();
        let out = self.chain([x.powf(n), n * x.powf(n - 1.0), n * (n - 1.0) * x.powf(n - 2.0)]);
        if self.near(0.0) { out.lost() } else { out }
    }

    fn call(self, function: Function) -> Self {
        let x = self.value();
        let (sin, cos) = x.sin_cos();
        let root = (1.0 - x * x).sqrt();
        let edges: &[f64] = match function {
            Function::Asin | Function::Acos => &[-1.0, 1.0],
            Function::Sqrt | Function::Ln | Function::Abs => &[0.0],
            _ => &[],
        };
        let is_angle = matches!(function, Function::Sin | Function::Cos | Function::Tan);
        let argument = if is_angle { self.as_angle() } else { self };
        let out = argument.chain(match function {
            Function::Sin => [sin, cos, -sin],
            Function::Cos => [cos, -sin, -cos],
            Function::Tan => [x.tan(), 1.0 / (cos * cos), 2.0 * sin / (cos * cos * cos)],
            Function::Asin => [x.asin(), 1.0 / root, x / (root * root * root)],
            Function::Acos => [x.acos(), -1.0 / root, -x / (root * root * root)],
            Function::Atan => [x.atan(), 1.0 / (1.0 + x * x), -2.0 * x / ((1.0 + x * x) * (1.0 + x * x))],
            Function::Sqrt => [x.sqrt(), 0.5 / x.sqrt(), -0.25 / (x * x.sqrt())],
            Function::Exp => [x.exp(), x.exp(), x.exp()],
            Function::Ln => [x.ln(), 1.0 / x, -1.0 / (x * x)],
            Function::Abs => [x.abs(), x.signum(), 0.0],
        });
        if edges.iter().any(|edge| self.near(*edge)) { out.lost() } else { out }
    }

    fn sign(self) -> Self {
        let sign = Self::real(self.value().signum());
        if self.near(0.0) { sign.lost() } else { sign }
    }

    /// The angle at the real parts, and the small angle from there.
    fn atan2(self, x: Self) -> Self {
        let (y_value, x_value) = (self.value(), x.value());
        if self.near(0.0) && (x_value <= 0.0 || x.near(0.0)) {
            return self.lost();
        }
        let (real_y, real_x) = (Self::real(y_value), Self::real(x_value));
        let small = (real_x * self - real_y * x) / (real_x * x + real_y * self);
        Self::real(y_value.atan2(x_value)) + small.call(Function::Atan)
    }

    /// The supplied function of the tests, f(x) = sin 1.3x + x²/4 + k x, or one of its derivatives.
    fn supplied(self, function: u32, order: u8) -> Self {
        self.chain(std::array::from_fn(|k| supplied(function, order + k as u8, self.value())))
    }
}

/// The supplied function of the tests and its derivatives.
pub fn supplied(function: u32, order: u8, x: f64) -> f64 {
    let (sin, cos) = (1.3 * x).sin_cos();
    let slope = f64::from(function + 1);
    match order {
        0 => sin + 0.25 * x * x + slope * x,
        1 => 1.3 * cos + 0.5 * x + slope,
        2 => -1.69 * sin + 0.5,
        3 => -2.197 * cos,
        _ => 2.8561 * sin,
    }
}

impl Number for f64 {
    fn real(value: f64) -> Self {
        value
    }
    fn chain(self, f: [f64; 3]) -> Self {
        f[0]
    }
    fn value(self) -> f64 {
        self
    }
    fn near(self, _: f64) -> bool {
        false
    }
    fn lost(self) -> Self {
        self
    }
}

/// First derivatives by num-dual; its own rules for the functions.
impl Number for Dual64 {
    fn real(value: f64) -> Self {
        Self::from_re(value)
    }
    fn chain(self, f: [f64; 3]) -> Self {
        Self::new(f[0], f[1] * self.eps)
    }
    fn value(self) -> f64 {
        self.re
    }
    fn near(self, _: f64) -> bool {
        false
    }
    fn lost(self) -> Self {
        self
    }
    fn call(self, function: Function) -> Self {
        dual_call(self, function)
    }
    fn powi(self, n: i32) -> Self {
        DualNum::powi(&self, n)
    }
    fn powf(self, n: f64) -> Self {
        DualNum::powf(&self, n)
    }
}

/// First and second derivatives by num-dual.
impl Number for Dual2_64 {
    fn real(value: f64) -> Self {
        Self::from_re(value)
    }
    fn chain(self, f: [f64; 3]) -> Self {
        Self::new(f[0], f[1] * self.v1, f[1] * self.v2 + f[2] * self.v1 * self.v1)
    }
    fn value(self) -> f64 {
        self.re
    }
    fn near(self, _: f64) -> bool {
        false
    }
    fn lost(self) -> Self {
        self
    }
    fn call(self, function: Function) -> Self {
        dual_call(self, function)
    }
    fn powi(self, n: i32) -> Self {
        DualNum::powi(&self, n)
    }
    fn powf(self, n: f64) -> Self {
        DualNum::powf(&self, n)
    }
}

fn dual_call<D: DualNum<Primitive = f64>>(x: D, function: Function) -> D {
    match function {
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

/// A value with a bound, to first order, of what rounding can do to it however the same formula is ordered.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    pub value: f64,
    pub error: f64,
}

impl Bounded {
    fn rounded(value: f64, error: f64) -> Self {
        Self { value, error: error + f64::EPSILON * value.abs() }
    }

    /// True when `other` agrees: relative 1e-10 and what rounding may do.
    pub fn agrees(self, other: f64) -> bool {
        self.value == other || (self.value - other).abs() <= 1e-10 * self.value.abs() + 1e3 * self.error
    }

    /// True when the value means something.
    pub fn is_sound(self) -> bool {
        self.value.is_finite() && self.error.is_finite() && self.value.abs() < 1e100
    }
}

impl Number for Bounded {
    fn real(value: f64) -> Self {
        Self { value, error: 0.0 }
    }
    fn chain(self, f: [f64; 3]) -> Self {
        let error =
            if self.error == 0.0 { 0.0 } else { f[1].abs() * self.error + f[2].abs() * self.error * self.error };
        Self::rounded(f[0], error)
    }
    fn value(self) -> f64 {
        self.value
    }
    fn near(self, edge: f64) -> bool {
        (self.value - edge).abs() <= 1e3 * self.error + 1e-280
    }
    fn lost(self) -> Self {
        Self { error: f64::INFINITY, ..self }
    }
    fn as_angle(self) -> Self {
        Self::rounded(self.value, self.error)
    }
}

impl Add for Bounded {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        // A sum that cancels is as uncertain as its terms, even where they are exact: they may be associated otherwise.
        let terms = f64::EPSILON * (self.value.abs() + b.value.abs());
        Self::rounded(self.value + b.value, self.error + b.error + terms)
    }
}

impl Neg for Bounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Sub for Bounded {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Bounded {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::rounded(self.value * b.value, self.value.abs() * b.error + b.value.abs() * self.error)
    }
}

impl Div for Bounded {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        let out = Self::rounded(value, (self.error + value.abs() * b.error) / b.value.abs());
        if b.error > 0.0 && b.near(0.0) { out.lost() } else { out }
    }
}

/// The value of `id`, when everything under it is a plain number, far from overflow and from the jumps of functions:
/// another order of the same operations then changes nothing but the rounding.
pub fn bounded(graph: &Graph, id: ExprId, symbol: impl Fn(Symbol) -> Bounded) -> Option<Bounded> {
    let all = graph.reachable([id]);
    let values = evaluate_over(graph, &all, symbol);
    let place = all.binary_search(&id).ok()?;
    values.iter().all(|value| value.is_sound()).then(|| values[place])
}

/// The values of `roots` over any kind of number, straight from the definition of each node.
pub fn evaluate_over<S: Number>(graph: &Graph, roots: &[ExprId], symbol: impl Fn(Symbol) -> S) -> Vec<S> {
    let mut values = vec![S::real(0.0); graph.len()];
    for id in graph.reachable(roots.iter().copied()) {
        let v = |id: ExprId| values[id.index()];
        values[id.index()] = match graph.node(id) {
            Node::Number(bits) => S::real(bits.value()),
            Node::Symbol(s) => symbol(s),
            Node::Neg(a) => -v(a),
            Node::Add(a, b) => v(a) + v(b),
            Node::Sub(a, b) => v(a) - v(b),
            Node::Mul(a, b) => v(a) * v(b),
            Node::Div(a, b) => v(a) / v(b),
            Node::Powi(a, n) => v(a).powi(n),
            Node::Powf(a, n) => v(a).powf(n.value()),
            Node::Call(f, a) => v(a).call(f),
            Node::Sign(a) => v(a).sign(),
            Node::Atan2(y, x) => v(y).atan2(v(x)),
            // Of solution plans only, whose numbers are real.
            Node::Nearest(a, _) | Node::Opaque(a) => v(a),
            Node::RotX(r) => v(r.angle).call(Function::Cos) * v(r.x) - v(r.angle).call(Function::Sin) * v(r.y),
            Node::RotY(r) => v(r.angle).call(Function::Sin) * v(r.x) + v(r.angle).call(Function::Cos) * v(r.y),
            Node::Dot(t) => v(t.u[0]) * v(t.d[0]) + v(t.u[1]) * v(t.d[1]),
            Node::Cross(t) => v(t.u[0]) * v(t.d[1]) - v(t.u[1]) * v(t.d[0]),
            Node::Supplied(f, order, a) => v(a).supplied(f, order),
        };
    }
    roots.iter().map(|root| values[root.index()]).collect()
}

//! Random expression trees and the values of their symbols.

use super::oracle::Environment;
use super::{Number, supplied};
use kin_core::expr::{Bits, ExprId, Graph, Node, Rotation, Symbol, Turning};
use kin_core::mechanism::Function;
use num_dual::{Dual2_64, Dual64};
use proptest::prelude::*;

pub const PARAMETERS: u32 = 3;
pub const INPUTS: u32 = 2;
pub const COORDINATES: u32 = 4;

/// An expression before any graph has seen it.
#[derive(Clone, Debug)]
pub enum Tree {
    Number(f64),
    Symbol(Symbol),
    Neg(Box<Tree>),
    Add(Box<[Tree; 2]>),
    Sub(Box<[Tree; 2]>),
    Mul(Box<[Tree; 2]>),
    Div(Box<[Tree; 2]>),
    Powi(Box<Tree>, i32),
    Powf(Box<Tree>, f64),
    Call(Function, Box<Tree>),
    Sign(Box<Tree>),
    Atan2(Box<[Tree; 2]>),
    /// A component of a vector turned by an angle.
    Turned(bool, Box<[Tree; 3]>),
    /// u·d or u×d, u a vector of literals or parameters turned by an angle.
    Product(bool, [Leaf; 2], Box<[Tree; 3]>),
    Supplied(u32, Box<Tree>),
}

/// A number or a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Leaf {
    Number(f64),
    Parameter(u32),
}

impl Leaf {
    fn build(self, graph: &mut Graph) -> ExprId {
        match self {
            Self::Number(value) => graph.number(value),
            Self::Parameter(k) => graph.symbol(Symbol::Parameter(k)),
        }
    }
}

impl Tree {
    pub fn build(&self, graph: &mut Graph) -> ExprId {
        match self {
            Self::Number(value) => graph.number(*value),
            Self::Symbol(symbol) => graph.symbol(*symbol),
            Self::Neg(a) => {
                let a = a.build(graph);
                graph.neg(a)
            }
            Self::Add(ab) => Self::binary(ab, graph, Graph::add),
            Self::Sub(ab) => Self::binary(ab, graph, Graph::sub),
            Self::Mul(ab) => Self::binary(ab, graph, Graph::mul),
            Self::Div(ab) => Self::binary(ab, graph, Graph::div),
            Self::Powi(a, n) => {
                let a = a.build(graph);
                graph.powi(a, *n)
            }
            Self::Powf(a, n) => {
                let a = a.build(graph);
                graph.powf(a, *n)
            }
            Self::Call(f, a) => {
                let a = a.build(graph);
                graph.call(*f, a)
            }
            Self::Sign(a) => {
                let a = a.build(graph);
                graph.sign(a)
            }
            Self::Atan2(ab) => Self::binary(ab, graph, Graph::atan2),
            Self::Turned(is_x, parts) => {
                let [angle, x, y] = [0, 1, 2].map(|k: usize| parts[k].build(graph));
                graph.rotate(angle, [x, y])[usize::from(!is_x)]
            }
            Self::Product(is_dot, axis, parts) => {
                let [angle, x, y] = [0, 1, 2].map(|k: usize| parts[k].build(graph));
                let local = axis.map(|leaf| leaf.build(graph));
                let u = graph.rotate(angle, local);
                if *is_dot { graph.dot(angle, u, [x, y]) } else { graph.cross(angle, u, [x, y]) }
            }
            Self::Supplied(f, a) => {
                let a = a.build(graph);
                graph.supplied(*f, 0, a)
            }
        }
    }

    /// The tree with every operation as it is written.
    pub fn plain(&self, graph: &mut Graph) -> ExprId {
        let both = |ab: &[Self; 2], graph: &mut Graph| [ab[0].plain(graph), ab[1].plain(graph)];
        let node = match self {
            Self::Number(value) => return graph.number(*value),
            Self::Symbol(symbol) => return graph.symbol(*symbol),
            Self::Neg(a) => Node::Neg(a.plain(graph)),
            Self::Add(ab) => {
                let [a, b] = both(ab, graph);
                Node::Add(a, b)
            }
            Self::Sub(ab) => {
                let [a, b] = both(ab, graph);
                Node::Sub(a, b)
            }
            Self::Mul(ab) => {
                let [a, b] = both(ab, graph);
                Node::Mul(a, b)
            }
            Self::Div(ab) => {
                let [a, b] = both(ab, graph);
                Node::Div(a, b)
            }
            Self::Powi(a, n) => Node::Powi(a.plain(graph), *n),
            Self::Powf(a, n) => Node::Powf(a.plain(graph), Bits::new(*n)),
            Self::Call(f, a) => Node::Call(*f, a.plain(graph)),
            Self::Sign(a) => Node::Sign(a.plain(graph)),
            Self::Atan2(ab) => {
                let [y, x] = both(ab, graph);
                Node::Atan2(y, x)
            }
            Self::Turned(is_x, parts) => {
                let [angle, x, y] = [0, 1, 2].map(|k: usize| parts[k].plain(graph));
                if *is_x { Node::RotX(Rotation { angle, x, y }) } else { Node::RotY(Rotation { angle, x, y }) }
            }
            Self::Product(is_dot, axis, parts) => {
                let [angle, dx, dy] = [0, 1, 2].map(|k: usize| parts[k].plain(graph));
                let [x, y] = axis.map(|leaf| leaf.build(graph));
                let rotation = Rotation { angle, x, y };
                let u = [graph.intern(Node::RotX(rotation)), graph.intern(Node::RotY(rotation))];
                let turning = Turning { angle, u, d: [dx, dy] };
                if *is_dot { Node::Dot(turning) } else { Node::Cross(turning) }
            }
            Self::Supplied(f, a) => Node::Supplied(*f, 0, a.plain(graph)),
        };
        graph.intern(node)
    }

    fn binary(ab: &[Self; 2], graph: &mut Graph, f: fn(&mut Graph, ExprId, ExprId) -> ExprId) -> ExprId {
        let [a, b] = [ab[0].build(graph), ab[1].build(graph)];
        f(graph, a, b)
    }
}

fn numbers() -> impl Strategy<Value = f64> {
    use std::f64::consts::{FRAC_PI_2, PI};
    let special = [0.0, 0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.25, 4.0, -8.0, 3.0, -0.7, PI, -FRAC_PI_2];
    prop_oneof![4 => proptest::sample::select(special.to_vec()), 1 => -4.0..4.0_f64]
}

fn leaves() -> impl Strategy<Value = Tree> {
    prop_oneof![
        3 => numbers().prop_map(Tree::Number),
        2 => (0..PARAMETERS).prop_map(|k| Tree::Symbol(Symbol::Parameter(k))),
        1 => Just(Tree::Symbol(Symbol::Time)),
        1 => (0..INPUTS).prop_map(|k| Tree::Symbol(Symbol::Input(k, 0))),
        5 => (0..COORDINATES).prop_map(|k| Tree::Symbol(Symbol::Coordinate(k))),
    ]
}

fn axes() -> impl Strategy<Value = [Leaf; 2]> {
    let leaf = || prop_oneof![numbers().prop_map(Leaf::Number), (0..PARAMETERS).prop_map(Leaf::Parameter)];
    [leaf(), leaf()]
}

/// Trees of every kind of node.
pub fn trees() -> impl Strategy<Value = Tree> {
    leaves().prop_recursive(5, 40, 3, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        let two = || [inner.clone(), inner.clone()].prop_map(Box::new);
        let three = || [inner.clone(), inner.clone(), inner.clone()].prop_map(Box::new);
        prop_oneof![
            2 => one().prop_map(Tree::Neg),
            4 => two().prop_map(Tree::Add),
            4 => two().prop_map(Tree::Sub),
            5 => two().prop_map(Tree::Mul),
            2 => two().prop_map(Tree::Div),
            2 => (one(), -4..=6_i32).prop_map(|(a, n)| Tree::Powi(a, n)),
            1 => (one(), proptest::sample::select(vec![-2.0, -0.5, 0.5, 1.5, 2.5, 3.0, 1.0 / 3.0]))
                .prop_map(|(a, n)| Tree::Powf(a, n)),
            3 => (proptest::sample::select(Function::ALL.to_vec()), one()).prop_map(|(f, a)| Tree::Call(f, a)),
            1 => one().prop_map(Tree::Sign),
            1 => two().prop_map(Tree::Atan2),
            3 => (any::<bool>(), three()).prop_map(|(x, parts)| Tree::Turned(x, parts)),
            3 => (any::<bool>(), axes(), three()).prop_map(|(dot, axis, parts)| Tree::Product(dot, axis, parts)),
            1 => (0..2_u32, one()).prop_map(|(f, a)| Tree::Supplied(f, a)),
        ]
    })
}

/// Values of all symbols.
#[derive(Clone, Debug)]
pub struct Values {
    pub parameters: Vec<f64>,
    pub t: f64,
    /// Value, rate and acceleration.
    pub inputs: Vec<[f64; 3]>,
    pub q: Vec<f64>,
    pub q_dot: Vec<f64>,
}

/// Random values of all symbols, a few of them exactly zero.
pub fn values() -> impl Strategy<Value = Values> {
    let some = || prop_oneof![1 => Just(0.0), 20 => -2.0..2.0_f64];
    (
        proptest::collection::vec(some(), PARAMETERS as usize),
        some(),
        proptest::collection::vec([some(), some(), some()], INPUTS as usize),
        proptest::collection::vec(some(), COORDINATES as usize),
        proptest::collection::vec(some(), COORDINATES as usize),
    )
        .prop_map(|(parameters, t, inputs, q, q_dot)| Values { parameters, t, inputs, q, q_dot })
}

impl Environment for Values {
    fn symbol(&self, symbol: Symbol) -> f64 {
        match symbol {
            Symbol::Parameter(k) => self.parameters[k as usize],
            Symbol::Time => self.t,
            Symbol::Input(k, order) => self.inputs[k as usize][usize::from(order)],
            Symbol::Coordinate(k) => self.q[k as usize],
            Symbol::Rate(k) => self.q_dot[k as usize],
            _ => f64::NAN,
        }
    }

    fn supplied(&self, function: u32, order: u8, argument: f64) -> f64 {
        supplied(function, order, argument)
    }
}

impl Values {
    /// Plain numbers of another kind.
    pub fn plain<S: Number>(&self) -> impl Fn(Symbol) -> S + '_ {
        |symbol| S::real(Environment::symbol(self, symbol))
    }

    /// Along the motion q + s q̇, t + s, u + s u̇ + s² ü/2.
    pub fn motion(&self) -> impl Fn(Symbol) -> Dual2_64 + '_ {
        |symbol| {
            let value = Environment::symbol(self, symbol);
            match symbol {
                Symbol::Parameter(_) | Symbol::Rate(_) => Dual2_64::from_re(value),
                Symbol::Time => Dual2_64::new(value, 1.0, 0.0),
                Symbol::Input(k, order) => {
                    let part = |order: u8| self.inputs[k as usize].get(usize::from(order)).copied().unwrap_or(0.0);
                    Dual2_64::new(value, part(order + 1), part(order + 2))
                }
                Symbol::Coordinate(k) => Dual2_64::new(value, self.q_dot[k as usize], 0.0),
                _ => Dual2_64::from_re(f64::NAN),
            }
        }
    }

    /// Along q_k.
    pub fn along(&self, k: u32) -> impl Fn(Symbol) -> Dual64 + '_ {
        move |symbol| {
            let part = if symbol == Symbol::Coordinate(k) { 1.0 } else { 0.0 };
            Dual64::new(Environment::symbol(self, symbol), part)
        }
    }

    /// Along t with q held.
    pub fn along_time(&self) -> impl Fn(Symbol) -> Dual64 + '_ {
        |symbol| {
            let part = match symbol {
                Symbol::Time => 1.0,
                Symbol::Input(k, order) => self.inputs[k as usize].get(usize::from(order) + 1).copied().unwrap_or(0.0),
                _ => 0.0,
            };
            Dual64::new(Environment::symbol(self, symbol), part)
        }
    }
}

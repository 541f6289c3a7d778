//! Total time derivatives by direct differentiation (lecture, slides 52–63). All differentiation happens here.
//!
//! For e(q, t) the first derivative is ė = Σ_k e_k q̇_k + e_t and the second is ë = Σ_k e_k q̈_k + r. Both are
//! computed together, node by node from the derivatives of the operands, which preserves the structure of the
//! expressions. The coefficients e_k of q̇ (and of q̈) are the row of Φ_q, the velocity-free rest e_t is Φ_t, and the
//! acceleration-free rest r is −γ.

use super::graph::Graph;
use super::node::{ExprId, Node, Symbol};
use crate::vocabulary::Function;
use std::rc::Rc;

/// An expression with its first and second total time derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Jet {
    /// The partial derivatives e_k, by ascending k, for every coordinate that appears: the coefficients of q̇_k and of
    /// q̈_k.
    pub gradient: Vec<(u32, ExprId)>,
    /// The partial time derivative e_t, which is ė without the terms in q̇.
    pub partial_t: ExprId,
    /// The complete first derivative ė.
    pub rate: ExprId,
    /// The rest r, which is ë without the terms in q̈.
    pub rest: ExprId,
}

/// The derivatives of `roots`, which must not contain q̇.
pub fn total_derivatives(graph: &mut Graph, roots: &[ExprId]) -> Vec<Jet> {
    derivatives(graph, roots, of_symbol)
}

/// The derivatives of `roots`; `of_symbol` gives those of symbols.
pub(super) fn derivatives(graph: &mut Graph, roots: &[ExprId], of_symbol: fn(&mut Graph, Symbol) -> Jet) -> Vec<Jet> {
    let order = graph.reachable(roots.iter().copied());
    let unchanging = Rc::new(constant(graph));
    let mut jets: Vec<Rc<Jet>> = vec![unchanging; graph.len()];
    for id in order {
        if graph.depends(id).is_static() {
            continue;
        }
        let jet = match graph.node(id) {
            Node::Symbol(symbol) => of_symbol(graph, symbol),
            _ => derive(graph, &jets, id),
        };
        jets[id.index()] = Rc::new(jet);
    }
    roots.iter().map(|root| Jet::clone(&jets[root.index()])).collect()
}

/// The partial derivatives of `roots` with respect to a coordinate or to the argument of a curve.
pub fn partial<const N: usize>(graph: &mut Graph, roots: [ExprId; N], by: Symbol) -> [ExprId; N] {
    let (jets, zero) = (total_derivatives(graph, &roots), graph.zero());
    let is_by = |k: u32| Symbol::Coordinate(k) == by;
    let by_k = |jet: &Jet| jet.gradient.iter().find(|(k, _)| is_by(*k)).map_or(zero, |(_, e)| *e);
    core::array::from_fn(|index| jets.get(index).map_or(zero, by_k))
}

/// The derivatives of `id` from those of its operands.
fn derive(graph: &mut Graph, jets: &[Rc<Jet>], id: ExprId) -> Jet {
    let jet = |id: ExprId| Rc::clone(&jets[id.index()]);
    match graph.node(id) {
        Node::Neg(a) => {
            let minus = graph.number(-1.0);
            linear(graph, &[(Some(minus), &jet(a))])
        }
        Node::Add(a, b) => linear(graph, &[(None, &jet(a)), (None, &jet(b))]),
        Node::Sub(a, b) => {
            let minus = graph.number(-1.0);
            linear(graph, &[(None, &jet(a)), (Some(minus), &jet(b))])
        }
        Node::Mul(a, b) if a == b => {
            // (a²)˙ = 2a ȧ and (a²)¨ = 2a ä + 2ȧ²; the factor 2 of the rest is factored out.
            let (a_jet, double) = (jet(a), graph.double(a));
            let mut out = linear(graph, &[(Some(double), &a_jet)]);
            let (product, square) = (graph.mul(a, a_jet.rest), graph.square(a_jet.rate));
            let half = graph.add(product, square);
            let two = graph.number(2.0);
            out.rest = graph.mul(two, half);
            out
        }
        Node::Mul(a, b) => {
            // (ab)˙ = a ḃ + b ȧ and (ab)¨ = a b̈ + b ä + 2ȧ ḃ.
            let (a_jet, b_jet) = (jet(a), jet(b));
            let mut out = linear(graph, &[(Some(a), &b_jet), (Some(b), &a_jet)]);
            let two = graph.number(2.0);
            let product = graph.mul_all([two, a_jet.rate, b_jet.rate]);
            out.rest = graph.add(out.rest, product);
            out
        }
        Node::Div(a, b) => quotient(graph, id, &jet(a), b, &jet(b)),
        Node::Powi(a, n) => {
            let n_minus_1 = graph.powi(a, n - 1);
            let n_number = graph.number(f64::from(n));
            let first = graph.mul(n_number, n_minus_1);
            compose(graph, &jet(a), first, |graph| {
                let n_minus_2 = graph.powi(a, n - 2);
                let factor = graph.number(f64::from(n) * (f64::from(n) - 1.0));
                graph.mul(factor, n_minus_2)
            })
        }
        Node::Powf(a, n) => {
            let n = n.value();
            let power = graph.powf(a, n - 1.0);
            let factor = graph.number(n);
            let first = graph.mul(factor, power);
            compose(graph, &jet(a), first, |graph| {
                let factors = [graph.number(n), graph.number(n - 1.0), graph.powf(a, n - 2.0)];
                graph.mul_all(factors)
            })
        }
        Node::Call(f, a) => of_function(graph, f, id, a, &jet(a)),
        // Literals are constant, signs are piecewise constant, and symbols have been handled by the caller.
        Node::Number(_) | Node::Sign(_) | Node::Symbol(_) => constant(graph),
        Node::Atan2(y, x) => match (graph.node(y), graph.node(x)) {
            // atan2(u×d, u·d) is the direction of d minus that of u, whose rate is φ̇.
            (Node::Cross(t), Node::Dot(other)) if t == other => {
                let direction = of_atan2(graph, t.d, &jet(t.d[0]), &jet(t.d[1]));
                let minus = graph.number(-1.0);
                linear(graph, &[(None, &direction), (Some(minus), &jet(t.angle))])
            }
            _ => of_atan2(graph, [x, y], &jet(x), &jet(y)),
        },
        // The number of whole turns is constant during a motion.
        Node::Nearest(a, _) | Node::Opaque(a) => linear(graph, &[(None, &jet(a))]),
        Node::RotX(r) | Node::RotY(r) => {
            let along = graph.rotate(r.angle, [r.x, r.y]);
            rotated(
                graph,
                matches!(graph.node(id), Node::RotX(_)),
                r.angle,
                along,
                &jet(r.angle),
                [&jet(r.x), &jet(r.y)],
            )
        }
        Node::Dot(t) | Node::Cross(t) => {
            let pair = [graph.dot(t.angle, t.u, t.d), graph.cross(t.angle, t.u, t.d)];
            let is_dot = matches!(graph.node(id), Node::Dot(_));
            turning(graph, is_dot, t.u, pair, &jet(t.angle), [&jet(t.d[0]), &jet(t.d[1])])
        }
        Node::Supplied(f, order, a) => {
            let first = graph.supplied(f, order + 1, a);
            compose(graph, &jet(a), first, |graph| graph.supplied(f, order + 2, a))
        }
    }
}

pub(super) fn constant(graph: &mut Graph) -> Jet {
    let zero = graph.zero();
    Jet { gradient: Vec::new(), partial_t: zero, rate: zero, rest: zero }
}

fn of_symbol(graph: &mut Graph, symbol: Symbol) -> Jet {
    let given = rate_of_given(graph, symbol);
    let mut jet = Jet { partial_t: given, rate: given, ..constant(graph) };
    match symbol {
        Symbol::Input(k, order) => jet.rest = graph.symbol(Symbol::Input(k, order + 2)),
        Symbol::Coordinate(k) => {
            jet.gradient.push((k, graph.number(1.0)));
            jet.rate = graph.symbol(Symbol::Rate(k));
        }
        _ => {}
    }
    jet
}

/// The partial time derivative of a symbol that the caller supplies (t and inputs); 0 for constants, and for q and q̇,
/// which the position level and the velocity level treat differently.
pub(super) fn rate_of_given(graph: &mut Graph, symbol: Symbol) -> ExprId {
    match symbol {
        Symbol::Time => graph.number(1.0),
        Symbol::Input(k, order) => graph.symbol(Symbol::Input(k, order + 1)),
        Symbol::Coordinate(_)
        | Symbol::Rate(_)
        | Symbol::Acceleration(_)
        | Symbol::Parameter(_)
        | Symbol::Mode(_)
        | Symbol::Start(_)
        | Symbol::Unknown(_)
        | Symbol::Saved(_)
        | Symbol::Right(_)
        | Symbol::Coarseness => graph.zero(),
    }
}

/// Σ c·jet, where the coefficients c are not differentiated; a missing coefficient is 1.
fn linear(graph: &mut Graph, terms: &[(Option<ExprId>, &Jet)]) -> Jet {
    let zero = graph.zero();
    let mut out = Jet { gradient: Vec::new(), partial_t: zero, rate: zero, rest: zero };
    for (coefficient, jet) in terms {
        let scaled = |graph: &mut Graph, e: ExprId| match coefficient {
            Some(c) => graph.mul(*c, e),
            None => e,
        };
        for &(k, e) in &jet.gradient {
            let e = scaled(graph, e);
            accumulate(graph, &mut out.gradient, k, e);
        }
        for (sum, e) in [(&mut out.partial_t, jet.partial_t), (&mut out.rate, jet.rate), (&mut out.rest, jet.rest)] {
            let e = scaled(graph, e);
            *sum = graph.add(*sum, e);
        }
    }
    out.gradient.retain(|(_, e)| !graph.is_zero(*e));
    out
}

fn accumulate(graph: &mut Graph, gradient: &mut Vec<(u32, ExprId)>, k: u32, e: ExprId) {
    match gradient.binary_search_by_key(&k, |(k, _)| *k) {
        Ok(index) => gradient[index].1 = graph.add(gradient[index].1, e),
        Err(index) => gradient.insert(index, (k, e)),
    }
}

/// The derivatives of f(a), given f′ and f″: ė = f′ȧ, ë = f′ä + f″ȧ².
fn compose(graph: &mut Graph, a: &Jet, first: ExprId, second: impl FnOnce(&mut Graph) -> ExprId) -> Jet {
    let mut out = linear(graph, &[(Some(first), a)]);
    if !graph.is_zero(a.rate) {
        let (second, square) = (second(graph), graph.square(a.rate));
        let term = graph.mul(second, square);
        out.rest = graph.add(out.rest, term);
    }
    out
}

/// The derivatives of e = a/b: ė = (ȧ − e ḃ)/b, ë = (ä − e b̈ − 2ė ḃ)/b.
fn quotient(graph: &mut Graph, e: ExprId, a_jet: &Jet, b: ExprId, b_jet: &Jet) -> Jet {
    let minus_e = graph.neg(e);
    let mut out = linear(graph, &[(None, a_jet), (Some(minus_e), b_jet)]);
    out.rate = graph.div(out.rate, b);
    let two = graph.number(2.0);
    let product = graph.mul_all([two, out.rate, b_jet.rate]);
    let rest = graph.sub(out.rest, product);
    out.rest = graph.div(rest, b);
    out.partial_t = graph.div(out.partial_t, b);
    for (_, coefficient) in &mut out.gradient {
        *coefficient = graph.div(*coefficient, b);
    }
    out
}

fn of_function(graph: &mut Graph, f: Function, e: ExprId, a: ExprId, jet: &Jet) -> Jet {
    match f {
        Function::Sin => {
            let cos = graph.cos(a);
            compose(graph, jet, cos, |graph| graph.neg(e))
        }
        Function::Cos => {
            let sin = graph.sin(a);
            let first = graph.neg(sin);
            compose(graph, jet, first, |graph| graph.neg(e))
        }
        Function::Tan => {
            // tan′ = 1 + tan², tan″ = 2 tan (1 + tan²).
            let (one, square) = (graph.number(1.0), graph.square(e));
            let first = graph.add(one, square);
            compose(graph, jet, first, |graph| {
                let two = graph.number(2.0);
                graph.mul_all([two, e, first])
            })
        }
        Function::Asin | Function::Acos => {
            // f′ = ±1/√(1 − a²), f″ = ±a/√(1 − a²)³ = a f′/(1 − a²).
            let (one, square) = (graph.number(1.0), graph.square(a));
            let inside = graph.sub(one, square);
            let root = graph.call(Function::Sqrt, inside);
            let numerator = graph.number(if f == Function::Asin { 1.0 } else { -1.0 });
            let first = graph.div(numerator, root);
            compose(graph, jet, first, |graph| {
                let product = graph.mul(a, first);
                graph.div(product, inside)
            })
        }
        Function::Atan => {
            // f′ = 1/(1 + a²), f″ = −2a f′².
            let (one, square) = (graph.number(1.0), graph.square(a));
            let inside = graph.add(one, square);
            let first = graph.div(one, inside);
            compose(graph, jet, first, |graph| {
                let (minus_two, square) = (graph.number(-2.0), graph.square(first));
                graph.mul_all([minus_two, a, square])
            })
        }
        Function::Sqrt => square_root(graph, e, jet),
        Function::Exp => compose(graph, jet, e, |_| e),
        Function::Ln => {
            let one = graph.number(1.0);
            let first = graph.div(one, a);
            compose(graph, jet, first, |graph| {
                let square = graph.square(first);
                graph.neg(square)
            })
        }
        Function::Abs => {
            let first = graph.sign(a);
            compose(graph, jet, first, Graph::zero)
        }
    }
}

/// The derivatives of e = √a: ė = (ȧ/2)/e, ë = (ä/2 − ė²)/e, which follow from e² = a. A sum of squares has the factor 2 in
/// its derivatives, which cancels.
fn square_root(graph: &mut Graph, e: ExprId, jet: &Jet) -> Jet {
    let one = graph.number(1.0);
    let inverse = graph.div(one, e);
    let divided = |graph: &mut Graph, id: ExprId| {
        let half = graph.half_of(id);
        graph.mul(inverse, half)
    };
    let gradient = jet.gradient.iter().map(|&(k, entry)| (k, divided(graph, entry))).collect();
    let [partial_t, rate] = [jet.partial_t, jet.rate].map(|id| divided(graph, id));
    let (half, square) = (graph.half_of(jet.rest), graph.square(rate));
    let difference = graph.sub(half, square);
    Jet { gradient, partial_t, rate, rest: graph.mul(inverse, difference) }
}

/// The derivatives of e = atan2(y, x), with d = x² + y²: ė = (x ẏ − y ẋ)/d, ë = (x ÿ − y ẍ − 2ė (x ẋ + y ẏ))/d.
fn of_atan2(graph: &mut Graph, [x, y]: [ExprId; 2], x_jet: &Jet, y_jet: &Jet) -> Jet {
    let minus_y = graph.neg(y);
    let mut out = linear(graph, &[(Some(x), y_jet), (Some(minus_y), x_jet)]);
    let (xx, yy) = (graph.square(x), graph.square(y));
    let d = graph.add(xx, yy);
    out.rate = graph.div(out.rate, d);
    let two = graph.number(2.0);
    let radial = graph.plain_dot([x, y], [x_jet.rate, y_jet.rate]);
    let product = graph.mul_all([two, out.rate, radial]);
    let rest = graph.sub(out.rest, product);
    out.rest = graph.div(rest, d);
    out.partial_t = graph.div(out.partial_t, d);
    for (_, coefficient) in &mut out.gradient {
        *coefficient = graph.div(*coefficient, d);
    }
    out
}

/// The derivatives of ρ = A(φ)s: ρ̇ = φ̇ perp(ρ) + A ṡ, ρ̈ = φ̈ perp(ρ) − φ̇² ρ + 2φ̇ perp(A ṡ) + A s̈.
fn rotated(graph: &mut Graph, is_x: bool, angle: ExprId, rho: [ExprId; 2], phi: &Jet, s: [&Jet; 2]) -> Jet {
    let perp = [graph.neg(rho[1]), rho[0]];
    let side = usize::from(!is_x);
    let mut out = linear(graph, &[(Some(perp[side]), phi)]);
    if !graph.is_zero(phi.rate) {
        let square = graph.square(phi.rate);
        let centripetal = graph.mul(rho[side], square);
        out.rest = graph.sub(out.rest, centripetal);
    }
    let moving = s.iter().any(|jet| !jet.gradient.is_empty() || !graph.is_zero(jet.partial_t));
    if !moving {
        return out;
    }
    let turned = |graph: &mut Graph, x: ExprId, y: ExprId| graph.rotate(angle, [x, y]);
    let zero = graph.zero();
    let mut columns: Vec<u32> = s.iter().flat_map(|jet| jet.gradient.iter().map(|(k, _)| *k)).collect();
    columns.sort_unstable();
    columns.dedup();
    for k in columns {
        let part = |jet: &Jet| jet.gradient.iter().find(|(other, _)| *other == k).map_or(zero, |(_, e)| *e);
        let e = turned(graph, part(s[0]), part(s[1]))[side];
        accumulate(graph, &mut out.gradient, k, e);
    }
    let e = turned(graph, s[0].partial_t, s[1].partial_t)[side];
    out.partial_t = graph.add(out.partial_t, e);
    let s_dot = turned(graph, s[0].rate, s[1].rate);
    out.rate = graph.add(out.rate, s_dot[side]);
    let perp_s_dot = [graph.neg(s_dot[1]), s_dot[0]];
    let two = graph.number(2.0);
    let coriolis = graph.mul_all([two, perp_s_dot[side], phi.rate]);
    out.rest = graph.add(out.rest, coriolis);
    let e = turned(graph, s[0].rest, s[1].rest)[side];
    out.rest = graph.add(out.rest, e);
    out.gradient.retain(|(_, e)| !graph.is_zero(*e));
    out
}

/// The derivatives of c = u·d and z = u×d with u̇ = φ̇ perp(u): ċ = φ̇ z + u·ḋ, ż = −φ̇ c + u×ḋ, c̈ = φ̈ z − φ̇²
/// c + 2φ̇ u×ḋ + u·d̈, z̈ = −φ̈ c − φ̇² z − 2φ̇ u·ḋ + u×d̈.
fn turning(graph: &mut Graph, is_dot: bool, u: [ExprId; 2], [dot, cross]: [ExprId; 2], phi: &Jet, d: [&Jet; 2]) -> Jet {
    let (value, derivative) = if is_dot { (dot, cross) } else { (cross, graph.neg(dot)) };
    let minus_u_y = graph.neg(u[1]);
    let mut out = if is_dot {
        linear(graph, &[(Some(derivative), phi), (Some(u[0]), d[0]), (Some(u[1]), d[1])])
    } else {
        linear(graph, &[(Some(derivative), phi), (Some(u[0]), d[1]), (Some(minus_u_y), d[0])])
    };
    if !graph.is_zero(phi.rate) {
        let square = graph.square(phi.rate);
        let centripetal = graph.mul(value, square);
        out.rest = graph.sub(out.rest, centripetal);
        let d_dot = [d[0].rate, d[1].rate];
        let across = if is_dot {
            graph.plain_cross(u, d_dot)
        } else {
            let along = graph.plain_dot(u, d_dot);
            graph.neg(along)
        };
        let two = graph.number(2.0);
        let coriolis = graph.mul_all([two, across, phi.rate]);
        out.rest = graph.add(out.rest, coriolis);
    }
    out
}

//! How near a single unknown of an iteration f = 0 is to its dead centre, where its coefficient J = f′ is 0.
//!
//! The sizes of the terms of J do not always show that. A curve e(X, Y) = 0 of fourth degree at the end of a long arm has
//! coefficients whose terms are powers of the arm's length, although X and Y are as small as the curve; and a coefficient of
//! one term, such as the slope of a cam, has itself as its size. Derivatives of J do: to first order, the dead centre of an
//! angle is J/J′ away. This is in radians, as the distances of other groups from their limits are. For an unknown length or
//! scalar, J/J′ has a unit, and J² is compared with |J′| times the terms of f, as b² is with a c in a quadratic equation.

use super::dense::kinds;
use super::rates::{Rates, SingleUnknown};
use super::sizes::{is_at_rest_or_coordinate, larger, smaller, squared_size_anywhere};
use super::tree::Block;
use crate::constraint::Coordinate;
use crate::expr::{ExprId, Graph, MAX_ORDER, Node, Symbol, partial, total_derivatives};
use crate::hash::FastMap;
use crate::vocabulary::{Function, UnknownKind};
use std::collections::BTreeMap;

/// Depth to which the terms of a coefficient are examined.
const DEPTH: usize = 8;

/// The least squared size of a coefficient, relative to its squared terms: where its gradient is 0, too, a coefficient that
/// consists of rounding errors is small.
const ROUNDING: f64 = 1e-18;

impl Rates<'_> {
    /// Records the margins and orientations of all single unknowns of iterations.
    pub(super) fn record_single_unknowns(&mut self, tree: &Block, entries: &[BTreeMap<u32, ExprId>]) {
        for single in std::mem::take(&mut self.single_unknowns) {
            let size = match single.kind {
                UnknownKind::Angle => squared_size_for_angle(self.graph, &single, (tree, entries, self.coordinates)),
                _ => squared_size_for_length(self.graph, &single),
            };
            self.record_single(single.row, single.coefficient, size);
            self.regular.extend(self.margins.get(&single.row));
        }
    }
}

/// The square of what the coefficient J of an unknown length or scalar is compared with: the squared terms of J, or |J′| times the
/// terms of f if that is larger and known, and if J is f′ itself and not a multiple of it.
fn squared_size_for_length(graph: &mut Graph, single: &SingleUnknown) -> ExprId {
    let of_coefficient = squared_size_anywhere(graph, single.coefficient, DEPTH);
    let by = Symbol::Coordinate(single.unknown);
    let [first] = partial(graph, [single.residual], by);
    let [second] = partial(graph, [first], by);
    if first != single.coefficient || graph.is_zero(second) || !is_known(graph, second) {
        return of_coefficient;
    }
    let terms = squared_size_anywhere(graph, single.residual, DEPTH);
    let (terms, second) = (graph.call(Function::Sqrt, terms), graph.call(Function::Abs, second));
    let product = graph.mul(second, terms);
    larger(graph, of_coefficient, product)
}

/// The square of what the coefficient J of an unknown angle is compared with: the squared gradient of J with respect to the angles, so that
/// |J|/|∇J| is, to first order, the distance from the configurations with J = 0. Of the unknown angle, the derivative is the
/// one along the motion in which it changes at the rate 1 and all that is known before it rests; others are partial. That of
/// the unknown alone would not do: for special dimensions it is nearly 0 where J is.
///
/// If the squares of the terms of J are smaller than that, they are the measure: the direction of a short distance turns
/// fast, and yet its sine is compared with 1.
fn squared_size_for_angle(
    graph: &mut Graph,
    single: &SingleUnknown,
    (tree, entries, coordinates): (&Block, &[BTreeMap<u32, ExprId>], &[Coordinate]),
) -> ExprId {
    let coefficient = single.coefficient;
    let terms = squared_size_anywhere(graph, coefficient, DEPTH);
    let gradient =
        total_derivatives(graph, &[coefficient]).into_iter().next().map_or_else(Vec::new, |jet| jet.gradient);
    let slope = slope(graph, (&gradient, single.unknown), (tree, entries, coordinates));
    if graph.is_zero(slope) || !is_known(graph, slope) {
        return terms;
    }
    let mut square = graph.square(slope);
    if is_single_term(graph, coefficient) {
        return square;
    }
    for (k, derivative) in gradient {
        let is_angle = kinds(coordinates, &[k]) == [UnknownKind::Angle];
        if is_angle && k != single.unknown && is_known(graph, derivative) {
            let derivative_square = graph.square(derivative);
            square = graph.add(square, derivative_square);
        }
    }
    let (size, rounding) = (smaller(graph, terms, square), graph.number(ROUNDING));
    let rounding = graph.mul(rounding, terms);
    larger(graph, size, rounding)
}

/// The derivative of a coefficient, whose partial derivatives are given, along the motion in which its angle changes at the
/// rate 1.
fn slope(
    graph: &mut Graph,
    (gradient, angle): (&[(u32, ExprId)], u32),
    (tree, entries, coordinates): (&Block, &[BTreeMap<u32, ExprId>], &[Coordinate]),
) -> ExprId {
    let zero = graph.zero();
    let mut rates = Rates::new(graph, entries.to_vec(), vec![zero; entries.len()], coordinates, FastMap::default());
    rates.turning = Some(angle);
    rates.block(tree);
    let motion = rates.solution;
    gradient.iter().fold(zero, |slope, &(k, derivative)| match motion.get(k as usize) {
        Some(&Some(rate)) => {
            let term = graph.mul(derivative, rate);
            graph.add(slope, term)
        }
        _ => slope,
    })
}

/// False for an expression with more derivatives of a function than there are.
fn is_known(graph: &Graph, id: ExprId) -> bool {
    let is_given = |id: &ExprId| !matches!(graph.node(*id), Node::Supplied(_, order, _) if order > MAX_ORDER);
    graph.reachable([id]).iter().all(is_given)
}

/// True for products and quotients of coordinates, powers and functions other than sine and cosine, whose size is 1.
fn is_single_term(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) | Node::Div(a, _) => is_single_term(graph, a),
        Node::Mul(a, b) => is_single_term(graph, a) && is_single_term(graph, b),
        // x − c is the position relative to c, which is measured as a whole, as in `squared_size_anywhere`.
        Node::Add(a, b) | Node::Sub(a, b) => [a, b].into_iter().all(|part| is_sum_of_positions(graph, part)),
        Node::RotX(_) | Node::RotY(_) | Node::Dot(_) | Node::Cross(_) => false,
        Node::Call(Function::Sin | Function::Cos, _) => false,
        _ => true,
    }
}

/// True for sums of coordinates and constants.
fn is_sum_of_positions(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Neg(a) | Node::Opaque(a) => is_sum_of_positions(graph, a),
        Node::Add(a, b) | Node::Sub(a, b) => is_sum_of_positions(graph, a) && is_sum_of_positions(graph, b),
        _ => is_at_rest_or_coordinate(graph, id),
    }
}

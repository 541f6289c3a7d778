//! Code shared by contacts with curves: a point relative to the curve's frame, formulas in the curve's variables, and
//! the curve for drawings.

use crate::constraint::{Assembly, PlacedPoint, Variables};
use crate::expr::{ExprId, Symbol, partial};
use crate::mechanism::Formula;

/// The vector r_Q − r_P.
pub(super) fn between(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint) -> [ExprId; 2] {
    [a.graph.sub(q.r[0], p.r[0]), a.graph.sub(q.r[1], p.r[1])]
}

/// The vector w = A_iᵀ(r_Q − r_P).
pub(super) fn seen(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint) -> [ExprId; 2] {
    let d = between(a, p, q);
    let (one, zero) = (a.graph.number(1.0), a.graph.zero());
    let u = a.graph.rotate(p.angle, [one, zero]);
    [a.graph.dot(p.angle, u, d), a.graph.cross(p.angle, u, d)]
}

/// The expression of a formula in θ.
pub(super) fn in_theta(a: &mut Assembly<'_>, formula: &Formula, theta: ExprId) -> ExprId {
    inside(a, Variables { theta: Some(theta), ..Variables::default() }, formula)
}

/// The expression of a formula in X and Y.
pub(super) fn in_point(a: &mut Assembly<'_>, formula: &Formula, point: [ExprId; 2]) -> ExprId {
    inside(a, Variables { point: Some(point), ..Variables::default() }, formula)
}

/// The expression of a formula in the parameter `k` of a curve that is written for drawings.
pub(super) fn in_parameter(a: &mut Assembly<'_>, formula: &Formula, k: u32) -> ExprId {
    inside(a, Variables { parameter: Some(k), ..Variables::default() }, formula)
}

fn inside(a: &mut Assembly<'_>, variables: Variables, formula: &Formula) -> ExprId {
    let outer = std::mem::replace(&mut a.variables, variables);
    let value = a.formula(formula);
    a.variables = outer;
    value
}

/// Records the curve P + `relative` in the frame of body i, with its tangent, for drawings.
pub(super) fn draw(a: &mut Assembly<'_>, p: &PlacedPoint, relative: [ExprId; 2]) {
    let [x, y] = [0, 1].map(|k| a.graph.add(p.local[k], relative[k]));
    let [dx, dy] = partial(&mut a.graph, relative, Symbol::ARGUMENT);
    a.outline = Some([x, y, dx, dy]);
}

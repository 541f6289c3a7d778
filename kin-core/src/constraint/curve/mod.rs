//! Contacts with curves: what is common to the ways of writing one, each of which has a file of its own.
//!
//! A curve is fixed in body i with its centre at P. Where Q stands as seen from it is
//! ```text
//! w = A_iᵀ(r_Q − r_P)
//! ```
//! w_x = u·d and w_y = u×d for u = A_i(1, 0), d = r_Q − r_P: two atoms that are each other's derivative.

pub(super) mod flat_follower;
mod implicit;
mod parametric;
mod polar;

use super::assembly::{Assembly, Rows};
use super::placed::PlacedPoint;
use crate::expr::{ExprId, Symbol, partial};
use crate::mechanism::{Curve, CurveVariable, Formula, Place};

/// What the variables of the curve at hand stand for; nothing outside of a curve.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Variables {
    theta: Option<ExprId>,
    point: Option<[ExprId; 2]>,
    /// The parameter that stands for the argument of a curve that is drawn.
    parameter: Option<u32>,
}

impl Variables {
    /// True for the parameter of a curve that is drawn.
    pub(super) fn is_parameter(&self, k: u32) -> bool {
        self.parameter == Some(k)
    }

    /// What `variable` stands for.
    pub(super) const fn get(&self, variable: CurveVariable) -> Option<ExprId> {
        match (variable, self.point) {
            (CurveVariable::Theta, _) => self.theta,
            (CurveVariable::X, Some([x, _])) => Some(x),
            (CurveVariable::Y, Some([_, y])) => Some(y),
            (_, None) => None,
        }
    }
}

/// The rows of Q on a curve of P's body.
pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, q: &Place, curve: &Curve) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    match curve {
        Curve::Polar { radius, origin } => polar::rows(a, &p, &q, radius, *origin),
        Curve::Implicit { value, .. } => implicit::rows(a, &p, &q, value),
        Curve::Parametric { parameter, x, y, roller, .. } => {
            parametric::rows(a, &p, &q, parameter, [x, y], roller.as_ref())
        }
    }
}

/// r_Q − r_P.
fn between(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint) -> [ExprId; 2] {
    [a.graph.sub(q.r[0], p.r[0]), a.graph.sub(q.r[1], p.r[1])]
}

/// w = A_iᵀ(r_Q − r_P).
fn seen(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint) -> [ExprId; 2] {
    let d = between(a, p, q);
    let (one, zero) = (a.graph.number(1.0), a.graph.zero());
    let u = a.graph.rotate(p.angle, [one, zero]);
    [a.graph.dot(p.angle, u, d), a.graph.cross(p.angle, u, d)]
}

/// A formula in θ.
fn in_theta(a: &mut Assembly<'_>, formula: &Formula, theta: ExprId) -> ExprId {
    inside(a, Variables { theta: Some(theta), ..Variables::default() }, formula)
}

/// A formula in X and Y.
fn in_point(a: &mut Assembly<'_>, formula: &Formula, point: [ExprId; 2]) -> ExprId {
    inside(a, Variables { point: Some(point), ..Variables::default() }, formula)
}

/// A formula in the parameter `k` of a curve that is drawn.
fn in_parameter(a: &mut Assembly<'_>, formula: &Formula, k: u32) -> ExprId {
    inside(a, Variables { parameter: Some(k), ..Variables::default() }, formula)
}

fn inside(a: &mut Assembly<'_>, variables: Variables, formula: &Formula) -> ExprId {
    let outer = std::mem::replace(&mut a.variables, variables);
    let value = a.formula(formula);
    a.variables = outer;
    value
}

/// Notes the curve that goes through P + `relative` of body i, with its tangent, for a drawing.
fn draw(a: &mut Assembly<'_>, p: &PlacedPoint, relative: [ExprId; 2]) {
    let [x, y] = [0, 1].map(|k| a.graph.add(p.local[k], relative[k]));
    let [dx, dy] = partial(&mut a.graph, relative, Symbol::ARGUMENT);
    a.outline = Some([x, y, dx, dy]);
}

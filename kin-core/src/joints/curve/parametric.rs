//! A point on a curve in parametric form: Q of body j is at c(u) of body i, where u is a scalar coordinate.
//!
//! Rows (2), lengths:
//! ```text
//! r_Q − r_P − A_i c(u) = 0
//! ```
//! If a roller of signed radius R runs on the curve, its centre Q is on the parallel curve
//! ```text
//! c + R perp(c′)/|c′|,   c′ = dc/du,   perp(v) = (−v_y, v_x)
//!
//!          R > 0   ○ Q            R is measured to the left of the direction in which u grows:
//!                  ┊              inwards of a curve that runs counter-clockwise,
//!      ────────────●───────▶ u    so that a roller on its outside has R < 0.
//!                  ┊
//!          R < 0   ○ Q
//! ```
//! Singular where c′ = 0 if there is a roller, and where R equals the signed radius of curvature (undercut). After
//! Haug (1989), section 3.4; parallel curves after do Carmo, *Differential Geometry of Curves and Surfaces*, section
//! 1-7.

use super::relative::{between, draw, in_parameter};
use crate::constraint::{Assembly, JointRows, PlacedPoint, RowMeaning};
use crate::expr::{ExprId, Symbol, partial};
use crate::mechanism::{Formula, Function, Member};
use crate::vocabulary::Role;

pub(super) fn rows(
    a: &mut Assembly<'_>,
    p: &PlacedPoint,
    q: &PlacedPoint,
    parameter: &Member,
    components: [&Formula; 2],
    roller: Option<&Formula>,
) -> JointRows {
    let mut rows = JointRows::between(p, q);
    let c = components.map(|component| a.formula(component));
    let u = a.scalar(parameter);
    if let Some(u) = u {
        let drawn = components.map(|component| in_parameter(a, component, u));
        draw(a, p, drawn);
    }
    let c = match (roller, u) {
        (Some(radius), Some(u)) => {
            let radius = a.formula(radius);
            rows.geometry.push((Role::Radius, p.frame, vec![radius]));
            parallel(a, c, u, radius)
        }
        _ => c,
    };
    let (d, c) = (between(a, p, q), a.graph.rotate(p.angle, c));
    rows.residuals =
        vec![("x", RowMeaning::Other, a.graph.sub(d[0], c[0])), ("y", RowMeaning::Other, a.graph.sub(d[1], c[1]))];
    rows
}

/// The parallel curve c + R perp(c′)/|c′|.
fn parallel(a: &mut Assembly<'_>, c: [ExprId; 2], u: u32, radius: ExprId) -> [ExprId; 2] {
    if a.graph.is_zero(radius) {
        return c;
    }
    let [x, y] = partial(&mut a.graph, c, Symbol::Coordinate(u));
    let square = a.graph.plain_dot([x, y], [x, y]);
    let length = a.graph.call(Function::Sqrt, square);
    let factor = a.graph.div(radius, length);
    let offset = [a.graph.mul(factor, y), a.graph.mul(factor, x)];
    [a.graph.sub(c[0], offset[0]), a.graph.add(c[1], offset[1])]
}

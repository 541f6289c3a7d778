//! A point on a curve in implicit form: Q of body j is where e(X, Y) of body i vanishes.
//!
//! Row (1), in the unit of e:
//! ```text
//! e(X, Y) = 0 at (X, Y) = w = A_iᵀ(r_Q − r_P)
//! ```
//! Singular where the gradient of e vanishes on the curve (a double point, a cusp). After Haug (1989), section 3.4.

use super::relative::{in_point, seen};
use crate::constraint::{Assembly, JointRows, PlacedPoint, RowMeaning};
use crate::mechanism::Formula;

pub(super) fn rows(a: &mut Assembly<'_>, p: &PlacedPoint, q: &PlacedPoint, value: &Formula) -> JointRows {
    let mut rows = JointRows::between(p, q);
    let w = seen(a, p, q);
    rows.residuals = vec![("", RowMeaning::Other, in_point(a, value, w))];
    rows
}

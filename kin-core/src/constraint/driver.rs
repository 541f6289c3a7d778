//! Driving constraints and free-form equations.
//!
//! Row (1):
//! ```text
//! left − right = 0
//! ```
//! A driver whose left side is exactly `distance(P, Q)` is written |r_Q − r_P|² − f², which has no square root and
//! the same solutions for f > 0. After Haug (1989), section 3.5.

use super::assembly::{Assembly, Rows};
use super::distance;
use crate::error::Origin;
use crate::mechanism::Formula;

pub(super) fn rows(a: &mut Assembly<'_>, left: &Formula, right: &Formula, origin: Origin) -> Rows {
    if let Formula::Distance(p, q) = left {
        let (p, q) = (a.place(p), a.place(q));
        let length = a.formula(right);
        return distance::between(a, &p, &q, length, origin);
    }
    equation(a, left, right)
}

pub(super) fn equation(a: &mut Assembly<'_>, left: &Formula, right: &Formula) -> Rows {
    let (left, right) = (a.formula(left), a.formula(right));
    Rows { residuals: vec![("", a.graph.sub(left, right))], ..Rows::default() }
}

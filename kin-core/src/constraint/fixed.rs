//! Fixed joint: two bodies move as one.
//!
//! Rows (3): those of a revolute joint, and the relative angle.
//! ```text
//! x, y:   r_Q − r_P = 0
//! angle:  φ_j − φ_i − c = 0
//! ```

use super::assembly::{Assembly, Rows};
use super::revolute::coincidence;
use super::set::Role;
use crate::mechanism::{Formula, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, q: &Place, angle: &Formula) -> Rows {
    let (p, q) = (a.place(p), a.place(q));
    let angle = a.formula(angle);
    let mut rows = Rows::between(&p, &q);
    rows.geometry.push((Role::Value, p.frame, vec![angle]));
    rows.residuals = coincidence(a, p.r, q.r);
    let turn = a.graph.sub(q.angle, p.angle);
    rows.residuals.push(("angle", a.graph.sub(turn, angle)));
    rows
}

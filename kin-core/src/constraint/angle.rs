//! Absolute and relative angle of bodies.
//!
//! Row (1), in radians, never wrapped:
//! ```text
//! φ − e = 0        or        φ_b − φ_a − e = 0
//! ```
//! After Haug (1989), section 3.2 and 3.3.

use super::assembly::{Assembly, Rows};
use super::set::{Frame, Role};
use crate::mechanism::{BodyRef, Formula};

pub(super) fn absolute(a: &mut Assembly<'_>, body: &BodyRef, value: &Formula) -> Rows {
    let frame = a.frame(body);
    let phi = a.pose(body)[2];
    let value = a.formula(value);
    Rows {
        residuals: vec![("", a.graph.sub(phi, value))],
        geometry: vec![(Role::Value, frame.unwrap_or(Frame::Ground), vec![value])],
        frames: [frame, None],
        ..Rows::default()
    }
}

pub(super) fn relative(a: &mut Assembly<'_>, i: &BodyRef, j: &BodyRef, value: &Formula) -> Rows {
    let frames = [a.frame(i), a.frame(j)];
    let (phi_i, phi_j) = (a.pose(i)[2], a.pose(j)[2]);
    let value = a.formula(value);
    let turn = a.graph.sub(phi_j, phi_i);
    Rows {
        residuals: vec![("", a.graph.sub(turn, value))],
        geometry: vec![(Role::Value, frames[0].unwrap_or(Frame::Ground), vec![value])],
        quantities: vec![("angle", turn)],
        frames,
        ..Rows::default()
    }
}

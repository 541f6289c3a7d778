//! Absolute x or y of a point.
//!
//! Row (1), in units of length:
//! ```text
//! x_P − e = 0        or        y_P − e = 0
//! ```
//! After Haug (1989), section 3.2.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, JointRows, RowMeaning};
use crate::mechanism::{Component, Dimension, Formula, OperandSlot, Place};
use crate::vocabulary::Role;

joint! {
    /// Operands of an absolute x.
    X {
        /// The point P.
        p: Place = OperandSlot::component_of_point("p", Component::X),
        /// The value e.
        value: Formula = OperandSlot::value(Dimension::Length),
    }
    example: "#[x(A: slider @ (0, 0) = 0.1)]"
}

joint! {
    /// Operands of an absolute y.
    Y {
        /// The point P.
        p: Place = OperandSlot::component_of_point("p", Component::Y),
        /// The value e.
        value: Formula = OperandSlot::value(Dimension::Length),
    }
    example: "#[y(A: slider @ (0, 0) = 0)]"
}

impl JointType for X {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        rows(a, &self.p, 0, &self.value)
    }
}

impl JointType for Y {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        rows(a, &self.p, 1, &self.value)
    }
}

fn rows(a: &mut Assembly<'_>, p: &Place, component: usize, value: &Formula) -> JointRows {
    let p = a.place(p);
    let value = a.formula(value);
    JointRows {
        residuals: vec![("", RowMeaning::Coordinate(component), a.graph.sub(p.r[component], value))],
        geometry: vec![(Role::P, p.frame, p.local.to_vec()), (Role::Value, p.frame, vec![value])],
        frames: [Some(p.frame), None],
        ..JointRows::default()
    }
}

//! Free-form rows of velocity level, and the code that all rows of this level share.
//!
//! Row (1), linear in the rates that `dot(…)` stands for:
//! ```text
//! η = left − right = B(q, t) q̇ + b(q, t) = 0
//! ```
//! The row has no residual at position level; B is its row of Φ_q, and b its entry of Φ_t. In general such a row is
//! not integrable: it does not restrict which positions can be reached. After Haug (1989), section 3.5.3, and
//! Nikravesh (1988), section 1.3.

use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, JointRows, PlacedPoint, VelocityRow};
use crate::expr::ExprId;
use crate::mechanism::{Formula, OperandSlot, OperandType, Place};
use crate::vocabulary::Role;

joint! {
    /// The sides of an equation of velocity level.
    Nonholonomic {
        /// The left side.
        left: Formula = OperandSlot::left(OperandType::SideOfRates),
        /// The right side.
        right: Formula = OperandSlot::right(OperandType::SideOfRates),
    }
    example: "#[nonholonomic(A: dot(wheel.x) = -R*dot(wheel.phi))]"
}

impl JointType for Nonholonomic {
    const REACTION: Reaction = Reaction::Generalized;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let velocity = velocity_row(a, |a| {
            let (left, right) = (a.formula(&self.left), a.formula(&self.right));
            a.graph.sub(left, right)
        });
        JointRows { velocity: Some(velocity), ..JointRows::default() }
    }
}

/// The expressions η and b: the same formula with rates, and with q̇ = 0.
pub(super) fn velocity_row(a: &mut Assembly<'_>, mut eta: impl FnMut(&mut Assembly<'_>) -> ExprId) -> VelocityRow {
    let full = eta(a);
    let outer = std::mem::replace(&mut a.at_rest, true);
    let b = eta(a);
    a.at_rest = outer;
    VelocityRow { eta: full, b }
}

/// A point and a direction that rotates with its body: u = (cos ψ, sin ψ), ψ = φ_i + α.
pub(super) struct Heading {
    pub(super) p: PlacedPoint,
    /// The angle ψ.
    pub(super) psi: ExprId,
    /// The direction u.
    pub(super) u: [ExprId; 2],
}

impl Heading {
    pub(super) fn of(a: &mut Assembly<'_>, p: &Place, angle: &Formula) -> Self {
        let p = a.place(p);
        let angle = a.formula(angle);
        let psi = a.graph.add(p.angle, angle);
        let unit = [a.graph.number(1.0), a.graph.zero()];
        Self { p, psi, u: a.graph.rotate(psi, unit) }
    }

    /// The velocity ṙ_P of the point.
    pub(super) fn velocity(&self, a: &mut Assembly<'_>) -> [ExprId; 2] {
        self.p.r.map(|component| a.rate(component))
    }

    /// The row of velocity level, with the point and the direction in the body's frame as geometry.
    pub(super) fn rows(&self, a: &mut Assembly<'_>, angle: &Formula, velocity: VelocityRow) -> JointRows {
        let alpha = a.formula(angle);
        let direction = vec![a.graph.cos(alpha), a.graph.sin(alpha)];
        let geometry = vec![(Role::P, self.p.frame, self.p.local.to_vec()), (Role::Axis, self.p.frame, direction)];
        JointRows { velocity: Some(velocity), frames: [Some(self.p.frame), None], geometry, ..JointRows::default() }
    }
}

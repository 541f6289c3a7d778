//! Free-form rows of velocity level, and what all rows of that level have in common.
//!
//! Row (1), linear in the rates that `dot(…)` stands for:
//! ```text
//! η = left − right = B(q, t) q̇ + b(q, t) = 0
//! ```
//! It has no residual of position level; B is its row of Φ_q and b its entry of Φ_t. In general such a row cannot be
//! integrated: which positions can be reached is not determined by it. After Haug (1989), section 3.5.3, and Nikravesh
//! (1988), section 1.3.

use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, PlacedPoint, Rows, VelocityRow};
use crate::expr::ExprId;
use crate::mechanism::{Formula, Place, Slot, Takes};
use crate::vocabulary::Role;

joint! {
    /// Sides of an equation of velocity level.
    Nonholonomic {
        /// Left side.
        left: Formula = Slot::left(Takes::SideOfRates),
        /// Right side.
        right: Formula = Slot::right(Takes::SideOfRates),
    }
    example: "#[nonholonomic(A: dot(wheel.x) = -R*dot(wheel.phi))]"
}

impl JointType for Nonholonomic {
    const REACTION: Reaction = Reaction::Generalized;

    fn rows(&self, a: &mut Assembly<'_>) -> Rows {
        let velocity = velocity_row(a, |a| {
            let (left, right) = (a.formula(&self.left), a.formula(&self.right));
            a.graph.sub(left, right)
        });
        Rows { velocity: Some(velocity), ..Rows::default() }
    }
}

/// η and b: the same formula with rates, and with all q̇ at 0.
pub(super) fn velocity_row(a: &mut Assembly<'_>, mut eta: impl FnMut(&mut Assembly<'_>) -> ExprId) -> VelocityRow {
    let full = eta(a);
    let outer = std::mem::replace(&mut a.at_rest, true);
    let b = eta(a);
    a.at_rest = outer;
    VelocityRow { eta: full, b }
}

/// A point with a direction that turns with its body: u = (cos ψ, sin ψ), ψ = φ_i + α.
pub(super) struct Heading {
    pub(super) p: PlacedPoint,
    /// ψ.
    pub(super) psi: ExprId,
    /// u.
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

    /// ṙ_P.
    pub(super) fn velocity(&self, a: &mut Assembly<'_>) -> [ExprId; 2] {
        self.p.r.map(|component| a.rate(component))
    }

    /// The geometry of the point and its direction in the body's frame.
    pub(super) fn rows(&self, a: &mut Assembly<'_>, angle: &Formula, velocity: VelocityRow) -> Rows {
        let alpha = a.formula(angle);
        let direction = vec![a.graph.cos(alpha), a.graph.sin(alpha)];
        let geometry = vec![(Role::P, self.p.frame, self.p.local.to_vec()), (Role::Axis, self.p.frame, direction)];
        Rows { velocity: Some(velocity), frames: [Some(self.p.frame), None], geometry, ..Rows::default() }
    }
}

//! Rolling on a disc: a disc of body j, centred at Q, rolls without slipping on a disc of body i, centred at P.
//!
//! Rows (3), where d = r_Q − r_P and the scalar coordinate ψ is the direction of d in the inertial frame, in units of
//! length:
//! ```text
//! x, y:  d − (R_i + R_j)(cos ψ, sin ψ) = 0
//! roll:  R_i(φ_i − ψ) + R_j(φ_j − ψ) − e = 0
//! ```
//! The discs touch at r_P + R_i(cos ψ, sin ψ) = r_Q − R_j(cos ψ, sin ψ), for any signs. A ring inside which the other
//! disc rolls has a negative radius. ψ is a coordinate because the direction of d alone does not count whole turns.
//! The line of centres acts as a carrier with the angle ψ: the third row is that of a [`gear`](super::gear). Singular
//! for R_i + R_j = 0, where the centres coincide and ψ is arbitrary. After Nikravesh (1988), section 4.2.

use super::contact::{Contact, Normal, side};
use super::joint::{JointType, joint};
use super::rolling_on_line::WAYS;
use crate::constraint::{Assembly, JointRows, RowMeaning};
use crate::error::ModelError;
use crate::mechanism::{Dimension, Formula, Mechanism, Member, OperandSlot, OperandType, Place, Radii, Statement};
use crate::vocabulary::Role;

joint! {
    /// Operands of a disc that rolls on a disc.
    RollingOnDisc {
        /// The point P, the centre of the disc of body i.
        p: Place = OperandSlot::frame("p"),
        /// The point Q, the centre of the disc of body j.
        q: Place = OperandSlot::frame("q"),
        /// The radii R_i and R_j.
        radii: Radii = OperandSlot::option("radii", OperandType::Radii),
        /// The scalar coordinate ψ, the direction of d in the inertial frame.
        along: Member =
            OperandSlot::option("along", OperandType::Scalar("`along` names a scalar coordinate, `#[coordinates(psi)]`"))
                .measured_in(Dimension::Angle),
        /// The offset e.
        offset: Formula = OperandSlot::offset("offset", Dimension::Length).in_last_row(),
    }
    example: "#[rolling(A: ring @ (0, 0), wheel @ (0, 0), radii = (r1, r2), along = psi)]",
    choice: WAYS
}

impl JointType for RollingOnDisc {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let radii = [&self.radii.i, &self.radii.j].map(|radius| a.radius(radius));
        let offset = a.formula(&self.offset);
        let psi = a.formula(&Formula::Scalar(self.along));
        let mut rows = JointRows::between(&p, &q);
        rows.geometry.push((Role::Radius, p.frame, vec![radii[0]]));
        rows.geometry.push((Role::Radius, q.frame, vec![radii[1]]));
        rows.geometry.push((Role::Value, p.frame, vec![offset]));
        // (R_i + R_j)(cos ψ, sin ψ) is the vector (R_i + R_j, 0) rotated by ψ.
        let (sum, zero) = (a.graph.add(radii[0], radii[1]), a.graph.zero());
        if a.graph.is_zero(sum) && radii.iter().all(|radius| !a.graph.is_zero(*radius)) {
            a.degenerate(
                self.radii.origin,
                "the radii",
                "add up to 0, which puts both discs on one centre, where nothing rolls",
            );
        }
        let centres = a.graph.rotate(psi, [sum, zero]);
        let d = [0, 1].map(|k| a.graph.sub(q.r[k], p.r[k]));
        let arcs = [(radii[0], p.angle), (radii[1], q.angle)].map(|(radius, angle)| {
            let turned = a.graph.sub(angle, psi);
            a.graph.mul(radius, turned)
        });
        let rolled = a.graph.add(arcs[0], arcs[1]);
        rows.residuals = vec![
            ("x", RowMeaning::Other, a.graph.sub(d[0], centres[0])),
            ("y", RowMeaning::Other, a.graph.sub(d[1], centres[1])),
            ("roll", RowMeaning::Other, a.graph.sub(rolled, offset)),
        ];
        rows
    }

    /// The normal points from the point of contact to the centre of the second disc.
    fn contact(&self, a: &mut Assembly<'_>) -> Option<Contact> {
        let (psi, radius) = (a.formula(&Formula::Scalar(self.along)), a.formula(&self.radii.j.value));
        Some(Contact { normal: Normal::Direction(psi), side: side(&mut a.graph, radius), sticks: true })
    }

    /// Rule: the sum of literal radii is not 0, which would put both discs on one centre. A sum that is 0 for a member
    /// of a family, or after constant folding, is reported when the rows are written.
    fn check(&self, _: &Statement, _: &Mechanism, errors: &mut Vec<ModelError>) {
        if let (Some(i), Some(j)) = (self.radii.i.value.literal(), self.radii.j.value.literal())
            && i != 0.0
            && i + j == 0.0
        {
            let message = format!("radii ({i}, {j}) put both discs on one centre, where nothing rolls");
            errors.push(ModelError::new(self.radii.origin, message));
        }
    }
}

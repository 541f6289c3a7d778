//! Rack and pinion: a pinion whose axle the guide carries moves a rack along the guide.
//!
//! Row (1), with u = A_i v̂ of the guide i and φ_b of the pinion, in units of length:
//! ```text
//! u·(r_Q − r_P) − R(φ_b − φ_i) − e = 0
//! ```
//! Where the pinion turns counter-clockwise, a positive radius moves the rack along the axis: it meshes to the right of
//! the axle, looking along the axis. A rack to the left has a negative radius. A translational joint keeps the rack on
//! its guide, and a revolute joint the pinion on its axle. Never singular while R is not 0. Reports the stroke
//! u·(r_Q − r_P). After Haug (1989), section 3.3.

use super::joint::{JointType, joint};
use super::translational::along;
use crate::constraint::{Assembly, Frame, RowMeaning, Rows};
use crate::error::ModelError;
use crate::mechanism::{Axis, BodyRef, Dimension, Formula, Joint, Mechanism, Place, Slot, Takes, Value};
use crate::vectors::{Equation, NamedJoint, Piece, Symbol, Terms, equals};
use crate::vocabulary::Role;

joint! {
    /// Operands of a rack and its pinion.
    RackPinion {
        /// P of the guide, body i.
        p: Place = Slot::frame("p"),
        /// Q of the rack, body j.
        q: Place = Slot::point("q"),
        /// v in body i.
        axis: Axis = Slot::required("axis", Takes::Axis),
        /// The pinion, whose axle the guide carries.
        pinion: BodyRef = Slot::required("pinion", Takes::Body),
        /// R.
        radius: Value = Slot::required("radius", Takes::Radius),
        /// e.
        offset: Formula = Slot::offset("offset", Dimension::Length),
    }
    example: "#[rack_pinion(A: ground @ (0, 0), rack @ (0, 0), axis = (1, 0), pinion = wheel, radius = r)]"
}

impl JointType for RackPinion {
    fn rows(&self, a: &mut Assembly<'_>) -> Rows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        let axis = a.axis(&self.axis, &p);
        let (wheel, turned) = (a.frame(&self.pinion).unwrap_or(Frame::Ground), a.pose(&self.pinion)[2]);
        let (radius, offset) = (a.radius(&self.radius), a.formula(&self.offset));
        let mut rows = Rows::between(&p, &q);
        rows.geometry.push((Role::Axis, p.frame, axis.local.to_vec()));
        rows.geometry.push((Role::Radius, wheel, vec![radius]));
        rows.geometry.push((Role::Value, p.frame, vec![offset]));
        let stroke = along(a, &axis, &p, &q);
        let angle = a.graph.sub(turned, p.angle);
        let arc = a.graph.mul(radius, angle);
        let whole = a.graph.sub(stroke, arc);
        rows.residuals = vec![("", RowMeaning::Other, a.graph.sub(whole, offset))];
        rows.quantities = vec![("stroke", stroke)];
        rows
    }

    /// The guide is not the pinion, at no step of the range.
    fn check(&self, joint: &Joint, mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
        if let Some(body) = mechanism.common_member(joint.range, self.p.body, self.pinion) {
            let name = &joint.name;
            let message = format!("`{body}` is the guide of rack_pinion `{name}`, against which the pinion turns");
            errors.push(ModelError::new(self.pinion.origin(), message));
        }
    }

    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let Some(terms) = Terms::of(joint) else { return Vec::new() };
        let arc = [Piece::Op(" − "), Piece::Scalar(Symbol::plain("R").of(joint.name)), Piece::Op("Δφ")];
        let stroke = terms.along().into_iter().chain(arc).collect();
        vec![equals(stroke, terms.scalar("e")), terms.d_is_difference()]
    }
}

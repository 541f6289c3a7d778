//! A point on a curve: Q of body j lies on a curve of body i, given in polar, implicit or parametric form.

use super::{implicit, parametric, polar};
use crate::constraint::{Assembly, JointRows};
use crate::joints::contact::{Contact, Normal, side};
use crate::joints::joint::{JointType, joint};
use crate::mechanism::{Curve, OperandSlot, OperandType, Place};
use crate::vectors::{Equation, EquationPiece, Letter, NamedJoint, Terms, equals, zero};
use crate::vocabulary::JointKind;

joint! {
    /// Operands of a point on a curve.
    OnCurve as OnPolarCurve {
        /// The point P of body i, the centre of the curve.
        p: Place = OperandSlot::frame("p"),
        /// The point Q of body j.
        q: Place = OperandSlot::point("q"),
        /// The curve.
        curve: Curve = OperandSlot::option("curve", OperandType::Curve),
    }
    example: "#[on_curve(A: cam @ (0, 0), follower @ (0, 0), polar(theta) = r + e*cos(theta))]"
}

impl JointType for OnCurve {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let (p, q) = (a.place(&self.p), a.place(&self.q));
        match &self.curve {
            Curve::Polar { radius, origin } => polar::rows(a, &p, &q, radius, *origin),
            Curve::Implicit { value, .. } => implicit::rows(a, &p, &q, value),
            Curve::Parametric { parameter, x, y, roller, .. } => {
                parametric::rows(a, &p, &q, parameter, [x, y], roller.as_ref())
            }
        }
    }

    /// The normal points away from the centre of a polar curve, towards larger values of e for an implicit curve, and
    /// to the right of a parametric curve, or to the side of its roller.
    fn contact(&self, a: &mut Assembly<'_>) -> Option<Contact> {
        let Curve::Parametric { parameter, roller, .. } = &self.curve else {
            return Some(Contact::smooth(&mut a.graph, Normal::Gradient));
        };
        let right = a.graph.number(-1.0);
        let radius = roller.as_ref().map(|radius| a.formula(radius)).filter(|radius| !a.graph.is_zero(*radius));
        let side = radius.map_or(right, |radius| side(&mut a.graph, radius));
        let along = a.scalar(parameter)?;
        Some(Contact { side, ..Contact::smooth(&mut a.graph, Normal::LeftOf(along)) })
    }

    /// For a parametric curve r_Q − r_P − A_i c(u) = 0; rows of the other forms are the user's own formulas.
    fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
        let (Some(terms), JointKind::OnParametricCurve) = (Terms::of(joint), joint.kind) else { return Vec::new() };
        let c = EquationPiece::Vector(Letter::bold("c").of(joint.name));
        let curve = [EquationPiece::Op(" − "), terms.i.matrix(), c, EquationPiece::Op("(u)")];
        vec![equals(terms.difference().into_iter().chain(curve).collect(), zero())]
    }
}

//! The table of all kinds of joints.

use super::contact::Contact;
use super::joint::{JointEntry, Reaction};
use super::{
    Angle, Belt, Constraint, Distance, Driver, Fixed, FlatFollower, Gear, KnifeEdge, Nonholonomic, OnCurve,
    PointOnLine, RackPinion, RelativeAngle, Revolute, RollingOnDisc, RollingOnLine, Rope, Screw, Speed, Translational,
    X, Y,
};
use crate::constraint::{Assembly, JointRows};
use crate::error::ModelError;
use crate::mechanism::{Mechanism, Operands, Statement, StatementForm};
use crate::vectors::{Equation, NamedJoint};
use crate::vocabulary::StatementKind;

/// Every kind of joint, in the order of the guide. A new kind needs a file of its own, a variant in the
/// [vocabulary](crate::vocabulary), and an entry here; the guide's chapter on adding a constraint has all steps with the tests.
const KINDS: &[JointEntry] = &[
    JointEntry::of::<Revolute>(),
    JointEntry::of::<Translational>(),
    JointEntry::of::<Fixed>(),
    JointEntry::of::<PointOnLine>(),
    JointEntry::of::<Distance>(),
    JointEntry::of::<Rope>(),
    JointEntry::of::<X>(),
    JointEntry::of::<Y>(),
    JointEntry::of::<Angle>(),
    JointEntry::of::<RelativeAngle>(),
    JointEntry::of::<OnCurve>(),
    JointEntry::of::<FlatFollower>(),
    JointEntry::of::<Gear>(),
    JointEntry::of::<Belt>(),
    JointEntry::of::<RackPinion>(),
    JointEntry::of::<Screw>(),
    JointEntry::of::<RollingOnLine>(),
    JointEntry::of::<RollingOnDisc>(),
    JointEntry::of::<Constraint>(),
    JointEntry::of::<KnifeEdge>(),
    JointEntry::of::<Speed>(),
    JointEntry::of::<Nonholonomic>(),
    JointEntry::of::<Driver>(),
];

/// The forms of all kinds of joints, in the order of the guide; kinds with the same keyword are adjacent.
pub fn forms() -> impl Iterator<Item = &'static StatementForm> {
    KINDS.iter().map(|kind| kind.form)
}

/// The kind of joint that the operands belong to.
fn kind_of(operands: &Operands) -> Option<&'static JointEntry> {
    KINDS.iter().find(|kind| kind.form == operands.form())
}

/// The rows of a joint, from the typed struct of its kind that is made of the operands; empty if the operands are not those
/// of a joint.
pub(crate) fn rows_of(a: &mut Assembly<'_>, operands: &Operands) -> JointRows {
    kind_of(operands).map_or_else(JointRows::default, |kind| (kind.rows)(a, operands))
}

/// How the reaction of a joint acts on the bodies.
pub(crate) fn reaction_of(operands: &Operands) -> Reaction {
    kind_of(operands).map_or(Reaction::Generalized, |kind| kind.reaction)
}

/// The contact of the bodies of a joint; `None` if it holds them together in both directions.
pub(crate) fn contact_of(a: &mut Assembly<'_>, operands: &Operands) -> Option<Contact> {
    (kind_of(operands)?.contact)(a, operands)
}

/// Checks the rules that belong to the joint's kind.
pub(crate) fn check(joint: &Statement, mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    if let Some(kind) = kind_of(&joint.operands) {
        (kind.check)(joint, mechanism, errors);
    }
}

/// The equations of a joint's rows in vectors; empty if the rows are the user's own formulas.
pub(crate) fn vector_equations(joint: &NamedJoint<'_>) -> Vec<Equation> {
    let same = |kind: &&JointEntry| kind.form.kind == StatementKind::Joint(joint.kind);
    // All forms of a curve belong to one entry, which is found by its keyword.
    let written_alike = |kind: &&JointEntry| kind.form.kind.keyword() == joint.kind.keyword();
    let kind = KINDS.iter().find(same).or_else(|| KINDS.iter().find(written_alike));
    kind.map_or_else(Vec::new, |kind| (kind.vector_equations)(joint))
}

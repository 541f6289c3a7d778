//! The interface of a kind of joint: operands, rows of Φ, and optionally rules and vector equations.

use super::contact::Contact;
use crate::constraint::{Assembly, JointRows};
use crate::error::ModelError;
use crate::mechanism::{Mechanism, Operands, Statement, StatementForm, TypedOperands};
use crate::vectors::{Equation, NamedJoint};

/// How the constraint reaction of a joint acts on the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reaction {
    /// A force at the joint's point and a couple on the body of the second operand, and their opposites on the first.
    OnSecond,
    /// As `OnSecond`, by a rope, whose tension has a sign.
    Tension,
    /// Couples only, on every body whose angle appears in the rows.
    Couples,
    /// A force on the body of the second operand, and couples on the other bodies.
    OnSecondAndCouples,
    /// A generalized force conjugate to the rows, which are free equations of the user.
    Generalized,
}

/// A kind of joint.
pub(super) trait JointType: TypedOperands {
    /// How the reaction acts.
    const REACTION: Reaction = Reaction::OnSecond;

    /// The rows of Φ.
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows;

    /// The rules of this kind beyond those of its slots.
    fn check(&self, _joint: &Statement, _mechanism: &Mechanism, _errors: &mut Vec<ModelError>) {}

    /// The contact of the bodies; `None` if the joint holds them together in both directions.
    fn contact(&self, _a: &mut Assembly<'_>) -> Option<Contact> {
        None
    }

    /// The equations of the rows in vectors, as in a textbook; empty if the rows are the user's own formulas.
    fn vector_equations(_joint: &NamedJoint<'_>) -> Vec<Equation> {
        Vec::new()
    }
}

/// An entry of the table of all kinds of joints.
pub(super) struct JointEntry {
    pub(super) form: &'static StatementForm,
    pub(super) reaction: Reaction,
    pub(super) rows: fn(&mut Assembly<'_>, &Operands) -> JointRows,
    pub(super) contact: fn(&mut Assembly<'_>, &Operands) -> Option<Contact>,
    pub(super) check: fn(&Statement, &Mechanism, &mut Vec<ModelError>),
    pub(super) vector_equations: fn(&NamedJoint<'_>) -> Vec<Equation>,
}

impl JointEntry {
    pub(super) const fn of<J: JointType>() -> Self {
        Self {
            form: J::FORM,
            reaction: J::REACTION,
            rows: |a, operands| J::of(operands).map_or_else(JointRows::default, |joint| joint.rows(a)),
            contact: |a, operands| J::of(operands)?.contact(a),
            check: |joint, mechanism, errors| {
                if let Some(typed) = J::of(&joint.operands) {
                    typed.check(joint, mechanism, errors);
                }
            },
            vector_equations: J::vector_equations,
        }
    }
}

/// Declares the operands of a kind of joint: a struct with a field for every slot, and its form as a statement.
macro_rules! joint {
    (
        $(#[$meta:meta])*
        $name:ident $(as $kind:ident)? { $($fields:tt)* }
        example: $example:expr $(, choice: $choice:expr)?
    ) => {
        $crate::mechanism::operands! {
            $(#[$meta])*
            $name { $($fields)* }
            kind: $crate::vocabulary::StatementKind::Joint(joint!(@kind $name $($kind)?)),
            named: true,
            example: $example,
            choice: joint!(@choice $($choice)?)
        }
    };
    (@kind $name:ident) => { $crate::vocabulary::JointKind::$name };
    (@kind $name:ident $kind:ident) => { $crate::vocabulary::JointKind::$kind };
    (@choice) => { "" };
    (@choice $choice:expr) => { $choice };
}
pub(super) use joint;

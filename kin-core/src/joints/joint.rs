//! What every kind of joint has: operands, rows of Φ, and as far as it wants them rules and vector equations.

use super::contact::Contact;
use crate::constraint::{Assembly, Rows};
use crate::error::ModelError;
use crate::mechanism::{Joint, Mechanism, Operands, StatementForm, TypedOperands};
use crate::vectors::{Equation, NamedJoint};

/// What the rows of a joint exert on its bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reaction {
    /// A force at the joint's point and a couple, on the body of the second operand, and the opposite on the first.
    OnSecond,
    /// Couples alone, on every body that the rows turn.
    Couples,
    /// Both: a force on the body of the second operand, and couples on all others.
    OnSecondAndCouples,
    /// What is conjugate to the rows, which are the user's own.
    Generalized,
}

/// A kind of joint.
pub(super) trait JointType: TypedOperands {
    /// What its rows exert.
    const REACTION: Reaction = Reaction::OnSecond;

    /// Its rows.
    fn rows(&self, a: &mut Assembly<'_>) -> Rows;

    /// The rules that only this kind has, beyond those that every slot has.
    fn check(&self, _joint: &Joint, _mechanism: &Mechanism, _errors: &mut Vec<ModelError>) {}

    /// How its bodies touch; none where a joint holds them together.
    fn contact(&self, _a: &mut Assembly<'_>) -> Option<Contact> {
        None
    }

    /// The equations of its rows in vectors, as a textbook writes them; none where the rows are the user's own formulas.
    fn vector_equations(_joint: &NamedJoint<'_>) -> Vec<Equation> {
        Vec::new()
    }
}

/// A kind of joint as an entry of the table of all kinds.
pub(super) struct Kind {
    pub(super) form: &'static StatementForm,
    pub(super) reaction: Reaction,
    pub(super) rows: fn(&mut Assembly<'_>, &Operands) -> Rows,
    pub(super) contact: fn(&mut Assembly<'_>, &Operands) -> Option<Contact>,
    pub(super) check: fn(&Joint, &Mechanism, &mut Vec<ModelError>),
    pub(super) vector_equations: fn(&NamedJoint<'_>) -> Vec<Equation>,
}

impl Kind {
    pub(super) const fn of<J: JointType>() -> Self {
        Self {
            form: J::FORM,
            reaction: J::REACTION,
            rows: |a, operands| J::of(operands).map_or_else(Rows::default, |joint| joint.rows(a)),
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

/// Declares the operands of a kind of joint: a struct with a field for every slot, and how the joint is written.
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

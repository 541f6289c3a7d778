//! What every kind of joint has: operands, rows of Φ, and as far as it wants them rules and vector equations.

use crate::constraint::{Assembly, Rows};
use crate::error::ModelError;
use crate::mechanism::{Joint, JointForm, Mechanism, Operands};
use crate::vectors::{Equation, NamedJoint};

/// The operands of a kind of joint, as a type; the macro `joint` writes it.
pub trait JointOperands: Sized + Into<Operands> {
    /// How it is written.
    const FORM: &'static JointForm;

    /// The typed operands of a joint of this kind; none for a joint of another kind.
    fn of(operands: &Operands) -> Option<Self>;
}

/// A kind of joint.
pub(super) trait JointType: JointOperands {
    /// Its rows.
    fn rows(&self, a: &mut Assembly<'_>) -> Rows;

    /// The rules that only this kind has, beyond those that every slot has.
    fn check(&self, _joint: &Joint, _mechanism: &Mechanism, _errors: &mut Vec<ModelError>) {}

    /// The equations of its rows in vectors, as a textbook writes them; none where the rows are the user's own formulas.
    fn vector_equations(_joint: &NamedJoint<'_>) -> Vec<Equation> {
        Vec::new()
    }
}

/// A kind of joint as an entry of the table of all kinds.
pub(super) struct Kind {
    pub(super) form: &'static JointForm,
    pub(super) rows: fn(&mut Assembly<'_>, &Operands) -> Rows,
    pub(super) check: fn(&Joint, &Mechanism, &mut Vec<ModelError>),
    pub(super) vector_equations: fn(&NamedJoint<'_>) -> Vec<Equation>,
}

impl Kind {
    pub(super) const fn of<J: JointType>() -> Self {
        Self {
            form: J::FORM,
            rows: |a, operands| J::of(operands).map_or_else(Rows::default, |joint| joint.rows(a)),
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
        $name:ident $(as $kind:ident)? { $($(#[$field_meta:meta])* $field:ident: $type:ty = $slot:expr,)* }
        example: $example:expr $(, choice: $choice:expr)?
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $($(#[$field_meta])* pub $field: $type,)*
        }

        impl $crate::joints::JointOperands for $name {
            const FORM: &'static $crate::mechanism::JointForm = &$crate::mechanism::JointForm {
                kind: joint!(@kind $name $($kind)?),
                slots: &[$($slot),*],
                example: $example,
                choice: joint!(@choice $($choice)?),
            };

            fn of(operands: &$crate::mechanism::Operands) -> Option<Self> {
                if operands.form() != Self::FORM {
                    return None;
                }
                let mut places = 0..;
                Some(Self { $($field: operands.get(places.next()?)?,)* })
            }
        }

        impl From<$name> for $crate::mechanism::Operands {
            fn from(joint: $name) -> Self {
                let values = vec![$($crate::mechanism::OperandValue::into_operand(joint.$field)),*];
                Self::of_fields(<$name as $crate::joints::JointOperands>::FORM, values)
            }
        }
    };
    (@kind $name:ident) => { $crate::vocabulary::JointKind::$name };
    (@kind $name:ident $kind:ident) => { $crate::vocabulary::JointKind::$kind };
    (@choice) => { "" };
    (@choice $choice:expr) => { $choice };
}
pub(super) use joint;

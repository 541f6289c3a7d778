//! Operands as structs with a named field for each slot.

use super::{Operands, StatementForm};

/// The operands of one kind of statement as a struct, declared by the macro `operands`.
pub trait TypedOperands: Sized + Into<Operands> {
    /// The form of the statement.
    const FORM: &'static StatementForm;

    /// The typed operands of a statement of this kind; `None` for a statement of another kind.
    fn of(operands: &Operands) -> Option<Self>;
}

/// Declares the operands of a kind of statement: a struct with a field for each slot, and the form of the statement.
macro_rules! operands {
    (
        $(#[$meta:meta])*
        $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty = $slot:expr,)* }
        kind: $kind:expr, named: $named:expr, example: $example:expr, choice: $choice:expr
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $($(#[$field_meta])* pub $field: $type,)*
        }

        impl $crate::mechanism::TypedOperands for $name {
            const FORM: &'static $crate::mechanism::StatementForm = &$crate::mechanism::StatementForm {
                kind: $kind,
                named: $named,
                slots: &[$($slot),*],
                example: $example,
                choice: $choice,
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
            fn from(typed: $name) -> Self {
                let values = vec![$($crate::mechanism::OperandValue::into_operand(typed.$field)),*];
                Self::of_fields(<$name as $crate::mechanism::TypedOperands>::FORM, values)
            }
        }
    };
}
pub(crate) use operands;

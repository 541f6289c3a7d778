//! Operands as a type with named fields, one for every slot of a form.

use super::{Operands, StatementForm};

/// The operands of one kind of statement, as a type; the macro `operands` writes it.
pub trait TypedOperands: Sized + Into<Operands> {
    /// How it is written.
    const FORM: &'static StatementForm;

    /// The typed operands of a statement of this kind; none for a statement of another kind.
    fn of(operands: &Operands) -> Option<Self>;
}

/// Declares the operands of a kind of statement: a struct with a field for every slot, and how the statement is written.
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

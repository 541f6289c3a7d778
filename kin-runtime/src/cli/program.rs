//! What a mechanism needs to be a program of its own.

use crate::mechanism::Mechanism;

/// A mechanism with a default for every parameter, where its program begins; every such mechanism is one.
#[doc(hidden)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no mechanism with default parameters",
    label = "its program begins with the defaults",
    note = "a mechanism is a struct under `#[mechanism]`; every field needs a default, `#[param(0.1)]`, \
            or the struct an `impl Default` of its own"
)]
pub trait Program: Mechanism + Default {}

// The two halves of the bound say less than the message above; a derived `Default` would make every length 0.
#[diagnostic::do_not_recommend]
impl<M: Mechanism + Default> Program for M {}

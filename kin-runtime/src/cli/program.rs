//! The trait bound for mechanisms that have a command-line program.

use crate::mechanism::Mechanism;

/// A mechanism with a default for every parameter, with which its program starts. Every such mechanism implements it.
#[doc(hidden)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanism, or one of its parameters has no default",
    label = "its program begins with the defaults",
    note = "a mechanism is a struct under `#[mechanism]`; every field needs a default, `#[param(0.1)]`, \
            or the struct an `impl Default` of its own"
)]
pub trait Program: Mechanism + Default {}

// The compiler would otherwise name only one half of the bound, or suggest deriving `Default`, which sets every length
// to 0.
#[diagnostic::do_not_recommend]
impl<M: Mechanism + Default> Program for M {}

//! The table of all kinds of masses and loads.

use super::free_bodies::FreeBodies;
use super::load::{Acting, LoadEntry};
use super::{Force, Gravity, Mass, Spring, Torque, TorsionSpring};
use crate::mechanism::{Operands, StatementForm};

/// Every kind of mass or load, in the order of the guide. A new kind needs a file of its own, a variant in the
/// [vocabulary](crate::vocabulary), and an entry here.
const KINDS: &[LoadEntry] = &[
    LoadEntry::of::<Gravity>(),
    LoadEntry::of::<Mass>(),
    LoadEntry::of::<Force>(),
    LoadEntry::of::<Torque>(),
    LoadEntry::of::<Spring>(),
    LoadEntry::of::<TorsionSpring>(),
];

/// The forms of all kinds of masses and loads, in the order of the guide.
pub fn forms() -> impl Iterator<Item = &'static StatementForm> {
    KINDS.iter().map(|kind| kind.form)
}

/// The action of a mass or a load; `None` for other statements.
pub(super) fn acts(bodies: &mut FreeBodies<'_>, operands: &Operands) -> Option<Acting> {
    let kind = KINDS.iter().find(|kind| kind.form == operands.form())?;
    (kind.acts)(bodies, operands)
}

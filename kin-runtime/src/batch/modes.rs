//! The assembly modes of the configurations of a batch.

use super::column::{Column, check_list};
use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::compare::Compare;
use crate::scalar::lanes::Octet;
use crate::signal::Instant;

/// The assembly modes of a batch. A configuration with an undecided mode has no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Modes<'a> {
    /// A column of signs, +1 or −1, for every mode of the plan, in the order of
    /// [`Plan::modes`](crate::plan::Plan::modes). Of any other number only the sign is used; 0 and NaN leave the
    /// mode undecided.
    Signs(&'a [Column<'a>]),
    /// The modes of the start, by [`Mechanism::branches_with`] at the parameters and the instant of the configuration.
    /// As for [`Planned`](crate::Planned), a branch value of 0 or NaN leaves the mode undecided.
    OfStart,
}

impl<'a> Modes<'a> {
    /// The columns of signs, if they are given.
    pub(super) fn columns(&self) -> &'a [Column<'a>] {
        match self {
            Self::Signs(columns) => columns,
            Self::OfStart => &[],
        }
    }

    pub(super) fn check<M: Mechanism>(&self, count: usize) -> Result<(), LengthError> {
        match self {
            Self::Signs(columns) => check_list("modes", M::model().plan.modes.len(), columns, count),
            Self::OfStart => Ok(()),
        }
    }

    /// Writes the signs for a block; `given` are the numbers of the block in the columns of signs, if there are such.
    /// `modes` has room for all signs of the plan.
    #[inline(always)]
    pub(super) fn of_block<M: Mechanism>(
        &self,
        mechanism: &M,
        parameters: &[Octet],
        at: &Instant<'_, Octet>,
        start: &[Octet],
        given: &[Octet],
        modes: &mut [Octet],
    ) {
        // NaN instead of 0, so that all results that depend on it are NaN, too.
        match self {
            Self::Signs(_) => {
                for (index, mode) in modes.iter_mut().enumerate() {
                    *mode = given.get(index).copied().unwrap_or_default().direction();
                }
            }
            Self::OfStart => {
                let lengths = mechanism.branches_with(parameters, at, start, modes);
                debug_assert!(lengths.is_ok(), "the columns have been counted");
                modes.iter_mut().for_each(|mode| *mode = mode.direction());
            }
        }
    }
}

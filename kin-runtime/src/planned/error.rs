//! Errors of a solution by the plan.

use super::group_limit::Limit;
use crate::mechanism::LengthError;
use crate::model::Model;
use crate::plan::ModeInfo;
use crate::text::{entry, rounded};
use core::fmt;

/// Why the plan has no solution at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PlanError {
    /// The mechanism has no plan.
    NoPlan {
        /// The reason.
        why: &'static str,
    },
    /// A group is at its limit or cannot close.
    Limit {
        /// Time.
        t: f64,
        /// The group and its margin.
        limit: Limit,
    },
    /// A step with a unique solution is singular here, or an iteration does not converge. The mechanism itself may be
    /// regular; then full Newton finds the solution.
    Singular {
        /// Time.
        t: f64,
        /// The step and its margin.
        limit: Limit,
    },
    /// Redundant rows contradict the rows that the plan uses: with these parameters and modes there is no
    /// configuration, or no velocity or acceleration.
    Contradiction {
        /// Time.
        t: f64,
        /// The rows and their contradiction, see [`Limit::contradiction`].
        limit: Limit,
    },
    /// The configuration that should determine the modes does not determine this one: its branch value
    /// ([`Mechanism::branches_with`](crate::Mechanism::branches_with)) is 0 or NaN there.
    Undecided {
        /// Time.
        t: f64,
        /// The name of the mode.
        mode: &'static str,
    },
    /// The iteration of a group leads from the start to another closure than that of the start, or more than half a turn
    /// away from it.
    OtherClosure {
        /// Time.
        t: f64,
        /// The name of the group.
        group: &'static str,
    },
    /// A length that a joint prescribes is negative: that of a link, a cylinder or a driver of a distance.
    NegativeLength {
        /// Time.
        t: f64,
        /// The joint.
        joint: &'static str,
        /// The length.
        length: f64,
    },
    /// The motion jumps: a row or an input changes instantaneously, so that no step is short enough.
    Jump {
        /// Time of the last state before the jump.
        t: f64,
        /// The instant requested.
        t_refused: f64,
    },
    /// More steps than allowed are needed on the way to an instant.
    TooManySteps {
        /// The time reached.
        t: f64,
        /// The instant requested.
        t_refused: f64,
    },
    /// Rounding errors dominate a coordinate or its rates, because the rows that determine it are nearly dependent there,
    /// or their slopes change too fast.
    Rounded {
        /// Time.
        t: f64,
        /// The name of the coordinate.
        coordinate: &'static str,
    },
    /// Two points coincide whose distance is in a row, as neighbouring points of a rope: the distance has no direction
    /// there, so that the row has no gradient.
    Coincident {
        /// Time.
        t: f64,
        /// The joint of the row.
        joint: &'static str,
    },
    /// NaN or infinity in an argument, a parameter or a result.
    NonFinite {
        /// The list: `q`, `t`, `parameters`, `inputs`, `margins`, ….
        what: &'static str,
        /// Index in the list.
        index: usize,
        /// Name of the coordinate, parameter or input.
        name: &'static str,
        /// Time.
        t: f64,
    },
    /// An argument of the wrong length.
    Length(LengthError),
    /// There is no mode with this name or index.
    UnknownMode {
        /// The modes of the mechanism.
        modes: &'static [ModeInfo],
    },
}

impl PlanError {
    /// The error for a negative length, given its index among the lengths that joints prescribe.
    #[cold]
    pub(super) fn negative_length(model: &Model, t: f64, index: usize, length: f64) -> Self {
        let joint = model.joints.iter().filter(|joint| joint.keeps_distance()).nth(index);
        Self::NegativeLength { t, joint: joint.map_or("", |joint| joint.name), length }
    }

    /// The error for a coordinate that rounding errors dominate, given its index.
    #[cold]
    pub(super) fn rounded(model: &Model, t: f64, k: usize) -> Self {
        Self::Rounded { t, coordinate: model.coordinates.get(k).map_or("", |coordinate| coordinate.name) }
    }

    /// The error for a row in which two points coincide, given its index.
    #[cold]
    pub(super) fn coincident(model: &Model, t: f64, row: usize) -> Self {
        let joint = model.rows.get(row).and_then(|row| model.joints.get(row.joint));
        Self::Coincident { t, joint: joint.map_or("", |joint| joint.name) }
    }

    /// The step that has no solution, with its margin.
    pub const fn limit(&self) -> Option<&Limit> {
        match self {
            Self::Limit { limit, .. } | Self::Singular { limit, .. } | Self::Contradiction { limit, .. } => Some(limit),
            _ => None,
        }
    }
}

impl From<LengthError> for PlanError {
    fn from(error: LengthError) -> Self {
        Self::Length(error)
    }
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPlan { why } => write!(f, "no plan because {why}"),
            Self::Limit { t, limit } => {
                write_at(f, *t, limit)?;
                // Finding the input that is the cause takes longer than a cycle of a controller, so the message names
                // the method.
                let hint =
                    if limit.step.has_inputs() { "; `Planned::out_of_range` says what its inputs can be" } else { "" };
                f.write_str(hint)
            }
            Self::Singular { t, limit } | Self::Contradiction { t, limit } => write_at(f, *t, limit),
            Self::Undecided { t, mode } => {
                write!(
                    f,
                    "at t = {t}, the start does not determine the mode {mode}: its two closures coincide there, or a number is NaN",
                    t = rounded(*t)
                )
            }
            Self::OtherClosure { t, group } => {
                write!(
                    f,
                    "at t = {t}, the iteration of {group} leads to another closure than that of the start; begin at a \
                     solved state, as `Solver::planned` does",
                    t = rounded(*t)
                )
            }
            Self::NegativeLength { t, joint, length } => {
                write!(
                    f,
                    "at t = {t}, the length of `{joint}` is {length}: a length must not be negative",
                    t = rounded(*t)
                )
            }
            Self::Jump { t, t_refused } => write!(
                f,
                "the motion jumps just after t = {t}, on the way to t = {t_refused}",
                t = rounded(*t),
                t_refused = rounded(*t_refused)
            ),
            Self::TooManySteps { t, t_refused } => {
                write!(
                    f,
                    "too many internal steps on the way from t = {t} to t = {t_refused}; add instants in between",
                    t = rounded(*t),
                    t_refused = rounded(*t_refused)
                )
            }
            Self::Rounded { t, coordinate } => write!(
                f,
                "at t = {t}, rounding errors dominate the rates of `{coordinate}`, because its rows are nearly dependent \
                 there or their slopes change too fast",
                t = rounded(*t)
            ),
            Self::Coincident { t, joint } => write!(
                f,
                "at t = {t}, two points of `{joint}` coincide, so that their distance has no direction",
                t = rounded(*t)
            ),
            Self::NonFinite { what: "margins", t, .. } => write!(
                f,
                "at t = {t} the plan has no solution: a dimension, or a difference of dimensions, by which it divides \
                 is 0",
                t = rounded(*t)
            ),
            Self::NonFinite { what: "Φ", name, t, .. } => {
                write!(f, "the row `{name}` is not defined beyond t = {t}", t = rounded(*t))
            }
            Self::NonFinite { what, index, name, t } => {
                entry(f, what, *index, name)?;
                write!(f, " is not a finite number at t = {t}", t = rounded(*t))
            }
            Self::Length(error) => error.fmt(f),
            Self::UnknownMode { modes } => {
                f.write_str("no such mode")?;
                for (k, mode) in modes.iter().enumerate() {
                    write!(f, "{}`{}`", if k == 0 { "; there are " } else { ", " }, mode.name)?;
                }
                Ok(())
            }
        }
    }
}

/// A limit with the instant that cannot be reached.
fn write_at(f: &mut fmt::Formatter<'_>, t: f64, limit: &Limit) -> fmt::Result {
    let is_elsewhere = limit.locks_at().is_some_and(|at| (at - t).abs() > 1e-9 * t.abs());
    match is_elsewhere {
        true => write!(f, "cannot reach t = {}: {limit}", rounded(t)),
        false => write!(f, "at t = {}, {limit}", rounded(t)),
    }
}

/// The message is complete without the source, which exists only for a [`LengthError`], to make its type available.
impl core::error::Error for PlanError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        if let Self::Length(error) = self { Some(error) } else { None }
    }
}

//! Errors of a solution by the plan.

use super::step::Step;
use crate::mechanism::LengthError;
use crate::model::Model;
use crate::plan::{ModeInfo, Plan};
use crate::text::{entry, rounded};
use core::fmt;

/// A group of a plan that is at or near its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Limit {
    /// The group, with the names of its joints.
    #[doc(hidden)]
    pub step: Step,
    /// The margin of the group: 0 at the limit, negative where it cannot close. For a closure a cos φ + b sin φ = c it
    /// is 1 − c²/(a² + b²), any negative number far beyond the limit.
    pub margin: f64,
    /// The location of the limit itself, where the motion was followed up to it.
    #[doc(hidden)]
    pub located: Option<Located>,
}

/// The location of a limit.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Located {
    /// The time, accurate to rounding.
    pub at: f64,
    /// The kind of limit, where it is known.
    pub kind: Option<LimitKind>,
}

/// The kind of limit that ends the motion of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum LimitKind {
    /// Both closures meet, and beyond the limit the group does not close: the motion could only turn back.
    DeadCentre,
    /// Both closures meet, and beyond the limit there are two closures again: two branches of the motion cross, and it
    /// is not determined which of them continues the motion.
    BranchPoint,
    /// The linear system of the group is singular, and its solution goes to infinity, as the pin in two slots that become
    /// parallel. Beyond, the solution would come back from the other side.
    Pole,
}

/// For example `dead centre`.
impl fmt::Display for LimitKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DeadCentre => "dead centre",
            Self::BranchPoint => "branch point",
            Self::Pole => "solution at infinity",
        })
    }
}

/// For example `t = 1.0947 (dead centre)`.
impl fmt::Display for Located {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "t = {}", rounded(self.at))?;
        self.kind.map_or(Ok(()), |kind| write!(f, " ({kind})"))
    }
}

impl Limit {
    /// A limit that has not been located.
    pub(crate) const fn new(step: Step, margin: f64) -> Self {
        Self { step, margin, located: None }
    }

    /// The names of the joints of the group: those of a dyad from one end to the other, others in
    /// order of declaration.
    pub fn joints(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.step.joints()
    }

    /// The names of the bodies that the group places, in order of declaration.
    pub fn bodies(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.step.bodies()
    }

    /// The drivers whose range the limit ends: those among the group's joints or, where there are none, all drivers of
    /// the bodies to which the group is attached. Empty where these cannot be determined, in mechanisms of more than
    /// 1024 coordinates.
    pub fn drivers(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.step.drivers()
    }

    /// The time of the limit itself, where the motion was followed up to it.
    pub const fn at(&self) -> Option<f64> {
        match self.located {
            Some(located) => Some(located.at),
            None => None,
        }
    }

    /// The time at which a group locks: that of the limit, unless it is the limit of a divisor.
    pub(crate) fn locks_at(&self) -> Option<f64> {
        self.at().filter(|_| self.step.closes() || self.step.is_iterated() || self.kind().is_some())
    }

    /// The kind of limit, where it is known.
    pub const fn kind(&self) -> Option<LimitKind> {
        match self.located {
            Some(located) => located.kind,
            None => None,
        }
    }

    /// The amount by which redundant rows contradict the others, relative to the size of the mechanism or of its
    /// motion; `None` where the step is of another kind. It is [`Plan::CONSISTENCY`] √(1 − margin), which far from
    /// limits of other steps is the largest residual of a row.
    pub fn contradiction(&self) -> Option<f64> {
        let square = 1.0 - self.margin;
        if !self.step.checks_redundant_rows() || !square.is_finite() {
            return None;
        }
        Some(Plan::CONSISTENCY * crate::scalar::Scalar::sqrt(square.max(0.0)))
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step, margin, .. } = self;
        if let Some(miss) = self.contradiction() {
            return write!(f, "{step} violated by {miss:.1e}, relative to the size of the mechanism or of its motion");
        }
        let Some(at) = self.locks_at() else {
            let singular = step.info().singular;
            return match (step.closes(), *margin < 0.0) {
                (true, true) => write!(f, "{step} cannot close"),
                (true, false) => write!(f, "{step} is at its limit: {singular}"),
                (false, _) => write!(f, "{step} is singular: {singular}"),
            };
        };
        let bodies = step.bodies().count();
        listed(f, step.bodies())?;
        f.write_str(if bodies > 0 { " of " } else { "" })?;
        let verb = match (self.kind(), bodies > 1) {
            (Some(LimitKind::Pole), true) => "go to infinity",
            (Some(LimitKind::Pole), false) => "goes to infinity",
            (_, true) => "lock",
            (_, false) => "locks",
        };
        write!(f, "{step} {verb} at t = {}", rounded(at))?;
        // The words for a closure are those of its dead centres, those for an iteration of all singular places.
        if self.kind() != Some(LimitKind::Pole) || step.info().is_linear() {
            write!(f, ": {}", step.info().singular)?;
        }
        f.write_str(" (")?;
        match self.kind() {
            Some(kind) => write!(f, "{kind})")?,
            None => f.write_str("dead centre or branch point)")?,
        }
        // Only at a dead centre does the motion end because a driver has reached the end of its range.
        if self.kind() != Some(LimitKind::DeadCentre) {
            return Ok(());
        }
        match step.drivers().count() {
            0 => Ok(()),
            1 => {
                f.write_str(", the driver ")?;
                listed(f, step.drivers())?;
                f.write_str(" is at the end of its range")
            }
            _ => {
                f.write_str(", the drivers ")?;
                listed(f, step.drivers())?;
                f.write_str(" are at the end of their common range")
            }
        }
    }
}

/// For example `A, B and C`.
fn listed(f: &mut fmt::Formatter<'_>, names: impl Iterator<Item = &'static str>) -> fmt::Result {
    let mut names = names.enumerate().peekable();
    while let Some((k, name)) = names.next() {
        f.write_str(match (k, names.peek()) {
            (0, _) => "",
            (_, None) => " and ",
            (_, Some(_)) => ", ",
        })?;
        f.write_str(name)?;
    }
    Ok(())
}

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
    /// Rounding errors dominate a coordinate or its rates, because the slopes of the rows that determine it change too
    /// fast there.
    Rounded {
        /// Time.
        t: f64,
        /// The name of the coordinate.
        coordinate: &'static str,
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
                "at t = {t}, rounding errors dominate the rates of `{coordinate}`, because the slopes of its rows change \
                 too fast there",
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

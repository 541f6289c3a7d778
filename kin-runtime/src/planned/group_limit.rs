//! A group of a plan at or near its limit, in numbers and in words.

use super::step::Step;
use crate::plan::Plan;
use crate::text::rounded;
use core::fmt;

/// A group of a plan that is at or near its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Limit {
    /// The group, with the names of its joints.
    #[doc(hidden)]
    pub step: Step,
    /// The margin of the group: 0 at the limit, negative where it cannot close. For a closure a cos φ + b sin φ = c it
    /// is 1 − c²/(a² + b²), which has no lower bound far beyond the limit.
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
    /// The time, accurate to rounding; of a group that is solved by iteration, to the smallest step
    /// ([`Options::min_step`](crate::Options::min_step)).
    pub at: f64,
    /// The kind of limit, where it is known.
    pub kind: Option<LimitKind>,
}

/// The kind of limit that ends the motion of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// As it prints.
#[cfg(feature = "serde")]
impl serde::Serialize for LimitKind {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
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
            return match (step.closes(), *margin < -Plan::SMALLEST_MARGIN) {
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

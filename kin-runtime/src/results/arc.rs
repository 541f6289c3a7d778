//! What a sweep along the arc of the solution curve finds.

use crate::text::{rounded, separated};
use core::fmt;

/// A special place on the curve of all solutions (q, t).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ArcPlaceKind {
    /// t is greatest or least: the driver can go no further and turns back, while the mechanism moves on into another
    /// assembly mode.
    DeadCentre,
    /// Branches of the motion cross. The curve ends there, because nothing determines which of them to follow.
    BranchPoint,
    /// The path of a named point has a cusp: the point comes to rest and goes on in the opposite direction, on another
    /// path than the one it came by. The ends of a path on which the point moves to and fro are no cusps.
    Cusp {
        /// The named point.
        point: &'static str,
    },
}

/// `dead centre`, `branch point`, `cusp of tip`.
impl fmt::Display for ArcPlaceKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadCentre => f.write_str("dead centre"),
            Self::BranchPoint => f.write_str("branch point"),
            Self::Cusp { point } => write!(f, "cusp of {point}"),
        }
    }
}

/// A special place that a sweep along the arc came to.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ArcPlace {
    /// What it is.
    pub kind: ArcPlaceKind,
    /// Time there.
    pub t: f64,
    /// The length of the arc from the first state to it, as [`SolutionArc::length`].
    pub s: f64,
    /// The length of the piece of the arc in which the place was enclosed.
    pub within: f64,
    /// q there, n numbers.
    pub q: Vec<f64>,
    /// The joints of the group that is singular there; without a plan those whose rows depend on one another. Empty for a
    /// cusp.
    pub joints: Vec<&'static str>,
    /// The drivers that turn back, if the plan determines them.
    pub drivers: Vec<&'static str>,
}

/// `dead centre of A, B, C at t = 1.0948`.
impl fmt::Display for ArcPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)?;
        if !self.joints.is_empty() {
            f.write_str(" of ")?;
            separated(f, &self.joints, |f, joint| f.write_str(joint))?;
        }
        write!(f, " at t = {}", rounded(self.t))
    }
}

/// Why a sweep along the arc ended in one of its two directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ArcEnd {
    /// The mechanism is back where it began, up to whole turns of bodies: the states cover the whole curve.
    Closed,
    /// t left the requested interval.
    Bound,
    /// Branches of the motion cross there.
    #[cfg_attr(feature = "serde", serde(rename = "branch point"))]
    BranchPoint,
    /// No step, however short, leads further: a formula is not defined beyond, or a contact ends.
    Ended,
    /// The curve did not close within the largest number of steps.
    #[cfg_attr(feature = "serde", serde(rename = "too long"))]
    TooLong,
}

/// `the curve is closed`, `t leaves the interval`, …
impl fmt::Display for ArcEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Closed => "the curve is closed",
            Self::Bound => "t leaves the interval",
            Self::BranchPoint => "branches of the motion cross",
            Self::Ended => "the curve goes no further",
            Self::TooLong => "the curve did not close within the steps that are taken",
        })
    }
}

/// The result of a sweep along the arc, apart from its states.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SolutionArc {
    /// The length of the arc from the first state to the last: the Euclidean norm of all displacements on the common
    /// scale of angles and lengths (see [`Options`](crate::Options)) and of t, whose unit is the time in which a driver
    /// moves by about one unit. The states are at equal distances along the arc.
    pub length: f64,
    /// Dead centres, branch points and cusps in the order in which the arc has them.
    pub places: Vec<ArcPlace>,
    /// Why it ends at its first state and at its last.
    pub ends: [ArcEnd; 2],
}

impl SolutionArc {
    /// True where the states are the whole curve, which comes back to where it begins.
    pub fn is_closed(&self) -> bool {
        self.ends == [ArcEnd::Closed; 2]
    }
}

/// `length 12.566, the curve is closed; dead centre of A, B, C at t = 1.0948`.
impl fmt::Display for SolutionArc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, last] = self.ends;
        write!(f, "length {}, {last}", rounded(self.length))?;
        if first != last {
            write!(f, ", and at its beginning {first}")?;
        }
        self.places.iter().try_for_each(|place| write!(f, "; {place}"))
    }
}

/// Why there is no single curve through a configuration that could be followed along its arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ArcFault {
    /// Rows of velocity level make the position depend on the motion so far.
    VelocityLevel,
    /// The drivers leave degrees of freedom open, or branches cross: the motion can begin in several independent
    /// directions.
    Directions {
        /// How many.
        count: usize,
    },
    /// Nothing can move: no change of t and q together satisfies all rows.
    Fixed,
}

impl fmt::Display for ArcFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::VelocityLevel => f.write_str("with nonholonomic rows the position depends on the preceding motion"),
            Self::Directions { count } => write!(
                f,
                "the motion can begin in {count} independent directions: drivers leave it open, or branches cross there"
            ),
            Self::Fixed => f.write_str("no change of t and q together satisfies all rows"),
        }
    }
}

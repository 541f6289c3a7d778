//! What a certificate says, and why there is none.

use crate::scalar::Interval;
use crate::text::{number, separated};
use core::fmt;

/// A proof that the equations of a mechanism have a solution at an instant, with where it is.
///
/// It is about the equations as they are compiled, at the parameters, the instant and the inputs as they are in `f64`: within
/// [`unique`](Self::unique) there is exactly one q with Φ(q, t) = 0, and its coordinates, rates and accelerations lie in `q`,
/// `q_dot` and `q_ddot`. Rounding is part of the proof. Other solutions may exist outside of `unique`, among them those in
/// other assembly modes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certificate {
    /// An interval for every coordinate, in its unit.
    pub q: Vec<Interval>,
    /// An interval for every rate.
    pub q_dot: Vec<Interval>,
    /// An interval for every acceleration.
    pub q_ddot: Vec<Interval>,
    /// The box in which there is no other solution.
    pub unique: Vec<Interval>,
    /// Redundant rows that the proof leaves out, by name. The solution is that of all others; that it satisfies these, too,
    /// holds to rounding, as any solution of redundant rows.
    pub left_out: Vec<&'static str>,
}

impl Certificate {
    /// The largest radius of an interval of `q`: how well the solution is known at least, lengths and radians alike.
    pub fn radius(&self) -> f64 {
        self.q.iter().fold(0.0, |most, x| x.radius().max(most))
    }

    /// The smallest radius of an interval of [`unique`](Self::unique): how far other solutions are away at least, in one of
    /// their coordinates; infinite without coordinates.
    pub fn isolation(&self) -> f64 {
        self.unique.iter().fold(f64::INFINITY, |least, x| x.radius().min(least))
    }

    /// True where a configuration lies in the box of which the certificate says that it has one solution.
    pub fn covers(&self, q: &[f64]) -> bool {
        q.len() == self.unique.len() && self.unique.iter().zip(q).all(|(interval, &x)| interval.contains(x))
    }
}

/// `one solution within 1.2e-16, no other within 1e-6`.
impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "one solution, known within {:.1e}, no other within {:.1e}", self.radius(), self.isolation())?;
        if !self.left_out.is_empty() {
            f.write_str("; redundant and left out: ")?;
            separated(f, &self.left_out, |f, row| f.write_str(row))?;
        }
        Ok(())
    }
}

/// Why a state has no certificate.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Uncertified {
    /// Degrees of freedom are open: the solutions are curves, and no single one is alone.
    Open {
        /// How many.
        degrees_of_freedom: usize,
    },
    /// Rows of velocity level leave the position to the motion.
    VelocityLevel,
    /// A row has no enclosure: it uses a supplied function at an argument that is rounded, or is not defined or not
    /// continuous all around the configuration.
    Unbounded {
        /// The row.
        row: &'static str,
    },
    /// Φ_q is singular or nearly so, so that solutions that meet or are nearly one cannot be told apart.
    Singular {
        /// 1 / κ of Φ_q with rows scaled to size 1 and lengths to that of the mechanism, κ in the maximum norm: 0 where it
        /// is singular, and certificates need more than about the root of the rounding errors.
        nearness: f64,
    },
    /// The state is no solution: Newton's correction is larger than what rounding leaves.
    NotASolution {
        /// What is wrong: `q`, `q̇` or `q̈`.
        what: &'static str,
        /// The coordinate that is off most.
        coordinate: &'static str,
        /// By how much, in its unit.
        by: f64,
    },
    /// A group of the plan closes by iteration, so that it cannot be enclosed along t. A sweep along the arc
    /// ([`Solver::sweep_along_arc`](crate::Solver::sweep_along_arc)) finds the dead centres of one motion.
    NoClosedForm {
        /// The joints of the first such group.
        joints: Vec<&'static str>,
    },
    /// There is no plan to enclose.
    NoPlan {
        /// The reason.
        why: &'static str,
    },
    /// There are too many assembly modes to go through all of their combinations.
    TooManyModes {
        /// How many there are.
        modes: usize,
        /// The most whose combinations are gone through.
        most: usize,
    },
    /// NaN or infinity in the state, or lists of other lengths than the mechanism has.
    Malformed,
}

impl fmt::Display for Uncertified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open { degrees_of_freedom: 1 } => {
                f.write_str("a degree of freedom is open, so that no solution is alone")
            }
            Self::Open { degrees_of_freedom } => {
                write!(f, "{degrees_of_freedom} degrees of freedom are open, so that no solution is alone")
            }
            Self::VelocityLevel => f.write_str("rows of velocity level do not determine the position"),
            Self::Unbounded { row } => write!(
                f,
                "row {row} has no enclosure: it uses a supplied function, or is not continuous around the configuration"
            ),
            Self::Singular { nearness } if *nearness == 0.0 => f.write_str("Φ_q is singular"),
            Self::Singular { nearness } => {
                write!(f, "Φ_q is nearly singular: its inverse condition number is {nearness:.1e}")
            }
            Self::NotASolution { what, coordinate, by } => {
                write!(f, "{what} is no solution: {coordinate} is off by ")?;
                number(f, by)
            }
            Self::NoClosedForm { joints } => {
                f.write_str("the group of ")?;
                separated(f, joints, |f, joint| f.write_str(joint))?;
                f.write_str(
                    " closes by iteration, which has no enclosure along t; a sweep along the arc finds the dead centres of \
                     one motion",
                )
            }
            Self::NoPlan { why } => write!(f, "there is no plan, because {why}"),
            Self::TooManyModes { modes, most } => {
                write!(f, "there are {modes} assembly modes, and the combinations of at most {most} are gone through")
            }
            Self::Malformed => f.write_str("numbers of the state are not finite, or too few or too many"),
        }
    }
}

impl core::error::Error for Uncertified {}

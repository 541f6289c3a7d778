//! Certificates of solutions, and the reasons why a state has none.

use crate::scalar::Interval;
use crate::text::{number, separated};
use core::fmt;

/// A proof that the equations of a mechanism have a solution at an instant, with bounds for it.
///
/// The proof is for the compiled equations, with parameters, time and inputs as exactly the numbers that `f64` holds:
/// within [`unique`](Self::unique) there is exactly one q with Φ(q, t) = 0, and its coordinates, rates and
/// accelerations lie in `q`, `q_dot` and `q_ddot`. The certificate of an [`Assembly`](crate::Assembly) is for its
/// position alone. The proof accounts for all rounding. Other solutions may exist outside of `unique`, for example in
/// other assembly modes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certificate {
    /// An interval for every coordinate, in its unit.
    pub q: Vec<Interval>,
    /// An interval for every rate; empty where the position alone was to be proven.
    pub q_dot: Vec<Interval>,
    /// An interval for every acceleration; empty where the position alone was to be proven.
    pub q_ddot: Vec<Interval>,
    /// The box in which there is no other solution.
    pub unique: Vec<Interval>,
    /// The names of redundant rows that the proof leaves out. The certified solution is that of the other rows; these it
    /// satisfies approximately, as any solution of redundant rows does: to 1e-9 of the size of the mechanism.
    pub left_out: Vec<&'static str>,
}

impl Certificate {
    /// The largest radius of the intervals of `q`: a bound on the error of every coordinate, in its own unit.
    pub fn radius(&self) -> f64 {
        self.q.iter().fold(0.0, |most, x| x.radius().max(most))
    }

    /// The smallest radius of the intervals of [`unique`](Self::unique): any other solution differs by more than this
    /// in at least one coordinate. Infinite without coordinates.
    pub fn isolation(&self) -> f64 {
        self.unique.iter().fold(f64::INFINITY, |least, x| x.radius().min(least))
    }

    /// True if a configuration lies in the box [`unique`](Self::unique).
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

/// With an inverse condition number of Φ_q below this, a large correction is reported as a singular configuration; from it
/// on, rounding errors are what prevents a certificate.
pub(crate) const SINGULAR_CONDITION: f64 = 1e-6;

/// Why a state has no certificate.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Uncertified {
    /// Degrees of freedom are open: the solutions form curves or surfaces, and none of them is isolated.
    Open {
        /// How many.
        degrees_of_freedom: usize,
    },
    /// Rows of velocity level make the position depend on the motion so far.
    VelocityLevel,
    /// A row has no enclosure: it uses a supplied function at an argument that is rounded, or it is undefined or
    /// discontinuous somewhere near the configuration.
    Unbounded {
        /// The row.
        row: &'static str,
    },
    /// Φ_q is singular or nearly so, or rounding errors are large, as those of an angle of a million radians: solutions that
    /// coincide or nearly coincide cannot be separated.
    Singular {
        /// 1 / κ of Φ_q, with rows scaled to size 1 and lengths to the size of the mechanism, κ in the maximum norm: 0
        /// if Φ_q is singular. A certificate needs more than about the square root of the rounding errors.
        nearness: f64,
    },
    /// The state is no solution: Newton's correction is larger than rounding errors explain.
    NotASolution {
        /// The vector that is wrong: `q`, `q̇` or `q̈`.
        what: &'static str,
        /// The coordinate with the largest error.
        coordinate: &'static str,
        /// Its error, in its unit.
        by: f64,
    },
    /// The state is no solution: the solution of the other rows that is next to it does not satisfy a redundant row.
    Violated {
        /// The row.
        row: &'static str,
        /// Its residual, in the unit of Φ.
        by: f64,
    },
    /// The plan leaves out a redundant row, which holds only for some dimensions and modes. No enclosure along t can prove
    /// that it holds.
    Redundant {
        /// The first such row.
        row: &'static str,
    },
    /// Coordinates are prescribed at one instant, and their values at any other t are unknown.
    Prescribed,
    /// There are too many assembly modes to examine all of their combinations.
    TooManyModes {
        /// How many there are.
        modes: usize,
        /// The largest number whose combinations are examined.
        most: usize,
    },
    /// NaN or infinity in the state, or lists of wrong lengths.
    Malformed,
}

impl fmt::Display for Uncertified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open { degrees_of_freedom: 1 } => {
                f.write_str("a degree of freedom is open, so that no solution is isolated")
            }
            Self::Open { degrees_of_freedom } => {
                write!(f, "{degrees_of_freedom} degrees of freedom are open, so that no solution is isolated")
            }
            Self::VelocityLevel => f.write_str("rows of velocity level do not determine the position"),
            Self::Unbounded { row } => write!(
                f,
                "row {row} has no enclosure: it uses a supplied function, or is not continuous around the configuration"
            ),
            Self::Singular { nearness } if *nearness == 0.0 => f.write_str("Φ_q is singular"),
            Self::Singular { nearness } if *nearness < SINGULAR_CONDITION => {
                write!(f, "Φ_q is nearly singular: its inverse condition number is {nearness:.1e}")
            }
            Self::Singular { nearness } => write!(
                f,
                "rounding errors, as those of large angles, are too large beside the inverse condition number of Φ_q, \
                 {nearness:.1e}"
            ),
            Self::NotASolution { what, coordinate, by } => {
                write!(f, "{what} is no solution: {coordinate} is off by ")?;
                number(f, by)
            }
            Self::Violated { row, by } => {
                write!(f, "q is no solution: the redundant row {row} is off by ")?;
                number(f, by)
            }
            Self::Redundant { row } => write!(
                f,
                "row {row} is redundant, and it cannot be proven along t that it holds; `sweep` checks it at every instant"
            ),
            Self::Prescribed => f.write_str("coordinates are prescribed, and their values at other t are unknown"),
            Self::TooManyModes { modes, most } => {
                write!(f, "there are {modes} assembly modes, and only combinations of at most {most} are examined")
            }
            Self::Malformed => f.write_str("numbers of the state are not finite, or too few or too many"),
        }
    }
}

impl core::error::Error for Uncertified {}

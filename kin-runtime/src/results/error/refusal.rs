//! Why a step of a sweep was refused.

use core::fmt;

/// Why a step of a sweep was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Refusal {
    /// Beyond this place the mechanism closes on another branch of the motion only, or not at all.
    WouldJump,
    /// The rows do not close at any smaller step either.
    NotAssembled,
    /// The internal step fell below the smallest allowed.
    StepTooSmall,
    /// More internal steps than allowed.
    TooManySteps,
    /// Rounding errors dominate the rates, because rows are nearly dependent or their slopes change too fast.
    Rounded,
    /// The error of velocities that are integrated has grown so large that it dominates the rates.
    GlobalError,
    /// A row is not defined beyond this place: a root, a logarithm or another function in it ends there.
    Undefined,
    /// Two points coincide whose distance is in a row, as neighbouring points of a rope.
    Coincident,
    /// A row or an input is discontinuous.
    Discontinuous,
    /// t is so large that neighbouring `f64` are farther apart than a step of the motion.
    TimeTooCoarse,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::WouldJump => "the motion would jump to another branch",
            Self::NotAssembled => "the mechanism cannot be assembled beyond it",
            Self::StepTooSmall => "the internal step became too small",
            Self::TooManySteps => "too many internal steps",
            Self::Rounded => {
                "rounding errors dominate the rates there, because rows are nearly dependent or their slopes change too \
                 fast"
            }
            Self::GlobalError => "the error of the integration has grown so large that it dominates the rates",
            Self::Undefined => "a row is not defined beyond it",
            Self::Coincident => "two points of the row coincide, so that their distance has no direction",
            Self::Discontinuous => "a row or an input jumps there",
            Self::TimeTooCoarse => {
                "t is too large: neighbouring floating-point numbers are too far apart there for a step of the motion"
            }
        })
    }
}

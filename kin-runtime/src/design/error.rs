//! What can be wrong with a design.

use crate::error::SolveError;
use crate::text::rounded;
use core::fmt;

/// Why a design cannot be searched for, or a search has no result.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DesignError {
    /// No parameter has this name.
    UnknownParameter {
        /// The name that was given.
        parameter: String,
        /// The parameters of the mechanism.
        parameters: Vec<&'static str>,
    },
    /// A parameter is to be equal to one that is not free.
    NotFree {
        /// The one that is not free.
        parameter: String,
    },
    /// A parameter that is free or kept equal to another one already.
    Twice {
        /// The parameter.
        parameter: String,
    },
    /// Bounds with nothing between them, or bounds that are not finite.
    Bounds {
        /// The parameter.
        parameter: String,
        /// The lower bound.
        low: f64,
        /// The upper bound.
        high: f64,
    },
    /// No quantity, point or body has this name.
    UnknownQuantity {
        /// The name that was given.
        quantity: String,
    },
    /// A quantity that has no derivatives with respect to parameters: a velocity ratio, a force without a closed form,
    /// an input, or t.
    NoDerivatives {
        /// The quantity.
        quantity: String,
    },
    /// A joint without a transmission angle, or no joint at all.
    NoTransmission {
        /// The name that was given.
        joint: String,
        /// The transmission angles of the mechanism.
        angles: Vec<String>,
    },
    /// No mode has this name.
    UnknownMode {
        /// The name that was given.
        mode: String,
        /// The modes of the mechanism.
        modes: Vec<&'static str>,
    },
    /// A number of the design is not finite, or a period is not positive.
    NotFinite {
        /// What it belongs to.
        what: &'static str,
    },
    /// No parameter is free, or there is no objective.
    Nothing {
        /// What is missing.
        what: &'static str,
    },
    /// The mechanism is driven by inputs, which a design does not specify over the motion.
    Inputs {
        /// The inputs.
        inputs: Vec<&'static str>,
    },
    /// The best design does not move through all of a period.
    Broken {
        /// The condition.
        condition: String,
        /// Why it ends.
        why: Box<SolveError>,
    },
    /// The best designs keep the conditions at the instants that the search evaluates, but not between them.
    NotKept {
        /// How often the conditions were tightened.
        rounds: usize,
    },
    /// Not one of the random designs assembles all the way and keeps the conditions.
    NoStart {
        /// How many were drawn.
        drawn: usize,
        /// How many others were examined for the following.
        sampled: usize,
        /// How many of these do not assemble during the whole motion.
        open: usize,
        /// Why one of them does not assemble; `None` if all do.
        why: Option<Box<SolveError>>,
        /// Conditions that designs do not satisfy which assemble.
        missed: Vec<Missed>,
    },
    /// The search was stopped before there was a design that keeps the conditions.
    Stopped,
}

/// A condition that random designs do not satisfy.
#[derive(Clone, Debug, PartialEq)]
pub struct Missed {
    /// The condition.
    pub condition: String,
    /// How many designs do not satisfy it.
    pub designs: usize,
    /// The least that one of them lacks, in the unit of the slack.
    pub closest: Option<f64>,
}

/// For example ``12 do not satisfy `B.transmission` (the best lacks 0.1)``.
impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} do not satisfy `{}`", self.designs, self.condition)?;
        self.closest.map_or(Ok(()), |closest| write!(f, " (the best lacks {})", rounded(closest)))
    }
}

impl fmt::Display for DesignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownParameter { parameter, parameters } => {
                write!(f, "no parameter is named `{parameter}`; there are {}", parameters.join(", "))
            }
            Self::NotFree { parameter } => {
                write!(f, "`{parameter}` is not free, so that no parameter can be set equal to it")
            }
            Self::Twice { parameter } => {
                write!(f, "`{parameter}` is free or kept equal to another parameter already")
            }
            Self::Bounds { parameter, low, high } => {
                write!(
                    f,
                    "the bounds of `{parameter}`, {low} and {high}, must be finite, and the lower one less than the \
                     upper one"
                )
            }
            Self::UnknownQuantity { quantity } => {
                write!(f, "no quantity is named `{quantity}`")
            }
            Self::NoDerivatives { quantity } => write!(
                f,
                "`{quantity}` cannot be an objective or a condition: velocity ratios, forces without a closed form, \
                 inputs and t have no derivatives with respect to parameters here"
            ),
            Self::NoTransmission { joint, angles } if angles.is_empty() => {
                write!(f, "`{joint}` has no transmission angle, and neither has any other joint")
            }
            Self::NoTransmission { joint, angles } => {
                write!(f, "`{joint}` has no transmission angle; there are {}", angles.join(", "))
            }
            Self::UnknownMode { mode, modes } if modes.is_empty() => {
                write!(f, "there is no mode `{mode}`: the mechanism closes in one way, or has no plan")
            }
            Self::UnknownMode { mode, modes } => {
                write!(f, "no mode is named `{mode}`; there are {}", modes.join(", "))
            }
            Self::NotFinite { what } => write!(f, "{what}: a number is not finite, or a period is not positive"),
            Self::Nothing { what } => write!(f, "{what}"),
            Self::Inputs { inputs } => write!(
                f,
                "a design follows a motion that t alone drives, and this mechanism has inputs ({}); prescribe them by \
                 drivers that are functions of t",
                inputs.join(", ")
            ),
            Self::Broken { condition, why } => {
                write!(f, "the best design does not move through all of a period, as `{condition}` requires: {why}")
            }
            Self::NotKept { rounds } => write!(
                f,
                "after {rounds} searches the best design still breaks a condition between the instants that the search \
                 evaluates; more instants or weaker conditions may help"
            ),
            Self::NoStart { drawn, sampled, open, why, missed } => {
                write!(
                    f,
                    "none of {drawn} random designs can be assembled during the whole motion and satisfies the \
                     conditions; of {sampled} others"
                )?;
                if let Some(why) = why {
                    write!(f, ", {open} do not assemble, for example: {why}")?;
                }
                for (k, missed) in missed.iter().enumerate() {
                    let before = if k == 0 && why.is_some() { ";" } else { "," };
                    write!(f, "{before} {missed}")?;
                }
                match (why, &missed[..]) {
                    (None, []) => f.write_str(", some satisfy them: more starts may find one"),
                    _ => Ok(()),
                }
            }
            Self::Stopped => f.write_str("stopped before a design was found that satisfies the conditions"),
        }
    }
}

impl core::error::Error for DesignError {}

//! What can be wrong with a design.

use crate::error::SolveError;
use core::fmt;

/// A design that cannot be searched for.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DesignError {
    /// No parameter has this name.
    UnknownParameter {
        /// What was asked for.
        parameter: String,
        /// The parameters that there are.
        parameters: Vec<&'static str>,
    },
    /// A parameter is to be equal to one that is not free.
    NotFree {
        /// The one that is not free.
        parameter: String,
    },
    /// Bounds that hold nothing between them, or that are not finite.
    Bounds {
        /// The parameter.
        parameter: String,
        /// The lower bound.
        low: f64,
        /// The upper bound.
        high: f64,
    },
    /// No point, coordinate, define or body has this name.
    UnknownQuantity {
        /// What was asked for.
        quantity: String,
    },
    /// No mode has this name.
    UnknownMode {
        /// What was asked for.
        mode: String,
        /// The modes that there are.
        modes: Vec<&'static str>,
    },
    /// A number of the design is not finite, or a period is not positive.
    NotFinite {
        /// What it belongs to.
        what: &'static str,
    },
    /// No parameter is free, or nothing is wanted of the mechanism.
    Nothing {
        /// What is missing.
        what: &'static str,
    },
    /// The mechanism is driven by inputs, whose course over the motion a design does not have.
    Inputs {
        /// The inputs.
        inputs: Vec<&'static str>,
    },
    /// Not one of the random designs assembles all the way and keeps the conditions.
    NoStart {
        /// How many were drawn.
        drawn: usize,
        /// Why the last one was none, where it did not assemble.
        why: Option<SolveError>,
    },
}

impl fmt::Display for DesignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownParameter { parameter, parameters } => {
                write!(f, "no parameter is named `{parameter}`; there are {}", parameters.join(", "))
            }
            Self::NotFree { parameter } => write!(f, "`{parameter}` is not free, so that nothing can be equal to it"),
            Self::Bounds { parameter, low, high } => {
                write!(f, "the bounds of `{parameter}`, {low} and {high}, hold nothing between them")
            }
            Self::UnknownQuantity { quantity } => {
                write!(f, "no point, coordinate, define or body is named `{quantity}`")
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
                "a design follows a motion that t alone drives, and this mechanism has inputs ({}); a driver that is a \
                 function of t says how they move",
                inputs.join(", ")
            ),
            Self::NoStart { drawn, why } => {
                write!(f, "none of {drawn} random designs assembles all the way and keeps the conditions")?;
                match why {
                    Some(why) => write!(f, "; of the last one: {why}"),
                    None => f.write_str("; wider bounds or weaker conditions may leave some"),
                }
            }
        }
    }
}

impl core::error::Error for DesignError {}

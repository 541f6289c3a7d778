//! What a search has found.

use crate::planned::Sign;
use core::fmt;

/// A condition and its slack.
///
/// For a condition on a whole period the motion of the result is followed all along the period, and the least slack is
/// found between instants, too: the slack is interpolated by Chebyshev polynomials around the least of 361 values until
/// their last coefficients are as small as rounding.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Slack {
    /// The condition; the bounds of an angle are in degrees.
    pub condition: String,
    /// By how much it is kept, in its own size: 0 at its limit, of the order of 1 far from it. Sums of parameters are
    /// measured by their bounds, ranges by their width.
    pub slack: f64,
    /// The instant of the least slack, for a condition on a whole period.
    pub at: Option<f64>,
}

/// The best design of a search.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Designed<M> {
    /// The mechanism with these parameters.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub mechanism: M,
    /// Its free parameters, and those that are equal to them.
    pub parameters: Vec<(&'static str, f64)>,
    /// The sum of squared misses: of distances for a path, of differences for a function. Where something was to be least, its
    /// value is added.
    pub error: f64,
    /// What was to be least ([`Design::least`](super::Design::least)); none where all objectives are sums of squares.
    pub least: Option<f64>,
    /// The instants of every objective, in their order.
    pub times: Vec<Vec<f64>>,
    /// The assembly modes.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub modes: Vec<(&'static str, Sign)>,
    /// The least slack of every condition.
    pub slacks: Vec<Slack>,
    /// The number of requested starts.
    pub starts: usize,
    /// Starts for which a design was found that assembles all the way and keeps the conditions.
    pub assembled: usize,
    /// Descents that were taken to the end.
    pub finished: usize,
    /// How many of these reached the best design: an error within a millionth of its error. If only few did, a better
    /// design may exist; if many did, that is no proof that none does.
    pub met: usize,
    /// The errors of the descents that were taken to the end, in ascending order.
    pub errors: Vec<f64>,
    /// True when [`Search::watch`](super::Search::watch) stopped the search.
    pub stopped: bool,
}

impl<M> Designed<M> {
    /// The same with something else in the place of the mechanism.
    pub fn map<T>(self, f: impl FnOnce(M) -> T) -> Designed<T> {
        Designed {
            mechanism: f(self.mechanism),
            parameters: self.parameters,
            error: self.error,
            least: self.least,
            times: self.times,
            modes: self.modes,
            slacks: self.slacks,
            starts: self.starts,
            assembled: self.assembled,
            finished: self.finished,
            met: self.met,
            errors: self.errors,
            stopped: self.stopped,
        }
    }
}

/// The error, how many searches ended there, and a line per parameter and condition.
impl<M> fmt::Display for Designed<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { error, starts, assembled, finished, met, .. } = self;
        match self.least {
            None => write!(f, "sum of squares {error:e}")?,
            Some(least) if least == *error => write!(f, "least {least:e}")?,
            Some(least) => write!(f, "least {least:e} plus a sum of squares of {:e}", error - least)?,
        }
        write!(f, ": {met} of {finished} searches end there, begun at the best of {starts} designs")?;
        write!(f, ", of which {assembled} assemble")?;
        self.parameters.iter().try_for_each(|(name, value)| write!(f, "\n{name} = {value}"))?;
        self.modes.iter().try_for_each(|(name, sign)| write!(f, "\nmode {name}: {sign}"))?;
        self.slacks.iter().try_for_each(|slack| write!(f, "\n{slack}"))
    }
}

//! Ranges of motion: the intervals of t in which a mechanism closes, and the limits at their ends.

use crate::planned::{LimitKind, Sign};
use crate::scalar::Interval;
use crate::text::{rounded, separated};
use core::fmt;

/// The largest radius, relative to 1 + |t|, with which the interval of a limit is printed as one number.
const ENCLOSED: f64 = 1e-6;

/// An interval of t in which the mechanism closes in one combination of its modes, proven for every t in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The signs of its assembly modes, with their names.
    pub modes: Vec<(&'static str, Sign)>,
    /// The first t.
    pub from: f64,
    /// The last t.
    pub to: f64,
    /// q in its middle, n numbers. It distinguishes ranges with the same modes, which occur where groups close by
    /// iteration.
    pub q: Vec<f64>,
    /// The circuit it belongs to, counted from 0. Ranges that meet at a dead centre are one circuit: the mechanism can
    /// pass from one mode into the other there without being taken apart.
    pub circuit: usize,
}

/// A limit at which ranges end.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeLimit {
    /// The interval of t that contains the limit.
    pub t: Interval,
    /// The modes of the range that ends there, and their signs.
    pub modes: Vec<(&'static str, Sign)>,
    /// The joints of the group that is at its limit.
    pub joints: Vec<&'static str>,
    /// The drivers that can go no further, each with the value of the coordinate that it drives; `None` if it drives
    /// something other than a coordinate.
    pub drivers: Vec<(&'static str, Option<f64>)>,
    /// The kind of limit, if it is known.
    pub kind: Option<LimitKind>,
    /// q at the limit, n numbers to about nine digits; empty where it was not found.
    pub q: Vec<f64>,
    /// True if it is proven that the mechanism closes on one side of `t` and not on the other, so that a limit is in
    /// `t`.
    pub proven: bool,
}

/// The ranges of motion between two instants, in every combination of modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranges {
    /// The intervals of t in which it closes, mode by mode.
    pub ranges: Vec<Range>,
    /// The limits at their ends between the two instants, and places at which a closure crosses a bound of `searched`,
    /// which are not proven.
    pub limits: Vec<RangeLimit>,
    /// How many circuits there are.
    pub circuits: usize,
    /// Coordinates with the bounds within which closures were searched: lengths that no row determines, scalar coordinates
    /// with which the equations do not repeat, and angles whose turns are different closures, because gears couple them in
    /// a ratio. Empty where nothing bounds the search.
    pub searched: Vec<(&'static str, Interval)>,
}

impl Ranges {
    /// True if every limit is proven. Then the mechanism closes in the ranges and, apart from the intervals of the
    /// limits, nowhere else, within the bounds of `searched`.
    pub fn is_complete(&self) -> bool {
        self.limits.iter().all(|limit| limit.proven)
    }
}

impl Range {
    /// Its modes as the option `--mode` takes them.
    pub fn name(&self) -> String {
        named(&self.modes)
    }
}

impl RangeLimit {
    /// The modes of the range that ends there, as the option `--mode` takes them.
    pub fn name(&self) -> String {
        named(&self.modes)
    }

    /// Whether its interval is so narrow that one number says where it is.
    pub(crate) fn is_enclosed(&self) -> bool {
        self.t.radius() <= ENCLOSED * (1.0 + self.t.magnitude())
    }
}

fn named(modes: &[(&'static str, Sign)]) -> String {
    modes.iter().map(|(mode, sign)| format!("{mode}={sign}")).collect::<Vec<_>>().join(",")
}

/// `A-B-C=+ from t = -1.0948 to t = 1.0948, circuit 0`.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { modes, from, to, circuit, .. } = self;
        if !modes.is_empty() {
            write!(f, "{} ", self.name())?;
        }
        write!(f, "from t = {} to t = {}, circuit {circuit}", rounded(*from), rounded(*to))
    }
}

/// `dead centre of A, B, C at t = 1.0948, A-B-C=+`.
impl fmt::Display for RangeLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            Some(kind) => write!(f, "{kind}")?,
            None => f.write_str("limit")?,
        }
        if !self.joints.is_empty() {
            f.write_str(" of ")?;
            separated(f, &self.joints, |f, joint| f.write_str(joint))?;
        }
        let Self { t, .. } = self;
        match self.is_enclosed() {
            true => write!(f, " at t = {}", rounded(t.midpoint()))?,
            false => write!(f, " between t = {} and t = {}", rounded(t.lower()), rounded(t.upper()))?,
        }
        if !self.modes.is_empty() {
            write!(f, ", {}", self.name())?;
        }
        f.write_str(if self.proven { "" } else { ", not proven" })
    }
}

/// Ranges, then limits, one per line.
impl fmt::Display for Ranges {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ranges: {}, limits: {}, circuits: {}", self.ranges.len(), self.limits.len(), self.circuits)?;
        self.ranges.iter().try_for_each(|range| write!(f, "\n  {range}"))?;
        self.limits.iter().try_for_each(|limit| write!(f, "\n  {limit}"))
    }
}

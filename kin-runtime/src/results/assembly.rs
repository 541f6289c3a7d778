//! The ways in which a mechanism closes at an instant.

use super::certificate::{Certificate, Uncertified};
use crate::planned::Sign;
use crate::scalar::Interval;
use crate::text::{rounded, separated};
use core::fmt;
use std::collections::BTreeMap;

/// One way in which a mechanism closes.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// q, n numbers; angles within half a turn of the guess, unless drivers determine them.
    pub q: Vec<f64>,
    /// q̇, n numbers; NaN if rounding errors dominate the rates, beside a crossing of branches.
    pub q_dot: Vec<f64>,
    /// q̈, n numbers; NaN with q̇.
    pub q_ddot: Vec<f64>,
    /// The names and signs of its assembly modes; empty if all groups close by iteration.
    pub modes: Vec<(&'static str, Sign)>,
    /// The proof that q is a solution, without its rates, or why there is none.
    pub certificate: Result<Certificate, Uncertified>,
}

impl Assembly {
    /// Its modes as [`Solver::with_mode`](crate::Solver::with_mode) and the option `--mode` take them: `A-B-D=+,E-F-G=-`.
    pub fn name(&self) -> String {
        self.modes.iter().map(|(mode, sign)| format!("{mode}={sign}")).collect::<Vec<_>>().join(",")
    }
}

/// What could not be decided.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Undecided {
    /// The groups with these signs are so near to a limit that neither a closure nor its absence is proven.
    Modes {
        /// The modes on which this depends, with their signs.
        modes: Vec<(&'static str, Sign)>,
        /// The joints of the group at its limit; none if a coordinate has no value, as the root of a negative number.
        joints: Vec<&'static str>,
    },
    /// A region in which there may be no, one or several solutions.
    Region {
        /// The coordinates that were searched, and where they are.
        coordinates: Vec<(&'static str, Interval)>,
    },
    /// The search ended before all boxes were examined.
    Unfinished {
        /// How many boxes, or combinations of signs, were examined.
        seen: usize,
    },
}

/// All ways in which a mechanism closes at an instant, as far as they are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Assemblies {
    /// The closures that were found.
    pub found: Vec<Assembly>,
    /// What is left undecided.
    pub undecided: Vec<Undecided>,
    /// The coordinates that were searched, each with its interval: a full turn for an angle, and a multiple of the size of the
    /// mechanism for a length that no row determines. A scalar coordinate counts as a length if it has the unit of lengths, or
    /// if its guess is more than a turn and the equations do not repeat after one; the interval is a multiple of its guess
    /// then. If the plan has a closed form for all groups, only the angles that others follow in a ratio, as with gears:
    /// further turns of such an angle are further closures.
    pub searched: Vec<(&'static str, Interval)>,
}

impl Assemblies {
    /// True if it is proven that there are no other closures, within the intervals of [`searched`](Self::searched): each has
    /// a certificate, and nothing is undecided.
    pub fn is_complete(&self) -> bool {
        self.undecided.is_empty() && self.found.iter().all(|assembly| assembly.certificate.is_ok())
    }

    /// The name of a closure, by its index in `found`, as the option `--mode` takes it: its [modes](Assembly::name) if
    /// no other closure has the same, otherwise its number, `closure=1` for the first.
    pub fn name(&self, index: usize) -> String {
        self.names().into_iter().nth(index).unwrap_or_else(|| numbered(index))
    }

    /// The names of all closures, in the order of `found`.
    pub(crate) fn names(&self) -> Vec<String> {
        let names: Vec<String> = self.found.iter().map(Assembly::name).collect();
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        names.iter().for_each(|name| *counts.entry(name).or_default() += 1);
        let is_unique = |name: &str| !name.is_empty() && counts.get(name) == Some(&1);
        let name = |(index, name): (usize, &String)| if is_unique(name) { name.clone() } else { numbered(index) };
        names.iter().enumerate().map(name).collect()
    }
}

/// The name of a closure whose modes are those of another one, too.
fn numbered(index: usize) -> String {
    format!("closure={}", index + 1)
}

impl fmt::Display for Undecided {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Modes { modes, joints } => {
                if joints.is_empty() {
                    f.write_str("a coordinate without a value")?;
                } else {
                    f.write_str("the group of ")?;
                    separated(f, joints, |f, joint| f.write_str(joint))?;
                    f.write_str(" at its limit")?;
                }
                modes.iter().try_for_each(|(mode, sign)| write!(f, ", {mode}={sign}"))
            }
            Self::Region { coordinates } => {
                separated(f, coordinates, |f, (name, interval)| write!(f, "{name} in {interval}"))
            }
            Self::Unfinished { seen } => write!(f, "the rest of a search that ended after {seen} cases"),
        }
    }
}

/// `A-B-D=+: one solution, known within 1.2e-16, no other within 1e-6`.
impl fmt::Display for Assembly {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        named(f, &self.name(), self)
    }
}

/// A closure under a name.
fn named(f: &mut fmt::Formatter<'_>, name: &str, assembly: &Assembly) -> fmt::Result {
    write!(f, "{name}: ")?;
    match &assembly.certificate {
        Ok(certificate) => fmt::Display::fmt(certificate, f),
        Err(why) => write!(f, "not certified: {why}"),
    }
}

/// One closure in a line, and what is undecided.
impl fmt::Display for Assemblies {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.found.len() {
            1 => f.write_str("1 closure")?,
            count => write!(f, "{count} closures")?,
        }
        f.write_str(if self.is_complete() { ", all there are" } else { ", not proven to be all" })?;
        let is_turn = |within: &Interval| (within.radius() - core::f64::consts::PI).abs() < 1e-9;
        for (name, within) in self.searched.iter().filter(|(_, within)| !is_turn(within)) {
            write!(f, ", with {name} from {} to {}", rounded(within.lower()), rounded(within.upper()))?;
        }
        for (name, assembly) in self.names().iter().zip(&self.found) {
            f.write_str("\n  ")?;
            named(f, name, assembly)?;
        }
        self.undecided.iter().try_for_each(|undecided| write!(f, "\n  undecided: {undecided}"))
    }
}

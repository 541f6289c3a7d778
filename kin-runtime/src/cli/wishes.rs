//! The requirements of `design`, as data that do not depend on the mechanism's type.

use crate::design::{Design, DesignError, Direction, Shortest};
use crate::mechanism::Mechanism;

/// Instants of a turn at which a search evaluates conditions; the result is tested between them, too.
pub(super) const INSTANTS: usize = 37;
/// The least margin of a mechanism that must turn, for example the height of a dyad relative to its links.
const MARGIN: f64 = 1e-2;

/// A requirement of a design: one call of its builder.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
    Free(String, f64, f64),
    Equal(String, String),
    PathAt(String, Vec<(f64, [f64; 2])>),
    Path(String, Vec<[f64; 2]>, Direction),
    Function(String, Vec<(f64, f64)>),
    Grashof(Vec<String>, Shortest),
    Turns,
    Range(String, f64, f64),
    Transmission(String, f64),
    Peak(String),
}

impl Wish {
    /// The bounds of a free parameter.
    pub(super) fn bounds(&self) -> Option<(String, [f64; 2])> {
        match self {
            Self::Free(name, low, high) => Some((name.clone(), [*low, *high])),
            _ => None,
        }
    }
}

/// All requirements of a design, with the duration of a turn, which they share.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wishes {
    pub(super) all: Vec<Wish>,
    pub(super) period: f64,
}

impl Wishes {
    /// The design of a mechanism.
    pub(super) fn of<M: Mechanism>(&self, begin: Design<M>) -> Result<Design<M>, DesignError> {
        let period = self.period;
        self.all.iter().try_fold(begin, |design, wish| match wish {
            Wish::Free(name, low, high) => design.free(name, *low..=*high),
            Wish::Equal(name, other) => design.equal(name, other),
            Wish::PathAt(point, places) => design.path_at(point, places),
            Wish::Path(point, places, direction) => design.path(point, places, period, *direction),
            Wish::Function(name, values) => design.function(name, values),
            Wish::Grashof(lengths, shortest) => {
                design.grashof(core::array::from_fn(|k| lengths.get(k).map_or("", String::as_str)), *shortest)
            }
            Wish::Turns => design.turns(period, INSTANTS, MARGIN),
            Wish::Transmission(joint, least) => design.transmission(joint, *least, period, INSTANTS),
            Wish::Peak(name) => {
                let times: Vec<f64> = (0..INSTANTS).map(|k| period * k as f64 / (INSTANTS - 1) as f64).collect();
                let greatest = |at: &[Vec<f64>]| at.iter().flatten().map(|value| value.abs()).fold(0.0, f64::max);
                design.least(&[name], &times, greatest)
            }
            Wish::Range(name, low, high) => design.range(name, *low..=*high, period, INSTANTS),
        })
    }
}

//! The requirements of `design`, as data that do not depend on the mechanism's type.

use super::setup::Setup;
use crate::design::{DesignError, Direction, Shortest, Task};
use std::sync::Arc;

/// Instants of a turn at which a search evaluates conditions; the result is tested between them, too.
pub(super) const INSTANTS: usize = 37;
/// The least margin of a mechanism that must turn. Margins are squares: a dyad keeps at least a tenth of the height, relative
/// to its links, that it has far from its dead centres.
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
    /// Adds all of them to the task of a design, with the modes and guesses of a setup.
    pub(super) fn add_to(&self, setup: &Setup, task: &mut Task) -> Result<(), DesignError> {
        setup.modes.iter().for_each(|&(index, sign)| task.prescribe(index, Some(sign)));
        task.guesses.extend(&setup.guesses);
        let period = self.period;
        self.all.iter().try_for_each(|wish| match wish {
            Wish::Free(name, low, high) => task.free(name, *low..=*high),
            Wish::Equal(name, other) => task.equal(name, other),
            Wish::PathAt(point, places) => task.path_at(point, places),
            Wish::Path(point, places, direction) => task.path(point, places, period, *direction),
            Wish::Function(name, values) => task.function(name, values),
            Wish::Grashof(lengths, shortest) => {
                task.grashof(core::array::from_fn(|k| lengths.get(k).map_or("", String::as_str)), *shortest)
            }
            Wish::Turns => task.turns(period, INSTANTS, MARGIN),
            Wish::Transmission(joint, least) => task.transmission(joint, *least, period, INSTANTS),
            Wish::Peak(name) => {
                let times: Vec<f64> = (0..INSTANTS).map(|k| period * k as f64 / (INSTANTS - 1) as f64).collect();
                let greatest = |at: &[Vec<f64>]| at.iter().flatten().map(|value| value.abs()).fold(0.0, f64::max);
                task.least(&[name], &times, Arc::new(greatest))
            }
            Wish::Range(name, low, high) => task.range(name, *low..=*high, period, INSTANTS),
        })
    }
}

//! Extremes between the instants of a motion.

use serde::Serialize;

use crate::cli::followed::FollowedMotion;
use crate::cli::instants::Instants;
use crate::nonlinear::peak::peak;
use crate::serial::NamedValues;
use crate::state::State;

/// Number of peaks that are refined in any case, the highest possible ones first; further ones only if they may be higher
/// than those.
const REFINED: usize = 8;
/// A quantity whose variation is smaller than this, relative to its largest value or to the largest coordinate from which
/// it is computed, is constant.
const CONSTANT: f64 = 1e-12;

/// The place of an extreme around which the motion cannot be solved everywhere, so that it may be exceeded there.
const UNRESOLVED: &str = "unresolved";

/// The least or the greatest of a quantity.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Extreme {
    pub(super) value: f64,
    pub(super) t: f64,
    /// The values of the driven quantities there.
    pub(super) drivers: NamedValues<f64, String>,
    #[serde(rename = "where")]
    pub(super) place: &'static str,
}

/// The least and the greatest of the finite numbers.
fn bounds(values: &[f64]) -> [f64; 2] {
    let finite = values.iter().filter(|value| value.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(*v), high.max(*v)])
}

/// A motion whose extremes are searched.
pub(super) struct SearchedMotion<'a> {
    pub(super) walk: FollowedMotion<'a>,
    pub(super) states: &'a [State],
    /// t, the driven quantities, and the quantities whose extremes are wanted.
    pub(super) columns: &'a [Vec<f64>],
    /// The index of the first quantity whose extremes are wanted.
    pub(super) first: usize,
    pub(super) instants: &'a Instants,
}

impl SearchedMotion<'_> {
    /// True for a quantity that varies by rounding at most.
    pub(super) fn is_constant(&self, place: usize) -> bool {
        let [low, high] = bounds(&self.columns[place]);
        let terms = self.states.iter().map(|state| self.walk.measures[place].largest_term(state)).fold(0.0, f64::max);
        low > high || high - low <= CONSTANT * low.abs().max(high.abs()).max(terms)
    }

    /// The greatest of a quantity, or with the sign −1 the least.
    pub(super) fn extreme(&self, place: usize, sign: f64) -> Option<Extreme> {
        let values: Vec<f64> = self.columns[place].iter().map(|value| sign * value).collect();
        let [low, high] = bounds(&values);
        let top = values.iter().position(|value| *value == high)?;
        let sampled = || self.at_instant(place, top);
        if self.is_constant(place) {
            return Some(Extreme { place: "constant", ..sampled() });
        }
        // Rates grow without bounds towards a dead centre, and are NaN at it.
        let last = values.len() - 1;
        if [(0, 1), (last, last.saturating_sub(1))].iter().any(|&(end, beside)| values[end].is_nan() && top == beside) {
            return Some(Extreme { place: "towards the limit", ..sampled() });
        }
        // An estimate of the greatest value around an instant: between two instants the curve is assumed to rise above
        // a value by no more than it drops to the neighbouring ones.
        let potential = |k: usize| {
            let neighbours = [k.checked_sub(1), Some(k + 1)].into_iter().flatten().filter_map(|j| values.get(j));
            let drop = neighbours.map(|other| values[k] - other).filter(|drop| drop.is_finite()).fold(0.0, f64::max);
            values[k] + drop
        };
        let is_peak = |k: &usize| {
            let lower = |other: Option<&f64>| other.is_none_or(|other| other.is_nan() || *other <= values[*k]);
            values[*k].is_finite() && lower(k.checked_sub(1).and_then(|j| values.get(j))) && lower(values.get(k + 1))
        };
        let mut peaks: Vec<usize> = (0..values.len()).filter(is_peak).filter(|k| potential(*k) >= high).collect();
        peaks.sort_by(|a, b| potential(*b).total_cmp(&potential(*a)));
        let rounding = 1e-14 * (high - low).max(high.abs());
        let mut best: Option<(usize, Extreme)> = None;
        for (count, k) in peaks.into_iter().enumerate() {
            let reached = best.as_ref().map_or(f64::NEG_INFINITY, |(_, best)| sign * best.value);
            if count >= REFINED && potential(k) <= reached + rounding {
                break;
            }
            let found = self.refined(place, sign, k).filter(|found| sign * found.value >= reached);
            best = found.map(|found| (k, found)).or(best);
        }
        // A value that exceeds those at the instants by rounding alone is reported at the instant, and so is the value at
        // an instant that cannot be refined, such as a limit, if no refined one reaches it. At an end of the motion the
        // nearest place beside it is no better.
        Some(match best {
            Some((_, best)) if sign * best.value > high + rounding => best,
            Some((k, best))
                if (best.place == UNRESOLVED || best.place != "end" && k != 0 && k != last)
                    && (sign * best.value >= high || values[k] == high) =>
            {
                best
            }
            _ => sampled(),
        })
    }

    /// The extreme at an instant of the motion.
    fn at_instant(&self, place: usize, k: usize) -> Extreme {
        let last = self.states.len() - 1;
        let has_limit = |end: usize| self.instants.limits[end].as_ref().is_some_and(|stop| stop.t == self.states[k].t);
        let named = match k {
            0 if has_limit(0) => "limit",
            _ if k == last && has_limit(1) => "limit",
            0 => "first instant",
            _ if k == last => "last instant",
            _ => "kink",
        };
        let drivers = (1..self.first).map(|d| (self.walk.measures[d].name().to_owned(), self.columns[d][k]));
        Extreme { value: self.columns[place][k], t: self.states[k].t, drivers: drivers.collect(), place: named }
    }

    /// The extreme around an instant; its place is `end` if it is at an end of the interval around it that can be
    /// solved, and `unresolved` if the motion cannot be solved everywhere around it.
    fn refined(&self, place: usize, sign: f64, k: usize) -> Option<Extreme> {
        let last = self.states.len() - 1;
        // Neither a limit nor what is beyond it can be solved.
        let solved = |j: &usize| self.states[*j].q_dot.iter().all(|rate| rate.is_finite());
        let around: Vec<usize> = (k.saturating_sub(1)..=(k + 1).min(last)).filter(solved).collect();
        let (&low, &high) = (around.first()?, around.last()?);
        if low == high {
            return None;
        }
        let (from, [a, b]) = (&self.states[low], [self.states[low].t, self.states[high].t]);
        let range = self.states[last].t - self.states[0].t;
        let measure = &self.walk.measures[place];
        let sample = |times: &[f64]| {
            let states = solve(&self.walk, self.instants, from, times)?;
            let value =
                |state: &State| self.walk.values_of(state, std::slice::from_ref(measure)).ok()?.first().copied();
            states.iter().map(|state| Some(sign * value(state)?)).collect()
        };
        let Some(found) = peak(sample, [a, b], range) else {
            return Some(Extreme { place: UNRESOLVED, ..self.at_instant(place, k) });
        };
        if !found.resolved && found.value < sign * self.columns[place][k] {
            return Some(Extreme { place: UNRESOLVED, ..self.at_instant(place, k) });
        }
        let state = solve(&self.walk, self.instants, from, &[found.at])?.pop()?;
        let values_of = |places: std::ops::Range<usize>| self.walk.values_of(&state, &self.walk.measures[places]).ok();
        let drivers = self.walk.measures[1..self.first].iter().map(|measure| measure.name().to_owned());
        let named = match found.smooth {
            _ if !found.resolved => UNRESOLVED,
            _ if found.at == a || found.at == b => "end",
            true => "between instants",
            false => "kink",
        };
        Some(Extreme {
            value: values_of(place..place + 1)?.first().copied()?,
            t: found.at,
            drivers: drivers.zip(values_of(1..self.first)?).collect(),
            place: named,
        })
    }
}

/// The states at `times`, each solved from the one before it, the first one from `from`.
pub(super) fn solve(walk: &FollowedMotion<'_>, instants: &Instants, from: &State, times: &[f64]) -> Option<Vec<State>> {
    let FollowedMotion { engine, setup, .. } = walk;
    let first = instants.times.get(instants.start)?;
    let starts_there = times.first().is_some_and(|t| *t == from.t);
    let all: Vec<f64> = match starts_there {
        true => times.to_vec(),
        false => std::iter::once(from.t).chain(times.iter().copied()).collect(),
    };
    let mut states = engine.sweep_from(setup, *first, &from.q, &all).ok()?.states;
    if !starts_there {
        states.remove(0);
    }
    Some(states)
}

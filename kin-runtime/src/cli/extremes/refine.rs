//! Further instants where quantities are not yet resolved by those of the motion.
//!
//! Between two instants a quantity may have a spike that neither of them shows. Every interval is therefore looked at in
//! three places; where a quantity is not near the straight line between its neighbours, the interval is divided, until
//! all quantities are nearly straight between neighbouring instants.

use super::search::solve;
use crate::cli::followed::FollowedMotion;
use crate::cli::instants::Instants;
use crate::state::State;

/// The largest distance of a quantity from the straight line between two instants, relative to its range.
const STRAIGHT: f64 = 0.01;
/// Places within an interval that is looked at for the first time, relative to its length.
const PLACES: [f64; 3] = [0.2175, 0.4602, 0.7423];
/// Largest number of instants in all.
const MAX_INSTANTS: usize = 20_000;
/// Largest number of times that an interval is divided.
const DEPTH: usize = 14;

/// A state with the values of all quantities.
struct Sampled {
    state: State,
    values: Vec<f64>,
    /// Whether the interval that begins here is still to be looked at.
    open: bool,
}

/// A motion with further instants.
pub(super) struct RefinedMotion {
    pub(super) states: Vec<State>,
    /// The columns of the states.
    pub(super) columns: Vec<Vec<f64>>,
    /// The intervals of time, in order, within which the motion could not be solved.
    pub(super) unsolved: Vec<[f64; 2]>,
}

/// The states and columns of a motion with further instants; those from `first` on are the quantities.
pub(super) fn refined(
    walk: &FollowedMotion<'_>,
    instants: &Instants,
    (states, columns): (&[State], &[Vec<f64>]),
    first: usize,
) -> RefinedMotion {
    let mut unsolved: Vec<[f64; 2]> = Vec::new();
    let values = |k: usize| columns.iter().map(|column| column[k]).collect();
    let given = states.iter().enumerate();
    let mut all: Vec<Sampled> =
        given.map(|(k, state)| Sampled { state: state.clone(), values: values(k), open: true }).collect();
    for round in 0..DEPTH {
        let places: &[f64] = if round == 0 { &PLACES } else { &[0.5] };
        let ranges = ranges(&all, first);
        let mut denser: Vec<Sampled> = Vec::with_capacity(2 * all.len());
        let mut rest = all.into_iter().peekable();
        let (mut count, mut divided) = (rest.len(), false);
        while let Some(mut current) = rest.next() {
            let within = match rest.peek() {
                Some(next) if current.open && count + places.len() <= MAX_INSTANTS => {
                    let within = between(walk, instants, [&current, next], places);
                    if within.is_none() {
                        unsolved.push([current.state.t, next.state.t]);
                    }
                    within.unwrap_or_default()
                }
                _ => Vec::new(),
            };
            let bends = rest.peek().is_some_and(|next| !are_straight([&current, next], &within, (first, &ranges)));
            current.open = bends;
            denser.push(current);
            if bends {
                (count, divided) = (count + within.len(), true);
                denser.extend(within);
            }
        }
        all = denser;
        if !divided {
            break;
        }
    }
    let columns = (0..columns.len()).map(|k| all.iter().map(|sampled| sampled.values[k]).collect()).collect();
    unsolved.sort_by(|a, b| a[0].total_cmp(&b[0]));
    RefinedMotion { states: all.into_iter().map(|sampled| sampled.state).collect(), columns, unsolved }
}

/// The range of every quantity.
fn ranges(all: &[Sampled], first: usize) -> Vec<f64> {
    let count = all.first().map_or(0, |sampled| sampled.values.len());
    let range = |k: usize| {
        let finite = all.iter().map(|sampled| sampled.values[k]).filter(|value| value.is_finite());
        let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        (high - low).max(1e-9 * low.abs().max(high.abs()))
    };
    (first..count).map(range).collect()
}

/// Instants between two others, none beside what has no rates; `None` where the motion cannot be solved between others.
fn between(
    walk: &FollowedMotion<'_>,
    instants: &Instants,
    [a, b]: [&Sampled; 2],
    places: &[f64],
) -> Option<Vec<Sampled>> {
    let is_solved = |sampled: &Sampled| sampled.state.q_dot.iter().all(|rate| rate.is_finite());
    let (from, h) = (a.state.t, b.state.t - a.state.t);
    if !is_solved(a) || !is_solved(b) || h == 0.0 {
        return Some(Vec::new());
    }
    let times: Vec<f64> = places.iter().map(|place| from + place * h).collect();
    let states = solve(walk, instants, &a.state, &times)?;
    let sampled = |state: State| {
        let values = walk.values_of(&state, walk.measures).ok()?;
        Some(Sampled { state, values, open: true })
    };
    Some(states.into_iter().map(sampled).collect::<Option<Vec<_>>>().unwrap_or_default())
}

/// True if all quantities are near the straight line between both ends.
fn are_straight([a, b]: [&Sampled; 2], within: &[Sampled], (first, ranges): (usize, &[f64])) -> bool {
    let h = b.state.t - a.state.t;
    within.iter().all(|m| {
        let share = (m.state.t - a.state.t) / h;
        ranges.iter().enumerate().all(|(k, range)| {
            let [from, to, value] = [a, b, m].map(|sampled| sampled.values[first + k]);
            let off = (value - (from + share * (to - from))).abs();
            // Where a quantity is not defined, there is nothing to find.
            off.is_nan() || off <= STRAIGHT * range
        })
    })
}

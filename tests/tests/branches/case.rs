//! Motions that are known independently of kin, and the comparison of results with them.

use crate::jet::Jet;
use kin_runtime::Signal;
use std::f64::consts::TAU;

/// Largest distance in time between a refusal and a fold or a crossing; all motions here have speeds of about one.
pub(crate) const NEAR: f64 = 2e-3;
/// Errors of q, q̇ and q̈ that are always allowed, relative to the largest number of the kind.
const FLOORS: [f64; 3] = [1e-8, 1e-6, 1e-4];
/// Relative change of dimensions and time within which a result may be the exact one (backward error).
const BACKWARD: f64 = 1e-13;
/// A position with a larger error is on another branch, however near a fold or a crossing is.
const FAR: f64 = 1e-3;

/// The exact coordinates over time, in the order of q: the analytic branch through the start, with all dimensions and
/// the time changed by the relative amount `off`. `None` where the mechanism does not close.
pub(crate) type Branch = Box<dyn Fn(f64, f64) -> Option<Vec<Jet>>>;

/// Writes value, rate and acceleration of every input at a time.
pub(crate) type Inputs = Box<dyn Fn(f64, &mut [Signal])>;

/// A mechanism with its known motion.
pub(crate) struct Case<M: ?Sized> {
    pub(crate) branch: Branch,
    /// The times at which the branch ends.
    pub(crate) folds: Vec<f64>,
    /// The times at which it crosses another branch.
    pub(crate) crossings: Vec<f64>,
    /// Additional information for failure messages.
    pub(crate) note: String,
    pub(crate) sampled: Sampled,
    /// Times at which the rows that the plan uses are singular although the mechanism is not: a follower of the plan
    /// alone may end there.
    pub(crate) plan_ends: Vec<f64>,
    /// The last field, so that its type may be a trait object.
    pub(crate) mechanism: M,
}

impl<M> Case<M> {
    pub(crate) fn new(
        mechanism: M,
        branch: impl Fn(f64, f64) -> Option<Vec<Jet>> + 'static,
        [folds, crossings]: [Vec<f64>; 2],
        note: String,
    ) -> Self {
        let (branch, sampled, plan_ends) = (Box::new(branch), Sampled::AsWell, Vec::new());
        Self { mechanism, branch, folds, crossings, note, sampled, plan_ends }
    }
}

/// The expected motion for solvers that get the inputs instant by instant instead of as functions.
pub(crate) enum Sampled {
    /// The same motion, because there are no inputs.
    AsWell,
    /// Another branch, which may end at other places.
    As { branch: Branch, places: Vec<f64> },
    /// Unknown.
    Unknown,
}

/// Mechanisms that move over the same instants.
pub(crate) struct Group<M> {
    pub(crate) times: Vec<f64>,
    pub(crate) cases: Vec<Case<M>>,
    pub(crate) inputs: Inputs,
}

impl<M> Group<M> {
    pub(crate) fn new(times: Vec<f64>, cases: Vec<Case<M>>) -> Self {
        Self { times, cases, inputs: Box::new(|_, _| ()) }
    }
}

/// The expected state at an instant with the allowed errors; `None` where no state is expected.
pub(crate) type Expected = Option<(Vec<Jet>, Vec<[f64; 3]>)>;

/// A result: q, q̇ and q̈ at the first instants, and the reason why there are no more.
pub(crate) struct Answer {
    pub(crate) states: Vec<[Vec<f64>; 3]>,
    pub(crate) refusal: Option<Refusal>,
}

/// The reason why a motion ends.
pub(crate) struct Refusal {
    /// The location of the limit; `None` if only the instant that cannot be reached is known.
    pub(crate) t: Option<f64>,
    /// Whether the error is of a type that describes limits and crossings.
    pub(crate) typed: bool,
    pub(crate) words: String,
}

/// The verdict about a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Verdict {
    /// All instants are solved, and all numbers are right.
    Right,
    /// The result is right up to a fold or a crossing, and refused there.
    Refused,
    /// The motion is refused although there is neither a fold nor a crossing.
    Early,
    /// A state is accepted although its errors are larger than the conditioning explains.
    Inexact,
    /// A state is accepted on another branch, or where no state exists.
    Flip,
}

/// The expected states at all instants; there are none behind the first fold.
pub(crate) fn expected(branch: &Branch, folds: &[f64], times: &[f64]) -> Vec<Expected> {
    let mut ended = false;
    let mut last = times[0];
    let at = |t: f64| {
        let from = std::mem::replace(&mut last, t);
        ended |= folds.iter().any(|fold| from.min(t) < *fold && *fold < from.max(t));
        let found = if ended { None } else { branch(t, 0.0) };
        ended |= found.is_none();
        let found = found?;
        let size = |part: fn(&Jet) -> f64| found.iter().fold(1.0_f64, |most, jet| most.max(part(jet).abs()));
        let sizes = [size(|jet| jet.x), size(|jet| jet.v), size(|jet| jet.a)];
        let mut allowed = vec![std::array::from_fn(|order| FLOORS[order] * sizes[order]); found.len()];
        for off in [BACKWARD, -BACKWARD] {
            let beside = branch(t, off);
            for (place, allowed) in allowed.iter_mut().enumerate() {
                // The instant is so near to a fold that nothing is determined.
                let Some(beside) = &beside else {
                    *allowed = [FAR, f64::INFINITY, f64::INFINITY];
                    continue;
                };
                let (a, b) = (beside[place], found[place]);
                for (allowed, difference) in allowed.iter_mut().zip([turn(a.x - b.x), a.v - b.v, a.a - b.a]) {
                    *allowed += difference.abs();
                }
            }
        }
        Some((found, allowed))
    };
    times.iter().copied().map(at).collect()
}

/// A difference of angles modulo full turns; smaller differences of lengths are unchanged.
fn turn(difference: f64) -> f64 {
    difference - TAU * (difference / TAU).round()
}

/// Judges a result; the text says what is wrong.
pub(crate) fn judge(places: &[f64], times: &[f64], expected: &[Expected], answer: &Answer) -> (Verdict, String) {
    let mut found = (Verdict::Right, String::new());
    let distance = |t: f64| places.iter().map(|place| (place - t).abs()).fold(f64::INFINITY, f64::min);
    let mut worse = |verdict: Verdict, words: String| {
        if verdict > found.0 {
            found = (verdict, words);
        }
    };
    for ((t, expected), state) in times.iter().zip(expected).zip(&answer.states) {
        let Some((jets, allowed)) = expected else {
            worse(Verdict::Flip, format!("a state at t = {t:?}, behind the end of the branch"));
            continue;
        };
        let [q, q_dot, q_ddot] = state;
        for (place, (jet, allowed)) in jets.iter().zip(allowed).enumerate() {
            let off = [turn(q[place] - jet.x), q_dot[place] - jet.v, q_ddot[place] - jet.a].map(f64::abs);
            // NaN counts as an error as well.
            let bad = (0..3).find(|order| off[*order].is_nan() || off[*order] > allowed[*order]);
            let Some(order) = bad else { continue };
            let near = distance(*t);
            // Near a fold or a crossing, the error of the position may be due to rounding.
            let elsewhere = off[0] > allowed[0].max(if near < NEAR { FAR } else { 0.0 });
            let verdict = if elsewhere { Verdict::Flip } else { Verdict::Inexact };
            let (what, off, allowed) = (["q", "q̇", "q̈"][order], off[order], allowed[order]);
            let words =
                format!("{what}[{place}] is off by {off:e} ({allowed:e} allowed) at t = {t:?}, {near:e} from a limit");
            worse(verdict, words);
        }
    }
    let done = answer.states.len();
    match &answer.refusal {
        None if done != times.len() => worse(Verdict::Flip, format!("only {done} of {} states", times.len())),
        None => {}
        Some(refusal) => {
            let (from, to) = (times[done.saturating_sub(1)], times[done.min(times.len() - 1)]);
            let slack = NEAR.max(1e-3 * (to - from).abs());
            let (low, high) = (from.min(to) - slack, from.max(to) + slack);
            let there =
                |place: &&f64| (low..=high).contains(*place) && refusal.t.is_none_or(|t| (t - **place).abs() <= slack);
            if refusal.typed && places.iter().any(|place| there(&place)) {
                worse(Verdict::Refused, String::new());
            } else {
                let nearest = distance(refusal.t.unwrap_or(to));
                let words = format!("behind t = {from:?}, {nearest:e} from any limit: {}", refusal.words);
                worse(Verdict::Early, words);
            }
        }
    }
    found
}

//! Finds values for the examples of the help by trying them, so that every example has an answer.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::engine::{Arc, Engine};
use super::setup::Setup;
use super::turns::natural_end;
use crate::model::Model;
use crate::observer::Reached;
use crate::present::number::rounded;
use crate::signal::Signal;
use crate::state::State;

/// Largest number of coordinates of a mechanism that is tried.
const MAX_COORDINATES: usize = 400;
/// Instants of a motion that is tried.
const INSTANTS: usize = 24;
/// Time limit of a trial; an example that takes longer is left out of the help.
const TIME_LIMIT: Duration = Duration::from_millis(200);
/// Largest number of modes whose combinations are tried.
const MAX_COMBINED_MODES: usize = 3;
/// Largest change of a coordinate that counts as none, relative to its size.
const NO_MOTION: f64 = 1e-9;
/// Largest number of combinations of values of inputs that are tried.
const MAX_INPUT_COMBINATIONS: usize = 200;

/// Values that examples can use.
#[derive(Clone, Debug)]
pub(super) struct ExampleValues {
    /// ` --input u=0.9,0.1`, ` --given s=0.3:1`; empty if nothing is needed.
    pub(super) needed: String,
    /// An instant within the motion, and one at its end.
    pub(super) at: String,
    pub(super) to: String,
    /// `l1=0.09..0.11:5`
    pub(super) vary: Option<String>,
    /// `A-B-D=-`, as it is assembled.
    pub(super) mode: Option<String>,
    /// Whether the configuration at t = 0 has a certificate, whether all closures there are known, and all limits of a
    /// turn.
    pub(super) proven: [bool; 3],
    /// Whether the motion along the arc closes.
    pub(super) arc: bool,
    /// The indices of coordinates that do not change in the motion.
    pub(super) unmoved: Vec<usize>,
}

impl Default for ExampleValues {
    fn default() -> Self {
        Self {
            needed: String::new(),
            at: "0.5".to_owned(),
            to: "1".to_owned(),
            vary: None,
            mode: None,
            proven: [false; 3],
            arc: false,
            unmoved: Vec::new(),
        }
    }
}

impl ExampleValues {
    /// Tries the mechanism; its parameters are restored afterwards.
    pub(super) fn of(engine: &mut dyn Engine) -> Option<Self> {
        let model = engine.model();
        if model.coordinates.len() > MAX_COORDINATES {
            return None;
        }
        let mut trial = Self::default();
        let mut setup = inputs(engine)?;
        let slow = |signal: &Signal| rounded(if signal.value == 0.0 { 0.1 } else { 0.1 * signal.value.abs() });
        if model.input_defaults.iter().any(Option::is_none) || model.input_defaults.len() < model.inputs.len() {
            let texts = model.inputs.iter().zip(&setup.inputs);
            let texts: Vec<String> =
                texts.map(|(name, u)| format!("{name}={},{}", rounded(u.value), rounded(u.rate))).collect();
            trial.needed = format!(" --input {}", quoted(texts.join(",")));
        }
        for _ in 0..=model.coordinates.len() {
            let state = engine.state(&setup, 0.0).ok()?;
            let mobility = engine.mobility(&setup, &state.instant(), &state.q).ok()?;
            if mobility.degrees_of_freedom_left == 0 {
                break;
            }
            let &index = mobility.could_be_given.first()?;
            let signal = Signal { value: shortened(state.q[index]), rate: 0.1, acceleration: 0.0 };
            setup.given.push((index, Signal { rate: slow(&signal).parse().unwrap_or(0.1), ..signal }));
        }
        if !setup.given.is_empty() {
            let texts = setup.given.iter().map(|(index, s)| {
                format!("{}={}:{}", model.coordinates[*index].name, rounded(s.value), rounded(s.rate))
            });
            let texts: Vec<String> = texts.collect();
            trial.needed.push_str(&format!(" --given {}", quoted(texts.join(","))));
        }
        let end = reached(engine, &setup, natural_end(engine, &setup, 0.0))?;
        (trial.at, trial.to) = (rounded(shortened(0.5 * end)), rounded(shortened(end)));
        let state = engine.state(&setup, 0.0).ok()?;
        let modes = engine.modes(&state.instant(), &state.q);
        trial.mode = modes.iter().find_map(|mode| Some(format!("{}={}", mode.name, mode.sign?)));
        trial.proven = proven(engine, &setup, &state, natural_end(engine, &setup, 0.0));
        trial.arc = closes(engine, &setup);
        // Not half a turn, after which a rod is parallel to where it began.
        let later = [0.3, 0.55].into_iter().filter_map(|share| engine.state(&setup, share * end).ok());
        let later: Vec<Vec<f64>> = later.map(|state| state.q).collect();
        let is_still =
            |k: &usize| later.iter().all(|q| (q[*k] - state.q[*k]).abs() <= NO_MOTION * (1.0 + state.q[*k].abs()));
        trial.unmoved = (0..state.q.len()).filter(is_still).collect();
        trial.vary = varied(engine, &setup);
        Some(trial)
    }
}

/// What can be proven: the configuration; and, if that is quick, all closures and all limits up to `end`.
fn proven(engine: &dyn Engine, setup: &Setup, state: &State, end: f64) -> [bool; 3] {
    let plan = &engine.model().plan;
    let short = plan.exists() && !plan.iterates() && plan.modes.len() <= MAX_COMBINED_MODES;
    let closures = short && engine.assemblies(setup, 0.0).is_ok_and(|all| all.is_complete());
    let limits = closures && engine.ranges(setup, 0.0, end).is_ok_and(|all| all.is_complete());
    [engine.certify(setup, state).is_ok(), closures, limits]
}

/// Whether the motion along the arc comes back to its start before long.
fn closes(engine: &dyn Engine, setup: &Setup) -> bool {
    let began = Instant::now();
    let observe =
        |_: Reached<'_>| if began.elapsed() < TIME_LIMIT { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let arc = Arc { from: 0.0, to: None, steps: 1 };
    let found = engine.sweep_along_arc(setup, arc, &observe);
    found.is_ok_and(|trajectory| trajectory.arc.is_some_and(|arc| arc.is_closed()))
}

/// The last instant that a motion reaches.
fn reached(engine: &dyn Engine, setup: &Setup, end: f64) -> Option<f64> {
    let times: Vec<f64> = (0..=INSTANTS).map(|k| end * k as f64 / INSTANTS as f64).collect();
    let (mut last, began) = (None, Instant::now());
    engine.sweep_each(setup, &times, false, &|_| ControlFlow::Continue(()), &mut |state| {
        last = Some(state.t);
        if began.elapsed() < TIME_LIMIT { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    last.filter(|t| *t > 0.0)
}

/// Inputs with which the mechanism can be assembled: their defaults, or else values found by trial.
fn inputs(engine: &dyn Engine) -> Option<Setup> {
    let model = engine.model();
    let count = model.inputs.len();
    let fixed: Vec<Option<f64>> =
        model.input_defaults.iter().copied().chain(std::iter::repeat(None)).take(count).collect();
    let setup = |values: &[f64]| {
        let moving = |value: f64| if value == 0.0 { 0.1 } else { shortened(0.1 * value.abs()) };
        let signal = |(value, fixed): (&f64, &Option<f64>)| Signal {
            value: fixed.unwrap_or(*value),
            rate: if fixed.is_some() { 0.0 } else { moving(*value) },
            acceleration: 0.0,
        };
        Setup { inputs: values.iter().zip(&fixed).map(signal).collect(), ..Setup::default() }
    };
    let parameters = engine.parameters().into_iter().filter(|value| value.is_finite()).map(shortened);
    let guessed = engine.guesses().into_iter().flatten().map(shortened);
    let mut candidates: Vec<f64> = [0.0, 0.5, 1.0].into_iter().chain(guessed).chain(parameters).collect();
    candidates.dedup();
    let number = candidates.len();
    // First the same value for all inputs, then all combinations.
    let alike = (0..number).map(|k| vec![candidates[k]; count]);
    let combination = |mut index: usize| -> Vec<f64> {
        (0..count)
            .map(|_| {
                let value = candidates[index % number];
                index /= number;
                value
            })
            .collect()
    };
    let all = alike.chain((0..MAX_INPUT_COMBINATIONS).map(combination)).take(if count == 0 {
        1
    } else {
        MAX_INPUT_COMBINATIONS
    });
    all.map(|values| setup(&values)).find(|setup| count == 0 || engine.state(setup, 0.0).is_ok())
}

/// The first parameter with which the mechanism moves when it is a tenth smaller and when it is a tenth larger.
fn varied(engine: &mut dyn Engine, setup: &Setup) -> Option<String> {
    let model: &Model = engine.model();
    let began = Instant::now();
    for (index, value) in engine.parameters().into_iter().enumerate().filter(|(_, value)| value.is_finite()).take(8) {
        if began.elapsed() >= TIME_LIMIT {
            return None;
        }
        let by = if value == 0.0 { 0.1 } else { 0.1 * value.abs() };
        let [low, high] = [shortened(value - by), shortened(value + by)];
        let moves = |engine: &mut dyn Engine, value: f64| {
            let end = engine.set_parameter(index, value).then(|| natural_end(&*engine, setup, 0.0));
            end.and_then(|end| reached(&*engine, setup, end)).is_some()
        };
        let both_move = moves(engine, low) && moves(engine, high);
        engine.set_parameter(index, value);
        if both_move && low < high {
            return Some(format!("{}={}..{}:5", model.parameters[index].name, rounded(low), rounded(high)));
        }
    }
    None
}

/// Rounded towards zero to two digits.
fn shortened(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    let places = 1 - value.abs().log10().floor() as i32;
    let factor = 10_f64.powi(places);
    // Parsed from a decimal, so that the result is 0.29 and not 0.28999999999999998.
    let digits = (value * factor * (1.0 + 1e-12)).trunc();
    format!("{digits}e{}", -places).parse().unwrap_or(value)
}

/// Quotes a text with brackets, which a shell would interpret.
pub(super) fn quoted(text: String) -> String {
    if text.contains('[') { format!("'{text}'") } else { text }
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0, 1.2345, -0.098_76, 0.29, 6.93].map(shortened), [0.0, 1.2, -0.098, 0.29, 6.9]);
        assert_eq!([2e-9, 123_456.0].map(shortened), [2e-9, 120_000.0]);
    }
}

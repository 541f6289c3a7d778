//! Settings of a solver: tolerances, guesses, prescribed coordinates, modes, inputs, observer.

use super::Solver;
use crate::analysis::forces::Sharing;
use crate::course::InputFunction;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::observer::Observer;
use crate::options::Options;
use crate::planned::{ModeKey, Sign};
use crate::signal::Signal;
use crate::state::State;
use core::fmt;

/// The settings of a solver, which do not depend on the type of the mechanism.
#[derive(Clone, Default)]
pub(crate) struct Settings<'m> {
    pub(crate) options: Options,
    /// Guesses of the caller, which prevail over those of the mechanism.
    pub(crate) guesses: Vec<(usize, f64)>,
    /// Prescribed coordinates with their signals at the first instant.
    pub(crate) given: Vec<(usize, Signal)>,
    /// Requested modes: the key, the index of the mode if there is one, and its sign.
    pub(crate) modes: Vec<(String, Option<usize>, Sign)>,
    pub(crate) inputs: InputFunction<'m>,
    pub(crate) observer: Option<Observer<'m>>,
    /// How redundant rows share a load.
    pub(crate) sharing: Sharing,
}

impl Settings<'_> {
    /// Requests the sign of a mode.
    pub(crate) fn request(&mut self, model: &Model, mode: ModeKey<'_>, sign: Sign) {
        self.modes.push((mode.to_string(), mode.index_in(model.plan.modes), sign));
    }

    /// Prescribes a coordinate.
    pub(crate) fn prescribe(&mut self, coordinate: usize, signal: Signal) {
        self.given.retain(|&(k, _)| k != coordinate);
        self.given.push((coordinate, signal));
    }

    /// The prescribed coordinates at a state. In a sweep their signals belong to its first instant, so that those at
    /// another state follow from the state itself.
    pub(crate) fn given_at(&self, state: &State) -> Vec<(usize, Signal)> {
        let numbers_of = |k: usize| Some(Signal::new(*state.q.get(k)?, *state.q_dot.get(k)?, *state.q_ddot.get(k)?));
        let is_finite = |u: &Signal| [u.value, u.rate, u.acceleration].iter().all(|x| x.is_finite());
        let signal_at = |&(k, signal): &(usize, Signal)| (k, numbers_of(k).filter(is_finite).unwrap_or(signal));
        self.given.iter().map(signal_at).collect()
    }

    /// The same without functions of the caller.
    pub(crate) fn without_functions(&self) -> Settings<'static> {
        let Self { options, guesses, given, modes, sharing, .. } = self.clone();
        Settings { options, guesses, given, modes, inputs: None, observer: None, sharing }
    }

    /// The same with these guesses and signs of modes, by their indices.
    pub(crate) fn starting_from(mut self, model: &Model, guesses: &[(usize, f64)], modes: &[(usize, Sign)]) -> Self {
        self.guesses.extend(guesses);
        modes.iter().for_each(|&(mode, sign)| self.request(model, mode.into(), sign));
        self
    }

    fn write(&self, model: &Model, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "solver of {}", model.name)?;
        for (index, signal) in &self.given {
            write!(f, ", {} = {}", model.coordinates.get(*index).map_or("?", |c| c.name), signal.value)?;
        }
        self.modes.iter().try_for_each(|(mode, _, sign)| write!(f, ", mode {mode} = {sign}"))
    }
}

impl<'m, M: Mechanism> Solver<'m, M> {
    /// Replaces tolerances and limits.
    #[must_use]
    pub fn with_options(mut self, options: Options) -> Self {
        self.settings.options = options;
        self
    }

    /// Whether a sweep ends at its first event: its trajectory then has the states before the event and the one at it,
    /// and [`Trajectory::stopped`](crate::Trajectory::stopped) is true. A sweep that begins at the last state
    /// ([`sweep_from`](Self::sweep_from)) does not meet this event again, and goes on to the next one.
    #[must_use]
    pub fn stop_at_events(mut self, stop: bool) -> Self {
        self.settings.options.stop_at_events = stop;
        self
    }

    /// Guesses a coordinate (index in q) as start of assembly, instead of the mechanism's own guess.
    #[must_use]
    pub fn with_guess(mut self, coordinate: usize, value: f64) -> Self {
        self.settings.guesses.push((coordinate, value));
        self
    }

    /// Requests an assembly mode, by its name or its index in [`Kinematics::modes`](crate::Kinematics::modes).
    ///
    /// Assembly from guesses first proceeds as without this setting. Then the plan solves in the requested modes, with
    /// all other modes as the guesses determine them, and full Newton corrects the result. Analyses from a complete
    /// start have the modes of that start.
    #[must_use]
    pub fn with_mode<'k>(mut self, mode: impl Into<ModeKey<'k>>, sign: Sign) -> Self {
        self.settings.request(M::model(), mode.into(), sign);
        self
    }

    /// Prescribes a coordinate (index in q): adds the row q_k − value, with its rate and acceleration.
    ///
    /// In a sweep the signal belongs to the first instant and continues with constant acceleration.
    #[must_use]
    pub fn with_given(mut self, coordinate: usize, signal: Signal) -> Self {
        self.settings.prescribe(coordinate, signal);
        self
    }

    /// Inputs as functions of time, for sweeps: writes value, rate and acceleration of every input at time t.
    #[must_use]
    pub fn with_inputs(mut self, inputs: &'m dyn Fn(f64, &mut [Signal])) -> Self {
        self.settings.inputs = Some(inputs);
        self
    }

    /// If redundant rows share a load, uses the possible forces of least norm in [`forces`](Self::forces),
    /// [`motion`](Self::motion) and [`measure`](Self::measure), as [`forces_of_least_norm`](Self::forces_of_least_norm)
    /// does.
    #[must_use]
    pub fn with_forces_of_least_norm(mut self) -> Self {
        self.settings.sharing = Sharing::LeastNorm;
        self
    }

    /// Sets an observer, which gets the progress of sweeps and checks and may end them with the error
    /// [`Stopped`](crate::SolveError::Stopped); a sweep keeps the instants that are finished.
    #[must_use]
    pub fn with_observer(mut self, observer: Observer<'m>) -> Self {
        self.settings.observer = Some(observer);
        self
    }

    /// The mechanism's guesses overridden by [`with_guess`](Self::with_guess), one entry per coordinate.
    pub fn guess(&self) -> Vec<Option<f64>> {
        let model = M::model();
        let mut values = vec![0.0; model.guesses.len()];
        let parameters = self.mechanism.parameters::<f64>();
        let written = self.mechanism.write_guesses(parameters.as_ref(), &mut values).is_ok();
        overridden(model, if written { &values } else { &[] }, &self.settings.guesses)
    }
}

/// Coordinates with guesses, those of the mechanism, which have these values, before those of the caller: later ones
/// prevail.
pub(super) fn all_guesses<'a>(
    model: &'a Model,
    values: &'a [f64],
    guesses: &'a [(usize, f64)],
) -> impl Iterator<Item = (usize, f64)> {
    model.guesses.iter().copied().zip(values.iter().copied()).chain(guesses.iter().copied())
}

/// The guess of every coordinate.
fn overridden(model: &Model, values: &[f64], guesses: &[(usize, f64)]) -> Vec<Option<f64>> {
    let mut guess = vec![None; model.coordinates.len()];
    for (coordinate, value) in all_guesses(model, values, guesses) {
        if let Some(place) = guess.get_mut(coordinate) {
            *place = Some(value);
        }
    }
    guess
}

impl<M: Mechanism> Clone for Solver<'_, M> {
    fn clone(&self) -> Self {
        Self { mechanism: self.mechanism, settings: self.settings.clone() }
    }
}

/// The mechanism, its prescribed coordinates and its modes.
impl<M: Mechanism> fmt::Display for Solver<'_, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.settings.write(M::model(), f)
    }
}

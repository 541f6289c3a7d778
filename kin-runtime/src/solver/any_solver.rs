//! The thin generic layer of solvers: a solver without the type of its mechanism.
//!
//! Sweeps, searches for closures and for ranges, sensitivities and the watch of contacts work on `dyn AnySolver`, so
//! that they are compiled once, in this crate, and not again for every mechanism of the user.

use super::{Settings, Solver};
use crate::equations::Equations;
use crate::error::{SolveError, SweepError};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::modes::WantedAssembly;
use crate::plan::{Depth, Solved};
use crate::planned::{Limit, Sign};
use crate::proof::{Enclosures, OverBoxes, Winding};
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::trajectory::Trajectory;

/// A solver without the type of its mechanism.
pub(crate) trait AnySolver {
    /// The names, rows and patterns of the mechanism.
    fn model(&self) -> &'static Model;

    /// Options, guesses, prescribed coordinates, inputs.
    fn settings(&self) -> &Settings<'_>;

    /// All guesses, 0 for coordinates without one; an error if one of them is for a coordinate that does not exist.
    fn start(&self) -> Result<Vec<f64>, SolveError>;

    /// The equations at an instant.
    fn equations_at(&self, at: &Instant<'_>) -> Result<Equations<'_>, SolveError>;

    /// The equations at the instant of a solved state, with the prescribed coordinates of the state.
    fn equations_of_state(&self, state: &State) -> Result<Equations<'_>, SolveError>;

    /// q of the mechanism assembled from the guesses.
    fn assembled(&self, at: &Instant<'_>) -> Result<Vec<f64>, SolveError>;

    /// The modes and guesses that the assembly must satisfy.
    fn wanted_assembly(&self) -> Result<WantedAssembly, SolveError>;

    /// The state that the plan finds near a complete start, or else from the guesses; `None` if the general path must be
    /// used.
    fn planned_state(&self, at: &Instant<'_>, start: Option<&[f64]>) -> Option<State>;

    /// The state near a complete start, as [`Solver::state_from`].
    fn state_near_start(&self, at: &Instant<'_>, start: &[f64]) -> Result<State, SolveError>;

    /// The rows over boxes (an interval for every coordinate), at an instant.
    fn boxes(&self, at: &Instant<'_>) -> Box<dyn Enclosures + '_>;

    /// True if parameters are finite and the plan solves the mechanism without further checks.
    fn is_sound_plan(&self, at: &Instant<'_>) -> bool;

    /// Computes q, q̇ and q̈ by the plan.
    fn solve(
        &self,
        at: &Instant<'_>,
        signs: &[f64],
        start: &[f64],
        depth: Depth,
        solved: Solved<'_, f64>,
    ) -> Result<(), LengthError>;

    /// Computes q by the plan over intervals.
    fn solve_over(
        &self,
        at: &Instant<'_, Winding>,
        signs: &[Winding],
        start: &[Winding],
        solved: Solved<'_, Winding>,
    ) -> Result<(), LengthError>;

    /// A sweep from one time to another with these guesses and modes, and with inputs that continue from the instant
    /// `start` with constant acceleration: q at its end, or what ended it.
    fn moved(
        &self,
        start: &Instant<'_>,
        way: [f64; 2],
        guesses: &[(usize, f64)],
        modes: &[(usize, Sign)],
    ) -> Result<Vec<f64>, SweepEnd>;
}

/// What ended a motion.
#[derive(Default)]
pub(crate) struct SweepEnd {
    pub(crate) limit: Option<Limit>,
    /// q there; empty where it is not known.
    pub(crate) q: Vec<f64>,
}

impl<M: Mechanism> AnySolver for Solver<'_, M> {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn settings(&self) -> &Settings<'_> {
        &self.settings
    }

    fn start(&self) -> Result<Vec<f64>, SolveError> {
        Ok(or_zero(self.checked_guess()?))
    }

    fn equations_at(&self, at: &Instant<'_>) -> Result<Equations<'_>, SolveError> {
        self.equations(at)
    }

    fn equations_of_state(&self, state: &State) -> Result<Equations<'_>, SolveError> {
        self.equations_of(state)
    }

    fn assembled(&self, at: &Instant<'_>) -> Result<Vec<f64>, SolveError> {
        self.assemble(at)
    }

    fn wanted_assembly(&self) -> Result<WantedAssembly, SolveError> {
        self.wanted()
    }

    fn planned_state(&self, at: &Instant<'_>, start: Option<&[f64]>) -> Option<State> {
        self.state_by_plan(at, start)
    }

    fn state_near_start(&self, at: &Instant<'_>, start: &[f64]) -> Result<State, SolveError> {
        self.state_from(at, start)
    }

    fn boxes(&self, at: &Instant<'_>) -> Box<dyn Enclosures + '_> {
        Box::new(OverBoxes::new(self.mechanism, at))
    }

    fn is_sound_plan(&self, at: &Instant<'_>) -> bool {
        self.goes_by_plan(at) && self.mechanism.parameters::<f64>().as_ref().iter().all(|x| x.is_finite())
    }

    fn solve(
        &self,
        at: &Instant<'_>,
        signs: &[f64],
        start: &[f64],
        depth: Depth,
        solved: Solved<'_, f64>,
    ) -> Result<(), LengthError> {
        self.mechanism.solve_with(self.mechanism.parameters().as_ref(), at, signs, start, depth, solved)
    }

    fn solve_over(
        &self,
        at: &Instant<'_, Winding>,
        signs: &[Winding],
        start: &[Winding],
        solved: Solved<'_, Winding>,
    ) -> Result<(), LengthError> {
        self.mechanism.solve_with(self.mechanism.parameters().as_ref(), at, signs, start, Depth::Position, solved)
    }

    fn moved(
        &self,
        start: &Instant<'_>,
        way: [f64; 2],
        guesses: &[(usize, f64)],
        modes: &[(usize, Sign)],
    ) -> Result<Vec<f64>, SweepEnd> {
        let later = |t: f64, out: &mut [Signal]| continued(start, t, out);
        let settings = Settings { options: self.settings.options, inputs: Some(&later), ..Settings::default() };
        let settings = settings.starting_from(M::model(), guesses, modes);
        end_of(Solver { mechanism: self.mechanism, settings }.sweep(&way))
    }
}

/// Numbers, 0 for those that are missing.
fn or_zero(numbers: Vec<Option<f64>>) -> Vec<f64> {
    numbers.into_iter().map(|number| number.unwrap_or(0.0)).collect()
}

/// Writes the inputs of an instant continued to a time with constant acceleration.
fn continued(start: &Instant<'_>, t: f64, out: &mut [Signal]) {
    out.iter_mut().zip(start.inputs).for_each(|(out, u)| *out = u.after(t - start.t));
}

/// q at the end of a sweep, or what ended it.
fn end_of(sweep: Result<Trajectory, SweepError>) -> Result<Vec<f64>, SweepEnd> {
    match sweep {
        Ok(trajectory) => Ok(trajectory.states.into_iter().next_back().map(|state| state.q).unwrap_or_default()),
        Err(error) => {
            let q = error.q_at_limit().map(<[f64]>::to_vec).unwrap_or_default();
            Err(SweepEnd { limit: error.source.limit().copied(), q })
        }
    }
}

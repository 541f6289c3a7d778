//! Sweeps: the motion over a list of instants.

use super::{AnySolver, Solver};
use crate::course::InputFunction;
use crate::equations::Equations;
use crate::error::{SolveError, SweepError};
use crate::linear::Factorization;
use crate::mechanism::Mechanism;
use crate::modes::first_state;
use crate::observer::Observed;
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::sweep::continuation::{Visit, kinematic};
use crate::trajectory::Trajectory;
use core::ops::ControlFlow;

impl<'m, M: Mechanism> Solver<'m, M> {
    /// The motion over `times`, in any order and at any distances: the branch is followed from the first instant, at
    /// which the mechanism is assembled from the guesses, to the last.
    ///
    /// Between two instants as many steps are taken as the motion needs by its velocities and accelerations. Drivers and
    /// curves that are written as formulas are enclosed over every step, and so are supplied functions that
    /// [enclose](crate::ScalarFunction::enclose) their values, as splines and sequences do: a peak, a pole or a gap is
    /// found down to a millionth of a step. Of other supplied functions and of inputs an excursion causes no error, even
    /// one past a dead centre, if they rest at both ends of a step and the excursion is much narrower than the step.
    /// Choose instants on every rise and dwell of such a function.
    ///
    /// # Errors
    /// As [`state`](Self::state) for the first instant; then [`Singular`](SolveError::Singular) or
    /// [`StepRefused`](SolveError::StepRefused) where the branch ends, with the states before it.
    pub fn sweep(&self, times: &[f64]) -> Result<Trajectory, SweepError> {
        swept(self, times, None, None)
    }

    /// As [`sweep`](Self::sweep), but states are passed to `visit` one by one and not kept: the memory of a state is
    /// reused for the next one. If the plan solves the mechanism, the memory does not grow with the number of instants.
    ///
    /// Returns the trajectory without states: its events, fallbacks and what could not be watched.
    ///
    /// ```
    /// use kin_runtime::{Kinematics, mechanism};
    /// use std::ops::ControlFlow;
    ///
    /// #[mechanism]
    /// #[bodies(crank, piston)]
    /// #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
    /// #[distance(rod: crank @ (0.1, 0), piston @ (0, 0), length = 0.3)]
    /// #[translational(slide: ground @ (0, 0), piston @ (0, 0), axis = (1, 0))]
    /// #[driver(drive: crank.phi = 3*t)]
    /// #[guess(piston.x = 0.4)]
    /// struct Pump;
    ///
    /// # fn main() -> Result<(), kin_runtime::SweepError> {
    /// let times: Vec<f64> = (0..=1000).map(|k| 0.002 * f64::from(k)).collect();
    /// let mut fastest: f64 = 0.0;
    /// Pump.solver().sweep_each(&times, |state| {
    ///     fastest = fastest.max(state[Pump::piston].x_dot.abs());
    ///     ControlFlow::Continue(())
    /// })?;
    /// assert!(fastest > 0.3 && fastest < 0.33);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`sweep`](Self::sweep), and [`Stopped`](SolveError::Stopped) where `visit` ends it before the last instant.
    pub fn sweep_each(
        &self,
        times: &[f64],
        mut visit: impl FnMut(&State) -> ControlFlow<()>,
    ) -> Result<Trajectory, SweepError> {
        swept(self, times, None, Some(&mut visit))
    }

    /// [`sweep`](Self::sweep) from a complete start, n numbers.
    ///
    /// # Errors
    /// As [`sweep`](Self::sweep).
    pub fn sweep_from(&self, start: &[f64], times: &[f64]) -> Result<Trajectory, SweepError> {
        swept(self, times, Some(start), None)
    }
}

/// A sweep from a complete start or from the guesses; its states are passed to `visit`, or kept without it.
pub(crate) fn swept(
    solver: &dyn AnySolver,
    times: &[f64],
    start: Option<&[f64]>,
    visit: Option<&mut Visit<'_>>,
) -> Result<Trajectory, SweepError> {
    let Some(&t) = times.first() else { return Ok(Trajectory::new(solver.model())) };
    match started(solver, t, start) {
        Ok((mut equations, first)) => {
            equations.observed = Observed::new(solver.settings().observer, times.len());
            kinematic(&mut equations, first, times, visit)
        }
        Err(source) => Err(SweepError { trajectory: Box::new(Trajectory::new(solver.model())), source }),
    }
}

/// The equations of a sweep and its first state, found by the plan or, where it has no solution, by position analysis, with
/// the factorisation of Φ_q if it was evaluated there last.
fn started<'s>(
    solver: &'s dyn AnySolver,
    t: f64,
    start: Option<&[f64]>,
) -> Result<(Equations<'s>, (State, Option<Factorization>)), SolveError> {
    let inputs = inputs_at(solver.settings().inputs, t, solver.model().inputs.len());
    let at = Instant { t, inputs: &inputs };
    let mut equations = solver.equations_at(&at)?;
    if let Some(state) = solver.planned_state(&at, start) {
        return Ok((equations, (state, None)));
    }
    let (state, factor) = first_state(&mut equations, start, || solver.wanted_assembly())?;
    Ok((equations, (state, Some(factor))))
}

/// The inputs at an instant; empty where they are not functions of time.
pub(super) fn inputs_at(function: InputFunction<'_>, t: f64, count: usize) -> Vec<Signal> {
    let Some(function) = function else { return Vec::new() };
    let mut inputs = vec![Signal::default(); count];
    function(t, &mut inputs);
    inputs
}

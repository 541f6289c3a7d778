//! Sweeps: the motion over a list of instants.

use super::{Position, Solver};
use crate::analysis;
use crate::analysis::position::position;
use crate::equations::Equations;
use crate::equations::system::Evaluator;
use crate::error::{SolveError, SweepError};
use crate::linear::Factorization;
use crate::mechanism::Mechanism;
use crate::modes::assemble_in;
use crate::observer::Observed;
use crate::state::State;
use crate::sweep::continuation::{kinematic, kinematic_each};
use crate::trajectory::Trajectory;
use crate::workspace::{Instant, Signal};
use core::ops::ControlFlow;

impl<'m, M: Mechanism> Solver<'m, M> {
    /// The motion over `times`, in whatever order and distance: the branch is followed from the first, which is
    /// assembled from the guesses, to the last.
    ///
    /// # Errors
    /// As [`state`](Self::state) for the first instant; then [`Singular`](SolveError::Singular) or
    /// [`StepRefused`](SolveError::StepRefused) where the branch ends, with the states before it.
    pub fn sweep(&self, times: &[f64]) -> Result<Trajectory, SweepError> {
        let first = |equations: &mut Equations<'_>| assemble_in(equations, &self.wanted()?);
        self.follow(times, |at| self.state_by_plan(at), first, kinematic)
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
        let first = |equations: &mut Equations<'_>| assemble_in(equations, &self.wanted()?);
        let each = |equations: &mut Equations<'_>, first: (State, _), times: &[f64]| {
            kinematic_each(equations, first, times, &mut visit)
        };
        self.follow(times, |at| self.state_by_plan(at), first, each)
    }

    /// [`sweep`](Self::sweep) from a complete start, n numbers.
    ///
    /// # Errors
    /// As [`sweep`](Self::sweep).
    pub fn sweep_from(&self, start: &[f64], times: &[f64]) -> Result<Trajectory, SweepError> {
        self.follow(times, |at| self.state_near(at, start), |equations| position(equations, start), kinematic)
    }

    /// A sweep from the state that the plan finds or, where it finds none, from the position that `first` finds.
    fn follow(
        &self,
        times: &[f64],
        by_plan: impl FnOnce(&Instant<'_>) -> Option<State>,
        first: impl FnOnce(&mut Equations<'_>) -> Result<Position, SolveError>,
        onwards: impl FnOnce(&mut Equations<'_>, (State, Option<Factorization>), &[f64]) -> Result<Trajectory, SweepError>,
    ) -> Result<Trajectory, SweepError> {
        let nothing = || Trajectory::new(M::model());
        let Some(&t) = times.first() else { return Ok(nothing()) };
        let mut inputs = Vec::new();
        if let Some(function) = self.inputs {
            inputs.resize(M::INPUTS, Signal::default());
            function(t, &mut inputs);
        }
        let evaluator = Box::new(Evaluator::<_, M>::new(self.mechanism));
        let at = Instant { t, inputs: &inputs };
        let started =
            Equations::new(evaluator, self.options, &self.given, self.inputs, &at).and_then(|mut equations| {
                let first = match by_plan(&at) {
                    Some(state) => (state, None),
                    None => {
                        let position = first(&mut equations)?;
                        let (state, factor) = analysis::state(&mut equations, position)?;
                        (state, Some(factor))
                    }
                };
                Ok((equations, first))
            });
        match started {
            Ok((mut equations, first)) => {
                equations.observed = Observed::new(self.observer, times.len());
                onwards(&mut equations, first, times)
            }
            Err(source) => Err(SweepError { trajectory: Box::new(nothing()), source }),
        }
    }
}

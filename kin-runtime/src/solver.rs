//! The analyses of one mechanism, with its options, guesses and prescribed coordinates.

use crate::cross_check::{CrossCheck, CrossCheckOptions};
use crate::error::{SolveError, SweepError};
use crate::mechanism::Mechanism;
use crate::mobility::Mobility;
use crate::model::Point;
use crate::motion::Motion;
use crate::options::Options;
use crate::ratios::VelocityRatios;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::transmission::TransmissionAngle;
use crate::workspace::{Instant, Signal};
use nalgebra::DMatrix;

/// An assembled position.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Position {
    /// q, n numbers.
    pub q: Vec<f64>,
    /// Iterations it took.
    pub iterations: usize,
    /// Largest |Φ_i|, in the rows' own units.
    pub residual: f64,
}

/// Position, velocity and acceleration analysis of one mechanism.
///
/// ```text
/// Φ(q, t) = 0        Φ_q q̇ = −Φ_t        Φ_q q̈ = γ
/// ```
///
/// Where degrees of freedom are left, every answer is the one of least Euclidean norm over q: the shortest correction
/// of the start, the smallest q̇, the smallest q̈. Prescribe coordinates with [`with_given`](Self::with_given), or add
/// drivers, for one that means something.
pub struct Solver<'m, M: Mechanism> {
    pub(crate) mechanism: &'m M,
    pub(crate) options: Options,
    pub(crate) guesses: Vec<(usize, f64)>,
    pub(crate) given: Vec<(usize, Signal)>,
    pub(crate) inputs: Option<&'m dyn Fn(f64, &mut [Signal])>,
}

impl<M: Mechanism> Clone for Solver<'_, M> {
    fn clone(&self) -> Self {
        Self {
            mechanism: self.mechanism,
            options: self.options,
            guesses: self.guesses.clone(),
            given: self.given.clone(),
            inputs: self.inputs,
        }
    }
}

impl<'m, M: Mechanism> Solver<'m, M> {
    /// A solver with default options and the mechanism's own guesses.
    pub fn new(mechanism: &'m M) -> Self {
        Self { mechanism, options: Options::default(), guesses: Vec::new(), given: Vec::new(), inputs: None }
    }

    /// Replaces tolerances and limits.
    #[must_use]
    pub fn with_options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// Guesses a coordinate (place in q) as start of assembly, instead of the mechanism's own guess.
    #[must_use]
    pub fn with_guess(mut self, coordinate: usize, value: f64) -> Self {
        self.guesses.push((coordinate, value));
        self
    }

    /// Prescribes a coordinate (place in q): adds the row q_k − value, with its rate and acceleration.
    ///
    /// A sweep takes value, rate and acceleration at its first instant and goes on with that acceleration.
    #[must_use]
    pub fn with_given(mut self, coordinate: usize, signal: Signal) -> Self {
        self.given.retain(|&(k, _)| k != coordinate);
        self.given.push((coordinate, signal));
        self
    }

    /// Inputs as functions of time, for sweeps: writes value, rate and acceleration of every input at time t.
    #[must_use]
    pub fn with_inputs(mut self, inputs: &'m dyn Fn(f64, &mut [Signal])) -> Self {
        self.inputs = Some(inputs);
        self
    }

    /// The mechanism's guesses overridden by [`with_guess`](Self::with_guess), one entry per coordinate.
    pub fn guess(&self) -> Vec<Option<f64>> {
        todo!()
    }

    /// Assembles the mechanism from the guesses; coordinates without a guess are found.
    ///
    /// # Errors
    pub fn assemble(&self, at: &Instant<'_>) -> Result<Vec<f64>, SolveError> {
        let _ = at;
        todo!()
    }

    /// Position analysis from a complete start, n numbers: the configuration near it.
    ///
    /// # Errors
    pub fn position(&self, at: &Instant<'_>, start: &[f64]) -> Result<Position, SolveError> {
        let _ = (at, start);
        todo!()
    }

    /// Velocity analysis of an assembled configuration: q̇ with Φ_q q̇ = −Φ_t.
    ///
    /// # Errors
    pub fn velocity(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, SolveError> {
        let _ = (at, q);
        todo!()
    }

    /// Acceleration analysis: q̈ with Φ_q q̈ = γ.
    ///
    /// # Errors
    pub fn acceleration(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, SolveError> {
        let _ = (at, q, q_dot);
        todo!()
    }

    /// Assembly from the guesses, then velocity and acceleration.
    ///
    /// # Errors
    pub fn state(&self, at: &Instant<'_>) -> Result<State, SolveError> {
        let _ = at;
        todo!()
    }

    /// Position analysis from a complete start, then velocity and acceleration.
    ///
    /// # Errors
    pub fn state_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<State, SolveError> {
        let _ = (at, start);
        todo!()
    }

    /// The motion over `times`, in whatever order and distance: the branch is followed from the first, which is
    /// assembled from the guesses, to the last.
    ///
    /// # Errors
    pub fn sweep(&self, times: &[f64]) -> Result<Trajectory, SweepError> {
        let _ = times;
        todo!()
    }

    /// [`sweep`](Self::sweep) from a complete start.
    ///
    /// # Errors
    pub fn sweep_from(&self, start: &[f64], times: &[f64]) -> Result<Trajectory, SweepError> {
        let _ = (start, times);
        todo!()
    }

    /// Motion of bodies, points, defines and joints.
    ///
    /// # Errors
    pub fn motion(&self, state: &State) -> Result<Motion, SolveError> {
        let _ = state;
        todo!()
    }

    /// Degrees of freedom, independent coordinates, redundant rows and conditioning at a configuration.
    ///
    /// # Errors
    pub fn mobility(&self, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError> {
        let _ = (at, q);
        todo!()
    }

    /// Velocity ratios and second-order ratios per driving row.
    ///
    /// # Errors
    pub fn velocity_ratios(&self, state: &State) -> Result<VelocityRatios, SolveError> {
        let _ = state;
        todo!()
    }

    /// ∂r_P/∂q of a named point, 2×n.
    ///
    /// # Errors
    pub fn point_jacobian(&self, at: &Instant<'_>, q: &[f64], point: Point) -> Result<DMatrix<f64>, SolveError> {
        let _ = (at, q, point);
        todo!()
    }

    /// Transmission angles at all revolute joints between two moving bodies.
    ///
    /// # Errors
    pub fn transmission_angles(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<TransmissionAngle>, SolveError> {
        let _ = (at, q);
        todo!()
    }

    /// Every entry of Φ_q, Φ_t and γ against dual numbers.
    ///
    /// # Errors
    pub fn cross_check(&self, options: &CrossCheckOptions) -> Result<CrossCheck, SolveError> {
        let _ = options;
        todo!()
    }
}

//! What the methods need of a mechanism, as trait objects, so that they are compiled once.

use crate::case::{Case, Group, Inputs};
use kin_runtime::batch::{BatchError, Moment, Motions, Sweeps, always, sweep};
use kin_runtime::model::Model;
use kin_runtime::{
    Instant, Kinematics, Lanes, LengthError, Options, PlanError, Planned, Signal, SolveError, State, SweepError,
    Tracker, Trajectory,
};
use std::fmt::Debug;

/// The states of a block of a batch, instant by instant.
pub(crate) type Seen = Vec<[Vec<Lanes>; 3]>;

/// A mechanism without its type.
pub(crate) trait Moving: Debug {
    /// The names, the rows and the plan.
    fn model(&self) -> &'static Model;

    /// The values of the parameters.
    fn own_parameters(&self) -> Vec<f64>;

    /// Φ, the non-zeros of Φ_q, and Φ_t.
    fn equations(&self, at: &Instant<'_>, q: &[f64]) -> Result<[Vec<f64>; 3], LengthError>;

    /// A sweep from a configuration.
    fn sweep_from(
        &self,
        options: Options,
        inputs: &Inputs,
        start: &[f64],
        times: &[f64],
    ) -> Result<Trajectory, SweepError>;

    /// A single state near a configuration.
    fn state_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<State, SolveError>;

    /// A tracker from a configuration.
    fn tracker_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<Tracker<'_>, SolveError>;

    /// A follower of the plan from a configuration.
    fn planned(&self, at: &Instant<'_>, start: &[f64]) -> Result<Box<dyn Follower + '_>, PlanError>;

    /// A batch of motions.
    fn sweep_batch(&self, sweeps: &Sweeps<'_>, out: &mut Motions<Seen>) -> Result<(), BatchError>;
}

impl<M: Kinematics + Sync + Debug> Moving for M {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn own_parameters(&self) -> Vec<f64> {
        self.parameters::<f64>().as_ref().to_vec()
    }

    fn equations(&self, at: &Instant<'_>, q: &[f64]) -> Result<[Vec<f64>; 3], LengthError> {
        let (phi, phi_q) = (self.constraints(at, q)?, self.jacobian(at, q)?);
        let phi_t = self.time_derivative(at, q)?;
        Ok([phi.as_ref().to_vec(), phi_q.as_ref().to_vec(), phi_t.as_ref().to_vec()])
    }

    fn sweep_from(
        &self,
        options: Options,
        inputs: &Inputs,
        start: &[f64],
        times: &[f64],
    ) -> Result<Trajectory, SweepError> {
        let mut solver = self.solver().with_options(options);
        if M::INPUTS > 0 {
            solver = solver.with_inputs(&**inputs);
        }
        solver.sweep_from(start, times)
    }

    fn state_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<State, SolveError> {
        self.solver().state_from(at, start)
    }

    fn tracker_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<Tracker<'_>, SolveError> {
        self.solver().tracker_from(at, start)
    }

    fn planned(&self, at: &Instant<'_>, start: &[f64]) -> Result<Box<dyn Follower + '_>, PlanError> {
        Ok(Box::new(Planned::new(self, at, start)?))
    }

    fn sweep_batch(&self, sweeps: &Sweeps<'_>, out: &mut Motions<Seen>) -> Result<(), BatchError> {
        sweep(self, sweeps, out, &always, see)
    }
}

fn see(seen: &mut Seen, moment: &Moment<'_>) {
    seen.push([moment.q, moment.q_dot, moment.q_ddot].map(<[Lanes]>::to_vec));
}

/// A follower of a plan.
pub(crate) trait Follower {
    /// q, q̇ and q̈ at another instant.
    fn at(&mut self, at: &Instant<'_>) -> Result<[Vec<f64>; 3], PlanError>;
}

impl<M: Kinematics> Follower for Planned<'_, M> {
    fn at(&mut self, at: &Instant<'_>) -> Result<[Vec<f64>; 3], PlanError> {
        let found = self.at(at)?;
        Ok([found.q().to_vec(), found.q_dot().to_vec(), found.q_ddot().to_vec()])
    }
}

/// The cases of a group without the type of their mechanisms.
pub(crate) struct AnyGroup<'g> {
    pub(crate) times: &'g [f64],
    pub(crate) cases: Vec<&'g Case<dyn Moving + 'g>>,
    pub(crate) inputs: &'g Inputs,
}

impl<'g> AnyGroup<'g> {
    pub(crate) fn new<M: Kinematics + Sync + Debug>(group: &'g Group<M>) -> Self {
        let mut cases: Vec<&Case<dyn Moving + 'g>> = Vec::new();
        for case in &group.cases {
            cases.push(case);
        }
        Self { times: &group.times, cases, inputs: &group.inputs }
    }

    /// The inputs of a mechanism at an instant.
    pub(crate) fn told(&self, model: &Model, t: f64) -> Vec<Signal> {
        let mut inputs = vec![Signal::default(); model.inputs.len()];
        (self.inputs)(t, &mut inputs);
        inputs
    }
}

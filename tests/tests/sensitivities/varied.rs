//! A mechanism whose derivatives are compared, without its type, so that a law about all mechanisms is compiled once.

use kin_runtime::batch::{BatchError, Problems, SensitivitySolutions, Solutions, always, sensitivities, solve};
use kin_runtime::model::Model;
use kin_runtime::plan::Depth;
use kin_runtime::{
    Forces, Instant, Kinematics, Measure, Mechanism, Options, Sensitivities, Signal, SolveError, State, Trajectory,
};
use kin_tests::mechanisms::{signals, write_signals};

/// A mechanism.
pub(crate) trait Varied {
    fn model(&self) -> &'static Model;

    fn parameters(&self) -> Vec<f64>;

    /// The same mechanism with its default parameters, except for one.
    fn with_parameter(&self, index: usize, value: f64) -> Box<dyn Varied>;

    /// The inputs of this test mechanism at time t.
    fn signals(&self, t: f64) -> Vec<Signal>;

    /// A motion with these inputs.
    fn sweep(&self, times: &[f64]) -> Trajectory;

    fn state_from(&self, at: &Instant<'_>, q: &[f64]) -> Result<State, SolveError>;

    fn forces(&self, state: &State) -> Result<Forces, SolveError>;

    fn measure(&self, state: &State, measures: &[Measure]) -> Vec<f64>;

    fn sensitivities(&self, state: &State, options: Options) -> Result<Sensitivities, SolveError>;

    fn measure_sensitivities(&self, state: &State, measures: &[Measure], parameters: &[usize]) -> Vec<Vec<f64>>;

    fn gradient(&self, state: &State, measures: &[Measure], weights: &[f64]) -> Result<Vec<f64>, SolveError>;

    /// Solves a batch and computes the derivatives of its configurations; whether each of these is solved.
    fn batch(
        &self,
        problems: &Problems<'_>,
        measures: &[Measure],
        parameters: &[usize],
        out: &mut SensitivitySolutions,
    ) -> Result<Vec<bool>, BatchError>;
}

impl<M: Kinematics + Default + Sync + 'static> Varied for M {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn parameters(&self) -> Vec<f64> {
        Mechanism::parameters::<f64>(self).as_ref().to_vec()
    }

    fn with_parameter(&self, index: usize, value: f64) -> Box<dyn Varied> {
        let mut changed = M::default();
        assert!(changed.set_parameter(index, value));
        Box::new(changed)
    }

    fn signals(&self, t: f64) -> Vec<Signal> {
        signals::<M>(t)
    }

    fn sweep(&self, times: &[f64]) -> Trajectory {
        self.solver().with_inputs(&write_signals::<M>).sweep(times).unwrap()
    }

    fn state_from(&self, at: &Instant<'_>, q: &[f64]) -> Result<State, SolveError> {
        self.solver().state_from(at, q)
    }

    fn forces(&self, state: &State) -> Result<Forces, SolveError> {
        self.solver().forces(state)
    }

    fn measure(&self, state: &State, measures: &[Measure]) -> Vec<f64> {
        self.solver().measure(state, measures).unwrap()
    }

    fn sensitivities(&self, state: &State, options: Options) -> Result<Sensitivities, SolveError> {
        self.solver().with_options(options).sensitivities(state)
    }

    fn measure_sensitivities(&self, state: &State, measures: &[Measure], parameters: &[usize]) -> Vec<Vec<f64>> {
        self.solver().measure_sensitivities(state, measures, parameters).unwrap()
    }

    fn gradient(&self, state: &State, measures: &[Measure], weights: &[f64]) -> Result<Vec<f64>, SolveError> {
        self.solver().gradient(std::slice::from_ref(state), measures, weights)
    }

    fn batch(
        &self,
        problems: &Problems<'_>,
        measures: &[Measure],
        parameters: &[usize],
        out: &mut SensitivitySolutions,
    ) -> Result<Vec<bool>, BatchError> {
        let mut solutions = Solutions::<M>::new(out.count());
        let _ = solve(self, Depth::Position, problems, &mut solutions, &always);
        sensitivities(self, problems, &solutions, measures, parameters, out, &always)?;
        Ok(solutions.solved().collect())
    }
}

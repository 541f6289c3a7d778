//! One objective, many parameters: the plan is evaluated once, its operations are recorded, and one backward pass gives
//! the gradient.

use super::variation::{MAX_STACK_COORDINATES, modes_of};
use super::{is_integrated, is_same};
use crate::analysis::forces::masses_are_not_negative;
use crate::error::SolveError;
use crate::measure::{Measure, Needs};
use crate::mechanism::{LengthError, Mechanism, Observations};
use crate::model::Model;
use crate::plan::{Plan, Solved};
use crate::results::varied::Varied;
use crate::scalar::Scalar;
use crate::scalar::compare::all_finite;
use crate::scalar::recorded::{Recorded, accumulate, variables};
use crate::signal::{Instant, Signal};
use crate::solver::Solver;
use crate::state::State;

impl<M: Mechanism> Solver<'_, M> {
    /// The gradient of Σ weight · quantity over the states of a motion with respect to all parameters, in the order of
    /// [`Model::parameters`](crate::model::Model::parameters).
    ///
    /// `weights` has a number per state and quantity, state by state: the derivatives of an objective with respect to
    /// these quantities. The cost per state does not grow with the number of parameters, unlike that of
    /// [`measure_sensitivities`](Self::measure_sensitivities), whose weighted sum it is; where the plan has no
    /// solution, and for forces without a closed form, it is computed as that sum. The instants, inputs and assembly
    /// modes are kept fixed.
    ///
    /// ```
    /// use kin_runtime::{Kinematics, Measure, Mechanism, mechanism};
    ///
    /// /// A crank whose end is at (l cos t, l sin t).
    /// #[mechanism]
    /// #[bodies(crank)]
    /// #[point(tip = crank @ (l, 0))]
    /// #[revolute(pin: ground @ (0, 0), crank @ (0, 0))]
    /// #[driver(drive: crank.phi = t)]
    /// struct Crank {
    ///     #[param(0.2)]
    ///     l: f64,
    /// }
    ///
    /// let crank = Crank::default();
    /// let solver = crank.solver();
    /// let motion = solver.sweep(&[0.0, 0.5, 1.0])?;
    /// // F = ½ Σ (tip.y − 0.1)².
    /// let height: Vec<Measure> = Measure::named(Crank::model(), "tip.y").into_iter().collect();
    /// let misses: Vec<f64> = motion.states.iter().map(|state| state[Crank::tip].r[1] - 0.1).collect();
    /// let gradient = solver.gradient(&motion.states, &height, &misses)?;
    /// let exact: f64 = [0.0_f64, 0.5, 1.0].iter().map(|t| (0.2 * t.sin() - 0.1) * t.sin()).sum();
    /// assert!((gradient[0] - exact).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`measure_sensitivities`](Self::measure_sensitivities); [`Length`](SolveError::Length) when there are not as many
    /// weights as states times quantities; [`NoSensitivity`](SolveError::NoSensitivity) where a quantity with a weight has
    /// no derivative.
    pub fn gradient(&self, states: &[State], measures: &[Measure], weights: &[f64]) -> Result<Vec<f64>, SolveError> {
        let expected = states.len() * measures.len();
        if weights.len() != expected {
            return Err(LengthError { what: "weights", expected, found: weights.len() }.into());
        }
        let mut gradient = vec![0.0; M::PARAMETERS];
        if measures.is_empty() {
            return Ok(gradient);
        }
        let model = M::model();
        let usable = self.settings.options.use_plan && self.settings.given.is_empty() && model.plan.exists();
        let determined = !is_integrated(model) && !model.plan.has_redundant_rows();
        let backwards = usable && determined && have_derivatives(measures) && M::COORDINATES <= MAX_STACK_COORDINATES;
        let mut work = Work::<M>::new(measures);
        let all: Vec<usize> = (0..M::PARAMETERS).collect();
        for (state, weights) in states.iter().zip(weights.chunks(measures.len())) {
            let before = gradient.clone();
            let done = backwards
                && state.degrees_of_freedom_left == 0
                && work.add(self.mechanism, state, (measures, weights), &mut gradient)?;
            if !(done && all_finite(&gradient)) {
                gradient = before;
                let slopes = self.measure_sensitivities(state, measures, &all)?;
                add_weighted(M::model(), state.t, (&slopes, weights), &mut gradient)?;
            }
        }
        Ok(gradient)
    }
}

/// Whether all quantities have derivatives; those that are held have the derivative 0.
fn have_derivatives(measures: &[Measure]) -> bool {
    measures.iter().all(|measure| measure.has_derivatives() || measure.is_held())
}

/// Adds the weighted derivatives of quantities with respect to all parameters.
fn add_weighted(
    model: &Model,
    t: f64,
    (slopes, weights): (&[Vec<f64>], &[f64]),
    gradient: &mut [f64],
) -> Result<(), SolveError> {
    for (slopes, &weight) in slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
        gradient.iter_mut().zip(slopes).for_each(|(by, slope)| *by += weight * slope);
    }
    match gradient.iter().position(|by| !by.is_finite()) {
        None => Ok(()),
        Some(index) => Err(SolveError::NoSensitivity { t, parameter: model.parameters[index].name, row_name: None }),
    }
}

/// Buffers that are overwritten for every state.
struct Work<M: Mechanism> {
    needs: Needs,
    varied: Varied<Recorded>,
    observations: Box<Observations<M, Recorded>>,
}

impl<M: Mechanism> Work<M> {
    fn new(measures: &[Measure]) -> Self {
        let needs = Needs::of(measures);
        Self { needs, varied: Varied::default(), observations: Box::new(M::observations()) }
    }

    /// Adds the gradient at a state; false where the plan has no valid solution. An error for a negative mass.
    fn add(
        &mut self,
        mechanism: &M,
        state: &State,
        (measures, weights): (&[Measure], &[f64]),
        gradient: &mut [f64],
    ) -> Result<bool, SolveError> {
        let model = M::model();
        let Some(modes) = modes_of(mechanism, state)? else { return Ok(false) };
        let parameters = variables(mechanism.parameters::<f64>().as_ref());
        let number = Recorded::from_f64;
        let inputs = constant_inputs(&state.inputs);
        let at = Instant { t: number(state.t), inputs: &inputs };
        let (start, signs) = (constants(&state.q), constants(modes.of_closures()));
        let Varied { q, q_dot, q_ddot, margins, observed, geometry, forces } = &mut self.varied;
        fill_with_zeros(margins, model.plan.margins);
        for list in [&mut *q, &mut *q_dot, &mut *q_ddot] {
            fill_with_zeros(list, M::COORDINATES);
        }
        let solved = Solved { q: &mut *q, q_dot: &mut *q_dot, q_ddot: &mut *q_ddot, margins: &mut *margins };
        mechanism.solve_with(&parameters, &at, &signs, &start, self.needs.depth, solved)?;
        if !(are_good(margins) && is_same(q, Recorded::value, &state.q)) {
            return Ok(false);
        }
        if self.needs.observed {
            mechanism.observe_with(&parameters, &at, q, q_dot, &mut self.observations)?;
            let parts = crate::equations::system::Parts::of(&self.observations);
            let pattern = &model.observable_pattern;
            observed.clear();
            observed.extend((0..model.observables.len()).map(|row| parts.rates(pattern, row, q_dot, q_ddot)));
        }
        if self.needs.geometry {
            fill_with_zeros(geometry, model.geometry);
            mechanism.write_geometry(&parameters, &at, geometry)?;
        }
        if let (true, Some(info)) = (self.needs.forces, model.forces) {
            fill_with_zeros(forces, info.count);
            mechanism.forces_with(&parameters, &at, q, q_dot, q_ddot, &[], forces)?;
            masses_are_not_negative(model, info, |index| forces[index].value())?;
        }
        Ok(add_recorded(model, &self.varied, (measures, weights), gradient))
    }
}

// These functions are not generic over the mechanism, so that they are compiled once for all.

/// Numbers that do not depend on the parameters.
fn constants(numbers: &[f64]) -> Vec<Recorded> {
    numbers.iter().map(|number| Recorded::from_f64(*number)).collect()
}

/// Inputs that do not depend on the parameters.
fn constant_inputs(inputs: &[Signal]) -> Vec<Signal<Recorded>> {
    inputs.iter().map(|input| input.map(Recorded::from_f64)).collect()
}

fn fill_with_zeros(list: &mut Vec<Recorded>, count: usize) {
    list.clear();
    list.resize(count, Recorded::from_f64(0.0));
}

/// Whether a solution of the plan is valid.
fn are_good(margins: &[Recorded]) -> bool {
    margins.iter().all(|margin| margin.value() > Plan::SMALLEST_MARGIN)
}

/// Adds the gradient of the weighted quantities by the recorded operations; false where one of them has no value.
fn add_recorded(
    model: &Model,
    varied: &Varied<Recorded>,
    (measures, weights): (&[Measure], &[f64]),
    gradient: &mut [f64],
) -> bool {
    let results = measures.iter().zip(weights).filter(|(measure, weight)| **weight != 0.0 && !measure.is_held());
    let results: Option<Vec<(Recorded, f64)>> =
        results.map(|(measure, &weight)| Some((measure.varied(model, varied)?, weight))).collect();
    let Some(results) = results else { return false };
    accumulate(results, gradient);
    true
}

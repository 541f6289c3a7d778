//! Derivatives of quantities by name.

use super::{Variation, Varying, check_indices, observe, sensitivities_by, vary};
use crate::analysis::forces::forces;
use crate::error::SolveError;
use crate::forces::Forces;
use crate::measure::{Measure, Needs, column_values, magnitude_parts};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::results::varied::{Number, Varied};
use crate::scalar::Scalar;
use crate::sensitivities::Sensitivities;
use crate::solver::{AnySolver, Solver};
use crate::state::State;

impl<M: Mechanism> Solver<'_, M> {
    /// Derivatives of quantities with respect to parameters, indices in
    /// [`Model::parameters`](crate::model::Model::parameters), at a solved state: for every quantity one number per
    /// parameter, in the given orders.
    ///
    /// A derivative that does not exist is NaN: that of a velocity ratio, of a transmission angle where an arm has no
    /// length or both are on one line, of a force that redundant rows leave undetermined. The instant and the inputs
    /// are kept fixed, so that their derivatives are 0.
    ///
    /// ```
    /// use kin_runtime::{Kinematics, Measure, Mechanism, mechanism};
    ///
    /// #[mechanism]
    /// #[bodies(crank, coupler, rocker)]
    /// #[revolute(C: ground @ (0, 0), crank @ (0, 0))]
    /// #[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
    /// #[revolute(B: coupler @ (length, 0), rocker @ (0, 0))]
    /// #[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0))]
    /// #[driver(drive: crank.phi = t)]
    /// #[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
    /// struct FourBar {
    ///     #[param(0.4)]
    ///     length: f64,
    /// }
    ///
    /// # fn main() -> Result<(), kin_runtime::SolveError> {
    /// let four_bar = FourBar::default();
    /// let solver = four_bar.solver();
    /// let state = solver.state(&0.0.into())?;
    /// let angle: Vec<Measure> = Measure::named(FourBar::model(), "B.transmission").into_iter().collect();
    /// let by = solver.measure_sensitivities(&state, &angle, &[0])?;
    /// // The law of cosines: 0.3² = l² + 0.3² − 2 · 0.3 l cos μ, where 0.3 is how far D is from A at t = 0.
    /// let (l, cos) = (0.4, 0.4 / 0.6);
    /// let exact = (cos / l - 1.0 / 0.3) / (1.0_f64 - cos * cos).sqrt();
    /// assert!((by[0][0] - exact).abs() < 1e-12);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`sensitivities_by`](Self::sensitivities_by); [`NegativeMass`](SolveError::NegativeMass) for a force.
    pub fn measure_sensitivities(
        &self,
        state: &State,
        measures: &[Measure],
        parameters: &[usize],
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        measure_sensitivities(self, &mut Varying::new(self.mechanism), state, measures, parameters)
    }
}

/// As [`Solver::measure_sensitivities`].
fn measure_sensitivities(
    solver: &dyn AnySolver,
    variation: &mut dyn Variation,
    state: &State,
    measures: &[Measure],
    parameters: &[usize],
) -> Result<Vec<Vec<f64>>, SolveError> {
    let model = variation.model();
    check_indices(model, parameters)?;
    // `vary` evaluates the observables, and forces follow below, with or without a closed form.
    let geometry = measures.iter().any(|measure| measure.needs().geometry);
    let needs = Needs { geometry, ..Needs::LEAST };
    let mut all = vec![Vec::with_capacity(parameters.len()); measures.len()];
    vary(solver, variation, state, parameters, &mut |variation, chunk, varied| {
        complete(variation, varied, needs)?;
        for (measure, by) in measures.iter().zip(&mut all) {
            let held = if measure.is_held() { 0.0 } else { f64::NAN };
            let number = measure.varied(model, varied);
            by.extend((0..chunk.len()).map(|lane| number.map_or(held, |number| number.by()[lane])));
        }
        Ok(())
    })?;
    if measures.iter().any(|measure| measure.force().is_some()) {
        let by = sensitivities_by(solver, variation, state, parameters)?;
        let mut equations = solver.equations_of_state(state)?;
        let at = match forces(&mut equations, state, solver.settings().sharing) {
            Err(error @ SolveError::NegativeMass { .. }) => return Err(error),
            found => found.ok(),
        };
        write_forces(model, measures, (at.as_ref(), &by), &mut all);
    }
    Ok(all)
}

/// Writes the derivatives of forces among the quantities; `at` is the forces themselves.
fn write_forces(
    model: &Model,
    measures: &[Measure],
    (at, by): (Option<&Forces>, &Sensitivities),
    all: &mut [Vec<f64>],
) {
    let (mut numbers, mut slopes) = (Vec::new(), Vec::new());
    column_values(model, at, &mut numbers);
    for (k, by) in by.by.iter().enumerate() {
        slopes.clear();
        column_values(model, by.forces.as_ref(), &mut slopes);
        for (measure, all) in measures.iter().zip(&mut *all) {
            let Some(index) = measure.force() else { continue };
            all[k] = match magnitude_parts(measure.name(), index) {
                // |f| = √(x² + y²).
                Some([x, y]) => (numbers[x] * slopes[x] + numbers[y] * slopes[y]) / numbers[index],
                None => slopes[index],
            };
        }
    }
}

/// Writes what quantities need besides q and its rates; forces in closed form.
pub(crate) fn complete(variation: &mut dyn Variation, varied: &mut Varied, needs: Needs) -> Result<(), SolveError> {
    if needs.observed {
        observe(variation, varied)?;
    }
    if needs.geometry {
        variation.write_geometry(&mut varied.geometry)?;
    }
    if let (true, Some(info)) = (needs.forces, variation.model().forces) {
        let mut forces = core::mem::take(&mut varied.forces);
        forces.clear();
        forces.resize(info.count, Number::from_f64(0.0));
        variation.forces(varied, &[], &mut forces)?;
        varied.forces = forces;
    }
    Ok(())
}

//! Sensitivities: exact derivatives of a solved state with respect to the parameters of its mechanism.
//!
//! The mode of the configuration and the instant are kept fixed. Where the plan solves the mechanism, its closed forms
//! over numbers with [`Tangents`](crate::scalar::Tangents) give all derivatives; where one of its steps iterates, one
//! correction of the converged solution is the linear solve. Otherwise, with D_p the derivative along (q_p, q̇_p, 1)
//! while the highest derivative of q is kept fixed,
//!
//! ```text
//! Φ_q q_p = −Φ_p        Φ_q q̇_p = −D_p(Φ_q q̇ + Φ_t)        Φ_q q̈_p = −D_p(Φ_q q̈ − γ)
//! ```
//!
//! with one factorisation of Φ_q (Haug, *Computer Aided Kinematics and Dynamics of Mechanical Systems*, 1989,
//! differentiates the same equations with respect to time). The right-hand sides are the code of Φ, Φ_q, Φ_t and γ over
//! the same numbers, and so is all that is reported of the motion and of forces.

#[cfg(feature = "std")]
mod adjoint;
mod forces;
mod linear;
pub(crate) mod measured;
mod variation;

use crate::equations::Equations;
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::mobility::mobility;
use crate::model::{Level, Model};
use crate::motion::{BodyMotion, PointMotion};
use crate::plan::Plan;
use crate::results::varied::{Number, Varied, WIDTH};
use crate::sensitivities::{Sensitivities, Sensitivity};
use crate::solver::{AnySolver, Solver};
use crate::state::State;
use linear::Linear;
#[cfg(any(feature = "simd", feature = "design"))]
pub(crate) use variation::MAX_STACK_COORDINATES;
#[cfg(feature = "simd")]
pub(crate) use variation::modes_at;
pub(crate) use variation::{Variation, Varying};

/// Largest difference between the plan's q and that of the state, relative to the size of its numbers, with which both
/// are the same configuration.
const SAME_CONFIGURATION: f64 = 1e-6;

impl<M: Mechanism> Solver<'_, M> {
    /// Derivatives of q, q̇, q̈ and of all that is reported of a solved state (bodies, points, defines, joint
    /// quantities, conditions, efforts and reactions) with respect to every parameter. Units are those of the quantity
    /// divided by that of the parameter.
    ///
    /// The assembly mode, the instant, the inputs and prescribed coordinates are kept fixed; parameters of drivers are
    /// parameters like any other.
    ///
    /// ```
    /// use kin_runtime::{Kinematics, mechanism};
    ///
    /// /// A crank whose end is at (l cos φ, l sin φ), φ = ω t.
    /// #[mechanism]
    /// #[bodies(crank)]
    /// #[point(tip = crank @ (l, 0))]
    /// #[revolute(pin: ground @ (0, 0), crank @ (0, 0))]
    /// #[driver(drive: crank.phi = omega * t)]
    /// struct Crank {
    ///     #[param(0.2)]
    ///     l: f64,
    ///     #[param(3)]
    ///     omega: f64,
    /// }
    ///
    /// let crank = Crank::default();
    /// let solver = crank.solver();
    /// let by = solver.sensitivities(&solver.state(&0.1.into())?)?;
    /// let (sin, cos) = 0.3_f64.sin_cos();
    /// assert!((by["l"][Crank::tip].r[0] - cos).abs() < 1e-15);
    /// assert!((by["omega"][Crank::tip].r[0] + 0.2 * 0.1 * sin).abs() < 1e-15);
    /// # Ok::<(), kin_runtime::SolveError>(())
    /// ```
    ///
    /// # Errors
    /// [`NotDetermined`](SolveError::NotDetermined) where degrees of freedom are left open and where rows of velocity
    /// level make the position depend on the motion so far; [`Singular`](SolveError::Singular) and the other errors of
    /// [`velocity`](Self::velocity) where Φ_q has no full rank here; [`NoSensitivity`](SolveError::NoSensitivity) where
    /// redundant rows agree at this value of a parameter only, or a function has no derivative. A supplied function in
    /// a driver needs a third derivative for q̈ ([`ScalarFunction::derivatives`](crate::ScalarFunction::derivatives)).
    pub fn sensitivities(&self, state: &State) -> Result<Sensitivities, SolveError> {
        let all: Vec<usize> = (0..M::PARAMETERS).collect();
        self.sensitivities_by(state, &all)
    }

    /// [`sensitivities`](Self::sensitivities) with respect to some parameters, indices in
    /// [`Model::parameters`](crate::model::Model::parameters).
    ///
    /// # Errors
    /// As [`sensitivities`](Self::sensitivities), and [`UnknownParameter`](SolveError::UnknownParameter).
    pub fn sensitivities_by(&self, state: &State, parameters: &[usize]) -> Result<Sensitivities, SolveError> {
        sensitivities_by(self, &mut Varying::new(self.mechanism), state, parameters)
    }

    /// [`sensitivities_by`](Self::sensitivities_by) at every state of a motion, in their order.
    ///
    /// # Errors
    /// As [`sensitivities_by`](Self::sensitivities_by) at the first state that has none.
    pub fn sensitivities_along(
        &self,
        states: &[State],
        parameters: &[usize],
    ) -> Result<Vec<Sensitivities>, SolveError> {
        states.iter().map(|state| self.sensitivities_by(state, parameters)).collect()
    }
}

/// As [`Solver::sensitivities_by`].
fn sensitivities_by(
    solver: &dyn AnySolver,
    variation: &mut dyn Variation,
    state: &State,
    parameters: &[usize],
) -> Result<Sensitivities, SolveError> {
    let model = variation.model();
    check_indices(model, parameters)?;
    let (mut by, mut margins) = (Vec::new(), Vec::new());
    vary(solver, variation, state, parameters, &mut |variation, chunk, varied| {
        let first = by.len();
        by.extend((0..chunk.len()).map(|lane| reported(model, model.parameters[chunk[lane]].name, lane, varied)));
        margins = varied.margins.iter().map(|margin| margin.value()).collect();
        let Some(info) = model.forces else { return Ok(()) };
        let mut equations = solver.equations_of_state(state)?;
        forces::forces(&mut equations, variation, info, state, varied, &mut by[first..]);
        Ok(())
    })?;
    match by.iter().find(|by| !by.is_finite()) {
        Some(by) => Err(SolveError::NoSensitivity { t: state.t, parameter: by.parameter, row_name: None }),
        None => Ok(Sensitivities { t: state.t, model, margins, by }),
    }
}

/// An error if a parameter does not exist.
fn check_indices(model: &Model, parameters: &[usize]) -> Result<(), SolveError> {
    let count = model.parameters.len();
    match parameters.iter().find(|&&index| index >= count) {
        Some(&index) => Err(SolveError::UnknownParameter { index, parameters: count }),
        None => Ok(()),
    }
}

/// q, q̇, q̈ and the observables with their derivatives, for as many parameters at once as a number carries.
pub(crate) fn vary(
    solver: &dyn AnySolver,
    variation: &mut dyn Variation,
    state: &State,
    parameters: &[usize],
    see: &mut See<'_>,
) -> Result<(), SolveError> {
    let mut all = Vec::new();
    let settings = solver.settings();
    let is_free = settings.given.is_empty();
    if !(is_free && planned(settings.options.use_plan, variation, state, parameters, &mut all)?) {
        by_rows(&mut solver.equations_of_state(state)?, variation, state, parameters, &mut all)?;
    }
    for (chunk, varied) in parameters.chunks(WIDTH).zip(&mut all) {
        variation.begin(&state.instant(), chunk);
        observe(variation, varied)?;
        see(variation, chunk, varied)?;
    }
    Ok(())
}

/// Receives the numbers that vary, for one chunk of the parameters after the other.
pub(crate) type See<'s> = dyn FnMut(&mut dyn Variation, &[usize], &mut Varied) -> Result<(), SolveError> + 's;

/// q, q̇ and q̈ by a factorisation of the whole Φ_q.
fn by_rows(
    equations: &mut Equations<'_>,
    variation: &mut dyn Variation,
    state: &State,
    parameters: &[usize],
    all: &mut Vec<Varied>,
) -> Result<(), SolveError> {
    for (what, list) in [("q", &state.q), ("q_dot", &state.q_dot), ("q_ddot", &state.q_ddot)] {
        equations.check(what, list)?;
    }
    if is_integrated(equations.model) {
        return Err(SolveError::NotDetermined { t: state.t, open: 0, could_be_given: Vec::new() });
    }
    if state.degrees_of_freedom_left > 0 {
        return Err(open(equations, state)?);
    }
    all.clear();
    let linear = Linear::at(equations, state)?;
    for chunk in parameters.chunks(WIDTH) {
        variation.begin(&state.instant(), chunk);
        let mut varied = Varied::default();
        linear.vary(equations, variation, state, chunk, &mut varied)?;
        all.push(varied);
    }
    Ok(())
}

/// True where rows of velocity level make the position depend on the motion so far.
pub(crate) fn is_integrated(model: &Model) -> bool {
    model.rows.iter().any(|row| row.level == Level::Velocity)
}

/// The error for open degrees of freedom.
fn open(equations: &mut Equations<'_>, state: &State) -> Result<SolveError, SolveError> {
    let open = mobility(equations, &state.q)?;
    let could_be_given = open.could_be_given.iter().map(|&k| equations.model.coordinates[k].name).collect();
    Ok(SolveError::NotDetermined { t: state.t, open: state.degrees_of_freedom_left, could_be_given })
}

/// q, q̇ and q̈ by the plan; false where it has no valid solution.
fn planned(
    use_plan: bool,
    variation: &mut dyn Variation,
    state: &State,
    parameters: &[usize],
    all: &mut Vec<Varied>,
) -> Result<bool, SolveError> {
    let model = variation.model();
    let plan = &model.plan;
    let lists = [&state.q, &state.q_dot, &state.q_ddot];
    let complete = lists.iter().all(|list| list.len() == model.coordinates.len());
    let determined = state.degrees_of_freedom_left == 0 && !is_integrated(model);
    // Rows that the plan leaves out may hold for these parameters only: all rows together show whether they do.
    let usable = use_plan && plan.exists() && !plan.has_redundant_rows();
    if !(complete && determined && usable) {
        return Ok(false);
    }
    for chunk in parameters.chunks(WIDTH) {
        variation.begin(&state.instant(), chunk);
        let mut varied = Varied::default();
        if !variation.solve(state, &mut varied)? {
            return Ok(false);
        }
        let good = varied.margins.iter().all(|margin| margin.value() > Plan::SMALLEST_MARGIN);
        let same = |found: &[Number], exact: &[f64]| {
            is_same(found, Number::value, exact) && found.iter().all(|found| found.by().iter().all(|by| by.is_finite()))
        };
        let found = [&varied.q, &varied.q_dot, &varied.q_ddot];
        if !(good && found.into_iter().zip(lists).all(|(found, exact)| same(found, exact))) {
            return Ok(false);
        }
        all.push(varied);
    }
    Ok(true)
}

/// Whether numbers with derivatives have the values of a state.
pub(crate) fn is_same<V: Copy>(found: &[V], value: fn(V) -> f64, exact: &[f64]) -> bool {
    let size = exact.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    found.iter().zip(exact).all(|(found, exact)| (value(*found) - exact).abs() <= SAME_CONFIGURATION * size)
}

/// Writes the observables.
pub(crate) fn observe(variation: &mut dyn Variation, varied: &mut Varied) -> Result<(), SolveError> {
    let model = variation.model();
    let parts = variation.observe(&varied.q, &varied.q_dot)?;
    let pattern = &model.observable_pattern;
    let all = (0..model.observables.len()).map(|k| parts.rates(pattern, k, &varied.q_dot, &varied.q_ddot));
    varied.observed.clear();
    varied.observed.extend(all);
    Ok(())
}

/// The derivatives with respect to the parameter of a lane, of all but forces.
fn reported(model: &'static Model, parameter: &'static str, lane: usize, varied: &Varied) -> Sensitivity {
    let derivatives = |list: &[Number]| list.iter().map(|number| number.by()[lane]).collect();
    let [q, q_dot, q_ddot, margins] =
        [&varied.q, &varied.q_dot, &varied.q_ddot, &varied.margins].map(|list| derivatives(list));
    let at = |k: usize| varied.observed.get(k).map(|signal| signal.map(|number| number.by()[lane])).unwrap_or_default();
    let joints = model.joints.iter().map(|joint| joint.quantities.iter().map(|q| at(q.observable)).collect());
    Sensitivity {
        model,
        parameter,
        q,
        q_dot,
        q_ddot,
        margins,
        bodies: model.bodies.iter().map(|body| BodyMotion::from(body.observables.map(at))).collect(),
        points: model.points.iter().map(|point| PointMotion::from(point.observables.map(at))).collect(),
        defines: model.defines.iter().map(|define| at(define.observable)).collect(),
        joints: joints.collect(),
        conditions: model.conditions.iter().map(|condition| at(condition.observable)).collect(),
        forces: None,
    }
}

//! The interface through which commands use a mechanism. Only this file depends on the mechanism's type.

use std::ops::ControlFlow;

use super::setup::Setup;
use crate::assembly::Assemblies;
use crate::certificate::{Certificate, Uncertified};
use crate::cross_check::{CrossCheck, CrossCheckOptions};
use crate::equations::system::{Evaluator, System};
use crate::error::SolveError;
use crate::evaluation::curve::CurvePoint;
use crate::forces::{Forces, Load};
use crate::measure::Measure;
use crate::mechanism::Mechanism;
use crate::mobility::Mobility;
use crate::model::Model;
use crate::modes::Mode;
use crate::motion::Motion;
use crate::observer::Observer;
use crate::planned::OutOfRange;
use crate::ranges::Ranges;
use crate::ratios::VelocityRatios;
use crate::sensitivities::Sensitivities;
use crate::signal::Instant;
use crate::solver::{ContactWatch, Solver};
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::transmission::TransmissionAngle;
use crate::workspace::Subset;

/// The arc that a motion follows: the time at its start, the end of its interval of t, and the number of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    pub(super) from: f64,
    pub(super) to: Option<f64>,
    pub(super) steps: usize,
}

/// The residual of the worst row of the velocity or acceleration equations, relative to the terms of that row.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub(super) struct Miss {
    /// Name of the row.
    pub(super) row: &'static str,
    /// Relative error.
    pub(super) error: f64,
}

/// A mechanism with its parameters.
pub(super) trait Engine {
    fn model(&self) -> &'static Model;
    fn parameters(&self) -> Vec<f64>;
    /// The mechanism's own guess of every coordinate, where it has one.
    fn guesses(&self) -> Vec<Option<f64>>;
    fn set_parameter(&mut self, index: usize, value: f64) -> bool;
    /// An assembled configuration, singular or not.
    fn assemble(&self, setup: &Setup, t: f64) -> Result<Vec<f64>, SolveError>;
    fn state(&self, setup: &Setup, t: f64) -> Result<State, SolveError>;
    /// The input with whose value the mechanism cannot close, and its range.
    fn out_of_range(&self, setup: &Setup, t: f64) -> Option<OutOfRange>;
    /// The motion up to the first failure, or to the first event if `stop_at_events`, with the failure. `visit` is
    /// called with every state; the states are not kept.
    fn sweep_each(
        &self,
        setup: &Setup,
        times: &[f64],
        stop_at_events: bool,
        observer: Observer<'_>,
        visit: &mut dyn FnMut(&State) -> ControlFlow<()>,
    ) -> (Trajectory, Option<SolveError>);
    /// The motion along the arc of the solution curve, through dead centres.
    fn sweep_along_arc(&self, setup: &Setup, arc: Arc, observer: Observer<'_>) -> Result<Trajectory, SolveError>;
    /// The motion over `times` from a configuration. The inputs continue from `first`, the first instant of the whole
    /// motion.
    fn sweep_from(&self, setup: &Setup, first: f64, start: &[f64], times: &[f64]) -> Result<Trajectory, SolveError>;
    fn motion(&self, setup: &Setup, state: &State) -> Result<Motion, SolveError>;
    /// The values of quantities at a state.
    fn measure(&self, setup: &Setup, state: &State, measures: &[Measure]) -> Result<Vec<f64>, SolveError>;
    /// Forces; those of joints that share a load redundantly are of least norm if the setup says so.
    fn forces(&self, setup: &Setup, state: &State) -> Result<Forces, SolveError>;
    /// The forces of gravity, of applied loads and of springs on the bodies.
    fn loads(&self, setup: &Setup, state: &State) -> Result<Vec<Load>, SolveError>;
    /// Updates the watch of contact forces with the next state of a motion that began at `first`.
    fn watch_contacts(
        &self,
        setup: &Setup,
        first: f64,
        watch: &mut ContactWatch,
        state: &State,
    ) -> Result<(), SolveError>;
    fn sensitivities(&self, setup: &Setup, state: &State) -> Result<Sensitivities, SolveError>;
    /// Derivatives of quantities with respect to parameters at a state.
    fn measure_sensitivities(
        &self,
        setup: &Setup,
        state: &State,
        measures: &[Measure],
        parameters: &[usize],
    ) -> Result<Vec<Vec<f64>>, SolveError>;
    #[cfg(feature = "design")]
    fn design(
        &self,
        setup: &Setup,
        wishes: &super::wishes::Wishes,
        search: &crate::design::Search<'_>,
    ) -> Result<crate::design::Designed<()>, crate::design::DesignError>;
    fn certify(&self, setup: &Setup, state: &State) -> Result<Certificate, Uncertified>;
    fn mobility(&self, setup: &Setup, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError>;
    fn velocity_ratios(&self, setup: &Setup, state: &State) -> Result<VelocityRatios, SolveError>;
    fn transmission_angles(&self, state: &State) -> Result<Vec<TransmissionAngle>, SolveError>;
    fn cross_check(&self, options: &CrossCheckOptions, observer: Observer<'_>) -> Result<CrossCheck, SolveError>;
    /// Compares the plan with the equations and with full Newton; `None` if there is no plan.
    fn plan_check(&self, options: &CrossCheckOptions, observer: Observer<'_>)
    -> Result<Option<CrossCheck>, SolveError>;
    /// The modes of a configuration; an empty list if there is no plan.
    fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Vec<Mode>;
    fn assemblies(&self, setup: &Setup, t: f64) -> Result<Assemblies, SolveError>;
    /// Whether the combinations of signs of a plan in closed form give all closures, so that no search is needed.
    fn closes_by_signs(&self, setup: &Setup, t: f64) -> bool;
    fn ranges(&self, setup: &Setup, from: f64, to: f64) -> Result<Ranges, SolveError>;
    /// Local points, axes, values and radii at an instant.
    fn geometry(&self, at: &Instant<'_>) -> Result<Vec<f64>, SolveError>;
    /// A point of the curve of a joint.
    fn curve(&self, at: &Instant<'_>, joint: usize, s: f64) -> Option<CurvePoint>;
    /// Φ_t and γ at q = q̇ = 0.
    fn time_derivatives(&self, at: &Instant<'_>) -> Result<[Vec<f64>; 2], SolveError>;
    /// The worst rows of Φ_q q̇ = −Φ_t and of Φ_q q̈ = γ.
    fn misses(&self, state: &State) -> Result<[Option<Miss>; 2], SolveError>;
}

/// The mechanism `M` as an [`Engine`].
pub(super) struct Bound<M> {
    mechanism: M,
}

impl<M: Mechanism> Bound<M> {
    pub(super) fn new(mechanism: M) -> Self {
        Self { mechanism }
    }

    fn solver(&self, setup: &Setup) -> Solver<'_, M> {
        Solver { mechanism: &self.mechanism, settings: setup.settings(M::model()) }
    }
}

impl<M: Mechanism + Default> Engine for Bound<M> {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn parameters(&self) -> Vec<f64> {
        self.mechanism.parameters::<f64>().as_ref().to_vec()
    }

    fn guesses(&self) -> Vec<Option<f64>> {
        Solver::new(&self.mechanism).guess()
    }

    fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        self.mechanism.set_parameter(index, value)
    }

    fn assemble(&self, setup: &Setup, t: f64) -> Result<Vec<f64>, SolveError> {
        let setup = &*setup.beginning_at(t);
        self.solver(setup).assemble(&Instant { t, inputs: &setup.inputs })
    }

    fn state(&self, setup: &Setup, t: f64) -> Result<State, SolveError> {
        let setup = &*setup.beginning_at(t);
        self.solver(setup).state(&Instant { t, inputs: &setup.inputs })
    }

    fn out_of_range(&self, setup: &Setup, t: f64) -> Option<OutOfRange> {
        let setup = &*setup.beginning_at(t);
        self.solver(setup).out_of_range(&Instant { t, inputs: &setup.inputs })
    }

    fn sweep_each(
        &self,
        setup: &Setup,
        times: &[f64],
        stop_at_events: bool,
        observer: Observer<'_>,
        visit: &mut dyn FnMut(&State) -> ControlFlow<()>,
    ) -> (Trajectory, Option<SolveError>) {
        let first = times.first().copied().unwrap_or(0.0);
        let setup = &*setup.beginning_at(first);
        let inputs = setup.inputs_from(first);
        let solver = self.solver(setup).with_inputs(&inputs).stop_at_events(stop_at_events).with_observer(observer);
        match solver.sweep_each(times, visit) {
            Ok(trajectory) => (trajectory, None),
            Err(error) => (*error.trajectory, Some(error.source)),
        }
    }

    fn sweep_along_arc(&self, setup: &Setup, arc: Arc, observer: Observer<'_>) -> Result<Trajectory, SolveError> {
        let setup = &*setup.beginning_at(arc.from);
        let inputs = setup.inputs_from(arc.from);
        let solver = self.solver(setup).with_inputs(&inputs).with_observer(observer);
        solver.sweep_along_arc(arc.from, arc.to, arc.steps)
    }

    fn sweep_from(&self, setup: &Setup, first: f64, start: &[f64], times: &[f64]) -> Result<Trajectory, SolveError> {
        let setup = &*setup.beginning_at(first);
        let inputs = setup.inputs_from(first);
        // Prescribed coordinates have their values at the first of these instants.
        let later = setup.after(times.first().copied().unwrap_or(first) - first);
        self.solver(&later).with_inputs(&inputs).sweep_from(start, times).map_err(|error| error.source)
    }

    fn measure(&self, setup: &Setup, state: &State, measures: &[Measure]) -> Result<Vec<f64>, SolveError> {
        self.solver(setup).measure(state, measures)
    }

    fn motion(&self, setup: &Setup, state: &State) -> Result<Motion, SolveError> {
        self.solver(setup).motion(state)
    }

    fn forces(&self, setup: &Setup, state: &State) -> Result<Forces, SolveError> {
        self.solver(setup).forces(state)
    }

    fn loads(&self, setup: &Setup, state: &State) -> Result<Vec<Load>, SolveError> {
        self.solver(setup).loads(state)
    }

    fn watch_contacts(
        &self,
        setup: &Setup,
        first: f64,
        watch: &mut ContactWatch,
        state: &State,
    ) -> Result<(), SolveError> {
        let setup = &*setup.beginning_at(first);
        let inputs = setup.inputs_from(first);
        self.solver(setup).with_inputs(&inputs).watch_contacts(watch, state)
    }

    fn sensitivities(&self, setup: &Setup, state: &State) -> Result<Sensitivities, SolveError> {
        self.solver(setup).sensitivities(state)
    }

    fn measure_sensitivities(
        &self,
        setup: &Setup,
        state: &State,
        measures: &[Measure],
        parameters: &[usize],
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        self.solver(setup).measure_sensitivities(state, measures, parameters)
    }

    #[cfg(feature = "design")]
    fn design(
        &self,
        setup: &Setup,
        wishes: &super::wishes::Wishes,
        search: &crate::design::Search<'_>,
    ) -> Result<crate::design::Designed<()>, crate::design::DesignError> {
        let mut design = crate::design::Design::new(&self.mechanism);
        wishes.add_to(setup, &mut design.task)?;
        Ok(crate::design::searched(&design, &design.task, search)?.map(|_| ()))
    }

    fn certify(&self, setup: &Setup, state: &State) -> Result<Certificate, Uncertified> {
        self.solver(setup).certify(state)
    }

    fn mobility(&self, setup: &Setup, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError> {
        self.solver(setup).mobility(at, q)
    }

    fn velocity_ratios(&self, setup: &Setup, state: &State) -> Result<VelocityRatios, SolveError> {
        self.solver(setup).velocity_ratios(state)
    }

    fn transmission_angles(&self, state: &State) -> Result<Vec<TransmissionAngle>, SolveError> {
        Solver::new(&self.mechanism).transmission_angles(&state.instant(), &state.q)
    }

    fn cross_check(&self, options: &CrossCheckOptions, observer: Observer<'_>) -> Result<CrossCheck, SolveError> {
        Solver::new(&self.mechanism).with_observer(observer).cross_check(options)
    }

    fn plan_check(
        &self,
        options: &CrossCheckOptions,
        observer: Observer<'_>,
    ) -> Result<Option<CrossCheck>, SolveError> {
        let exists = M::model().plan.exists();
        exists.then(|| Solver::new(&self.mechanism).with_observer(observer).plan_check(options)).transpose()
    }

    fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Vec<Mode> {
        Solver::new(&self.mechanism).modes(at, q).unwrap_or_default()
    }

    fn assemblies(&self, setup: &Setup, t: f64) -> Result<Assemblies, SolveError> {
        let setup = &*setup.beginning_at(t);
        self.solver(setup).assemblies(&Instant { t, inputs: &setup.inputs })
    }

    fn closes_by_signs(&self, setup: &Setup, t: f64) -> bool {
        let setup = &*setup.beginning_at(t);
        self.solver(setup).closes_by_signs(&Instant { t, inputs: &setup.inputs })
    }

    fn ranges(&self, setup: &Setup, from: f64, to: f64) -> Result<Ranges, SolveError> {
        let setup = &*setup.beginning_at(from);
        self.solver(setup).ranges(&Instant { t: from, inputs: &setup.inputs }, to)
    }

    fn geometry(&self, at: &Instant<'_>) -> Result<Vec<f64>, SolveError> {
        let mut geometry = vec![0.0; M::model().geometry];
        self.mechanism.write_geometry(self.mechanism.parameters::<f64>().as_ref(), at, &mut geometry)?;
        Ok(geometry)
    }

    fn curve(&self, at: &Instant<'_>, joint: usize, s: f64) -> Option<CurvePoint> {
        self.mechanism.curve_point(at, joint, s).ok().flatten()
    }

    fn time_derivatives(&self, at: &Instant<'_>) -> Result<[Vec<f64>; 2], SolveError> {
        time_derivatives(&mut Evaluator::<_, M>::new(&self.mechanism), at)
    }

    fn misses(&self, state: &State) -> Result<[Option<Miss>; 2], SolveError> {
        misses(&mut Evaluator::<_, M>::new(&self.mechanism), state)
    }
}

fn time_derivatives(system: &mut dyn System, at: &Instant<'_>) -> Result<[Vec<f64>; 2], SolveError> {
    let still = vec![0.0; system.model().coordinates.len()];
    system.evaluate(Subset::ALL, at, &still, &still)?;
    let parts = system.constraints();
    Ok([parts.phi_t, parts.gamma].map(<[f64]>::to_vec))
}

fn misses(system: &mut dyn System, state: &State) -> Result<[Option<Miss>; 2], SolveError> {
    system.evaluate(Subset::ALL, &state.instant(), &state.q, &state.q_dot)?;
    let (model, parts) = (system.model(), system.constraints());
    let nu: Vec<f64> = parts.phi_t.iter().map(|v| -v).collect();
    let velocity = worst_miss(model, parts.phi_q, &state.q_dot, &nu);
    Ok([velocity, worst_miss(model, parts.phi_q, &state.q_ddot, parts.gamma)])
}

/// The worst row of Φ_q x = b, relative to the sizes of the row, x and b.
fn worst_miss(model: &'static Model, phi_q: &[f64], x: &[f64], b: &[f64]) -> Option<Miss> {
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut worst: Option<Miss> = None;
    for (i, row) in model.rows.iter().enumerate() {
        let right = b.get(i).copied().unwrap_or(0.0);
        let (mut miss, mut size) = (-right, right.abs());
        for (&(r, column), &entry) in model.constraint_pattern.entries.iter().zip(phi_q) {
            if r == i {
                miss += entry * x.get(column).copied().unwrap_or(0.0);
                size = size.max(entry.abs() * largest);
            }
        }
        let error = if miss == 0.0 { 0.0 } else { miss.abs() / size };
        // NaN counts as the worst.
        if worst.is_none_or(|w| error > w.error || error.is_nan()) {
            worst = Some(Miss { row: row.name, error });
        }
    }
    worst
}

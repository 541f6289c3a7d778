//! The analyses of one mechanism, with its options, guesses and prescribed coordinates.

use crate::analysis;
use crate::analysis::acceleration::acceleration;
use crate::analysis::forces::Sharing;
use crate::analysis::position::position;
use crate::analysis::singular::explain;
use crate::analysis::velocity::{factorize, velocity};
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::equations::system::Evaluator;
use crate::error::SolveError;
use crate::forces::{Forces, Load};
use crate::measure::{Measure, values};
use crate::mechanism::Mechanism;
use crate::mobility::{Mobility, mobility};
use crate::model::Point;
use crate::modes::{Mode, WantedAssembly, assemble_in, first_state, modes};
use crate::motion::Motion;
use crate::plan::Plan;
use crate::planned::{PlanError, Planned, Sign};
use crate::ratios::{VelocityRatios, velocity_ratios};
use crate::report::motion::{motion, point_jacobian};
use crate::signal::{Instant, Signal};
use crate::state::State;
use crate::transmission::{TransmissionAngle, transmission_angles};
use nalgebra::DMatrix;

mod any_solver;
mod arc;
mod assemblies;
mod by_plan;
mod certify;
mod choices;
mod contacts;
mod cross_checks;
mod guessed_modes;
mod input_ranges;
mod iterations;
mod ranges;
mod rates;
mod settings;
mod sweep;
mod usable;

pub use crate::analysis::position::Position;
pub(crate) use any_solver::AnySolver;
#[cfg(feature = "cli")]
pub(crate) use contacts::ContactWatch;
pub(crate) use settings::Settings;
#[cfg(feature = "design")]
pub(crate) use sweep::swept;

/// Position, velocity and acceleration analysis of one mechanism.
///
/// ```text
/// Φ(q, t) = 0        Φ_q q̇ = −Φ_t        Φ_q q̈ = γ
/// ```
///
/// If degrees of freedom are left, every result is the one of least Euclidean norm over q: the shortest correction of
/// the start, the smallest q̇, the smallest q̈. Such a result is only a convention; prescribe coordinates with
/// [`with_given`](Self::with_given) or add drivers for one with a mechanical meaning.
pub struct Solver<'m, M: Mechanism> {
    pub(crate) mechanism: &'m M,
    pub(crate) settings: Settings<'m>,
}

impl<'m, M: Mechanism> Solver<'m, M> {
    /// A solver with default options and the mechanism's own guesses.
    pub fn new(mechanism: &'m M) -> Self {
        Self { mechanism, settings: Settings::default() }
    }

    /// Assembles the mechanism from the guesses; coordinates without a guess are found.
    ///
    /// # Errors
    /// [`NotAssembled`](SolveError::NotAssembled) with the residual of the best attempt,
    /// [`GivenConflict`](SolveError::GivenConflict), [`UnknownCoordinate`](SolveError::UnknownCoordinate);
    /// [`Rounded`](SolveError::Rounded) where rounding errors dominate;
    /// [`UnknownMode`](SolveError::UnknownMode), [`ModeNotAssembled`](SolveError::ModeNotAssembled) and
    /// [`Plan`](SolveError::Plan) where a mode is requested; [`NonFinite`](SolveError::NonFinite) and
    /// [`Length`](SolveError::Length) for arguments and parameters, here and in every other analysis.
    pub fn assemble(&self, at: &Instant<'_>) -> Result<Vec<f64>, SolveError> {
        let wanted = self.wanted()?;
        match self.position_by_plan(at, None) {
            Some(position) => Ok(position.q),
            None => assembled(self.equations(at)?, &wanted),
        }
    }

    /// The modes of a configuration: the sign of each, and how far it is from its limit.
    ///
    /// # Errors
    /// [`Plan`](SolveError::Plan) where there is no plan; [`NonFinite`](SolveError::NonFinite) and
    /// [`Length`](SolveError::Length).
    pub fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<Mode>, SolveError> {
        modes(&self.equations(at)?, q)
    }

    /// Assembles the mechanism from the guesses and returns it as [`Planned`], which follows the plan from there.
    /// Prescribed coordinates are not supported.
    ///
    /// # Errors
    /// As [`assemble`](Self::assemble), and [`Plan`](SolveError::Plan).
    pub fn planned(&self, at: &Instant<'_>) -> Result<Planned<'m, M>, SolveError> {
        if !self.settings.given.is_empty() {
            return Err(SolveError::Plan(PlanError::NoPlan { why: "coordinates are prescribed" }));
        }
        Ok(Planned::new(self.mechanism, at, &self.assemble(at)?)?)
    }

    /// Position analysis from a complete start, n numbers: the configuration near it.
    ///
    /// # Errors
    /// As [`assemble`](Self::assemble).
    pub fn position(&self, at: &Instant<'_>, start: &[f64]) -> Result<Position, SolveError> {
        match self.position_by_plan(at, Some(start)) {
            Some(position) => Ok(position),
            None => position(&mut self.equations(at)?, start),
        }
    }

    /// Velocity analysis of an assembled configuration: q̇ with Φ_q q̇ = −Φ_t.
    ///
    /// # Errors
    /// [`Singular`](SolveError::Singular) where Φ_q loses rank in this configuration alone,
    /// [`InconsistentVelocity`](SolveError::InconsistentVelocity) where redundant rows contradict the others,
    /// [`GivenConflict`](SolveError::GivenConflict).
    pub fn velocity(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, SolveError> {
        match self.rates_by_blocks(at, q, None) {
            Some(q_dot) => Ok(q_dot),
            None => velocity_at(&mut self.equations(at)?, q),
        }
    }

    /// Acceleration analysis of an assembled configuration with its q̇: q̈ with Φ_q q̈ = γ.
    ///
    /// # Errors
    /// As [`velocity`](Self::velocity), [`InconsistentAcceleration`](SolveError::InconsistentAcceleration), and
    /// [`Rounded`](SolveError::Rounded).
    pub fn acceleration(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, SolveError> {
        match self.rates_by_blocks(at, q, Some(q_dot)) {
            Some(q_ddot) => Ok(q_ddot),
            None => acceleration_at(&mut self.equations(at)?, q, q_dot),
        }
    }

    /// Assembly from the guesses, then velocity and acceleration.
    ///
    /// # Errors
    /// As [`assemble`](Self::assemble), [`velocity`](Self::velocity) and [`acceleration`](Self::acceleration);
    /// [`Plan`](SolveError::Plan) with the limit where a group is so near to a crossing of branches that rounding errors
    /// dominate the rates, and no smooth motion through the configuration gives them.
    pub fn state(&self, at: &Instant<'_>) -> Result<State, SolveError> {
        if let Some(state) = self.state_by_plan(at, None) {
            return Ok(state);
        }
        Ok(first_state(&mut self.equations(at)?, None, || self.wanted())?.0)
    }

    /// Position analysis from a complete start, then velocity and acceleration.
    ///
    /// Groups in closed form keep the modes of the start. An iteration may converge to a solution on another branch if
    /// the start is far from it; [`sweep`](Self::sweep) and [`tracker`](Self::tracker) follow a motion and never
    /// leave its branch.
    ///
    /// # Errors
    /// As [`state`](Self::state).
    pub fn state_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<State, SolveError> {
        if let Some(state) = self.state_by_plan(at, Some(start)) {
            return Ok(state);
        }
        Ok(first_state(&mut self.equations(at)?, Some(start), || self.wanted())?.0)
    }

    /// Motion of bodies, points, defines and joints.
    ///
    /// # Errors
    /// [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn motion(&self, state: &State) -> Result<Motion, SolveError> {
        motion_at(&mut self.equations_of(state)?, state, self.settings.sharing)
    }

    /// The values of quantities at a solved state, in their order, in the units of the mechanism and in radians. A
    /// value that does not exist is NaN: a transmission angle if an arm has no length, a force that redundant rows
    /// leave undetermined, a ratio to a driver that cannot move alone. Only the quantities in `measures` are computed.
    ///
    /// # Errors
    /// [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn measure(&self, state: &State, measures: &[Measure]) -> Result<Vec<f64>, SolveError> {
        match known(state, measures) {
            Some(known) => Ok(known),
            None => {
                values(scaled_around(&mut self.equations_of(state)?, state)?, state, measures, self.settings.sharing)
            }
        }
    }

    /// Efforts of drivers, reactions of joints, energies and powers at a solved state, from M q̈ + Φ_qᵀ λ = Q. Forces
    /// that redundant rows leave undetermined have no number.
    ///
    /// # Errors
    /// [`NoLoads`](SolveError::NoLoads) for a mechanism without masses and loads,
    /// [`NegativeMass`](SolveError::NegativeMass), [`NotHeld`](SolveError::NotHeld)
    /// where degrees of freedom are left that loads act along, [`UnboundedForces`](SolveError::UnboundedForces) in a
    /// singular configuration; [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn forces(&self, state: &State) -> Result<Forces, SolveError> {
        self.shared_forces(state, self.settings.sharing)
    }

    /// As [`forces`](Self::forces), but if redundant rows share a load, with the possible forces of least norm: the
    /// least sum of the squares of all forces in joints, times a typical length of the mechanism, and of all moments.
    /// Equal bodies that are placed symmetrically share equally; how real bodies share depends on their stiffness and
    /// on tolerances. [`Reaction::determined`](crate::Reaction::determined) is false for numbers that depend on this
    /// convention.
    ///
    /// # Errors
    /// As [`forces`](Self::forces).
    pub fn forces_of_least_norm(&self, state: &State) -> Result<Forces, SolveError> {
        self.shared_forces(state, Sharing::LeastNorm)
    }

    /// The forces of gravity, applied loads and springs on the bodies at a solved state, with their points, and their
    /// couples.
    ///
    /// # Errors
    /// For a mechanism without masses and loads, and when a list has another length.
    pub fn loads(&self, state: &State) -> Result<Vec<Load>, SolveError> {
        analysis::forces::loads(&self.equations_of(state)?, state)
    }

    fn shared_forces(&self, state: &State, sharing: Sharing) -> Result<Forces, SolveError> {
        analysis::forces::forces(&mut self.equations_of(state)?, state, sharing)
    }

    /// Estimated condition number of the scaled Φ_q at a state: see [`State::condition`].
    ///
    /// # Errors
    /// As [`velocity`](Self::velocity).
    pub fn condition(&self, state: &State) -> Result<f64, SolveError> {
        if let Some(condition) = state.condition {
            return Ok(condition);
        }
        Ok(factorize(scaled_around(&mut self.equations_of(state)?, state)?, &state.q, None)?.condition)
    }

    /// Degrees of freedom, independent coordinates, redundant rows and conditioning at a configuration.
    ///
    /// # Errors
    /// [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn mobility(&self, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError> {
        mobility(&mut self.equations(at)?, q)
    }

    /// Velocity ratios and second-order ratios per driving row and per input.
    ///
    /// # Errors
    /// As [`velocity`](Self::velocity); [`InconsistentVelocity`](SolveError::InconsistentVelocity) also if one driving
    /// row cannot move without another.
    pub fn velocity_ratios(&self, state: &State) -> Result<VelocityRatios, SolveError> {
        velocity_ratios(scaled_around(&mut self.equations_of(state)?, state)?, state)
    }

    /// ∂r_P/∂q of a named point, 2×n.
    ///
    /// # Errors
    /// [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn point_jacobian(&self, at: &Instant<'_>, q: &[f64], point: Point) -> Result<DMatrix<f64>, SolveError> {
        point_jacobian(&mut self.equations(at)?, q, point)
    }

    /// Transmission angles at the revolute joints between two moving bodies that each have another joint of the same dyad
    /// or group that acts at a point, or is the guide of a slider on the ground.
    ///
    /// # Errors
    /// [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn transmission_angles(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<TransmissionAngle>, SolveError> {
        transmission_angles(&mut self.equations(at)?, q)
    }

    /// The guesses; an error if one of them is for a coordinate that does not exist.
    pub(crate) fn checked_guess(&self) -> Result<Vec<Option<f64>>, SolveError> {
        are_of_coordinates(&self.settings.guesses, M::COORDINATES)?;
        Ok(self.guess())
    }

    /// The guesses, and the indices of the requested modes.
    pub(crate) fn wanted(&self) -> Result<WantedAssembly, SolveError> {
        wanted_assembly(&M::model().plan, self.checked_guess()?, &self.settings.modes)
    }

    /// The equations at an instant.
    pub(crate) fn equations(&self, at: &Instant<'_>) -> Result<Equations<'_>, SolveError> {
        self.equations_with(&self.settings.given, at)
    }

    /// The equations at the instant of a solved state, with the prescribed coordinates of the state.
    pub(crate) fn equations_of(&self, state: &State) -> Result<Equations<'_>, SolveError> {
        self.equations_with(&self.settings.given_at(state), &state.instant())
    }

    fn equations_with(&self, given: &[(usize, Signal)], at: &Instant<'_>) -> Result<Equations<'_>, SolveError> {
        let evaluator = Box::new(Evaluator::<_, M>::new(self.mechanism));
        Equations::new(evaluator, self.settings.options, given, self.settings.inputs, at)
    }
}

/// q of the assembled mechanism.
fn assembled(mut equations: Equations<'_>, wanted: &WantedAssembly) -> Result<Vec<f64>, SolveError> {
    Ok(assemble_in(&mut equations, wanted)?.q)
}

/// An error if a guess is for a coordinate that does not exist.
fn are_of_coordinates(guesses: &[(usize, f64)], coordinates: usize) -> Result<(), SolveError> {
    match guesses.iter().find(|(index, _)| *index >= coordinates) {
        Some(&(index, _)) => Err(SolveError::UnknownCoordinate { index, coordinates }),
        None => Ok(()),
    }
}

/// The equations, scaled around a state.
pub(crate) fn scaled_around<'e, 'a>(
    equations: &'e mut Equations<'a>,
    state: &State,
) -> Result<&'e mut Equations<'a>, SolveError> {
    equations.check("q", &state.q)?;
    equations.scale = Scale::around(equations, &state.q);
    Ok(equations)
}

fn velocity_at(equations: &mut Equations<'_>, q: &[f64]) -> Result<Vec<f64>, SolveError> {
    equations.check("q", q)?;
    equations.scale = Scale::around(equations, q);
    Ok(velocity(equations, q, None)?.0)
}

fn acceleration_at(equations: &mut Equations<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, SolveError> {
    equations.check("q", q)?;
    equations.check("q_dot", q_dot)?;
    equations.scale = Scale::around(equations, q);
    let factor = factorize(equations, q, None)?;
    let found = acceleration(equations, q, q_dot, &factor).map_err(|error| explain(equations, q, &factor, error))?;
    equations.check_slopes([q, q_dot, &found])?;
    Ok(found)
}

pub(crate) fn motion_at(equations: &mut Equations<'_>, state: &State, sharing: Sharing) -> Result<Motion, SolveError> {
    let mut motion = motion(equations, state)?;
    // Forces are optional: without them the motion is still valid.
    if equations.model.forces.is_some() {
        motion.forces = analysis::forces::forces(equations, state, sharing).ok();
    }
    Ok(motion)
}

/// The values of quantities, if a state alone determines all of them.
fn known(state: &State, measures: &[Measure]) -> Option<Vec<f64>> {
    measures.iter().map(|measure| measure.of_state(state)).collect()
}

/// The guesses, and the indices of the modes that are requested by name or index.
fn wanted_assembly(
    plan: &Plan,
    guess: Vec<Option<f64>>,
    modes: &[(String, Option<usize>, Sign)],
) -> Result<WantedAssembly, SolveError> {
    let index = |(mode, index, sign): &(String, Option<usize>, Sign)| match index {
        Some(index) => Ok((*index, *sign)),
        None => {
            if let Some(why) = plan.absent {
                return Err(SolveError::Plan(PlanError::NoPlan { why }));
            }
            let modes = plan.modes.iter().map(|mode| mode.name).collect();
            Err(SolveError::UnknownMode { mode: mode.clone(), modes })
        }
    };
    Ok(WantedAssembly { guess, modes: modes.iter().map(index).collect::<Result<_, _>>()? })
}

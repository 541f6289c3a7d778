//! What a mechanism is to do: quantities that are to have given values at instants that are given or free.

use super::error::DesignError;
use crate::mechanism::Mechanism;
use crate::model::{Component, CoordinateKind, Model};
use crate::motion::Motion;
use crate::sensitivity::{Number, Varied};
use crate::signal::Signal;
use crate::state::State;
use core::f64::consts::TAU;

/// In which direction of time a path is to be passed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// With time.
    #[default]
    Forward,
    /// Against it.
    Backward,
    /// Either way: every start takes one of them at random.
    Either,
}

/// A number of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Quantity {
    /// A coordinate; the flag says that whole turns do not count.
    Coordinate(usize, bool),
    /// A component of a point.
    Point(usize, usize),
    /// x, y or φ of a body.
    Pose(usize, usize),
    Define(usize),
}

impl Quantity {
    /// The quantity of this name.
    pub(crate) fn named<M: Mechanism>(name: &str) -> Result<Self, DesignError> {
        let model = M::model();
        if let Some(place) = model.coordinates.iter().position(|info| info.name == name) {
            let turns = matches!(model.coordinates[place].kind, CoordinateKind::Pose { component: Component::Phi, .. });
            return Ok(Self::Coordinate(place, turns));
        }
        if let Some(place) = model.defines.iter().position(|info| info.name == name) {
            return Ok(Self::Define(place));
        }
        let (body, component) = name.rsplit_once('.').unwrap_or((name, ""));
        let axis = ["x", "y", "phi"].iter().position(|axis| *axis == component);
        let found = axis.and_then(|axis| match model.points.iter().position(|info| info.name == body) {
            Some(place) if axis < 2 => Some(Self::Point(place, axis)),
            _ => model.bodies.iter().position(|info| info.name == body).map(|place| Self::Pose(place, axis)),
        });
        found.ok_or_else(|| DesignError::UnknownQuantity { quantity: name.to_owned() })
    }

    /// Both components of a point.
    pub(crate) fn point<M: Mechanism>(name: &str) -> Result<[Self; 2], DesignError> {
        let place = M::model().points.iter().position(|info| info.name == name);
        let place = place.ok_or_else(|| DesignError::UnknownQuantity { quantity: name.to_owned() })?;
        Ok([0, 1].map(|axis| Self::Point(place, axis)))
    }

    /// x, y and φ of a body.
    pub(crate) fn pose<M: Mechanism>(name: &str) -> Result<[Self; 3], DesignError> {
        let place = M::model().bodies.iter().position(|info| info.name == name);
        let place = place.ok_or_else(|| DesignError::UnknownQuantity { quantity: name.to_owned() })?;
        Ok([0, 1, 2].map(|axis| Self::Pose(place, axis)))
    }

    /// True where it is not part of a state.
    pub(crate) const fn needs_motion(self) -> bool {
        matches!(self, Self::Define(_))
    }

    /// Value and rate.
    pub(crate) fn at(self, state: &State, motion: Option<&Motion>) -> (f64, f64) {
        match self {
            Self::Coordinate(place, _) => (state.q[place], state.q_dot[place]),
            Self::Point(place, axis) => (state.points[place].r[axis], state.points[place].v[axis]),
            Self::Pose(place, axis) => {
                let body = &state.bodies[place];
                [(body.x, body.x_dot), (body.y, body.y_dot), (body.phi, body.phi_dot)][axis]
            }
            Self::Define(place) => {
                let Signal { value, rate, .. } = motion.map_or(Signal::default(), |motion| motion.defines[place]);
                (value, rate)
            }
        }
    }

    /// The number with its derivatives.
    pub(crate) fn varied(self, model: &Model, varied: &Varied) -> Option<Number> {
        let observed = |place: usize| varied.observed.get(place).map(|signal| signal.value);
        match self {
            Self::Coordinate(place, _) => varied.q.get(place).copied(),
            Self::Point(place, axis) => observed(model.points[place].observables[axis]),
            Self::Pose(place, axis) => observed(model.bodies[place].observables[axis]),
            Self::Define(place) => observed(model.defines[place].observable),
        }
    }

    /// By how much a value misses another.
    pub(crate) fn miss(self, value: f64, wanted: f64) -> f64 {
        let miss = value - wanted;
        match self {
            Self::Coordinate(_, true) | Self::Pose(_, 2) => miss - TAU * (miss / TAU).round(),
            _ => miss,
        }
    }
}

/// A quantity that is to have a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Goal {
    pub(crate) of: Quantity,
    pub(crate) value: f64,
    pub(crate) weight: f64,
}

/// Instants that are variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FreeInstants {
    pub(crate) period: f64,
    pub(crate) direction: Direction,
}

/// Goals, instant by instant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Objective {
    pub(crate) goals: Vec<Vec<Goal>>,
    /// The instants; empty where they are free.
    pub(crate) times: Vec<f64>,
    pub(crate) free: Option<FreeInstants>,
}

impl Objective {
    pub(crate) fn timed(goals: Vec<(f64, Vec<Goal>)>) -> Result<Self, DesignError> {
        let (times, goals): (Vec<f64>, Vec<Vec<Goal>>) = goals.into_iter().unzip();
        if !times.iter().all(|t| t.is_finite()) {
            return Err(DesignError::NotFinite { what: "the instants" });
        }
        Self { goals, times, free: None }.checked()
    }

    pub(crate) fn untimed(goals: Vec<Vec<Goal>>, period: f64, direction: Direction) -> Result<Self, DesignError> {
        if !(period.is_finite() && period > 0.0) {
            return Err(DesignError::NotFinite { what: "the period" });
        }
        Self { goals, times: Vec::new(), free: Some(FreeInstants { period, direction }) }.checked()
    }

    fn checked(self) -> Result<Self, DesignError> {
        let finite = self.goals.iter().flatten().all(|goal| goal.value.is_finite() && goal.weight.is_finite());
        if finite { Ok(self) } else { Err(DesignError::NotFinite { what: "what is wanted" }) }
    }

    /// Variables of its own: as many as it has instants that are free.
    pub(crate) fn variables(&self) -> usize {
        if self.free.is_some() { self.goals.len() } else { 0 }
    }
}

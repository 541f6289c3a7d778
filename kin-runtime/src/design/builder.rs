//! A design as it is written: what may vary, what is wanted, what must hold.

use super::condition::{Condition, Shortest};
use super::error::DesignError;
use super::objective::{Direction, Goal, Objective, Quantity};
use super::variables::{self, Free};
use crate::mechanism::Mechanism;
use crate::planned::Sign;
use core::ops::RangeInclusive;

/// What a mechanism is to do, and what may vary.
///
/// Parameters that are not free keep the values that the mechanism has.
pub struct Design<M: Mechanism> {
    /// Makes the mechanism whose parameters are set.
    pub(crate) make: fn() -> M,
    /// The parameters with which the search begins.
    pub(crate) parameters: Vec<f64>,
    pub(crate) free: Vec<Free>,
    pub(crate) objectives: Vec<Objective>,
    pub(crate) conditions: Vec<Condition>,
    /// Places of modes; both signs are tried where none is asked for.
    pub(crate) modes: Vec<(usize, Option<Sign>)>,
    pub(crate) guesses: Vec<(usize, f64)>,
}

impl<M: Mechanism> Design<M> {
    /// A design that begins with the parameters of this mechanism. Functions that are supplied are those of the default.
    pub fn new(mechanism: &M) -> Self
    where
        M: Default,
    {
        Self {
            make: M::default,
            parameters: mechanism.parameters::<f64>().as_ref().to_vec(),
            free: Vec::new(),
            objectives: Vec::new(),
            conditions: Vec::new(),
            modes: Vec::new(),
            guesses: Vec::new(),
        }
    }

    /// Lets a parameter vary within these bounds, in the unit of the parameter.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter), [`Bounds`](DesignError::Bounds).
    pub fn free(mut self, parameter: &str, bounds: RangeInclusive<f64>) -> Result<Self, DesignError> {
        let place = variables::place::<M>(parameter)?;
        let (low, high) = bounds.into_inner();
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(DesignError::Bounds { parameter: parameter.to_owned(), low, high });
        }
        self.free.retain(|free| free.places != [place]);
        self.free.push(Free { places: vec![place], low, high });
        Ok(self)
    }

    /// Keeps a parameter equal to one that is free.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter), [`NotFree`](DesignError::NotFree).
    pub fn equal(mut self, parameter: &str, to: &str) -> Result<Self, DesignError> {
        let (place, leader) = (variables::place::<M>(parameter)?, variables::place::<M>(to)?);
        match self.free.iter_mut().find(|free| free.places.contains(&leader)) {
            Some(free) => free.places.push(place),
            None => return Err(DesignError::NotFree { parameter: to.to_owned() }),
        }
        Ok(self)
    }

    /// A point is to be at given places at given instants, (t, [x, y]).
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn path_at(mut self, point: &str, places: &[(f64, [f64; 2])]) -> Result<Self, DesignError> {
        let axes = Quantity::point::<M>(point)?;
        let goal = |value: [f64; 2]| (0..2).map(|k| Goal { of: axes[k], value: value[k], weight: 1.0 }).collect();
        let goals = places.iter().map(|(t, place)| (*t, goal(*place))).collect();
        self.objectives.push(Objective::timed(goals)?);
        Ok(self)
    }

    /// A point is to pass given places in their order within one period of the drive, whenever it likes.
    ///
    /// The instants are variables of the search as the free parameters are; between the first and the last passes no more
    /// than one period.
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn path(
        mut self,
        point: &str,
        places: &[[f64; 2]],
        period: f64,
        direction: Direction,
    ) -> Result<Self, DesignError> {
        let axes = Quantity::point::<M>(point)?;
        let goal = |value: [f64; 2]| (0..2).map(|k| Goal { of: axes[k], value: value[k], weight: 1.0 }).collect();
        let goals = places.iter().map(|place| goal(*place)).collect();
        self.objectives.push(Objective::untimed(goals, period, direction)?);
        Ok(self)
    }

    /// A quantity is to have given values at given instants, (t, value): a coordinate (`rocker.phi`), a component of a point
    /// (`tip.x`) or a define. Angles of bodies count as equal when they differ by whole turns.
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn function(mut self, quantity: &str, values: &[(f64, f64)]) -> Result<Self, DesignError> {
        let of = Quantity::named::<M>(quantity)?;
        let goals = values.iter().map(|&(t, value)| (t, vec![Goal { of, value, weight: 1.0 }])).collect();
        self.objectives.push(Objective::timed(goals)?);
        Ok(self)
    }

    /// A body is to take given poses at given instants, (t, [x, y, φ]) of its origin and angle; a radian that it is turned
    /// too far counts as much as the distance `arm`.
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn poses(mut self, body: &str, poses: &[(f64, [f64; 3])], arm: f64) -> Result<Self, DesignError> {
        let axes = Quantity::pose::<M>(body)?;
        let goal = |value: [f64; 3]| {
            (0..3).map(|k| Goal { of: axes[k], value: value[k], weight: if k == 2 { arm } else { 1.0 } }).collect()
        };
        let goals = poses.iter().map(|(t, pose)| (*t, goal(*pose))).collect();
        self.objectives.push(Objective::timed(goals)?);
        Ok(self)
    }

    /// A sum of multiples of parameters is to be no less than this: Σ factor · parameter ≥ least.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter).
    pub fn at_least(mut self, terms: &[(&str, f64)], least: f64) -> Result<Self, DesignError> {
        self.conditions.push(Condition::sum::<M>(terms, least)?);
        Ok(self)
    }

    /// Grashof's condition for the lengths of a four-bar, named in the order ground, crank, coupler, rocker: the shortest and
    /// the longest are together no longer than the two others, and the shortest is the one that is said.
    ///
    /// With the crank or the ground as the shortest, the crank turns fully.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter).
    pub fn grashof(mut self, lengths: [&str; 4], shortest: Shortest) -> Result<Self, DesignError> {
        self.conditions.extend(Condition::grashof::<M>(lengths, shortest)?);
        Ok(self)
    }

    /// The mechanism is to move on through all of a period from the instant 0, with the margins of its plan above `least`, at
    /// `instants` of them that are equally far apart. A margin is 0 where a group cannot close and 1 far from that.
    ///
    /// # Errors
    /// [`NotFinite`](DesignError::NotFinite).
    pub fn turns(mut self, period: f64, instants: usize, least: f64) -> Result<Self, DesignError> {
        self.conditions.push(Condition::turns(period, instants, least)?);
        Ok(self)
    }

    /// A quantity is to stay within a range over a period, at `instants` of them that are equally far apart.
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn range(
        mut self,
        quantity: &str,
        range: RangeInclusive<f64>,
        period: f64,
        instants: usize,
    ) -> Result<Self, DesignError> {
        let name = quantity.to_owned();
        self.conditions.push(Condition::range(name, Quantity::named::<M>(quantity)?, range, period, instants)?);
        Ok(self)
    }

    /// Asks for an assembly mode; with no sign both are tried. What is not asked for is as the guesses of the mechanism have
    /// it.
    ///
    /// # Errors
    /// [`UnknownMode`](DesignError::UnknownMode).
    pub fn mode(mut self, mode: &str, sign: Option<Sign>) -> Result<Self, DesignError> {
        let modes = M::model().plan.modes;
        let Some(place) = modes.iter().position(|info| info.name == mode) else {
            let modes = modes.iter().map(|info| info.name).collect();
            return Err(DesignError::UnknownMode { mode: mode.to_owned(), modes });
        };
        self.modes.retain(|(other, _)| *other != place);
        self.modes.push((place, sign));
        Ok(self)
    }

    /// Where assembly starts, as [`Solver::with_guess`](crate::Solver::with_guess).
    #[must_use]
    pub fn guess(mut self, coordinate: usize, value: f64) -> Self {
        self.guesses.push((coordinate, value));
        self
    }
}

//! The description of a design: free parameters, objectives and conditions.

use super::condition::Shortest;
use super::error::DesignError;
use super::objective::Direction;
use super::task::Task;
use crate::mechanism::Mechanism;
use crate::planned::Sign;
use crate::results::varied::Number;
use core::ops::RangeInclusive;
use std::sync::Arc;

/// A task of synthesis: what a mechanism is to do, and which parameters may vary.
///
/// Parameters that are not free keep the values that the mechanism has.
pub struct Design<M: Mechanism> {
    /// Makes the mechanism whose parameters are set.
    pub(crate) make: fn() -> M,
    pub(crate) task: Task,
}

impl<M: Mechanism> Clone for Design<M> {
    fn clone(&self) -> Self {
        Self { make: self.make, task: self.task.clone() }
    }
}

impl<M: Mechanism> Design<M> {
    /// A design that begins with the parameters of this mechanism. Supplied functions are those of the default
    /// mechanism.
    pub fn new(mechanism: &M) -> Self
    where
        M: Default,
    {
        Self { make: M::default, task: Task::new(M::model(), mechanism.parameters::<f64>().as_ref().to_vec()) }
    }

    /// Lets a parameter vary within these bounds, in the unit of the parameter.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter), [`Bounds`](DesignError::Bounds),
    /// [`Twice`](DesignError::Twice).
    pub fn free(mut self, parameter: &str, bounds: RangeInclusive<f64>) -> Result<Self, DesignError> {
        self.task.free(parameter, bounds)?;
        Ok(self)
    }

    /// Keeps a parameter equal to one that is free.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter), [`NotFree`](DesignError::NotFree),
    /// [`Twice`](DesignError::Twice).
    pub fn equal(mut self, parameter: &str, to: &str) -> Result<Self, DesignError> {
        self.task.equal(parameter, to)?;
        Ok(self)
    }

    /// A point is to be at given places at given instants, (t, [x, y]).
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn path_at(mut self, point: &str, places: &[(f64, [f64; 2])]) -> Result<Self, DesignError> {
        self.task.path_at(point, places)?;
        Ok(self)
    }

    /// A point is to pass given places in their order within one period of the drive, at any instants.
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
        self.task.path(point, places, period, direction)?;
        Ok(self)
    }

    /// A quantity is to have given values at given instants, (t, value). Quantities are those of
    /// [`Measure`](crate::Measure) but velocity ratios: coordinates (`rocker.phi`), components of points (`tip.x`), defines,
    /// quantities of joints, transmission angles (`B.transmission`), their rates and accelerations, forces for which there is a
    /// closed form (`drive.effort`); and `x`, `y` and `phi` of every body. Angles of bodies count as equal when they differ by whole turns.
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NoDerivatives`](DesignError::NoDerivatives),
    /// [`NotFinite`](DesignError::NotFinite).
    pub fn function(mut self, quantity: &str, values: &[(f64, f64)]) -> Result<Self, DesignError> {
        self.task.function(quantity, values)?;
        Ok(self)
    }

    /// A body is to take given poses at given instants, (t, [x, y, φ]) of its origin and angle; an error of one radian
    /// counts as much as the distance `arm`.
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NotFinite`](DesignError::NotFinite).
    pub fn poses(mut self, body: &str, poses: &[(f64, [f64; 3])], arm: f64) -> Result<Self, DesignError> {
        self.task.poses(body, poses, arm)?;
        Ok(self)
    }

    /// Numbers of your own are to be 0: a function of quantities over a motion.
    ///
    /// `residuals` receives the quantities at every instant, in the order of their names, and returns numbers whose
    /// squares are added to the error, always equally many. It computes with [`Number`]s, which carry their derivatives
    /// with respect to the free parameters: sums, products and functions of [`Scalar`](crate::Scalar) keep them.
    ///
    /// ```
    /// use kin_runtime::design::{Design, Number, Search};
    /// use kin_runtime::{Scalar, mechanism};
    ///
    /// /// A crank that moves a slider by a rod.
    /// #[mechanism]
    /// #[body(crank, x = 0, y = 0)]
    /// #[body(slider, y = 0, phi = 0)]
    /// #[distance(rod: crank @ (r, 0), slider @ (0, 0), length = 0.7)]
    /// #[driver(drive: crank.phi = t)]
    /// #[guess(slider.x = 0.7)]
    /// struct SliderCrank {
    ///     #[param(0.2)]
    ///     r: f64,
    /// }
    ///
    /// # fn main() -> Result<(), kin_runtime::design::DesignError> {
    /// // Between t = 0 and t = π the slider moves by 2 r, and that is to be 0.3.
    /// let stroke = |at: &[Vec<Number>]| vec![at[0][0] - at[1][0] - Number::from_f64(0.3)];
    /// let found = Design::new(&SliderCrank::default())
    ///     .free("r", 0.05..=0.5)?
    ///     .residuals(&["slider.x"], &[0.0, std::f64::consts::PI], stroke)?
    ///     .search(&Search { starts: 2, ..Search::default() })?;
    /// assert!((found.mechanism.r - 0.15).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NoDerivatives`](DesignError::NoDerivatives),
    /// [`NotFinite`](DesignError::NotFinite).
    pub fn residuals(
        mut self,
        quantities: &[&str],
        times: &[f64],
        residuals: impl Fn(&[Vec<Number>]) -> Vec<Number> + Send + Sync + 'static,
    ) -> Result<Self, DesignError> {
        self.task.residuals(quantities, times, Arc::new(residuals))?;
        Ok(self)
    }

    /// A number of your own is to be as small as it can be: a function of quantities over a motion that is no sum of squares,
    /// such as the greatest torque.
    ///
    /// `least` receives the quantities at every instant, in the order of their names. The search then needs no
    /// derivatives: it tries designs around every start, in a large region at first and in smaller and smaller ones
    /// later. The motion between the instants is not evaluated.
    ///
    /// ```
    /// use kin_runtime::design::{Design, Search};
    /// use kin_runtime::mechanism;
    ///
    /// /// An arm with a counterweight.
    /// #[mechanism]
    /// #[bodies(arm)]
    /// #[revolute(O: ground @ (0, 0), arm @ (0, 0))]
    /// #[driver(motor: arm.phi = t)]
    /// #[gravity(0, -9.81)]
    /// #[mass(arm @ (0.5, 0), mass = 1)]
    /// #[mass(arm @ (-c, 0), mass = 2)]
    /// struct Arm {
    ///     #[param(0.1)]
    ///     c: f64,
    /// }
    ///
    /// # fn main() -> Result<(), kin_runtime::design::DesignError> {
    /// let greatest = |at: &[Vec<f64>]| at.iter().map(|torque| torque[0].abs()).fold(0.0, f64::max);
    /// let found = Design::new(&Arm::default())
    ///     .free("c", 0.01..=0.6)?
    ///     .least(&["motor.effort"], &[0.0, 0.5, 1.0, 1.5], greatest)?
    ///     .search(&Search { starts: 2, ..Search::default() })?;
    /// assert!((found.mechanism.c - 0.25).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`residuals`](Self::residuals).
    pub fn least(
        mut self,
        quantities: &[&str],
        times: &[f64],
        least: impl Fn(&[Vec<f64>]) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, DesignError> {
        self.task.least(quantities, times, Arc::new(least))?;
        Ok(self)
    }

    /// A sum of multiples of parameters is to be no less than this: Σ factor · parameter ≥ least.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter).
    pub fn at_least(mut self, terms: &[(&str, f64)], least: f64) -> Result<Self, DesignError> {
        self.task.at_least(terms, least)?;
        Ok(self)
    }

    /// Grashof's condition for the lengths of a four-bar, named in the order ground, crank, coupler, rocker: the
    /// shortest and the longest are together no longer than the two others, and the shortest is the given one.
    ///
    /// With the crank or the ground as the shortest, the crank turns fully.
    ///
    /// # Errors
    /// [`UnknownParameter`](DesignError::UnknownParameter).
    pub fn grashof(mut self, lengths: [&str; 4], shortest: Shortest) -> Result<Self, DesignError> {
        self.task.grashof(lengths, shortest)?;
        Ok(self)
    }

    /// The mechanism is to move on through all of a period from the instant 0, with the margins of its plan above
    /// `least`. A margin is 0 at the limit beyond which a group cannot close and 1 far from all limits.
    ///
    /// The search evaluates this many equally spaced `instants`; the result is checked between them as well
    /// ([`Slack`](super::Slack)).
    ///
    /// # Errors
    /// [`NotFinite`](DesignError::NotFinite).
    pub fn turns(mut self, period: f64, instants: usize, least: f64) -> Result<Self, DesignError> {
        self.task.turns(period, instants, least)?;
        Ok(self)
    }

    /// A quantity, named as for [`function`](Self::function), is to stay within a range over a period.
    ///
    /// The search evaluates this many equally spaced `instants`; the result is checked between them as well
    /// ([`Slack`](super::Slack)).
    ///
    /// # Errors
    /// [`UnknownQuantity`](DesignError::UnknownQuantity), [`NoDerivatives`](DesignError::NoDerivatives),
    /// [`Bounds`](DesignError::Bounds), [`NotFinite`](DesignError::NotFinite).
    pub fn range(
        mut self,
        quantity: &str,
        range: RangeInclusive<f64>,
        period: f64,
        instants: usize,
    ) -> Result<Self, DesignError> {
        self.task.range(quantity, range, period, instants)?;
        Ok(self)
    }

    /// All transmission angles at a revolute joint are to stay between `least` and π − `least` over a period: force is
    /// transmitted best at π/2, and not at all at 0 and π.
    ///
    /// The search evaluates this many equally spaced `instants`; the result is checked between them as well
    /// ([`Slack`](super::Slack)).
    ///
    /// # Errors
    /// [`NoTransmission`](DesignError::NoTransmission) where the joint has no transmission angle;
    /// [`Bounds`](DesignError::Bounds), [`NotFinite`](DesignError::NotFinite).
    pub fn transmission(mut self, joint: &str, least: f64, period: f64, instants: usize) -> Result<Self, DesignError> {
        self.task.transmission(joint, least, period, instants)?;
        Ok(self)
    }

    /// Prescribes an assembly mode; with no sign both are tried. Modes that are not prescribed are those of the
    /// mechanism's guesses.
    ///
    /// # Errors
    /// [`UnknownMode`](DesignError::UnknownMode).
    pub fn mode(mut self, mode: &str, sign: Option<Sign>) -> Result<Self, DesignError> {
        self.task.mode(mode, sign)?;
        Ok(self)
    }

    /// Where assembly starts, as [`Solver::with_guess`](crate::Solver::with_guess).
    #[must_use]
    pub fn guess(mut self, coordinate: usize, value: f64) -> Self {
        self.task.guesses.push((coordinate, value));
        self
    }
}

//! Signals known only at run time, and instants: a time with the values of the inputs at that time.

use crate::model::Input;
use crate::scalar::Scalar;
use crate::text::{number, rates, separated};
use core::fmt;
use core::ops::{Index, IndexMut};

/// Value, rate and acceleration of an input.
///
/// Inputs come in the order of declaration, in an array that the mechanism's handles index:
///
/// ```
/// use kin_runtime::{Instant, Kinematics, Mechanism, Signal, mechanism};
///
/// #[mechanism]
/// #[bodies(arm)]
/// #[input(lift)]
/// #[revolute(pin: ground @ (0, 0), arm @ (0, 0))]
/// #[driver(raise: arm.phi = lift)]
/// struct Arm;
///
/// # fn main() -> Result<(), kin_runtime::SolveError> {
/// let mut inputs = [Signal::default(); Arm::INPUTS];
/// inputs[Arm::lift] = Signal::new(0.5, 0.1, 0.0);
/// let state = Arm.state_at(&Instant { t: 0.0, inputs: &inputs })?;
/// assert_eq!(state.q_dot[2], 0.1);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Signal<T = f64> {
    /// u.
    pub value: T,
    /// u̇.
    pub rate: T,
    /// ü.
    pub acceleration: T,
}

impl<T> Signal<T> {
    /// A signal with this value, rate and acceleration.
    pub const fn new(value: T, rate: T, acceleration: T) -> Self {
        Self { value, rate, acceleration }
    }

    /// A constant signal.
    pub fn constant(value: T) -> Self
    where
        T: Scalar,
    {
        Self { value, rate: T::from_f64(0.0), acceleration: T::from_f64(0.0) }
    }

    /// Applies a function to value, rate and acceleration, for example a conversion to another scalar type.
    pub fn map<U>(self, mut scalar: impl FnMut(T) -> U) -> Signal<U> {
        Signal { value: scalar(self.value), rate: scalar(self.rate), acceleration: scalar(self.acceleration) }
    }
}

impl<T: Scalar> Signal<T> {
    /// The signal a time `dt` later, with constant acceleration: u + dt u̇ + ½ dt² ü, u̇ + dt ü.
    pub fn after(self, dt: T) -> Self {
        let Self { value, rate, acceleration } = self;
        let half = T::from_f64(0.5) * dt * acceleration;
        Self { value: value + dt * (rate + half), rate: rate + dt * acceleration, acceleration }
    }
}

impl<T> Index<Input> for [Signal<T>] {
    type Output = Signal<T>;

    fn index(&self, input: Input) -> &Signal<T> {
        &self[input.0]
    }
}

impl<T> IndexMut<Input> for [Signal<T>] {
    fn index_mut(&mut self, input: Input) -> &mut Signal<T> {
        &mut self[input.0]
    }
}

/// An instant: a time, and the inputs at that time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant<'a, T = f64> {
    /// Time t.
    pub t: T,
    /// The inputs, in the order of declaration; empty where the mechanism has none.
    pub inputs: &'a [Signal<T>],
}

impl<T> Instant<'_, T> {
    /// An instant of a mechanism without inputs.
    pub const fn at(t: T) -> Self {
        Self { t, inputs: &[] }
    }
}

impl From<f64> for Instant<'static> {
    fn from(t: f64) -> Self {
        Self::at(t)
    }
}

/// For example `0.9 (rate 0.2, acceleration 0)`.
impl<T: fmt::Display> fmt::Display for Signal<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        rates(f, [&self.value, &self.rate, &self.acceleration])
    }
}

/// For example `t = 0.1`, followed by the inputs where there are any.
impl<T: fmt::Display> fmt::Display for Instant<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("t = ")?;
        number(f, &self.t)?;
        if self.inputs.is_empty() {
            return Ok(());
        }
        f.write_str(", inputs ")?;
        separated(f, self.inputs, |f, input| input.fmt(f))
    }
}

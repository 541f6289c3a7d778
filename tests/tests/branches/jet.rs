//! Numbers with their first two derivatives with respect to time, so that a closed form of the position also gives
//! velocity and acceleration. They are independent of kin.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value, its rate and its acceleration.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Jet {
    pub(crate) x: f64,
    pub(crate) v: f64,
    pub(crate) a: f64,
}

impl Jet {
    pub(crate) const fn new(x: f64, v: f64, a: f64) -> Self {
        Self { x, v, a }
    }

    /// The time as a variable.
    pub(crate) const fn time(t: f64) -> Self {
        Self::new(t, 1.0, 0.0)
    }

    /// f of this number by the chain rule, from f and its first two derivatives.
    fn chain(self, f: f64, d: f64, dd: f64) -> Self {
        Self::new(f, d * self.v, dd * self.v * self.v + d * self.a)
    }

    pub(crate) fn sin(self) -> Self {
        let (sin, cos) = self.x.sin_cos();
        self.chain(sin, cos, -sin)
    }

    pub(crate) fn cos(self) -> Self {
        let (sin, cos) = self.x.sin_cos();
        self.chain(cos, -sin, -cos)
    }

    pub(crate) fn sqrt(self) -> Self {
        let root = self.x.sqrt();
        self.chain(root, 0.5 / root, -0.25 / (root * self.x))
    }

    /// The angle of the vector (`other`, `self`); NaN where both are 0.
    pub(crate) fn atan2(self, other: Self) -> Self {
        let (y, x) = (self, other);
        let square = x.x * x.x + y.x * y.x;
        let turn = x.x * y.v - y.x * x.v;
        let rate = turn / square;
        let growth = 2.0 * (x.x * x.v + y.x * y.v) / square;
        Self::new(y.x.atan2(x.x), rate, (x.x * y.a - y.x * x.a) / square - growth * rate)
    }
}

impl From<f64> for Jet {
    fn from(x: f64) -> Self {
        Self::new(x, 0.0, 0.0)
    }
}

impl Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self::new(-self.x, -self.v, -self.a)
    }
}

impl<T: Into<Jet>> Add<T> for Jet {
    type Output = Self;

    fn add(self, other: T) -> Self {
        let o = other.into();
        Self::new(self.x + o.x, self.v + o.v, self.a + o.a)
    }
}

impl<T: Into<Jet>> Sub<T> for Jet {
    type Output = Self;

    fn sub(self, other: T) -> Self {
        self + -other.into()
    }
}

impl<T: Into<Jet>> Mul<T> for Jet {
    type Output = Self;

    fn mul(self, other: T) -> Self {
        let o = other.into();
        Self::new(self.x * o.x, self.v * o.x + self.x * o.v, self.a * o.x + 2.0 * self.v * o.v + self.x * o.a)
    }
}

impl<T: Into<Jet>> Div<T> for Jet {
    type Output = Self;

    fn div(self, other: T) -> Self {
        let o = other.into();
        let x = self.x / o.x;
        let v = (self.v - x * o.v) / o.x;
        Self::new(x, v, (self.a - 2.0 * v * o.v - x * o.a) / o.x)
    }
}

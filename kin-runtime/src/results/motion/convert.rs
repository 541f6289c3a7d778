//! Conversions of motions from signals, and to the types of nalgebra.

use super::{BodyMotion, PointMotion, Signal};
use crate::model::Component;
use nalgebra::{Isometry2, Point2, Vector2, Vector3};

impl From<[Signal; 3]> for BodyMotion {
    /// From the signals of x, y and φ.
    fn from([x, y, phi]: [Signal; 3]) -> Self {
        Self {
            x: x.value,
            y: y.value,
            phi: phi.value,
            x_dot: x.rate,
            y_dot: y.rate,
            phi_dot: phi.rate,
            x_ddot: x.acceleration,
            y_ddot: y.acceleration,
            phi_ddot: phi.acceleration,
        }
    }
}

impl From<[Signal; 2]> for PointMotion {
    /// From the signals of x and y.
    fn from([x, y]: [Signal; 2]) -> Self {
        Self { r: [x.value, y.value], v: [x.rate, y.rate], a: [x.acceleration, y.acceleration] }
    }
}

impl Signal {
    /// The signal of something that is missing: NaN.
    pub(crate) const UNKNOWN: Self = Self { value: f64::NAN, rate: f64::NAN, acceleration: f64::NAN };

    /// A value whose rates are unknown.
    fn without_rates(value: f64) -> Self {
        Self { value, ..Self::UNKNOWN }
    }
}

impl BodyMotion {
    /// The pose alone; its rates are unknown.
    pub(crate) fn without_rates(&self) -> Self {
        Self::from([self.x, self.y, self.phi].map(Signal::without_rates))
    }

    /// One coordinate of the pose with its rates.
    #[doc(hidden)]
    pub const fn rates(&self, component: Component) -> Signal {
        match component {
            Component::X => Signal { value: self.x, rate: self.x_dot, acceleration: self.x_ddot },
            Component::Y => Signal { value: self.y, rate: self.y_dot, acceleration: self.y_ddot },
            Component::Phi => Signal { value: self.phi, rate: self.phi_dot, acceleration: self.phi_ddot },
        }
    }

    /// The pose: the transformation of body-fixed coordinates to the inertial frame, r + A(φ) s′.
    pub fn pose(&self) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(self.x, self.y), self.phi)
    }

    /// (ẋ, ẏ, φ̇).
    pub const fn velocity(&self) -> Vector3<f64> {
        Vector3::new(self.x_dot, self.y_dot, self.phi_dot)
    }

    /// (ẍ, ÿ, φ̈).
    pub const fn acceleration(&self) -> Vector3<f64> {
        Vector3::new(self.x_ddot, self.y_ddot, self.phi_ddot)
    }

    /// The motion of the point with body-fixed coordinates `local`:
    ///
    /// ```text
    /// r_P = r + A s′,   ṙ_P = ṙ + φ̇ perp(A s′),   r̈_P = r̈ + φ̈ perp(A s′) − φ̇² A s′
    /// ```
    pub fn point(&self, local: [f64; 2]) -> PointMotion {
        let (sin, cos) = self.phi.sin_cos();
        let [x, y] = [cos * local[0] - sin * local[1], sin * local[0] + cos * local[1]];
        let turning = self.phi_dot * self.phi_dot;
        PointMotion {
            r: [self.x + x, self.y + y],
            v: [self.x_dot - self.phi_dot * y, self.y_dot + self.phi_dot * x],
            a: [self.x_ddot - self.phi_ddot * y - turning * x, self.y_ddot + self.phi_ddot * x - turning * y],
        }
    }
}

impl From<BodyMotion> for Isometry2<f64> {
    fn from(motion: BodyMotion) -> Self {
        motion.pose()
    }
}

impl PointMotion {
    /// The place alone; its rates are unknown.
    pub(crate) fn without_rates(&self) -> Self {
        Self::from(self.r.map(Signal::without_rates))
    }

    /// The position.
    pub const fn position(&self) -> Point2<f64> {
        Point2::new(self.r[0], self.r[1])
    }

    /// The velocity.
    pub const fn velocity(&self) -> Vector2<f64> {
        Vector2::new(self.v[0], self.v[1])
    }

    /// The acceleration.
    pub const fn acceleration(&self) -> Vector2<f64> {
        Vector2::new(self.a[0], self.a[1])
    }
}

impl From<PointMotion> for Point2<f64> {
    fn from(motion: PointMotion) -> Self {
        motion.position()
    }
}

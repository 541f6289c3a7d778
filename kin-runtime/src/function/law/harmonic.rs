//! Simple harmonic motion: s = (1 − cos πτ)/2, s′ = π/2 sin πτ, s″ = π²/2 cos πτ.

use super::wave::Wave;
use crate::scalar::Scalar;
use core::f64::consts::PI;

pub(super) fn law(tau: f64) -> [f64; 3] {
    let (sin, cos) = Scalar::sin_cos(PI * tau);
    [0.5 * (1.0 - cos), 0.5 * PI * sin, 0.5 * PI * PI * cos]
}

pub(super) fn wave(tau: f64) -> Wave {
    let (sin, cos) = Scalar::sin_cos(PI * tau);
    Wave::new(0.5 * PI * PI, (cos, -sin), PI)
}

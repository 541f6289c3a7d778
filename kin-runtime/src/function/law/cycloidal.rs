//! Cycloidal motion: s = τ − sin(2πτ)/2π, s′ = 1 − cos 2πτ, s″ = 2π sin 2πτ.

use super::wave::Wave;
use crate::scalar::Scalar;
use core::f64::consts::TAU;

pub(super) fn law(tau: f64) -> [f64; 3] {
    let (sin, cos) = Scalar::sin_cos(TAU * tau);
    [tau - sin / TAU, 1.0 - cos, TAU * sin]
}

pub(super) fn wave(tau: f64) -> Wave {
    Wave::new(TAU, Scalar::sin_cos(TAU * tau), TAU)
}

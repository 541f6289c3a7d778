//! Modified sine: the acceleration is a sine of period 1/2 in the first and last eighth, and one of period 3/2 between
//! them. With C = 4π²/(4 + π), the peak of s″:
//!
//! τ ≤ 1/8 or τ ≥ 7/8: s″ = C sin 4πτ; between: s″ = C sin((4πτ + π)/3).

use super::wave::Wave;
use crate::scalar::Scalar;
use core::f64::consts::PI;

pub(super) fn law(tau: f64) -> [f64; 3] {
    let scale = 1.0 / (4.0 + PI);
    if (0.125..0.875).contains(&tau) {
        let (sin, cos) = Scalar::sin_cos((4.0 * PI * tau + PI) / 3.0);
        return [scale * (2.0 + PI * tau - 2.25 * sin), scale * PI * (1.0 - 3.0 * cos), scale * 4.0 * PI * PI * sin];
    }
    let (sin, cos) = Scalar::sin_cos(4.0 * PI * tau);
    let offset = if tau < 0.5 { 0.0 } else { 4.0 };
    [scale * (offset + PI * tau - 0.25 * sin), scale * PI * (1.0 - cos), scale * 4.0 * PI * PI * sin]
}

pub(super) fn wave(tau: f64) -> Wave {
    let amplitude = 4.0 * PI * PI / (4.0 + PI);
    if (0.125..0.875).contains(&tau) {
        return Wave::new(amplitude, Scalar::sin_cos((4.0 * PI * tau + PI) / 3.0), 4.0 * PI / 3.0);
    }
    Wave::new(amplitude, Scalar::sin_cos(4.0 * PI * tau), 4.0 * PI)
}

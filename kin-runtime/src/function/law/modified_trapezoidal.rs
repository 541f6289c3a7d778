//! Modified trapezoidal: the acceleration rises over a quarter sine to its peak C = 8π/(2 + π), stays there for a
//! quarter of the duration, and falls over a quarter sine to 0 at τ = 1/2; the second half mirrors the first.

use super::wave::Wave;
use crate::scalar::Scalar;
use core::f64::consts::PI;

const PEAK: f64 = 8.0 * PI / (2.0 + PI);
const OMEGA: f64 = 4.0 * PI;

pub(super) fn law(tau: f64) -> [f64; 3] {
    if tau > 0.5 {
        let [s, s_1, s_2] = first_half(1.0 - tau);
        return [1.0 - s, s_1, -s_2];
    }
    first_half(tau)
}

fn first_half(tau: f64) -> [f64; 3] {
    // s and s′ at the ends of the constant piece, τ = 1/8 and τ = 3/8.
    let (s_a, v_a) = (PEAK / OMEGA * (0.125 - 1.0 / OMEGA), PEAK / OMEGA);
    let (s_b, v_b) = (s_a + v_a / 4.0 + PEAK / 32.0, v_a + PEAK / 4.0);
    if (0.125..0.375).contains(&tau) {
        let x = tau - 0.125;
        return [s_a + x * (v_a + 0.5 * PEAK * x), v_a + PEAK * x, PEAK];
    }
    let (sin, cos) = Scalar::sin_cos(OMEGA * tau);
    if tau < 0.125 {
        [PEAK / OMEGA * (tau - sin / OMEGA), PEAK / OMEGA * (1.0 - cos), PEAK * sin]
    } else {
        let x = tau - 0.375;
        [s_b + v_b * x + PEAK / (OMEGA * OMEGA) * (1.0 + sin), v_b + PEAK / OMEGA * cos, -PEAK * sin]
    }
}

pub(super) fn wave(tau: f64) -> Wave {
    // The second half mirrors the first: s″(τ) = −s″(1 − τ), s‴(τ) = s‴(1 − τ). At a junction the values of the later
    // piece are used.
    let (from_start, sign) = if tau >= 0.5 { (1.0 - tau, -1.0) } else { (tau, 1.0) };
    let constant = if tau >= 0.5 { from_start > 0.125 && from_start <= 0.375 } else { (0.125..0.375).contains(&tau) };
    if constant {
        return Wave::new(sign * PEAK, (1.0, 0.0), 0.0);
    }
    let (sin, cos) = Scalar::sin_cos(OMEGA * from_start);
    let rises = if tau >= 0.5 { from_start <= 0.125 } else { tau < 0.125 };
    let amplitude = if rises { PEAK } else { -PEAK };
    Wave::new(amplitude, (sign * sin, cos), OMEGA)
}

//! Polynomial laws, named after their powers of τ.

use crate::function::polynomial::horner;

pub(super) const LAW_345: [f64; 6] = [0.0, 0.0, 0.0, 10.0, -15.0, 6.0];
pub(super) const LAW_4567: [f64; 8] = [0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0];

/// 10τ³ − 15τ⁴ + 6τ⁵: velocity and acceleration are 0 at both ends.
pub(super) fn law_345(tau: f64) -> [f64; 3] {
    horner(&LAW_345, tau)
}

/// 35τ⁴ − 84τ⁵ + 70τ⁶ − 20τ⁷: velocity, acceleration and jerk are 0 at both ends.
pub(super) fn law_4567(tau: f64) -> [f64; 3] {
    horner(&LAW_4567, tau)
}

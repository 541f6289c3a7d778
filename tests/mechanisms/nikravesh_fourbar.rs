//! Source: a lecture by Nikravesh, 4 digits; see `tests/data/PUBLISHED.md`.

use kin_runtime::mechanism;

/// A four-bar as a vector loop, l1 e^(iθ1) + l2 e^(iθ2) = l3 e^(iθ3) + r0.
#[mechanism]
#[coordinates(theta1, theta2, theta3)]
#[constraint(real: l1*theta1.cos() + l2*theta2.cos() = l3*theta3.cos() + 2)]
#[constraint(imaginary: l1*theta1.sin() + l2*theta2.sin() = l3*theta3.sin() + 0.5)]
#[driver(drive: theta1 = pi/2 + 2*pi*t)]
#[guess(theta2 = 0.6, theta3 = 1.3)]
pub struct NikraveshFourbar {
    /// Crank length
    #[param(1)]
    pub l1: f64,
    /// Coupler length
    #[param(3)]
    pub l2: f64,
    /// Rocker length
    #[param(2.2)]
    pub l3: f64,
}

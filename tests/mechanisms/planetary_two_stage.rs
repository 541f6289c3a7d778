//! Planetary stages in series; speeds after Willis' equation.

use kin_runtime::mechanism;

/// Two planetary stages: the arm of the first is the sun of the second, the first ring belongs to the housing, and the
/// second ring is turned to trim the output. Radii are numbers of teeth.
#[mechanism]
#[bodies(sun, planet1, arm1, planet2, ring, arm2)]
#[define(output = arm2.phi)]
#[revolute(S: ground @ (0, 0), sun @ (0, 0))]
#[revolute(C1: ground @ (0, 0), arm1 @ (0, 0))]
#[revolute(P1: arm1 @ (m*(zs1 + zp1)/2, 0), planet1 @ (0, 0))]
#[revolute(C2: ground @ (0, 0), arm2 @ (0, 0))]
#[revolute(P2: arm2 @ (0, m*(zs2 + zp2)/2), planet2 @ (0, 0))]
#[revolute(R: ground @ (0, 0), ring @ (0, 0))]
#[gear(sun1: sun, planet1, radii = (zs1, zp1), carrier = arm1)]
#[gear(ring1: planet1, ground, radii = (zp1, -zs1 - 2*zp1), carrier = arm1)]
#[gear(sun2: arm1, planet2, radii = (zs2, zp2), carrier = arm2)]
#[gear(ring2: planet2, ring, radii = (zp2, -zs2 - 2*zp2), carrier = arm2)]
#[driver(drive: sun.phi = 4 * t + 0.3 * pow(t, 2))]
#[driver(trim: ring.phi = 0.2 * sin(2 * t))]
pub struct PlanetaryTwoStage {
    /// Module
    #[param(0.002, unit = "m")]
    pub m: f64,
    /// Teeth of the first sun
    #[param(18)]
    pub zs1: f64,
    /// Teeth of the first planet
    #[param(33)]
    pub zp1: f64,
    /// Teeth of the second sun
    #[param(24)]
    pub zs2: f64,
    /// Teeth of the second planet
    #[param(21)]
    pub zp2: f64,
}

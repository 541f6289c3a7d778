//! Source: `tests/data/planetary_basic.json`, with the loads of `tests/data/forces/planetary_basic.json`.

use kin_runtime::mechanism;

/// Planetary gear: sun and ring are driven, the carrier and its planet follow.
#[mechanism]
#[bodies(sun, carrier, planet, ring)]
#[point(R = planet @ (rp, 0))]
#[revolute(S: ground @ (0.02, 0.05), sun @ (0, 0))]
#[revolute(O: ground @ (0.02, 0.05), carrier @ (-l/2, 0))]
#[revolute(P: carrier @ (l/2, 0), planet @ (0, 0))]
#[revolute(Q: ground @ (0.02, 0.05), ring @ (0, 0))]
#[gear(inner: sun, planet, radii = (rs, rp), carrier = carrier, offset = c1)]
#[gear(outer: planet, ring, radii = (rp, -rr), carrier = carrier, offset = c2)]
#[driver(drive_sun: sun.phi = 0.2 + 3.1 * t)]
#[driver(drive_ring: ring.phi = 0.05 + 0.4 * sin(2 * t))]
#[gravity(0, -9.81)]
#[mass(sun @ (0.034, 0.026), mass = 2.48, inertia = 0.00178)]
#[mass(carrier @ (-0.026, 0.024), mass = 2.35, inertia = 0.00321)]
#[mass(planet @ (0.011, -0.024), mass = 0.815, inertia = 0.000311)]
#[mass(ring @ (0.015, 0.029), mass = 2.5, inertia = 0.00279)]
#[force(pull: sun @ (-0.031, 0.033), (-8.15, -9.08))]
#[force(thrust: planet @ (0.0099, -0.036), (-4.83, -13.4), frame = planet)]
#[torque(load: carrier = -0.559)]
#[spring(spring: ground @ (0.12, -0.11), planet @ (0.007, -0.027), stiffness = 117, free_length = 0.229, damping = 19.5)]
#[torsion_spring(torsion: ring, sun, stiffness = 0.535, free_angle = 0.528, damping = 0.0556)]
pub struct PlanetaryBasic {
    /// Radius of the sun
    #[param(0.12)]
    pub rs: f64,
    /// Radius of the planet
    #[param(0.085)]
    pub rp: f64,
    /// Radius of the ring
    #[param(0.29)]
    pub rr: f64,
    /// Length of the carrier
    #[param(0.205)]
    pub l: f64,
    /// Constant of sun and planet
    #[param(0.0137)]
    pub c1: f64,
    /// Constant of planet and ring
    #[param(-0.0052)]
    pub c2: f64,
}

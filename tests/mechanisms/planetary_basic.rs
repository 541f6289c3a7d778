//! Source: `tests/data/planetary_basic.json`.

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
pub struct PlanetaryBasic {
    /// Radius of the sun
    #[param(0.12, unit = "m")]
    pub rs: f64,
    /// Radius of the planet
    #[param(0.085, unit = "m")]
    pub rp: f64,
    /// Radius of the ring
    #[param(0.29, unit = "m")]
    pub rr: f64,
    /// Length of the carrier
    #[param(0.205, unit = "m")]
    pub l: f64,
    /// Constant of sun and planet
    #[param(0.0137, unit = "m")]
    pub c1: f64,
    /// Constant of planet and ring
    #[param(-0.0052, unit = "m")]
    pub c2: f64,
}

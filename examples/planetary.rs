//! A planetary gear with three planets: which speed does the ring turn with?
//!
//! Sun and arm are driven, the ring follows: Willis' equation (ω_s − ω_a) z_s = −(ω_r − ω_a) z_r is not written down
//! anywhere, it follows from the meshes. Each mesh is a `gear` whose axles the arm carries; the ring is an internal gear
//! and has a negative radius. One planet meshes with the ring: what the others would say there repeats it.
//!
//! ```text
//! cargo run --release --example planetary
//! cargo run --release --example planetary -- solve --at 0 --set arm_speed=0 --format json
//! ```
//!
//! With the arm at rest the ring turns backwards, with the ratio of the teeth; with `--set arm_speed=3.0` (as fast as the
//! sun) everything turns as one block.

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A planetary gear: sun and arm are driven, the ring follows.
#[mechanism]
#[bodies(sun, arm, planet[3], ring)]
#[revolute(S: ground @ (0, 0), sun @ (0, 0))]
#[revolute(C: ground @ (0, 0), arm @ (0, 0))]
#[revolute(R: ground @ (0, 0), ring @ (0, 0))]
#[revolute(P[i in 0..3]: arm @ (a * cos(2*pi*i/3), a * sin(2*pi*i/3)), planet[i] @ (0, 0))]
#[gear(inner[i in 0..3]: sun, planet[i], radii = (z_sun, z_planet), carrier = arm)]
#[gear(outer: planet[0], ring, radii = (z_planet, -z_sun - 2*z_planet), carrier = arm)]
#[driver(drive: sun.phi = sun_speed * t)]
#[driver(trim: arm.phi = arm_speed * t)]
pub struct Planetary {
    /// Teeth of the sun
    #[param(24)]
    pub z_sun: f64,
    /// Teeth of each planet
    #[param(18)]
    pub z_planet: f64,
    /// Distance of the planets' axles from the centre
    #[param(0.042, unit = "m")]
    pub a: f64,
    /// Speed of the sun
    #[param(3.0, unit = "rad/s")]
    pub sun_speed: f64,
    /// Speed of the arm
    #[param(1.2, unit = "rad/s")]
    pub arm_speed: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Planetary>()
}

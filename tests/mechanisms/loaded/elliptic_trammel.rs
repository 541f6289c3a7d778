//! Source: `tests/data/elliptic_trammel.json`, with the loads of `tests/data/forces/elliptic_trammel.json`.

use kin_runtime::mechanism;

/// Elliptic trammel: a bar with two points kept on a vertical and a horizontal line; the tracer `C` draws an ellipse.
#[mechanism]
#[bodies(bar)]
#[point(C = bar @ (0.5, 0.1))]
#[x(vertical: bar @ (-0.21, 0.03) = 0.02)]
#[y(horizontal: bar @ (0.34, -0.05) = -0.03)]
#[driver(drive: bar.phi = 0.4 + 1.7 * t - 0.3 * cos(2.1 * t))]
#[gravity(0, -9.81)]
#[mass(bar @ (0.13, 0.18), mass = 2.06, inertia = 0.0341)]
#[force(pull: bar @ (0.043, 0.054), (-8.95, -11.4))]
#[force(thrust: bar @ (-0.12, -0.16), (4.41, 8.84), frame = bar)]
#[torque(load: bar = 3.28)]
#[spring(spring: ground @ (0.2, -0.57), bar @ (0.075, -0.089), stiffness = 39.7, free_length = 0.468, damping = 7.84)]
#[torsion_spring(torsion: ground, bar, stiffness = 1.1, free_angle = 0.891, damping = 0.426)]
pub struct EllipticTrammel;

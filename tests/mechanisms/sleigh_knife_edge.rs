//! Source: `tests/data/sleigh_knife_edge.json`.

use kin_runtime::mechanism;

/// Sleigh with a knife edge at `P`; its heading and the speed of `P` are driven. The guess is the exact start.
#[mechanism]
#[bodies(sleigh)]
#[point(P = sleigh @ (0.3, -0.07))]
#[point(C = sleigh @ (-0.1, 0.2))]
#[driver(drive: sleigh.phi = phi0 + w * t)]
#[knife_edge(blade: P, angle = al)]
#[speed(speed: P, angle = al, value = v0 + a * t)]
#[guess(sleigh.x = 0.25 - 0.3 * cos(phi0) - 0.07 * sin(phi0), sleigh.y = -0.4 - 0.3 * sin(phi0) + 0.07 * cos(phi0))]
pub struct SleighKnifeEdge {
    #[param(0.3)]
    phi0: f64,
    #[param(0.8)]
    w: f64,
    #[param(0.9)]
    v0: f64,
    #[param(0.25)]
    a: f64,
    #[param(0.2)]
    al: f64,
}

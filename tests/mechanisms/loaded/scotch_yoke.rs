//! Source: `tests/data/scotch_yoke.json`, with the loads of `tests/data/forces/scotch_yoke.json`.

use kin_runtime::mechanism;

/// Scotch yoke: the crank pin on the inclined slot of a yoke that slides along an inclined axis.
#[mechanism]
#[bodies(crank, yoke)]
#[point(S = yoke @ (0.3, -0.06))]
#[revolute(O: ground @ (0.03, -0.02), crank @ (-0.05, 0.01))]
#[translational(guide: ground @ (-0.1, 0.04), yoke @ (0.11, 0.02), axis = (0.96, 0.28), angle = c0)]
#[point_on_line(pin: S, crank @ (-0.05 + r, 0.01), axis = (0.2, 1))]
#[driver(drive: crank.phi = 0.6 + w * t)]
#[guess(yoke.phi = 0.2)]
#[gravity(0, -9.81)]
#[mass(crank @ (-0.031, -0.078), mass = 1.53, inertia = 0.0173)]
#[mass(yoke @ (-0.11, -0.06), mass = 2.98, inertia = 0.0287)]
#[force(pull: crank @ (-0.12, -0.059), (-9.75, -6.62))]
#[force(thrust: yoke @ (-0.088, -0.082), (-10.2, 9.87), frame = yoke)]
#[torque(load: crank = -3.34)]
#[spring(spring: crank @ (-0.023, -0.065), yoke @ (-0.078, 0.025), stiffness = 68.5, free_length = 0.363, damping = 9.53)]
#[torsion_spring(torsion: ground, crank, stiffness = 0.681, free_angle = -0.253, damping = 0.0653)]
pub struct ScotchYoke {
    /// Crank radius
    #[param(0.19)]
    pub r: f64,
    /// Inclination of the yoke
    #[param(0.25)]
    pub c0: f64,
    /// Speed of the drive
    #[param(2.7)]
    pub w: f64,
}

//! The lecture's four-bar with masses in the middle of its links, gravity, and a spring.

use kin_runtime::mechanism;

/// The lecture's four-bar, joint by joint, with masses and loads.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = phi0 + omega * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0, 0), mass = 0.5, inertia = 0.0004)]
#[mass(coupler @ (0, 0), mass = 2, inertia = 0.027)]
#[mass(rocker @ (0, 0), mass = 1.5, inertia = 0.011)]
#[spring(S: ground @ (0, 0.4), rocker @ (0, 0), stiffness = 120, free_length = 0.25, damping = 2)]
pub struct LoadedFourBar {
    /// Length of the crank.
    #[param(0.1)]
    pub l1: f64,
    /// Length of the coupler.
    #[param(0.4)]
    pub l2: f64,
    /// Length of the rocker.
    #[param(0.3)]
    pub l3: f64,
    /// x of the ground pin.
    #[param(0.4)]
    pub d1: f64,
    /// y of the ground pin.
    #[param(0.1)]
    pub d2: f64,
    /// Crank angle at t = 0.
    #[param(0.7)]
    pub phi0: f64,
    /// Angular velocity of the crank.
    #[param(1.0)]
    pub omega: f64,
}

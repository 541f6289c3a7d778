//! Four-bar loops geared in series: every crank is geared to the rocker of the loop before it.

use kin_runtime::mechanism;

/// The number of loops.
pub const LOOPS: usize = 100;

/// A chain of a hundred loops.
#[mechanism]
#[bodies(crank[100], coupler[100], rocker[100])]
#[revolute(C[i in 0..100]: ground @ (0, 0), crank[i] @ (-l1[i]/2, 0))]
#[revolute(A[i in 0..100]: crank[i] @ (l1[i]/2, 0), coupler[i] @ (-l2[i]/2, 0))]
#[revolute(B[i in 0..100]: coupler[i] @ (l2[i]/2, 0), rocker[i] @ (-l3[i]/2, 0))]
#[revolute(D[i in 0..100]: rocker[i] @ (l3[i]/2, 0), ground @ (d1[i], d2[i]))]
#[gear(mesh[i in 1..100]: rocker[i - 1], crank[i], radii = (r[i - 1], r[i]))]
#[driver(drive: crank[0].phi = phi0 + omega * t)]
pub struct Chain {
    /// Lengths of the cranks.
    #[param(0.1, unit = "m")]
    pub l1: [f64; 100],
    /// Lengths of the couplers.
    #[param(0.4, unit = "m")]
    pub l2: [f64; 100],
    /// Lengths of the rockers.
    #[param(0.3, unit = "m")]
    pub l3: [f64; 100],
    /// x of the ground pins.
    #[param(0.4, unit = "m")]
    pub d1: [f64; 100],
    /// y of the ground pins.
    #[param(0.1, unit = "m")]
    pub d2: [f64; 100],
    /// Pitch radii of the gears: the one on a rocker meshes with the one on the next crank.
    #[param(0.05, unit = "m")]
    pub r: [f64; 100],
    /// Angle of the first crank at t = 0.
    #[param(0.7, unit = "rad")]
    pub phi0: f64,
    /// Angular velocity of the first crank.
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

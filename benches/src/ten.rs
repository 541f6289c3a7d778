//! Ten four-bar loops geared in series, once with ranges and once written out, loop by loop.

use kin_runtime::mechanism;

/// The number of loops of either chain.
pub const LOOPS: usize = 10;

/// The chain written with ranges.
#[mechanism]
#[bodies(crank[10], coupler[10], rocker[10])]
#[revolute(C[i in 0..10]: ground @ (0, 0), crank[i] @ (-l1[i]/2, 0))]
#[revolute(A[i in 0..10]: crank[i] @ (l1[i]/2, 0), coupler[i] @ (-l2[i]/2, 0))]
#[revolute(B[i in 0..10]: coupler[i] @ (l2[i]/2, 0), rocker[i] @ (-l3[i]/2, 0))]
#[revolute(D[i in 0..10]: rocker[i] @ (l3[i]/2, 0), ground @ (d1[i], d2[i]))]
#[gear(mesh[i in 1..10]: rocker[i - 1], crank[i], radii = (r, r))]
#[driver(drive: crank[0].phi = phi0 + omega * t)]
pub struct Ranged {
    /// Lengths of the cranks.
    #[param(0.1, unit = "m")]
    pub l1: [f64; 10],
    /// Lengths of the couplers.
    #[param(0.4, unit = "m")]
    pub l2: [f64; 10],
    /// Lengths of the rockers.
    #[param(0.3, unit = "m")]
    pub l3: [f64; 10],
    /// x of the ground pins.
    #[param(0.4, unit = "m")]
    pub d1: [f64; 10],
    /// y of the ground pins.
    #[param(0.1, unit = "m")]
    pub d2: [f64; 10],
    /// Pitch radius of all gears.
    #[param(0.05, unit = "m")]
    pub r: f64,
    /// Angle of the first crank at t = 0.
    #[param(0.7, unit = "rad")]
    pub phi0: f64,
    /// Angular velocity of the first crank.
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

/// The chain written out loop by loop.
#[mechanism]
#[bodies(crank0, coupler0, rocker0)]
#[bodies(crank1, coupler1, rocker1)]
#[bodies(crank2, coupler2, rocker2)]
#[bodies(crank3, coupler3, rocker3)]
#[bodies(crank4, coupler4, rocker4)]
#[bodies(crank5, coupler5, rocker5)]
#[bodies(crank6, coupler6, rocker6)]
#[bodies(crank7, coupler7, rocker7)]
#[bodies(crank8, coupler8, rocker8)]
#[bodies(crank9, coupler9, rocker9)]
#[revolute(C0: ground @ (0, 0), crank0 @ (-l1[0]/2, 0))]
#[revolute(A0: crank0 @ (l1[0]/2, 0), coupler0 @ (-l2[0]/2, 0))]
#[revolute(B0: coupler0 @ (l2[0]/2, 0), rocker0 @ (-l3[0]/2, 0))]
#[revolute(D0: rocker0 @ (l3[0]/2, 0), ground @ (d1[0], d2[0]))]
#[driver(drive: crank0.phi = phi0 + omega * t)]
#[revolute(C1: ground @ (0, 0), crank1 @ (-l1[1]/2, 0))]
#[revolute(A1: crank1 @ (l1[1]/2, 0), coupler1 @ (-l2[1]/2, 0))]
#[revolute(B1: coupler1 @ (l2[1]/2, 0), rocker1 @ (-l3[1]/2, 0))]
#[revolute(D1: rocker1 @ (l3[1]/2, 0), ground @ (d1[1], d2[1]))]
#[gear(mesh1: rocker0, crank1, radii = (r, r))]
#[revolute(C2: ground @ (0, 0), crank2 @ (-l1[2]/2, 0))]
#[revolute(A2: crank2 @ (l1[2]/2, 0), coupler2 @ (-l2[2]/2, 0))]
#[revolute(B2: coupler2 @ (l2[2]/2, 0), rocker2 @ (-l3[2]/2, 0))]
#[revolute(D2: rocker2 @ (l3[2]/2, 0), ground @ (d1[2], d2[2]))]
#[gear(mesh2: rocker1, crank2, radii = (r, r))]
#[revolute(C3: ground @ (0, 0), crank3 @ (-l1[3]/2, 0))]
#[revolute(A3: crank3 @ (l1[3]/2, 0), coupler3 @ (-l2[3]/2, 0))]
#[revolute(B3: coupler3 @ (l2[3]/2, 0), rocker3 @ (-l3[3]/2, 0))]
#[revolute(D3: rocker3 @ (l3[3]/2, 0), ground @ (d1[3], d2[3]))]
#[gear(mesh3: rocker2, crank3, radii = (r, r))]
#[revolute(C4: ground @ (0, 0), crank4 @ (-l1[4]/2, 0))]
#[revolute(A4: crank4 @ (l1[4]/2, 0), coupler4 @ (-l2[4]/2, 0))]
#[revolute(B4: coupler4 @ (l2[4]/2, 0), rocker4 @ (-l3[4]/2, 0))]
#[revolute(D4: rocker4 @ (l3[4]/2, 0), ground @ (d1[4], d2[4]))]
#[gear(mesh4: rocker3, crank4, radii = (r, r))]
#[revolute(C5: ground @ (0, 0), crank5 @ (-l1[5]/2, 0))]
#[revolute(A5: crank5 @ (l1[5]/2, 0), coupler5 @ (-l2[5]/2, 0))]
#[revolute(B5: coupler5 @ (l2[5]/2, 0), rocker5 @ (-l3[5]/2, 0))]
#[revolute(D5: rocker5 @ (l3[5]/2, 0), ground @ (d1[5], d2[5]))]
#[gear(mesh5: rocker4, crank5, radii = (r, r))]
#[revolute(C6: ground @ (0, 0), crank6 @ (-l1[6]/2, 0))]
#[revolute(A6: crank6 @ (l1[6]/2, 0), coupler6 @ (-l2[6]/2, 0))]
#[revolute(B6: coupler6 @ (l2[6]/2, 0), rocker6 @ (-l3[6]/2, 0))]
#[revolute(D6: rocker6 @ (l3[6]/2, 0), ground @ (d1[6], d2[6]))]
#[gear(mesh6: rocker5, crank6, radii = (r, r))]
#[revolute(C7: ground @ (0, 0), crank7 @ (-l1[7]/2, 0))]
#[revolute(A7: crank7 @ (l1[7]/2, 0), coupler7 @ (-l2[7]/2, 0))]
#[revolute(B7: coupler7 @ (l2[7]/2, 0), rocker7 @ (-l3[7]/2, 0))]
#[revolute(D7: rocker7 @ (l3[7]/2, 0), ground @ (d1[7], d2[7]))]
#[gear(mesh7: rocker6, crank7, radii = (r, r))]
#[revolute(C8: ground @ (0, 0), crank8 @ (-l1[8]/2, 0))]
#[revolute(A8: crank8 @ (l1[8]/2, 0), coupler8 @ (-l2[8]/2, 0))]
#[revolute(B8: coupler8 @ (l2[8]/2, 0), rocker8 @ (-l3[8]/2, 0))]
#[revolute(D8: rocker8 @ (l3[8]/2, 0), ground @ (d1[8], d2[8]))]
#[gear(mesh8: rocker7, crank8, radii = (r, r))]
#[revolute(C9: ground @ (0, 0), crank9 @ (-l1[9]/2, 0))]
#[revolute(A9: crank9 @ (l1[9]/2, 0), coupler9 @ (-l2[9]/2, 0))]
#[revolute(B9: coupler9 @ (l2[9]/2, 0), rocker9 @ (-l3[9]/2, 0))]
#[revolute(D9: rocker9 @ (l3[9]/2, 0), ground @ (d1[9], d2[9]))]
#[gear(mesh9: rocker8, crank9, radii = (r, r))]
pub struct WrittenOut {
    /// Lengths of the cranks.
    #[param(0.1, unit = "m")]
    pub l1: [f64; 10],
    /// Lengths of the couplers.
    #[param(0.4, unit = "m")]
    pub l2: [f64; 10],
    /// Lengths of the rockers.
    #[param(0.3, unit = "m")]
    pub l3: [f64; 10],
    /// x of the ground pins.
    #[param(0.4, unit = "m")]
    pub d1: [f64; 10],
    /// y of the ground pins.
    #[param(0.1, unit = "m")]
    pub d2: [f64; 10],
    /// Pitch radius of all gears.
    #[param(0.05, unit = "m")]
    pub r: f64,
    /// Angle of the first crank at t = 0.
    #[param(0.7, unit = "rad")]
    pub phi0: f64,
    /// Angular velocity of the first crank.
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

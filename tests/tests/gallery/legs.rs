//! Walking legs compared with constructions by intersecting circles.

use crate::page::says;
use crate::{close, meet, moved, range};
use kin_runtime::Motion;
use kin_runtime::model::Point;
use kin_tests::examples::{jansen::Jansen, klann::Klann};
use std::f64::consts::TAU;

/// The foot counts as on the ground while it is below this fraction of the step's height.
const GROUND: f64 = 0.05;

/// The stride, the height of the step, and the percentage of the turn with the foot on the ground.
fn step(motion: &[(f64, Motion)], foot: Point) -> [f64; 3] {
    let places = || motion.iter().map(|(_, at)| at[foot].r);
    let ((left, right), (low, high)) = (range(places().map(|r| r[0])), range(places().map(|r| r[1])));
    // The last instant repeats the first.
    let down = places().skip(1).filter(|r| r[1] <= low + GROUND * (high - low)).count();
    [right - left, high - low, 100.0 * down as f64 / (motion.len() - 1) as f64]
}

#[test]
fn jansens_feet_go_where_circles_meet() {
    let legs = Jansen::default();
    let motion = moved(&legs, 0.0, TAU / legs.omega, 360);
    let Jansen { a, b, c, d, e, f, g, h, i, j, k, l, m, .. } = legs;
    let foot = |phi: f64| {
        let (pin, axle) = ([m * phi.cos(), m * phi.sin()], [-a, -l]);
        let upper = meet(axle, b, pin, j);
        let outer = meet(axle, d, upper, e);
        let knee = meet(pin, k, axle, c);
        let top = meet(knee, g, outer, f);
        meet(knee, i, top, h)
    };
    for (t, at) in &motion {
        let phi = legs.omega * t;
        let (left, right) = (foot(phi), foot(TAU / 2.0 - phi));
        for (found, expected) in [(at[Jansen::foot[0]].r, left), (at[Jansen::foot[1]].r, [-right[0], right[1]])] {
            close(found[0], expected[0], 1e-11);
            close(found[1], expected[1], 1e-11);
        }
    }
    // Joint 7 at angle 0 of "Jansen's linkage (Single)" in the collection of pyslvs, whose axle is 0.01 beside
    // Jansen's.
    let start = motion[0].1[Jansen::foot[0]].r;
    close(start[0], -43.170_055, 0.02);
    close(start[1], -91.753_226, 0.02);
    let [stride, height, down] = step(&motion, Jansen::foot[0]);
    says(
        "jansen",
        &format!("stride {stride:.1} mm, step height {height:.1} mm, on the ground for {down:.0} % of a turn"),
    );
}

#[test]
fn klanns_foot_goes_where_circles_meet() {
    let leg = Klann::default();
    let motion = moved(&leg, 0.0, TAU / leg.omega.abs(), 360);
    let Klann { oc, bx, by, dx, dy, bh, de, ch, hf, cf, ef, fg, eg, omega } = leg;
    for (t, at) in &motion {
        let phi = omega * t;
        let crank = [oc * phi.cos(), oc * phi.sin()];
        let elbow = meet([bx, by], bh, crank, ch);
        let knee = meet(elbow, hf, crank, cf);
        let hip = meet(knee, ef, [dx, dy], de);
        let foot = meet(hip, eg, knee, fg);
        close(at[Klann::foot].r[0], foot[0], 1e-11);
        close(at[Klann::foot].r[1], foot[1], 1e-11);
    }
    let [stride, height, down] = step(&motion, Klann::foot);
    says(
        "klann",
        &format!("stride {stride:.1} mm, step height {height:.1} mm, on the ground for {down:.0} % of a turn"),
    );
}

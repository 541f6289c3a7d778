//! Wheels and cams.

use crate::page::says;
use crate::{close, moved};
use kin_runtime::{Instant, Mechanism};
use kin_tests::examples::cam::Cam;
use kin_tests::examples::cam_drive::{CamDrive, TABLE};
use kin_tests::examples::{planetary::Planetary, rack_and_pinion::Steering};
use std::f64::consts::TAU;

#[test]
fn the_planetary_gear_obeys_willis() {
    for (sun_speed, arm_speed) in [(3.0, 1.2), (3.0, 0.0), (2.0, 2.0), (0.0, 1.0)] {
        let gear = Planetary { sun_speed, arm_speed, ..Planetary::default() };
        let z_ring = gear.z_sun + 2.0 * gear.z_planet;
        for (t, at) in moved(&gear, 0.0, 2.0, 8) {
            let ring = arm_speed - (sun_speed - arm_speed) * gear.z_sun / z_ring;
            close(at[Planetary::ring].phi_dot, ring, 1e-14);
            close(at[Planetary::ring].phi, ring * t, 1e-14);
            let planet = arm_speed - (sun_speed - arm_speed) * gear.z_sun / gear.z_planet;
            (0..3).for_each(|k| close(at[Planetary::planet[k]].phi_dot, planet, 1e-14));
        }
    }
    let gear = Planetary::default();
    let ratio = -gear.z_sun / (gear.z_sun + 2.0 * gear.z_planet);
    says("planetary", &format!("{ratio} turns of the ring for one of the sun, with the arm at rest"));
}

#[test]
fn the_rack_goes_the_circumference_of_its_pinion() {
    let steering = Steering::default();
    for (t, at) in moved(&steering, 0.0, 1.0, 20) {
        close(at[Steering::rack].x, steering.r * TAU * t, 1e-16);
        // The tie rods have constant length.
        let (rack, left) = (at[Steering::rack], at[Steering::left]);
        let (sin, cos) = left.phi.sin_cos();
        let arm =
            [left.x + steering.inset * cos + steering.arm * sin, left.y + steering.inset * sin - steering.arm * cos];
        close((rack.x - steering.w - arm[0]).hypot(rack.y - arm[1]), steering.rod, 1e-15);
    }
    let (_, end) = moved(&steering, 0.0, 1.0, 20).pop().unwrap();
    let (travel, [left, right]) = (1e3 * end[Steering::rack].x, [Steering::left, Steering::right].map(|w| end[w].phi));
    assert!(left.abs() > right.abs() && left * right > 0.0, "the inner wheel turns further: {left} {right}");
    let [left, right] = [left, right].map(|phi| phi.to_degrees().abs());
    says("rack_and_pinion", &format!("{travel:.2} mm of rack per turn, the wheels at {left:.1}° and {right:.1}° then"));
}

#[test]
fn the_cam_touches_both_followers_and_cuts_into_neither() {
    let cam = Cam::default();
    let joints = Cam::model().joints;
    let place = |name: &str| joints.iter().position(|joint| joint.name == name).unwrap();
    let outline: Vec<[f64; 2]> = (0..7200)
        .map(|k| TAU * f64::from(k) / 7200.0)
        .map(|u| cam.curve_point(&Instant::at(0.0), place("roll"), u).unwrap().unwrap().r)
        .collect();
    let mut lift = (f64::INFINITY, f64::NEG_INFINITY);
    for (_, at) in moved(&cam, 0.0, 60.0 / cam.rpm, 36) {
        let (sin, cos) = at[Cam::cam].phi.sin_cos();
        let turned = || outline.iter().map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]);
        // The tappet rests on the highest point of the outline; half a step of the outline away from it, the outline is
        // 6·10⁻⁹ m lower.
        let top = turned().map(|r| r[1]).fold(f64::NEG_INFINITY, f64::max);
        close(at[Cam::tappet].y, top, 1e-8);
        let rocker = at[Cam::rocker];
        let centre = [rocker.x + cam.l * rocker.phi.cos(), rocker.y + cam.l * rocker.phi.sin()];
        let nearest = turned().map(|r| (r[0] - centre[0]).hypot(r[1] - centre[1])).fold(f64::INFINITY, f64::min);
        close(nearest, cam.roller, 1e-8);
        lift = (lift.0.min(at[Cam::lift].value), lift.1.max(at[Cam::lift].value));
    }
    // The support function h ranges from r + a + b at the nose to r − a + b at the back.
    close(lift.1 - lift.0, 2.0 * cam.a, 2e-5);
    says("cam", &format!("the tappet is lifted by 2a = {:.1} mm", 2e3 * cam.a));
}

#[test]
fn the_spline_cam_goes_through_its_table_with_continuous_acceleration() {
    let train = CamDrive::default();
    // A turn takes 0.2 s; at t = 0.2 s the camshaft has made half a turn.
    let time = |angle: f64| 0.2 + 0.2 * (angle / TAU - 0.5);
    let (mut largest_jump, mut largest) = (0.0_f64, 0.0_f64);
    let near = 1e-7;
    let knots: Vec<(usize, f64)> = (12..=24 + 12).map(|k| (k % 24, time(TAU * k as f64 / 24.0))).collect();
    for (k, t) in knots.into_iter().skip(1) {
        let motion = moved(&train, t - near, t + near, 2);
        let [before, at, after] = [0, 1, 2].map(|k| motion[k].1[CamDrive::tappet]);
        close(at.y - train.base, 1e-3 * TABLE[k], 1e-14);
        largest_jump = largest_jump.max((after.y_ddot - before.y_ddot).abs());
        largest = largest.max(at.y_ddot.abs());
        // The rocker converts the tappet's lift into that of the valve.
        let valve = motion[1].1[CamDrive::valve_lift].value;
        close(valve, -(at.y + train.l - train.h) * train.b / train.a, 1e-15);
    }
    // The third derivative jumps, but the second does not: over a short time it changes by no more than its slope
    // allows.
    assert!(largest_jump < 1e-3 * largest, "{largest_jump} {largest}");
    assert!(largest > 1.0);
    says(
        "cam_drive",
        &format!("all entries of the table within 10⁻¹⁴ m; the acceleration, up to {largest:.1} m/s², jumps nowhere"),
    );
}

//! Machines: four-bar, scissor lift, excavator, suspension, squeezer.

use crate::page::says;
use crate::{angle, close, meet, moved, range};
use kin_runtime::{Instant, Kinematics, Mechanism, Signal};
use kin_tests::examples::{excavator::Excavator, four_bar::FourBar, scissor_lift::ScissorLift};
use kin_tests::examples::{squeezer::Squeezer, wishbone::Wishbone};
use std::f64::consts::TAU;

#[test]
fn the_four_bar_swings_between_its_dead_centres() {
    let linkage = FourBar::default();
    let FourBar { l1, l2, l3, d1, d2, phi0, omega } = linkage;
    let base = d1.hypot(d2);
    assert!(l1 + base.max(l2).max(l3) < base + l2 + l3 - base.max(l2).max(l3), "Grashof: the crank goes round");
    let solver = linkage.solver();
    // At the dead centres crank and coupler are in line, with total length l2 ± l1, and the rocker is at rest.
    let swing = [l2 + l1, l2 - l1].map(|length| {
        let b = meet([0.0; 2], length, [d1, d2], l3);
        let phi = if length > l2 { angle([0.0; 2], b) } else { angle(b, [0.0; 2]) };
        let motion = solver.motion(&solver.state(&((phi - phi0) / omega).into()).unwrap()).unwrap();
        close(motion[FourBar::rocker].phi_dot, 0.0, 1e-13);
        let found = angle([d1, d2], b);
        // The x axis of the rocker's frame points from its coupler pin to the ground pin.
        close((motion[FourBar::rocker].phi + TAU / 2.0 - found + 1.0).rem_euclid(TAU), 1.0, 1e-7);
        found
    });
    let motion = moved(&linkage, 0.0, TAU / omega, 3600);
    let (low, high) = range(motion.iter().map(|(_, at)| at[FourBar::rocker].phi));
    close(high - low, (swing[1] - swing[0]).abs(), 1e-6);
    says("four_bar", &format!("the rocker swings by {:.2}°", (high - low).to_degrees()));
}

#[test]
fn a_four_bar_without_a_turning_link_draws_its_whole_curve() {
    let bar = FourBar { l1: 0.25, l2: 0.2, ..FourBar::default() };
    let ground = bar.d1.hypot(bar.d2);
    let cosine = (bar.l1.powi(2) + ground * ground - (bar.l2 + bar.l3).powi(2)) / (2.0 * bar.l1 * ground);
    let path = bar.solver().sweep_along_arc(0.0, None, 360).unwrap();
    let arc = path.arc.as_ref().unwrap();
    assert!(arc.is_closed() && arc.places.len() == 2, "{arc}");
    let (low, high) = range(arc.places.iter().map(|place| bar.phi0 + place.t));
    let middle = bar.d2.atan2(bar.d1);
    close(high, middle + cosine.acos(), 1e-11);
    close(low, middle - cosine.acos(), 1e-11);
    let [Some(first), Some(last)] = [path.states.first(), path.last()] else { panic!("states") };
    (0..2).for_each(|axis| close(last.points[0].r[axis], first.points[0].r[axis], 1e-9));
    says("four_bar", &format!("the crank swings by {:.1}°", (high - low).to_degrees()));
}

#[test]
fn the_scissor_lift_rises_by_its_law() {
    let lift = ScissorLift::default();
    for (_, at) in moved(&lift, 0.0, TAU, 24) {
        let foot = at[ScissorLift::right[0]];
        let (sin, cos) = foot.phi.sin_cos();
        let (w, w_dot) = (foot.x - 0.5 * lift.l * cos, foot.x_dot + 0.5 * lift.l * sin * foot.phi_dot);
        let stage = (lift.l * lift.l - w * w).sqrt();
        close(at[ScissorLift::height].value, 20.0 * stage, 1e-13);
        close(at[ScissorLift::height].rate, -20.0 * w * w_dot / stage, 1e-13);
    }
    let (low, high) = range(moved(&lift, 0.0, TAU, 360).iter().map(|(_, at)| at[ScissorLift::height].value));
    says("scissor_lift", &format!("20 √(l² − w²) within 10⁻¹³ m, from {low:.2} m to {high:.2} m"));
}

/// The bucket by triangles with three known sides, one cylinder after the other.
#[test]
fn the_bucket_stands_where_trigonometry_says() {
    let arm = Excavator::default();
    let placed = |origin: [f64; 2], phi: f64, [u, v]: [f64; 2]| {
        let (sin, cos) = phi.sin_cos();
        [origin[0] + u * cos - v * sin, origin[1] + u * sin + v * cos]
    };
    let apart = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
    let polar = |p: [f64; 2]| (p[0].hypot(p[1]), p[1].atan2(p[0]));
    let show = |lengths: [f64; 3]| {
        let mut inputs = [Signal::default(); Excavator::INPUTS];
        inputs[Excavator::boom_length] = Signal::constant(lengths[0]);
        inputs[Excavator::stick_length] = Signal::constant(lengths[1]);
        inputs[Excavator::bucket_length] = Signal::constant(lengths[2]);
        let solver = arm.solver();
        solver.motion(&solver.state(&Instant { t: 0.0, inputs: &inputs }).unwrap()).unwrap()
    };
    for (boom_length, stick_length, bucket_length) in [(1.42, 1.90, 1.13), (1.35, 1.85, 1.10), (1.5, 1.95, 1.17)] {
        let foot = [0.0, 0.2];
        let (reach, bend) = polar([1.4, 0.35]);
        let boom = angle(foot, meet(foot, reach, [0.45, -0.05], boom_length)) - bend;
        let at_boom = |p: [f64; 2]| placed(foot, boom, p);
        let stick_pin = at_boom([arm.boom_reach, 0.2]);
        let (reach, bend) = polar([-0.6, 0.15]);
        let stick = angle(stick_pin, meet(at_boom([1.5, 0.8]), stick_length, stick_pin, reach)) - bend;
        let at_stick = |p: [f64; 2]| placed(stick_pin, stick, p);
        // The lever turns about its one end, and the cylinder acts on its other end.
        let lever_pin = at_stick([1.25, 0.1]);
        let lever = angle(lever_pin, meet(at_stick([0.25, 0.3]), bucket_length, lever_pin, 0.42));
        let link_pin = placed(lever_pin, lever, [0.19 + 0.21, 0.05]);
        let bucket_pin = at_stick([arm.stick_reach, 0.0]);
        let (own, link) = ([-0.4, -0.1], [-0.15, 0.1]);
        let other = meet(link_pin, 0.4, bucket_pin, apart(own, link));
        let bucket = angle(bucket_pin, other) - angle(own, link);
        let tip = placed(bucket_pin, bucket, [0.5 - own[0], -0.2 - own[1]]);

        let motion = show([boom_length, stick_length, bucket_length]);
        for (body, expected) in [(Excavator::boom, boom), (Excavator::stick, stick), (Excavator::bucket, bucket)] {
            close((motion[body].phi - expected + 1.0).rem_euclid(TAU), 1.0, 1e-12);
        }
        close(motion[Excavator::tip].r[0], tip[0], 1e-12);
        close(motion[Excavator::tip].r[1], tip[1], 1e-12);
    }
    let middle = show([1.42, 1.90, 1.13]);
    let (tip, turned) = (middle[Excavator::tip].r, middle[Excavator::bucket].phi.to_degrees());
    let text = format!("the tip at ({:.3}, {:.3}) m, the bucket turned by {turned:.2}°", tip[0], tip[1]);
    says("excavator", &text.replace('-', "−"));
}

#[test]
fn the_wheel_leans_as_the_circles_of_its_arms_say() {
    let suspension = Wishbone::default();
    let (low_ball, high_ball) = ([-0.10, -0.12], [-0.13, 0.15]);
    let apart = f64::hypot(high_ball[0] - low_ball[0], high_ball[1] - low_ball[1]);
    let motion = moved(&suspension, 0.0, TAU, 64);
    for (_, at) in &motion {
        // With the angle of the lower arm given, the other positions follow from intersecting circles.
        let (sin, cos) = at[Wishbone::lower].phi.sin_cos();
        let low = [0.30 + suspension.lower_length * cos, 0.20 + suspension.lower_length * sin];
        let high = meet([0.38, 0.42], suspension.upper_length, low, apart);
        let turned = angle(low, high) - angle(low_ball, high_ball);
        close(at[Wishbone::camber].value, -turned.to_degrees(), 1e-12);
        let (sin, cos) = turned.sin_cos();
        let arm = [-low_ball[0], -suspension.tyre - low_ball[1]];
        close(at[Wishbone::track].value, low[0] + cos * arm[0] - sin * arm[1] - 0.75, 1e-14);
    }
    let text = [("raised", 16), ("lowered", 48)].map(|(what, instant)| {
        let (_, at) = &motion[instant];
        let (camber, track) = (at[Wishbone::camber].value, 1e3 * at[Wishbone::track].value);
        format!("{what} by 80 mm, {camber:+.2}° of camber and {track:+.1} mm of track").replace('-', "−")
    });
    text.iter().for_each(|text| says("wishbone", text));
}

/// The solution of the test set for IVP solvers at t = 0.03 s, from `tests/data/PUBLISHED.md`: the crank angle is
/// prescribed, everything else is computed.
#[test]
fn the_squeezer_agrees_with_the_test_set() {
    let published = include_str!("../../data/PUBLISHED.md");
    let line = published.split("t=0.03: q=(").nth(1).expect("the line");
    let numbers = |text: &str| -> Vec<f64> {
        let inside = text.split(')').next().expect("a bracket");
        inside.replace('−', "-").split(',').map(|number| number.trim().parse().expect("a number")).collect()
    };
    let (q, v) = (numbers(line), numbers(line.split("v=(").nth(1).expect("velocities")));
    let (beta, omega) = (q[0], v[0]);
    let squeezer = Squeezer { beta, omega, ..Squeezer::default() };
    let motion = squeezer.solver().motion(&squeezer.state_at(&0.0.into()).unwrap()).unwrap();
    let absolute = |x: &[f64]| [x[0], x[0] + x[1], x[2], x[3] + x[4], x[4], x[5] + x[6], x[6]];
    let bodies = [Squeezer::K1, Squeezer::K2, Squeezer::K3, Squeezer::K4, Squeezer::K5, Squeezer::K6, Squeezer::K7];
    for ((body, phi), rate) in bodies.into_iter().zip(absolute(&q)).zip(absolute(&v)) {
        close((motion[body].phi - phi + 1.0).rem_euclid(TAU), 1.0, 1e-13);
        close(motion[body].phi_dot, rate, 3e-11 * 1424.4);
    }
    says(
        "squeezer",
        "at t = 0.03 s of the test set all angles within 10⁻¹³ rad, all rates within 3·10⁻¹¹ of the fastest",
    );
}

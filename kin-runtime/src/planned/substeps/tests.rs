//! Tests of the length of steps, and of the checks of a step: each check beside its threshold, while all others pass.
//!
//! The margin of the test's four-bar is prescribed, so that its group can be arbitrarily near to its limit.

use super::*;
use crate::Kinematics;
use crate::course::Timed;
use crate::fixture::PlannedFourBar;

/// The step is the shorter one of those in which h q̇ alone, or ½ h² q̈ alone, turns by the limit.
#[test]
fn a_step_is_as_long_as_velocity_or_acceleration_alone_allows() {
    let weights = [1.0, 0.0, 0.5];
    let of = |v: [f64; 3], a: [f64; 3]| natural_step([&v, &a], &weights, 0.3);
    let is = |expected: f64, found: f64| assert!((found / expected - 1.0).abs() < 1e-15, "{found} for {expected}");
    is(0.15, of([-2.0, 50.0, 1.0], [0.1, 50.0, 0.1]));
    is(0.1, of([-2.0, 50.0, 6.0], [0.1, 50.0, 0.1]));
    is(0.2, of([0.5, 50.0, -0.5], [-15.0, 50.0, 1.0]));
    is(0.1, of([0.5, 50.0, -0.5], [-15.0, 50.0, 120.0]));
    assert_eq!(f64::INFINITY, of([0.0; 3], [0.0; 3]));
}

/// Accepts steps from any prediction.
const GENEROUS: Control = Control { rotation: 1.0, correction: 10.0, ..Control::USUAL };

/// A four-bar at the crank angle `start`, whose group has the distance `w` from its limit.
fn at_distance(start: f64, w: f64) -> PlannedFourBar {
    PlannedFourBar { start, margin: Some(w * w), ..PlannedFourBar::default() }
}

fn follower(mechanism: &PlannedFourBar) -> PlanFollower<PlannedFourBar> {
    let own = PlannedFourBar { margin: None, ..*mechanism };
    let q = own.state_at(&Instant::at(0.0)).unwrap().q;
    PlanFollower::new(mechanism, &Instant::at(0.0), &q).unwrap_or_else(|error| panic!("{error}"))
}

/// Takes a step of length h from a state; `now` prescribes the group's distance at its end.
fn step(
    follower: &mut PlanFollower<PlannedFourBar>,
    here: &PlanSolution<PlannedFourBar>,
    now: &PlannedFourBar,
    h: f64,
    control: &Control,
) -> Result<f64, Rejection> {
    let course = Timed { from: 0.0, to: h, inputs: &|_, _| () };
    let mut inputs = follower.inputs;
    let nearest = follower.nearest;
    follower.step(now, &course, [0.0, h], &mut inputs, (here, nearest), control)
}

/// The step, forwards or backwards, that turns by `turn`.
fn step_of(follower: &PlanFollower<PlannedFourBar>, turn: f64, side: f64) -> f64 {
    let PlanSolution { q, q_dot, q_ddot, .. } = follower.state();
    let turns =
        |h: f64| parabola(&mut q.clone(), [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()], follower.weights.as_ref(), h);
    let (mut short, mut long) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (short + long);
        if turns(side * middle) < turn { short = middle } else { long = middle }
    }
    side * long
}

#[test]
fn a_group_is_believed_where_the_step_resolves_it() {
    // 10 turn³ is 0.2 for a turn of 0.271; the distances at both ends count.
    for [before, now] in [[0.2, 0.2], [0.9, 0.2], [0.2, 0.9]] {
        for side in [1.0, -1.0] {
            let (from, to) = (at_distance(0.2, before), at_distance(0.2, now));
            for (turn, expected) in [(0.27, None), (0.273, Some(Rejection::Group(0)))] {
                let mut follower = follower(&from);
                let (here, h) = (*follower.state(), step_of(&follower, turn, side));
                assert_eq!(expected, step(&mut follower, &here, &to, h, &GENEROUS).err(), "{before} {now} {turn}");
            }
        }
    }
}

#[test]
fn a_solution_that_is_not_where_it_was_predicted_does_not_count() {
    let mechanism = PlannedFourBar::default();
    for side in [1.0, -1.0] {
        let mut follower = follower(&mechanism);
        let (here, h) = (*follower.state(), step_of(&follower, 0.3, side));
        assert!(step(&mut follower, &here, &mechanism, h, &GENEROUS).is_ok());
        let found = follower.trial();
        let away = turned(found.q.as_ref(), follower.predicted.as_ref(), follower.weights.as_ref());
        assert!(away > 4.0 * NEGLIGIBLE_CORRECTION && away < 0.03, "{away}");
        for (factor, expected) in [(1.01, None), (0.99, Some(Rejection::Coarse))] {
            let control = Control { correction: (factor * away - NEGLIGIBLE_CORRECTION) / 0.3, ..GENEROUS };
            assert_eq!(expected, step(&mut follower, &here, &mechanism, h, &control).err(), "{factor}");
        }
    }
}

#[test]
fn a_group_that_cannot_close_is_to_blame_and_so_is_a_number_that_is_none() {
    let mechanism = PlannedFourBar::default();
    let mut follower = follower(&mechanism);
    let here = *follower.state();
    for (margin, expected) in
        [(1e-12, Rejection::Margin(0)), (-0.5, Rejection::Margin(0)), (f64::NAN, Rejection::NonFinite)]
    {
        let bad = PlannedFourBar { margin: Some(margin), ..PlannedFourBar::default() };
        assert_eq!(Some(expected), step(&mut follower, &here, &bad, 0.01, &GENEROUS).err());
    }
    assert!(step(&mut follower, &here, &at_distance(0.2, 1.1e-6), 1e-9, &GENEROUS).is_ok());
}

/// The crank angle, near the dead centre of the four-bar, at which its closure is `w`.
fn crank_at(w: f64) -> f64 {
    let closure = |phi: f64| {
        let q = PlannedFourBar { start: phi, ..PlannedFourBar::default() }.state_at(&Instant::at(0.0)).unwrap().q;
        let mut found = [0.0];
        let at = Instant::at(0.0);
        PlannedFourBar::default().branches_with(&[], &at, &q, &mut found).unwrap();
        found[0].abs()
    };
    let (mut a, mut b) = (0.5, PlannedFourBar::limit() - 1e-9);
    for _ in 0..50 {
        let middle = 0.5 * (a + b);
        if closure(middle) > w { a = middle } else { b = middle }
    }
    a
}

/// The rotation of the third body that takes the branch value of a configuration to `w`, towards the limit.
fn rotation_to(w: f64, q: &[f64; 9]) -> f64 {
    let value = |out: f64| {
        let (mut there, mut found) = (*q, [0.0]);
        there[5] += out;
        PlannedFourBar::default().branches_with(&[], &Instant::at(0.0), &there, &mut found).unwrap();
        found[0]
    };
    let sign = value(0.0).signum();
    let side = if sign * value(1e-3) < sign * value(0.0) { 1.0 } else { -1.0 };
    let (mut near, mut far) = (0.0, 0.2 * side);
    for _ in 0..50 {
        let middle = 0.5 * (near + far);
        if sign * value(middle) > w { near = middle } else { far = middle }
    }
    near
}

/// A group that is close to its limit at an end of a step is looked at half way along the parabola, which here moves away
/// and returns to its start; the step is too long if the branch value there is less than a quarter of those at its ends.
#[test]
fn a_group_that_may_have_been_at_its_limit_within_a_step_is_looked_at_half_way() {
    let (phi, h) = (crank_at(0.06), 1e-6);
    for (share, is_far) in [(0.26, true), (0.24, false)] {
        for ([before, now], looks) in
            [([0.14, 0.14], true), ([0.9, 0.14], true), ([0.14, 0.9], true), ([0.151, 0.151], false)]
        {
            let mut follower = follower(&at_distance(phi, before));
            let mut here = *follower.state();
            let out = rotation_to(share * 0.06, &here.q);
            here.q_dot = [0.0; 9];
            here.q_ddot = [0.0; 9];
            (here.q_dot[5], here.q_ddot[5]) = (4.0 * out / h, -8.0 * out / (h * h));
            let found = step(&mut follower, &here, &at_distance(phi, now), h, &GENEROUS);
            let expected = if looks && !is_far { Some(Rejection::Group(0)) } else { None };
            assert_eq!(expected, found.err(), "{share} {before} {now}");
        }
    }
}

/// Of q(u, t) with u̇ = 3 and ü = 0: q̇ = q_u u̇ + q_t and q̈ = q_uu u̇² + 2 q_ut u̇ + q_tt, of which q_u u̇ and q_uu
/// u̇² are left.
#[test]
fn what_time_itself_contributes_is_taken_out() {
    let (q_u, q_t, q_uu, q_ut, q_tt) = (0.5, 7.0, 0.25, 2.0, -1.0);
    let of = |u_dot: f64| (q_u * u_dot + q_t, q_uu * u_dot * u_dot + 2.0 * q_ut * u_dot + q_tt);
    let ((v, a), still, back) = (of(3.0), of(0.0), of(-3.0));
    let (mut q_dot, mut q_ddot) = ([v], [a]);
    without_time([&mut q_dot, &mut q_ddot], [&[still.0], &[still.1]], &[back.1]);
    assert_eq!([1.5, 2.25], [q_dot[0], q_ddot[0]]);
    let mut inputs = [Signal::new(1.0, 3.0, 5.0)];
    scale_rates(&mut inputs, -1.0);
    assert_eq!([Signal::new(1.0, -3.0, 0.0)], inputs);
}

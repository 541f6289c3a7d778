//! Unilateral conditions: the events agree with closed forms, in either direction of time, and the motion is not
//! changed.

mod bells;
mod corners;
mod crossings;
mod fast;
mod one_step;
mod pulses;
mod resting_cams;
mod starts;
mod surroundings;
mod touches;

use core::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI, TAU};
use kin_runtime::{Crossing, Event, Instant, Kinematics, Mechanism, Signal, SolveError, Trajectory, mechanism};
use kin_tests::mechanisms::StrokeLimits;
use kin_tests::random::Random;

use Crossing::{Restored, Touched, Violated};

/// A limit so far away that it is never reached.
const NEVER: f64 = 1e3;

/// A mechanism whose limits are never reached.
fn free() -> StrokeLimits {
    StrokeLimits {
        far: NEVER,
        near: -NEVER,
        high: NEVER,
        leaning: NEVER,
        ahead: NEVER,
        marks: [-NEVER; 3],
        ..StrokeLimits::default()
    }
}

fn grid(from: f64, to: f64, steps: usize) -> Vec<f64> {
    (0..=steps).map(|k| from + (to - from) * k as f64 / steps as f64).collect()
}

/// The events of one condition as (t, crossing), all of them accurate to 1e-10.
fn events_of(trajectory: &Trajectory, name: &str) -> Vec<(f64, Crossing)> {
    let of: Vec<&Event> = trajectory.events.iter().filter(|event| event.name == name).collect();
    for event in &of {
        assert!(event.within <= 1e-10, "{name}: {}", event.within);
        assert_eq!(event.t, event.state.t);
        let [q, q_dot, _] = event.state.columns();
        // The bodies in the event's state have the coordinates of the event, not those at the start of the step.
        for (body, info) in event.state.bodies.iter().zip(trajectory.model.bodies) {
            for (k, (shown, rate)) in
                [(body.x, body.x_dot), (body.y, body.y_dot), (body.phi, body.phi_dot)].into_iter().enumerate()
            {
                if let Some(place) = info.coordinates[k] {
                    assert_eq!((q[place], q_dot[place]), (shown, rate), "{name}: {} at t = {}", info.name, event.t);
                }
            }
        }
        assert_eq!(trajectory.model.conditions[event.condition].name, name);
    }
    of.iter().map(|event| (event.t, event.crossing)).collect()
}

#[track_caller]
fn agree(found: &[(f64, Crossing)], expected: &[(f64, Crossing)]) {
    assert_eq!(found.len(), expected.len(), "{found:?} and {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found.0 - expected.0).abs() <= 1e-10 && found.1 == expected.1, "{found:?} and {expected:?}");
    }
}

fn sweep<M: Mechanism>(mechanism: &M, times: &[f64]) -> Trajectory {
    mechanism.kinematic_analysis(times).unwrap()
}

#[test]
fn a_stroke_limit_is_met_where_the_closed_form_says() {
    let mechanism = StrokeLimits { far: 0.85, near: 0.55, ..free() };
    let (far, near) = (mechanism.crank_at(0.85), mechanism.crank_at(0.55));
    for steps in [1, 7, 400] {
        let trajectory = sweep(&mechanism, &grid(0.2, TAU + 1.0, steps));
        let start = trajectory.violated_at_start.clone();
        assert_eq!(start, [0], "x is beyond 0.85 at 0.2");
        agree(&events_of(&trajectory, "front"), &[(far, Restored), (TAU - far, Violated), (TAU + far, Restored)]);
        agree(&events_of(&trajectory, "back"), &[(near, Violated), (TAU - near, Restored)]);
        assert!(trajectory.events.is_sorted_by_key(|event| event.t));
        assert!(!trajectory.stopped);
    }
}

#[test]
fn points_distances_and_defines_have_limits() {
    let mechanism = StrokeLimits { high: 0.8, leaning: 0.2, ..free() };
    let trajectory = sweep(&mechanism, &grid(0.0, PI, 5));
    let high = 0.8_f64.asin();
    agree(&events_of(&trajectory, "height"), &[(high, Violated), (PI - high, Restored)]);
    // The sine of the rod's angle is −r/l sin φ.
    let leaning = (0.7 * 0.2_f64.sin() / 0.2).asin();
    agree(&events_of(&trajectory, "slope"), &[(leaning, Violated), (PI - leaning, Restored)]);
    // The smallest distance between the pin and the eye above it is exactly the limit 2 r.
    agree(&events_of(&trajectory, "reach"), &[(FRAC_PI_2, Touched)]);
    assert_eq!(trajectory.events.len(), 5);
    for event in &trajectory.events {
        let motion = mechanism.solver().motion(&event.state).unwrap();
        assert!(motion.conditions[event.condition].value.abs() < 1e-12);
    }
}

#[test]
fn a_limit_may_move() {
    let mechanism = StrokeLimits { gap: 0.05, ahead: 0.0, ..free() };
    let trajectory = sweep(&mechanism, &grid(0.0, 7.0, 3));
    assert_eq!(trajectory.violated_at_start, [5]);
    let g = |t: f64| 0.05 * t + 0.7 - (0.2 * t.cos() + (0.49 - (0.2 * t.sin()).powi(2)).sqrt());
    let zero = |mut lo: f64, mut hi: f64| {
        assert!(g(lo) * g(hi) < 0.0);
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            *if g(middle) * g(lo) > 0.0 { &mut lo } else { &mut hi } = middle;
        }
        lo
    };
    let found = events_of(&trajectory, "moving");
    assert!(g(6.2) > 0.0, "later turns stay behind the limit");
    agree(&found, &[(zero(0.5, 2.0), Restored)]);
}

#[test]
fn members_of_a_family_have_events_of_their_own() {
    let mechanism = StrokeLimits { marks: [0.6, 0.7, 0.8], ..free() };
    let trajectory = sweep(&mechanism, &grid(0.0, PI, 1));
    let names: Vec<&str> = trajectory.events.iter().map(|event| event.name).collect();
    assert_eq!(names, ["mark[2]", "mark[1]", "reach", "mark[0]"]);
    for (k, x) in [0.6, 0.7, 0.8].into_iter().enumerate() {
        agree(&events_of(&trajectory, &format!("mark[{k}]")), &[(mechanism.crank_at(x), Violated)]);
    }
}

#[test]
fn a_sweep_may_run_backwards_and_turn_round() {
    let mechanism = StrokeLimits { near: 0.55, ..free() };
    let near = mechanism.crank_at(0.55);
    let back = sweep(&mechanism, &[5.0, 1.0]);
    agree(&events_of(&back, "back"), &[(TAU - near, Violated), (near, Restored)]);
    let there_and_back = sweep(&mechanism, &[1.0, 3.0, 3.0, 1.0]);
    agree(&events_of(&there_and_back, "back"), &[(near, Violated), (near, Restored)]);
    assert_eq!(there_and_back.states[0].q.len(), StrokeLimits::COORDINATES);
}

#[test]
fn two_limits_may_be_met_at_once() {
    let mechanism = StrokeLimits { near: 0.6, marks: [0.6, -NEVER, -NEVER], ..free() };
    let trajectory = sweep(&mechanism, &[1.7, 2.8]);
    let met: Vec<(&str, f64)> = trajectory.events.iter().map(|event| (event.name, event.t)).collect();
    let t = mechanism.crank_at(0.6);
    assert!(met.iter().all(|(_, at)| (at - t).abs() < 1e-10), "{met:?}");
    assert_eq!(met.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["back", "mark[0]"]);
    let stopped = mechanism.solver().stop_at_events(true).sweep(&[1.7, 2.8]).unwrap();
    assert_eq!(stopped.events.len(), 2);
}

#[test]
fn a_limit_met_at_an_instant_of_the_grid_is_met_once() {
    for high in [0.5, 0.5 + 1e-16, 0.5 - 1e-16, 0.5 + 1e-14, 0.5 - 1e-14] {
        let mechanism = StrokeLimits { high, ..free() };
        for times in [vec![0.0, FRAC_PI_6, 1.0], grid(0.0, FRAC_PI_2, 3), vec![0.1, FRAC_PI_6, FRAC_PI_6, 1.2]] {
            let trajectory = sweep(&mechanism, &times);
            agree(&events_of(&trajectory, "height"), &[(FRAC_PI_6, Violated)]);
            let back: Vec<f64> = times.iter().rev().copied().collect();
            agree(&events_of(&sweep(&mechanism, &back), "height"), &[(FRAC_PI_6, Restored)]);
        }
    }
    // The sweep may end or begin at the limit.
    let mechanism = StrokeLimits { high: 0.5, ..free() };
    agree(&events_of(&sweep(&mechanism, &[0.0, FRAC_PI_6]), "height"), &[(FRAC_PI_6, Violated)]);
    let inwards = sweep(&mechanism, &[FRAC_PI_6, 0.0]);
    assert!(inwards.events.is_empty() && inwards.violated_at_start.is_empty(), "{:?}", inwards.events);
    let outwards = sweep(&mechanism, &[FRAC_PI_6, 1.0]);
    assert!(outwards.events.is_empty());
    assert_eq!(outwards.violated_at_start, [2]);
}

//! Unilateral conditions: limits are met where closed forms say, in either direction of time, and nothing else changes.

use core::f64::consts::TAU;
use kin_runtime::{Crossing, Event, Kinematics, Mechanism, Trajectory};
use kin_tests::mechanisms::StrokeLimits;

use Crossing::{Restored, Violated};

/// A limit so far away that it is never met.
const NEVER: f64 = 1e3;

/// All limits out of the way.
fn free() -> StrokeLimits {
    StrokeLimits {
        far: NEVER,
        near: -NEVER,
        high: NEVER,
        leaning: NEVER,
        gap: NEVER,
        marks: [-NEVER; 3],
        ..StrokeLimits::default()
    }
}

fn grid(from: f64, to: f64, steps: usize) -> Vec<f64> {
    (0..=steps).map(|k| from + (to - from) * k as f64 / steps as f64).collect()
}

/// The events of one condition as (t, crossing), all of them certain to 1e-10.
fn events_of(trajectory: &Trajectory, name: &str) -> Vec<(f64, Crossing)> {
    let of: Vec<&Event> = trajectory.events.iter().filter(|event| event.name == name).collect();
    for event in &of {
        assert!(event.within <= 1e-10, "{name}: {}", event.within);
        assert_eq!(event.t, event.state.t);
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

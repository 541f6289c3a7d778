//! The mechanisms of the gallery, `examples/README.md`, compared with known properties. The page contains the numbers
//! that are measured here, word for word.

mod forces;
mod gears;
mod legs;
mod machines;
mod open;
mod page;
mod parallel;
mod sliders;
mod straight;

use kin_runtime::{Kinematics, Motion};

/// The reports of a motion, at `steps` + 1 instants with their times.
fn moved<M: Kinematics>(mechanism: &M, from: f64, to: f64, steps: usize) -> Vec<(f64, Motion)> {
    let times: Vec<f64> = (0..=steps).map(|k| from + (to - from) * k as f64 / steps as f64).collect();
    let trajectory = mechanism.kinematic_analysis(&times).expect("a motion");
    let solver = mechanism.solver();
    trajectory.iter().map(|state| (state.t, solver.motion(state).expect("its report"))).collect()
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}, off by {:e}", found - expected);
}

/// The intersection of the circles of radius r about p and s about q, on the left of the direction from p to q.
fn meet(p: [f64; 2], r: f64, q: [f64; 2], s: f64) -> [f64; 2] {
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let d = dx.hypot(dy);
    let along = (d * d + r * r - s * s) / (2.0 * d);
    let aside = (r * r - along * along).sqrt();
    [p[0] + (along * dx - aside * dy) / d, p[1] + (along * dy + aside * dx) / d]
}

/// The angle of the direction from p to q.
fn angle(p: [f64; 2], q: [f64; 2]) -> f64 {
    (q[1] - p[1]).atan2(q[0] - p[0])
}

/// The smallest and the largest number.
fn range(numbers: impl IntoIterator<Item = f64>) -> (f64, f64) {
    numbers.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

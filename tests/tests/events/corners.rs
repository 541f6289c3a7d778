//! Conditions with absolute values, which have corners: within a step the samples at its ends show nothing of what is between.

use super::{Restored, Violated, grid};
use kin_runtime::{Crossing, Kinematics, Trajectory, mechanism};

/// A slider that moves as s = sin t + cos 0.7 t, watched beside its middle.
#[mechanism]
#[bodies(slider)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(move_to: slider.x = sin(t) + cos(0.7 * t))]
#[unilateral(middle: abs(slider.x) < k)]
#[unilateral(edges: abs(abs(slider.x) - 0.5) > k)]
struct Wave {
    k: f64,
}

fn s(t: f64) -> f64 {
    t.sin() + (0.7 * t).cos()
}

/// The zeros of a function between two times, by its signs at many instants, each with the sign after it.
fn zeros(f: &dyn Fn(f64) -> f64, from: f64, to: f64) -> Vec<(f64, bool)> {
    let all = grid(from, to, 40_000);
    let mut found = Vec::new();
    for pair in all.windows(2) {
        let [mut low, mut high] = [pair[0], pair[1]];
        if f(low) * f(high) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                *(if f(low) * f(middle) < 0.0 { &mut high } else { &mut low }) = middle;
            }
            found.push((low, f(pair[1]) > 0.0));
        }
    }
    found
}

fn check(motion: &Trajectory, name: &str, f: &dyn Fn(f64) -> f64, [from, to]: [f64; 2]) {
    let of = motion.events.iter().filter(|event| event.name == name);
    let found: Vec<(f64, Crossing)> = of.map(|event| (event.t, event.crossing)).collect();
    let right = zeros(f, from, to);
    assert_eq!(right.len(), found.len(), "{name} {from}..{to}: {found:?}, not {right:?}");
    for ((t, crossing), (zero, after)) in found.iter().zip(&right) {
        assert!((t - zero).abs() < 1e-9, "{name} {from}..{to}: {found:?}, not {right:?}");
        assert_eq!(*crossing, if *after { Restored } else { Violated }, "{name} {from}..{to} at {t}");
    }
}

#[test]
fn corners_hide_no_crossings() {
    for k in [0.002, 0.005, 0.013, 0.03, 0.08] {
        for end in (0..14).map(|j| 5.0 + 0.23 * f64::from(j)).flat_map(|end| [end, -end]) {
            for steps in [1, 2, 3, 5, 8, 13] {
                let motion = Wave { k }.solver().sweep(&grid(0.0, end, steps)).unwrap();
                assert!(motion.unwatched.is_empty(), "{k} {end} {steps}");
                check(&motion, "middle", &|t| k - s(t).abs(), [0.0, end]);
                check(&motion, "edges", &|t| (s(t).abs() - 0.5).abs() - k, [0.0, end]);
            }
        }
    }
}

//! Sweeps along the arc through dead centres that are near each other, within one step.

use kin_runtime::{Kinematics, mechanism};

/// t = s³ − e s turns back at s = ∓√(e/3), which are near each other for a small e.
#[mechanism]
#[coordinates(s)]
#[driver(drive: s.powi(3) - e*s = t)]
#[guess(s = -1)]
struct Cubic {
    e: f64,
}

#[test]
fn places_near_each_other_are_all_listed() {
    for e in [0.3, 0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6] {
        for (steps, [from, to]) in [20, 50, 333].into_iter().flat_map(|n| [[-0.9, 0.9], [-0.7, 1.1]].map(|t| (n, t))) {
            let swept = Cubic { e }.solver().sweep_along_arc(from, Some(to), steps).unwrap();
            let found: Vec<[f64; 2]> =
                swept.arc.as_ref().expect("an arc").places.iter().map(|place| [place.q[0], place.t]).collect();
            let s = (e / 3.0_f64).sqrt();
            let right = [[-s, 2.0 / 3.0 * e * s], [s, -2.0 / 3.0 * e * s]];
            assert_eq!(2, found.len(), "{e} {steps}: {found:?}");
            for (found, right) in found.iter().zip(right) {
                assert!(
                    (found[0] - right[0]).abs() < 1e-6 && (found[1] - right[1]).abs() < 1e-9,
                    "{e} {steps}: {found:?}"
                );
            }
        }
    }
}

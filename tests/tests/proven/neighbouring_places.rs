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

/// An arm of length 1 on a cylinder that is shortest, 0.5, at t = 7/3.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(cylinder: distance(ground @ (1.5, 0), arm @ (1, 0)) = 1.2 - 0.3*t)]
#[guess(arm.phi = 0.8)]
struct Arm;

#[test]
fn an_interval_may_end_where_a_length_would_be_negative() {
    for (to, steps) in [(3.0, 10), (6.0, 10), (6.0, 57), (40.0, 100)] {
        let swept = Arm.solver().sweep_along_arc(0.0, Some(to), steps).unwrap_or_else(|error| panic!("{to}: {error}"));
        let places = &swept.arc.as_ref().expect("an arc").places;
        assert_eq!(1, places.len(), "{to}");
        assert!((places[0].t - 7.0 / 3.0).abs() < 1e-9 && places[0].q[2].abs() < 1e-6, "{to}: {:?}", places[0]);
        assert!(swept.states.last().is_some_and(|state| state.q[2] < -0.5), "{to}: it turns back to the other side");
    }
}

//! What redundant rows leave open or forbid has no derivatives: multipliers that depend on how rows are scaled, and motions of
//! rows that agree for one value of a parameter only.

use kin_runtime::{Instant, Kinematics, SolveError, mechanism};

/// A beam on three equal arms, of which two would suffice.
#[mechanism(allow_redundant)]
#[bodies(a, b, c, beam)]
#[revolute(O1: ground @ (0, 0), a @ (0, 0))]
#[revolute(O2: ground @ (0.3, 0), b @ (0, 0))]
#[revolute(O3: ground @ (0.6, 0), c @ (0, 0))]
#[revolute(A: a @ (r, 0), beam @ (0, 0))]
#[revolute(B: b @ (r, 0), beam @ (0.3, 0))]
#[revolute(C: c @ (r, 0), beam @ (0.6, 0))]
#[driver(drive: a.phi = 1 + t)]
#[guess(a.phi = 1, b.phi = 1, c.phi = 1)]
#[gravity(0, -9.81)]
#[mass(beam @ (0.2, 0.05), mass = 3, inertia = 0.1)]
struct Beam {
    r: f64,
}

#[test]
fn multipliers_that_are_left_open_have_no_derivatives() {
    let at = |r: f64| {
        let beam = Beam { r };
        let state = beam.state_at(&Instant::at(0.4)).unwrap();
        beam.solver().forces(&state).unwrap()
    };
    let (r, h) = (0.2, 1e-4);
    let beam = Beam { r };
    let state = beam.state_at(&Instant::at(0.4)).unwrap();
    let found = beam.solver().sensitivities(&state).unwrap();
    let forces = found["r"].forces.as_ref().expect("forces have derivatives");
    let [before, after] = [at(r - h), at(r + h)];
    let mut open = 0;
    let all = forces.multipliers.iter().zip(before.multipliers.iter().zip(&after.multipliers));
    for (k, (derivative, (before, after))) in all.enumerate() {
        let expected = (after - before) / (2.0 * h);
        let is_right = (derivative - expected).abs() < 1e-5 * (1.0 + expected.abs());
        assert!(is_right || derivative.is_nan(), "{k}: {derivative} instead of {expected}");
        open += usize::from(derivative.is_nan());
    }
    // The load is shared among the arms, and that of the drive is determined.
    assert!(open > 0 && open < forces.multipliers.len(), "{:?}", forces.multipliers);
}

/// Two motors on one shaft, of which one may be a little faster.
#[mechanism(allow_redundant)]
#[bodies(shaft)]
#[revolute(O: ground @ (0, 0), shaft @ (0, 0))]
#[driver(one: shaft.phi = t)]
#[driver(other: shaft.phi = (1 + e)*t)]
struct Motors {
    e: f64,
}

/// Rows that contradict one another for every other value of a parameter do so for a value of the size of rounding, too.
#[test]
fn a_deviation_near_zero_is_a_deviation() {
    for e in [0.0, 1e-16, 1e-13, -1e-13, 1e-10] {
        let motors = Motors { e };
        let state = motors.state_at(&Instant::at(0.0)).unwrap();
        let found = motors.solver().sensitivities(&state);
        assert!(matches!(found, Err(SolveError::NoSensitivity { parameter: "e", .. })), "e = {e}: {found:?}");
    }
}

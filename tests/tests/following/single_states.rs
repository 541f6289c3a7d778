//! States near a crossing of branches, where rounding errors dominate the rates that follow from q: a single state has those
//! of the smooth motion through it, whether the plan solves, full Newton, or a prescribed coordinate moves the mechanism.

use kin_runtime::{Instant, Kinematics, Options, Planned, Signal, SolveError, State, mechanism};

/// A parallelogram, which lies flat at t = 0.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (2, 0), rocker @ (a, 0))]
#[revolute(D: rocker @ (0, 0), ground @ (2, 0))]
#[driver(drive: crank.phi = t)]
#[guess(crank.phi = 1, coupler.phi = 0, rocker.phi = 1)]
struct Flat {
    a: f64,
}

/// The same without a driver.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (2, 0), rocker @ (a, 0))]
#[revolute(D: rocker @ (0, 0), ground @ (2, 0))]
#[guess(crank.phi = 1, coupler.phi = 0, rocker.phi = 1)]
struct Moved {
    a: f64,
}

/// The parallelogram with its crank at an angle, a little open.
fn start(a: f64, angle: f64) -> [f64; 9] {
    let (y, x) = angle.sin_cos();
    [0.0, 0.0, angle, a * x, a * y, 0.0, 2.0, 0.0, angle * 1.001]
}

/// True for a state whose q̈ is accurate to 4·10⁻⁶ of the square of the crank's rate, or, where that was not possible from q
/// alone, much better.
fn is_right(state: &State, angle: f64) -> bool {
    let allowed = if angle < 1e-4 { 1e-9 } else { 1e-5 };
    (state.q_dot[8] - 1.0).abs() < 1e-8 && state.q_ddot[8].abs() < allowed
}

#[test]
fn rates_beside_a_crossing_are_right() {
    for a in [1.0, 0.7, 0.33] {
        for exponent in -160..=-10 {
            let angle = 1.37 * 10_f64.powf(0.05 * f64::from(exponent));
            let (start, mechanism) = (start(a, angle), Flat { a });
            let planned = Planned::new(&mechanism, &Instant::at(angle), &start).is_ok();
            for use_plan in [true, false] {
                let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
                match solver.state_from(&Instant::at(angle), &start) {
                    Ok(state) => assert!(is_right(&state, angle), "{a} {angle} {use_plan}: {:?}", state.q_ddot),
                    Err(SolveError::Singular { .. }) => assert!(!planned && angle < 1e-6, "{a} {angle}"),
                    Err(error) => panic!("{a} {angle}: {error}"),
                }
            }
            let moved = Moved { a };
            let solver = moved.solver().with_given(2, Signal::new(angle, 1.0, 0.0));
            match solver.state_from(&Instant::at(0.0), &start) {
                Ok(state) => assert!(is_right(&state, angle), "{a} {angle}: {:?}", state.q_ddot),
                Err(SolveError::Singular { .. }) => assert!(angle < 1e-6, "{a} {angle}"),
                Err(error) => panic!("{a} {angle}: {error}"),
            }
            // A sweep that ends there.
            let solver = moved.solver().with_given(2, Signal::new(1.0, -1.0, 0.0));
            if let Ok(states) = solver.sweep(&[0.0, 1.0 - angle]) {
                let state = states.states.last().expect("two states");
                // The rocker may have assembled as that of the antiparallelogram, which crosses there, too.
                let is_parallel = state.q_dot[8] < 0.0;
                assert!(!is_parallel || state.q_ddot[8].abs() < 1e-5, "{a} {angle}: {:?}", state.q_ddot);
            }
        }
    }
}

//! States near a crossing of branches: where rounding errors dominate the rates, a single state is refused as a sweep and a
//! plan refuse it, whether the plan solves, full Newton, or a prescribed coordinate moves the mechanism.

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

/// True for a state as accurate as q̈ of the rocker can be, to 4·10⁻⁶ of the square of the crank's rate.
fn is_right(state: &State) -> bool {
    (state.q_dot[8] - 1.0).abs() < 1e-8 && state.q_ddot[8].abs() < 1e-5
}

#[test]
fn what_rounding_dominates_is_refused_by_every_way() {
    for a in [1.0, 0.7, 0.33] {
        for exponent in -160..=-10 {
            let angle = 1.37 * 10_f64.powf(0.05 * f64::from(exponent));
            let (start, mechanism) = (start(a, angle), Flat { a });
            let planned = Planned::new(&mechanism, &Instant::at(angle), &start).is_ok();
            for use_plan in [true, false] {
                let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
                match solver.state_from(&Instant::at(angle), &start) {
                    Ok(state) => assert!(is_right(&state), "{a} {angle} {use_plan}: {:?}", state.q_ddot),
                    Err(SolveError::Singular { .. }) => assert!(!planned && angle < 1e-6, "{a} {angle}"),
                    Err(error) => {
                        assert!(matches!(error, SolveError::Plan(_)) && angle < 1e-3, "{a} {angle}: {error}");
                        assert!(error.to_string().contains("A, B and D on one line"), "{error}");
                    }
                }
            }
            let moved = Moved { a };
            let solver = moved.solver().with_given(2, Signal::new(angle, 1.0, 0.0));
            match solver.state_from(&Instant::at(0.0), &start) {
                Ok(state) => assert!(is_right(&state), "{a} {angle}: {:?}", state.q_ddot),
                Err(SolveError::Singular { .. }) => assert!(angle < 1e-6, "{a} {angle}"),
                Err(error) => assert!(matches!(error, SolveError::Rounded { .. }) && angle < 1e-3, "{error}"),
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

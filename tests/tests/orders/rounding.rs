//! Derivatives near a crossing of branches, where rounding errors grow with every order.

use kin_runtime::{Instant, Kinematics, Options, SolveError, mechanism};

/// A parallelogram, which lies flat at t = 0: all bars turn with constant rates, and no higher derivative of an angle exists.
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

#[test]
fn a_derivative_that_rounding_dominates_is_refused() {
    let a = 0.7;
    let mechanism = Flat { a };
    for angle in [1.0_f64, 0.3, 0.1, 0.03, 0.01, 3e-3, 1.37e-3] {
        let (y, x) = angle.sin_cos();
        let start = [0.0, 0.0, angle, a * x, a * y, 0.0, 2.0, 0.0, angle];
        for use_plan in [true, false] {
            let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
            let state = solver.state_from(&Instant::at(angle), &start).expect("far enough from the crossing");
            for order in 3..=10 {
                // The rounding errors of this order.
                let noise = f64::EPSILON / angle.powi(2 * order - 1);
                match solver.derivatives(&state, order as usize) {
                    Ok(found) => {
                        assert!(noise < 1e-3, "{angle} {order} {use_plan}");
                        let off = found.q.iter().skip(3).map(|q| q[5].abs().max(q[8].abs())).fold(0.0, f64::max);
                        assert!(off < 1e-4, "{angle} {order} {use_plan}: {off:e}");
                    }
                    Err(error) => {
                        assert!(matches!(error, SolveError::Rounded { .. }), "{angle} {order}: {error}");
                        assert!(noise > 1e-12, "{angle} {order} {use_plan}: {error}");
                    }
                }
            }
        }
    }
}

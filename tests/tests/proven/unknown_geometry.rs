//! Dimensions that are not numbers: nothing is proven of a mechanism that has none.

use kin_runtime::{Instant, Kinematics, SolveError, mechanism};

/// A four-bar whose coupler is the other leg of a right triangle.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (sqrt(long * long - short * short), 0), rocker @ (0, 0))]
#[revolute(C: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
#[driver(drive: crank.phi = pi/4 + t)]
struct Triangle {
    long: f64,
    short: f64,
}

#[test]
fn a_dimension_that_is_no_number_is_an_error_and_not_a_proof() {
    let right = Triangle { long: 0.5, short: 0.3 };
    assert_eq!(2, right.solver().assemblies(&Instant::at(0.0)).unwrap().found.len());
    assert!(right.solver().ranges(&Instant::at(0.0), 1.0).unwrap().is_complete());
    let wrong = Triangle { long: 0.3, short: 0.5 };
    let errors = [
        wrong.solver().assemblies(&Instant::at(0.0)).unwrap_err(),
        wrong.solver().ranges(&Instant::at(0.0), 1.0).unwrap_err(),
    ];
    for error in errors {
        assert!(matches!(error, SolveError::NonFinite { what: "Φ", name: "B.x", .. }), "{error}");
    }
}

//! Parameters that are listed more than once.

use kin_runtime::{Kinematics, Measure, Mechanism, Options, mechanism};

/// A crank.
#[mechanism]
#[bodies(arm)]
#[point(tip = arm @ (l, 0))]
#[revolute(pin: ground @ (0, 0), arm @ (0, 0))]
#[driver(drive: arm.phi = t)]
struct Crank {
    #[param(0.2)]
    l: f64,
}

#[test]
fn a_parameter_that_is_listed_twice_has_its_derivative_twice() {
    let solver = Crank::default();
    let solver = solver.solver();
    let state = solver.state(&0.3.into()).expect("it closes");
    let height = Measure::named(Crank::model(), "tip.y").expect("it is a point");
    for use_plan in [true, false] {
        let solver = solver.clone().with_options(Options { use_plan, ..Options::default() });
        let found = solver.measure_sensitivities(&state, std::slice::from_ref(&height), &[0, 0]).expect("they exist");
        assert!(found.iter().flatten().all(|by| (by - 0.3_f64.sin()).abs() < 1e-15), "{found:?}");
        let found = solver.sensitivities_by(&state, &[0, 0]).expect("they exist");
        assert_eq!(found.by[0].points, found.by[1].points);
        assert!((found.by[1].points[0].r[1] - 0.3_f64.sin()).abs() < 1e-15);
    }
}

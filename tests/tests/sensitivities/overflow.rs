//! Lengths of vectors whose squares do not show their derivatives: those that are large, tiny or 0.

use kin_runtime::{Instant, Kinematics, Measure, Mechanism, mechanism};

/// A crank with a weight at its end, on a pin.
#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = 0.3 + 2 * t)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.2, 0), mass = m)]
struct Weight {
    m: f64,
}

#[test]
fn the_gradient_of_a_force_whose_square_overflows_is_right() {
    let force: Vec<Measure> = Measure::named(Weight::model(), "O.force").into_iter().collect();
    let gradient = |m: f64| {
        let weight = Weight { m };
        let state = weight.solver().state(&Instant::at(0.0)).expect("it closes");
        weight.solver().gradient(&[state], &force, &[1.0]).expect("a gradient")[0]
    };
    // The force is proportional to the mass.
    let light = gradient(1.0);
    assert!(light > 9.0, "{light}");
    for heavy in [1e150, 1e160, 1e300] {
        assert!((light / gradient(heavy) - 1.0).abs() < 1e-12, "{heavy}: {}", gradient(heavy));
    }
}

/// A turning crank.
#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = omega * t)]
#[point(tip = crank @ (l, 0))]
struct Turning {
    omega: f64,
    l: f64,
}

/// The speed is |ω| l.
#[test]
fn a_speed_has_a_derivative_unless_it_is_0() {
    let speed: Vec<Measure> = Measure::named(Turning::model(), "tip.speed").into_iter().collect();
    let by = |omega: f64| {
        let turning = Turning { omega, l: 0.2 };
        let state = turning.solver().state(&Instant::at(0.0)).expect("it closes");
        turning.solver().measure_sensitivities(&state, &speed, &[0, 1]).expect("derivatives").remove(0)
    };
    for omega in [1.0_f64, -1e-6, 1e-170] {
        assert_eq!(vec![0.2 * omega.signum(), omega.abs()], by(omega), "{omega}");
    }
    let at_rest = by(0.0);
    assert!(at_rest[0].is_nan() && at_rest[1] == 0.0, "{at_rest:?}");
}

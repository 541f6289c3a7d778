//! Gradients of large quantities, whose squares overflow.

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

//! Velocity ratios of a driver of a distance are per length, not per its square.

use kin_runtime::{Instant, Kinematics, mechanism};

/// A carriage at height h whose distance from the origin is driven: x = √(f² − h²).
#[mechanism]
#[body(carriage, y = h, phi = 0)]
#[driver(drive: distance(ground @ (0, 0), carriage @ (0, 0)) = f0 + rate * t + 0.5 * t * t)]
#[guess(carriage.x = 1)]
struct Carriage {
    #[param(0.6)]
    h: f64,
    #[param(1.0)]
    f0: f64,
    #[param(-0.2)]
    rate: f64,
}

#[test]
fn ratios_of_a_driven_distance() {
    let carriage = Carriage::default();
    let state = carriage.state_at(&Instant::at(0.0)).unwrap();
    let x = 0.8;
    let (first, second) = (1.0 / x, (1.0 - 1.0 / (x * x)) / x);
    let ratios = carriage.solver().velocity_ratios(&state).unwrap();
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    near(state.q[0], x);
    near(ratios.drivers[0].first[0], first);
    near(ratios.drivers[0].second[0], second);
    near(ratios.drivers[0].q_dot[0], first * -0.2);
    near(ratios.drivers[0].q_ddot[0], first + second * 0.04);
    near(state.q_dot[0], first * -0.2);
    near(state.q_ddot[0], first + second * 0.04);
}

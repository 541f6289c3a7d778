//! Velocity ratios of driven distances are per length, although the row is in squares; those of an input include its
//! acceleration.

use kin_runtime::{Instant, Kinematics, Signal, mechanism};

/// A carriage at the height h whose distance from the origin is driven: x = √(f² − h²).
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

/// The same carriage on a rod whose length is a function of time: the row is in squares, its ratios are not.
#[mechanism]
#[body(carriage, y = 0.6, phi = 0)]
#[distance(rod: ground @ (0, 0), carriage @ (0, 0), length = 1 + 0.5 * t)]
#[guess(carriage.x = 1)]
struct Rod;

#[test]
fn ratios_of_a_distance_that_drives() {
    let state = Rod.state_at(&Instant::at(0.0)).unwrap();
    let ratios = Rod.solver().velocity_ratios(&state).unwrap();
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    // x² = f² − 0.36, hence k = f/x and l = (1 − k²)/x.
    let (first, second) = (1.25, -0.703125);
    near(state.q[0], 0.8);
    near(ratios.drivers[0].first[0], first);
    near(ratios.drivers[0].second[0], second);
    near(ratios.drivers[0].q_dot[0], 0.5 * first);
    near(ratios.drivers[0].q_ddot[0], 0.25 * second);
}

/// s is the square of an input.
#[mechanism]
#[input(u)]
#[coordinates(s)]
#[constraint(square: s = u * u)]
struct Square;

/// s̈ = 2 u̇² + 2 u ü; both terms belong to the ratios of the input.
#[test]
fn an_input_has_its_share_of_the_acceleration() {
    let inputs = [Signal::new(1.5, 2.0, 3.0)];
    let state = Square.state_at(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    let ratio = Square.solver().velocity_ratios(&state).unwrap()[Square::u].clone();
    assert_eq!((state.q_dot[0], state.q_ddot[0]), (6.0, 17.0));
    assert_eq!((ratio.first[0], ratio.second[0]), (3.0, 2.0));
    assert_eq!((ratio.q_dot[0], ratio.q_ddot[0]), (6.0, 17.0));
}

/// s t = 1 mixes the coordinate with time: s = 1/t, ṡ = −1/t², s̈ = 2/t³.
#[mechanism]
#[coordinates(s)]
#[constraint(product: s * t = 1)]
struct Product;

#[test]
fn a_row_that_mixes_a_coordinate_with_time_has_its_whole_share() {
    let state = Product.state_at(&Instant::at(2.0)).unwrap();
    let ratio = Product.solver().velocity_ratios(&state).unwrap().drivers[0].clone();
    assert_eq!((state.q_dot[0], state.q_ddot[0]), (-0.25, 0.25));
    assert_eq!((ratio.first[0], ratio.second[0]), (0.5, 0.0));
    assert_eq!((ratio.q_dot[0], ratio.q_ddot[0]), (-0.25, 0.25));
}

//! Forces of rows that prescribe motion in unusual ways, and of masses that are written in two ways.

use kin_runtime::{Instant, Kinematics, Signal, SolveError, mechanism};

/// A block that a row of velocity level pulls at a constant speed.
#[mechanism]
#[body(block, phi = 0)]
#[nonholonomic(pull: dot(block.x) = v)]
#[y(level: block @ (0, 0) = 0)]
#[force(drag: block @ (0, 0), (-5 * dot(block.x), 0))]
#[mass(block @ (0, 0), mass = 2)]
struct Pulled {
    #[param(0.4)]
    v: f64,
}

/// A row that prescribes a speed supplies power, also where it contains neither t nor an input.
#[test]
fn a_constant_speed_takes_power() {
    let pulled = Pulled::default();
    let motion = pulled.solver().sweep(&[0.0, 0.1]).unwrap();
    let forces = pulled.solver().forces(&motion.states[1]).unwrap();
    assert!((forces.effort("pull").unwrap() - 2.0).abs() < 1e-12, "{forces}");
    assert!((forces.driver_power - 0.8).abs() < 1e-12 && forces.power_miss() < 1e-12, "{forces}");
}

/// A cylinder whose length depends on another coordinate.
#[mechanism]
#[bodies(block)]
#[coordinates(s)]
#[input(u, w)]
#[translational(way: ground @ (0, 1), block @ (0, 0), axis = (1, 0))]
#[driver(lead: s = u)]
#[driver(follow: distance(ground @ (0, 0), block @ (0, 0)) = w + s*s)]
#[guess(block.x = 2, block.y = 1)]
#[mass(block @ (0, 0), mass = 3)]
struct Following;

/// A driven distance may depend on coordinates, with forces and velocity ratios as of any other driver.
#[test]
fn a_distance_may_depend_on_coordinates() {
    let inputs = [Signal::new(1.1, 0.7, 0.2), Signal::new(1.0, 0.4, -0.3)];
    let solver = Following.solver();
    let state = solver.state(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    // x² + 1 = f², f = w + u².
    let (f, f_u) = (1.0 + 1.1 * 1.1, 2.0 * 1.1);
    let x = (f * f - 1.0_f64).sqrt();
    assert!((state.q[0] - x).abs() < 1e-12);
    let ratios = solver.velocity_ratios(&state).unwrap();
    // x x″ + x′² = f f″ + f′².
    for (ratio, (f_1, f_2)) in ratios.drivers.iter().zip([(f_u, 2.0), (1.0, 0.0)]) {
        let first = f * f_1 / x;
        let second = (f * f_2 + f_1 * f_1 - first * first) / x;
        assert!((ratio.first[0] - first).abs() < 1e-12, "{ratio}");
        assert!((ratio.second[0] - second).abs() < 1e-12, "{ratio}");
    }
    let forces = solver.forces(&state).unwrap();
    let along = 3.0 * state.q_ddot[0] * f / x;
    assert!((forces.effort("follow").unwrap() - along).abs() < 1e-12, "{forces}");
    assert!((forces.effort("lead").unwrap() - along * f_u).abs() < 1e-12, "{forces}");
    assert!(forces.power_miss() < 1e-12, "{forces}");
}

/// Three links, of which the first has a mass of its own.
#[mechanism]
#[bodies(link[3])]
#[revolute(O: ground @ (0, 0), link[0] @ (0, 0))]
#[revolute(J[i in 0..2]: link[i] @ (1, 0), link[i+1] @ (0, 0))]
#[driver(D[i in 0..3]: link[i].phi = 0)]
#[mass(M[i in 1..3]: link[i] @ (0.5, 0), mass = 1)]
#[mass(link[0] @ (0.5, 0), mass = 2)]
#[gravity(0, -10)]
struct Links;

/// The place of a family's mass is compared with that of a single one for the members that the family has.
#[test]
fn one_member_may_have_another_mass() {
    let state = Links.state_at(&Instant::at(0.0)).unwrap();
    let forces = Links.solver().forces(&state).unwrap();
    assert_eq!(Some([0.0, 40.0]), forces.reaction("O").unwrap().force);
    assert!((forces.effort("D[0]").unwrap() - (20.0 * 0.5 + 20.0)).abs() < 1e-12, "{forces}");
}

/// A heavy arm on a motor, and a pointer that nothing turns.
#[mechanism]
#[bodies(heavy, pointer)]
#[revolute(O: ground @ (0, 0), heavy @ (0, 0))]
#[revolute(P: ground @ (2, 0), pointer @ (0, 0))]
#[driver(motor: heavy.phi = 0.3)]
#[mass(heavy @ (1, 0), mass = m)]
#[torque(load: pointer = 1)]
#[gravity(0, -9.81)]
struct Pointer {
    m: f64,
}

/// A small load that nothing holds is not overlooked beside large ones, and what holds it is accurate.
#[test]
fn small_loads_count_beside_large_ones() {
    for m in [1.0, 1e3, 1e6, 1e8] {
        let pointer = Pointer { m };
        let state = pointer.state_at(&Instant::at(0.0)).unwrap();
        let found = pointer.solver().forces(&state);
        assert!(matches!(found, Err(SolveError::NotHeld { open: 1, .. })), "m = {m}: {found:?}");
    }
    for m in [1.0, 1e8, 1e14] {
        let pointer = Pointer { m };
        let solver = pointer.solver().with_given(5, Signal::constant(0.2));
        let forces = solver.forces(&solver.state(&Instant::at(0.0)).unwrap()).unwrap();
        assert!((forces.effort("pointer.phi").unwrap() + 1.0).abs() < 1e-9, "m = {m}: {forces}");
    }
}

//! Where rows of velocity level contradict one another or lose rank, and events during the integration.

use super::*;
use kin_runtime::function::FromFn;

/// The front wheel is steered to 90°: there the rear axle cannot keep its speed.
#[mechanism]
#[bodies(car)]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (2, 0), angle = t)]
#[speed(engine: car @ (0, 0), value = 1)]
struct Turning;

/// ṡ = √(1 − t) has no derivative at t = 1 and no value beyond.
#[mechanism]
#[coordinates(s)]
#[nonholonomic(rate: dot(s) = sqrt(1 - t))]
struct Ending;

#[test]
fn motions_end_with_an_error() {
    let ended = Turning.kinematic_analysis(&[0.0, 1.0, 3.0]).unwrap_err();
    assert_eq!(ended.trajectory.len(), 2);
    match ended.source {
        SolveError::Singular { t, rank, expected_rank, .. } => {
            assert!((1.5..FRAC_PI_2 + 1e-6).contains(&t), "{t}");
            assert_eq!((rank, expected_rank), (2, 3));
        }
        SolveError::StepRefused { t, .. } => assert!((1.5..FRAC_PI_2 + 1e-6).contains(&t), "{t}"),
        other => panic!("{other}"),
    }
    let ended = Ending.kinematic_analysis(&[0.0, 0.5, 2.0]).unwrap_err();
    assert_eq!(ended.trajectory.len(), 2, "{ended}");
    assert!(!ended.to_string().is_empty());
}

#[test]
fn a_tolerance_out_of_reach_is_an_error() {
    let impossible = Options { integration_tolerance: 1e-300, ..Options::default() };
    let refused = SteeredCar::default().solver().with_options(impossible).sweep(&[0.0, 1.0]).unwrap_err();
    assert!(matches!(refused.source, SolveError::StepRefused { reason: Refusal::StepTooSmall, .. }), "{refused}");
    assert!(refused.to_string().contains("no step is short enough"), "{refused}");
}

/// With a looser tolerance the error is of the size of that tolerance.
#[test]
fn the_tolerance_is_kept() {
    let car = SteeredCar::default();
    let exact = car.kinematic_analysis(&[0.0, 20.0]).unwrap().states[1].q.clone();
    for tolerance in [1e-6, 1e-9] {
        let options = Options { integration_tolerance: tolerance, ..Options::default() };
        let found = car.solver().with_options(options).sweep(&[0.0, 20.0]).unwrap().states[1].q.clone();
        let error = exact.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 1e3 * tolerance && error > 1e-3 * tolerance, "{tolerance:e}: {error:e}");
    }
}

/// x = start + 0.1 sin 30 t.
#[mechanism]
#[coordinates(x)]
#[nonholonomic(sway: dot(x) = 3 * cos(30 * t))]
#[guess(x = start)]
struct Swaying {
    start: f64,
}

/// The tolerance is relative for large coordinates, so that their integration takes fewer steps.
#[test]
fn large_coordinates_are_known_relative_to_their_size() {
    let [small, large] = [0.0, 1e6].map(|start| {
        let swayed = Swaying { start }.kinematic_analysis(&[0.0, 10.0]).unwrap();
        let state = &swayed.states[1];
        let error = state.q[0] - start - 0.1 * 300.0_f64.sin();
        assert!(error.abs() < 1e-9 * f64::max(start, 1.0), "{error:e} beside {start:e}");
        state.iterations
    });
    assert!(4 * large < small, "{large} and {small} steps");
}

/// A driver that jumps at 0.5, which its derivatives do not show, together with a row of velocity level.
#[mechanism]
#[function(jump)]
#[coordinates(x, y)]
#[driver(place: x = jump(t))]
#[nonholonomic(roll: dot(y) = dot(x) + 1)]
struct Jumping<F> {
    jump: F,
}

/// The correction onto Φ = 0 may be as large as the integration error; a larger one would change the branch.
#[test]
fn no_correction_bridges_a_jump() {
    let jumping = |by: f64| Jumping { jump: FromFn(move |t: f64| [if t < 0.5 { 0.0 } else { by }, 0.0, 0.0]) };
    for by in [1e-3, 1.0] {
        let ended = jumping(by).kinematic_analysis(&[0.0, 0.4, 1.0]).unwrap_err();
        assert_eq!(ended.trajectory.len(), 2, "{by}");
        assert!(matches!(ended.source, SolveError::StepRefused { joint: "place", .. }), "{ended}");
    }
    assert!(jumping(0.0).kinematic_analysis(&[0.0, 0.4, 1.0]).is_ok());
}

/// Two unsteered axles: the body cannot turn.
#[mechanism(allow_redundant)]
#[bodies(cart)]
#[knife_edge(rear: cart @ (0, 0))]
#[knife_edge(front: cart @ (1, 0))]
#[driver(turn: cart.phi = t)]
#[speed(engine: cart @ (0, 0), value = 1)]
struct Cart;

#[test]
fn rows_that_contradict_one_another_are_inconsistent() {
    let refused = Cart.kinematic_analysis(&[0.0, 1.0]).unwrap_err();
    assert!(refused.trajectory.is_empty());
    assert!(matches!(refused.source, SolveError::InconsistentVelocity { .. }), "{refused}");
    let mobility = Cart.mobility(&Instant::at(0.0), &[0.0; 3]).unwrap();
    assert_eq!(mobility.rank, 3);
    assert!(!mobility.redundant[0].consistent, "{mobility}");
}

/// A car whose front wheels are steered by an input.
#[mechanism]
#[bodies(car)]
#[input(w)]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (2, 0), angle = w)]
#[speed(engine: car @ (0, 0), value = 1.5)]
struct Turned;

/// With wheels at 90° to the car no velocity exists. cos(π/2) is 6e-17 in floating point and must not be used as a
/// pivot.
#[test]
fn wheels_across_the_car_are_singular() {
    let with = |w: f64| [Signal::constant(w)];
    for phi in [0.0, 0.3, -2.0] {
        let q = [0.4, -1.0, phi];
        let inputs = with(FRAC_PI_2);
        let at = Instant { t: 0.0, inputs: &inputs };
        for error in [
            Turned.velocity_analysis(&at, &q).unwrap_err(),
            Turned.solver().state_from(&at, &q).unwrap_err(),
            Turned.state_at(&at).unwrap_err(),
        ] {
            let SolveError::Singular { rank: 2, expected_rank: 3, ref rows, condition, .. } = error else {
                panic!("{error}")
            };
            assert!(condition > 1e10, "{error}");
            assert!(rows.contains(&"front") && rows.contains(&"engine"), "{error}");
        }
        for error in [1e-9, 1e-6] {
            let inputs = with(FRAC_PI_2 - error);
            let at = Instant { t: 0.0, inputs: &inputs };
            match Turned.velocity_analysis(&at, &q) {
                Ok(q_dot) => close("turning", 0.75 * inputs[0].value.tan(), q_dot[2], 1e-6 * q_dot[2].abs()),
                Err(error) => assert!(matches!(error, SolveError::Singular { .. }), "{error}"),
            }
            let condition = Turned.mobility(&at, &q).unwrap().condition;
            assert!(condition > 1e-4 / error, "{condition:e} at {error:e}");
        }
        let inputs = with(0.4);
        let at = Instant { t: 0.0, inputs: &inputs };
        close("turning", 0.75 * 0.4_f64.tan(), Turned.velocity_analysis(&at, &q).unwrap()[2], 1e-14);
    }
    // An inconsistency that does not depend on the steering is still an error.
    assert!(matches!(Cart.state_at(&Instant::at(0.0)), Err(SolveError::InconsistentVelocity { .. })));
}

/// The driven wheels of a robot: both sides roll without slipping.
#[mechanism]
#[bodies(robot)]
#[coordinates(left, right)]
#[knife_edge(axle: robot @ (0, 0))]
#[nonholonomic(roll[i in 0..2]: dot(robot.x) * cos(robot.phi) + dot(robot.y) * sin(robot.phi) + (2 * i - 1) * half * dot(robot.phi) = radius * ((1 - i) * dot(left) + i * dot(right)))]
#[driver(turn_left: left = 2 * t)]
#[driver(turn_right: right = 3 * t)]
#[point(side = robot @ (0, -half))]
struct Robot {
    #[param(0.15)]
    half: f64,
    #[param(0.05)]
    radius: f64,
}

#[test]
fn two_driven_wheels_turn_a_robot() {
    let robot = Robot::default();
    let names: Vec<&str> = Robot::model().rows.iter().map(|row| row.name).collect();
    assert_eq!(names, ["axle", "roll[0]", "roll[1]", "turn_left", "turn_right"]);
    for state in &robot.kinematic_analysis(&grid(0.0, 9.0, 3)).unwrap() {
        let rate = robot.radius * (3.0 - 2.0) / (2.0 * robot.half);
        let radius = robot.radius * 2.5 / rate;
        close("phi", rate * state.t, state.q[2], PATH);
        close("x", radius * (rate * state.t).sin(), state.q[0], PATH);
        close("y", radius * (1.0 - (rate * state.t).cos()), state.q[1], PATH);
        let v = robot.solver().motion(state).unwrap().points[0].v;
        close("speed of the right wheel", robot.radius * 3.0, v[0].hypot(v[1]), 1e-12);
    }
}

/// The crossing of a line by a car that drives a circle, with its instant known exactly.
#[mechanism]
#[bodies(car)]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (2.5, 0), angle = 0.4)]
#[speed(engine: car @ (0, 0), value = 1.5)]
#[unilateral(wall: car.y < 3)]
struct CarAndWall;

#[test]
fn events_are_located_on_an_integrated_motion() {
    let trajectory = CarAndWall.kinematic_analysis(&[0.0, 6.0]).unwrap();
    let radius: f64 = 2.5 / 0.4_f64.tan();
    let expected = (1.0 - 3.0 / radius).acos() * radius / 1.5;
    let event = &trajectory.events[0];
    close("time", expected, event.t, 1e-10);
    close("y", 3.0, event.state.q[1], 1e-10);
}

/// A car on a straight line whose speed grows with t.
#[mechanism]
#[bodies(car)]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (2.5, 0), angle = 0)]
#[speed(engine: car @ (0, 0), value = 1 + 0.3 * t)]
struct Endless;

/// The way over 1e300 seconds is no number.
#[test]
fn a_way_that_overflows_is_an_error() {
    for times in [[1e300, 0.0], [0.0, 1e300]] {
        let error = Endless.kinematic_analysis(&times).expect_err("the way is no number");
        assert!(error.trajectory.states.iter().all(|state| state.q.iter().all(|x| x.is_finite())), "{times:?}");
    }
}

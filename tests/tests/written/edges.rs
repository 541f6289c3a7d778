//! Extreme cases of solutions: guesses that are far away, late instants, and rows that vanish completely.

use kin_runtime::{Instant, Kinematics, Mechanism, Planned, Refusal, Signal, SolveError, mechanism};

#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 3 * t)]
#[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = 0.9)]
struct SliderCrank;

#[mechanism]
#[coordinates(u)]
#[constraint(square: u * u = t)]
#[guess(u = 1)]
struct Square;

#[mechanism]
#[coordinates(u)]
#[constraint(sine: sin(u) = t)]
struct Sine;

/// The guess of a driven angle is for one instant, but the driver determines the angle at every instant.
#[test]
fn a_guess_does_not_hold_back_a_driven_angle() {
    for t in [0.0, 10.0, 100.0, -200.0, 1e6] {
        let state = SliderCrank.state_at(&Instant::at(t)).unwrap();
        let phi = 3.0 * t;
        let x = 0.2 * phi.cos() + (0.7_f64.powi(2) - (0.2 * phi.sin()).powi(2)).sqrt();
        assert_eq!(phi, state.q[2]);
        assert!((state.q[6] - x).abs() < 1e-10, "t = {t}: {} instead of {x}", state.q[6]);
    }
}

/// Joints must close even if rounding in a far coordinate prevents it: this is an error.
#[test]
fn a_coordinate_that_rounds_to_turns_closes_nothing() {
    let solver = SliderCrank.solver().with_guess(5, 1e18);
    match solver.state(&Instant::at(0.0)) {
        Ok(state) => {
            let closed = SliderCrank.constraints(&Instant::at(0.0), &state.q).unwrap();
            assert!(closed.iter().all(|r| r.abs() < 1e-9), "{closed:?}");
        }
        Err(error) => assert!(matches!(error, SolveError::NotAssembled { .. }), "{error}"),
    }
}

/// A single vanishing row is reported as singular.
#[test]
fn a_single_row_can_be_singular() {
    let at = |result: Result<kin_runtime::State, SolveError>| match result {
        Err(SolveError::Singular { rank, expected_rank, condition, .. }) if condition > 1e7 => (rank, expected_rank),
        other => panic!("{other:?}"),
    };
    assert_eq!((0, 1), at(Square.state_at(&Instant::at(0.0))));
    assert_eq!((0, 1), at(Sine.state_at(&Instant::at(1.0))));
    for t in [1e-6, 0.25, 100.0] {
        let state = Square.state_at(&Instant::at(t)).unwrap();
        assert!((state.q_dot[0] - 0.5 / t.sqrt()).abs() < 1e-9 * state.q_dot[0]);
    }
}

/// A distance has no rate where its points coincide; the error names the quantity.
#[test]
fn what_has_no_rate_is_named() {
    #[mechanism]
    #[coordinates(u)]
    #[define(gap = sqrt(u * u))]
    #[driver(drive: u = t)]
    struct Meeting;
    let solver = Meeting.solver();
    let state = solver.state(&Instant::at(0.0)).unwrap();
    match solver.motion(&state) {
        Err(SolveError::NonFinite { name, .. }) => assert_eq!("gap", name),
        other => panic!("{other:?}"),
    }
}

/// The length of a cylinder by the law of cosines, without a guess, in metres and in millimetres.
#[test]
fn scalar_coordinates_have_no_unit() {
    #[mechanism]
    #[coordinates(s, f)]
    #[constraint(cosines: s * s = a * a + b * b - 2 * a * b * cos(f))]
    #[driver(drive: f = 1 + t)]
    struct Cylinder {
        a: f64,
        b: f64,
    }
    let expected = (0.49 + 0.81 - 1.26 * 1.0_f64.cos()).sqrt();
    for unit in [1e-3, 1.0, 1e3, 1e6] {
        let state = Cylinder { a: 0.7 * unit, b: 0.9 * unit }.state_at(&Instant::at(0.0)).unwrap();
        assert!((state.q[0].abs() / unit - expected).abs() < 1e-10, "{unit}: {:?}", state.q);
    }
}

/// A slider at the end of its stroke, where the guess does not determine in which direction the crank continues.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[coordinates(s)]
#[constraint(c: s = r * cos(crank.phi))]
#[driver(d: s = r - t)]
#[guess(crank.phi = 0, s = r)]
struct EndOfStroke {
    #[param(0.2)]
    r: f64,
}

/// A lift whose height is an input.
#[mechanism]
#[body(table, x = 0, phi = 0)]
#[input(u)]
#[driver(lift: table.y = u)]
struct Measured;

#[test]
fn what_is_guessed_is_not_varied_and_the_error_says_so() {
    let mechanism = EndOfStroke::default();
    let error = mechanism.state_at(&Instant::at(0.05)).unwrap_err();
    assert!(matches!(error, SolveError::NotAssembled { all_guessed: true, .. }), "{error}");
    assert!(
        error
            .to_string()
            .ends_with("every coordinate has a guess, so no others were tried: change a guess, or leave some out")
    );
    for angle in [0.1, -0.1] {
        let state = mechanism.solver().with_guess(0, angle).state(&Instant::at(0.05)).unwrap();
        assert!((state.q[0] - 0.75_f64.acos().copysign(angle)).abs() < 1e-12);
    }
}

#[test]
fn a_sweep_without_inputs_names_where_they_come_from() {
    let error = Measured.solver().sweep(&[0.0, 1.0]).unwrap_err().to_string();
    assert!(
        error.contains("inputs has 0 entries and must have 1") && error.contains("`Solver::with_inputs`"),
        "{error}"
    );
    // The state of the first instant is valid; there is none at t = 1.
    let ends = |t: f64, u: &mut [Signal]| u[0] = Signal::constant(if t > 0.5 { f64::NAN } else { 1.0 });
    let error = Measured.solver().with_inputs(&ends).sweep(&[0.0, 1.0]).unwrap_err().to_string();
    assert!(error.ends_with("(after 1 good instant)"), "{error}");
}

/// A plate on three links, which is solved by an iteration over two lengths and an angle.
#[mechanism]
#[bodies(crank, plate)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = 0.2 + t)]
#[distance(first: crank @ (0.2 * u, 0), plate @ (0, 0), length = 0.5 * u)]
#[distance(second: ground @ (0.8 * u, 0), plate @ (0.1 * u, 0.3 * u), length = 0.6 * u)]
#[distance(third: ground @ (0, 0.9 * u), plate @ (0.3 * u, 0), length = 0.6 * u)]
#[guess(plate.x = 0.4 * u, plate.y = 0.4 * u, plate.phi = 0.1)]
struct Plate {
    u: f64,
}

/// A follower that an iteration solves for its height, which passes through 0.
#[mechanism]
#[body(cam, x = 0, y = -u)]
#[body(follower, x = 0, phi = 0)]
#[on_curve(contact: cam @ (0, 0), follower @ (0, 0), polar(theta) = u * (1 + 0.3 * cos(theta)))]
#[driver(turn: cam.phi = t)]
#[guess(follower.y = 0.1 * u)]
struct Follower {
    u: f64,
}

/// The plan does not depend on units: margins and the number of correct digits of iterations are the same.
#[test]
fn iterations_of_a_plan_are_the_same_in_all_units() {
    let steps = |q: &[f64], k: usize, unit: f64| q[k] / unit;
    let mut plates = Vec::new();
    for u in [1.0, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9] {
        let plate = Plate { u };
        let at = Instant::at(0.0);
        let mut planned = Planned::new(&plate, &at, &plate.state_at(&at).unwrap().q).unwrap();
        let mut found = Vec::new();
        for k in 1..=20 {
            planned.at(&Instant::at(0.1 * f64::from(k))).unwrap();
            let (q, margins) = (planned.q(), planned.margins());
            found.extend([steps(q, 3, u), steps(q, 4, u), q[5], margins[0]]);
        }
        plates.push(found);

        let follower = Follower { u };
        let mut planned = Planned::new(&follower, &at, &follower.state_at(&at).unwrap().q).unwrap();
        for k in 0..=63 {
            let t = 0.1 * f64::from(k);
            let lift = planned.at(&Instant::at(t)).unwrap().q()[1] / u;
            assert!((lift - 0.3 * t.sin()).abs() < 1e-14, "u = {u}, t = {t}: {lift}");
        }
    }
    let closest = plates[0].iter().skip(3).step_by(4).copied().fold(1.0, f64::min);
    assert!(closest > 1e-4, "{closest}");
    for plate in &plates[1..] {
        assert_near(plate, &plates[0], 1e-11);
    }
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64], bound: f64) {
    let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(found.len() == expected.len() && worst < bound, "{worst:e}");
}

/// Where the spacing of floating-point numbers near t exceeds a step of the motion, the error says so, and mentions
/// neither branches nor velocities.
#[test]
fn a_time_too_large_for_the_motion_is_told_so() {
    for (from, to) in [(1e17, 1e18), (1e17, 1e17 + 16.0), (1e15, 1e15 + 10.0), (-1e16, -1e15)] {
        assert!(SliderCrank.state_at(&Instant::at(from)).is_ok());
        let refused = SliderCrank.solver().sweep(&[from, to]).unwrap_err();
        let reason = |error: &SolveError| match *error {
            SolveError::StepRefused { reason, .. } => Some(reason),
            _ => None,
        };
        assert_eq!(reason(&refused.source), Some(Refusal::TimeTooCoarse), "{from:e}: {refused}");
        assert!(refused.to_string().contains("neighbouring floating-point numbers are"), "{refused}");
        assert_eq!(refused.trajectory.len(), 1);
    }
    // The end of a branch is reported as such even at late times.
    let refused = Square.solver().sweep(&[1e9, -1.0]).unwrap_err();
    assert!(!refused.to_string().contains("neighbouring floating-point numbers are"), "{refused}");
}

/// The direction from (x1, y1) to (x2, y2), and the same beside the opposite difference, with which it shares a value.
mod directions {
    use super::*;

    #[mechanism]
    #[body(crank, x = 0, y = 0)]
    #[driver(drive: crank.phi = atan2(y2 - y1, x2 - x1))]
    pub(super) struct Alone {
        pub x1: f64,
        pub y1: f64,
        pub x2: f64,
        pub y2: f64,
    }

    #[mechanism]
    #[body(crank, x = 0, y = 0)]
    #[define(opposite = y1 - y2)]
    #[define(direction = atan2(-opposite, x2 - x1))]
    #[driver(drive: crank.phi = atan2(y2 - y1, x2 - x1))]
    pub(super) struct Beside {
        pub x1: f64,
        pub y1: f64,
        pub x2: f64,
        pub y2: f64,
    }
}

/// On its cut `atan2` is π, whatever sign a zero has with which it was computed.
#[test]
fn atan2_of_a_zero_is_half_a_turn_whatever_its_sign() {
    use core::f64::consts::PI;
    for (y1, y2) in [(0.5, 0.5), (0.0, -0.0), (-0.0, 0.0), (0.0, 0.0)] {
        let alone = directions::Alone { x1: 1.0, y1, x2: 0.0, y2 };
        assert_eq!(alone.state_at(&Instant::at(0.0)).unwrap().q, [PI], "{y1}, {y2}");
        let beside = directions::Beside { x1: 1.0, y1, x2: 0.0, y2 };
        let state = beside.state_at(&Instant::at(0.0)).unwrap();
        assert_eq!(state.q, [PI], "{y1}, {y2}");
        let motion = beside.solver().motion(&state).unwrap();
        assert_eq!(motion.defines[1].value, PI, "{y1}, {y2}");
    }
}

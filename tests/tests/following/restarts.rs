//! Analyses of a state that was reached: restarts of trackers, prescribed coordinates, ratios, modes that were requested.

use kin_runtime::{Instant, Kinematics, Options, PlanError, Planned, Signal, SolveError, mechanism};
use kin_tests::random::Random;

/// A four-bar.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1 * s, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b * s, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (0.3 * s, 0), ground @ (d * s, 0))]
#[driver(drive: crank.phi = t)]
#[guess(coupler.phi = acos(g), rocker.phi = 5.0)]
struct FourBar {
    #[param(0.4)]
    b: f64,
    #[param(0.35)]
    d: f64,
    #[param(1.0)]
    s: f64,
    #[param(0.6)]
    g: f64,
}

/// Two arms on a rod of prescribed length.
#[mechanism]
#[bodies(crank, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(D: ground @ (s, 0), rocker @ (0, 0))]
#[distance(rod: crank @ (0.4 * s, 0), rocker @ (0.6 * s, 0), length = 0.8 * s)]
#[driver(drive: crank.phi = t)]
#[guess(rocker.phi = 1.2)]
struct Rods {
    #[param(1.0)]
    s: f64,
}

/// A trammel whose only dimension is the length of its rod.
#[mechanism]
#[body(a, y = 0, phi = 0)]
#[body(b, x = 0, phi = 0)]
#[distance(rod: a @ (0, 0), b @ (0, 0), length = s)]
#[guess(a.x = 0.9 * s, b.y = 0.5 * s)]
struct Trammel {
    #[param(1.0)]
    s: f64,
}

/// An arm without a driver.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
struct Arm;

/// An arm with a point that no row contains.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(motor: arm.phi = t)]
#[point(tip = arm @ (l, 0))]
struct Pointer {
    #[param(1.0)]
    l: f64,
}

#[test]
fn a_tracker_restarts_on_the_branch_on_which_it_would_begin() {
    let (mut random, four_bar) = (Random::new(71), FourBar::default());
    for _ in 0..300 {
        let at = Instant::at(random.between(0.0, 6.0));
        let solver =
            four_bar.solver().with_guess(5, random.between(-3.0, 3.0)).with_guess(8, random.between(-3.0, 3.0));
        let expected = solver.state(&at).expect("it closes");
        let mut tracker = solver.tracker(&at).expect("it closes");
        assert_eq!(expected.q, tracker.state().q);
        assert_eq!(expected.q, tracker.restart(&at).expect("it closes").q);
        let start: Vec<f64> = expected.q.iter().map(|q| q + random.between(-1.0, 1.0)).collect();
        let from = |found: Result<Vec<f64>, SolveError>| found.map_err(|error| error.to_string());
        let expected = from(solver.state_from(&at, &start).map(|state| state.q));
        assert_eq!(expected, from(solver.tracker_from(&at, &start).map(|tracker| tracker.state().q.clone())));
        assert_eq!(expected, from(tracker.restart_from(&at, &start).map(|state| state.q.clone())));
    }
}

#[test]
fn the_ratios_of_a_tracker_do_not_depend_on_the_unit_of_length() {
    let at = Instant::at(0.3);
    let ratio = |s: f64| {
        let rods = Rods { s };
        let mut tracker = rods.solver().tracker(&at).expect("it closes");
        let ratios = tracker.velocity_ratios().expect("it is regular");
        tracker.update(&Instant::at(0.4)).expect("it goes on");
        ratios.drivers[0].first[5]
    };
    let expected = ratio(1.0);
    for s in [1e-6, 1e-5, 1e-4, 1e-3, 1e3, 1e5, 1e6] {
        assert!((ratio(s) - expected).abs() < 1e-13, "{s:e}: {} {expected}", ratio(s));
    }
}

#[test]
fn a_length_alone_shows_how_large_a_mechanism_is() {
    for s in [1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9] {
        let trammel = Trammel { s };
        for k in 1..60 {
            let x = (0.025 * f64::from(k)).cos();
            let state = trammel.solver().with_given(0, Signal::constant(s * x)).state(&0.0.into()).expect("it closes");
            let expected = s * (1.0 - x * x).sqrt();
            assert!((state.q[1] / expected - 1.0).abs() < 1e-11, "{s:e}, {x}: {} {expected}", state.q[1]);
        }
    }
}

/// The signal belongs to the first instant of the sweep: φ = 0.1 + t + t².
#[test]
fn a_prescribed_coordinate_is_that_of_the_state() {
    let solver = Arm.solver().with_given(2, Signal::new(0.1, 1.0, 2.0));
    let trajectory = solver.sweep(&[0.0, 0.5, 1.0]).expect("it turns");
    for state in trajectory.states {
        let rate = 1.0 + 2.0 * state.t;
        let share = solver.velocity_ratios(&state).expect("it is regular").drivers[0].q_dot[2];
        assert!((share - rate).abs() < 1e-14, "{}: {share} {rate}", state.t);
        let certificate = solver.certify(&state).expect("it is a solution");
        assert!(certificate.covers(&state.q));
        assert_eq!(2.0, solver.derivatives(&state, 2).expect("they are known").q[2][2]);
    }
}

#[test]
fn a_request_that_is_taken_back_changes_nothing() {
    let four_bar = FourBar::default();
    let at = |undone: bool| {
        let mut planned = four_bar.solver().planned(&Instant::at(0.0)).expect("it closes");
        planned.at(&Instant::at(3.0)).expect("it turns");
        let mode = planned.mode(0).expect("it has one");
        if undone {
            planned.set_mode(0, mode.flipped()).expect("it exists");
            planned.set_mode(0, mode).expect("it exists");
        }
        planned.at(&Instant::at(40.0)).expect("it turns").q().to_vec()
    };
    assert_eq!(at(false), at(true));
}

#[test]
fn a_motion_may_take_as_many_steps_as_are_allowed() {
    let four_bar = FourBar::default();
    let solver = |max_steps| four_bar.solver().with_options(Options { max_steps, ..Options::default() });
    let times = |end: f64| [0.0, end];
    assert_eq!(2, solver(1).sweep(&times(0.05)).expect("one step suffices").len());
    let needed = (1..100).find(|&most| solver(most).sweep(&times(3.0)).is_ok()).expect("a hundred suffice");
    assert!(needed > 1 && solver(needed + 1).sweep(&times(3.0)).is_ok());
}

#[test]
fn a_guess_that_is_not_a_number_is_an_error_with_the_plan_and_without() {
    let four_bar = FourBar { g: 2.0, ..FourBar::default() };
    for use_plan in [true, false] {
        let solver = four_bar.solver().with_options(Options { use_plan, ..Options::default() });
        let refused = solver.state(&0.0.into());
        assert!(matches!(refused, Err(SolveError::NonFinite { what: "guess", .. })), "{use_plan}: {refused:?}");
    }
}

#[test]
fn a_parameter_that_is_not_a_number_is_named_even_if_no_row_contains_it() {
    let pointer = Pointer { l: f64::NAN };
    let refused = Planned::new(&pointer, &Instant::at(0.0), &[0.0; 3]).map(|_| ());
    assert!(matches!(refused, Err(PlanError::NonFinite { what: "parameters", name: "l", .. })), "{refused:?}");
}

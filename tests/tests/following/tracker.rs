//! The tracker compared with sweeps, along its branch to the end of the range and back.

use kin_runtime::{
    GeometryFault, Instant, Kinematics, LengthError, Mechanism, Options, Refusal, Signal, SolveError, State, Tracker,
    mechanism,
};
use kin_tests::compare::{Differences, assert_shows, largest};
use kin_tests::mechanisms::{
    DrivenLeg, Excavator, FiveBarLeg, MeasuredExcavator, RateTable, SignalTable, signals, write_signals,
};

/// Instants from `from` to `to`, unevenly spaced.
fn uneven(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|k| f64::from(k) / f64::from(count)).map(|x| from + (to - from) * x * (0.4 + 0.6 * x)).collect()
}

fn same(differences: &mut Differences, names: fn(usize) -> &'static str, a: &State, b: &State, tolerance: f64) {
    for (what, a, b) in [("q", &a.q, &b.q), ("q_dot", &a.q_dot, &b.q_dot), ("q_ddot", &a.q_ddot, &b.q_ddot)] {
        differences.vector(what, names, a, b, tolerance * largest(a).max(1.0));
    }
}

fn name<M: Mechanism>(place: usize) -> &'static str {
    M::model().coordinates[place].name
}

/// The poses in the tracker's state are consistent with its q, q̇ and q̈, however the state was reached.
fn shows_its_motion(tracker: &mut Tracker<'_>) {
    let motion = tracker.motion().unwrap();
    assert_shows(tracker.state(), &motion);
}

/// The states of the tracker are those of a sweep with the inputs as functions of time.
fn follows_the_sweep<M: Kinematics + Default>(count: u32) {
    let mechanism = M::default();
    let times = uneven(0.0, 1.9, count);
    let swept = mechanism.solver().with_inputs(&write_signals::<M>).sweep(&times).unwrap();
    let mut tracker = mechanism.solver().tracker(&swept.states[0].instant()).unwrap();
    let mut differences = Differences::new();
    for state in &swept.states {
        differences.at(format_args!("t = {}", state.t));
        let tracked = tracker.update(&state.instant()).unwrap();
        assert_eq!((state.t, &state.inputs), (tracked.t, &tracked.inputs));
        assert!(tracked.residual <= 1e-12);
        same(&mut differences, name::<M>, state, tracked, 1e-10);
        shows_its_motion(&mut tracker);
        // The same input values at the same time with other rates: the configuration is unchanged.
        let rested: Vec<Signal> = state.inputs.iter().map(|input| Signal::constant(input.value)).collect();
        tracker.update(&Instant { t: state.t, inputs: &rested }).unwrap();
        shows_its_motion(&mut tracker);
        tracker.update(&state.instant()).unwrap();
    }
    differences.finish();
}

#[test]
fn tracked_instants_are_those_of_a_sweep() {
    for count in [3, 30, 200] {
        follows_the_sweep::<MeasuredExcavator>(count);
        follows_the_sweep::<FiveBarLeg>(count);
        follows_the_sweep::<SignalTable>(count);
        follows_the_sweep::<Excavator>(count);
    }
}

/// Rows of velocity level are integrated from update to update along interpolated inputs.
#[test]
fn rows_of_velocity_level_are_integrated() {
    let table = RateTable::default();
    let times = uneven(0.0, 1.0, 60);
    let swept = table.solver().with_inputs(&write_signals::<RateTable>).sweep(&times).unwrap();
    let mut tracker = table.solver().tracker(&swept.states[0].instant()).unwrap();
    let mut differences = Differences::new();
    for state in &swept.states {
        differences.at(format_args!("t = {}", state.t));
        same(&mut differences, name::<RateTable>, state, tracker.update(&state.instant()).unwrap(), 1e-8);
    }
    differences.finish();

    // Forth and back along straight lines in the inputs at constant time: a knife edge retraces its path.
    let at = |share: f64| {
        signals::<RateTable>(0.0)
            .into_iter()
            .zip(signals::<RateTable>(0.3))
            .map(move |(a, b)| Signal::constant(a.value + share * (b.value - a.value)))
    };
    let mut tracker = table.solver().tracker(&Instant { t: 0.0, inputs: &at(0.0).collect::<Vec<_>>() }).unwrap();
    let start = tracker.state().q.clone();
    for share in [0.4, 1.0, 0.0] {
        tracker.update(&Instant { t: 0.0, inputs: &at(share).collect::<Vec<_>>() }).unwrap();
        let moved = largest(&start.iter().zip(&tracker.state().q).map(|(a, b)| a - b).collect::<Vec<_>>());
        assert!(if share == 0.0 { moved < 1e-9 } else { moved > 1e-3 }, "{moved:e} at {share}");
    }
}

/// An input-driven mechanism moves as the same mechanism driven by functions of time.
fn twins<A: Kinematics + Default, B: Kinematics + Default>() {
    assert_eq!(0, B::INPUTS);
    let times = uneven(0.0, 1.9, 30);
    let (measured, driven) = (A::default(), B::default());
    let measured = measured.solver().with_inputs(&write_signals::<A>).sweep(&times).unwrap();
    let driven = driven.kinematic_analysis(&times).unwrap();
    let mut differences = Differences::new();
    for (a, b) in measured.states.iter().zip(&driven.states) {
        differences.at(format_args!("t = {}", a.t));
        same(&mut differences, name::<B>, b, a, 1e-11);
    }
    differences.finish();
}

#[test]
fn inputs_drive_like_functions_of_time() {
    twins::<MeasuredExcavator, Excavator>();
    twins::<FiveBarLeg, DrivenLeg>();
}

/// Without rates, backwards, and at constant time the tracker reaches the same configurations.
#[test]
fn only_the_values_decide_where_it_goes() {
    fn goes<M: Kinematics + Default>() {
        let mechanism = M::default();
        let times = uneven(0.0, 1.9, 25);
        let swept = mechanism.solver().with_inputs(&write_signals::<M>).sweep(&times).unwrap();
        let mut differences = Differences::new();
        let mut tracker = mechanism.solver().tracker(&swept.states[0].instant()).unwrap();
        for state in swept.states.iter().chain(swept.states.iter().rev()) {
            let still: Vec<_> = state.inputs.iter().map(|u| Signal::constant(u.value)).collect();
            let tracked = tracker.update(&Instant { t: state.t, inputs: &still }).unwrap();
            differences.at(format_args!("without rates, t = {}", state.t));
            differences.vector("q", name::<M>, &state.q, &tracked.q, 1e-10 * largest(&state.q).max(1.0));
            differences.number("rate", 0.0, largest(&tracked.q_dot) * f64::from(u8::from(!moves::<M>())), 1e-12);
            // The same instant again, now with rates and accelerations: neither time nor a value changes.
            let tracked = tracker.update(&state.instant()).unwrap();
            differences.at(format_args!("with rates, t = {}", state.t));
            same(&mut differences, name::<M>, state, tracked, 1e-10);
        }
        differences.finish();
    }
    goes::<MeasuredExcavator>();
    goes::<FiveBarLeg>();
    goes::<SignalTable>();
}

/// True for a mechanism with rows that depend on time.
fn moves<M: Mechanism>() -> bool {
    M::model().name == "SignalTable"
}

/// At constant time, with large changes of the inputs.
#[test]
fn inputs_change_while_time_stands_still() {
    let leg = FiveBarLeg::default();
    let swept = leg.solver().with_inputs(&write_signals::<FiveBarLeg>).sweep(&uneven(0.0, 1.9, 7)).unwrap();
    let mut tracker = leg.solver().tracker(&swept.states[0].instant()).unwrap();
    let mut differences = Differences::new();
    for (place, state) in swept.states.iter().enumerate() {
        differences.at(place);
        let tracked = tracker.update(&Instant { t: 0.0, inputs: &state.inputs }).unwrap();
        assert_eq!(0.0, tracked.t);
        // Time is not used in this mechanism, so that the rates are those of the sweep, too.
        same(&mut differences, name::<FiveBarLeg>, state, tracked, 1e-10);
    }
    differences.finish();

    // This one depends on time, which stays at 0.7.
    let table = SignalTable;
    let inputs = |t| signals::<SignalTable>(t);
    let mut tracker = table.solver().tracker(&Instant { t: 0.7, inputs: &inputs(0.0) }).unwrap();
    let mut differences = Differences::new();
    for place in [0.6, 1.3, 0.2] {
        let at = Instant { t: 0.7, inputs: &inputs(place) };
        let tracked = tracker.update(&at).unwrap().clone();
        let alone = table.solver().state_from(&at, &tracked.q).unwrap();
        differences.at(place);
        same(&mut differences, name::<SignalTable>, &alone, &tracked, 1e-11);
    }
    differences.finish();
}

/// A rocker on a hydraulic cylinder: it turns between the shortest and the longest length of the cylinder, in two
/// modes.
#[mechanism]
#[bodies(rocker)]
#[input(cylinder)]
#[revolute(pin: ground @ (0, 0), rocker @ (0, 0))]
#[distance(ram: ground @ (1, 0), rocker @ (arm, 0), length = cylinder)]
#[guess(rocker.phi = 1.2)]
#[derive(Clone)]
struct Rocker {
    #[param(0.5)]
    arm: f64,
}

/// The rocker's angle by the law of cosines, in the mode of the guess.
fn angle(cylinder: f64) -> f64 {
    ((1.0 + 0.25 - cylinder * cylinder) / 1.0).acos()
}

fn at(tracker: &mut Tracker<'_>, t: f64, cylinder: Signal) -> Result<f64, SolveError> {
    tracker.update(&Instant { t, inputs: &[cylinder] }).map(|state| state.q[2])
}

/// Repeatedly to the dead centre at 1.5 and back: the mode never changes.
#[test]
fn the_branch_is_never_left() {
    let rocker = Rocker::default();
    for overshoot in [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.2] {
        let first = Instant { t: 0.0, inputs: &[Signal::constant(1.0)] };
        let mut tracker = rocker.solver().tracker(&first).unwrap();
        let mut refused = 0;
        for k in 1..=400 {
            let t = 0.01 * f64::from(k);
            // Between 0.9 and slightly beyond the dead centre.
            let (sin, cos) = (3.0 * t).sin_cos();
            let reach = 0.3 + 0.5 * overshoot;
            let u = Signal::new(1.2 + reach * sin, 3.0 * reach * cos, -9.0 * reach * sin);
            let before = tracker.state().clone();
            match at(&mut tracker, t, u) {
                Ok(phi) => assert!((phi - angle(u.value)).abs() < 1e-6, "{phi} at {}, overshoot {overshoot}", u.value),
                Err(SolveError::Singular { .. } | SolveError::StepRefused { .. }) => {
                    assert!(u.value > 1.5 - 1e-3, "refused at {}", u.value);
                    assert_eq!(&before, tracker.state());
                    refused += 1;
                }
                Err(error) => panic!("{error}"),
            }
        }
        assert_eq!(overshoot > 1e-4, refused > 0, "overshoot {overshoot}: {refused} refused");
        assert!(refused < 200);
    }
}

/// Where the quintic interpolation of the input overshoots the dead centre, the tracker takes the straight line, and
/// its fallbacks are those on the line.
#[test]
fn fallbacks_are_those_of_the_way_that_was_taken() {
    let rocker = Rocker::default();
    let mut straight = 0;
    for (short, k) in (1..=12).flat_map(|k| [(1e-3, k), (1e-2, k)]) {
        let (end, change) = (1.5 - short, 0.04 * f64::from(k));
        let first = Instant { t: 0.0, inputs: &[Signal::new(end - change, 1.2 * change, 0.0)] };
        // Returning from beyond the end value, with the largest rates and accelerations that the interpolation accepts.
        let swinging = Signal::new(end, -change, -3.6 * change);
        let still = Instant { t: 0.0, inputs: &[Signal::constant(end - change)] };
        let mut one = rocker.solver().tracker(&first).unwrap();
        let mut other = rocker.solver().tracker(&still).unwrap();
        let (a, b) = (at(&mut one, 1.0, swinging), at(&mut other, 1.0, Signal::constant(end)));
        let (Ok(a), Ok(b)) = (a, b) else { continue };
        assert!((a - b).abs() < 1e-6 && (a - angle(end)).abs() < 1e-6);
        straight += 1;
        assert!(other.fallbacks().is_empty());
        assert!(one.fallbacks().is_empty(), "{short}, {change}: {:?}", one.fallbacks());
    }
    assert!(straight > 12, "{straight}");
}

/// Input values out of range are an error, after which the tracker can be updated again.
#[test]
fn beyond_the_range_is_an_error_and_no_end() {
    let rocker = Rocker::default();
    let first = Instant { t: 0.0, inputs: &[Signal::constant(1.0)] };
    let mut tracker = rocker.solver().tracker(&first).unwrap();
    for (t, far) in [(1.0, 1.7), (1.0, -3.0), (0.0, 2.0), (-1.0, 5.0), (1e6, 1e9), (1e6, -0.1)] {
        let error = at(&mut tracker, t, Signal::constant(far)).unwrap_err();
        match &error {
            SolveError::Singular { t: last, rows, .. } => {
                assert!(rows.contains(&"ram") && *last <= t.max(0.0), "{error}")
            }
            SolveError::StepRefused { joint: "ram", reason: Refusal::NotAssembled | Refusal::WouldJump, .. } => {}
            SolveError::DegenerateGeometry { t: at, joint: "ram", fault: GeometryFault::NegativeLength { length } } => {
                assert_eq!((*at, *length), (t, far), "{error}");
                assert!(far < 0.0);
            }
            _ => panic!("{error}"),
        }
        assert_eq!((0.0, 1.0), (tracker.state().t, tracker.state().inputs[0].value));
        assert!((tracker.state().q[2] - angle(1.0)).abs() < 1e-12);
    }
    let phi = at(&mut tracker, 2.0, Signal::new(1.1, 0.1, 0.0)).unwrap();
    assert!((phi - angle(1.1)).abs() < 1e-12);

    let mut rough = rocker.solver().with_options(Options { min_step: 1e-3, max_steps: 50, ..Options::default() });
    rough = rough.with_guess(2, 1.0);
    let mut tracker = rough.tracker(&first).unwrap();
    assert!(at(&mut tracker, 1.0, Signal::constant(1.7)).is_err());
    assert!((at(&mut tracker, 1.0, Signal::constant(1.4)).unwrap() - angle(1.4)).abs() < 1e-12);
}

/// Invalid inputs are named in the error and do not change the state.
#[test]
fn wrong_inputs_change_nothing() {
    let excavator = MeasuredExcavator;
    let inputs = signals::<MeasuredExcavator>(0.0);
    let mut tracker = excavator.solver().tracker(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    let before = tracker.state().clone();
    let error = tracker.update(&Instant { t: 0.1, inputs: &inputs[1..] }).unwrap_err();
    assert_eq!(SolveError::Length(LengthError { what: "inputs", expected: 3, found: 2 }), error);
    let mut broken = inputs.clone();
    broken[..][MeasuredExcavator::stick_length].rate = f64::NAN;
    let error = tracker.update(&Instant { t: 0.1, inputs: &broken }).unwrap_err();
    assert_eq!(SolveError::NonFinite { what: "inputs", index: 1, name: "stick_length", t: None }, error);
    assert!(error.to_string().contains("stick_length"), "{error}");
    assert!(tracker.update(&Instant { t: f64::NAN, inputs: &inputs }).is_err());
    assert!(tracker.restart(&Instant { t: f64::INFINITY, inputs: &inputs }).is_err());
    assert!(tracker.restart_from(&Instant { t: 0.0, inputs: &inputs }, &[0.0; 3]).is_err());
    assert_eq!(&before, tracker.state());
    let huge = vec![Signal::new(f64::MAX, f64::MAX, -f64::MAX); 3];
    assert!(tracker.update(&Instant { t: 0.1, inputs: &huge }).is_err());
    assert_eq!(&before, tracker.state());
}

/// A restart can choose another mode.
#[test]
fn starting_anew_chooses_the_branch() {
    let rocker = Rocker::default();
    let inputs = [Signal::constant(1.0)];
    let first = Instant { t: 0.0, inputs: &inputs };
    let mut tracker = rocker.solver().tracker(&first).unwrap();
    let below = tracker.restart_from(&first, &[0.0, 0.0, -1.0]).unwrap().q[2];
    assert!((below + angle(1.0)).abs() < 1e-12);
    assert!(at(&mut tracker, 0.1, Signal::constant(1.3)).unwrap() < 0.0);
    assert!(tracker.restart(&Instant { t: 3.0, inputs: &inputs }).unwrap().q[2] > 0.0);
    assert!(tracker.restart(&Instant { t: 4.0, inputs: &[Signal::constant(9.0)] }).is_err());
    assert_eq!(3.0, tracker.state().t);
    assert!((at(&mut tracker, 5.0, Signal::constant(1.2)).unwrap() - angle(1.2)).abs() < 1e-12);
    let mut other = rocker.solver().tracker_from(&first, &[0.0, 0.0, -1.0]).unwrap();
    assert!(at(&mut other, 0.1, Signal::constant(1.3)).unwrap() < 0.0);
}

/// A tracker can be stored in a struct without borrowing the mechanism.
#[test]
fn a_tracker_can_own_its_mechanism() {
    struct Controller(Tracker<'static>);
    let first = Instant { t: 0.0, inputs: &[Signal::constant(1.0)] };
    let mut controller = Controller(Rocker { arm: 0.5 }.solver().owned_tracker(&first).unwrap());
    assert!((at(&mut controller.0, 0.1, Signal::constant(1.3)).unwrap() - angle(1.3)).abs() < 1e-12);
    assert!(format!("{:?}", controller.0).contains("state"));
}

/// The reports of a tracker are those of the solver for its state.
#[test]
fn reports_are_those_of_the_solver() {
    let arm = MeasuredExcavator;
    let solver = arm.solver();
    let mut tracker = solver.tracker(&Instant { t: 0.0, inputs: &signals::<MeasuredExcavator>(0.0) }).unwrap();
    tracker.update(&Instant { t: 0.3, inputs: &signals::<MeasuredExcavator>(0.3) }).unwrap();
    assert!(tracker.update(&Instant { t: 0.4, inputs: &[Signal::constant(9.0); 3] }).is_err());
    let state = tracker.state().clone();
    assert_eq!(0.3, state.t);
    assert_eq!(solver.motion(&state).unwrap(), tracker.motion().unwrap());
    let (alone, tracked) = (solver.velocity_ratios(&state).unwrap(), tracker.velocity_ratios().unwrap());
    let mut differences = Differences::new();
    for (a, b) in alone.inputs.iter().zip(&tracked.inputs) {
        differences.vector("first", name::<MeasuredExcavator>, &a.first, &b.first, 1e-12);
        differences.vector("second", name::<MeasuredExcavator>, &a.second, &b.second, 1e-11);
    }
    differences.finish();
}

/// An arm driven by an input, and one whose coordinate is prescribed.
#[mechanism]
#[input(turn)]
#[body(arm, x = 0, y = 0)]
#[body(other, x = 1, y = 0)]
#[driver(drive: arm.phi = turn)]
#[driver(half: other.phi + free = 0)]
#[coordinates(free)]
struct Arms;

/// Time stamps that are large or jitter may leave a step in time too short to divide; the inputs are still followed.
#[test]
fn instants_may_be_neighbouring_numbers() {
    for start in [1.0_f64, 1.7e9] {
        let free = Arms::model().coordinate("free").expect("its name");
        let solver = Arms.solver().with_given(free, Signal::default());
        let mut tracker = solver.tracker(&Instant { t: start, inputs: &[Signal::constant(0.0)] }).unwrap();
        let next = start.next_up();
        let state = tracker.update(&Instant { t: next, inputs: &[Signal::new(2.0, 0.5, 0.0)] }).unwrap();
        assert_eq!((state.t, state.q[0], state.q_dot[0]), (next, 2.0, 0.5));
        assert!(state.iterations < 1000, "{}", state.iterations);
    }
}

#[test]
fn a_restart_begins_prescribed_coordinates_anew() {
    let free = Arms::model().coordinate("free").expect("its name");
    let solver = Arms.solver().with_given(free, Signal::new(0.1, 1.0, 0.0));
    let inputs = [Signal::constant(0.0)];
    let mut tracker = solver.tracker(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    assert!((tracker.update(&Instant { t: 0.5, inputs: &inputs }).unwrap().q[free] - 0.6).abs() < 1e-12);
    // A restart that fails leaves the state unchanged.
    assert!(tracker.restart(&Instant { t: f64::NAN, inputs: &inputs }).is_err());
    assert!((tracker.update(&Instant { t: 0.7, inputs: &inputs }).unwrap().q[free] - 0.8).abs() < 1e-12);
    assert!((tracker.restart(&Instant { t: 5.0, inputs: &inputs }).unwrap().q[free] - 0.1).abs() < 1e-12);
}

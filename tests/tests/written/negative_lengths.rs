//! A negative length of a distance constraint is an error that names the joint, whether the length is a parameter, an
//! input or a function of time.

use kin_runtime::{GeometryFault, Instant, Kinematics, PlanError, Planned, Signal, SolveError, Solver, mechanism};

/// A four-bar whose coupler is a distance constraint; the crank is given by the local coordinates of its points.
#[mechanism]
#[bodies(crank, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (-l1 / 2, 0))]
#[distance(link: crank @ (l1 / 2, 0), rocker @ (0.3, 0), length = l2)]
#[revolute(D: rocker @ (0, 0), ground @ (0.4, 0.1))]
#[driver(turn: crank.phi = 0.5 + t)]
#[guess(rocker.phi = 1.6)]
#[derive(Clone)]
struct Linked {
    #[param(0.1)]
    l1: f64,
    #[param(0.4)]
    l2: f64,
}

/// A boom on a hydraulic cylinder whose length is an input.
#[mechanism]
#[bodies(boom)]
#[input(cylinder)]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[distance(lift: ground @ (0.5, -0.2), boom @ (1.0, 0.1), length = cylinder)]
#[guess(boom.phi = 0.7)]
struct Boom;

/// The same boom with the length of its cylinder driven as a function of time.
#[mechanism]
#[bodies(boom)]
#[point(eye = boom @ (1.0, 0.1))]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[driver(lift: distance(ground @ (0.5, -0.2), eye) = from + speed * t)]
#[guess(boom.phi = 0.7)]
struct Driven {
    #[param(0.9)]
    from: f64,
    #[param(0.1)]
    speed: f64,
}

fn fault(error: SolveError) -> (f64, &'static str, f64) {
    let shown = error.to_string();
    match error {
        SolveError::DegenerateGeometry { t, joint, fault: GeometryFault::NegativeLength { length } } => {
            assert!(shown.contains(joint) && shown.contains(&length.to_string()), "{shown}");
            (t, joint, length)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_negative_parameter_is_an_error_in_every_analysis() {
    let at = Instant::at(0.25);
    let sound = Linked::default();
    let q = sound.state_at(&at).unwrap().q;
    let wrong = Linked { l2: -0.4, ..sound.clone() };
    assert_eq!(fault(wrong.state_at(&at).unwrap_err()), (0.25, "link", -0.4));
    assert_eq!(fault(wrong.position_analysis(&at, &q).unwrap_err()), (0.25, "link", -0.4));
    assert_eq!(fault(wrong.velocity_analysis(&at, &q).unwrap_err()), (0.25, "link", -0.4));
    assert_eq!(fault(wrong.mobility(&at, &q).unwrap_err()), (0.25, "link", -0.4));
    assert_eq!(fault(wrong.solver().sweep(&[0.25, 1.0]).unwrap_err().source), (0.25, "link", -0.4));
    assert!(wrong.solver().tracker(&at).is_err());
    // A negative local coordinate of a point is valid.
    let turned = Linked { l1: -0.1, ..sound }.state_at(&at).unwrap();
    assert!(turned.residual < 1e-12);
}

fn cylinder(value: f64) -> [Signal; 1] {
    [Signal::constant(value)]
}

#[test]
fn a_measured_length_is_looked_at_in_every_instant() {
    let mut tracker = Boom.solver().tracker(&Instant { t: 0.0, inputs: &cylinder(0.9) }).unwrap();
    let wrong = cylinder(-0.9);
    let at = Instant { t: 0.5, inputs: &wrong };
    assert_eq!(fault(tracker.update(&at).map(|_| ()).unwrap_err()), (0.5, "lift", -0.9));
    assert_eq!(fault(tracker.restart(&at).map(|_| ()).unwrap_err()), (0.5, "lift", -0.9));
    // The tracker keeps its last valid state and can be updated from it.
    assert_eq!(tracker.state().t, 0.0);
    assert!(tracker.update(&Instant { t: 1.0, inputs: &cylinder(0.95) }).is_ok());
    assert_eq!(fault(Boom.state_at(&at).unwrap_err()), (0.5, "lift", -0.9));
    // The input as a function of time jumps from a positive to a negative length in one step.
    let jump = |t: f64, u: &mut [Signal]| u[0] = Signal::constant(if t == 0.0 { 0.9 } else { -0.9 });
    let error = Boom.solver().with_inputs(&jump).sweep(&[0.0, 1.0]).unwrap_err();
    assert_eq!(error.trajectory.states.len(), 1);
    let (_, joint, length) = fault(error.source);
    assert_eq!((joint, length), ("lift", -0.9));
}

#[test]
fn a_driven_length_is_looked_at_in_every_instant() {
    let sound = Driven::default();
    assert!(sound.state_at(&Instant::at(1.0)).is_ok());
    assert_eq!(fault(Driven { from: -0.9, speed: 0.0 }.state_at(&Instant::at(2.0)).unwrap_err()), (2.0, "lift", -0.9));
    let shrinking = Driven { from: 0.9, speed: -1.0 };
    let (t, joint, length) = fault(shrinking.state_at(&Instant::at(2.0)).unwrap_err());
    assert_eq!((t, joint), (2.0, "lift"));
    assert!((length + 1.1).abs() < 1e-15);
    // The sweep ends earlier than at a negative length: at some length the loop of boom and cylinder cannot be closed
    // any more.
    let solver: Solver<'_, Driven> = shrinking.solver();
    assert!(solver.sweep(&[0.0, 0.2, 2.0]).unwrap_err().trajectory.states.len() == 2);
}

/// The loop cannot be closed any more at some positive length; that is found although the next instant has a negative
/// one, and although the last instant is an hour later.
#[test]
fn a_dead_centre_before_a_negative_length_is_found() {
    let (reach, eye) = (f64::hypot(0.5, 0.2), f64::hypot(1.0, 0.1));
    let shrinking = Driven { from: 0.9, speed: -0.3 };
    let dead = (0.9 - (eye - reach)) / 0.3;
    let solver = shrinking.solver();
    for times in [[0.0, 0.2, 3600.0], [0.0, 0.3, 3.1], [0.0, 0.4, 2.0]] {
        let error = solver.sweep(&times).unwrap_err();
        let limit = error.source.limit().unwrap_or_else(|| panic!("{}", error.source));
        assert!((limit.at().unwrap() - dead).abs() < 1e-9, "{limit}, expected {dead}");
        assert_eq!(error.trajectory.states.len(), 2);
        let mut planned = solver.planned(&Instant::at(0.0)).unwrap();
        let error = planned.at(&Instant::at(times[2])).map(|_| ()).unwrap_err();
        let limit = error.limit().unwrap_or_else(|| panic!("{error}"));
        assert!((limit.at().unwrap() - dead).abs() < 1e-9, "{limit}, expected {dead}");
        assert_eq!(planned.t(), 0.0);
        assert!(planned.at(&Instant::at(times[1])).is_ok());
        let mut tracker = solver.tracker(&Instant::at(0.0)).unwrap();
        let error = tracker.update(&Instant::at(times[2])).map(|_| ()).unwrap_err();
        let limit = error.limit().unwrap_or_else(|| panic!("{error}"));
        assert!((limit.at().unwrap() - dead).abs() < 1e-9, "{limit}, expected {dead}");
        assert!(tracker.state().t == 0.0 && tracker.q_at_limit().is_some());
        assert!(tracker.update(&Instant::at(times[1])).is_ok());
    }
    // The same by an input that is a function of time; a value that is given is wrong by itself.
    let by_input = |t: f64, inputs: &mut [Signal]| inputs[0] = Signal::new(0.9 - 0.3 * t, -0.3, 0.0);
    let error = Boom.solver().with_inputs(&by_input).sweep(&[0.0, 0.2, 3600.0]).unwrap_err();
    let limit = error.source.limit().unwrap_or_else(|| panic!("{}", error.source));
    assert!((limit.at().unwrap() - dead).abs() < 1e-9, "{limit}, expected {dead}");
}

#[test]
fn a_length_of_nothing_is_what_it_was() {
    let error = Driven { from: 0.0, speed: 0.0 }.state_at(&Instant::at(0.0)).unwrap_err();
    assert!(
        !matches!(error, SolveError::DegenerateGeometry { fault: GeometryFault::NegativeLength { .. }, .. }),
        "{error}"
    );
    assert!(!matches!(
        Driven { from: -0.0, speed: 0.0 }.state_at(&Instant::at(0.0)).unwrap_err(),
        SolveError::DegenerateGeometry { fault: GeometryFault::NegativeLength { .. }, .. }
    ));
}

#[test]
fn the_plan_alone_takes_no_negative_length_either() {
    let at = Instant::at(0.25);
    let sound = Linked::default();
    let q = sound.state_at(&at).unwrap().q;
    let wrong = Linked { l2: -0.4, ..sound };
    let error = Planned::new(&wrong, &at, &q).map(|_| ()).unwrap_err();
    assert_eq!(error, PlanError::NegativeLength { t: 0.25, joint: "link", length: -0.4 });
    assert_eq!(error.to_string(), "at t = 0.25, the length of `link` is -0.4: a length must not be negative");
    // The last valid state is kept.
    let mut boom = Boom.solver().planned(&Instant { t: 0.0, inputs: &cylinder(0.9) }).unwrap();
    let error = boom.at(&Instant { t: 0.5, inputs: &cylinder(-0.9) }).map(|_| ()).unwrap_err();
    assert_eq!(error, PlanError::NegativeLength { t: 0.5, joint: "lift", length: -0.9 });
    assert_eq!(boom.t(), 0.0);
    assert!(boom.at(&Instant { t: 1.0, inputs: &cylinder(0.95) }).is_ok());
}

/// In a batch, parameter sets with a negative length have no solution, and those in the other lanes are the same as
/// when solved alone.
#[cfg(feature = "simd")]
#[test]
fn nor_does_a_batch() {
    use kin_runtime::Lanes;
    use kin_runtime::batch::{Column, Modes, Moment, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
    let lengths = [0.4, -0.4, 0.41, 0.42, 0.43, -0.44, 0.45, 0.46, -0.47, 0.48];
    let start = Linked::default().state_at(&Instant::at(0.0)).unwrap().q;
    let start: Vec<Column<'_>> = start.iter().map(|q| Column::Shared(*q)).collect();
    let parameters = [Column::Shared(0.1), Column::Each(&lengths)];
    let sound = lengths.map(|length| length > 0.0);
    let t = Column::Shared(0.0);
    let problems = Problems { parameters: &parameters, t, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Solutions::<Linked>::new(lengths.len());
    solve(&Linked::default(), kin_runtime::plan::Depth::Acceleration, &problems, &mut out, &always).unwrap();
    assert!(out.solved().eq(sound));
    let times = [0.0, 0.1, 0.2];
    let sweeps = Sweeps { parameters: &parameters, times: &times, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(lengths.len(), Lanes::from(0.0));
    let count = |seen: &mut Lanes, moment: &Moment<'_>| *seen = moment.keep(*seen, *seen + Lanes::from(1.0));
    sweep(&Linked::default(), &sweeps, &mut out, &always, count).unwrap();
    assert!(out.ends().map(|end| end.is_none()).eq(sound));
    assert!(out.ends().flatten().all(|end| end.instant == 0 && end.limit.is_none()));
    assert!(out.scores(|seen| *seen).zip(sound).all(|(seen, sound)| seen == if sound { 3.0 } else { 0.0 }));
    // The length of the cylinder is an input: at the second instant it is negative for every problem of the batch.
    let start = Boom.state_at(&Instant { t: 0.0, inputs: &cylinder(0.9) }).unwrap().q;
    let start: Vec<Column<'_>> = start.iter().map(|q| Column::Shared(*q)).collect();
    let (still, measured) = (Column::Shared(0.0), [0.9, -0.9, 0.9]);
    let inputs = [Signal::new(Column::Each(&measured), still, still)];
    let sweeps = Sweeps { parameters: &[], times: &times, inputs: &inputs, modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(3, Lanes::from(0.0));
    sweep(&Boom, &sweeps, &mut out, &always, count).unwrap();
    assert!(out.ends().all(|end| end.is_some_and(|end| end.instant == 1 && end.margin <= 0.0 && end.limit.is_none())));
    assert!(out.scores(|seen| *seen).all(|seen| seen == 1.0));
}

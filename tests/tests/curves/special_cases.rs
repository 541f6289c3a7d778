//! Redundant, singular, infeasible and under-driven reference cases: the results are those of their files.

use kin_runtime::{Instant, Kinematics, Mechanism, Signal, SolveError, mechanism};
use kin_tests::case::Case;
use kin_tests::compare::{Differences, largest};
use kin_tests::mechanisms::{
    InfeasibleFourbar, RedundantParallelogram, SingularSliderCrank, SliderCrankInline, UnderdrivenFivebar,
};
use std::collections::BTreeSet;

fn joint_of<M: Mechanism>(row: usize) -> &'static str {
    M::model().joints[M::model().rows[row].joint].name
}

fn coordinate_name<M: Mechanism>(place: usize) -> &'static str {
    M::model().coordinates[place].name
}

/// The redundant row is consistent, and its circuit is the support of the file's left null vector.
#[test]
fn redundant_row_is_named_with_its_circuit() {
    type M = RedundantParallelogram;
    let case = Case::read("redundant_parallelogram");
    for instant in &case.modes[0].instants {
        let mobility = M::default().mobility(&Instant::at(instant.t), &instant.q).unwrap();
        let [redundant] = &mobility.redundant[..] else { panic!("one redundant row: {:?}", mobility.redundant) };
        assert!(redundant.consistent, "{redundant:?}");
        let null = &case.left_null_space[0];
        let support: BTreeSet<_> =
            null.iter().enumerate().filter(|(_, y)| y.abs() > 1e-9).map(|(row, _)| joint_of::<M>(row)).collect();
        let found: BTreeSet<_> = redundant.circuit.iter().copied().chain([redundant.joint]).collect();
        assert_eq!(support, found, "t = {}", instant.t);
    }
}

/// A parallelogram whose third link has a length parameter.
#[mechanism(allow_redundant)]
#[bodies(crank, coupler, rocker, middle)]
#[revolute(O1: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.3, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.6, 0), rocker @ (0.3, 0))]
#[revolute(O2: ground @ (0.6, 0), rocker @ (0, 0))]
#[revolute(O3: ground @ (0.2, 0), middle @ (0, 0))]
#[revolute(C: coupler @ (0.2, 0), middle @ (length, 0))]
#[driver(drive: crank.phi = 0.6 + t)]
#[guess(rocker.phi = 0.6, middle.phi = 0.6)]
struct ThirdLink {
    #[param(0.3)]
    length: f64,
}

/// Contradicting redundant rows are an error, not a least-squares solution.
#[test]
fn contradicting_redundant_rows_do_not_assemble() {
    let at = Instant::at(0.0);
    assert!(ThirdLink { length: 0.3 }.state_at(&at).is_ok());
    let error = ThirdLink { length: 0.31 }.state_at(&at).unwrap_err();
    assert!(matches!(error, SolveError::NotAssembled { .. }), "{error}");
}

/// At t* the rank drops and no velocity exists; every analysis that needs a velocity returns an error.
#[test]
fn singular_configuration_is_an_error() {
    type M = SingularSliderCrank;
    let case = Case::read("singular_slider_crank");
    let singular = case.singular.as_ref().unwrap();
    assert!(!singular.velocity_consistent);
    let mechanism = M::default();
    let at = Instant::at(singular.t);
    let mobility = mechanism.mobility(&at, &singular.q).unwrap();
    assert_eq!(singular.rank, mobility.rank);
    let moving: BTreeSet<_> = mobility.could_be_given.iter().map(|&place| coordinate_name::<M>(place)).collect();
    let null = &singular.right_null_space[0];
    let expected: BTreeSet<_> =
        null.iter().enumerate().filter(|(_, z)| z.abs() > 1e-9).map(|(place, _)| coordinate_name::<M>(place)).collect();
    assert_eq!(expected, moving);
    match mechanism.velocity_analysis(&at, &singular.q) {
        Err(SolveError::Singular { t, rank, .. } | SolveError::InconsistentVelocity { t, rank, .. }) => {
            assert_eq!((singular.t, singular.rank), (t, rank));
        }
        other => panic!("{other:?}"),
    }
}

/// A sweep that runs into t* ends with an error and keeps the states before.
#[test]
fn sweep_stops_before_the_singular_configuration() {
    let case = Case::read("singular_slider_crank");
    let end = case.singular.as_ref().unwrap().t;
    let mechanism = SingularSliderCrank::default();
    for mode in &case.modes {
        for beyond in [end, end + 1e-6, end + 0.1, 3.0] {
            let mut times = mode.times();
            times.push(beyond);
            let error = mechanism.solver().sweep_from(&mode.initial_guess, &times).unwrap_err();
            assert_eq!(mode.instants.len(), error.trajectory.len(), "{}, until {beyond}: {error}", mode.name);
            let (SolveError::StepRefused { t: last, .. }
            | SolveError::Singular { t: last, .. }
            | SolveError::InconsistentVelocity { t: last, .. }) = error.source
            else {
                panic!("{}, until {beyond}: {error}", mode.name)
            };
            assert!((0.46..=end + 1e-6).contains(&last), "{}, until {beyond}: {error}", mode.name);
        }
    }
}

#[test]
fn beyond_the_singular_configuration_nothing_assembles() {
    let mechanism = SingularSliderCrank::default();
    let error = mechanism.solver().state(&Instant::at(0.5)).unwrap_err();
    let SolveError::NotAssembled { t, gap, .. } = error else { panic!("{error}") };
    assert!(t == 0.5 && gap > 1e-3, "{gap}");
}

#[test]
fn infeasible_mechanism_never_assembles() {
    let mechanism = InfeasibleFourbar::default();
    for t in [0.0, 0.3, 1.0, 2.5] {
        match mechanism.solver().state(&Instant::at(t)) {
            Err(SolveError::NotAssembled { t: at, gap, joint, .. }) => {
                assert!(at == t && gap > 1e-3 && gap.is_finite(), "t = {t}: gap {gap}");
                assert!(["O", "A", "B", "D", "drive"].contains(&joint), "{joint}");
            }
            other => panic!("t = {t}: {other:?}"),
        }
    }
    assert!(mechanism.kinematic_analysis(&[0.0, 0.1]).is_err());
}

/// The degrees of freedom that an under-driven mechanism leaves open, and its velocity and acceleration of least norm.
#[test]
fn under_driven_mechanism_has_least_norm_answers() {
    type M = UnderdrivenFivebar;
    let case = Case::read("underdriven_fivebar");
    let mechanism = M::default();
    let first = &case.modes[0].instants[0];
    let at = Instant::at(first.t);
    let mobility = mechanism.mobility(&at, &first.q).unwrap();
    let null = &case.null_space[0];
    let open: Vec<_> =
        null.iter().enumerate().filter(|(_, z)| z.abs() > 1e-9).map(|(place, _)| coordinate_name::<M>(place)).collect();
    let found: Vec<_> = mobility.could_be_given.iter().map(|&place| coordinate_name::<M>(place)).collect();
    assert_eq!(open, found);

    let expected = case.minimum_norm.as_ref().unwrap();
    let q_dot = mechanism.velocity_analysis(&at, &first.q).unwrap();
    let q_ddot = mechanism.acceleration_analysis(&at, &first.q, &q_dot).unwrap();
    let mut differences = Differences::new();
    differences.at("least norm");
    for (what, expected, found) in [("q_dot", &expected.q_dot, &q_dot), ("q_ddot", &expected.q_ddot, &q_ddot)] {
        differences.vector(what, coordinate_name::<M>, expected, found, 1e-10 * largest(expected));
    }
    differences.finish();
}

/// The samples of the under-driven case: the second crank's angle is prescribed at every instant.
#[test]
fn under_driven_mechanism_is_completed_by_a_given_coordinate() {
    type M = UnderdrivenFivebar;
    let case = Case::read("underdriven_fivebar");
    let mechanism = M::default();
    let [completion] = &case.completion_constraint[..] else { panic!("one completion") };
    let name = format!("{}.phi", completion.body_i);
    let place = M::model().coordinates.iter().position(|c| c.name == name).unwrap();
    let mode = &case.modes[0];
    let mut start = mode.initial_guess.clone();
    let mut differences = Differences::new();
    for (expected, sample) in mode.instants.iter().zip(&completion.f_samples) {
        let given = Signal { value: sample[1], rate: sample[2], acceleration: sample[3] };
        let solver = mechanism.solver().with_given(place, given);
        let state = solver.state_from(&Instant::at(expected.t), &start).unwrap();
        differences.at(format_args!("t = {}", expected.t));
        let levels = [
            ("q", &expected.q, &state.q),
            ("q_dot", &expected.q_dot, &state.q_dot),
            ("q_ddot", &expected.q_ddot, &state.q_ddot),
        ];
        for (what, expected, found) in levels {
            differences.vector(what, coordinate_name::<M>, expected, found, 1e-10 * largest(expected));
        }
        start = state.q;
    }
    differences.finish();
}

/// Prescribing a coordinate of a mechanism without a degree of freedom left is an error.
#[test]
fn given_coordinate_of_a_driven_mechanism_conflicts() {
    let mechanism = SliderCrankInline::default();
    let given = Signal { value: 1.0, rate: 0.0, acceleration: 0.0 };
    let error = mechanism.solver().with_given(2, given).state(&Instant::at(0.0)).unwrap_err();
    assert!(matches!(error, SolveError::GivenConflict { .. } | SolveError::NotAssembled { .. }), "{error}");
}

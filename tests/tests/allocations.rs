//! Evaluation takes no memory: neither the equations nor the observables, in `f64` and `f32`; nor does a loop by the plan,
//! a tracker, or a sweep that lends its states, where the plan solves the mechanism.

use allocation_counter::measure;
use kin_runtime::{Instant, Kinematics, Mechanism, Planned, Scalar, Signal, Subset};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::{signals, *};
use kin_tests::random::Random;
use std::ops::ControlFlow;

macro_rules! allocation_tests {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(#[test]
        fn $moving() {
            allocates_nothing::<$Moving, f64>();
            allocates_nothing::<$Moving, f32>();
            loops_without_memory::<$Moving>($from, $to);
            tracks_without_memory::<$Moving>($from, $to);
            sweeps_without_memory::<$Moving>($from, $to);
        })*
        $(#[test]
        fn $other() {
            allocates_nothing::<$Other, f64>();
            allocates_nothing::<$Other, f32>();
        })*
    };
}

every_mechanism!(allocation_tests);

fn allocates_nothing<M: Mechanism + Default, T: Scalar>() {
    let mechanism = M::default();
    let mut random = Random::new(5);
    let mut vector = || (0..M::COORDINATES).map(|_| T::from_f64(random.between(-1.0, 1.0))).collect::<Vec<_>>();
    let (q, q_dot) = (vector(), vector());
    let inputs: Vec<_> = signals::<M>(0.3).into_iter().map(|u| u.map(T::from_f64)).collect();
    let mut geometry = vec![T::from_f64(0.0); M::model().geometry];
    let counted = measure(|| {
        let at = Instant { t: T::from_f64(0.3), inputs: &inputs };
        let mut workspace = M::workspace::<T>();
        let mut observations = M::observations::<T>();
        for subset in [Subset::PHI, Subset::JACOBIAN, Subset::GAMMA, Subset::ALL] {
            mechanism.evaluate(subset, &at, &q, &q_dot, &mut workspace).expect("lengths agree");
        }
        let parameters = mechanism.parameters::<T>();
        mechanism.observe_with(parameters.as_ref(), &at, &q, &q_dot, &mut observations).expect("lengths agree");
        mechanism.write_geometry(parameters.as_ref(), &at, &mut geometry).expect("lengths agree");
    });
    assert_eq!(0, counted.count_total, "{}", M::model().name);
}

/// Making a `Planned`, its loop, its errors and another mode.
fn loops_without_memory<M: Kinematics + Default>(from: f64, to: f64) {
    if !M::model().plan.exists() {
        return;
    }
    let mechanism = M::default();
    let inputs: Vec<Vec<_>> = (0..=20).map(|k| signals::<M>(from + (to - from) * f64::from(k) / 20.0)).collect();
    let at = |k: usize| Instant { t: from + (to - from) * k as f64 / 20.0, inputs: &inputs[k] };
    let start = mechanism.solver().assemble(&at(0)).unwrap();
    let mut found = Vec::with_capacity(21);
    let counted = measure(|| {
        let mut planned = Planned::new(&mechanism, &at(0), &start).unwrap();
        for k in 0..=20 {
            found.push(planned.at(&at(k)).unwrap().q()[0]);
        }
        let error = planned.at(&Instant { t: f64::NAN, ..at(20) }).is_err();
        if error && !M::model().plan.modes.is_empty() {
            planned.flip(0).unwrap();
            let _ = planned.at(&at(20));
        }
    });
    assert_eq!((0, 21), (counted.count_total, found.len()), "{}", M::model().name);
}

/// The updates of a tracker, back and forth.
fn tracks_without_memory<M: Kinematics + Default>(from: f64, to: f64) {
    if !M::model().plan.exists() {
        return;
    }
    let mechanism = M::default();
    let inputs: Vec<Vec<_>> = (0..=200).map(|k| signals::<M>(from + (to - from) * f64::from(k) / 200.0)).collect();
    let at = |k: usize| Instant { t: from + (to - from) * k as f64 / 200.0, inputs: &inputs[k] };
    let mut tracker = mechanism.solver().tracker(&at(0)).unwrap();
    // The first update makes room.
    tracker.update(&at(1)).unwrap();
    let mut by_plan = 0;
    for k in (2..=200).chain((0..200).rev()) {
        let counted = measure(|| assert!(tracker.update(&at(k)).is_ok()));
        // Full Newton allocates, where the plan has no answer.
        let is_by_plan = tracker.fallbacks().is_empty() && tracker.state().condition.is_none();
        by_plan += usize::from(is_by_plan);
        assert!(!is_by_plan || counted.count_total == 0, "{} at {k}: {}", M::model().name, counted.count_total);
    }
    assert!(by_plan > 300, "{}: {by_plan}", M::model().name);
}

/// A sweep of many instants takes no more memory than one of few.
fn sweeps_without_memory<M: Kinematics + Default>(from: f64, to: f64) {
    if !M::model().plan.exists() || !M::model().conditions.is_empty() {
        return;
    }
    let mechanism = M::default();
    let inputs = |t: f64, to: &mut [Signal]| to.copy_from_slice(&signals::<M>(t));
    let times: Vec<f64> = (0..=400).map(|k| from + (to - from) * f64::from(k) / 400.0).collect();
    let solver = mechanism.solver();
    let solver = if M::INPUTS > 0 { solver.with_inputs(&inputs) } else { solver };
    let mut seen = 0;
    let sweep = |times: &[f64], seen: &mut usize| {
        let found = solver.sweep_each(times, |_| {
            *seen += 1;
            ControlFlow::Continue(())
        });
        found.unwrap().fallbacks.len()
    };
    // Full Newton allocates, and so do these functions of the inputs.
    let mut fallbacks = M::INPUTS;
    let few = measure(|| fallbacks += sweep(&times[..201], &mut seen));
    let many = measure(|| fallbacks += sweep(&times, &mut seen));
    assert_eq!(602, seen);
    if fallbacks == 0 {
        assert_eq!(few.count_total, many.count_total, "{}", M::model().name);
    }
}

/// A point, its Jacobian to the inputs and forces, at every tick.
#[test]
fn a_controller_asks_without_memory() {
    use kin_tests::mechanisms::loaded;

    let excavator = MeasuredExcavator;
    let inputs: Vec<Signal> = signals::<MeasuredExcavator>(0.0);
    let state = excavator.state_at(&Instant { t: 0.0, inputs: &inputs }).expect("it closes");
    let mut planned = Planned::new(&excavator, &Instant { t: 0.0, inputs: &inputs }, &state.q).expect("a plan");
    let mut jacobian = [[0.0; 2]; MeasuredExcavator::INPUTS];
    let counted = measure(|| {
        planned.at(&Instant { t: 0.001, inputs: &inputs }).expect("it goes on");
        planned.point(MeasuredExcavator::tip).expect("its own point");
        planned.point_jacobian(MeasuredExcavator::tip, &mut jacobian).expect("as many columns as inputs");
    });
    assert_eq!(0, counted.count_total);
    let mut broken = inputs.clone();
    broken[MeasuredExcavator::boom_length.0] = Signal::constant(9.0);
    let tick = Instant { t: 0.002, inputs: &broken };
    let counted = measure(|| {
        planned.at(&tick).map(|_| ()).expect_err("the boom is too short");
        planned.out_of_range(&tick).expect("the boom's sensor is to blame");
    });
    assert_eq!(0, counted.count_total);

    let four_bar = loaded::FourbarLectureMid::default();
    let state = four_bar.state_at(&Instant::at(0.0)).expect("it closes");
    let mut planned = Planned::new(&four_bar, &Instant::at(0.0), &state.q).expect("a plan");
    let mut forces = vec![0.0; loaded::FourbarLectureMid::model().forces.expect("it has masses").count];
    let counted = measure(|| {
        planned.at(&Instant::at(0.001)).expect("it goes on");
        planned.forces(&mut forces).expect("as many numbers as there are");
    });
    assert_eq!(0, counted.count_total);
}

//! Mechanisms that depend on time and on inputs; the inputs are functions of time, or jump at a fixed time. A jump is
//! followed along the inputs alone, without the contribution of time to the rates.

use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, PlanError, Refusal, Signal, SolveError, mechanism};
use kin_tests::mechanisms::MeasuredExcavator;
use std::f64::consts::TAU;

/// A double crank whose crank angle is a function of time plus an input.
#[mechanism]
#[input(ahead)]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.3, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.35, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (0.3, 0), ground @ (0.1, 0))]
#[driver(drive: crank.phi = pace * t + quick * t * t + ahead)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
struct DoubleCrank {
    #[param(7.0)]
    pace: f64,
    #[param(3.0)]
    quick: f64,
}

/// A four-bar that cannot make full turns, driven in the same way.
#[mechanism]
#[input(ahead)]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.3, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.25, 0), rocker @ (0.2, 0))]
#[revolute(D: ground @ (0.5, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = pace * t + ahead)]
#[guess(coupler.phi = 0.9, rocker.phi = 2.2)]
struct Swing {
    #[param(7.0)]
    pace: f64,
}

fn signal(value: f64) -> [Signal; 1] {
    [Signal::new(value, 0.4, -0.3)]
}

/// A jump in one step or in many leads to the same state: by the plan, by a tracker, and without a plan.
#[test]
fn a_jump_of_an_input_is_walked_along_the_input_alone() {
    for (pace, quick) in [(7.0, 3.0), (-20.0, 0.0), (0.0, 50.0), (300.0, -10.0), (0.1, 0.0)] {
        let mechanism = DoubleCrank { pace, quick };
        let t = 0.3;
        let first = signal(0.2 - pace * t - quick * t * t);
        for jump in [0.5, 2.0, -2.0, 12.0, -7.0] {
            let last = signal(first[0].value + jump);
            let (from, to) = (Instant { t, inputs: &first }, Instant { t, inputs: &last });
            let mut planned = mechanism.solver().planned(&from).unwrap();
            let start = planned.q().to_vec();
            let mut slowly = mechanism.solver().planned(&from).unwrap();
            for k in 1..=400 {
                let told = signal(first[0].value + jump * f64::from(k) / 400.0);
                slowly.at(&Instant { t, inputs: &told }).unwrap();
            }
            let same = |what: &str, found: [&[f64]; 3]| {
                let expected = [slowly.q(), slowly.q_dot(), slowly.q_ddot()];
                for (found, expected) in found.into_iter().zip(expected) {
                    let size = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                    for (a, b) in found.iter().zip(expected) {
                        assert!((a - b).abs() < 1e-9 * size, "{what}, {pace} {quick} {jump}: {a} for {b}");
                    }
                }
            };
            if let Err(error) = planned.at(&to) {
                panic!("{pace} {quick} {jump}: {error}");
            }
            same("planned", [planned.q(), planned.q_dot(), planned.q_ddot()]);
            for use_plan in [true, false] {
                let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
                let mut tracker = solver.tracker_from(&from, &start).unwrap();
                let state = tracker.update(&to).unwrap_or_else(|error| panic!("{pace} {quick} {jump}: {error}"));
                same("tracked", [&state.q, &state.q_dot, &state.q_ddot]);
            }
        }
    }
}

/// An input that jumps beyond the range of the mechanism is refused at the end of the range, and the last state
/// remains.
#[test]
fn a_jump_beyond_the_range_is_refused() {
    for pace in [7.0, -20.0, 0.0, 300.0] {
        let mechanism = Swing { pace };
        let t = 0.3;
        let first = signal(0.2 - pace * t);
        for jump in [1.0, -1.4, 3.0] {
            let last = signal(first[0].value + jump);
            let mut planned = mechanism.solver().planned(&Instant { t, inputs: &first }).unwrap();
            let q = planned.q().to_vec();
            let error = planned.at(&Instant { t, inputs: &last }).map(|_| ()).unwrap_err();
            let PlanError::Limit { limit, .. } = error else { panic!("{error}") };
            assert_eq!(3, Swing::model().plan.steps[limit.step.index()].joints.len(), "{error}");
            assert_eq!((q.as_slice(), t), (planned.q(), planned.t()));
        }
    }
}

/// An input that is a function of time is treated like time itself: the plan solves every instant, near instants in one
/// step, with the same results.
#[test]
fn an_input_that_is_a_function_of_time_is_followed_by_the_plan() {
    let by_time = DoubleCrank { pace: 1.0, quick: 0.2 };
    let told = DoubleCrank { pace: 0.6, quick: 0.0 };
    let rest = |t: f64, inputs: &mut [Signal]| inputs[0] = Signal::new(t * (0.4 + 0.2 * t), 0.4 + 0.4 * t, 0.4);
    let nothing = |_: f64, inputs: &mut [Signal]| inputs[0] = Signal::default();
    for step in [0.01, 0.1, 1.0, 7.0] {
        for side in [1.0, -1.0] {
            let times: Vec<f64> = (0..=20).map(|k| side * step * f64::from(k)).collect();
            let expected = by_time.solver().with_inputs(&nothing).sweep(&times).unwrap();
            let found = told.solver().with_inputs(&rest).sweep(&times).unwrap();
            assert!(expected.fallbacks.is_empty() && found.fallbacks.is_empty(), "{step}: {:?}", found.fallbacks);
            for (a, b) in found.iter().zip(&expected) {
                for (a, b) in [(&a.q, &b.q), (&a.q_dot, &b.q_dot), (&a.q_ddot, &b.q_ddot)] {
                    let size = b.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                    a.iter().zip(b).for_each(|(x, y)| assert!((x - y).abs() < 1e-9 * size, "{step}: {x} for {y}"));
                }
            }
            assert!(found.iter().skip(1).all(|state| state.iterations == 1), "{step}");
        }
    }
}

/// A boom on a cylinder whose length jumps at t = 1, to a possible length and to impossible ones.
#[test]
fn a_jump_of_an_input_is_no_limit_of_the_mechanism() {
    for to in [1.2, 9.0, 1e6] {
        let jump = move |t: f64, u: &mut [Signal]| u[0] = Signal::constant(if t > 1.0 { to } else { 0.9 });
        let error = Lifted.solver().with_inputs(&jump).sweep(&[0.0, 0.5, 1.5]).unwrap_err();
        let SolveError::StepRefused { t, reason: Refusal::Discontinuous, limit: None, .. } = error.source else {
            panic!("{to}: {:?}", error.source)
        };
        assert!((t - 1.0).abs() < 1e-6, "{to}: {t}");
        assert!(error.to_string().contains("jumps there") && error.q_at_limit().is_none(), "{error}");
    }
}

#[mechanism]
#[bodies(boom)]
#[input(cylinder)]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[distance(lift: ground @ (0.5, -0.2), boom @ (1.0, 0.1), length = cylinder)]
#[guess(boom.phi = 0.7)]
struct Lifted;

/// A boom that a crank moves by a rod; the crank is held at the angle of an input.
#[mechanism]
#[body(crank, x = 0.6, y = 0, phi = turn)]
#[body(boom, x = 0, y = 0)]
#[input(turn)]
#[distance(rod: crank @ (0.45, 0), boom @ (0.8, 0), length = 0.2)]
#[guess(boom.phi = -0.4)]
struct Cranked;

/// A boom on a rod whose length is longest where the input is 0.
#[mechanism]
#[body(boom, x = 0, y = 0)]
#[input(turn)]
#[distance(rod: ground @ (0.6, 0), boom @ (1, 0), length = 0.9 + 0.9 * cos(turn))]
#[guess(boom.phi = 0.7)]
struct Cosine;

/// A boom that a motor turns by the square of the input, with a rod to a slider.
#[mechanism]
#[body(boom, x = 0, y = 0)]
#[bodies(slider)]
#[input(turn)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[distance(rod: slider @ (0, 0), boom @ (1, 0), length = 0.9)]
#[driver(drive: boom.phi = 1.5 - turn * turn)]
#[guess(slider.x = 1.6)]
struct Squared;

/// A boom on a rod whose length is a polynomial, longest where the input is 0.
#[mechanism]
#[body(boom, x = 0, y = 0)]
#[input(turn)]
#[distance(rod: ground @ (0.6, 0), boom @ (1, 0), length = 1.8 - turn * turn)]
#[guess(boom.phi = 0.7)]
struct Parabola;

/// A rod leans on a cart at the input and lifts a rider on a vertical guide; a boom with a stay follows up to 0.62.
#[mechanism]
#[body(rider, x = 0, phi = 0)]
#[body(cart, x = turn, y = 0, phi = 0)]
#[body(boom, x = 0.5, y = 0)]
#[input(turn)]
#[distance(rod: cart @ (0, 0), rider @ (0, 0), length = 1)]
#[distance(stay: rider @ (0, 0), boom @ (0.3, 0), length = 0.5)]
#[guess(rider.y = 0.5, boom.phi = 1.0)]
struct Lift;

/// Rates that are not those of the path tell nothing of an input that enters by its sine or square: the same place on the other
/// side of a dead centre is not reached.
#[test]
fn an_input_does_not_turn_past_a_limit_to_where_all_looks_the_same() {
    fn ends<M: Kinematics + Sync>(mechanism: &M, [low, high]: [f64; 2]) {
        let name = M::model().name;
        for (t, rate) in [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 2.4)] {
            let (from, to) = ([Signal::new(low, rate, 0.0)], [Signal::constant(high)]);
            let [from, to] = [Instant { t: 0.0, inputs: &from }, Instant { t, inputs: &to }];
            let solver = mechanism.solver();
            let mut planned = solver.planned(&from).unwrap();
            let start: Vec<Column<'_>> = planned.q().iter().map(|q| Column::Shared(*q)).collect();
            let error = planned.at(&to).map(|_| ()).unwrap_err();
            assert!(matches!(error, PlanError::Limit { .. }), "{name} {t} {rate}: {error}");
            let error = solver.tracker(&from).unwrap().update(&to).map(|_| ()).unwrap_err();
            assert!(error.limit().is_some(), "{name} {t} {rate}: {error}");
            let (values, rates) = ([low, high], [rate, 0.0]);
            let inputs = [Signal::new(Column::Each(&values), Column::Each(&rates), Column::Shared(0.0))];
            let modes = Modes::OfStart;
            let sweeps = Sweeps { parameters: &[], times: &[0.0, t], inputs: &inputs, modes, start: &start };
            let mut out = Motions::new(1, ());
            sweep(mechanism, &sweeps, &mut out, &always, |(), _| ()).unwrap();
            let end = out.ends().next().flatten();
            assert_eq!(Some(1), end.map(|end| end.instant), "{name} {t} {rate}");
        }
    }
    // Around 0 the pin of the crank is 1.05 from the foot of the boom, which reaches up to 1 with the rod.
    ends(&Cranked, [-1.5, TAU - 1.5]);
    // Both rods are 1.8 long there, and their ends at most 1.6 apart.
    ends(&Cosine, [-1.2, 1.2]);
    ends(&Parabola, [-0.9, 0.9]);
    // The boom would be higher than its rod is long.
    ends(&Squared, [-0.9, 0.9]);
    // The rod would lift the rider to 1.
    ends(&Lift, [-0.9, 0.9]);
    const { assert!(Cranked::INPUTS_CURVE && Cosine::INPUTS_CURVE && Squared::INPUTS_CURVE) };
    const { assert!(!MeasuredExcavator::INPUTS_CURVE && !Swing::INPUTS_CURVE && !Cosine::KNOWN_VALUES_CURVE) };
}

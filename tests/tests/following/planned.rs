//! A mechanism solved by its plan at successive instants: what an error names, and which state is kept after an error.

use kin_runtime::batch::{Column, End, Modes, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
use kin_runtime::plan::Depth;
use kin_runtime::planned::{PlanError, Planned, Sign};
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, Signal, mechanism};
use std::f64::consts::TAU;

/// A boom on a cylinder, and a stick; the cylinder's length and the angle between stick and boom are inputs, and time
/// is not used.
#[mechanism]
#[input(ram, tilt)]
#[bodies(boom, stick)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[distance(cylinder: ground @ (foot, 0), boom @ (arm, 0), length = ram)]
#[revolute(elbow: boom @ (1.5, 0), stick @ (0, 0))]
#[driver(turn: stick.phi = boom.phi + tilt + 0 * reach)]
#[guess(boom.phi = 0.8)]
struct Crane {
    #[param(1.0)]
    foot: f64,
    #[param(1.2)]
    arm: f64,
    #[param(0.0)]
    reach: f64,
}

const TOLD: [Signal; 2] = [Signal::new(0.9, 0.1, -0.2), Signal::new(0.3, 0.2, 0.1)];

fn said(result: Result<&Planned<'_, Crane>, PlanError>) -> String {
    result.map(Planned::t).unwrap_err().to_string()
}

#[test]
fn what_is_not_a_number_is_named_and_the_last_good_state_stays() {
    let (crane, good) = (Crane::default(), Instant { t: 0.5, inputs: &TOLD });
    let mut planned = crane.solver().planned(&good).unwrap();
    let before = [planned.q(), planned.q_dot(), planned.q_ddot()].map(<[f64]>::to_vec);
    for bad in [f64::NAN, f64::INFINITY] {
        for part in 0..3 {
            for (place, name) in [(0, "ram"), (1, "tilt")] {
                let mut told = TOLD;
                let number = &mut told[place];
                *[&mut number.value, &mut number.rate, &mut number.acceleration][part] = bad;
                let error = said(planned.at(&Instant { t: 0.6, inputs: &told }));
                assert_eq!(format!("the input `{name}` is not a finite number at t = 0.6"), error);
            }
        }
        assert!(said(planned.at(&Instant { t: bad, inputs: &TOLD })).starts_with("t is not a finite number"));
        for (place, name) in [(0, "foot"), (1, "arm")] {
            let mut broken = Crane::default();
            assert!(broken.set_parameter(place, bad));
            let error = Planned::new(&broken, &good, planned.q()).unwrap_err().to_string();
            assert_eq!(format!("the parameter `{name}` is not a finite number at t = 0.5"), error);
        }
    }
    assert_eq!(before, [planned.q(), planned.q_dot(), planned.q_ddot()].map(<[f64]>::to_vec));
    assert_eq!(0.5, planned.t());
    assert!(planned.at(&Instant { t: 0.6, inputs: &TOLD }).is_ok());
}

#[test]
fn a_restart_that_fails_leaves_the_modes_as_they_were() {
    let (crane, good) = (Crane::default(), Instant { t: 0.0, inputs: &TOLD });
    let mut planned = crane.solver().planned(&good).unwrap();
    let (q, sign) = (planned.q().to_vec(), planned.mode(0).unwrap());
    let other = crane.solver().with_mode(0, sign.flipped()).assemble(&good).unwrap();
    // Longer than `foot` and `arm` together.
    let long = [Signal::new(3.0, 0.0, 0.0), TOLD[1]];
    let error = planned.restart(&Instant { t: 0.1, inputs: &long }, &other).unwrap_err();
    assert!(matches!(error, PlanError::Limit { t: 0.1, limit } if limit.margin < 0.0), "{error}");
    assert_eq!((Some(sign), 0.0), (planned.mode(0), planned.t()));
    assert_eq!(q, planned.at(&good).unwrap().q());
    assert_eq!(Some(sign.flipped()), planned.restart(&good, &other).unwrap().mode("pin-cylinder"));
    assert_eq!(None, Sign::of(0.0));
}

/// A pin that runs in a slot whose pivot almost coincides with the crank's: the slot turns as fast as the crank, at
/// increasing speed.
#[mechanism]
#[bodies(crank, slot)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(D: ground @ (0.0001, 0), slot @ (0, 0))]
#[point_on_line(pin: slot @ (0, 0), crank @ (1, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 100 * t + 50 * t * t)]
#[guess(slot.phi = 0.01)]
struct Spinning;

#[test]
fn fast_bodies_go_on_counting_over_many_turns() {
    let slot = Spinning::model().coordinates.iter().position(|c| c.name == "slot.phi").unwrap();
    let mut planned = Spinning.solver().planned(&Instant::at(0.0)).unwrap();
    let begun = planned.q()[slot];
    for k in 1..=20 {
        // Several turns per step, and a contribution of the acceleration of more than a radian.
        let t = 0.2 * f64::from(k);
        let turned = planned.at(&Instant::at(t)).unwrap().q()[slot] - begun;
        assert!((turned - (100.0 + 50.0 * t) * t).abs() < 0.1, "{t}: {turned}, {} turns", turned / TAU);
    }
}

/// A double crank of any size.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.30*s, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.35*s, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (0.30*s, 0), ground @ (0.1*s, 0))]
#[driver(drive: crank.phi = t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
struct DoubleCrank {
    #[param(1.0)]
    s: f64,
}

/// A platform on three driven cranks, of any size: its plan has an iteration.
#[mechanism]
#[bodies(crank[3], link[3], platform)]
#[revolute(O0: ground @ (0, 0), crank[0] @ (0, 0))]
#[revolute(O1: ground @ (s, 0), crank[1] @ (0, 0))]
#[revolute(O2: ground @ (0.5*s, 0.9*s), crank[2] @ (0, 0))]
#[revolute(A[i in 0..3]: crank[i] @ (0.3*s, 0), link[i] @ (0, 0))]
#[revolute(B0: link[0] @ (0.4*s, 0), platform @ (-0.12*s, -0.1*s))]
#[revolute(B1: link[1] @ (0.4*s, 0), platform @ (0.12*s, -0.1*s))]
#[revolute(B2: link[2] @ (0.4*s, 0), platform @ (0, 0.13*s))]
#[driver(d0: crank[0].phi = 0.8 + 0.5 * sin(t))]
#[driver(d1: crank[1].phi = 2.6 + 0.5 * sin(t + 1))]
#[driver(d2: crank[2].phi = 4.6 + 0.5 * sin(t + 2))]
#[guess(platform.x = 0.5*s, platform.y = 0.33*s, platform.phi = 0)]
struct Platform {
    #[param(1.0)]
    s: f64,
}

/// The angles at every instant.
struct Angles {
    /// By [`Planned`]; `None` where it returns an error.
    one: Vec<Option<Vec<f64>>>,
    /// In a batch, and the instant at which the motion ends.
    batch: Vec<Vec<f64>>,
    end: Option<usize>,
}

fn angles<M: Kinematics + Sync>(mechanism: &M, times: &[f64]) -> Angles {
    let is_angle = |k: &usize| M::model().coordinates[*k].name.ends_with("phi");
    let pick = |q: &[f64]| (0..M::COORDINATES).filter(is_angle).map(|k| q[k]).collect::<Vec<_>>();
    let mut planned = mechanism.solver().planned(&Instant::at(times[0])).unwrap();
    let start: Vec<_> = planned.q().iter().map(|q| Column::Shared(*q)).collect();
    let one = times.iter().map(|t| planned.at(&Instant::at(*t)).ok().map(|planned| pick(planned.q()))).collect();
    let own = mechanism.parameters::<f64>();
    let parameters: Vec<_> = own.as_ref().iter().map(|p| Column::Shared(*p)).collect();
    let sweeps = Sweeps { parameters: &parameters, times, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(1, Vec::new());
    sweep(mechanism, &sweeps, &mut out, &always, |seen: &mut Vec<Vec<f64>>, moment| {
        let q: Vec<f64> = moment.q.iter().map(|x| x.to_array()[0]).collect();
        seen.push(pick(&q));
    })
    .unwrap();
    let (batch, end) = (out.blocks().next().unwrap().clone(), out.ends().next().flatten());
    Angles { one, batch, end: end.map(|end: End| end.instant) }
}

#[test]
fn no_unit_of_length_changes_predictions() {
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    let mut compared = 0;
    for k in 1..=40 {
        // Many of these steps are far too long; even then the result must not depend on the unit of length.
        let (far, near_by) = (0.2 + 0.0075 * f64::from(k), TAU / f64::from(4 + k));
        let times = |step: f64| (0..=20).map(|i| step * f64::from(i)).collect::<Vec<_>>();
        let cranks = [1e-3, 1.0, 1e3].map(|s| angles(&DoubleCrank { s }, &times(TAU * far)));
        let platforms = [1e-3, 1.0, 1e3].map(|s| angles(&Platform { s }, &times(near_by)));
        for [small, own, large] in [cranks, platforms] {
            for other in [small, large] {
                assert_eq!(own.end, other.end, "steps number {k}: the batch ends elsewhere");
                assert!(own.batch.iter().zip(&other.batch).all(|(a, b)| near(a, b)), "steps number {k} in a batch");
                for (place, pair) in own.one.iter().zip(&other.one).enumerate() {
                    let same = match pair {
                        (Some(a), Some(b)) => near(a, b),
                        pair => pair.0.is_none() && pair.1.is_none(),
                    };
                    assert!(same, "steps number {k}, instant {place}: {pair:?}");
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 40 * 4 * 21);
}

#[test]
fn a_start_that_does_not_decide_a_mode_has_no_answer() {
    let crank = DoubleCrank::default();
    let at = |start: f64| {
        let columns = [Column::Shared(start); 9];
        let (parameters, t, modes) = (&[Column::Shared(1.0)], Column::Shared(0.7), Modes::OfStart);
        let problems = Problems { parameters, t, inputs: &[], modes, start: &columns };
        let mut out = Solutions::<DoubleCrank>::new(1);
        solve(&crank, Depth::Acceleration, &problems, &mut out, &always).unwrap();
        let mut ends = Motions::new(1, Lanes::default());
        let sweeps = Sweeps { parameters, times: &[0.7], inputs: &[], modes, start: &columns };
        sweep(&crank, &sweeps, &mut ends, &always, |_, _| ()).unwrap();
        let one = Planned::new(&crank, &Instant::at(0.7), &[start; 9]).map(|planned| planned.q()[8]);
        let ended = ends.ends().next().flatten().is_some();
        (one, (out.solved().next() == Some(true) && !ended).then(|| out.q(8).next().unwrap()))
    };
    for start in [0.0, -0.0, f64::NAN] {
        let (one, batch) = at(start);
        let error = one.unwrap_err();
        if start.is_nan() {
            assert!(matches!(error, PlanError::NonFinite { what: "q", index: 0, name: "crank.x", .. }), "{error}");
        } else {
            assert!(matches!(error, PlanError::Undecided { t: 0.7, mode: "A-B-D" }), "{start}: {error}");
            assert_eq!(
                error.to_string(),
                "at t = 0.7, the start does not determine the mode A-B-D: its two closures coincide there, or a number is NaN"
            );
        }
        assert_eq!(batch, None, "{start}");
    }
    for start in [0.5, -0.5] {
        let (one, batch) = at(start);
        assert!((one.unwrap() - batch.unwrap()).abs() < 1e-12, "{start}");
    }
    // A mode given as 0 or NaN is an error.
    let columns = [Column::Shared(0.5); 9];
    for (sign, good) in [(1.0, true), (-3.0, true), (0.0, false), (-0.0, false), (f64::NAN, false)] {
        let (parameters, signs) = (&[Column::Shared(1.0)], [Column::Shared(sign)]);
        let (t, modes) = (Column::Shared(0.7), Modes::Signs(&signs));
        let problems = Problems { parameters, t, inputs: &[], modes, start: &columns };
        let mut out = Solutions::<DoubleCrank>::new(1);
        solve(&crank, Depth::Acceleration, &problems, &mut out, &always).unwrap();
        assert_eq!(out.solved().next(), Some(good), "{sign}");
    }
}

//! Rows whose slopes grow so fast that the terms of an acceleration cancel: `tan(u) = 1/(1 − t)` means u = π/2 − s with
//! s ≈ 1 − t, and so u̇ ≈ 1 and ü ≈ 2s, while the terms of the row grow as 1/s³.

use super::jumps::reached;
use kin_runtime::batch::{Column, Modes, Moment, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, Options, PlanError, Planned, SolveError, mechanism};

#[mechanism]
#[coordinates(u)]
#[driver(turn: tan(u) = 1 / (end - t))]
#[guess(u = 0.78)]
struct OfNumber {
    end: f64,
}

#[mechanism]
#[body(arm, x = 0, y = 0)]
#[constraint(turn: tan(arm.phi) = 1 / (end - t))]
#[guess(arm.phi = 0.78)]
struct OfAngle {
    end: f64,
}

/// u̇ and ü at a distance s from the pole.
fn rates(s: f64) -> [f64; 2] {
    let square = 1.0 + s * s;
    [1.0 / square, 2.0 * s / (square * square)]
}

fn are_near([v, a]: [f64; 2], s: f64) -> bool {
    let expected = rates(s);
    (v - expected[0]).abs() <= 1e-9 && (a - expected[1]).abs() <= 1e-7
}

fn is_right_or_refused<M: Mechanism + Sync>(mechanism: &M) {
    for n in 2..=11 {
        let t = 1.0 - 0.1_f64.powi(n);
        let s = 1.0 - t;
        // Rounding of u by ε changes ü by about ε/s².
        let has_rates = n <= 4;
        for parts in [1, 3, 10] {
            let times: Vec<f64> = (0..=parts).map(|k| t * f64::from(k) / f64::from(parts)).collect();
            let expected = if has_rates { times.len() } else { times.len() - 1 };
            assert_eq!([expected; 5], reached(mechanism, &times), "10^-{n} in {parts} parts");
            for use_plan in [true, false] {
                let options = Options { use_plan, ..Options::default() };
                let found = mechanism.solver().with_options(options).sweep(&times);
                match &found {
                    Ok(found) => {
                        let last = found.states.last().expect("there are states");
                        assert!(are_near([last.q_dot[0], last.q_ddot[0]], s), "10^-{n}: {last:?}");
                    }
                    Err(error) => {
                        let said = error.to_string();
                        assert!(said.contains("rounding errors dominate the rates there"), "{said}");
                    }
                }
            }
        }
        let mut planned = mechanism.solver().planned(&Instant::at(0.0)).expect("it closes");
        match planned.at(&Instant::at(t)) {
            Ok(found) => assert!(has_rates && are_near([found.q_dot()[0], found.q_ddot()[0]], s), "10^-{n}"),
            Err(error) => assert!(!has_rates && matches!(error, PlanError::Rounded { .. }), "10^-{n}: {error}"),
        }
        // From the guess, the iteration does not reach every root.
        match mechanism.solver().state(&Instant::at(t)) {
            Ok(found) => assert!(has_rates && are_near([found.q_dot[0], found.q_ddot[0]], s), "10^-{n}: {found:?}"),
            Err(SolveError::Rounded { .. }) => assert!(!has_rates, "10^-{n}"),
            Err(error) => assert!(n >= 8, "10^-{n}: {error}"),
        }
    }
}

#[test]
fn an_acceleration_is_right_or_refused_where_a_number_has_steep_rows() {
    is_right_or_refused(&OfNumber { end: 1.0 });
}

#[test]
fn an_acceleration_is_right_or_refused_where_an_angle_has_steep_rows() {
    is_right_or_refused(&OfAngle { end: 1.0 });
}

/// Beside a pole the residual of a row is large, although it is small relative to the slope there.
#[test]
fn a_pole_is_no_root() {
    let start = std::f64::consts::FRAC_PI_2;
    for near in [1e-3, 1e-9, 1e-13, 0.0] {
        let number = OfNumber { end: 1.0 };
        let solver = number.solver();
        if let Ok(found) = solver.with_guess(0, start - near).state(&Instant::at(0.5)) {
            assert!((found.q[0].tan() - 2.0).abs() < 1e-9, "{near}: {found:?}");
        }
    }
}

/// A carriage whose row has a pole.
#[mechanism]
#[body(carriage, y = 0, phi = 0)]
#[driver(push: 1 / (carriage.x - a) = 2 + t)]
#[guess(carriage.x = 0.8)]
struct OfLength {
    a: f64,
}

/// What batches find at t = 0.5 from this start, position alone and a motion.
fn in_batches<M: Mechanism + Sync>(mechanism: &M, at_start: f64, is_root: &dyn Fn(f64) -> bool) {
    let (start, parameter) = ([Column::Shared(at_start)], mechanism.parameters::<f64>().as_ref()[0]);
    let parameters = [Column::Shared(parameter)];
    for depth in [Depth::Position, Depth::Acceleration] {
        let (t, modes) = (Column::Shared(0.5), Modes::OfStart);
        let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
        let mut out = Solutions::<M>::new(1);
        solve(mechanism, depth, &problems, &mut out, &always).expect("columns of the right length");
        let is_solved = out.solved().next() == Some(true);
        assert!(!is_solved || out.q(0).all(is_root), "{start:?}");
    }
    let modes = Modes::OfStart;
    let sweeps = Sweeps { parameters: &parameters, times: &[0.5], inputs: &[], modes, start: &start };
    let mut out = Motions::new(1, Lanes::from(f64::NAN));
    let show = |found: &mut Lanes, moment: &Moment<'_>| *found = moment.q[0];
    sweep(mechanism, &sweeps, &mut out, &always, show).expect("columns of the right length");
    let reached = out.ends().all(|end| end.is_none());
    assert!(!reached || out.scores(|found| *found).all(is_root), "{start:?}");
    assert_eq!(reached, Planned::new(mechanism, &Instant::at(0.5), &[at_start]).is_ok(), "{at_start}");
}

#[test]
fn the_plan_takes_no_pole_for_a_root() {
    let at = Instant::at(0.5);
    assert!(Planned::new(&OfLength { a: 0.3 }, &at, &[0.65]).is_ok());
    let (number, angle) = (OfNumber { end: 1.0 }, OfAngle { end: 1.0 });
    for near in [1e-8, 3e-9, 1e-9, 1e-10, 1e-13, 0.0, -1e-13, -1e-9] {
        let pole = std::f64::consts::FRAC_PI_2 - near;
        if let Ok(found) = Planned::new(&number, &at, &[pole]) {
            assert!((found.q()[0].tan() - 2.0).abs() < 1e-9, "{near}: {:?}", found.q());
        }
        in_batches(&number, pole, &|u| (u.tan() - 2.0).abs() < 1e-9);
        in_batches(&angle, pole, &|u| (u.tan() - 2.0).abs() < 1e-9);
        if let Ok(found) = Planned::new(&angle, &at, &[pole]) {
            assert!((found.q()[0].tan() - 2.0).abs() < 1e-9, "{near}: {:?}", found.q());
        }
        for a in [1e-3, 0.3, -7.0] {
            let length = OfLength { a };
            if let Ok(found) = Planned::new(&length, &at, &[a * (1.0 - near)]) {
                assert!((found.q()[0] - a - 0.4).abs() < 1e-9, "{near}: {:?}", found.q());
            }
            in_batches(&length, a * (1.0 - near), &|x| (x - a - 0.4).abs() < 1e-9);
        }
    }
}

/// The acceleration of a given configuration, too.
#[test]
fn the_acceleration_of_a_configuration_is_right_or_refused() {
    let (number, angle) = (OfNumber { end: 1.0 }, OfAngle { end: 1.0 });
    for n in 2..=9 {
        let at = Instant::at(1.0 - 0.1_f64.powi(n));
        let s = 1.0 - at.t;
        let q = [(1.0 / s).atan()];
        for found in [
            number.solver().velocity(&at, &q).and_then(|v| number.solver().acceleration(&at, &q, &v)),
            angle.solver().velocity(&at, &q).and_then(|v| angle.solver().acceleration(&at, &q, &v)),
        ] {
            match found {
                Ok(a) => assert!(n <= 4 && (a[0] - rates(s)[1]).abs() <= 1e-7, "10^-{n}: {a:?}"),
                Err(error) => assert!(n > 4 && matches!(error, SolveError::Rounded { .. }), "10^-{n}: {error}"),
            }
        }
    }
}

/// Step by step, the motion ends where ε |u| w² exceeds 4·10⁻⁶ with w = 2/s, at s = 1.9·10⁻⁵.
#[test]
fn all_ways_end_at_the_same_instant_of_a_fine_grid() {
    let mut distances = vec![1.0, 0.3, 0.1, 0.03, 0.01];
    while distances.last().is_some_and(|s| *s > 1e-7) {
        distances.extend(distances.last().map(|s| 0.9 * s));
    }
    let times: Vec<f64> = distances.iter().map(|s| 1.0 - s).collect();
    let expected = distances.iter().filter(|s| **s > 1.868e-5).count();
    assert_eq!([expected; 5], reached(&OfNumber { end: 1.0 }, &times));
    assert_eq!([expected; 5], reached(&OfAngle { end: 1.0 }, &times));
}

//! Sweeps, trackers and assembly with a plan that was written by hand, against full Newton.

use super::agree;
use crate::fixture::{FlatParallelogram, PlannedFourBar};
use crate::{Instant, Kinematics, Options, PlanError, Sign, Signal, SolveError, Solver, Trajectory};

/// Full Newton.
fn newton<M: Kinematics>(mechanism: &M) -> Solver<'_, M> {
    mechanism.solver().with_options(Options { use_plan: false, ..Options::default() })
}

fn same(a: &Trajectory, b: &Trajectory) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!((a.t, a.degrees_of_freedom_left), (b.t, b.degrees_of_freedom_left));
        agree(&a.q, &b.q, 1e-13);
        agree(&a.q_dot, &b.q_dot, 1e-12);
        agree(&a.q_ddot, &b.q_ddot, 1e-11);
        // An estimate by pivots, of which several are equal but for rounding.

        assert!(a.residual < 1e-14, "{}", a.residual);
    }
}

#[test]
fn a_sweep_by_the_plan_is_that_of_full_newton() {
    let mechanism = PlannedFourBar::default();
    let fine: Vec<f64> = (0..=80).map(|k| 0.01 * f64::from(k)).collect();
    for times in [&fine[..], &[0.0, 0.8, -0.9, 0.1]] {
        let planned = mechanism.solver().sweep(times).unwrap();
        same(&planned, &newton(&mechanism).sweep(times).unwrap());
        assert!(planned.fallbacks.is_empty());
    }
    // One solution per instant, where Newton needs more.
    let iterations = |t: &Trajectory| t.iter().skip(1).map(|s| s.iterations).sum::<usize>();
    assert_eq!(iterations(&mechanism.solver().sweep(&fine).unwrap()), 80);
    assert!(iterations(&newton(&mechanism).sweep(&fine).unwrap()) > 80);
}

#[test]
fn full_newton_takes_over_where_the_plan_says_nothing_and_it_is_said() {
    let times = [0.0, 0.1, 0.2, 0.3];
    let expected = newton(&PlannedFourBar::default()).sweep(&times).unwrap();
    let singular = PlannedFourBar { margin: Some(0.0), ..PlannedFourBar::default() };
    let found = singular.solver().sweep(&times).unwrap();
    same(&found, &expected);
    assert_eq!(found.fallbacks.iter().map(|f| f.t).collect::<Vec<_>>(), times[1..]);
    assert_eq!(
        found.fallbacks[0].to_string(),
        "at t = 0.1: dyad RRR of A, B, D is at its limit: A, B and D on one line"
    );
    assert!(newton(&singular).sweep(&times).unwrap().fallbacks.is_empty());

    let mut tracker = singular.solver().tracker(&Instant::at(0.0)).unwrap();
    tracker.update(&Instant::at(0.1)).unwrap();
    assert_eq!(tracker.fallbacks().len(), 1);
    tracker.update(&Instant::at(0.2)).unwrap();
    assert_eq!(tracker.fallbacks().iter().map(|f| f.t).collect::<Vec<_>>(), [0.2]);
}

#[test]
fn a_plan_that_does_not_close_is_not_believed() {
    let times = [0.0, 0.1, 0.2, 0.3];
    let wrong = PlannedFourBar { mistake: 1e-9, ..PlannedFourBar::default() };
    let found = wrong.solver().sweep(&times).unwrap();
    same(&found, &newton(&PlannedFourBar::default()).sweep(&times).unwrap());
    assert_eq!(found.fallbacks.len(), 3);
    assert_eq!(found.fallbacks[2].limit, None);
}

#[test]
fn where_the_branch_ends_the_dyad_is_named() {
    let mechanism = PlannedFourBar { start: 0.0, ..PlannedFourBar::default() };
    let end = PlannedFourBar::limit();
    for times in [[0.0, 0.5, 2.0], [0.0, 1.0, end + 1e-3]] {
        let (error, by_newton) =
            (mechanism.solver().sweep(&times).unwrap_err(), newton(&mechanism).sweep(&times).unwrap_err());
        same(&error.trajectory, &by_newton.trajectory);
        let (SolveError::Singular { t, rows, .. }, SolveError::Singular { t: t_newton, rows: rows_newton, .. }) =
            (&error.source, &by_newton.source)
        else {
            panic!("{error} {by_newton}")
        };
        assert!((t - end).abs() < 1e-9 && (t - t_newton).abs() < 1e-9, "{t} {t_newton} {end}");
        assert_eq!(rows, rows_newton);
        let limit = error.source.limit().unwrap();
        assert_eq!(limit.step.to_string(), "dyad RRR of A, B, D");
        assert!(limit.margin < 1e-9, "{}", limit.margin);
        assert!(error.to_string().contains("coupler and rocker of dyad RRR of A, B, D lock at t = 1.09468"), "{error}");
        assert_eq!(Some(limit), by_newton.source.limit());
    }
    // At an instant beyond the limit, and at the limit itself.
    let error = mechanism.state_at(&Instant::at(end + 0.1)).unwrap_err();
    assert!(matches!(error, SolveError::NotAssembled { .. }), "{error}");
    assert!((error.limit().unwrap().margin + 0.108).abs() < 1e-3, "{error}");
    let error = mechanism.state_at(&Instant::at(end)).unwrap_err();
    assert!(matches!(error, SolveError::Singular { .. }), "{error}");
    assert!(error.limit().unwrap().margin.abs() < 1e-12, "{error}");
    let mut tracker = mechanism.solver().tracker(&Instant::at(0.0)).unwrap();
    let error = tracker.update(&Instant::at(end + 0.1)).unwrap_err();
    assert!(error.limit().is_some(), "{error}");
    assert!(tracker.update(&Instant::at(0.1)).is_ok());
}

#[test]
fn a_crossing_of_branches_is_not_passed() {
    let flat = PlannedFourBar::parallelogram(-0.3);
    for times in [&[0.0, 0.6][..], &[0.0, 0.299, 0.301], &[0.0, 0.29, 0.2999, 0.35]] {
        let (planned, by_newton) = (flat.solver().sweep(times).unwrap_err(), newton(&flat).sweep(times).unwrap_err());
        assert_eq!(planned.trajectory.len(), by_newton.trajectory.len());
        for (a, b) in planned.trajectory.iter().zip(&by_newton.trajectory.states) {
            // A thousandth beside the crossing the condition number is a thousand.
            agree(&a.q, &b.q, 1e-11);
        }
        let SolveError::Singular { t, .. } = planned.source else { panic!("{planned}") };
        assert!((t - 0.3).abs() < 1e-3, "{t}");
    }
}

#[test]
fn modes_are_listed_asked_for_and_refused() {
    let mechanism = PlannedFourBar::default();
    let at = Instant::at(0.0);
    assert_eq!(PlannedFourBar::modes().iter().map(|mode| mode.name).collect::<Vec<_>>(), ["A-B-D"]);
    let q = mechanism.solver().assemble(&at).unwrap();
    let [mode] = &mechanism.solver().modes(&at, &q).unwrap()[..] else { panic!() };
    assert_eq!((mode.name, mode.group, &mode.joints[..]), ("A-B-D", "RRR", &["A", "B", "D"][..]));
    let sign = mode.sign.unwrap();
    assert!(mode.closure.abs() > 0.1 && mode.closure.abs() <= 1.0);

    // The sign that it has changes nothing; the other one is another configuration, as good as the first.
    assert_eq!(mechanism.solver().with_mode("A-B-D", sign).assemble(&at).unwrap(), q);
    let flipped = mechanism.solver().with_mode(0, sign.flipped());
    let other = flipped.state(&at).unwrap();
    assert!((other.q[5] - q[5]).abs() > 0.1 && other.residual < 1e-15);
    assert_eq!(flipped.modes(&at, &other.q).unwrap()[0].sign, Some(sign.flipped()));
    // What was asked for last counts.
    assert_eq!(flipped.clone().with_mode("A-B-D", sign).assemble(&at).unwrap(), q);
    let sweep = flipped.sweep(&[0.0, 0.4]).unwrap();
    assert_eq!(flipped.modes(&at, &sweep.states[1].q).unwrap()[0].sign, Some(sign.flipped()));
    let tracked = flipped.tracker(&at).unwrap();
    agree(&tracked.state().q, &other.q, 1e-15);
    assert_eq!(flipped.planned(&at).unwrap().mode(0), Some(sign.flipped()));

    let error = mechanism.solver().with_mode("A-B-C", Sign::Plus).state(&at).unwrap_err();
    assert_eq!(error.to_string(), "there is no mode `A-B-C`; there are `A-B-D`");
    let error = mechanism.solver().with_mode(1, Sign::Plus).state(&at).unwrap_err();
    assert!(matches!(error, SolveError::UnknownMode { .. }), "{error}");
    let far = Instant::at(1.1);
    let error = mechanism.solver().with_mode(0, Sign::Minus).state(&far).unwrap_err();
    let SolveError::ModeNotAssembled { modes, limit: Some(limit), .. } = &error else { panic!("{error}") };
    assert_eq!(modes, &[("A-B-D", Sign::Minus)]);
    assert!(limit.margin < -0.1 && limit.step.closes());
    assert!(
        error.to_string().starts_with("not assembled at t = 1.1 in the mode A-B-D = -; dyad RRR of A, B, D cannot")
    );
}

#[test]
fn modes_need_a_plan() {
    let flat = FlatParallelogram { start: 0.3 };
    let at = Instant::at(0.0);
    let q = flat.solver().assemble(&at).unwrap();
    let no_plan = SolveError::Plan(PlanError::NoPlan { why: "written by hand" });
    assert_eq!(flat.solver().modes(&at, &q).unwrap_err(), no_plan);
    assert_eq!(flat.solver().with_mode("A", Sign::Plus).assemble(&at).unwrap_err(), no_plan);
    assert_eq!(flat.solver().planned(&at).unwrap_err(), no_plan);
    // Prescribed coordinates have no part in a plan.
    let bar = PlannedFourBar::default();
    let given = bar.solver().with_given(2, Signal::new(0.3, 1.0, 0.0));
    let error = given.planned(&at).unwrap_err();
    assert_eq!(error.to_string(), "no plan because coordinates are prescribed");
}

#[test]
fn assembly_from_a_poor_guess_in_a_mode() {
    let mechanism = PlannedFourBar::default();
    let at = Instant::at(0.0);
    for sign in [Sign::Plus, Sign::Minus] {
        for angle in [0.0, 1.0, 3.0, -2.0] {
            let solver = mechanism.solver().with_guess(5, angle).with_guess(8, -angle).with_mode(0, sign);
            let state = solver.state(&at).unwrap();
            assert_eq!(solver.modes(&at, &state.q).unwrap()[0].sign, Some(sign));
        }
    }
}

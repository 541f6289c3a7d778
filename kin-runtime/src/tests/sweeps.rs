//! Sweeps: the same branch however far the instants are apart, and none where the branch ends.

use super::agree;
use crate::fixture::{FiveBar, FlatParallelogram, FourBarLoop, Squeezer, StretchedSlider};
use crate::{Instant, Kinematics, Mechanism, SolveError};

/// q̇ and q̈ against central differences of the trajectory.
fn differences<M: Mechanism>(mechanism: &M, centre: f64, h: f64, tolerance: f64) {
    let times: Vec<f64> = (-2..=2).map(|k| centre + f64::from(k) * h).collect();
    let states = mechanism.kinematic_analysis(&times).unwrap().states;
    let rate = |f: fn(&crate::State) -> &Vec<f64>, k: usize| {
        let at = |i: usize| f(&states[i])[k];
        (8.0 * (at(3) - at(1)) - (at(4) - at(0))) / (12.0 * h)
    };
    let n = M::COORDINATES;
    let q_dot: Vec<f64> = (0..n).map(|k| rate(|s| &s.q, k)).collect();
    let q_ddot: Vec<f64> = (0..n).map(|k| rate(|s| &s.q_dot, k)).collect();
    agree(&q_dot, &states[2].q_dot, tolerance);
    agree(&q_ddot, &states[2].q_ddot, tolerance);
}

#[test]
fn rates_are_those_of_the_trajectory() {
    differences(&FourBarLoop::default(), 0.7, 1e-3, 1e-8);
    differences(&Squeezer, 0.01, 2e-5, 1e-7);
    differences(&StretchedSlider, 0.2, 1e-3, 1e-7);
}

#[test]
fn an_arc_without_steps_is_its_start() {
    let states = FourBarLoop::default().solver().sweep_along_arc(0.0, Some(0.5), 0).unwrap().states;
    assert!(
        states.len() == 1 && states[0].t.abs() < 1e-9,
        "{:?}",
        states.iter().map(|state| state.t).collect::<Vec<_>>()
    );
}

#[test]
fn far_apart_instants_give_the_same_branch() {
    let mechanism = FourBarLoop::default();
    let turns = 20.0 * core::f64::consts::TAU / 2.3;
    let fine: Vec<f64> = (0..=4000).map(|k| turns * f64::from(k) / 4000.0).collect();
    let fine = mechanism.kinematic_analysis(&fine).unwrap();
    let coarse = mechanism.kinematic_analysis(&[0.0, turns]).unwrap();
    let last = coarse.last().unwrap();
    agree(&last.q, &fine.last().unwrap().q, 1e-11);
    // Angles go on counting: the crank has turned, coupler and rocker have come back.
    let first = &coarse.states[0].q;
    agree(&last.q, &[first[0] + 20.0 * core::f64::consts::TAU, first[1], first[2]], 1e-11);
    for state in &fine {
        assert!(state.residual < 1e-13);
    }
}

#[test]
fn backwards_and_repeated_instants_return() {
    let mechanism = FourBarLoop::default();
    let states = mechanism.kinematic_analysis(&[0.0, 3.0, 3.0, -2.0, 0.0]).unwrap().states;
    agree(&states[1].q, &states[2].q, 0.0);
    agree(&states[0].q, &states[4].q, 1e-12);
    assert!(mechanism.kinematic_analysis(&[]).unwrap().is_empty());
}

#[test]
fn the_squeezer_turns_and_returns() {
    let times: Vec<f64> = (0..=300).map(|k| 1e-4 * f64::from(k)).collect();
    let fine = Squeezer.kinematic_analysis(&times).unwrap();
    let coarse = Squeezer.kinematic_analysis(&[0.0, 0.03]).unwrap();
    agree(&coarse.last().unwrap().q, &fine.last().unwrap().q, 1e-12);
    agree(&coarse.last().unwrap().q_ddot, &fine.last().unwrap().q_ddot, 1e-9);
    let long = Squeezer.kinematic_analysis(&[0.0, 0.2, 0.0]).unwrap();
    agree(&long.states[2].q, &long.states[0].q, 1e-11);
}

#[test]
fn the_end_of_the_range_is_an_error_near_its_time() {
    for last in [0.475, 0.476, 0.6, 5.0, 1e6] {
        for inner in [vec![], vec![0.2, 0.46]] {
            let times: Vec<f64> = [0.0].into_iter().chain(inner.clone()).chain([last]).collect();
            let error = StretchedSlider.kinematic_analysis(&times).unwrap_err();
            assert_eq!(error.trajectory.len(), inner.len() + 1);
            let t = match error.source {
                SolveError::Singular { t, .. } | SolveError::StepRefused { t, .. } => t,
                ref other => panic!("{other}"),
            };
            assert!((0.4749..0.475 + 1e-9).contains(&t), "{error} at {t}");
        }
    }
    // Just before it all is well.
    let state = StretchedSlider.kinematic_analysis(&[0.0, 0.475 - 1e-9]).unwrap().states.remove(1);
    assert!(state.q[2] > 0.0 && state.q[2] < 1e-3);
}

#[test]
fn a_crossing_of_branches_is_not_passed() {
    for start in [-0.5, 0.37] {
        let mechanism = FlatParallelogram { start };
        let to = -2.0 * start;
        // One branch has its rocker parallel to the crank, the other mirrored.
        for rocker in [start, -start] {
            let solver = mechanism.solver().with_guess(8, rocker).with_guess(5, 0.5 * (rocker - start));
            let error = solver.sweep(&[0.0, to]).unwrap_err();
            let (SolveError::Singular { t, .. } | SolveError::StepRefused { t, .. }) = error.source else {
                panic!("{error}")
            };
            assert!((t + start).abs() < 1e-3, "{error}: {t}");
        }
    }
}

#[test]
fn an_under_driven_sweep_stays_assembled() {
    let times: Vec<f64> = (0..=20).map(|k| 0.1 * f64::from(k)).collect();
    let trajectory = FiveBar.kinematic_analysis(&times).unwrap();
    for state in &trajectory {
        assert!(state.residual < 1e-13 && state.degrees_of_freedom_left == 1);
    }
    let column = trajectory.column("crank1.phi").unwrap();
    assert!((column[20] - 2.4).abs() < 1e-12);
    assert_eq!(trajectory.column("crank1.phi_dot").map(|c| (c[3] * 1e9).round()), Some(6e8));
    assert_eq!(trajectory.column("t"), Some(times));
    assert_eq!(trajectory.column("nothing"), None);
}

#[test]
fn a_state_can_be_solved_again_from_itself() {
    let state = Squeezer.state_at(&Instant::at(0.0)).unwrap();
    let again = Squeezer.solver().state_from(&Instant::at(0.0), &state.q).unwrap();
    agree(&again.q, &state.q, 1e-14);
}

/// An observer is told every instant and the steps between them, changes nothing, and may end it all.
#[test]
fn an_observer_is_told_and_may_end_it() {
    use core::cell::RefCell;
    use core::ops::ControlFlow;
    let mechanism = FourBarLoop::default();
    let times = [0.0, 2.0, 4.0, 3.0];
    let told = RefCell::new(Vec::new());
    let listen = |reached: crate::Reached<'_>| {
        assert_eq!(reached.total, times.len());
        assert!(reached.state.is_none_or(|state| state.t == reached.t));
        told.borrow_mut().push((reached.done, reached.t, reached.state.is_some()));
        ControlFlow::Continue(())
    };
    let solver = crate::Solver::new(&mechanism);
    let whole = solver.clone().with_observer(&listen).sweep(&times).unwrap();
    assert_eq!(whole, solver.sweep(&times).unwrap());
    let told = told.into_inner();
    let instants: Vec<f64> = told.iter().filter(|(_, _, state)| *state).map(|(_, t, _)| *t).collect();
    assert_eq!(instants, times);
    assert!(told.windows(2).all(|pair| pair[0].0 <= pair[1].0 && pair[0].1 != pair[1].1));
    assert!(told.len() > 20, "a turn takes several steps: {told:?}");
    assert!(told.iter().all(|(done, t, state)| *state || (times[done - 1] - t) * (times[*done] - t) < 0.0));

    for end in 0..told.len() {
        let count = core::cell::Cell::new(0);
        let stop = |_: crate::Reached<'_>| {
            count.set(count.get() + 1);
            if count.get() > end { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let ended = solver.clone().with_observer(&stop).sweep(&times);
        let (done, t, _) = told[end];
        if end + 1 == told.len() {
            assert_eq!(ended.unwrap(), whole, "who stops it with the last instant has all of them");
        } else {
            let error = ended.unwrap_err();
            assert_eq!(error.source, SolveError::Stopped { t, done, total: times.len() });
            assert_eq!(error.trajectory.states, whole.states[..done]);
        }
    }
    let twice = |reached: crate::Reached<'_>| {
        if reached.done == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let options = crate::CrossCheckOptions { configurations: 5, ..crate::CrossCheckOptions::default() };
    let ended = solver.with_observer(&twice).cross_check(&options);
    assert!(matches!(ended, Err(SolveError::Stopped { done: 2, total: 5, .. })), "{ended:?}");
}

//! Conditions that change faster than the motion: each crossing is found, or the trajectory reports where the condition
//! was not watched.

use super::*;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicUsize, Ordering};
use kin_runtime::Reached;
use kin_runtime::function::FromFn;

/// A coordinate that moves uniformly.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = t)]
#[unilateral(n: sin(k * u) > c)]
struct Steady {
    #[param(1)]
    k: f64,
    #[param(0.3)]
    c: f64,
}

/// A coordinate that moves back and forth, with one condition on the coordinate and one on t.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = 3 * sin(t))]
#[unilateral(n: sin(k * u) > c)]
#[unilateral(timed: cos(k * t) < c)]
struct Swinging {
    #[param(1)]
    k: f64,
    #[param(0.3)]
    c: f64,
}

/// Only the condition changes, so that the whole sweep is one step.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = 1 + 0 * t)]
#[unilateral(n: u * sin(k * t) > c)]
struct Resting {
    #[param(1)]
    k: f64,
    #[param(0.3)]
    c: f64,
}

/// A crank, whose angle limits the length of steps, and a condition on the position of its tip.
#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[point(tip = crank @ (1, 0))]
#[unilateral(n: cos(k * tip.x) > c)]
#[unilateral(touched: sin(k * crank.phi) < 1)]
struct Scale {
    #[param(1)]
    k: f64,
    #[param(0.3)]
    c: f64,
}

/// The values of u in (from, to) where sin(k u) = c, with the kind of crossing for increasing u.
fn crossings(k: f64, c: f64, from: f64, to: f64) -> Vec<(f64, Crossing)> {
    let (rising, falling) = (c.asin(), PI - c.asin());
    let turns = |u: f64| k * u / TAU;
    let first = turns(from).min(turns(to)).floor() as i64 - 2;
    let last = turns(from).max(turns(to)).ceil() as i64 + 2;
    let all = (first..=last)
        .flat_map(|m| [(rising, Restored), (falling, Violated)].map(|(at, way)| ((at + TAU * m as f64) / k, way)));
    all.filter(|(u, _)| from < *u && *u < to).collect()
}

#[track_caller]
fn watched(trajectory: &Trajectory) {
    assert!(trajectory.unwatched.is_empty(), "{:?}", trajectory.unwatched);
}

fn grids(from: f64, to: f64) -> Vec<Vec<f64>> {
    let uneven = |n: i32| (0..=n).map(|k| from + (to - from) * (f64::from(k) / f64::from(n)).powi(3)).collect();
    vec![vec![from, to], grid(from, to, 7), grid(from, to, 100), uneven(20), vec![to, from]]
}

/// The crossings in the order in which a sweep along `times` meets them; the list is for increasing times.
fn along(times: &[f64], mut expected: Vec<(f64, Crossing)>) -> Vec<(f64, Crossing)> {
    if times[0] > times[times.len() - 1] {
        expected.reverse();
        let turned = |way| if way == Restored { Violated } else { Restored };
        expected.iter_mut().for_each(|(_, way)| *way = turned(*way));
    }
    expected
}

#[test]
fn each_wave_of_a_fast_condition_is_seen() {
    for k in 1..=400 {
        // Most conditions are tested on one short interval, some on all grids.
        let (to, few) = if k % 67 == 0 || k == 37 { (20.0, 5) } else { (3.0, 1) };
        let k = f64::from(k);
        for times in grids(0.0, to).into_iter().take(few) {
            let trajectory = sweep(&Steady { k, ..Steady::default() }, &times);
            watched(&trajectory);
            let found = events_of(&trajectory, "n");
            let expected = along(&times, crossings(k, 0.3, 0.0, to));
            assert_eq!(found.len(), expected.len(), "k = {k} on {} instants", times.len());
            agree(&found, &expected);
        }
    }
}

#[test]
fn so_are_shallow_waves() {
    for c in [-0.9999, -0.9, 0.0, 0.7, 0.99, 0.999_999] {
        for k in [3.0, 17.0, 41.5, 97.25, 388.0] {
            let trajectory = sweep(&Steady { k, c }, &[0.013, 7.0]);
            watched(&trajectory);
            agree(&events_of(&trajectory, "n"), &crossings(k, c, 0.013, 7.0));
        }
    }
}

/// The times in (from, to) at which 3 sin t passes the values in `upwards`, with the kind of crossing.
fn times_of(upwards: &[(f64, Crossing)], from: f64, to: f64) -> Vec<(f64, Crossing)> {
    let mut all = Vec::new();
    for &(u, way) in upwards {
        let rising = (u / 3.0).asin();
        let back = if way == Restored { Violated } else { Restored };
        for m in -1..4 {
            all.push((rising + TAU * f64::from(m), way));
            all.push((PI - rising + TAU * f64::from(m), back));
        }
    }
    all.retain(|(t, _)| from < *t && *t < to);
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

#[test]
fn a_motion_to_and_fro_passes_a_fast_condition_both_ways() {
    for k in [1.0, 5.0, 13.0, 29.0, 33.0, 64.0, 127.0, 255.0, 399.0] {
        for times in grids(0.1, 12.0) {
            let trajectory = sweep(&Swinging { k, ..Swinging::default() }, &times);
            watched(&trajectory);
            let places = times_of(&crossings(k, 0.3, -3.0, 3.0), 0.1, 12.0);
            let found = events_of(&trajectory, "n");
            let expected = along(&times, places);
            assert_eq!(found.len(), expected.len(), "k = {k} on {} instants", times.len());
            // Where u reverses near a crossing, the time is less accurate than u.
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found.0 - expected.0).abs() < 1e-8 && found.1 == expected.1, "{found:?} and {expected:?}");
            }
            // cos x < c is −cos x > −c, and −cos x = sin(x − π/2).
            let timed: Vec<(f64, Crossing)> = crossings(k, -0.3, -FRAC_PI_2 / k + 0.1, 12.0 - FRAC_PI_2 / k);
            let timed = timed.into_iter().map(|(t, way)| (t + FRAC_PI_2 / k, way)).collect();
            let found = events_of(&trajectory, "timed");
            let expected = along(&times, timed);
            assert_eq!(found.len(), expected.len(), "k = {k} on {} instants, timed", times.len());
            agree(&found, &expected);
        }
    }
}

#[test]
fn a_condition_may_move_where_nothing_else_does() {
    for k in [1.0, 7.0, 40.0, 160.0, 400.0] {
        for times in [vec![0.0, 20.0], grid(0.0, 20.0, 3)] {
            let trajectory = sweep(&Resting { k, ..Resting::default() }, &times);
            watched(&trajectory);
            agree(&events_of(&trajectory, "n"), &crossings(k, 0.3, 0.0, 20.0));
        }
    }
}

#[test]
fn fast_limits_of_points_are_met_and_crests_are_touched() {
    for k in [2.0, 11.0, 40.0, 150.0] {
        let trajectory = sweep(&Scale { k, ..Scale::default() }, &[0.0, 3.0]);
        watched(&trajectory);
        // cos(k x) > c with x = cos φ falling from 1 to −1, and cos(k x) = sin(k x + π/2).
        let places = crossings(k, 0.3, -1.0 + FRAC_PI_2 / k, 1.0 + FRAC_PI_2 / k);
        let turned = |way| if way == Restored { Violated } else { Restored };
        let mut expected: Vec<(f64, Crossing)> =
            places.into_iter().map(|(x, way)| ((x - FRAC_PI_2 / k).acos(), turned(way))).collect();
        expected.retain(|(t, _)| *t < 3.0);
        expected.sort_by(|a, b| a.0.total_cmp(&b.0));
        agree(&events_of(&trajectory, "n"), &expected);
        let crests = (0..).map(|m| (FRAC_PI_2 + TAU * f64::from(m)) / k).take_while(|t| *t < 3.0);
        let found = events_of(&trajectory, "touched");
        let crests: Vec<f64> = crests.collect();
        assert_eq!(found.len(), crests.len(), "k = {k}: {found:?}");
        for (found, crest) in found.iter().zip(crests) {
            assert!((found.0 - crest).abs() < 1e-8 && found.1 == Touched, "{found:?} and {crest}");
        }
    }
}

#[test]
fn a_sweep_stops_at_the_first_crossing_of_a_fast_condition() {
    for k in [3.0, 37.0, 38.0, 128.0, 400.0] {
        for from in [0.0, 0.41, 3.3] {
            let expected = crossings(k, 0.3, from, 20.0)[0];
            let steady = Steady { k, ..Steady::default() };
            let stopped = steady.solver().stop_at_events(true).sweep(&[from, 20.0]).unwrap();
            assert!(stopped.stopped);
            agree(&events_of(&stopped, "n"), &[expected]);
            watched(&stopped);
        }
    }
}

/// A condition too fast for any number of samples is reported with its times, and no events are reported that were not
/// found.
#[test]
fn what_is_too_fast_to_be_watched_is_told_so() {
    for times in [vec![0.0, 20.0], vec![20.0, 0.0], grid(0.0, 20.0, 50)] {
        let trajectory = sweep(&Steady { k: 3e7, ..Steady::default() }, &times);
        let told = &trajectory.unwatched;
        assert!(!told.is_empty());
        for unwatched in told {
            assert_eq!((unwatched.name, unwatched.condition), ("n", 0));
            assert!((0.0..=20.0).contains(&unwatched.from) && (0.0..=20.0).contains(&unwatched.to));
            assert!((unwatched.to - unwatched.from) * (times[times.len() - 1] - times[0]) > 0.0, "{unwatched}");
        }
        let length: f64 = told.iter().map(|unwatched| (unwatched.to - unwatched.from).abs()).sum();
        assert!(length > 19.0, "{length}");
        assert!(trajectory.to_string().contains("n was not watched from t = "), "{trajectory}");
        // The events that were found are right.
        for event in trajectory.events {
            assert!(((3e7 * event.t).sin() - 0.3).abs() < 0.1, "{event}");
        }
    }
    // A sweep that stops at an event reports no unwatched intervals after it.
    let mechanism = Steady { k: 3e7, ..Steady::default() };
    let stopped = mechanism.solver().stop_at_events(true).sweep(&[0.0, 20.0]).unwrap();
    let end = stopped.last().unwrap().t;
    assert!(stopped.unwatched.iter().all(|unwatched| unwatched.from < end));
}

/// The number of evaluations of the driver of [`Counted`].
static ASKED: AtomicUsize = AtomicUsize::new(0);

fn asked(t: f64) -> [f64; 3] {
    ASKED.fetch_add(1, Ordering::Relaxed);
    [t, 1.0, 0.0]
}

/// A slider-crank with limits that change as slowly as its motion.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[function(turned)]
#[driver(drive: crank.phi = turned(t))]
#[unilateral(front: slider.x < far)]
#[unilateral(high: slider.x > near)]
#[unilateral(lean: rod.phi < 1)]
#[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = 0.9)]
struct Counted {
    turned: FromFn<fn(f64) -> [f64; 3]>,
    #[param(2)]
    far: f64,
    #[param(0)]
    near: f64,
}

/// The slider-crank without limits.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[function(turned)]
#[driver(drive: crank.phi = turned(t))]
#[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = 0.9)]
struct Unlimited {
    turned: FromFn<fn(f64) -> [f64; 3]>,
}

/// Limits that are far from the motion cost one more step at the start of a sweep, and nothing afterwards.
#[test]
fn slow_conditions_cost_next_to_nothing() {
    let count = |run: &dyn Fn() -> Trajectory| {
        let before = ASKED.load(Ordering::Relaxed);
        watched(&run());
        ASKED.load(Ordering::Relaxed) - before
    };
    let turned = FromFn(asked as fn(f64) -> [f64; 3]);
    for times in [vec![0.0, 30.0], grid(0.0, 30.0, 40), grid(0.0, 30.0, 400)] {
        // An observer that sees every step, as limits do.
        let look = |_: Reached<'_>| ControlFlow::Continue(());
        let unlimited = Unlimited { turned };
        let free = count(&|| unlimited.solver().with_observer(&look).sweep(&times).unwrap());
        let slow = count(&|| sweep(&Counted { turned, far: 2.0, near: 0.0 }, &times));
        assert!(slow <= free + 20, "{slow} and {free}");
        // Ten turns with four crossings each, and the evaluations that locate them.
        let met = count(&|| sweep(&Counted { turned, far: 0.85, near: 0.55 }, &times));
        assert!(met <= free + 1500, "{met} and {free}");
    }
}

//! Where and why a motion ends, for a follower of the plan: the place of a fold or a crossing to the last digits, its
//! kind, and by how much a group would be beyond it. The four-bar's own closed forms say what is right.

use crate::fixture::PlannedFourBar;
use crate::planned::{LimitKind, Located};
use crate::{Instant, Kinematics, PlanError, Planned};

/// A four-bar whose crank is at `from` at the time `t`, turning with `speed`.
fn four_bar(lengths: [f64; 4], from: f64, t: f64, speed: f64) -> PlannedFourBar {
    PlannedFourBar { lengths, start: from - speed * t, speed, ..PlannedFourBar::default() }
}

/// The margin of the dyad at a crank angle.
fn margin([crank, coupler, rocker, ground]: [f64; 4], phi: f64) -> f64 {
    let square = crank * crank + ground * ground - 2.0 * crank * ground * phi.cos();
    let m = 0.5 * (rocker * rocker - coupler * coupler - square);
    1.0 - m * m / (square * coupler * coupler)
}

/// Where the motion from `t` ends on the way to another instant, and the margin that is told.
fn end(mechanism: &PlannedFourBar, t: f64, to: f64) -> (f64, LimitKind, f64) {
    let mut planned = mechanism.solver().planned(&Instant::at(t)).unwrap();
    let error = planned.at(&Instant::at(to)).unwrap_err();
    let PlanError::Limit { t: refused, limit } = error else { panic!("{error}") };
    assert_eq!((to, 2), (refused, limit.step.index()));
    let Some(Located { at, kind: Some(kind) }) = limit.located else { panic!("{limit:?}") };
    assert_eq!(t, planned.t(), "the last good state stays");
    (at, kind, limit.margin)
}

/// Times from which motions begin, and speeds.
const STARTS: [f64; 4] = [0.0, 0.7, -0.7, 40.0];
const SPEEDS: [f64; 4] = [1.0, -1.0, 5.0, 0.02];

#[test]
fn a_dead_centre_is_found_to_the_last_digits_whatever_was_asked_for() {
    let lengths = PlannedFourBar::default().lengths;
    for t in STARTS {
        for speed in SPEEDS {
            let fold = PlannedFourBar::limit();
            // In either direction of the crank, and of time.
            for (from, fold) in [(0.9, fold), (0.3, fold), (-0.9, -fold), (0.2, -fold)] {
                let mechanism = four_bar(lengths, from, t, speed);
                let place = t + (fold - from) / speed;
                let side = (fold - from).signum() / speed;
                for beyond in [0.0, 1e-9, 1e-3, 0.1, 1.0] {
                    let to = place + beyond * side;
                    let (at, kind, found) = end(&mechanism, t, to);
                    let allowed = 1e-13 * (1.0 + t.abs() + 1.0 / speed.abs());
                    assert!((at - place).abs() < allowed, "{at} for {place}, on the way from {t} to {to}");
                    assert_eq!(LimitKind::DeadCentre, kind, "on the way from {t} to {to}");
                    let expected = margin(lengths, fold + beyond * (fold - from).signum());
                    assert!(
                        (found - expected).abs() < 1e-10 * (1.0 + speed.abs()),
                        "{found} for {expected}, {beyond} beyond"
                    );
                }
            }
        }
    }
}

#[test]
fn a_crossing_is_found_whether_the_instant_lies_behind_it_or_just_before() {
    let lengths = PlannedFourBar::parallelogram(0.0).lengths;
    for t in STARTS {
        for speed in SPEEDS {
            for from in [-0.5, -0.05, 0.3] {
                let mechanism = four_bar(lengths, from, t, speed);
                let place = t - from / speed;
                let side = -from.signum() / speed;
                for beyond in [-1e-5, -1e-6, 0.0, 1e-6, 0.01, 0.3, 1.0] {
                    let to = place + beyond * side;
                    let (at, kind, found) = end(&mechanism, t, to);
                    assert!(((at - place) * speed).abs() < 1e-9, "{at} for {place}, on the way from {t} to {to}");
                    assert_eq!(LimitKind::BranchPoint, kind, "on the way from {t} to {to}");
                    assert!(found.abs() < 1e-9, "{found}");
                }
            }
        }
    }
}

/// A rocker that is a little too short does not close where a parallelogram lies flat: it is no crossing.
#[test]
fn two_dead_centres_near_one_another_are_no_crossing() {
    for short in [1e-3, 1e-4, 1e-6, 1e-7, 1e-8] {
        let lengths = [0.2, 0.5, 0.2 - short, 0.5];
        let fold = ((0.29 - (0.3 + short) * (0.3 + short)) / 0.2_f64).acos();
        assert!(margin(lengths, fold).abs() < 1e-12 && margin(lengths, 0.5 * fold) < -short);
        for (t, from, speed) in [(0.2, -0.5, 1.0), (0.2, 0.5, -1.0), (300.0, 0.4, -3.0), (-300.0, -0.4, 3.0)] {
            let mechanism = four_bar(lengths, from, t, speed);
            let place = t + (f64::copysign(fold, from) - from) / speed;
            for beyond in [0.0, 0.1 * fold, fold, 0.1] {
                let (at, kind, _) = end(&mechanism, t, place + beyond / speed.abs());
                assert!((at - place).abs() < 1e-8, "{at} for {place}");
                assert_eq!(LimitKind::DeadCentre, kind, "{short} from {from}, {beyond} beyond");
            }
        }
    }
}

/// A rocker that is a little too long passes: there is a way, however near the closures come to one another.
#[test]
fn a_group_that_only_comes_near_its_limit_goes_on() {
    for long in [1e-3, 1e-5, 1e-6, 1e-7] {
        let mechanism = four_bar([0.2, 0.5, 0.2 + long, 0.5], -0.5, 0.0, 1.0);
        let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
        let before = planned.q()[8];
        let after = planned.at(&Instant::at(1.0)).unwrap_or_else(|error| panic!("{long}: {error}")).q()[8];
        // The rocker, parallel at first or mirrored, stays on its side of the ground.
        assert!(before.sin() * after.sin() > 0.0, "{long}: {before} and {after}");
    }
}

/// What kind of limit it is does not depend on how far behind it the instant lies that was asked for.
#[test]
fn a_dead_centre_is_one_however_far_the_way_was_to_go() {
    let lengths = [0.2, 0.5, 0.199, 0.5];
    let fold = ((0.29 - 0.301 * 0.301) / 0.2_f64).acos();
    for to in [1.0, 10.0, 50.0, 200.0, 1000.0] {
        let (at, kind, _) = end(&four_bar(lengths, -0.5, 0.0, 1.0), 0.0, to);
        assert!((at - (0.5 - fold)).abs() < 1e-8, "{at}");
        assert_eq!(LimitKind::DeadCentre, kind, "on the way to {to}");
    }
}

/// Where a motion may begin beside a crossing is an angle, however fast the crank is.
#[test]
fn no_motion_begins_so_near_to_a_crossing_that_its_rates_mean_nothing() {
    let begins = |phi: f64, speed: f64| {
        let mechanism = PlannedFourBar { speed, ..PlannedFourBar::parallelogram(phi) };
        let q = [0.0, 0.0, phi, 0.2 * phi.cos(), 0.2 * phi.sin(), 0.0, 0.5, 0.0, phi];
        match Planned::new(&mechanism, &Instant::at(0.0), &q) {
            Ok(_) => true,
            Err(PlanError::Limit { t: 0.0, limit }) => {
                // The crossing itself, not the instant beside it.
                let Some(Located { at, kind: Some(LimitKind::BranchPoint) }) = limit.located else { panic!("{limit}") };
                assert!((at * speed + phi).abs() < 1e-9, "{at} for {}", -phi / speed);
                false
            }
            Err(error) => panic!("{error}"),
        }
    };
    for speed in [1.0, -1.0, 1e-4, 1e4] {
        for side in [1.0, -1.0] {
            let of = |phi: f64| begins(side * phi, speed);
            assert!(!of(1e-5) && !of(1e-4) && of(2e-3) && of(1e-2) && of(0.3), "{speed} {side}");
        }
    }
}

/// After an error of a restart the motion goes on from where it was.
#[test]
fn a_restart_at_a_crossing_leaves_everything_as_it_was() {
    let mechanism = PlannedFourBar::parallelogram(-0.5);
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
    let expected = mechanism.solver().planned(&Instant::at(0.0)).unwrap().at(&Instant::at(0.3)).unwrap().q().to_vec();
    for t in [0.1, 0.2] {
        planned.at(&Instant::at(t)).unwrap();
        // The other branch, at the crossing.
        let error = planned.restart(&Instant::at(0.5 - 1e-6), &[0.0, 0.0, -1e-6, 0.2, -2e-7, 4e-7, 0.5, 0.0, 1e-6]);
        assert!(matches!(error.map(|_| ()).unwrap_err(), PlanError::Limit { limit, .. } if limit.margin > 0.0));
        assert_eq!(t, planned.t());
    }
    let found = planned.at(&Instant::at(0.3)).unwrap().q();
    found.iter().zip(&expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{found:?}"));
}

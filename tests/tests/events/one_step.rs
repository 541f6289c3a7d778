//! Several limits within one step, and motions at rest: the order of events, the stop of a sweep, and the conditions at
//! its start.

use super::*;

/// A hand so slow that a whole sweep is one step.
#[mechanism]
#[body(hand, x = 0, y = 0)]
#[driver(drive: hand.phi = 0.01 * t)]
#[unilateral(first: hand.phi < 0.002)]
#[unilateral(second: hand.phi < 0.003)]
#[unilateral(again: 2 * hand.phi < 0.004)]
#[unilateral(start: hand.phi > 0)]
struct Hand;

fn names(trajectory: &Trajectory) -> Vec<&'static str> {
    trajectory.events.iter().map(|event| event.name).collect()
}

#[test]
fn events_of_one_step_are_in_the_order_of_the_motion() {
    assert_eq!(names(&sweep(&Hand, &[0.0, 1.0])), ["first", "again", "second"]);
    assert_eq!(names(&sweep(&Hand, &[1.0, 0.1])), ["second", "first", "again"]);
}

#[test]
fn a_sweep_that_stops_has_no_later_event() {
    for (times, met, t) in [([0.0, 1.0], &["first", "again"][..], 0.2), ([1.0, 0.1], &["second"], 0.3)] {
        let stopped = Hand.solver().stop_at_events(true).sweep(&times).unwrap();
        assert_eq!(names(&stopped), met);
        assert!((stopped.last().unwrap().t - t).abs() < 1e-10);
    }
}

/// A condition that starts at its limit and never changes is violated; if the motion leads away from the limit to the
/// satisfied side, it is not.
#[test]
fn what_stays_at_its_limit_is_violated_at_the_start() {
    assert_eq!(sweep(&Hand, &[0.0]).violated_at_start, [3]);
    assert_eq!(sweep(&Hand, &[0.0, 0.0]).violated_at_start, [3]);
    assert_eq!(sweep(&Hand, &[0.0, 0.1]).violated_at_start, [0; 0]);
    // The same holds if the observer stops the sweep at its first instant.
    let stop = |_: kin_runtime::Reached<'_>| std::ops::ControlFlow::Break(());
    let stopped = Hand.solver().with_observer(&stop).sweep(&[0.0, 0.1, 0.2]).unwrap_err();
    assert_eq!((stopped.trajectory.len(), stopped.trajectory.violated_at_start), (1, vec![3]));
}

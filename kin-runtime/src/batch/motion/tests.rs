//! Tests of the checks of a step that eight sets take together: each check beside its threshold, while all others pass.
//!
//! The margin of the test's four-bar is prescribed, so that its group can be arbitrarily near to its limit. The margins
//! of the previous instant are so small that the scalar follower refuses every step from there. The common step does
//! not use them, so that exactly those sets fail that repeat the step alone.

use super::*;
use crate::Kinematics;
use crate::fixture::PlannedFourBar;

fn at(t: f64) -> Instant<'static, Octet> {
    Instant { t: Octet::from_f64(t), inputs: &[] }
}

/// The time at which motions begin; not 0, near which floating-point numbers allow arbitrarily short steps.
const T: f64 = 1.0;

/// A four-bar whose group has the prescribed distance w from its limit.
fn at_distance(w: f64) -> PlannedFourBar {
    PlannedFourBar { start: 0.2 - T, margin: Some(w * w), ..PlannedFourBar::default() }
}

/// Eight sets of parameters of this four-bar at their first instant.
fn begun(mechanism: &PlannedFourBar) -> BlockMotion<PlannedFourBar> {
    let own = PlannedFourBar { margin: None, ..*mechanism };
    let q = own.state_at(&crate::Instant::at(T)).unwrap().q;
    let mut motion = BlockMotion::<PlannedFourBar>::nothing();
    motion.predicted = Array::generate(Octet::default(), |k| Octet::from_f64(q[k]));
    motion.modes = motion.branch_values(mechanism, &at(T), motion.predicted.as_ref()).modes();
    assert!(motion.begin(mechanism, &at(T)).is_none());
    motion.margins_before = Margins::filled(Octet::from_f64(1e-30));
    motion
}

/// The step, forwards or backwards, that turns by `turn`.
fn step_of(motion: &BlockMotion<PlannedFourBar>, turn: f64, side: f64) -> f64 {
    let BlockSolution { q, q_dot, q_ddot, .. } = motion.poses();
    let rates = [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()];
    let turns = |h: f64| parabola(&mut q.clone(), rates, motion.weights.as_ref(), h).lane(0);
    let (mut short, mut long) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (short + long);
        if turns(side * middle) < turn { short = middle } else { long = middle }
    }
    side * long
}

/// Whether a step that turns by `turn` is accepted for all sets together; `to` is the mechanism at its end.
fn together(from: &PlannedFourBar, to: &PlannedFourBar, turn: f64) -> bool {
    let answers = [1.0, -1.0].map(|side| {
        let mut motion = begun(from);
        let h = step_of(&motion, turn, side);
        match motion.advance(to, &at(T + h), T + h) {
            None => true,
            Some(refusals) => {
                assert!(refusals.iter().all(Option::is_some));
                false
            }
        }
    });
    assert_eq!(answers[0], answers[1], "{turn}");
    answers[0]
}

fn counts([before, now]: [f64; 2], turn: f64) -> bool {
    together(&at_distance(before), &at_distance(now), turn)
}

#[test]
fn a_step_turns_no_farther_than_it_may() {
    assert!(counts([1.0; 2], 0.299) && !counts([1.0; 2], 0.301));
}

#[test]
fn a_solution_that_is_not_where_it_was_predicted_does_not_count() {
    // A tenth of 0.02, and 0.0001.
    for (mistake, expected) in [(0.00205, true), (0.00215, false), (-0.00205, true), (-0.00215, false)] {
        let to = PlannedFourBar { mistake, ..at_distance(1.0) };
        assert_eq!(expected, together(&at_distance(1.0), &to, 0.02), "{mistake}");
    }
}

#[test]
fn a_group_out_of_reach_is_not_asked() {
    // The prescribed margin disagrees with the branch value, so a group within reach of its limit is not accepted.
    assert!(counts([0.2; 2], 0.0499) && !counts([0.2; 2], 0.0501));
    assert!(counts([0.9, 0.2], 0.0499) && !counts([0.9, 0.2], 0.0501));
    // The same holds if the group may have reached its limit and returned.
    assert!(counts([0.12, 0.9], 0.0299) && !counts([0.12, 0.9], 0.0301));
    // Even in a short step, the rates of a group nearer to its limit may be dominated by rounding.
    assert!(counts([0.9, 0.101], 0.001) && !counts([0.9, 0.099], 0.001));
    assert!(counts([0.101, 0.9], 0.001) && !counts([0.099_5, 0.9], 0.001));
}

/// Only the sets whose own step is not accepted repeat it alone.
#[test]
fn every_set_is_judged_for_itself() {
    let mechanism = at_distance(0.9);
    for lane in 0..Octet::COUNT {
        let mut motion = begun(&mechanism);
        let h = step_of(&motion, 0.2, 1.0);
        // One set turns faster.
        let good = motion.good;
        let rates = motion.poses[good].q_dot.as_mut();
        rates.iter_mut().for_each(|rate| rate.set(lane, 1.6 * rate.lane(lane)));
        let refusals = motion.advance(&mechanism, &at(T + h), T + h).expect("one that cannot go on");
        let alone: Vec<usize> = (0..Octet::COUNT).filter(|k| refusals[*k].is_some()).collect();
        assert_eq!(vec![lane], alone);
        assert!((0..Octet::COUNT).all(|k| motion.poses().is_good(k) == (k != lane)));
    }
}

/// A set that took a step alone continues with the others, with its own margin at the end of that step.
#[test]
fn a_set_that_was_alone_is_as_near_to_its_limit_as_it_says() {
    for w in [0.9, 0.5] {
        let mechanism = at_distance(w);
        let mut motion = begun(&mechanism);
        motion.margins_before = Margins::filled(Octet::from_f64(w * w));
        // The step turns farther than one step may.
        let h = step_of(&motion, 0.35, -1.0);
        assert!(motion.advance(&mechanism, &at(T + h), T + h).is_none());
        let poses = motion.poses();
        for lane in 0..Octet::COUNT {
            assert!(poses.is_good(lane) && (poses.margin.lane(lane) - w * w).abs() < 1e-15);
            assert!((motion.margins.as_ref()[0].lane(lane) - w * w).abs() < 1e-15);
        }
    }
}

#[test]
fn a_prediction_is_as_certain_as_the_least_certain_group() {
    let of = |w: f64, nearest: f64, turn: f64| {
        let mut motion = begun(&at_distance(0.9));
        motion.margins.as_mut()[0] = Octet::from_f64(w * w);
        let [nearest, turn] = [nearest, turn].map(Octet::from_f64);
        let certain = motion.certainty_of_prediction(&at_distance(0.9), &at(T), nearest, turn);
        (1..Octet::COUNT).for_each(|lane| assert_eq!(certain.lane(0), certain.lane(lane)));
        certain.lane(0)
    };
    let mut closure = [0.0];
    let start = begun(&at_distance(0.9));
    let q: Vec<f64> = start.predicted.as_ref().iter().map(|q| q.lane(0)).collect();
    PlannedFourBar::default().branches_with(&[], &crate::Instant::at(T), &q, &mut closure).unwrap();
    let closure = closure[0].abs();
    // The distance may differ from the predicted branch value by half of the smaller of the two.
    assert!(of(0.67 * closure, 0.9, 0.0) > 0.0 && of(0.66 * closure, 0.9, 0.0) < 0.0);
    assert!(of(1.49 * closure, 0.9, 0.0) > 0.0 && of(1.51 * closure, 0.9, 0.0) < 0.0);
    // The step must resolve the group, which must be too far from its limit to have reached it within the step.
    assert!(of(closure, 0.28, 0.3) > 0.0 && of(closure, 0.26, 0.3) < 0.0);
    assert!(of(closure, 0.151, 0.0) > 0.0 && of(closure, 0.149, 0.0) < 0.0);
}

/// Eight positive numbers, one of which is replaced.
#[test]
fn one_lane_that_is_not_positive_is_seen_wherever_it_is() {
    for lane in 0..Octet::COUNT {
        let with = |x: f64| {
            let mut octet = Octet::from_f64(0.3);
            (1..Octet::COUNT).step_by(2).for_each(|k| octet.set(k, 1e200));
            octet.set(lane, x);
            is_positive(octet)
        };
        assert!([1e-3, 0.5, 1.0, 7.0, 1e300].into_iter().all(with), "{lane}");
        assert!(![-1e-3, -1.0, -1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().any(with), "{lane}");
    }
}

//! Tests of the checks of a single step: each check beside its threshold, while all others pass.
//!
//! The margin of the test's four-bar is prescribed, so that its group can be arbitrarily near to its limit.

use super::*;
use crate::Kinematics;
use crate::fixture::PlannedFourBar;

/// Accepts steps of any length, from any prediction.
const GENEROUS: Control = Control { rotation: 1.0, correction: 10.0, ..Control::USUAL };

fn at_distance(w: f64) -> PlannedFourBar {
    PlannedFourBar { margin: Some(w * w), ..PlannedFourBar::default() }
}

fn follower(mechanism: &PlannedFourBar) -> PlanFollower<PlannedFourBar> {
    let q = PlannedFourBar::default().state_at(&Instant::at(0.0)).unwrap().q;
    PlanFollower::new(mechanism, &Instant::at(0.0), &q).unwrap_or_else(|error| panic!("{error}"))
}

/// The step, forwards or backwards, that turns by `turn`.
fn step_of(follower: &mut PlanFollower<PlannedFourBar>, turn: f64, side: f64) -> f64 {
    let (mut short, mut long) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (short + long);
        if follower.predict(side * middle) < turn { short = middle } else { long = middle }
    }
    side * long
}

/// Whether a step that turns by `turn` is accepted, for given distances of the group from its limit at both ends.
fn counts([before, now]: [f64; 2], turn: f64, control: &Control) -> bool {
    let answers = [1.0, -1.0].map(|side| {
        let mut follower = follower(&at_distance(before));
        let h = step_of(&mut follower, turn, side);
        let turn = follower.predict(h);
        let at = Instant::at(h);
        let counts = follower.try_one_step(&at_distance(now), &at, turn, control, None).unwrap();
        // An accepted step reaches the instant, and a rejected one changes nothing.
        assert_eq!(
            if counts { [h, 0.0] } else { [0.0, f64::NAN] }.map(f64::to_bits),
            [follower.t.to_bits(), follower.t_before.to_bits()]
        );
        assert!((if counts { now } else { before } - follower.nearest).abs() < 1e-12);
        counts
    });
    assert_eq!(answers[0], answers[1]);
    answers[0]
}

#[test]
fn a_step_turns_no_farther_than_it_may() {
    let control = Control { rotation: 0.2, ..GENEROUS };
    assert!(counts([1.0; 2], 0.199, &control) && !counts([1.0; 2], 0.201, &control));
}

#[test]
fn a_group_out_of_reach_is_not_asked() {
    // Nearer than 0.15 the group must not be near enough to reach its limit and return.
    assert!(counts([0.12; 2], 0.0299, &GENEROUS) && !counts([0.12; 2], 0.0301, &GENEROUS));
    // The distances at both ends count.
    for [before, now] in [[0.12, 0.9], [0.9, 0.12]] {
        assert!(counts([before, now], 0.0299, &GENEROUS) && !counts([before, now], 0.0301, &GENEROUS), "{before}");
    }
    // Even in a short step, the rates of a group nearer to its limit may be dominated by rounding.
    assert!(counts([0.9, 0.101], 0.001, &GENEROUS) && !counts([0.9, 0.099], 0.001, &GENEROUS));
}

#[test]
fn a_group_in_reach_is_believed_where_the_step_resolves_it() {
    // 10 turn³ is 0.2 for a turn of 0.271.
    assert!(counts([0.2; 2], 0.27, &GENEROUS) && !counts([0.2; 2], 0.273, &GENEROUS));
    assert!(counts([0.9, 0.2], 0.27, &GENEROUS) && !counts([0.9, 0.2], 0.273, &GENEROUS));
    // The group must also be too far from its limit to reach it and return.
    assert!(counts([0.151; 2], 0.1, &GENEROUS) && !counts([0.149; 2], 0.1, &GENEROUS));
}

#[test]
fn a_solution_that_is_not_where_it_was_predicted_does_not_count() {
    for side in [1.0, -1.0] {
        let mechanism = PlannedFourBar::default();
        let mut from = follower(&mechanism);
        let h = step_of(&mut from, 0.3, side);
        let turn = from.predict(h);
        let mut found = from;
        assert!(found.try_one_step(&mechanism, &Instant::at(h), turn, &GENEROUS, None).unwrap());
        let away = turned(found.state().q.as_ref(), found.predicted.as_ref(), found.weights.as_ref());
        assert!(away > 4.0 * NEGLIGIBLE_CORRECTION && away < 0.1 * turn, "{away}");
        for (factor, expected) in [(1.01, true), (0.99, false)] {
            let control = Control { correction: (factor * away - NEGLIGIBLE_CORRECTION) / turn, ..GENEROUS };
            let counts = |mut follower: PlanFollower<PlannedFourBar>| {
                follower.try_one_step(&mechanism, &Instant::at(h), turn, &control, None).unwrap()
            };
            assert_eq!(expected, counts(from), "{factor} {side}");
        }
    }
}

#[test]
fn what_is_not_good_does_not_count() {
    assert!(counts([1.0; 2], 0.1, &GENEROUS));
    // A group at its limit, a group beyond it, and NaN.
    let mut follower = follower(&at_distance(1.0));
    let turn = follower.predict(0.01);
    for margin in [1e-12, 0.0, -0.5, f64::NAN] {
        let bad = PlannedFourBar { margin: Some(margin), ..PlannedFourBar::default() };
        assert!(!follower.try_one_step(&bad, &Instant::at(0.01), turn, &GENEROUS, None).unwrap(), "{margin}");
    }
    assert!(!follower.try_one_step(&at_distance(1.0), &Instant::at(f64::NAN), turn, &GENEROUS, None).unwrap());
    assert!(!follower.try_one_step(&at_distance(1.0), &Instant::at(0.01), f64::NAN, &GENEROUS, None).unwrap());
    assert!(follower.try_one_step(&at_distance(1.0), &Instant::at(0.01), turn, &GENEROUS, None).unwrap());
}

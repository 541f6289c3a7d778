//! Tests of the order in which causes are reported.

use super::*;
use crate::Kinematics;
use crate::fixture::PlannedFourBar;
use crate::planned::lists::BranchValues;

/// Starts a follower of the four-bar at a configuration of its closed form, with a prescribed margin and an error in
/// its plan.
fn begun(margin: f64, mistake: f64, sign: f64) -> Result<PlanFollower<PlannedFourBar>, PlanError> {
    begun_by(PlannedFourBar::default(), margin, mistake, sign)
}

/// [`begun`] of another four-bar.
fn begun_by(
    own: PlannedFourBar,
    margin: f64,
    mistake: f64,
    sign: f64,
) -> Result<PlanFollower<PlannedFourBar>, PlanError> {
    let q = own.state_at(&Instant::at(0.0)).unwrap().q;
    let mechanism = PlannedFourBar { margin: Some(margin), mistake, ..own };
    let mut modes = BranchValues::at(&mechanism, &[], &Instant::at(0.0), &q)?.modes();
    let asked = modes.as_ref()[0] * sign;
    modes.as_mut()[0] = if asked == 0.0 { f64::NAN } else { asked };
    PlanFollower::begin(&mechanism, [], &Instant::at(0.0), &q, modes)
}

#[test]
fn what_is_to_blame_is_asked_in_the_order_of_the_plan() {
    let says = |margin: f64, mistake: f64, sign: f64| begun(margin, mistake, sign).map(|_| ()).unwrap_err();
    let number =
        |what: &'static str, index: usize, name: &'static str| PlanError::NonFinite { what, index, name, t: 0.0 };
    let is_limit = |error: PlanError, margin: f64| {
        let PlanError::Limit { t: 0.0, limit } = error else { panic!("{error}") };
        assert_eq!((2, margin, None), (limit.step.index(), limit.margin, limit.located));
    };
    // A group at its limit is reported before everything that follows from it, even where its mode is undecided.
    for margin in [1e-12, 5e-13, 0.0, -3.0, f64::NEG_INFINITY] {
        is_limit(says(margin, 0.0, 1.0), margin);
        is_limit(says(margin, f64::NAN, 1.0), margin);
        is_limit(says(margin, 0.0, 0.0), margin);
    }
    // Above the smallest margin the group is not reported.
    for margin in [2e-12, 0.3] {
        assert_eq!(number("q", 8, "rocker.phi"), says(margin, f64::NAN, 1.0));
        assert_eq!(PlanError::Undecided { t: 0.0, mode: "A-B-D" }, says(margin, 0.0, 0.0));
    }
    assert_eq!(number("margins", 0, ""), says(f64::NAN, 0.0, 1.0));
    assert_eq!(number("margins", 0, ""), says(f64::NAN, f64::NAN, 1.0));
}

/// Where the closures are apart and the margin is small nevertheless, no motion starts.
#[test]
fn nothing_begins_where_pins_meet() {
    for (w, begins) in [(0.101, true), (0.099, false), (0.02, false)] {
        // The pins come nearer faster than the crank turns; where they keep their distance, the group is small.
        let meeting = PlannedFourBar { loss: 4.0, ..PlannedFourBar::default() };
        assert!(begun(w * w, 0.0, 1.0).is_ok(), "{w}");
        let found = begun_by(meeting, w * w, 0.0, 1.0);
        match found {
            Ok(_) => assert!(begins, "{w}"),
            Err(error) => {
                let PlanError::Limit { t: 0.0, limit } = error else { panic!("{error}") };
                let at_once = Located { at: 0.0, kind: Some(LimitKind::BranchPoint) };
                assert_eq!((false, w * w, Some(at_once)), (begins, limit.margin, limit.located));
            }
        }
    }
}

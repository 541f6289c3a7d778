//! Solving by a plan that was written by hand.

use super::agree;
use crate::fixture::{FourBarLoop, PlannedFourBar};
use crate::{Instant, Kinematics, LengthError, PlanError, Planned, Sign};

/// Solved by full Newton at t.
fn newton(mechanism: &PlannedFourBar, t: f64) -> crate::State {
    mechanism
        .solver()
        .with_options(crate::Options { use_plan: false, ..Default::default() })
        .sweep(&[0.0, t])
        .unwrap()
        .states
        .remove(1)
}

#[test]
fn it_is_full_newton() {
    let mechanism = PlannedFourBar::default();
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
    for k in -30..=80 {
        let t = 0.01 * f64::from(k);
        let found = planned.at(&Instant::at(t)).unwrap();
        let expected = newton(&mechanism, t);
        agree(found.q(), &expected.q, 1e-13);
        agree(found.q_dot(), &expected.q_dot, 1e-12);
        agree(found.q_ddot(), &expected.q_ddot, 1e-11);
        assert!(found.t() == t && found.margins()[0] > 0.0);
    }
}

#[test]
fn a_dyad_that_cannot_close_is_named_and_the_last_good_state_stays() {
    let mechanism = PlannedFourBar { start: 0.0, ..PlannedFourBar::default() };
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
    let limit = PlannedFourBar::limit();
    let before = planned.at(&Instant::at(limit - 1e-3)).unwrap().q().to_vec();
    for beyond in [1e-12, 1e-6, 0.1, 1.0] {
        let error = planned.at(&Instant::at(limit + beyond)).unwrap_err();
        let PlanError::Limit { t, limit: found } = error else { panic!("{error}") };
        assert_eq!(
            (t, found.step.index(), found.step.joints().collect::<Vec<_>>()),
            (limit + beyond, 2, vec!["A", "B", "D"])
        );
        assert!(found.margin < 1e-11 && (beyond < 1e-6 || found.margin < 0.0), "{}", found.margin);
        assert_eq!((planned.q(), planned.t()), (&before[..], limit - 1e-3));
    }
    let error = planned.at(&Instant::at(limit + 0.1)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot reach t = 1.19468: coupler and rocker of dyad RRR of A, B, D lock at t = 1.09468: A, B and D on one line \
         (dead centre), the driver drive is at the end of its range"
    );
    assert!(planned.at(&Instant::at(limit - 2e-3)).is_ok());
}

#[test]
fn modes_are_kept_and_changed_by_sign() {
    let mechanism = PlannedFourBar::default();
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
    let sign = planned.mode("A-B-D").unwrap();
    let above = planned.q()[5];
    planned.flip(0).unwrap();
    let below = planned.at(&Instant::at(0.0)).unwrap().q()[5];
    assert!(above > below, "{above} {below}");
    assert_eq!(planned.modes().collect::<Vec<_>>(), [sign.flipped()]);
    // Closed in either mode.
    agree(mechanism.constraints_dense(&Instant::at(0.0), planned.q()).unwrap().as_slice(), &[0.0; 9], 1e-15);
    planned.set_mode("A-B-D", sign).unwrap();
    assert_eq!(planned.at(&Instant::at(0.0)).unwrap().q()[5], above);
    let error = planned.set_mode("A-B-C", Sign::Plus).unwrap_err();
    assert_eq!(error.to_string(), "no such mode; there are `A-B-D`");
    assert!(planned.flip(1).is_err() && planned.mode(1).is_none());
    // A configuration in the other mode decides for it.
    planned.flip(0).unwrap();
    let other = planned.at(&Instant::at(0.1)).unwrap().q().to_vec();
    let again = Planned::new(&mechanism, &Instant::at(0.1), &other).unwrap();
    assert_eq!(again.mode(0), Some(sign.flipped()));
    agree(again.q(), &other, 1e-15);
    let owned = Planned::owned(PlannedFourBar::default(), &Instant::at(0.1), &other).unwrap();
    assert_eq!((owned.q(), owned.mechanism().speed), (again.q(), 1.0));
}

#[test]
fn angles_go_on_counting() {
    let mechanism = PlannedFourBar::default();
    let mut start = mechanism.state_at(&Instant::at(0.0)).unwrap().q;
    start[5] += 4.0 * core::f64::consts::TAU;
    let mut planned = Planned::new(&mechanism, &Instant::at(0.0), &start).unwrap();
    assert!((planned.q()[5] - start[5]).abs() < 1e-13);
    assert!((planned.at(&Instant::at(0.1)).unwrap().q()[5] - start[5]).abs() < 0.5);
}

#[test]
fn what_is_not_a_number_is_named() {
    let mechanism = PlannedFourBar::default();
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
    let error = planned.at(&Instant::at(f64::NAN)).unwrap_err();
    assert!(matches!(error, PlanError::NonFinite { what: "t", .. }), "{error}");
    assert_eq!(planned.t(), 0.0);
    let mut q = planned.q().to_vec();
    q[5] = f64::NAN;
    assert!(matches!(planned.restart(&Instant::at(0.0), &q), Err(PlanError::NonFinite { .. })));
    let error = planned.restart(&Instant::at(0.0), &q[1..]).unwrap_err();
    assert_eq!(error, PlanError::Length(LengthError { what: "q", expected: 9, found: 8 }));
    assert!(planned.at(&Instant::at(0.1)).is_ok());
}

#[test]
fn without_a_plan_there_is_a_reason() {
    let mechanism = FourBarLoop::default();
    let error = Planned::new(&mechanism, &Instant::at(0.0), &[0.0; 3]).unwrap_err();
    assert_eq!(error.to_string(), "no plan because written by hand");
}

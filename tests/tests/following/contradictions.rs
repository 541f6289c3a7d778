//! Redundant rows that contradict the others: the size of the contradiction, and what is said of it.

use kin_runtime::{Instant, Kinematics, Planned, SolveError, mechanism};

/// A sled on two guides that are `h` apart, as its two shoes are 0.5; the second guide turns by tilt t³.
#[mechanism(allow_redundant)]
#[bodies(sled)]
#[translational(one: ground @ (0, 0), sled @ (0, 0), axis = (1, 0))]
#[translational(two: ground @ (0, h), sled @ (0, 0.5), axis = (1, 0), angle = tilt * t * t * t)]
#[driver(drive: sled.x = t)]
struct Sled {
    #[param(0.5)]
    h: f64,
    #[param(0)]
    tilt: f64,
}

/// The size of a contradiction does not depend on the pose: at t = 0 all arms of the rows have the component 0.
#[test]
fn a_contradiction_is_relative_to_the_arms_at_every_pose() {
    for gap in [1e-6, 1e-3, 0.1] {
        let bad = Sled { h: 0.5 + gap, tilt: 0.0 };
        for t in [0.0, 0.3, 3.0, 30.0] {
            let error = Planned::new(&bad, &Instant::at(t), &[t, 0.0, 0.0]).expect_err("the guides contradict");
            let miss = error.limit().and_then(|limit| limit.contradiction()).expect("a contradiction");
            // The gap relative to the arm of 0.5, or to the distance from the origin.
            assert!(miss < 5.0 * gap && miss > 0.2 * gap / (1.0 + t), "{gap}, {t}: {miss:e}");
            let error = bad.state_at(&Instant::at(t)).expect_err("the guides contradict");
            let SolveError::NotAssembled { limit: Some(limit), .. } = &error else { panic!("{gap}, {t}: {error}") };
            assert!(limit.contradiction().is_some_and(|of_state| (of_state - miss).abs() <= 0.5 * miss), "{error}");
            assert!(error.to_string().contains("redundant row of two violated by"), "{error}");
        }
    }
}

#[test]
fn a_contradiction_has_the_size_at_the_instant_requested() {
    let turning = Sled { h: 0.5, tilt: 1.0 };
    let mut planned = turning.solver().planned(&Instant::at(0.0)).expect("it closes");
    for t in [0.01, 0.1] {
        let error = planned.at(&Instant::at(t)).expect_err("the guides contradict");
        let miss = error.limit().and_then(|limit| limit.contradiction()).expect("a contradiction");
        assert!(miss > 0.2 * t * t * t && miss < 10.0, "{t}: {error}");
    }
}

#[test]
fn redundancy_has_a_cause_and_a_contradiction_has_these_dimensions() {
    let said = |sled: &Sled| {
        let mobility = sled.solver().mobility(&Instant::at(0.3), &[0.3, 0.0, 0.0]).expect("numbers");
        mobility.to_string()
    };
    let fits = said(&Sled { h: 0.5, tilt: 0.0 });
    assert!(fits.contains("row `two.normal` of joint `two` repeats one whatever the dimensions"), "{fits}");
    let contradicts = said(&Sled { h: 0.501, tilt: 0.0 });
    let words = "row `two.normal` of joint `two` contradicts one; they are dependent whatever the dimensions";
    assert!(contradicts.contains(words), "{contradicts}");
}

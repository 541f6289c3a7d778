//! Inputs over the motion of a study.

use crate::{directory, limits, table};
use kin_runtime::mechanism;
use kin_study::{Ramp, Range, Score, Study, StudyError, Watch, run};

/// An arm whose angle is an input, on a carriage that another input moves.
#[mechanism]
#[bodies(carriage, arm)]
#[translational(rail: ground @ (0, 0), carriage @ (0, 0), axis = (1, 0))]
#[revolute(pin: carriage @ (0, 0), arm @ (0, 0))]
#[input(angle)]
#[input(place, default = 0.25)]
#[driver(motor: arm.phi = angle)]
#[driver(spindle: carriage.x = place)]
#[point(tip = arm @ (l, 0))]
struct Arm {
    #[param(0.5)]
    l: f64,
}

/// The scores of one arm at these instants.
fn scores(times: &[f64], at: f64) -> Vec<f64> {
    let score = |of: &str| Score::At { of: of.to_owned(), t: at };
    let study = Study::new()
        .rows(1)
        .parameter("l", Range::Fixed(0.5))
        .times(times)
        .input("angle", Ramp { from: 0.5, to: -1.0 })
        .score("turned", score("arm.phi"))
        .score("rate", score("arm.phi_dot"))
        .score("along", score("tip.x"));
    let target = directory();
    run::<Arm>(&study, target.path(), limits(1), &Watch::default()).expect("it runs");
    let text = table(target.path());
    let row = text.lines().nth(1).expect("there is a row");
    row.split(',').skip(2).take(3).map(|number| number.parse().expect("a number")).collect()
}

#[test]
fn an_input_changes_at_a_constant_rate_and_rests_at_a_single_instant() {
    let close = |found: Vec<f64>, [angle, rate]: [f64; 2]| {
        let expected = [angle, rate, 0.25 + 0.5 * angle.cos()];
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
    };
    close(scores(&[1.0, 2.0, 3.0], 3.0), [-1.0, -0.75]);
    close(scores(&[1.0, 2.0, 3.0], 2.0), [-0.25, -0.75]);
    // Backwards in time.
    close(scores(&[3.0, 1.0], 1.0), [-1.0, 0.75]);
    close(scores(&[2.0], 2.0), [0.5, 0.0]);
}

#[test]
fn an_input_without_a_value_is_named() {
    let study = Study::new().rows(1).parameter("l", Range::Fixed(0.5)).times(&[0.0]);
    let error = run::<Arm>(&study, directory().path(), limits(1), &Watch::default()).expect_err("it has no angle");
    assert!(matches!(&error, StudyError::Description { message, .. } if message.contains("`angle`")), "{error}");
}

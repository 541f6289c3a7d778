//! What holds for every function.

use super::{CubicSpline, MotionLaw, Polynomial, ScalarFunction, Sequence};
use crate::scalar::Interval;

fn functions() -> Vec<(String, Box<dyn ScalarFunction>)> {
    let knots = [0.0, 0.4, 1.0, 1.1, 2.0];
    let values = [0.0, 1.0, -0.5, 0.7, 0.0];
    let sequence = || {
        Sequence::starting_at(0.0, 0.3)
            .dwell(0.2)
            .rise(MotionLaw::ModifiedSine, 0.5, 0.7)
            .polynomial(&[0.0, 1.0, -3.0, 2.5, -0.5], 0.6)
            .fall(MotionLaw::Polynomial345, 0.5, 0.5)
    };
    let mut all: Vec<(String, Box<dyn ScalarFunction>)> = vec![
        ("polynomial".into(), Box::new(Polynomial([0.3, -2.0, 0.5, 1.0]))),
        ("natural".into(), Box::new(CubicSpline::natural(&knots, &values).unwrap())),
        ("clamped".into(), Box::new(CubicSpline::clamped(&knots, &values, 1.0, -2.0).unwrap())),
        ("periodic spline".into(), Box::new(CubicSpline::periodic(&knots, &values).unwrap())),
        ("sequence".into(), Box::new(sequence().build().unwrap())),
        ("periodic sequence".into(), Box::new(sequence().periodic().unwrap())),
    ];
    all.extend(MotionLaw::ALL.map(|law| (law.to_string(), Box::new(law) as Box<dyn ScalarFunction>)));
    all
}

#[test]
fn values_are_within_the_enclosure() {
    for (name, f) in functions() {
        for k in 0..200 {
            let from = -3.0 + 0.041 * f64::from(k);
            for width in [1e-9, 1e-3, 0.03, 0.31, 1.3, 2.0, 5.0] {
                let enclosure = f.enclose(Interval::new(from, from + width));
                for i in 0..=40 {
                    let value = f.evaluate(from + width * f64::from(i) / 40.0)[0];
                    let near = Interval::around(value, 1e-13 * (1.0 + value.abs()));
                    assert!(
                        enclosure.intersection(near).is_some(),
                        "{name} over {from} + {width}: {enclosure}, {value}"
                    );
                }
            }
        }
    }
}

/// Over a short interval an enclosure is hardly wider than the function, and exact where the motion rests.
#[test]
fn enclosures_become_narrow() {
    for (name, f) in functions() {
        for k in 0..200 {
            let from = -1.0 + 0.0217 * f64::from(k);
            let enclosure = f.enclose(Interval::new(from, from + 1e-6));
            let most = 1e-5 * (1.0 + f.evaluate(from)[1].abs());
            assert!(enclosure.upper() - enclosure.lower() < most, "{name} at {from}: {enclosure}");
        }
    }
    let rest = Sequence::starting_at(0.0, 0.0).dwell(1.0).build().unwrap().enclose(Interval::new(0.1, 0.9));
    assert_eq!([0.0, 0.0], [rest.lower(), rest.upper()]);
    assert!(!super::FromFn(|x: f64| [x, 1.0, 0.0]).enclose(Interval::from(1.0)).is_defined());
    for (_, f) in functions() {
        assert!(!f.enclose(Interval::UNDEFINED).is_defined());
    }
}

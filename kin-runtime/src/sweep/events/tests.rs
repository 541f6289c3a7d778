//! Tests of the parts of event location.

use super::sample::Sample;
use super::shape::{CurveShape, doubt, is_known, shape};
use super::watch::EventWatch;
use crate::equations::Equations;
use crate::equations::system::Evaluator;
use crate::fixture::Approaching;
use crate::nonlinear::root::{Value, bracket, tolerance};
use crate::options::Options;
use crate::signal::Instant;
use crate::state::State;

/// The bracket of a root of `f`, which returns a value and a derivative, and the number of evaluations.
fn located(f: impl Fn(f64) -> (f64, f64), lo: f64, hi: f64) -> ([Value; 2], usize) {
    let mut trials = 0;
    let value = |t: f64| {
        let (f, rate) = f(t);
        Value { t, f, rate }
    };
    let ends = bracket(value(lo), value(hi), 1e-12, |t| {
        trials += 1;
        Some(value(t))
    });
    (ends, trials)
}

#[test]
fn a_bracket_closes_from_both_sides() {
    type Function<'f> = &'f dyn Fn(f64) -> (f64, f64);
    let cases: [(Function<'_>, f64); 5] = [
        (&|t| (0.3 - t, -1.0), 0.3),
        (&|t: f64| (t.cos(), -t.sin()), core::f64::consts::FRAC_PI_2),
        (&|t| (2.0 - t * t * t, -3.0 * t * t), 2.0_f64.cbrt()),
        (&|t: f64| (1e-3 - (t - 1.0).powi(3), -3.0 * (t - 1.0).powi(2)), 1.1),
        // Functions without a derivative, and with a wrong one.
        (&|t: f64| (0.7 - t, f64::NAN), 0.7),
    ];
    for (k, (f, zero)) in cases.into_iter().enumerate() {
        for (lo, hi) in [(0.0, 2.0), (-0.5, 1.9)] {
            let ([a, b], trials) = located(f, lo, hi);
            assert!((a.t - b.t).abs() <= 1e-12, "{k}: {a:?} {b:?}");
            assert!((a.t - zero).abs() < 1e-10, "{k}: {a:?} and {zero}");
            assert!(trials < if k == 4 { 60 } else { 40 }, "{k}: {trials}");
        }
    }
    let ([a, b], _) = located(|t| (t - 0.3, 1.0), 2.0, -1.0);
    assert!(a.t > b.t && (a.t - 0.3).abs() < 1e-10, "time runs backwards");
    let (_, trials) = located(|t: f64| (t.cos(), -t.sin()), 1.0, 2.0);
    assert!(trials <= 6, "{trials}");
}

#[test]
fn where_nothing_can_be_evaluated_the_bracket_stays_open() {
    let ends = [Value { t: 0.0, f: 1.0, rate: -1.0 }, Value { t: 1.0, f: -1.0, rate: -1.0 }];
    assert_eq!(bracket(ends[0], ends[1], 1e-12, |_| None), ends);
    let half = |t: f64| (t < 0.45).then_some(Value { t, f: 0.5 - t, rate: -1.0 });
    let [a, b] = bracket(ends[0], ends[1], 1e-12, half);
    assert!(a.t > 0.2 && b.t == 1.0);
}

#[test]
fn instants_are_located_to_what_they_can_be() {
    assert_eq!(tolerance(1.0), 1e-12);
    assert_eq!(tolerance(1e4), 5e-11);
    assert!(tolerance(1e9) > f64::EPSILON * 1e9);
}

fn sample(t: f64, value: f64, rate: f64, acceleration: f64) -> Sample {
    Sample { t, value, rate, acceleration, noise: 1e-15 }
}

/// The shape of a polynomial between two times.
fn course(c: [f64; 4], a: f64, b: f64) -> CurveShape {
    let at = |t: f64| {
        let value = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
        sample(t, value, c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]), 2.0 * c[2] + 6.0 * t * c[3])
    };
    shape(&at(a), &at(b), 0.0)
}

#[test]
fn shapes_are_what_they_are_called() {
    for (a, b) in [(-1.0, 1.0), (1.0, -1.0)] {
        assert_eq!(course([3.0, 1.0, 0.5, 0.0], a, b), CurveShape::Clear);
        assert_eq!(course([0.2, 2.0, 0.1, 0.0], a, b), CurveShape::Monotone);
        assert_eq!(course([-0.1, 0.2, 1.0, 0.0], a, b), CurveShape::Turning);
        assert_eq!(course([0.0, -1.0, 0.0, 2.0], a, b), CurveShape::Unclear);
        assert_eq!(course([0.0; 4], a, b), CurveShape::Still);
    }
    // Two equal values with a wave between them.
    let wave = |t: f64| sample(t, t.sin() + 0.5, t.cos(), -t.sin());
    assert_eq!(shape(&wave(0.1), &wave(0.1 + core::f64::consts::TAU), 0.0), CurveShape::Unclear);
    let unknown = sample(1.0, 0.1, f64::NAN, f64::NAN);
    assert_eq!(shape(&sample(0.0, 1.0, 0.0, 0.0), &unknown, 0.0), CurveShape::Unclear);
}

/// Three samples of a sine, of which the first and the last are `width` apart.
fn wave(from: f64, width: f64, place: f64) -> [Sample; 3] {
    [0.0, place, 1.0].map(|s| {
        let t = from + s * width;
        sample(t, t.sin(), t.cos(), -t.sin())
    })
}

/// A slow course is predicted to the last digits; one that oscillates between its samples is not, whatever the samples
/// look like.
#[test]
fn a_third_sample_shows_what_two_do_not() {
    let quintic = |t: f64| sample(t, t.powi(5) - t, 5.0 * t.powi(4) - 1.0, 20.0 * t.powi(3));
    assert!(doubt(&quintic(-0.4), &quintic(0.3), &quintic(1.0)) < 1e-13);
    for from in 0..60 {
        let from = 0.1 * f64::from(from);
        for place in [0.3, 0.5, 0.7] {
            let [a, m, b] = wave(from, 0.3, place);
            assert!(doubt(&a, &m, &b) < 1e-5 && is_known(&a, &b, doubt(&a, &m, &b)));
            assert!(doubt(&b, &m, &a) < 1e-5, "time may run backwards");
            for waves in 2..40 {
                let [a, m, b] = wave(from, core::f64::consts::TAU * f64::from(waves), place);
                assert!(doubt(&a, &m, &b) > 1.0, "{waves} waves from {from}");
            }
        }
    }
    // A sample near an end says nothing about the rest of the interval, and neither does one without a derivative.
    let [a, m, b] = wave(0.0, 1e-3, 0.01);
    assert_eq!(doubt(&a, &m, &b), f64::INFINITY);
    let [a, m, b] = wave(0.0, 0.1, 0.5);
    assert!(doubt(&a, &Sample { rate: f64::NAN, ..m }, &b).is_nan());
    assert_eq!(shape(&a, &b, f64::NAN), CurveShape::Unclear);
    // Two samples may look like a parabola although a third one shows a deviation.
    let parabola = |t: f64| sample(t, 3.0 - t * t, -2.0 * t, -2.0);
    let wavy = sample(0.1, 0.5, 4.0, 30.0);
    assert_eq!(shape(&parabola(-1.0), &parabola(1.0), 0.0), CurveShape::Clear);
    let doubted = doubt(&parabola(-1.0), &wavy, &parabola(1.0));
    assert_eq!(shape(&parabola(-1.0), &parabola(1.0), doubted), CurveShape::Unclear);
}

#[test]
fn the_side_at_the_limit_is_where_the_motion_goes() {
    for (rate, acceleration, side) in [
        (1.0, 0.0, true),
        (-1.0, 0.0, false),
        (0.0, 1.0, true),
        (0.0, -1.0, false),
        (0.0, 0.0, false),
        (-1e-9, 1.0, true),
    ] {
        assert_eq!(sample(0.0, 0.0, rate, acceleration).side_after(1.0), side, "{rate} {acceleration}");
    }
    assert!(!sample(0.0, 0.0, 1.0, 0.0).side_after(-1.0), "backwards");
    assert!(sample(0.0, 1e-3, -9.0, 0.0).side_after(1.0), "not there yet");
}

/// Watches the condition of [`Approaching`] from t = 0 to 1, where only the first `solved` intermediate states can be solved. Returns the t
/// of the event, its uncertainty, and the number of intermediate states requested.
fn watched(limit: f64, solved: usize) -> (f64, f64, usize) {
    let system = Box::new(Evaluator::<_, Approaching>::new(Approaching { limit }));
    let mut equations = Equations::new(system, Options::default(), &[], None, &Instant::at(0.0)).unwrap();
    let model = equations.model;
    let state = |t: f64| State {
        model,
        t,
        inputs: Vec::new(),
        q: vec![limit - t, 0.0, 0.0],
        q_dot: vec![-1.0, 0.0, 0.0],
        q_ddot: vec![0.0; 3],
        bodies: Vec::new(),
        points: Vec::new(),
        residual: 0.0,
        iterations: 0,
        condition: Some(1.0),
        degrees_of_freedom_left: 0,
    };
    let mut watch = EventWatch::start(&mut equations, &state(0.0)).unwrap().unwrap();
    let mut asked = 0;
    let mut between = |_: &mut Equations<'_>, t: f64| {
        asked += 1;
        (asked <= solved).then(|| state(t))
    };
    watch.pass(&mut equations, &state(1.0), &mut between).unwrap();
    let [event] = watch.events() else { panic!("{:?}", watch.events()) };
    assert_eq!(event.t, event.state.t);
    (event.t, event.within, asked)
}

#[test]
fn an_event_without_a_state_of_its_own_has_the_nearer_end() {
    let (t, within, asked) = watched(0.3, usize::MAX);
    assert!((t - 0.3).abs() < 1e-12 && within < 1e-11, "{t} {within}");
    // No intermediate state can be solved: the whole interval is the uncertainty.
    for (limit, end) in [(0.3, 0.0), (0.7, 1.0)] {
        let (t, within, _) = watched(limit, 0);
        assert_eq!((t, within), (end, 1.0));
    }
    // The event is located but its state cannot be solved: the uncertainty is the distance to the nearer end.
    for (limit, end) in [(0.3, 0.0), (0.7, 1.0)] {
        let (t, within, again) = watched(limit, asked - 1);
        assert_eq!((t, again), (end, asked));
        assert!((within - 0.3).abs() < 1e-9, "{within}");
    }
}

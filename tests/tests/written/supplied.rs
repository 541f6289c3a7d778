//! Supplied functions: every type that the field of a function can have.

#![allow(unreachable_pub, reason = "public as in a library of a user")]

use kin_runtime::function::{CubicSpline, FromFn, MotionLaw, Polynomial, Sequence};
use kin_runtime::{Instant, Kinematics, Mechanism, ScalarFunction, SolveError, mechanism};
use std::rc::Rc;
use std::sync::Arc;

/// x = lift(t) + ½ lift(x)² for any function `lift`.
#[mechanism]
#[function(lift)]
#[coordinates(x)]
#[driver(d: x - 0.5 * pow(lift(x), 2) = lift(t))]
#[guess(x = lift(0))]
struct Cam<F> {
    lift: F,
}

/// sin(x)/3 and its derivatives, supplied as a closure, a struct, behind pointers and so on.
fn sine(x: f64) -> [f64; 3] {
    [x.sin() / 3.0, x.cos() / 3.0, -x.sin() / 3.0]
}

struct Sine;

impl ScalarFunction for Sine {
    fn evaluate(&self, x: f64) -> [f64; 3] {
        sine(x)
    }
}

/// The acceleration of the cam at t = 0.4.
fn acceleration<F: ScalarFunction>(lift: F) -> f64 {
    let cam = Cam { lift };
    assert!(cam.cross_check().unwrap().passes(1e-12));
    let state = cam.state_at(&Instant::at(0.4)).unwrap();
    let ([f, f1, f2], [_, g1, g2]) = (cam.lift.evaluate(state.q[0]), cam.lift.evaluate(0.4));
    let v = g1 / (1.0 - f * f1);
    let a = (g2 + (f1 * f1 + f * f2) * v * v) / (1.0 - f * f1);
    assert!((state.q_dot[0] - v).abs() < 1e-14 && (state.q_ddot[0] - a).abs() < 1e-14);
    state.q_ddot[0]
}

#[test]
fn a_function_can_have_any_type() {
    let expected = acceleration(Sine);
    let boxed: Box<dyn ScalarFunction> = Box::new(Sine);
    let shared: Arc<dyn ScalarFunction + Send + Sync> = Arc::new(Sine);
    let borrowed: &dyn ScalarFunction = &Sine;
    let third = 3.0;
    let captured = FromFn(move |x: f64| [x.sin() / third, x.cos() / third, -x.sin() / third]);
    let all = [
        acceleration(boxed),
        acceleration(Rc::new(Sine)),
        acceleration(shared),
        acceleration(borrowed),
        acceleration(&Sine),
        acceleration(captured),
        acceleration(FromFn(sine as fn(f64) -> [f64; 3])),
    ];
    assert!(all.iter().all(|a| *a == expected), "{all:?} {expected}");
    acceleration(Polynomial(vec![0.1, 0.2, -0.1]));
}

/// Lifetimes, const generics beside generic functions, arrays of a generic type, raw identifiers.
#[mechanism]
#[function(lift, stroke, r#fn)]
#[coordinates(x, y, z)]
#[driver(a: x = scale * lift(t))]
#[driver(b: y = stroke[0](t) + stroke[1](x))]
#[driver(c: z + 0.1 * r#fn(z) = t)]
struct Several<'a, T, F, const N: usize> {
    lift: &'a F,
    scale: T,
    stroke: [Box<F>; 2],
    r#fn: FromFn<fn(f64) -> [f64; 3]>,
    label: [T; 1],
}

#[test]
fn generics_of_all_kinds_go_together() {
    let lift = Sine;
    let several = Several::<f64, Sine, 3> {
        lift: &lift,
        scale: 0.5,
        stroke: [Box::new(Sine), Box::new(Sine)],
        r#fn: FromFn(sine),
        label: [0.0],
    };
    let state = several.state_at(&Instant::at(0.7)).unwrap();
    let x = 0.5 * sine(0.7)[0];
    assert!((state.q[0] - x).abs() < 1e-15);
    assert!((state.q[1] - sine(0.7)[0] - sine(x)[0]).abs() < 1e-15);
    assert!(several.cross_check().unwrap().passes(1e-12));
    let model = <Several<'_, f64, Sine, 3> as kin_runtime::Mechanism>::model();
    assert_eq!(model.functions, ["lift", "stroke[0]", "stroke[1]", "fn"]);
    assert_eq!(model.parameters.len(), 2);
}

/// A default for the type parameter of the function, which the test that `cross_check` generates needs to name the
/// type.
#[mechanism(cross_check)]
#[function(lift)]
#[coordinates(x)]
#[driver(d: x = lift(omega * t))]
pub struct WithDefault<F = CubicSpline> {
    lift: F,
    omega: f64,
}

impl Default for WithDefault {
    fn default() -> Self {
        let lift = CubicSpline::clamped(&[-2.0, -0.5, 0.3, 2.0], &[0.0, 1.0, 0.5, 0.0], 0.0, 0.0);
        Self { lift: lift.expect("a sound table"), omega: 1.5 }
    }
}

/// The textbook case of a cam: a cycloidal rise of 30 mm over 120° at 10 rad/s has the peaks 2hω/β and 2πhω²/β².
#[test]
fn peaks_of_a_cycloidal_cam() {
    use std::f64::consts::{PI, TAU};
    let (h, beta, omega) = (0.03, TAU / 3.0, 10.0);
    let law = |law| Sequence::starting_at(0.0, 0.0).rise(law, h, beta).build().expect("a sound sequence");
    let cam = WithDefault { lift: law(MotionLaw::Cycloidal), omega };
    let at = |angle: f64| cam.state_at(&Instant::at(angle / omega)).unwrap();
    let middle = at(beta / 2.0);
    assert!((middle.q[0] - h / 2.0).abs() < 1e-15);
    assert!((middle.q_dot[0] - 2.0 * h * omega / beta).abs() < 1e-13);
    let quarter = at(beta / 4.0).q_ddot[0];
    assert!((quarter - TAU * h * (omega / beta).powi(2)).abs() < 1e-12);
    // The same cam with a harmonic rise: the factors are π/2 and π²/2.
    let cam = WithDefault { lift: law(MotionLaw::Harmonic), omega };
    let at = |angle: f64| cam.state_at(&Instant::at(angle / omega)).unwrap();
    assert!((at(beta / 2.0).q_dot[0] - PI / 2.0 * h * omega / beta).abs() < 1e-13);
    assert!((at(0.0).q_ddot[0] - PI * PI / 2.0 * h * (omega / beta).powi(2)).abs() < 1e-12);
}

/// A wrong supplied derivative enters both sides of the comparison with dual numbers; the finite differences of the
/// function itself show it.
#[test]
fn wrong_derivatives_fail_the_cross_check_by_name() {
    #[mechanism]
    #[function(good, bad)]
    #[coordinates(x, y)]
    #[driver(d: x = good(t))]
    #[constraint(e: y = bad(x + 0.2 * y))]
    struct Two<F> {
        good: Sine,
        bad: F,
    }
    for (first, second, derivative) in [(1.001, 1.0, "f′"), (1.0, 0.999, "f″"), (1.0, 0.0, "f″")] {
        let bad = FromFn(move |x: f64| [x.sin(), first * x.cos(), -second * x.sin()]);
        let two = Two { good: Sine, bad };
        let check = two.cross_check().unwrap();
        assert!(check.max_error < 1e-12 && !check.passes(1e-12), "{check}");
        let worst = check.worst_function().unwrap();
        assert_eq!((worst.function, worst.derivative), ("bad", derivative), "{check}");
        assert!(worst.error > 5e-4 && worst.arguments > 0);
        assert!(check.functions.iter().any(|f| f.function == "good" && f.error < 1e-9 && f.arguments > 0));
        // The message of the test that `#[mechanism(cross_check)]` generates.
        let said = kin_runtime::private::cross_check(&two).unwrap_err();
        assert!(said.contains(&format!("function `bad`: {derivative} is")), "{said}");
    }
    let nan = Two { good: Sine, bad: FromFn(|x: f64| [x, 1.0, f64::NAN]) };
    assert!(!nan.cross_check().unwrap().passes(1e300));
}

/// Where a function has no value, analyses return typed errors and cross-checks skip the configuration.
#[test]
fn where_a_function_has_no_value_there_is_no_answer() {
    let root = |x: f64| [x.sqrt(), 0.5 / x.sqrt(), -0.25 / (x * x.sqrt())];
    let cam = WithDefault { lift: FromFn(root), omega: 1.0 };
    assert!((cam.state_at(&Instant::at(0.25)).unwrap().q[0] - 0.5).abs() < 1e-15);
    let error = cam.state_at(&Instant::at(-0.25)).unwrap_err();
    assert!(matches!(error, SolveError::NonFinite { .. }), "{error:?}");
    // A value without derivatives does not suffice for a velocity.
    let error = cam.state_at(&Instant::at(0.0)).unwrap_err();
    assert!(matches!(error, SolveError::NonFinite { .. }), "{error:?}");
    let check = cam.cross_check().unwrap();
    assert!(check.skipped > 0 && check.configurations > 0 && check.passes(1e-12), "{check}");
    // Beside a large constant, rounding hides the function's variation: the argument is counted as skipped.
    let hidden = FromFn(|x: f64| [1e12 + 1e-3 * x, 1e-3 + 1e-18 * x, 1e-18]);
    let check = WithDefault { lift: hidden, omega: 1.0 }.cross_check().unwrap();
    let [of_lift] = &check.functions[..] else { panic!("{check}") };
    assert!(of_lift.skipped > 0 && of_lift.arguments == 0, "{of_lift:?}");
}

/// Functions in places other than rows of position level: in a row of velocity level, in a point, in a guess.
#[mechanism]
#[function(speed, reach, first)]
#[coordinates(s)]
#[body(arm, x = 0, y = 0)]
#[point_on_line(slot: arm @ (0, reach(0.25)), ground @ (1, 0.5), axis = (1, 0))]
#[nonholonomic(rate: dot(s) = speed(0.5 * t))]
#[guess(s = first(0.125), arm.phi = 0.1)]
struct Elsewhere {
    speed: Sine,
    reach: Sine,
    first: Sine,
}

#[test]
fn functions_are_checked_wherever_they_stand() {
    let model = Elsewhere::model();
    let elsewhere = Elsewhere { speed: Sine, reach: Sine, first: Sine };
    let mut arguments = vec![0.0_f64; model.arguments.len()];
    elsewhere.write_arguments(&[], &Instant::at(3.0), &[0.0; 2], &mut arguments).unwrap();
    let mut found: Vec<_> = model.arguments.iter().map(|&function| model.functions[function]).zip(arguments).collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(found, [("first", 0.125), ("reach", 0.25), ("speed", 1.5)]);
}

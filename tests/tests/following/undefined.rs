//! Instants at which a formula has no value or no derivative are errors, and no numbers from beside them.

use kin_runtime::function::FromFn;
use kin_runtime::{Instant, Kinematics, SolveError, mechanism};

/// The second derivative of √u³ is infinite at 0.
#[mechanism]
#[coordinates(u, v)]
#[driver(a: u = t)]
#[driver(b: v = u*sqrt(u))]
struct InfiniteAcceleration;

/// The first derivative of u ln u is infinite at 0, and the formula has no value there.
#[mechanism]
#[coordinates(u, v)]
#[driver(a: u = t)]
#[driver(b: v = u*ln(u))]
struct InfiniteRate;

/// 1 on one side of 0, −1 on the other.
#[mechanism]
#[coordinates(u, v)]
#[driver(a: u = t)]
#[driver(b: v = u/abs(u))]
struct Jump;

/// The distance of two blocks has a corner where they meet.
#[mechanism]
#[body(a, x = 0, phi = 0)]
#[body(b, y = 0, phi = 0)]
#[body(s, x = 0, phi = 0)]
#[driver(da: a.y = t)]
#[driver(db: b.x = t)]
#[constraint(c: s.y = a.y*distance(a @ (0, 0), b @ (0, 0)))]
struct Meeting;

/// A lift that is the square root of the sine of the cam's angle, to the third power.
#[mechanism]
#[bodies(crank, slider)]
#[revolute(o: ground @ (0, 0), crank @ (0, 0))]
#[x(sx: slider @ (0, 0) = 0)]
#[angle(sp: slider = 0)]
#[driver(d: crank.phi = t)]
#[constraint(cam: slider.y = sin(crank.phi)*sqrt(sin(crank.phi)))]
struct Cam;

#[mechanism]
#[function(f)]
#[coordinates(u, v)]
#[driver(a: u = t)]
#[driver(b: v = f(u))]
struct Supplied<F> {
    f: F,
}

/// Asserts that the state at 0 is an error about a number that is not finite, and so are motions that begin there.
fn assert_undefined<M: Kinematics>(mechanism: &M) {
    for error in [
        mechanism.state_at(&Instant::at(0.0)).err(),
        mechanism.kinematic_analysis(&[0.0, 0.5]).err().map(|error| error.source),
        mechanism.kinematic_analysis(&[0.5, 0.0]).err().map(|error| error.source),
    ] {
        let Some(error) = error else { panic!("a state at 0") };
        assert!(error.to_string().contains("is not a finite number at t = 0"), "{error}");
    }
    assert!(mechanism.state_at(&Instant::at(0.5)).is_ok());
}

#[test]
fn where_a_derivative_is_infinite_there_is_no_state() {
    assert_undefined(&InfiniteAcceleration);
    assert_undefined(&InfiniteRate);
    assert_undefined(&Jump);
    assert_undefined(&Meeting);
    assert_undefined(&Cam);
}

#[test]
fn where_a_supplied_function_has_no_value_there_is_no_state() {
    let undefined = |at: f64, values: [f64; 3]| if at == 0.0 { [f64::NAN; 3] } else { values };
    assert_undefined(&Supplied { f: FromFn(move |x: f64| undefined(x, [x.sin(), x.cos(), -x.sin()])) });
    let second = |x: f64| [x.sin(), x.cos(), if x == 0.0 { f64::NAN } else { -x.sin() }];
    let state = Supplied { f: FromFn(second) }.state_at(&Instant::at(0.0));
    assert!(matches!(state, Err(SolveError::NonFinite { .. })), "{state:?}");
}

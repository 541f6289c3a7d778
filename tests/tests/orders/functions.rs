//! Every function of the expression language: its Taylor series at one instant gives its values at neighbouring
//! instants.

use crate::expands;
use kin_runtime::function::{FromFn, Polynomial};
use kin_runtime::{Kinematics, ScalarFunction, SolveError, mechanism};

/// u is driven; every other coordinate is a function of u, so that one recursion finds all the series.
#[mechanism]
#[coordinates(u, v)]
#[coordinates(sine, cosine, tangent, arcsine, arccosine, arctangent, angle, second_angle, exponential, logarithm)]
#[coordinates(root, absolute, negative, power, falling, product, quotient, inverse, squared, high, mixed, below)]
#[driver(drive: u = 0.4 + 0.3 * sin(1.3 * t) + 0.1 * t * t)]
#[driver(other: v = 0.7 - 0.2 * cos(t + 0.3))]
#[constraint(f00: sine = sin(u * v))]
#[constraint(f01: cosine = cos(u * v))]
#[constraint(f02: tangent = tan(u))]
#[constraint(f03: arcsine = asin(u - 0.1))]
#[constraint(f04: arccosine = acos(u * v))]
#[constraint(f05: arctangent = atan(2 * u))]
#[constraint(f06: angle = atan2(u, v))]
#[constraint(f07: second_angle = atan2(-0.3, -u))]
#[constraint(f08: exponential = exp(-2 * u))]
#[constraint(f09: logarithm = ln(u))]
#[constraint(f10: root = sqrt(1 + u * v))]
#[constraint(f11: absolute = abs(u))]
#[constraint(f12: negative = abs(v - 2))]
#[constraint(f13: power = pow(u, 2.7))]
#[constraint(f14: falling = pow(u + 1, -1.5))]
#[constraint(f15: product = u * v * (u - v))]
#[constraint(f16: quotient = (u - 1) / (1 + v * v))]
#[constraint(f17: inverse = 2 / u)]
#[constraint(f18: squared = (u - v) * (u - v))]
#[constraint(f19: high = pow(u - 1.2, 40) * 1000)]
#[constraint(f20: mixed = sin(root) + exp(sine) * logarithm - tangent / absolute)]
#[constraint(f21: below = abs(cos(u + 2) * v))]
struct Functions;

#[test]
fn functions_of_the_language_have_their_series() {
    let solver = Functions.solver();
    let solver = (0..24).fold(solver, |solver, k| solver.with_guess(k, 0.5));
    for t in [0.0, 0.35, 0.8] {
        expands(&solver, t, 0.06, 16, 3e-13);
    }
}

/// A power with a whole exponent whose base is 0 at t = 1: for orders below the exponent, its derivatives exist there
/// and are 0.
#[mechanism]
#[coordinates(a, b, c)]
#[driver(whole: a = pow(t - 1, 40))]
#[driver(real: b = pow(t - 1, 4.5))]
#[driver(still: c = abs(t - t) + 2 * abs(3 * (t - t)))]
struct Powers;

#[test]
fn powers_of_nothing_vanish_as_long_as_they_exist() {
    let solver = Powers.solver();
    let state = solver.state(&1.0.into()).unwrap();
    let derivatives = solver.derivatives(&state, 4).unwrap();
    assert!(derivatives.q.iter().flatten().all(|value| *value == 0.0), "{derivatives:?}");
    let error = solver.derivatives(&state, 5).unwrap_err();
    assert_eq!(SolveError::NotSmooth { t: 1.0, order: 5, row_name: "real", joint: "real" }, error);
}

/// Powers whose base is 0 at t = 1, with derivatives that are not 0 there.
#[mechanism]
#[coordinates(a, b, c)]
#[driver(fifth: a = pow(t - 1, 5))]
#[driver(twelfth: b = pow(t - 1, 12))]
#[driver(of_another: c = pow(sin(a), 3))]
struct WholePowers;

#[test]
fn whole_powers_of_nothing_have_all_their_derivatives() {
    let solver = WholePowers.solver();
    let derivatives = solver.derivatives(&solver.state(&1.0.into()).unwrap(), 15).unwrap();
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    for (order, q) in derivatives.q.iter().enumerate() {
        let at = |k: u32| if order == k as usize { factorial(k) } else { 0.0 };
        // The lowest term of sin³ a is a³ = (t − 1)¹⁵.
        for (found, expected) in q.iter().zip([at(5), at(12), at(15)]) {
            assert!((found - expected).abs() <= 1e-13 * expected, "{order}: {found} {expected}");
        }
    }
}

/// Absolute values in a row of velocity level, where their derivatives are signs.
#[mechanism]
#[coordinates(u, v, w)]
#[driver(drive: u = 0.4 + 0.3 * t * t)]
#[nonholonomic(along: dot(v) = 2 * dot(abs(cos(u + 2))))]
#[nonholonomic(kink: dot(w) = dot(abs(u - 0.7)))]
struct Signs;

#[test]
fn signs_are_constant_where_they_are_there() {
    let solver = Signs.solver();
    let state = solver.state(&0.5.into()).unwrap();
    let derivatives = solver.derivatives(&state, 9).unwrap();
    let cosine = Cosine.solver();
    let expected = cosine.derivatives(&cosine.state(&0.5.into()).unwrap(), 9).unwrap();
    for (order, (found, expected)) in derivatives.q.iter().zip(&expected.q).enumerate().skip(1) {
        assert!(
            (found[1] + 2.0 * expected[1]).abs() < 1e-12 * (1.0 + expected[1].abs()),
            "{order}: {found:?} {expected:?}"
        );
        assert!((found[2] + found[0]).abs() < 1e-13, "{order}: {found:?}");
    }
    // u passes 0.7 at t = 1 with u̇ ≠ 0.
    let error = solver.derivatives(&solver.state(&1.0.into()).unwrap(), 3).unwrap_err();
    assert_eq!(SolveError::NotSmooth { t: 1.0, order: 3, row_name: "kink", joint: "kink" }, error);
}

/// The cosine of [`Signs`] as a constraint of its own.
#[mechanism]
#[coordinates(u, c)]
#[driver(drive: u = 0.4 + 0.3 * t * t)]
#[constraint(is: c = cos(u + 2))]
struct Cosine;

/// e^(0.3 x), whose derivatives of every order are supplied.
#[derive(Default)]
struct Growth;

impl ScalarFunction for Growth {
    fn evaluate(&self, x: f64) -> [f64; 3] {
        [0, 1, 2].map(|order| 0.3_f64.powi(order) * (0.3 * x).exp())
    }

    fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
        out.iter_mut().enumerate().for_each(|(order, place)| *place = 0.3_f64.powi(order as i32) * (0.3 * x).exp());
        out.len()
    }
}

/// Supplied functions, also composed with one another, a curve, and a row of velocity level that needs their
/// derivative.
#[mechanism]
#[function(growth, cubic)]
#[coordinates(u, f, g, h, b, k)]
#[bodies(cam)]
#[body(follower, x = 0.1, phi = 0)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[driver(turn: cam.phi = 0.3 * u)]
#[driver(drive: u = 0.2 + 0.5 * t + 0.2 * sin(t))]
#[constraint(f_is: f = growth(u * u))]
#[constraint(g_is: g = growth(cubic(u)) + cubic(t))]
#[constraint(h_is: h = growth(0.5) * u)]
#[on_curve(face: cam @ (0, 0), follower @ (0, 0), parametric(b) = (b, growth(b)))]
#[nonholonomic(k_is: dot(k) = dot(growth(u * u)) * growth(k))]
#[guess(follower.y = 1, b = 0)]
struct Supplied {
    growth: Box<Growth>,
    cubic: Polynomial<[f64; 4]>,
}

/// The same mechanism with the functions written as expressions.
#[mechanism]
#[coordinates(u, f, g, h, b, k)]
#[bodies(cam)]
#[body(follower, x = 0.1, phi = 0)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[driver(turn: cam.phi = 0.3 * u)]
#[driver(drive: u = 0.2 + 0.5 * t + 0.2 * sin(t))]
#[constraint(f_is: f = exp(0.3 * u * u))]
#[constraint(g_is: g = exp(0.3 * (1 - u + 0.5 * u * u + 0.25 * u * u * u)) + 1 - t + 0.5 * t * t + 0.25 * t * t * t)]
#[constraint(h_is: h = exp(0.15) * u)]
#[on_curve(face: cam @ (0, 0), follower @ (0, 0), parametric(b) = (b, exp(0.3 * b)))]
#[nonholonomic(k_is: dot(k) = dot(exp(0.3 * u * u)) * exp(0.3 * k))]
#[guess(follower.y = 1, b = 0)]
struct WrittenOut;

#[test]
fn supplied_functions_are_what_they_say() {
    let supplied = Supplied { growth: Box::new(Growth), cubic: Polynomial([1.0, -1.0, 0.5, 0.25]) };
    for t in [0.0, 0.4, 1.1] {
        let state = supplied.solver().state(&t.into()).unwrap();
        let found = supplied.solver().derivatives(&state, 9).unwrap();
        let expected = WrittenOut.solver().derivatives(&state, 9).unwrap();
        for (order, (found, expected)) in found.q.iter().zip(&expected.q).enumerate() {
            let size = expected.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-11 * size, "{order}: {found} {expected}");
            }
        }
    }
}

/// A closure supplies derivatives up to the second. For the argument t³, whose first two derivatives are 0 at t = 0,
/// order 8 does not need the third derivative.
#[mechanism]
#[function(known)]
#[coordinates(u)]
#[driver(drive: u = known(pow(t, 3)))]
struct Resting<F> {
    known: FromFn<F>,
}

#[test]
fn an_argument_at_rest_asks_for_no_derivative() {
    let resting = Resting { known: FromFn(|x: f64| [x.sin(), x.cos(), -x.sin()]) };
    let solver = resting.solver();
    // sin t³ = t³ − t⁹/6 + …: order 8 needs at most the term (t³)², order 9 the third derivative of the sine.
    let state = solver.state(&0.0.into()).unwrap();
    let derivatives = solver.derivatives(&state, 8).unwrap();
    let expected = [0.0, 0.0, 0.0, 6.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    assert_eq!(expected[..], derivatives.q.concat()[..]);
    let error = solver.derivatives(&state, 9).unwrap_err();
    let right = SolveError::UnknownDerivative { t: 0.0, order: 9, what: "function", name: "known", known: 2 };
    assert_eq!(right, error);
}

//! Derivatives of all orders by plans that have an iteration, that watch redundant rows, and that use functions and
//! inputs.

use kin_runtime::function::{FromFn, Polynomial};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, Signal, SolveError, Solver, mechanism};
use kin_tests::mechanisms::RedundantParallelogram;

/// Derivatives by the plan against those from the factorisation of Φ_q as a whole.
fn agrees<M: Mechanism>(mechanism: &M, at: &Instant<'_>, highest: usize) {
    let options = Options { use_plan: false, ..Options::default() };
    let solver = Solver::new(mechanism).with_options(options);
    let state = solver.state(at).unwrap();
    let further = vec![&[0.0; 20][..]; M::INPUTS];
    let expected = solver.derivatives_with(&state, highest, &further).unwrap();
    assert!(!expected.by_plan);
    let found = Solver::new(mechanism).derivatives_with(&state, highest, &further).unwrap();
    let redundant = M::model().plan.redundant_rows().count();
    assert_eq!(found.by_plan, highest > 2 && redundant == 0, "{}", M::model().name);
    for (order, (found, expected)) in found.q.iter().zip(&expected.q).enumerate() {
        // A derivative is k! times a Taylor coefficient, and so is its rounding error.
        let factorial: f64 = (1..=order).map(|k| k as f64).product();
        let size = expected.iter().fold(1.0_f64.max(1e-2 * factorial), |size, value| size.max(value.abs()));
        for (found, expected) in found.iter().zip(expected) {
            let off = (found - expected).abs();
            assert!(off <= 1e-11 * size, "{}, {order} of {highest}: {found} {expected}", M::model().name);
        }
    }
}

/// Kepler's equation, and the points of an orbit.
#[mechanism]
#[coordinates(mean, eccentric)]
#[driver(drive: mean = 1.3 * t)]
#[constraint(kepler: eccentric - 0.4 * sin(eccentric) = mean)]
#[derive(Default)]
struct Orbit;

#[test]
fn iterations_take_all_orders_along() {
    assert!(!Orbit::model().plan.orientations.is_empty());
    for highest in [2, 3, 4, 6, 9, 10, 14] {
        agrees(&Orbit, &Instant::at(0.8), highest);
    }
}

#[test]
fn redundant_rows_change_nothing() {
    for highest in [3, 10, 12] {
        agrees(&RedundantParallelogram::default(), &Instant::at(0.3), highest);
    }
}

/// A crank driven by an input, and a follower on a cam that is a polynomial.
#[mechanism]
#[function(lift)]
#[input(turn)]
#[bodies(crank)]
#[coordinates(follower)]
#[revolute(O: ground @ (0, 0), crank @ (-0.2, 0))]
#[driver(drive: crank.phi = sin(turn))]
#[constraint(rise: follower = lift(crank.phi) + lift(0.3))]
struct Cam<F> {
    lift: F,
}

#[test]
fn functions_and_inputs_have_their_orders() {
    let cam = Cam { lift: Polynomial([0.1, 0.2, -0.4, 0.3, 0.5]) };
    let inputs = [Signal::new(0.3, 0.7, -0.2)];
    let at = Instant { t: 0.5, inputs: &inputs };
    for highest in 2..13 {
        agrees(&cam, &at, highest);
    }
    let state = cam.solver().state(&at).unwrap();
    for highest in 3..13 {
        // The third derivative of the input is unknown.
        let error = cam.solver().derivatives(&state, highest).unwrap_err();
        assert!(matches!(error, SolveError::UnknownDerivative { order: 3, name: "turn", .. }), "{error}");
    }
}

/// A cam at the end of a crank that turns with constant angular acceleration.
#[mechanism]
#[function(lift)]
#[bodies(crank)]
#[coordinates(follower)]
#[revolute(O: ground @ (0, 0), crank @ (-0.2, 0))]
#[driver(drive: crank.phi = 0.3 + 0.7 * t + 0.2 * t * t)]
#[constraint(rise: follower = lift(crank.phi) + lift(0.3))]
struct Turned<F> {
    lift: F,
}

#[test]
fn functions_are_taken_as_far_as_they_are_known() {
    let cam = Turned { lift: Polynomial([0.1, 0.2, -0.4, 0.3, 0.5]) };
    for highest in [3, 5, 7, 10, 12] {
        agrees(&cam, &Instant::at(0.5), highest);
    }
    let cam = Turned { lift: FromFn(|x: f64| [x.sin(), x.cos(), -x.sin()]) };
    agrees(&cam, &Instant::at(0.5), 2);
    let state = cam.solver().state(&Instant::at(0.5)).unwrap();
    let error = cam.solver().derivatives(&state, 3).unwrap_err();
    assert!(matches!(error, SolveError::UnknownDerivative { order: 3, name: "lift", .. }), "{error}");
}

/// A coupler between two sliders on guides.
#[mechanism]
#[bodies(c, s1, s2)]
#[translational(g1: ground @ (0, 0), s1 @ (0, 0), axis = (cos(a), sin(a)))]
#[translational(g2: ground @ (1, 0.2), s2 @ (0, 0), axis = (cos(b), sin(b)))]
#[distance(d1: s1 @ (0, 0.1), c @ (0, 0), length = 0.6953749147313977)]
#[distance(d2: s2 @ (0, 0), c @ (0.6, 0), length = 1.3707711901635675)]
#[distance(d3: ground @ (0.5, 1.5), c @ (0.3, 0.4), length = 0.9572663434341714)]
#[constraint(k: s1.x * cos(a) + s1.y * sin(a) + kk * (s2.x * cos(b) + s2.y * sin(b)) = 0.4216729721715238 + 0.2 * t)]
#[driver(dd: distance(ground @ (-1, 1), c @ (0.1, 0.1)) = 1.3661678237493766 + 0.1 * sin(-t))]
struct Coupler {
    a: f64,
    b: f64,
    kk: f64,
}

/// A step of the plan may be nearly singular where the mechanism is regular: the error of a derivative by the plan would
/// grow with every order.
#[test]
fn derivatives_beside_a_singular_step_are_as_exact_as_elsewhere() {
    let coupler = Coupler { a: 0.9617616121003589, b: 1.385949150094027, kk: -0.4094861659106881 };
    let q = [
        0.45285173715186056,
        0.4234411755746373,
        -4.589763595582437,
        0.683218711484432,
        0.9795488871392515,
        0.0,
        1.336605219019393,
        2.000204367543975,
        0.0,
    ];
    let full = coupler.solver().with_options(Options { use_plan: false, ..Options::default() });
    let state = full.state_from(&Instant::at(-0.6654592869846936), &q).unwrap();
    let expected = full.derivatives(&state, 10).unwrap().q;
    let found = coupler.solver().derivatives(&state, 10).unwrap().q;
    for (order, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= 1e-9 * size, "order {order}: {:e}", off / size);
    }
}

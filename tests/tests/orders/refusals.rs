//! If a derivative of some order does not exist or is not known, the error names the function, row or input.

use kin_runtime::function::FromFn;
use kin_runtime::series::HigherOrders;
use kin_runtime::{Derivatives, Instant, Kinematics, Mechanism, Options, Signal, SolveError, mechanism};

/// A row with an absolute value whose argument is 0 at t = 1.
#[mechanism]
#[coordinates(u, v)]
#[driver(drive: u = t - 1)]
#[constraint(kink: v = abs(u) + abs(t - 1))]
struct Kink;

#[mechanism]
#[coordinates(u, v)]
#[driver(drive: u = pow(t - 1, 2))]
#[constraint(branch: v * v * v + v = sqrt(u))]
struct Branch;

#[mechanism]
#[coordinates(u, v)]
#[driver(drive: u = t - 1)]
#[constraint(pole: v = (1 - cos(u)) / u)]
struct Pole;

/// The error of order 3 at t = 1, for a state with arbitrary q, q̇, q̈.
fn refused<M: Kinematics>(mechanism: &M) -> SolveError {
    let mut state = mechanism.state_at(&1.5.into()).unwrap();
    state.t = 1.0;
    state.q = vec![0.0; M::COORDINATES];
    mechanism.solver().derivatives(&state, 3).unwrap_err()
}

#[test]
fn where_nothing_is_smooth_the_row_is_named() {
    let error = refused(&Kink);
    assert_eq!(SolveError::NotSmooth { t: 1.0, order: 3, row_name: "kink", joint: "kink" }, error);
    let said = "row `kink` of joint `kink` has no derivative of order 3 at t = 1: a root, a divisor or an absolute \
                value in it is 0";
    assert_eq!(said, error.to_string());
    // If velocity analysis fails there too, its own error is returned.
    assert!(matches!(refused(&Branch), SolveError::NonFinite { .. } | SolveError::NotSmooth { .. }));
    assert!(matches!(refused(&Pole), SolveError::NonFinite { .. } | SolveError::NotSmooth { .. }));
}

/// One input drives a coordinate, one drives a rate, and one is used in a define only.
#[mechanism]
#[input(lift, pace, note)]
#[coordinates(u, v, w, z)]
#[driver(raise: u = sin(lift))]
#[nonholonomic(go: dot(v) = pace)]
#[nonholonomic(along: dot(z) = 2 * dot(lift))]
#[driver(plain: w = t)]
#[define(said = u * note)]
struct Told;

#[test]
fn inputs_are_known_as_far_as_they_are_given() {
    let inputs = [Signal::new(0.3, 0.7, -0.2), Signal::new(0.1, 0.2, 0.4), Signal::new(1.0, 2.0, 3.0)];
    let at = Instant { t: 0.5, inputs: &inputs };
    let solver = Told.solver();
    let state = solver.state(&at).unwrap();
    let unknown = |order, name, known| SolveError::UnknownDerivative { t: 0.5, order, what: "input", name, known };
    let error = solver.derivatives(&state, 3).unwrap_err();
    assert_eq!(unknown(3, "lift", 2), error);
    let said =
        "the derivative of order 3 at t = 0.5 needs a derivative of the input `lift` above order 2, which is not known";
    assert_eq!(said, error.to_string());

    // Given the third derivative of `lift`, and with the acceleration of `pace`, v has a third derivative.
    let third = solver.derivatives_with(&state, 3, &[&[0.9]]).unwrap();
    let (sin, cos) = 0.3_f64.sin_cos();
    let expected = cos * (0.9 - 0.7_f64.powi(3)) - sin * 3.0 * 0.7 * -0.2;
    assert!((third.q[3][0] - expected).abs() < 1e-14 && (third.q[3][1] - 0.4).abs() < 1e-15, "{third:?}");
    assert!((third.q[3][3] - 1.8).abs() < 1e-15, "{third:?}");
    assert_eq!(unknown(4, "lift", 3), solver.derivatives_with(&state, 4, &[&[0.9]]).unwrap_err());
    assert_eq!(unknown(4, "pace", 2), solver.derivatives_with(&state, 4, &[&[0.9, 0.1]]).unwrap_err());
    let fourth = solver.derivatives_with(&state, 4, &[&[0.9, 0.1], &[0.25]]).unwrap();
    assert!((fourth.q[4][1] - 0.25).abs() < 1e-15);

    // Only the define needs `note`.
    assert_eq!(unknown(3, "note", 2), solver.motion_derivatives(&third).unwrap_err());
    let known = solver.derivatives_with(&state, 3, &[&[0.9], &[], &[4.0]]).unwrap();
    let motion = solver.motion_derivatives(&known).unwrap();
    let leibniz = known.q[3][0] * 1.0 + 3.0 * known.q[2][0] * 2.0 + 3.0 * known.q[1][0] * 3.0 + known.q[0][0] * 4.0;
    assert!((motion.defines[0][3] - leibniz).abs() < 1e-14);

    // Up to the second order no derivative of an input is missing.
    assert_eq!(3, solver.derivatives(&state, 2).unwrap().q.len());
    let second = solver.derivatives(&state, 2).unwrap();
    solver.motion_derivatives(&second).unwrap();
    let nothing = Derivatives { q: Vec::new(), ..second };
    assert_eq!(0, nothing.order());
    assert!(matches!(solver.motion_derivatives(&nothing), Err(SolveError::Length(_))));
    assert!(matches!(solver.derivatives_with(&state, 3, &[&[], &[], &[], &[]]), Err(SolveError::Length(_))));
    let bad = solver.derivatives_with(&state, 3, &[&[f64::NAN]]).unwrap_err();
    assert_eq!(SolveError::NonFinite { what: "inputs", index: 0, name: "lift", t: None }, bad);
}

/// A supplied function with derivatives up to the second.
#[mechanism]
#[function(cam)]
#[coordinates(u, v)]
#[driver(drive: u = 1 + 0.5 * t)]
#[constraint(follow: v = cam(u))]
struct Followed<F> {
    cam: FromFn<F>,
}

#[test]
fn functions_are_known_as_far_as_they_say() {
    let followed = Followed { cam: FromFn(|x: f64| [x.exp(), x.exp(), x.exp()]) };
    let solver = followed.solver();
    let state = solver.state(&0.2.into()).unwrap();
    assert_eq!(3, solver.derivatives(&state, 2).unwrap().q.len());
    let error = solver.derivatives(&state, 5).unwrap_err();
    let right = SolveError::UnknownDerivative { t: 0.2, order: 3, what: "function", name: "cam", known: 2 };
    assert_eq!(right, error);
    let said = "the derivative of order 3 at t = 0.2 needs a derivative of the function `cam` above order 2, which is \
                not known";
    assert_eq!(said, error.to_string());
}

/// Two coordinates tied by one equation: one degree of freedom is left, which `with_given` can prescribe.
#[mechanism]
#[coordinates(u, v)]
#[constraint(sum: u + v = sin(t))]
struct Free;

#[test]
fn prescribed_coordinates_go_on_with_constant_acceleration() {
    let solver = Free.solver().with_given(0, Signal::new(0.3, 0.2, 0.1));
    let state = solver.state(&0.4.into()).unwrap();
    let found = solver.derivatives(&state, 5).unwrap();
    let sine = [0.4_f64.sin(), 0.4_f64.cos(), -0.4_f64.sin(), -0.4_f64.cos(), 0.4_f64.sin(), 0.4_f64.cos()];
    for (q, sine) in found.q.iter().zip(&sine).skip(3) {
        assert!(q[0].abs() < 1e-15 && (q[1] - sine).abs() < 1e-15, "{found:?}");
    }
    // Without a prescribed coordinate the derivatives of least norm are returned, as for q̇ and q̈.
    let found = Free.solver().derivatives(&Free.state_at(&0.4.into()).unwrap(), 4).unwrap();
    assert!(found.q[1..].iter().zip(&sine[1..]).all(|(q, s)| q.iter().all(|value| (value - 0.5 * s).abs() < 1e-15)));
}

/// Two drivers of one coordinate whose derivatives agree up to the second, and only at t = 0.
#[mechanism(allow_redundant)]
#[coordinates(u)]
#[driver(first: u = t)]
#[driver(second: u = t + pow(t, 3))]
struct Parting;

#[test]
fn redundant_rows_must_agree_in_every_order() {
    let solver = Parting.solver();
    let state = solver.state(&0.0.into()).unwrap();
    let error = solver.derivatives(&state, 3).unwrap_err();
    assert!(matches!(error, SolveError::InconsistentDerivative { t: 0.0, order: 3, rank: 1, .. }), "{error}");
    assert!(error.to_string().starts_with("no derivative of order 3 satisfies all rows at t = 0: row "), "{error}");
}

/// An invalid state is an error, as in every other analysis.
#[test]
fn states_are_checked() {
    let state = Free.state_at(&0.4.into()).unwrap();
    let mut short = state.clone();
    short.q_ddot.pop();
    assert!(matches!(Free.solver().derivatives(&short, 3), Err(SolveError::Length(_))));
    let mut bad = state;
    bad.q_dot[1] = f64::NAN;
    assert!(matches!(Free.solver().derivatives(&bad, 3), Err(SolveError::NonFinite { what: "q_dot", .. })));
}

/// A four-bar without a driver.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
struct Undriven;

/// A slider-crank.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.4, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 1000 * t)]
#[guess(slider.x = 0.5)]
struct Slider;

#[test]
fn without_a_plan_no_order_is_by_it() {
    assert!(Undriven::model().plan.absent.is_some());
    let state = Undriven.state_at(&Instant::at(0.0)).unwrap();
    let found = Undriven.solver().derivatives(&state, 4).unwrap();
    assert!(!found.by_plan && found.q.iter().flatten().all(|x| x.is_finite()));
}

/// The derivatives of a state that is not the plan's are those of Φ at the given q, q̇ and q̈.
#[test]
fn orders_belong_to_the_state_that_is_given() {
    let options = Options { use_plan: false, ..Options::default() };
    let state = Slider.state_at(&Instant::at(0.0013)).unwrap();
    let third = |state: &kin_runtime::State, use_plan: bool| {
        let solver = if use_plan { Slider.solver() } else { Slider.solver().with_options(options) };
        solver.derivatives(state, 3).unwrap().q.swap_remove(3)
    };
    let off = |a: &[f64], b: &[f64]| {
        let size = b.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
    };
    let own = third(&state, true);
    assert!(off(&own, &third(&state, false)) < 1e-12);
    for change in 0..3 {
        let mut other = state.clone();
        match change {
            0 => other.q[5] += 1e-5,
            1 => other.q_dot[5] += 1.0,
            _ => other.q_ddot[5] += 1e3,
        }
        let found = third(&other, true);
        assert!(off(&found, &third(&other, false)) < 1e-12 && off(&found, &own) > 1e-7, "{change}");
    }
}

#[test]
fn orders_beyond_the_range_of_numbers_are_an_error_of_their_own() {
    let state = Slider.state_at(&Instant::at(0.0003)).unwrap();
    let refused = |order: usize| match Slider.solver().derivatives(&state, order) {
        Ok(found) => assert!(found.q.iter().flatten().all(|x| x.is_finite()), "{order}"),
        Err(error) => assert_eq!(error.to_string(), SolveError::OutOfRange { t: state.t, order }.to_string()),
    };
    assert!(Slider.solver().derivatives(&state, 60).is_ok());
    assert_eq!(170, HigherOrders::<Slider>::MOST);
    for order in [171, 172, 1000, usize::MAX] {
        refused(order);
    }
    // The derivatives grow as k! (ω/2)ᵏ, which exceeds the range of `f64` from this order on.
    let error = Slider.solver().derivatives(&state, 150).unwrap_err();
    let SolveError::OutOfRange { order, .. } = error else { panic!("{error}") };
    assert!((70..=85).contains(&order), "{order}");
}

/// A finite right-hand side whose solution overflows because of a small pivot.
#[mechanism]
#[coordinates(u, v)]
#[driver(drive: u = t)]
#[constraint(lever: 0.001 * v = u * u * u)]
struct Lever;

/// The difference of two terms that both overflow.
#[mechanism]
#[coordinates(u, v, w)]
#[driver(drive: u = t)]
#[driver(other: v = t)]
#[constraint(difference: w = exp(u) * u - exp(v) * v)]
struct Difference;

#[test]
fn solutions_beyond_the_range_of_numbers_are_an_error_of_their_own_too() {
    for use_plan in [true, false] {
        let options = Options { use_plan, ..Options::default() };
        let out_of_range = Err(SolveError::OutOfRange { t: 0.0, order: 3 });

        // v⃛ = 6000 u̇³ is just within the range of `f64` first.
        let mut state = Lever.state_at(&0.0.into()).unwrap();
        let solver = Lever.solver().with_options(options);
        state.q_dot[0] = 3e101;
        let within = solver.derivatives(&state, 3).unwrap();
        assert!((within.q[3][1] / 1.62e308 - 1.0).abs() < 1e-12, "{within:?}");
        state.q_dot[0] = 4e101;
        assert_eq!(out_of_range, solver.derivatives(&state, 3));

        let mut state = Difference.state_at(&0.0.into()).unwrap();
        let solver = Difference.solver().with_options(options);
        (state.q_dot[0], state.q_dot[1]) = (1e150, 1e150);
        (state.q_ddot[0], state.q_ddot[1]) = (1e250, 1e250);
        assert_eq!(out_of_range, solver.derivatives(&state, 3));
    }
}

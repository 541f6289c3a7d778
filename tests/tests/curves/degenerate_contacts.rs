//! Degenerate points of curves: every analysis reports them with the name of the joint.

use kin_runtime::{Degeneracy, Instant, Kinematics, SolveError, mechanism};

/// A pin on a heart-shaped curve, moved along x.
#[mechanism]
#[bodies(pin)]
#[angle(upright: pin = 0)]
#[on_curve(track: ground @ (0.1, 0), pin @ (0, 0.2), polar(theta) = r * (1.5 + cos(theta)))]
#[driver(feed: pin.x = 0.1 + t)]
struct Polar {
    #[param(0.3)]
    r: f64,
}

/// A roller on a curve with a cusp at u = 0.
#[mechanism]
#[bodies(roller)]
#[coordinates(u)]
#[angle(upright: roller = 0)]
#[on_curve(cusp: ground @ (0, 0), roller @ (0, 0), parametric(u) = (u.powi(3), u*u), roller = 0.1)]
#[driver(feed: u = t)]
struct Cusp;

/// A pin on a lemniscate, which crosses itself at the origin.
#[mechanism]
#[bodies(pin)]
#[angle(upright: pin = 0)]
#[on_curve(loops: ground @ (0, 0), pin @ (0, 0), implicit(X, Y) = (X*X + Y*Y).powi(2) - 2*a*a*(X*X - Y*Y))]
#[driver(feed: pin.x = t)]
#[guess(pin.y = 0.1)]
struct Lemniscate {
    #[param(0.5)]
    a: f64,
}

/// A polar curve whose formula has no value on one half.
#[mechanism]
#[bodies(pin)]
#[angle(upright: pin = 0)]
#[on_curve(half: ground @ (0, 0), pin @ (0, 0), polar(theta) = 0.2 + sqrt(cos(theta)))]
#[driver(feed: pin.x = -1 + t)]
struct Half;

/// The degenerate contact at which an analysis ends, and its message.
fn contact<T: std::fmt::Debug>(result: Result<T, SolveError>) -> (&'static str, f64, Degeneracy, String) {
    match result {
        Err(error @ SolveError::DegenerateContact { joint, t, what, .. }) => (joint, t, what, error.to_string()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_polar_curve_at_its_centre() {
    let (at, centre) = (Instant::at(0.0), [0.1, -0.2, 0.0]);
    let mechanism = Polar::default();
    let (joint, t, what, message) = contact(mechanism.velocity_analysis(&at, &centre));
    assert_eq!((joint, t, what), ("track", 0.0, Degeneracy::Centre { distance: 0.0 }));
    assert!(message.contains("`track`") && message.contains("t = 0") && message.contains("centre"), "{message}");
    // Rounding errors near the centre do not hide the degeneracy.
    for off in [1e-14, 1e-20, 7.7e-34, 1e-160] {
        let (_, _, what, _) = contact(mechanism.velocity_analysis(&at, &[0.1 + off, -0.2 - off, 0.0]));
        assert!(matches!(what, Degeneracy::Centre { distance } if distance < 1e-13), "{what:?}");
    }
    _ = contact(mechanism.position_analysis(&at, &centre));
    _ = contact(mechanism.acceleration_analysis(&at, &centre, &[0.0; 3]));
    // Assembly does not depend on whether its start is degenerate.
    let state = mechanism.state_at(&at).unwrap_or_else(|error| panic!("{error}"));
    assert!((state.q[1] + 0.2).abs() > 0.1);
}

/// The same curve with a point that is not at the origin of its body, and a rotated body.
#[mechanism]
#[bodies(pin)]
#[angle(turned: pin = 0.7)]
#[on_curve(track: ground @ (0.1, 0), pin @ (0.3, 0.2), polar(theta) = 0.3 * (1.5 + cos(theta)))]
#[driver(feed: pin.x = 0.1 + t)]
struct Turned;

#[test]
fn the_centre_is_met_by_the_point_of_a_turned_body() {
    let (sin, cos) = 0.7_f64.sin_cos();
    let q = [0.1 - (0.3 * cos - 0.2 * sin), -(0.3 * sin + 0.2 * cos), 0.7];
    for off in [0.0, 1e-14] {
        let found = contact(Turned.velocity_analysis(&Instant::at(0.0), &[q[0] + off, q[1], q[2]]));
        assert!(matches!(found, ("track", _, Degeneracy::Centre { distance }, _) if distance < 1e-13), "{found:?}");
    }
}

#[test]
fn a_roller_at_a_cusp() {
    let at = Instant::at(0.0);
    let (joint, t, what, message) = contact(Cusp.velocity_analysis(&at, &[0.0, 0.1, 0.0, 0.0]));
    assert_eq!((joint, t, what), ("cusp", 0.0, Degeneracy::Direction { parameter: "u", value: 0.0 }));
    assert!(message.contains("u = 0"), "{message}");
    // A solved position is as near to the cusp as rounding allows.
    let (_, _, what, _) = contact(Cusp.state_at(&at));
    assert!(matches!(what, Degeneracy::Direction { parameter: "u", value } if value.abs() < 1e-8), "{what:?}");
    assert!(Cusp.state_at(&Instant::at(0.2)).is_ok());
}

#[test]
fn an_implicit_curve_at_a_double_point() {
    let at = Instant::at(0.0);
    let lemniscate = Lemniscate::default();
    let (joint, t, what, message) = contact(lemniscate.state_at(&at));
    assert_eq!((joint, t), ("loops", 0.0));
    assert!(matches!(what, Degeneracy::Gradient { largest } if largest < 1e-6), "{what:?}");
    assert!(message.contains("double point"), "{message}");
    assert!(lemniscate.state_at(&Instant::at(0.3)).is_ok());
    // A sweep to the double point ends with an error that names the joint, and does not choose a branch there.
    let error = lemniscate.kinematic_analysis(&[0.3, 0.1, 0.0]).expect_err("no tangent at the double point");
    assert!(matches!(error.source, SolveError::DegenerateContact { joint: "loops", .. }), "{error}");
}

/// A roller whose radius is a parameter, on an ellipse.
#[mechanism]
#[bodies(roller)]
#[coordinates(u)]
#[angle(upright: roller = 0)]
#[on_curve(track: ground @ (0, 0), roller @ (0, 0), parametric(u) = (2 * cos(u), sin(u)), roller = r)]
#[driver(feed: u = t)]
struct Ellipse {
    #[param(0)]
    r: f64,
}

#[test]
fn a_roller_without_a_radius_is_a_point() {
    let state = Ellipse::default().state_at(&Instant::at(0.4)).unwrap_or_else(|error| panic!("{error}"));
    assert!((state.q[0] - 2.0 * 0.4_f64.cos()).abs() < 1e-12 && (state.q[1] - 0.4_f64.sin()).abs() < 1e-12);
}

#[test]
fn a_formula_without_a_value_is_no_degenerate_contact() {
    let error = Half.velocity_analysis(&Instant::at(0.0), &[-1.0, 0.0, 0.0]).expect_err("the root of −1");
    assert!(matches!(error, SolveError::NonFinite { name: "half", .. }), "{error}");
}

/// Rollers around cusps of two kinds, where the parameter of the curve is driven.
#[mechanism]
#[bodies(roller)]
#[coordinates(u)]
#[angle(upright: roller = 0)]
#[on_curve(cusp: ground @ (0, 0), roller @ (0, 0), parametric(u) = (u*u, u.powi(3)), roller = r)]
#[driver(feed: u = -1 + t)]
struct Beak {
    #[param(0.1)]
    r: f64,
}

/// At a cusp the normal reverses: with no grid does a sweep move a roller to the other side.
#[test]
fn no_sweep_steps_over_a_cusp() {
    for steps in [1, 2, 3, 7, 13, 15, 33, 101] {
        let times = |end: f64| (0..=steps).map(|k| end * f64::from(k) / f64::from(steps)).collect::<Vec<_>>();
        let error = Beak::default().kinematic_analysis(&times(2.0)).unwrap_err();
        assert!(error.trajectory.iter().all(|state| state.t < 1.0), "{steps}: {error}");
        assert!(error.to_string().contains("cusp"), "{steps}: {error}");
        let sweep = Cusp.kinematic_analysis(&times(2.0).iter().map(|t| t - 1.0).collect::<Vec<_>>());
        assert!(sweep.unwrap_err().trajectory.iter().all(|state| state.t < 0.0), "{steps}");
        // Sweeps that end before the cusp succeed.
        assert_eq!(Beak::default().kinematic_analysis(&times(0.9)).unwrap().len(), times(0.9).len());
    }
}

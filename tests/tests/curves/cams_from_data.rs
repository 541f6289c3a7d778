//! Cams whose profile is a supplied function or changes with an input.

use core::f64::consts::TAU;
use kin_runtime::function::CubicSpline;
use kin_runtime::{Instant, Kinematics, Mechanism, Signal, mechanism};

/// A cam given by tables of its pitch radius and of its support function, with a follower for each.
#[mechanism]
#[bodies(cam, roller, face, pin)]
#[coordinates(u)]
#[function(rho)]
#[function(h)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(up: ground @ (0, 0), roller @ (0, 0), axis = (0, 1))]
#[translational(down: ground @ (0, 0), face @ (0, 0), axis = (0, 1))]
#[translational(aside: ground @ (0, 0), pin @ (0, 0), axis = (1, 0))]
#[on_curve(rolls: cam @ (0, 0), roller @ (0, 0), polar(theta) = rho(theta))]
#[flat_follower(slides: cam @ (0, 0), face @ (0, 0), axis = (-1, 0), support(theta) = h(theta))]
#[on_curve(runs: cam @ (0, 0), pin @ (0, 0), parametric(u) = (rho(u)*cos(u), rho(u)*sin(u)))]
#[driver(drive: cam.phi = 0.3 + 2*t)]
#[guess(roller.y = 0.05, face.y = -0.05, pin.x = 0.05, u = -0.3)]
struct FromTable {
    rho: CubicSpline,
    h: CubicSpline,
}

/// A spline through the support function r + e cos θ of an eccentric circle.
fn table(r: f64, e: f64) -> CubicSpline {
    let angles: Vec<f64> = (0..=72).map(|k| TAU * f64::from(k) / 72.0).collect();
    let mut values: Vec<f64> = angles.iter().map(|theta| r + e * theta.cos()).collect();
    values[72] = values[0];
    CubicSpline::periodic(&angles, &values).expect("a turn")
}

fn from_table() -> FromTable {
    FromTable { rho: table(0.05, 0.012), h: table(0.04, 0.012) }
}

#[test]
fn supplied_profiles_give_the_closed_form_up_to_interpolation() {
    let cam = from_table();
    let times: Vec<f64> = (0..=40).map(|k| 0.1 * f64::from(k)).collect();
    let trajectory = cam.kinematic_analysis(&times).unwrap_or_else(|error| panic!("{error}"));
    let of = |name: &str| trajectory.column(name).unwrap();
    let (face, v, a) = (of("face.y"), of("face.y_dot"), of("face.y_ddot"));
    let (roller, pin) = (of("roller.y"), of("pin.x"));
    for (k, t) in times.iter().enumerate() {
        let phi = 0.3 + 2.0 * t;
        // For the face under the cam n = (0, −1) and θ = −π/2 − φ.
        assert!((face[k] + 0.04 - 0.012 * phi.sin()).abs() < 1e-8);
        assert!((v[k] - 0.024 * phi.cos()).abs() < 1e-6 && (a[k] + 0.048 * phi.sin()).abs() < 1e-4);
        assert!((roller[k] - 0.05 - 0.012 * phi.sin()).abs() < 1e-8);
        assert!((pin[k] - 0.05 - 0.012 * phi.cos()).abs() < 1e-8);
    }
}

#[test]
fn supplied_profiles_agree_with_dual_numbers() {
    assert!(from_table().cross_check().unwrap().passes(1e-11));
}

#[test]
fn supplied_profiles_can_be_drawn() {
    let cam = from_table();
    for (joint, r) in [("rolls", 0.05), ("runs", 0.05)] {
        let joint = FromTable::model().joints.iter().position(|j| j.name == joint).unwrap();
        let point = cam.curve_point(&Instant::at(0.0), joint, 1.0).unwrap().unwrap();
        let rho = r + 0.012 * 1.0_f64.cos();
        assert!((point.r[0] - rho * 1.0_f64.cos()).abs() < 1e-8 && (point.r[1] - rho * 1.0_f64.sin()).abs() < 1e-8);
    }
}

/// A cam whose eccentricity is an input.
#[mechanism]
#[bodies(cam, face, pin)]
#[coordinates(u)]
#[input(e)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(up: ground @ (0, 0), face @ (0, 0), axis = (0, 1))]
#[translational(aside: ground @ (0, 0), pin @ (0, 0), axis = (1, 0))]
#[flat_follower(slides: cam @ (0, 0), face @ (0, 0), axis = (1, 0), support(theta) = 0.04 + e*cos(theta))]
#[on_curve(runs: cam @ (0, 0), pin @ (0, 0), parametric(u) = (e + 0.04*cos(u), 0.04*sin(u)), roller = -0.01)]
#[driver(drive: cam.phi = 2*t)]
#[guess(face.y = 0.05, pin.x = 0.05)]
struct Adjusted;

#[test]
fn a_profile_that_changes_with_an_input_moves_its_followers() {
    let e = Signal { value: 0.012, rate: 0.02, acceleration: -0.3 };
    let inputs = [e];
    let at = Instant { t: 0.4, inputs: &inputs };
    assert!(Adjusted.cross_check().unwrap().passes(1e-12));
    let state = Adjusted.state_at(&at).unwrap_or_else(|error| panic!("{error}"));
    let of = |name: &str| Adjusted::model().coordinate(name).unwrap();
    let (sin, cos) = 0.8_f64.sin_cos();
    let face = of("face.y");
    assert!((state.q[face] - 0.04 - e.value * sin).abs() < 1e-13);
    assert!((state.q_dot[face] - e.rate * sin - 2.0 * e.value * cos).abs() < 1e-13);
    let acceleration = e.acceleration * sin + 4.0 * e.rate * cos - 4.0 * e.value * sin;
    assert!((state.q_ddot[face] - acceleration).abs() < 1e-12);
    // The distance between the roller's centre and the circle's centre is 0.05.
    let pin = state.q[of("pin.x")];
    assert!(((pin - e.value * cos).hypot(e.value * sin) - 0.05).abs() < 1e-13);
}

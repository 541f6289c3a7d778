//! Cams: the same motion in every formulation of the contact, and closed forms from textbooks.

use kin_runtime::{CurvePoint, Instant, Kinematics, Mechanism, Options, Trajectory, mechanism};
use kin_tests::compare::Differences;
use kin_tests::mechanisms::*;

/// The times of one turn of the shaft.
fn turn() -> Vec<f64> {
    (0..=60).map(|k| 0.05 * f64::from(k)).collect()
}

fn swept<M: Kinematics + Default>() -> Trajectory {
    M::default().kinematic_analysis(&turn()).unwrap_or_else(|error| panic!("{error}"))
}

fn column(trajectory: &Trajectory, name: &str) -> Vec<f64> {
    trajectory.column(name).unwrap_or_else(|| panic!("no column {name}"))
}

fn agree(a: &Trajectory, b: &Trajectory, coordinate: &str) {
    let mut differences = Differences::new();
    for suffix in ["", "_dot", "_ddot"] {
        let name = format!("{coordinate}{suffix}");
        differences.vector(&name, |k| turn()[k], &column(a, &name), &column(b, &name), 1e-11);
    }
    differences.finish();
}

#[test]
fn a_roller_cam_is_the_same_in_polar_implicit_and_parametric_form() {
    let polar = swept::<EccentricRollerPolar>();
    agree(&polar, &swept::<EccentricRollerImplicit>(), "follower.y");
    agree(&polar, &swept::<EccentricRollerParametric>(), "follower.y");
}

/// Newton's iteration of the plan for a parametric curve would find the contact on the other side of the cam, or a
/// parameter after dozens of revolutions, from many of these guesses.
#[test]
fn a_single_state_is_the_contact_that_full_newton_finds_however_far_the_cam_has_turned() {
    fn compare<M: Kinematics + Default>() {
        let mechanism = M::default();
        let full = mechanism.solver().with_options(Options { use_plan: false, ..Options::default() });
        for k in 0..600 {
            let at = Instant::at(-3.0 + 0.01 * f64::from(k));
            let [state, expected] = [mechanism.state_at(&at), full.state(&at)]
                .map(|state| state.unwrap_or_else(|error| panic!("{} {}: {error}", M::model().name, at.t)));
            for (found, expected) in state.q.iter().zip(&expected.q) {
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{} at {}: {:?} {:?}",
                    M::model().name,
                    at.t,
                    state.q,
                    expected
                );
            }
        }
    }
    compare::<EccentricRollerPolar>();
    compare::<EccentricRollerImplicit>();
    compare::<EccentricRollerParametric>();
    compare::<EllipticRoller>();
}

/// The plan solves it as any other roller.
#[test]
fn a_roller_of_radius_0_is_a_point_on_the_curve() {
    let mechanism = EccentricRollerParametric { roller: 0.0, ..Default::default() };
    for k in 0..20 {
        let at = Instant::at(0.05 * f64::from(k));
        let near = mechanism.state_at(&at).unwrap_or_else(|error| panic!("{error}"));
        let state = mechanism.solver().state_from(&at, &near.q).unwrap_or_else(|error| panic!("{error}"));
        assert!(state.condition.is_none(), "it was solved without the plan");
        let (shaft, y) = (state[EccentricRollerParametric::cam].phi, state[EccentricRollerParametric::follower].y);
        let distance = f64::hypot(0.005 - mechanism.e * shaft.cos(), y - mechanism.e * shaft.sin());
        assert!((distance - mechanism.r).abs() < 1e-14, "{distance} at step {k}");
    }
}

#[test]
fn a_roller_runs_on_the_parallel_curve_that_is_written_out() {
    let (roller, path) = (swept::<EllipticRoller>(), swept::<EllipticPath>());
    agree(&roller, &path, "lever.phi");
    agree(&roller, &path, "u");
}

/// The lift of an eccentric circle of radius r and eccentricity e under a flat face is r + e sin φ.
#[test]
fn the_lift_of_an_eccentric_circle_under_a_flat_face() {
    let EccentricFlatTranslating { r, e, w } = EccentricFlatTranslating::default();
    let trajectory = swept::<EccentricFlatTranslating>();
    let shaft = |t: f64| (0.3 + w * t + 0.2 * t * t, w + 0.4 * t, 0.4);
    let exact = |f: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
        let at = |t: &f64| {
            let (phi, phi_dot, phi_ddot) = shaft(*t);
            f(phi, phi_dot, phi_ddot)
        };
        turn().iter().map(at).collect()
    };
    let mut differences = Differences::new();
    let expected = [
        ("follower.y", exact(&|phi, _, _| r + e * phi.sin())),
        ("follower.y_dot", exact(&|phi, w, _| e * w * phi.cos())),
        ("follower.y_ddot", exact(&|phi, w, a| e * (a * phi.cos() - w * w * phi.sin()))),
    ];
    for (name, expected) in &expected {
        differences.vector(name, |k| turn()[k], expected, &column(&trajectory, name), 1e-13);
    }
    differences.finish();
}

/// The face of the lever is tangent to the circle: it is at the distance r from the circle's centre, on the outer side.
#[test]
fn the_face_of_an_oscillating_follower_touches_the_circle() {
    let cam = EccentricFlatOscillating::default();
    let trajectory = swept::<EccentricFlatOscillating>();
    let (phi, x, y) = (column(&trajectory, "cam.phi"), column(&trajectory, "lever.x"), column(&trajectory, "lever.y"));
    for (k, lever) in column(&trajectory, "lever.phi").into_iter().enumerate() {
        let centre = [cam.e * (phi[k] + cam.a).cos(), cam.e * (phi[k] + cam.a).sin()];
        let face = [x[k] + 0.15 * lever.cos() - cam.fy * lever.sin(), y[k] + 0.15 * lever.sin() + cam.fy * lever.cos()];
        let slope = lever + cam.vy.atan();
        let distance = -slope.sin() * (face[0] - centre[0]) + slope.cos() * (face[1] - centre[1]);
        assert!((distance - cam.r).abs() < 1e-13, "{distance} at step {k}");
    }
}

/// The contacts of the carriage's cams, checked from the poses alone: the roller's centre is at the distance r + R from
/// the circle's centre, the plate's face at the distance r.
#[test]
fn cams_on_a_moving_carriage_touch_their_followers() {
    let cams = CamsOnCarriage::default();
    let trajectory = swept::<CamsOnCarriage>();
    for i in 0..2 {
        let of = |what: &str| column(&trajectory, what);
        let body = |name: &str| ["x", "y", "phi"].map(|c| of(&format!("{name}[{i}].{c}")));
        let ([cam, tappet], plate) = (["cam", "tappet"].map(body), body("plate"));
        for k in 0..turn().len() {
            let e = cams.e[i];
            let centre = [cam[0][k] + e * cam[2][k].cos(), cam[1][k] + e * cam[2][k].sin()];
            let gap = (tappet[0][k] - centre[0]).hypot(tappet[1][k] - centre[1]);
            assert!((gap - cams.r - 0.01).abs() < 1e-12, "roller {i} at step {k}: {gap}");
            let (sin, cos) = plate[2][k].sin_cos();
            let down = sin * (plate[0][k] - centre[0]) - cos * (plate[1][k] - centre[1]);
            assert!((down - cams.r).abs() < 1e-12, "plate {i} at step {k}: {down}");
        }
    }
}

/// `theta` and `X` are the variables of a curve inside of curves only.
#[mechanism(cross_check)]
#[bodies(cam, arm, X)]
#[coordinates(Y)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[revolute(F: ground @ (1, 0), arm @ (0, 0))]
#[on_curve(rim: cam @ (0, 0), arm @ (theta, 0), polar(theta) = 0.7 + 0.1*cos(theta))]
#[fixed(weld: arm @ (0, 0), X @ (0, 0), angle = theta)]
#[on_curve(track: cam @ (0, 0), X @ (0, 0), parametric(Y) = ((0.5 + Y)*cos(theta), (0.5 + Y)*sin(theta)))]
#[guess(arm.phi = 2.0, Y = 0.4)]
struct Shadows {
    #[param(0.5)]
    theta: f64,
}

#[test]
fn variables_of_a_curve_shadow_other_names_inside_it_only() {
    let state = Shadows::default().state_at(&Instant::at(0.0)).unwrap_or_else(|error| panic!("{error}"));
    let at = |name: &str| state.q[Shadows::model().coordinate(name).unwrap()];
    let (x, y) = (1.0 + 0.5 * at("arm.phi").cos() - at("cam.x"), 0.5 * at("arm.phi").sin() - at("cam.y"));
    let theta = y.atan2(x) - at("cam.phi");
    assert!((x.hypot(y) - 0.7 - 0.1 * theta.cos()).abs() < 1e-13);
    assert!((at("X.phi") - at("arm.phi") - 0.5).abs() < 1e-13);
    assert!((at("Y") - 0.5).abs() < 1e-13);
}

#[test]
fn the_direction_of_a_face_is_never_wrapped() {
    let times: Vec<f64> = (0..=100).map(|k| 0.2 * f64::from(k)).collect();
    let cam = EccentricFlatTranslating::default();
    let contact = EccentricFlatTranslating::model().joints.iter().position(|joint| joint.name == "contact").unwrap();
    let solver = cam.solver();
    let trajectory = solver.sweep(&times).unwrap_or_else(|error| panic!("{error}"));
    for state in &trajectory.states {
        let motion = solver.motion(state).expect("a solved state");
        let theta = motion.joints[contact][0].value;
        let phi = 0.3 + cam.w * state.t + 0.2 * state.t * state.t;
        let expected = core::f64::consts::FRAC_PI_2 - phi;
        assert!((theta - expected).abs() < 1e-12, "{theta} and {expected}");
    }
}

/// The index of the joint called `name`.
fn joint<M: Mechanism>(name: &str) -> usize {
    M::model().joints.iter().position(|joint| joint.name == name).unwrap_or_else(|| panic!("no joint {name}"))
}

/// A point of a joint's curve; its tangent is compared with differences.
fn point<M: Mechanism>(mechanism: &M, name: &str, t: f64, s: f64) -> CurvePoint {
    let at = |s: f64| mechanism.curve_point(&Instant::at(t), joint::<M>(name), s).expect("no inputs").expect("a curve");
    let (found, h) = (at(s), 1e-4);
    for axis in 0..2 {
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(s + k * h).r[axis]);
        let slope = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
        assert!((slope - found.tangent[axis]).abs() < 1e-11, "{slope} and {:?}", found.tangent);
    }
    found
}

/// A point of the inertial frame in coordinates of a body.
fn seen(trajectory: &Trajectory, body: &str, k: usize, r: [f64; 2]) -> [f64; 2] {
    let [x, y, phi] = ["x", "y", "phi"].map(|c| column(trajectory, &format!("{body}.{c}"))[k]);
    let (sin, cos) = phi.sin_cos();
    let d = [r[0] - x, r[1] - y];
    [cos * d[0] + sin * d[1], -sin * d[0] + cos * d[1]]
}

fn close(a: [f64; 2], b: [f64; 2]) {
    assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12, "{a:?} and {b:?}");
}

#[test]
fn drawn_curves_go_through_the_contacts() {
    let (polar, parametric) = (swept::<EccentricRollerPolar>(), swept::<EccentricRollerParametric>());
    let ellipse = swept::<EllipticRoller>();
    for k in [0, 7, 23, 41] {
        let t = turn()[k];
        let follower = |trajectory: &Trajectory| ["x", "y"].map(|c| column(trajectory, &format!("follower.{c}"))[k]);
        let w = seen(&polar, "cam", k, follower(&polar));
        close(point(&EccentricRollerPolar::default(), "contact", t, w[1].atan2(w[0])).r, w);

        let cam = EccentricRollerParametric::default();
        let CurvePoint { r, tangent: [x, y] } = point(&cam, "contact", t, column(&parametric, "u")[k]);
        let outwards = [y, -x].map(|c| cam.roller * c / x.hypot(y));
        let centre = seen(&parametric, "cam", k, follower(&parametric));
        close([r[0] + outwards[0], r[1] + outwards[1]], centre);

        // The curve depends on its centre and on time.
        let u = column(&ellipse, "u")[k];
        let cam = EllipticRoller::default();
        let expected = [0.002 + (cam.a + 0.004 * t) * u.cos(), -0.004 + cam.b * u.sin()];
        close(point(&cam, "contact", t, u).r, expected);
    }
}

/// The face touches the drawn cam in one point, and the whole cam is on one side of it.
#[test]
fn a_flat_face_is_tangent_to_the_drawn_cam() {
    let (cam, trajectory) = (EccentricFlatTranslating::default(), swept::<EccentricFlatTranslating>());
    for k in [0, 13, 37] {
        let face = ["x", "y"].map(|c| column(&trajectory, &format!("follower.{c}"))[k]);
        let theta = core::f64::consts::FRAC_PI_2 - column(&trajectory, "cam.phi")[k];
        let normal = [theta.cos(), theta.sin()];
        let level = |r: [f64; 2]| normal[0] * r[0] + normal[1] * r[1];
        let height = level(seen(&trajectory, "cam", k, face));
        let contact = point(&cam, "contact", turn()[k], theta);
        assert!((level(contact.r) - height).abs() < 1e-13 && level(contact.tangent).abs() < 1e-13);
        for step in 1..60 {
            let other = point(&cam, "contact", turn()[k], theta + 0.1 * f64::from(step));
            assert!(level(other.r) < height);
        }
    }
}

#[test]
fn joints_without_a_curve_draw_none() {
    let at = Instant::at(0.0_f32);
    let implicit = EccentricRollerImplicit::default();
    for name in ["O", "guide", "contact"] {
        let none = implicit.curve_point(&at, joint::<EccentricRollerImplicit>(name), 0.5);
        assert_eq!(none, Ok(None), "{name}");
    }
    let family = CamsOnCarriage::default();
    let found = family.curve_point(&at, joint::<CamsOnCarriage>("roll[1]"), 0.0).unwrap().unwrap();
    assert!((found.r[0] - 0.06).abs() < 1e-7 && found.r[1].abs() < 1e-7);
    assert_eq!(family.curve_point(&at, 999, 0.0), Ok(None));
}

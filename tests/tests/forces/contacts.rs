//! The parts of contact forces, and where contacts lift off.

use crate::machines::*;
use kin_runtime::{Instant, Kinematics, Mechanism, Signal, State, mechanism};
use kin_tests::mechanisms::loaded;

fn near(found: f64, exact: f64, size: f64) {
    assert!((found - exact).abs() <= 1e-10 * size, "{found} instead of {exact}");
}

/// A translating follower of mass 2 on an eccentric disc of radius 5 whose centre turns with radius 1, pressed by its weight.
#[mechanism]
#[bodies(cam, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(way: ground @ (0, 0), follower @ (0, 0), axis = (0, 1))]
#[flat_follower(contact: cam @ (0, 0), follower @ (0, 0), axis = (1, 0), support(theta) = 0.05 + 0.01*cos(theta))]
#[driver(drive: cam.phi = omega*t)]
#[guess(follower.y = 0.05)]
#[gravity(0, -9.81)]
#[mass(follower @ (0, 0), mass = 2)]
struct Eccentric {
    #[param(40)]
    omega: f64,
}

#[test]
fn a_face_is_pressed_by_weight_and_inertia() {
    let cam = Eccentric::default();
    for t in [0.0, 0.013, 0.05, 0.11] {
        let state = cam.state_at(&Instant::at(t)).unwrap();
        let forces = cam.solver().forces(&state).unwrap();
        let contact = forces.reaction("contact").unwrap();
        // y = 0.05 + 0.01 sin ωt: the force is m (g + ÿ), the face carries nothing along itself.
        let exact = 2.0 * (9.81 - 0.01 * 1600.0 * (40.0 * t).sin());
        near(contact.normal.unwrap(), exact, 40.0);
        assert_eq!(None, contact.tangential);
    }
}

#[test]
fn a_follower_lifts_off_where_its_acceleration_reaches_gravity() {
    let cam = Eccentric::default();
    // 0.01 ω² sin ωt = g, and there again on the way back.
    let first = (9.81_f64 / 16.0).asin() / 40.0;
    let second = std::f64::consts::PI / 40.0 - first;
    let turn = std::f64::consts::TAU / 40.0;
    for steps in [24, 100] {
        let times: Vec<f64> = (0..=steps).map(|k| turn * f64::from(k) / f64::from(steps)).collect();
        let states = cam.solver().sweep(&times).unwrap().states;
        let changes = cam.solver().contact_changes(&states).unwrap();
        let found: Vec<_> = changes.iter().map(|change| (change.name, change.lifts_off)).collect();
        assert_eq!(vec![("contact", true), ("contact", false)], found);
        for (change, exact) in changes.iter().zip([first, second]) {
            assert!((change.t - exact).abs() < 1e-10, "{change}: {exact}");
            assert!(change.within < 1e-9);
        }
        assert_eq!("contact lifts off at t = ", &changes[0].to_string()[..25]);
        // Backwards, what lifts off presses again.
        let back: Vec<State> = states.into_iter().rev().collect();
        let changes = cam.solver().contact_changes(&back).unwrap();
        assert_eq!(vec![true, false], changes.iter().map(|change| change.lifts_off).collect::<Vec<_>>());
        assert!((changes[0].t - second).abs() < 1e-10);
    }
    // A little faster than where it only touches, both changes lie between two states.
    let cam = Eccentric { omega: 31.33 };
    let turn = std::f64::consts::TAU / cam.omega;
    let times: Vec<f64> = (0..=24).map(|k| turn * (f64::from(k) + 0.4) / 24.0).collect();
    let states = cam.solver().sweep(&times).unwrap().states;
    let changes = cam.solver().contact_changes(&states).unwrap();
    let first = (9.81 / (0.01 * cam.omega.powi(2))).asin() / cam.omega;
    assert_eq!(2, changes.len(), "{changes:?}");
    assert!((changes[0].t - first).abs() < 1e-7, "{changes:?} {first}");
    // And slower it never does.
    let cam = Eccentric { omega: 31.0 };
    let states = cam.solver().sweep(&times).unwrap().states;
    assert!(cam.solver().contact_changes(&states).unwrap().is_empty());
}

/// Normal and tangential parts are perpendicular parts of the force, along directions that geometry tells.
#[test]
fn rolling_discs_press_and_are_pulled_along() {
    for t in [0.1, 0.7, 2.0] {
        let state = Incline.state_at(&Instant::at(t)).unwrap();
        let forces = Incline.solver().forces(&state).unwrap();
        let track = forces.reaction("track").unwrap();
        let [x, y] = track.force.unwrap();
        // The axis (2, 0.5) in the beam, whose angle is the third coordinate.
        let (sin, cos) = (state.q[2] + 0.5_f64.atan2(2.0)).sin_cos();
        let size = x.hypot(y);
        near(track.normal.unwrap(), cos * y - sin * x, size);
        near(track.tangential.unwrap(), cos * x + sin * y, size);

        let state = Discs.state_at(&Instant::at(t)).unwrap();
        let forces = Discs.solver().forces(&state).unwrap();
        let contact = forces.reaction("contact").unwrap();
        let [x, y] = contact.force.unwrap();
        let (sin, cos) = (0.3 * (2.0 * t).sin()).sin_cos();
        let size = x.hypot(y);
        near(contact.normal.unwrap(), cos * x + sin * y, size);
        // Euler's law of the planet about its centre: only the tangential force turns it, from behind.
        near(contact.moment.unwrap(), -0.1 * contact.tangential.unwrap(), size);
        // Who drives the line of centres pushes, too: without that the tangential force is all that acts along growing ψ.
        let state = FreeCarrier.solver().with_given(5, Signal::constant(0.4)).state(&Instant::at(t)).unwrap();
        let forces = FreeCarrier.solver().with_given(5, Signal::constant(0.4)).forces_of_least_norm(&state).unwrap();
        let contact = forces.reaction("contact").unwrap();
        let [x, y] = contact.force.unwrap();
        let (sin, cos) = 0.4_f64.sin_cos();
        near(contact.tangential.unwrap(), cos * y - sin * x, 10.0);
    }
}

/// Smooth contacts carry all of their force across what they touch.
#[test]
fn cams_press_along_their_normals_alone() {
    macro_rules! presses {
        ($($Mechanism:ty, $times:expr;)*) => {$(
            let mechanism = <$Mechanism>::default();
            let mut compared = 0;
            for t in $times {
                let state = mechanism.state_at(&Instant::at(t)).unwrap();
                let forces = mechanism.solver().forces(&state).unwrap();
                for reaction in forces.reactions.iter().filter(|reaction| reaction.normal.is_some()) {
                    let [x, y] = reaction.force.unwrap();
                    near(reaction.normal.unwrap().abs(), x.hypot(y), x.hypot(y));
                    assert_eq!(None, reaction.tangential);
                    compared += 1;
                }
            }
            assert!(compared > 0, "{} has no contact", <$Mechanism>::model().name);
        )*};
    }
    presses! {
        FlatFace, [0.1, 0.7];
        Roller, [0.1, 0.3];
        loaded::CamEllipseImplicit, [0.0];
        loaded::CamOscillatingFollower, [0.0];
    }
}

/// The spring presses the face on the cam, and the cam the roller away from itself: outwards.
#[test]
fn what_is_pressed_outwards_is_positive() {
    let state = FlatFace.state_at(&Instant::at(0.1)).unwrap();
    let forces = FlatFace.solver().forces(&state).unwrap();
    assert!(forces.reaction("contact").unwrap().normal.unwrap() > 0.0, "{forces}");
    // The lever lies on the roller with its weight, above the cam.
    let state = Roller.state_at(&Instant::at(0.1)).unwrap();
    let forces = Roller.solver().forces(&state).unwrap();
    let contact = forces.reaction("contact").unwrap();
    assert_eq!(contact.force.unwrap()[1] > 0.0, contact.normal.unwrap() > 0.0, "{forces}");
}

/// `sweep` tells where the follower lifts off, and has it for another program.
#[test]
fn a_sweep_tells_where_contacts_lift_off() {
    let file = format!("{}/lift-off.json", env!("CARGO_TARGET_TMPDIR"));
    let args = ["eccentric", "sweep", "--steps", "24", "--format", "json", "--out", &file];
    assert_eq!(std::process::ExitCode::SUCCESS, kin_runtime::cli::run_from::<Eccentric>(args));
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let contacts = json["contacts"].as_array().unwrap();
    assert_eq!(2, contacts.len(), "{contacts:?}");
    let first = (9.81_f64 / 16.0).asin() / 40.0;
    assert_eq!("contact", contacts[0]["name"]);
    assert!((contacts[0]["t"].as_f64().unwrap() - first).abs() < 1e-10);
    assert_eq!([true, false], [0, 1].map(|k: usize| contacts[k]["lifts_off"].as_bool().unwrap()));
}

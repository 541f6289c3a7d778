//! Results do not depend on the unit of length, be it metres, millimetres or another.

use kin_runtime::{Instant, Kinematics, mechanism};

#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2 * scale, 0), rod @ (-0.3 * scale, 0))]
#[distance(B: rod @ (0.3 * scale, 0), slider @ (0, 0.1 * scale), length = 0.15 * scale)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0.1))]
#[constraint(lean: rod.phi = 0.2 * cos(crank.phi) - 0.1)]
#[driver(drive: crank.phi = 0.3 + t)]
#[guess(slider.x = 0.6 * scale)]
struct Engine {
    #[param(1.0)]
    scale: f64,
}

#[test]
fn no_unit_matters() {
    let times = [0.0, 1.5, -0.3, 0.4];
    let metres = Engine { scale: 1.0 };
    let expected = metres.kinematic_analysis(&times).unwrap();
    let mobility = metres.mobility(&Instant::at(0.0), &expected.states[0].q).unwrap();
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        let engine = Engine { scale };
        let found = engine.kinematic_analysis(&times).unwrap();
        for (a, b) in found.iter().zip(&expected) {
            for (k, (x, y)) in a.q.iter().zip(&b.q).enumerate() {
                let unit = if k % 3 == 2 { 1.0 } else { scale };
                assert!((x / unit - y).abs() < 1e-11, "coordinate {k} at t = {}, scale {scale}", a.t);
            }
            let [a, b] = [engine.solver().condition(a), metres.solver().condition(b)].map(Result::unwrap);
            assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
        }
        let again = engine.mobility(&Instant::at(0.0), &found.states[0].q).unwrap();
        assert_eq!((&again.independent, again.rank), (&mobility.independent, mobility.rank));
        assert!((again.condition / mobility.condition - 1.0).abs() < 1e-6);
    }
}

/// A cam whose points are all at the bodies' origins: the characteristic length is that of its curves.
#[mechanism]
#[bodies(cam, face, roller)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(up: ground @ (0, 0), face @ (0, 0), axis = (0, 1))]
#[translational(aside: ground @ (0, 0), roller @ (0, 0), axis = (1, 0))]
#[flat_follower(slides: cam @ (0, 0), face @ (0, 0), axis = (1, 0), support(theta) = (0.04 + 0.01*cos(theta)) * scale)]
#[on_curve(rolls: cam @ (0, 0), roller @ (0, 0), parametric(u) = (0.05*scale*cos(u), 0.04*scale*sin(u)), roller = -0.01*scale)]
#[driver(drive: cam.phi = 0.3 + t)]
#[guess(face.y = 0.04 * scale, roller.x = 0.06 * scale, u = -0.3)]
struct Cam {
    #[param(1.0)]
    scale: f64,
}

#[test]
fn no_unit_matters_to_a_cam() {
    let times = [0.0, 1.5, -0.3, 0.4];
    let expected = Cam { scale: 1.0 }.kinematic_analysis(&times).unwrap();
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        let cam = Cam { scale };
        let found = cam.kinematic_analysis(&times).unwrap();
        for (a, b) in found.iter().zip(&expected) {
            for (k, (x, y)) in a.q.iter().zip(&b.q).enumerate() {
                let unit = if k % 3 == 2 || k == 9 { 1.0 } else { scale };
                assert!((x / unit - y).abs() < 1e-11, "coordinate {k} at t = {}, scale {scale}", a.t);
            }
            // Entries that are 0 but for rounding enter the scale factors in some units and not in others.
            let [a, b] = [cam.solver().condition(a), Cam { scale: 1.0 }.solver().condition(b)].map(Result::unwrap);
            assert!((a / b - 1.0).abs() < 0.2, "{a} {b}");
        }
    }
}

/// A wheel rolling around a wheel, with a slider, and all points at the bodies' origins: the characteristic length is
/// that of the radii.
#[mechanism]
#[body(sun, x = 0, y = 0)]
#[bodies(planet)]
#[body(slider, y = 0, phi = 0)]
#[coordinates(psi)]
#[rolling(mesh: sun @ (0, 0), planet @ (0, 0), radii = (3 * scale, 2 * scale), along = psi)]
#[distance(rod: planet @ (0, 0), slider @ (0, 0), length = 9 * scale)]
#[driver(hold: sun.phi = 0.1)]
#[driver(drive: psi = 0.3 + t)]
#[guess(slider.x = 14 * scale, psi = 0.3)]
struct Planet {
    #[param(1.0)]
    scale: f64,
}

#[test]
fn no_unit_matters_to_wheels() {
    let expected = Planet { scale: 1.0 }.kinematic_analysis(&[0.0, 1.5, 0.4]).unwrap();
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        let planet = Planet { scale };
        let found = planet.kinematic_analysis(&[0.0, 1.5, 0.4]).unwrap();
        for (a, b) in found.iter().zip(&expected) {
            assert!((a.q[4] / scale - b.q[4]).abs() < 1e-11, "{scale}: {} and {}", a.q[4], b.q[4]);
            let [a, b] =
                [planet.solver().condition(a), Planet { scale: 1.0 }.solver().condition(b)].map(Result::unwrap);
            assert!((a / b - 1.0).abs() < 1e-6, "{scale}: {a} and {b}");
        }
    }
}

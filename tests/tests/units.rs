//! The same mechanism in metres, millimetres and other units is solved alike.

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
            assert!((a.condition / b.condition - 1.0).abs() < 1e-6, "{} {}", a.condition, b.condition);
        }
        let again = engine.mobility(&Instant::at(0.0), &found.states[0].q).unwrap();
        assert_eq!((&again.independent, again.rank), (&mobility.independent, mobility.rank));
        assert!((again.condition / mobility.condition - 1.0).abs() < 1e-6);
    }
}

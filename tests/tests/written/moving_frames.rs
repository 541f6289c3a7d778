//! Mechanisms on a frame with moving held coordinates: mobility and driving rows are the same as on a fixed frame.

use kin_runtime::{Instant, Kinematics, Mechanism, Mobility, Signal, VelocityRatios, mechanism};

/// A parallel-arm leg with two motors, on a chassis whose pitch is an input.
#[mechanism(cross_check)]
#[input(pitch)]
#[body(chassis, x = 0.2, y = 0.5, phi = pitch)]
#[bodies(thigh[2], shank[2])]
#[revolute(hip[i in 0..2]: chassis @ (0.04 - 0.08 * i, 0), thigh[i] @ (0, 0))]
#[revolute(knee[i in 0..2]: thigh[i] @ (0.12, 0), shank[i] @ (0, 0))]
#[revolute(ankle: shank[0] @ (0.22, 0), shank[1] @ (0.22, 0))]
#[driver(left: thigh[0].phi = -0.5 + 0.1 * t)]
#[driver(right: thigh[1].phi = -2.6)]
#[guess(shank[0].phi = -2.2, shank[1].phi = -0.9)]
struct Leg;

/// The same leg on a fixed chassis.
#[mechanism]
#[body(chassis, x = 0.2, y = 0.5, phi = 0)]
#[bodies(thigh[2], shank[2])]
#[revolute(hip[i in 0..2]: chassis @ (0.04 - 0.08 * i, 0), thigh[i] @ (0, 0))]
#[revolute(knee[i in 0..2]: thigh[i] @ (0.12, 0), shank[i] @ (0, 0))]
#[revolute(ankle: shank[0] @ (0.22, 0), shank[1] @ (0.22, 0))]
#[driver(left: thigh[0].phi = -0.5 + 0.1 * t)]
#[driver(right: thigh[1].phi = -2.6)]
#[guess(shank[0].phi = -2.2, shank[1].phi = -0.9)]
struct StandingLeg;

fn mobility<M: Kinematics>(mechanism: &M, inputs: &[Signal]) -> (Mobility, VelocityRatios, Vec<f64>) {
    let at = Instant { t: 0.3, inputs };
    let state = mechanism.state_at(&at).unwrap();
    let angles = mechanism.solver().transmission_angles(&at, &state.q).unwrap();
    let mobility = mechanism.mobility(&at, &state.q).unwrap();
    (mobility, mechanism.solver().velocity_ratios(&state).unwrap(), angles.iter().map(|it| it.angle).collect())
}

#[test]
fn joints_of_a_body_that_an_input_moves_drive_nothing() {
    let (standing, expected, angles) = mobility(&StandingLeg, &[]);
    let (moving, ratios, found) = mobility(&Leg, &[Signal::new(0.0, 0.3, 0.1)]);
    assert_eq!((moving.degrees_of_freedom, moving.driving_rows, moving.degrees_of_freedom_left), (2, 2, 0), "{moving}");
    assert_eq!(moving.position_degrees_of_freedom, 2);
    assert_eq!(moving.generic_degrees_of_freedom, Some(2));
    assert_eq!(moving.independent, standing.independent);
    let names: Vec<&str> = ratios.drivers.iter().map(|driver| driver.name).collect();
    assert_eq!(names, ["left", "right"]);
    for (found, expected) in ratios.drivers.iter().zip(&expected.drivers) {
        for (found, expected) in found.first.iter().zip(&expected.first) {
            assert!((found - expected).abs() < 1e-12, "{found} and {expected}");
        }
    }
    // The chassis turns the whole leg; the thighs keep the angles prescribed by their motors.
    assert!(ratios[Leg::pitch].first.iter().any(|&k| k != 0.0));
    assert_eq!(found.len(), angles.len());
    assert!(found.iter().zip(&angles).all(|(found, expected)| (found - expected).abs() < 1e-12));
}

#[test]
fn the_joints_stay_rheonomic() {
    let class = |name: &str| {
        let row = Leg::model().rows.iter().find(|row| row.name == name).unwrap();
        (row.rheonomic, row.driving)
    };
    assert_eq!(class("hip[0].x"), (true, false));
    assert_eq!(class("hip[1].y"), (true, false));
    assert_eq!(class("knee[0].x"), (false, false));
    assert_eq!(class("left"), (true, true));
    assert_eq!(class("right"), (false, true));
}

/// All kinds of rows on a moving table, once with constant operands and once with moving ones.
#[mechanism(allow_redundant)]
#[input(sway)]
#[body(table, x = sway, y = 0.1 * t, phi = 0.2 * sway)]
#[define(moved = 0.1 * sway)]
#[define(seen = table.phi + 0.1)]
#[bodies(a, b)]
#[translational(guide: table @ (0, 0), a @ (0, 0), axis = (1, 0))]
#[translational(turned: table @ (0, 0), a @ (0, 0), axis = (1, 0), angle = t)]
#[fixed(weld: table @ (0, 0), a @ (0, 0), angle = moved)]
#[distance(bar: table @ (0, 0), b @ (0, 0), length = 0.5)]
#[distance(cylinder: table @ (0, 0), b @ (0, 0), length = moved + 0.5)]
#[relative_angle(follows: table, b = 0.1)]
#[constraint(same: b.phi = seen)]
#[constraint(led: b.phi = seen + moved)]
#[constraint(free: table.x + a.x + b.x = 0)]
#[constraint(timed: a.x + b.x = t)]
#[rolling(wheel: table @ (0, 0), b @ (0, 0), axis = (1, 0), radius = 0.1, offset = t)]
#[speed(steered: b @ (0, 0), angle = 0, value = 1)]
#[knife_edge(blade: b @ (0, 0), angle = sway)]
struct Kinds;

#[test]
fn a_row_drives_by_its_own_operands() {
    let driving = Kinds::model().rows.iter().filter(|row| row.driving).map(|row| row.name);
    let expected = ["turned.angle", "weld.angle", "cylinder", "led", "timed", "wheel.roll", "steered", "blade"];
    assert_eq!(driving.collect::<Vec<_>>(), expected);
    let still = Kinds::model().rows.iter().filter(|row| !row.rheonomic).map(|row| row.name);
    assert_eq!(still.collect::<Vec<_>>(), ["steered"]);
}

/// Three equal cranks carry a platform on a swaying frame: one crank is redundant, and the driver is not.
#[mechanism(allow_redundant)]
#[input(sway)]
#[body(frame, x = sway, y = 0, phi = 0.1 * sway)]
#[bodies(p, q, r, platform)]
#[revolute(A: frame @ (0, 0), p @ (0, 0))]
#[revolute(B: frame @ (0.5, 0), q @ (0, 0))]
#[revolute(C: frame @ (0.8, 0), r @ (0, 0))]
#[revolute(D: platform @ (0, 0), p @ (0.3, 0))]
#[revolute(E: platform @ (0.5, 0), q @ (0.3, 0))]
#[revolute(F: platform @ (0.8, 0), r @ (0.3, 0))]
#[relative_angle(drive: frame, p = 0.6 + t)]
#[guess(p.phi = 0.6, q.phi = 0.6, r.phi = 0.6)]
struct SwayingTable;

#[test]
fn the_plan_of_a_redundant_mechanism_keeps_its_driver_on_a_moving_frame() {
    let sway = |t: f64, u: &mut [Signal]| u[0] = Signal::new(0.1 * t.sin(), 0.1 * t.cos(), -0.1 * t.sin());
    let times: Vec<f64> = (0..=50).map(|k| 0.04 * f64::from(k)).collect();
    let path = SwayingTable.solver().with_inputs(&sway).sweep(&times).unwrap();
    assert!(path.fallbacks.is_empty(), "{:?}", path.fallbacks);
    assert!(path.states.iter().all(|state| {
        let turned = state[SwayingTable::p].phi - 0.01 * state.t.sin() - 0.6 - state.t;
        turned.abs() < 1e-9
    }));
}

//! Forces of a pump jack, a press and an engine, compared with laws that need no multipliers.

use crate::page::says;
use crate::{close, moved};
use kin_runtime::model::Body;
use kin_runtime::{Instant, Kinematics, Signal};
use kin_tests::examples::engine::{Engine, largest_shaking};
use kin_tests::examples::excavator::{Excavator, holding_forces};
use kin_tests::examples::pump_jack::{PumpJack, largest_torque};
use kin_tests::examples::toggle_press::{TogglePress, largest_pin_forces};
use std::f64::consts::TAU;

/// The motor's power is the rate of the energy plus the power delivered to the rods.
#[test]
fn the_pump_jack_needs_the_power_that_it_lifts_with() {
    let jack = PumpJack::default();
    let without = PumpJack { counterweight: 0.0, ..PumpJack::default() };
    let [with, without] = [&jack, &without].map(|jack| largest_torque(jack).unwrap() / 1000.0);
    says(
        "pump_jack",
        &format!("At most {with:.1} kN m with the counterweight on its crank, and {without:.1} kN m without"),
    );
    let steps = 3600;
    let turn = TAU / jack.omega;
    let (mut supplied, mut lifted) = (0.0, 0.0);
    for (_, at) in moved(&jack, 0.0, turn, steps).iter().skip(1) {
        let forces = at.forces.as_ref().unwrap();
        supplied += forces.driver_power * turn / steps as f64;
        lifted -= forces.applied_power * turn / steps as f64;
    }
    close(supplied / lifted, 1.0, 1e-6);
}

/// The boom cylinder alone holds all weights about the boom's pin; bucket and stick cylinders are inside of the arm.
#[test]
fn the_boom_cylinder_holds_all_weights() {
    let inputs = [1.42, 1.9, 1.13].map(Signal::constant);
    let mut forces = [0.0; 2];
    for (found, load) in forces.iter_mut().zip([0.0, 1600.0]) {
        let arm = Excavator { load, ..Excavator::default() };
        let at = arm.state_at(&Instant { t: 0.0, inputs: &inputs }).unwrap();
        let place = |body: Body, [u, v]: [f64; 2]| {
            let (body, (sin, cos)) = (&at[body], at[body].phi.sin_cos());
            [body.x + cos * u - sin * v, body.y + sin * u + cos * v]
        };
        let weights = [
            (1100.0, place(Excavator::boom, [1.5, 0.4])),
            (550.0, place(Excavator::stick, [0.4, 0.1])),
            (60.0, place(Excavator::lever, [0.0, 0.0])),
            (420.0, place(Excavator::bucket, [0.1, -0.1])),
            (load, at[Excavator::tip].r),
        ];
        let moment: f64 = weights.iter().map(|(mass, [x, _])| 9.81 * mass * x).sum();
        let [x, y] = place(Excavator::boom, [1.4, 0.35]);
        let along = [(x - 0.45) / 1.42, (y + 0.05) / 1.42];
        let exact = moment / (x * along[1] - (y - 0.2) * along[0]);
        *found = holding_forces(&arm).unwrap()[0];
        close(*found / exact, 1.0, 1e-9);
    }
    let [empty, full] = forces.map(|force| force / 1000.0);
    says(
        "excavator",
        &format!("its cylinder holds the empty arm with {empty:.1} kN, and 1600 kg at the tip with {full:.1} kN"),
    );
}

/// Near the dead centre of the toggle, the load of the ram goes directly into the frame.
#[test]
fn the_press_carries_its_load_in_the_frame() {
    let largest = largest_pin_forces(&TogglePress::default()).unwrap();
    let of = |name: &str| largest.iter().find(|(joint, _)| *joint == name).unwrap().1 / 1000.0;
    says(
        "toggle_press",
        &format!("The pin in the frame carries {:.1} kN at most, the crank pin {:.1} kN", of("T"), of("C")),
    );
    assert!(of("T") > 20.0 && of("R") > 20.0);
}

/// The shaking force is minus the sum of masses times accelerations.
#[test]
fn the_engine_shakes_by_its_masses() {
    let engine = Engine::default();
    let bare = Engine { counterweight: 0.0, ..Engine::default() };
    let [with, without] = [&engine, &bare].map(|engine| largest_shaking(engine).unwrap());
    says(
        "engine",
        &format!("The shaking force is {without:.0} N at most without a counterweight, {with:.0} N with it"),
    );
    let turn = TAU / bare.omega;
    let mut largest: f64 = 0.0;
    for (_, at) in moved(&bare, 0.0, turn, 360) {
        let [rod, piston] = [at[Engine::rod], at[Engine::piston]];
        let (sin, cos) = rod.phi.sin_cos();
        let (s, w, w_dot) = (0.3 * bare.l, rod.phi_dot, rod.phi_ddot);
        let x = 0.6 * (rod.x_ddot - s * (cos * w * w + sin * w_dot));
        let y = 0.6 * (rod.y_ddot - s * (sin * w * w - cos * w_dot)) + 0.5 * piston.y_ddot;
        largest = largest.max(x.hypot(y));
    }
    close(largest / without, 1.0, 1e-3);
}

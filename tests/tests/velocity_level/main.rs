//! Rows of velocity level compared with exact motions: circles, a trailer that straightens, and motions that are also
//! written with equations of position level.

mod coefficients;
mod ends;
mod limits;
mod pulses;
mod short_pulses;

use kin_runtime::model::{Frame, Level, Role};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, Refusal, Signal, SolveError, State, mechanism};
use kin_tests::case::Case;
use kin_tests::compare::{Differences, largest};
use kin_tests::mechanisms::{RateDrivenSliderCrank, SleighKnifeEdge, SteeredCar, TruckWithTrailers, WheelByRates};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The tolerance of integrated positions.
const PATH: f64 = 1e-10;

fn grid(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * f64::from(k) / f64::from(count)).collect()
}

fn close(what: &str, expected: f64, found: f64, tolerance: f64) {
    assert!((expected - found).abs() <= tolerance, "{what}: {expected} and {found}");
}

/// Velocity and acceleration analysis at the exact positions of the file.
#[test]
fn reference_positions_give_reference_rates() {
    let case = Case::read("sleigh_knife_edge");
    let sleigh = SleighKnifeEdge::default();
    let mut differences = Differences::new();
    for instant in &case.modes[0].instants {
        differences.at(format_args!("t = {}", instant.t));
        let at = Instant::at(instant.t);
        let q_dot = sleigh.velocity_analysis(&at, &instant.q).unwrap();
        let q_ddot = sleigh.acceleration_analysis(&at, &instant.q, &instant.q_dot).unwrap();
        let name = |place: usize| SleighKnifeEdge::model().coordinates[place].name;
        differences.vector("q_dot", name, &instant.q_dot, &q_dot, 1e-14 * largest(&instant.q_dot));
        differences.vector("q_ddot", name, &instant.q_ddot, &q_ddot, 1e-14 * largest(&instant.q_ddot));
    }
    differences.finish();
}

/// The degrees of freedom of velocity and of position differ: a car can reach every position.
#[test]
fn degrees_of_freedom_are_counted_on_both_levels() {
    let (at, car) = (Instant::at(0.0), SteeredCar::default());
    let levels: Vec<Level> = SteeredCar::model().rows.iter().map(|row| row.level).collect();
    assert_eq!(levels, [Level::Velocity; 3]);
    let mobility = car.mobility(&at, &[0.5, 0.0, 0.3]).unwrap();
    // The steered wheel depends on time and counts as a driver, as the engine does; the rear wheels leave two of three
    // velocities.
    assert_eq!((mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), (2, 0));
    assert_eq!((mobility.position_degrees_of_freedom, mobility.position_degrees_of_freedom_left), (3, 3));
    assert_eq!((mobility.velocity_level_rows, mobility.driving_rows), (3, 2));
    assert!(mobility.to_string().contains("of position: 3 degrees of freedom, 3 left"), "{mobility}");

    let truck = TruckWithTrailers;
    let mobility = truck.mobility(&at, &truck.state_at(&at).unwrap().q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), (2, 0));
    assert_eq!((mobility.position_degrees_of_freedom, mobility.position_degrees_of_freedom_left), (6, 5));
    assert!(mobility.redundant.is_empty());

    let crank = RateDrivenSliderCrank::default();
    let mobility = crank.mobility(&at, &crank.state_at(&at).unwrap().q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.position_degrees_of_freedom), (1, 1));
    assert_eq!((mobility.degrees_of_freedom_left, mobility.position_degrees_of_freedom_left), (0, 1));
}

/// With constant steering the car drives a circle of radius L/tan δ and returns to its start after one turn, also
/// backwards in time.
#[test]
fn constant_steering_is_a_circle() {
    let car = SteeredCar { swing: 0.0, ..SteeredCar::default() };
    let radius = car.wheelbase / car.steer.tan();
    let (rate, once) = (car.v / radius, TAU * radius / car.v);
    let centre = [0.5 - radius * 0.3_f64.sin(), radius * 0.3_f64.cos()];
    for times in [grid(0.0, once, 7), vec![0.0, once], grid(0.0, -once, 3), vec![0.0, once, 0.25 * once, -once]] {
        for state in &car.kinematic_analysis(&times).unwrap() {
            let phi = 0.3 + rate * state.t;
            close("phi", phi, state.q[2], PATH);
            close("x", centre[0] + radius * phi.sin(), state.q[0], PATH * radius);
            close("y", centre[1] - radius * phi.cos(), state.q[1], PATH * radius);
            close("x_ddot", -car.v * rate * phi.sin(), state.q_ddot[0], PATH);
        }
    }
}

/// A trailer hitched at the axle of a truck that drives straight ahead: tan(ψ/2) decays as exp(−v t/L).
#[mechanism]
#[body(truck, y = 0, phi = 0)]
#[bodies(trailer)]
#[revolute(hitch: truck @ (0, 0), trailer @ (length, 0))]
#[knife_edge(wheels: trailer @ (0, 0))]
#[speed(engine: truck @ (0, 0), value = v)]
#[guess(trailer.x = 0, trailer.y = 2, trailer.phi = -1.5)]
struct Straightening {
    #[param(1.3)]
    length: f64,
    #[param(0.7)]
    v: f64,
}

#[test]
fn a_trailer_straightens() {
    let mechanism = Straightening::default();
    let trajectory = mechanism.kinematic_analysis(&grid(0.0, 12.0, 5)).unwrap();
    let phi = trajectory.column("trailer.phi").unwrap();
    for (state, phi) in trajectory.iter().zip(&phi) {
        let expected = (0.5 * trajectory.column("trailer.phi").unwrap()[0]).tan()
            * (-mechanism.v * state.t / mechanism.length).exp();
        close("tan(phi/2)", expected, (0.5 * phi).tan(), PATH);
    }
    assert!(phi[0] < -1.0 && phi[5].abs() < 0.01);
}

/// The rows of `WheelByRates` integrated analytically.
#[mechanism]
#[body(rail, x = 0, y = 0)]
#[bodies(wheel)]
#[coordinates(counter)]
#[point_on_line(contact: rail @ (0, 0), wheel @ (0, 0), axis = (1, 0), offset = radius)]
#[constraint(roll: wheel.x * cos(rail.phi) + wheel.y * sin(rail.phi) = along - radius * (wheel.phi - 0.2 - rail.phi))]
#[constraint(count: counter / 2 - sin(wheel.phi) = start + 0.05 * t * t)]
#[driver(tilt: rail.phi = 0.4 * sin(1.3 * t))]
#[driver(roll_on: wheel.phi = 0.2 - t * t)]
#[guess(wheel.x = 0.3)]
struct WheelByPositions {
    #[param(0.25)]
    radius: f64,
    #[param(0.3)]
    along: f64,
    #[param(0)]
    start: f64,
}

#[test]
fn integrable_rows_move_like_their_integrals() {
    let times = grid(0.0, 1.7, 11);
    let by_rates = WheelByRates::default().kinematic_analysis(&times).unwrap();
    let start = 0.5 * by_rates.column("counter").unwrap()[0] - by_rates.column("wheel.phi").unwrap()[0].sin();
    let by_positions = WheelByPositions { start, ..WheelByPositions::default() };
    compare(&by_rates.states, &by_positions.kinematic_analysis(&times).unwrap().states);
}

fn compare(found: &[State], expected: &[State]) {
    let mut differences = Differences::new();
    for (found, expected) in found.iter().zip(expected) {
        differences.at(format_args!("t = {}", expected.t));
        for (what, expected, found) in [
            ("q", &expected.q, &found.q),
            ("q_dot", &expected.q_dot, &found.q_dot),
            ("q_ddot", &expected.q_ddot, &found.q_ddot),
        ] {
            differences.vector(what, |place| place, expected, found, PATH * largest(expected).max(1.0));
        }
    }
    differences.finish();
}

/// `RateDrivenSliderCrank` with the angle driven instead of its rate.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (0.3, 0), rod @ (0, 0))]
#[revolute(C: rod @ (0.8, 0.05), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0.1), slider @ (0, 0), axis = (1, 0))]
#[driver(motor: crank.phi = start + 2 * t - (cos(3 * t) - 1) / 3)]
#[guess(rod.phi = -0.1, slider.x = 1)]
struct DrivenSliderCrank {
    #[param(0)]
    start: f64,
}

/// Two turns of a closed loop: it stays closed and on its branch.
#[test]
fn a_loop_driven_by_a_rate_moves_like_one_driven_by_an_angle() {
    let times = grid(0.0, 6.0, 9);
    let by_rate = RateDrivenSliderCrank::default().kinematic_analysis(&times).unwrap();
    let start = by_rate.column("crank.phi").unwrap()[0];
    close("start", 0.4, start, 0.1);
    compare(&by_rate.states, &DrivenSliderCrank { start }.kinematic_analysis(&times).unwrap().states);
    let worst = by_rate.iter().map(|state| state.residual).fold(0.0, f64::max);
    assert!(worst < 1e-14, "{worst}");
}

/// A car whose steering angle is an input.
#[mechanism]
#[input(wheel)]
#[bodies(car)]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (2.5, 0), angle = wheel)]
#[nonholonomic(engine: dot(car.x) * cos(car.phi) + dot(car.y) * sin(car.phi) = 1.5)]
#[guess(car.x = 0.5, car.phi = 0.3)]
struct CarWithInput;

fn steering(t: f64) -> Signal {
    let (sin, cos) = (2.0 * t).sin_cos();
    Signal { value: 0.2 + 0.3 * sin, rate: 0.6 * cos, acceleration: -1.2 * sin }
}

/// A blade at a distance from the origin of the body, which turns uniformly.
#[mechanism]
#[bodies(sled)]
#[driver(turn: sled.phi = 0.3 + w * t)]
#[knife_edge(edge: sled @ (e, 0))]
#[speed(go: sled @ (e, 0), value = v)]
struct Offset {
    w: f64,
    e: f64,
    v: f64,
}

/// The blade moves on a circle with the radius v/w; the steps do not become shorter with the offset.
#[test]
fn a_small_offset_does_not_shorten_the_steps() {
    let (w, v) = (-1.2, 3.0);
    for e in [0.0, 1.0, 1e-2, 1e-4, 1e-6] {
        let sled = Offset { w, e, v };
        let options = Options { max_steps: 10_000, ..Options::default() };
        let times = grid(0.0, 8.0, 4);
        let start = [-e * f64::cos(0.3), -e * f64::sin(0.3), 0.3];
        let states = sled.solver().with_options(options).sweep_from(&start, &times).expect("a circle").states;
        for state in states {
            let phi = 0.3 + w * state.t;
            let at = [v / w * (phi.sin() - f64::sin(0.3)), v / w * (f64::cos(0.3) - phi.cos())];
            close("x", at[0] - e * phi.cos(), state.q[0], 1e-9);
            close("y", at[1] - e * phi.sin(), state.q[1], 1e-9);
        }
    }
}

#[test]
fn inputs_steer() {
    let times = grid(0.0, 1.9, 4);
    let inputs = |t: f64, inputs: &mut [Signal]| inputs[0] = steering(t);
    let found = CarWithInput.solver().with_inputs(&inputs).sweep(&times).unwrap();
    compare(&found.states, &SteeredCar::default().kinematic_analysis(&times).unwrap().states);
}

/// The tracker integrates from update to update by interpolating the steering; at constant time nothing moves.
#[test]
fn a_tracker_drives_on() {
    let mut tracker = CarWithInput.solver().tracker(&Instant { t: 0.0, inputs: &[steering(0.0)] }).unwrap();
    for t in grid(0.0, 1.9, 95) {
        tracker.update(&Instant { t, inputs: &[steering(t)] }).unwrap();
    }
    let expected = SteeredCar::default().kinematic_analysis(&[0.0, 1.9]).unwrap();
    for (expected, found) in expected.states[1].q.iter().zip(tracker.state().q.clone()) {
        close("q", *expected, found, 1e-9);
    }
    let before = tracker.state().clone();
    let after = tracker.update(&Instant { t: 1.9, inputs: &[Signal::constant(-0.4)] }).unwrap();
    assert_eq!(before.q, after.q);
    close("phi_dot", 1.5 / 2.5 * (-0.4_f64).tan(), after.q_dot[2], 1e-13);
}

/// A skate without a driver.
#[mechanism]
#[bodies(skate)]
#[knife_edge(blade: skate @ (0, 0))]
#[guess(skate.phi = 0.5)]
struct Skate;

/// Prescribed coordinates together with rows of velocity level; without them the velocity of least norm is 0.
#[test]
fn what_is_left_open_can_be_given() {
    let times = [0.0, 0.4, 2.0];
    let still = Skate.kinematic_analysis(&times).unwrap();
    assert!(still.iter().all(|state| state.q == [0.0, 0.0, 0.5] && state.degrees_of_freedom_left == 2));

    let signal = |value, rate| Signal { value, rate, acceleration: 0.0 };
    let solver = Skate.solver().with_given(2, signal(0.5, 0.3)).with_given(0, signal(1.0, 0.7));
    for state in &solver.sweep(&times).unwrap() {
        // ẏ = ẋ tan φ.
        let phi = 0.5 + 0.3 * state.t;
        close("x", 1.0 + 0.7 * state.t, state.q[0], 1e-14);
        close("y", 0.7 / 0.3 * (0.5_f64.cos() / phi.cos()).ln(), state.q[1], PATH);
        close("y_dot", 0.7 * phi.tan(), state.q_dot[1], 1e-13);
        close("y_ddot", 0.7 * 0.3 / phi.cos().powi(2), state.q_ddot[1], 1e-13);
    }
    let conflict = Skate.solver().with_given(0, signal(0.0, 1.0)).with_given(1, signal(0.0, 1.0));
    let conflict = conflict.with_given(2, signal(0.5, 0.0)).sweep(&times).unwrap_err();
    assert!(matches!(conflict.source, SolveError::GivenConflict { .. }), "{conflict}");
}

/// A knife edge and a speed constraint at different points of a cart, both at angles to it.
#[mechanism]
#[bodies(cart)]
#[knife_edge(wheel: cart @ (0.5, -0.2), angle = 0.3)]
#[speed(motor: cart @ (0.1, 0.4), angle = -0.7, value = 1.5)]
struct Steered;

/// The geometry that a drawing needs: the point, the direction in the body's frame, and the speed.
#[test]
fn rows_of_velocity_level_tell_where_they_stand() {
    let model = Steered::model();
    let mut numbers = vec![0.0; model.geometry];
    Steered.write_geometry(&[], &Instant::at(0.0), &mut numbers).unwrap();
    let of = |joint: usize, role: Role| {
        let geometry = model.joints[joint].geometry.iter().find(|geometry| geometry.role == role).unwrap();
        assert_eq!(geometry.frame, Frame::Body(0));
        &numbers[geometry.offset..]
    };
    assert_eq!(of(0, Role::P)[..2], [0.5, -0.2]);
    assert_eq!(of(0, Role::Axis)[..2], [0.3_f64.cos(), 0.3_f64.sin()]);
    assert_eq!(of(1, Role::P)[..2], [0.1, 0.4]);
    assert_eq!(of(1, Role::Axis)[..2], [0.7_f64.cos(), -0.7_f64.sin()]);
    assert_eq!(of(1, Role::Value)[0], 1.5);
}

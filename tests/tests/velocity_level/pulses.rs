//! Velocities that the stages of an integration may not show: zero at both ends of an interval and at all stages between
//! them, or told at times whose spacing is coarse.

use kin_runtime::function::{MotionLaw, Sequence};
use kin_runtime::{Instant, Kinematics, Signal, mechanism};

#[mechanism]
#[body(trolley, y = 0, phi = 0)]
#[function(v)]
#[speed(motor: trolley @ (0, 0), value = v(t))]
#[guess(trolley.x = 0)]
struct Trolley {
    v: Sequence,
}

#[mechanism]
#[body(trolley, y = 0, phi = 0)]
#[speed(motor: trolley @ (0, 0), value = 1 - cos(2*pi*t))]
#[guess(trolley.x = 0)]
struct StopAndGo;

#[mechanism]
#[bodies(sled)]
#[function(f)]
#[knife_edge(blade: sled @ (0, 0))]
#[speed(push: sled @ (0, 0), value = 1)]
#[driver(head: sled.phi = f(t))]
#[guess(sled.x = 0, sled.y = 0)]
struct Sled {
    f: Sequence,
}

/// A rise and a return between two times, rest before and after until t = 100.
fn pulse([from, to]: [f64; 2], height: f64) -> Sequence {
    let half = 0.5 * (to - from);
    let rest = Sequence::starting_at(0.0, 0.0).dwell(from);
    let moved = rest.rise(MotionLaw::Cycloidal, height, half).rise(MotionLaw::Cycloidal, -height, half);
    moved.dwell(100.0 - to).build().unwrap_or_else(|error| panic!("{error}"))
}

/// q at t = 100, in a sweep of `steps` steps.
fn at_the_end<M: Kinematics>(mechanism: &M, end: f64, steps: u32) -> Vec<f64> {
    let times: Vec<f64> = (0..=steps).map(|k| end * f64::from(k) / f64::from(steps)).collect();
    let swept = mechanism.kinematic_analysis(&times).unwrap_or_else(|error| panic!("{error}"));
    swept.last().expect("an instant").q.clone()
}

const PULSES: [[f64; 2]; 6] = [[33.1, 37.9], [31.0, 79.0], [20.0, 40.0], [5.0, 19.0], [45.0, 55.0], [70.0, 99.0]];

#[test]
fn a_pulse_of_speed_between_two_instants_moves_the_trolley() {
    for [from, to] in PULSES {
        for steps in [1, 2, 10, 100] {
            let x = at_the_end(&Trolley { v: pulse([from, to], 1.0) }, 100.0, steps)[0];
            assert!((x - 0.5 * (to - from)).abs() < 1e-8, "{from} to {to} in {steps} steps: {x}");
        }
    }
}

/// The mean speed is 1, and the stages of an integration over 90 periods are all at rest.
#[test]
fn a_trolley_that_stops_and_goes_arrives() {
    for (end, steps) in [(90.0, 1), (18.0, 2), (90.0, 3), (1800.0, 20)] {
        let x = at_the_end(&StopAndGo, end, steps)[0];
        assert!((x - end).abs() < 1e-8 * end, "{end} in {steps} steps: {x}");
    }
}

/// A long way does not hide a turn of the sled, however small.
#[test]
fn a_pulse_of_the_heading_turns_the_sled() {
    for height in [1.0, 0.01] {
        for interval in PULSES {
            let sled = Sled { f: pulse(interval, height) };
            let (found, expected) = (at_the_end(&sled, 100.0, 1), at_the_end(&sled, 100.0, 1000));
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-7, "{interval:?}: {found} instead of {expected}");
            }
        }
    }
}

/// What is found on the way there is found on the way back, where the places within a step are mirrored.
#[test]
fn pulses_are_integrated_backwards_as_well() {
    for [from, to] in PULSES.map(|[from, to]| [100.0 - to, 100.0 - from]) {
        let back =
            |steps: u32| -> Vec<f64> { (0..=steps).map(|k| 100.0 * (1.0 - f64::from(k) / f64::from(steps))).collect() };
        let trolley = Trolley { v: pulse([from, to], 1.0) };
        let sled = Sled { f: pulse([from, to], 1.0) };
        let x = trolley.kinematic_analysis(&back(1)).unwrap_or_else(|error| panic!("{error}")).states[1].q[0];
        assert!((x + 0.5 * (to - from)).abs() < 1e-8, "{from} to {to}: {x}");
        let [found, expected] = [1, 1000].map(|steps| {
            let swept = sled.kinematic_analysis(&back(steps)).unwrap_or_else(|error| panic!("{error}"));
            swept.last().expect("an instant").q.clone()
        });
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-7, "{from} to {to}: {found} instead of {expected}");
        }
    }
}

#[mechanism]
#[body(trolley, y = 0, phi = 0)]
#[speed(motor: trolley @ (0, 0), value = exp(-pow((t - c) / w, 2)))]
#[guess(trolley.x = 0)]
struct Nudged {
    c: f64,
    w: f64,
}

#[mechanism]
#[bodies(sled)]
#[knife_edge(blade: sled @ (0, 0))]
#[speed(push: sled @ (0, 0), value = 1)]
#[driver(head: sled.phi = exp(-pow((t - c) / w, 2)))]
#[guess(sled.x = 0, sled.y = 0)]
struct Swerving {
    c: f64,
    w: f64,
}

/// Pulses of formulas, narrower than the distances of all places at which a step is looked into: ∫ exp(−x²) dx = √π.
#[test]
fn narrow_pulses_of_formulas_are_integrated() {
    let area = std::f64::consts::PI.sqrt();
    for (c, w) in [(33.7, 0.3), (87.3, 0.02), (12.9, 0.003)] {
        for steps in [1, 3] {
            let x = at_the_end(&Nudged { c, w }, 100.0, steps)[0];
            assert!((x - w * area).abs() < 1e-7, "{c} {w} in {steps} steps: {x}");
            let (found, expected) = (at_the_end(&Swerving { c, w }, 100.0, steps), swerved(w));
            assert!((found[1] - expected).abs() < 1e-7 && (0.0..w).contains(&(100.0 - found[0])), "{c} {w}: {found:?}");
        }
    }
}

/// ∫ sin(exp(−(t/w)²)) dt by the trapezoidal rule, which converges fast for such functions.
fn swerved(w: f64) -> f64 {
    let at = |k: i32| (-(0.02 * f64::from(k)).powi(2)).exp().sin();
    0.02 * w * (-400..=400).map(at).sum::<f64>()
}

/// s = u² − 1, whatever t does.
#[mechanism]
#[coordinates(s)]
#[input(u)]
#[nonholonomic(square: dot(s) = 2*u*dot(u))]
#[guess(s = 0)]
struct Square;

/// Seconds of a calendar are so large that neighbouring floating-point numbers are 2e-7 apart.
#[test]
fn inputs_are_integrated_between_their_instants_however_large_the_time_is() {
    for (start, h) in [(0.0, 1e-3), (1.7e9, 0.1), (1.7e9, 0.01), (1.7e9, 1e-3), (1.0, 1e-11)] {
        // Rates that suit the times as they are rounded.
        let h = (start + h) - start;
        let at = |t: f64, u: f64, rate: f64| (t, [Signal::new(u, rate, 0.0)]);
        let [(t, inputs), (later, further)] = [at(start, 1.0, 1.0 / h), at(start + h, 2.0, 1.0 / h)];
        let square = Square;
        let mut tracker = square.solver().tracker(&Instant { t, inputs: &inputs }).expect("it begins");
        let state = tracker.update(&Instant { t: later, inputs: &further });
        let s = state.unwrap_or_else(|error| panic!("{start}, {h:e}: {error}")).q[0];
        assert!((s - 3.0).abs() < 1e-12, "{start}, {h:e}: {s}");
    }
}

//! Short pulses of velocities beside other motions, which are so large that the pulse is a small part of them.

use super::grid;
use kin_runtime::function::{MotionLaw, Sequence};
use kin_runtime::{Instant, Kinematics, mechanism};
use std::f64::consts::PI;

const END: f64 = 10.0;

/// Compares a coordinate at the end of a motion in one step and in several ones, and of a tracker.
fn arrives<M: Kinematics>(what: &str, mechanism: &M, coordinate: usize, expected: f64) {
    for steps in [1, 3, 10, 100] {
        let swept = mechanism.kinematic_analysis(&grid(0.0, END, steps));
        let states = swept.unwrap_or_else(|error| panic!("{what}: {error}")).states;
        let found = states[states.len() - 1].q[coordinate];
        assert!((found - expected).abs() < 1e-9, "{what} in {steps} steps: {found} instead of {expected}");
    }
    let mut tracker = mechanism.solver().tracker(&Instant::at(0.0)).expect("it begins");
    let state = tracker.update(&Instant::at(END));
    let found = state.unwrap_or_else(|error| panic!("{what}: {error}")).q[coordinate];
    assert!((found - expected).abs() < 1e-9, "{what} by a tracker: {found} instead of {expected}");
}

/// A shuttle that goes ahead all the time and is pushed aside once.
#[mechanism]
#[function(side)]
#[body(shuttle, phi = 0)]
#[speed(ahead: shuttle @ (0, 0), value = 1)]
#[speed(aside: shuttle @ (0, 0), angle = pi/2, value = side(t))]
#[guess(shuttle.x = 0, shuttle.y = 0)]
struct Shuttle {
    side: Sequence,
}

#[test]
fn a_short_push_beside_a_long_way_moves_the_shuttle() {
    for (speed, duration) in [(0.1, 0.02), (0.1, 0.01), (0.1, 0.003), (0.05, 0.02), (1e-4, 0.02)] {
        let rest = Sequence::starting_at(0.0, 0.0).dwell(4.0);
        let push = rest.rise(MotionLaw::Cycloidal, speed, duration).fall(MotionLaw::Cycloidal, speed, duration);
        let side = push.dwell(END).build().unwrap_or_else(|error| panic!("{error}"));
        arrives(&format!("{speed} for {duration}"), &Shuttle { side }, 1, speed * duration);
    }
}

/// The speed grows by 0.15 in 4 s before the push and again after it.
#[test]
fn a_short_push_of_a_changing_speed_moves_the_shuttle() {
    let (speed, duration) = (0.1, 0.01);
    let slow = Sequence::starting_at(0.0, 0.0).rise(MotionLaw::ConstantVelocity, 0.15, 4.0);
    let push = slow.rise(MotionLaw::Cycloidal, speed, duration).fall(MotionLaw::Cycloidal, speed, duration);
    let rise = push.rise(MotionLaw::ConstantVelocity, 0.15, 4.0).dwell(END);
    let side = rise.build().unwrap_or_else(|error| panic!("{error}"));
    let way = 0.075 * 4.0 + 0.15 * 2.0 * duration + speed * duration + 0.225 * 4.0 + 0.3 * (2.0 - 2.0 * duration);
    arrives("a ramp with a push", &Shuttle { side }, 1, way);
}

/// A coordinate whose rate has a burst of the relative height `a` and the width `w`; x = t and z = t/2 are integrated, too.
macro_rules! with_burst {
    ($name:ident: $($rate:tt)*) => {
        #[mechanism]
        #[coordinates(x, y, z)]
        #[nonholonomic(ahead: dot(x) = 1)]
        #[nonholonomic(aside: dot(z) = 0.5)]
        #[nonholonomic(rate: dot(y) = $($rate)*)]
        #[guess(x = 0, y = 0, z = 0)]
        struct $name {
            a: f64,
            w: f64,
        }
    };
}

with_burst!(OfTime: (1 + a * exp(-pow((t - 4.321) / w, 2))));
with_burst!(OfSeveral: (a * exp(-pow((x + z - 6.4815) / w, 2))));
with_burst!(OfSeveralAndTime: (a / (1 + pow((x + z + t - 10.8025) / w, 6))));
with_burst!(BesideASine: (sin(t) + a * exp(-pow((t - 4.321) / w, 2))));
with_burst!(InAProduct: ((2 + sin(t)) * (1 + a * exp(-pow((x - 4.321) / w, 2)))));
with_burst!(OfARate: ((2 + a * exp(-pow((z - 2.1605) / w, 2))) * dot(x)));
with_burst!(InADivisor: (dot(x) / (1 / a + pow((x - 4.321) / w, 2) / a)));

/// ∫ exp(−τ²) = √π, ∫ 1/(1 + τ⁶) = 2π/3, ∫ exp(−τ²) cos(w τ) = √π exp(−w²/4).
#[test]
fn short_bursts_of_formulas_are_integrated() {
    let (c, area) = (4.321_f64, PI.sqrt());
    for (a, w) in [(0.05, 0.003), (0.05, 0.001), (1e-3, 0.003), (5.0, 3e-4)] {
        let name = |of: &str| format!("{of}, {a}, {w}");
        arrives(&name("of time"), &OfTime { a, w }, 1, END + a * w * area);
        arrives(&name("of several"), &OfSeveral { a, w }, 1, a * w * area / 1.5);
        arrives(&name("of several and time"), &OfSeveralAndTime { a, w }, 1, a * w * 2.0 * PI / 3.0 / 2.5);
        arrives(&name("beside a sine"), &BesideASine { a, w }, 1, 1.0 - END.cos() + a * w * area);
        let of_sine = 2.0 + c.sin() * (-0.25 * w * w).exp();
        arrives(&name("in a product"), &InAProduct { a, w }, 1, 2.0 * END + 1.0 - END.cos() + a * w * area * of_sine);
        arrives(&name("of a rate"), &OfARate { a, w }, 1, 2.0 * END + a * 2.0 * w * area);
        let of_quotient = ((END - c) / w).atan() + (c / w).atan();
        arrives(&name("in a divisor"), &InADivisor { a, w }, 1, a * w * of_quotient);
    }
}

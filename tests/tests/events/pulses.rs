//! Motions that begin and end at rest within one step of a sweep, and pass the limit of a condition in between.

use kin_runtime::function::{MotionLaw, Sequence};
use kin_runtime::{Crossing, Kinematics, mechanism};

#[mechanism]
#[body(finger, x = 0, y = 0)]
#[function(f)]
#[driver(motor: finger.phi = f(t))]
#[point(tip = finger @ (1, 0))]
#[unilateral(low: finger.phi < 0.05)]
#[unilateral(below: tip.y < sin(0.05))]
struct Finger {
    f: Sequence,
}

#[mechanism]
#[bodies(crank, coupler, rocker)]
#[function(f)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(D: ground @ (0.4, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = f(t))]
#[unilateral(low: crank.phi < 0.05)]
#[guess(coupler.phi = 0.5, rocker.phi = 1.8)]
struct FourBar {
    f: Sequence,
}

/// The condition alone moves.
#[mechanism]
#[body(post, x = 0, y = 0)]
#[function(f)]
#[driver(still: post.phi = 0.1)]
#[unilateral(low: f(t) < 0.05)]
struct Post {
    f: Sequence,
}

const HEIGHT: f64 = 0.3;

fn pulse([from, to]: [f64; 2]) -> Sequence {
    let half = 0.5 * (to - from);
    let rest = Sequence::starting_at(0.0, 0.0).dwell(from);
    let moved = rest.rise(MotionLaw::Cycloidal, HEIGHT, half).rise(MotionLaw::Cycloidal, -HEIGHT, half);
    moved.dwell(100.0 - to).build().unwrap_or_else(|error| panic!("{error}"))
}

/// The times at which the pulse passes 0.05: the cycloidal law is x − sin(2πx) / 2π.
fn crossings([from, to]: [f64; 2]) -> [f64; 2] {
    let (mut low, mut high) = (0.0_f64, 1.0);
    for _ in 0..60 {
        let x = 0.5 * (low + high);
        let turn = std::f64::consts::TAU;
        if HEIGHT * (x - (turn * x).sin() / turn) < 0.05 { low = x } else { high = x }
    }
    let part = 0.5 * (to - from) * low;
    [from + part, to - part]
}

/// The events of a condition, forwards with a pulse and backwards with its mirror image.
fn events<M: Kinematics>(mechanism: &dyn Fn(Sequence) -> M, condition: &str, [from, to]: [f64; 2]) {
    let [first, last] = crossings([from, to]);
    let mirrored = [100.0 - to, 100.0 - from];
    for (times, interval, expected) in
        [([0.0, 100.0], [from, to], [first, last]), ([100.0, 0.0], mirrored, [100.0 - first, 100.0 - last])]
    {
        let mechanism = mechanism(pulse(interval));
        let path = mechanism.kinematic_analysis(&times).unwrap_or_else(|error| panic!("{error}"));
        assert!(path.unwatched.is_empty());
        let found: Vec<_> = path.events.iter().filter(|event| event.name == condition).collect();
        let crossings: Vec<Crossing> = found.iter().map(|event| event.crossing).collect();
        assert_eq!(crossings, [Crossing::Violated, Crossing::Restored], "{condition}, {expected:?}");
        for (event, t) in found.iter().zip(expected) {
            assert!((event.t - t).abs() < 1e-8, "{condition}: {} instead of {t}", event.t);
        }
    }
}

#[test]
fn a_pulse_between_two_instants_passes_the_limit_twice() {
    for interval in [[20.0, 40.0], [60.0, 78.0], [5.0, 35.0], [2.0, 48.0], [51.0, 99.0], [33.1, 37.9], [31.0, 79.0]] {
        events(&|f| Finger { f }, "low", interval);
        events(&|f| Finger { f }, "below", interval);
        events(&|f| Post { f }, "low", interval);
        events(&|f| FourBar { f }, "low", interval);
    }
}

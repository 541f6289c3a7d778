//! Pulses of drivers that move a little where a step begins, and show nothing of the pulse there.

use super::grid;
use kin_runtime::{Crossing, Kinematics, mechanism};
use kin_tests::random::Random;

/// A bell of a scalar coordinate.
#[mechanism]
#[coordinates(u)]
#[driver(d: u = exp(-steepness*(t-peak)*(t-peak)))]
#[unilateral(still: u < 0.5)]
#[unilateral(moving: u - 0.1*t < 0.5)]
struct Bell {
    steepness: f64,
    peak: f64,
}

/// The same bell of a crank that drives a slider.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[distance(rod: crank @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[driver(push: crank.phi = exp(-steepness*(t-peak)*(t-peak)))]
#[unilateral(still: crank.phi < 0.5)]
#[unilateral(moving: crank.phi - 0.1*t < 0.5)]
#[guess(slider.x = 0.8)]
struct BellOfCrank {
    steepness: f64,
    peak: f64,
}

/// The numbers of crossings of both conditions, by many values.
fn crossings(steepness: f64, peak: f64, [from, to]: [f64; 2]) -> [usize; 2] {
    let u = |t: f64| (-steepness * (t - peak) * (t - peak)).exp();
    [0.0, 0.1].map(|slope| {
        let is_met = |t: f64| u(t) - slope * t < 0.5;
        let times = grid(from, to, 20_000);
        times.windows(2).filter(|pair| is_met(pair[0]) != is_met(pair[1])).count()
    })
}

#[test]
fn a_pulse_that_the_ends_of_a_step_do_not_show_has_its_events() {
    let mut random = Random::new(7);
    for _ in 0..300 {
        let half = random.between(0.02, 0.6);
        let peak = random.between(1.0, 2.0);
        let steepness = core::f64::consts::LN_2 / (half * half);
        let from = peak - half * random.between(1.2, 5.0) - 0.01;
        let to = peak + half * random.between(1.2, 5.0) + random.between(0.0, 2.0);
        let times = [from - random.between(0.1, 1.5), from, to];
        let expected = crossings(steepness, peak, [times[0], to]);
        for motion in [
            Bell { steepness, peak }.kinematic_analysis(&times).unwrap(),
            BellOfCrank { steepness, peak }.kinematic_analysis(&times).unwrap(),
        ] {
            let of = |name: &str| {
                motion.events.iter().filter(|event| event.name == name && event.crossing != Crossing::Touched).count()
            };
            assert_eq!(expected, [of("still"), of("moving")], "{steepness} {peak} {times:?}");
            assert!(motion.unwatched.is_empty());
        }
    }
}

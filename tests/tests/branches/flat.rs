//! Four-bars that are nearly parallelograms and pass the place at which all bars lie along an axis of the ground, driven by
//! a weighted sum of two angles, so that all their angles are found by one iteration.
//!
//! With a rocker that is longer than the crank, the coupler and the rocker are never in line, and with a shorter one the
//! crank and the coupler are not: so the side on which the middle one of these pins lies is kept in every motion.

use kin_runtime::{Instant, Kinematics, mechanism};
use kin_tests::random::Random;

#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(D: rocker @ (0, 0), ground @ (b, 0))]
#[driver(drive: own * crank.phi + other * rocker.phi = (own + other) * (start + t))]
#[guess(crank.phi = start, rocker.phi = start, coupler.phi = 0)]
#[derive(Clone, Debug)]
struct Weighted {
    a: f64,
    b: f64,
    c: f64,
    own: f64,
    other: f64,
    start: f64,
}

impl Weighted {
    /// The side of the line through two pins on which the pin between them lies, by hand: positive or negative.
    fn side(&self, q: &[f64]) -> f64 {
        let end = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()];
        let crank = end(self.a, q[2]);
        let coupler = end(self.b, q[5]);
        let rocker = end(-self.c, q[8]);
        let [first, second] = if self.c > self.a { [coupler, rocker] } else { [crank, coupler] };
        first[0] * second[1] - first[1] * second[0]
    }
}

#[test]
fn bars_that_lie_along_an_axis_do_not_change_sides() {
    let (mut random, mut reached) = (Random::new(0x0f1a7), 0);
    for _ in 0..60 {
        let longer = 10_f64.powf(random.between(-8.0, -2.5)) * random.between(-1.0, 1.0).signum();
        let (a, start) = (random.between(0.2, 0.9), -random.between(0.3, 1.0));
        let (own, other) = (random.between(0.2, 1.0), random.between(0.05, 1.0));
        let bar = Weighted { a, b: 1.0, c: a + longer, own, other, start };
        let span = random.between(1.0, 2.0);
        for steps in [10, 20, 40] {
            let times: Vec<f64> = (0..=steps).map(|k| span * f64::from(k) / f64::from(steps)).collect();
            let states = match bar.solver().sweep(&times) {
                Ok(trajectory) => trajectory.states,
                Err(error) => error.trajectory.states,
            };
            let mut visited: Vec<Vec<f64>> = states.into_iter().map(|state| state.q).collect();
            let first = visited[0].clone();
            let mut planned = bar.solver().planned(&Instant::at(0.0)).expect("it closes");
            let mut tracker = bar.solver().tracker(&Instant::at(0.0)).expect("it closes");
            visited.extend(times[1..].iter().map_while(|t| Some(planned.at(&Instant::at(*t)).ok()?.q().to_vec())));
            visited.extend(times[1..].iter().map_while(|t| Some(tracker.update(&Instant::at(*t)).ok()?.q.to_vec())));
            let side = bar.side(&first);
            assert!(visited.iter().all(|q| side * bar.side(q) > 0.0), "{bar:?} in {steps} steps");
            reached += usize::from(visited.len() == 3 * times.len() - 2);
        }
    }
    // The others end at dead centres.
    assert!(reached > 30, "{reached}");
}

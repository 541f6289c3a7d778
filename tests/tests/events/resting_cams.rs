//! Events while a cam rests at its highest place, where its slope is a rounding error: bisection of a closed form.

use kin_runtime::function::{CubicSpline, MotionLaw, Sequence};
use kin_runtime::{Crossing, Kinematics, ScalarFunction, mechanism};
use std::f64::consts::PI;

/// A cam lifts a follower, which a second drive lifts as well.
#[mechanism]
#[function(turn, lift, second)]
#[body(cam, x = 0, y = 0)]
#[body(follower, x = 0, phi = 0)]
#[driver(drive: cam.phi = turn(t))]
#[constraint(contact: follower.y = 0.05*size + size*lift(cam.phi) + 0.1*size*second(t/2))]
#[unilateral(limit: follower.y < size * top)]
struct Lifted<F: ScalarFunction, G: ScalarFunction> {
    turn: F,
    lift: CubicSpline,
    second: G,
    top: f64,
    size: f64,
}

#[test]
fn an_event_is_found_while_the_cam_rests_at_its_top() {
    let rise = |end: f64| {
        let sequence = Sequence::starting_at(0.0, 0.0).rise(MotionLaw::ModifiedSine, end, 0.4).dwell(0.2);
        sequence.rise(MotionLaw::Polynomial345, end, 0.3).build().expect("it is regular")
    };
    let angles = [0.0, 0.5, 1.0, 1.5, 2.0].map(|half_turns| half_turns * PI);
    let lift = CubicSpline::periodic(&angles, &[0.0, 0.01, 0.03, 0.01, 0.0]).expect("it is regular");
    let second = MotionLaw::Cycloidal;
    for end in [PI, 0.999_999_9 * PI, 0.99 * PI] {
        let turn = rise(end);
        for (top, size) in [(0.0865, 1.0), (0.09, 1.0), (0.0925, 1.0), (0.09, 1e-3), (0.09, 1e3)] {
            let height = |t: f64| {
                let cam = turn.evaluate(t)[0];
                0.05 + lift.evaluate(cam)[0] + 0.1 * second.evaluate(t / 2.0)[0]
            };
            // The height increases up to the end of the rest.
            let (mut before, mut after) = (0.3, 0.6);
            assert!(height(before) < top && height(after) > top);
            for _ in 0..60 {
                let middle = 0.5 * (before + after);
                *(if height(middle) < top { &mut before } else { &mut after }) = middle;
            }
            let lifted = Lifted { turn: turn.clone(), lift: lift.clone(), second, top, size };
            // Grids that end in the rest and after it, and one that begins in it.
            let grids =
                [(0.0, 0.6), (0.0, 0.65), (0.45, 0.65)].map(|ends| [1, 4, 10, 30, 101].map(|steps| (ends, steps)));
            for ((from, to), steps) in grids.into_iter().flatten().filter(|((from, _), _)| height(*from) < top) {
                let times: Vec<f64> =
                    (0..=steps).map(|k| from + (to - from) * f64::from(k) / f64::from(steps)).collect();
                let trajectory = lifted.solver().sweep(&times).expect("it moves");
                assert!(trajectory.unwatched.is_empty(), "{end} {top} {size} {to} {steps}: {:?}", trajectory.unwatched);
                let [event] = &trajectory.events[..] else { panic!("one event: {:?}", trajectory.events) };
                assert_eq!(Crossing::Violated, event.crossing);
                assert!((event.t - before).abs() < 2e-10, "{end} {top} {size} {to} {steps}: {} {before}", event.t);
            }
        }
    }
}

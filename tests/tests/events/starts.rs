//! Motions that begin at a limit: the condition has the side that follows, and a motion that stopped at an event goes on to
//! the next one.

use super::{Restored, Touched, Violated};
use kin_runtime::{Crossing, Kinematics, Trajectory, mechanism};
use std::f64::consts::{PI, TAU};

/// A slider that moves as a sine, and a limit.
#[mechanism]
#[bodies(slider)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(move_to: slider.x = sin(start + t))]
#[unilateral(limit: slider.x > least)]
struct Sine {
    start: f64,
    least: f64,
}

fn crossings(motion: &Trajectory) -> Vec<(f64, Crossing)> {
    motion.events.iter().map(|event| (event.t, event.crossing)).collect()
}

/// At the first instant the slider is at the limit, to a few units in the last place, and returns to it past its lowest
/// place within one step.
#[test]
fn a_return_within_the_first_step_is_found() {
    for (depth, ulp) in (1..30).flat_map(|k| (-3..=3).map(move |ulp| (0.004 * f64::from(k), ulp))) {
        for direction in [1.0, -1.0] {
            let start = -0.5 * PI - direction * depth;
            let least = f64::from_bits(start.sin().to_bits().wrapping_add_signed(ulp));
            let motion = Sine { start, least }.solver().sweep(&[0.0, 3.0 * direction * depth]).unwrap();
            let found = crossings(&motion);
            // Within rounding of the limit the first crossing may have been before or after the first instant.
            let (last, before) = found.split_last().expect("it returns");
            assert!((last.0 - 2.0 * direction * depth).abs() < 1e-9 && last.1 == Restored, "{depth} {ulp}: {found:?}");
            assert!(before.iter().all(|event| event.0.abs() < 1e-9 && event.1 == Violated), "{depth} {ulp}: {found:?}");
            assert_eq!(before.is_empty(), motion.violated_at_start == [0], "{depth} {ulp}: {found:?}");
        }
    }
}

/// Every sweep begins at the last state of the one before.
#[test]
fn stops_are_the_events_of_the_whole_motion() {
    for (start, least, end) in [(0.3, 0.2, 20.0), (-0.4, -0.999_999, -15.0), (0.1, -1.0, 18.0), (1.0, 0.999, 3.0 * TAU)]
    {
        let sine = Sine { start, least };
        let whole = crossings(&sine.solver().sweep(&[0.0, end]).unwrap());
        let (mut found, mut at) = (Vec::new(), 0.0);
        let mut q = sine.solver().assemble(&0.0.into()).unwrap();
        loop {
            let leg = sine.solver().stop_at_events(true).sweep_from(&q, &[at, end]).unwrap();
            found.extend(crossings(&leg));
            let last = leg.states.last().expect("a state");
            (q, at) = (last.q.clone(), last.t);
            if !leg.stopped {
                break;
            }
            assert!(found.len() <= whole.len(), "{least}: {found:?}, not {whole:?}");
        }
        assert_eq!((end, whole.len()), (at, found.len()), "{least}: {found:?}, not {whole:?}");
        let same = |((t, is), (other, of)): (&(f64, Crossing), &(f64, Crossing))| {
            // An extremum is located by its slope.
            (t - other).abs() < if *is == Touched { 1e-6 } else { 1e-9 } && is == of
        };
        assert!(whole.iter().zip(&found).all(same), "{least}: {found:?}, not {whole:?}");
    }
}

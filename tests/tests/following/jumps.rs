//! Motions that end where a length jumps, however they are followed, and kinks, which they pass.

use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, mechanism};

/// A carriage whose driver jumps back by 2π a at t = π.
#[mechanism]
#[body(carriage, phi = 0, y = 0)]
#[driver(push: carriage.x = far + a * atan2(sin(t), cos(t)))]
struct Carriage {
    far: f64,
    a: f64,
}

/// A slider-crank on a base that jumps.
#[mechanism]
#[body(base, x = a * atan2(sin(t), cos(t)), y = 0, phi = 0)]
#[bodies(crank, rod, slider)]
#[revolute(O: base @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: base @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 0.1 * t)]
#[guess(crank.phi = 0, rod.phi = 0, slider.x = 0.9)]
struct OnBase {
    a: f64,
}

/// The centre of a roller jumps from one side of a cusp to the other.
#[mechanism]
#[coordinates(s)]
#[body(roller, phi = 0)]
#[on_curve(cam: ground @ (0, 0), roller @ (0, 0), parametric(s) = (s - sin(s), 1 - cos(s)), roller = a)]
#[driver(turn: s = pi + t)]
#[guess(s = pi)]
struct Cusp {
    a: f64,
}

/// A carriage that turns back at t = 1.
#[mechanism]
#[body(carriage, phi = 0, y = 0)]
#[driver(push: carriage.x = a * abs(t - 1) + 10)]
struct Kinked {
    a: f64,
}

/// How many instants a sweep, one without the plan, a tracker, the plan's follower and a batch reach.
pub(super) fn reached<M: Mechanism + Sync>(mechanism: &M, times: &[f64]) -> [usize; 5] {
    let (solver, first) = (mechanism.solver(), Instant::at(times[0]));
    let start = solver.state(&first).expect("it closes").q;
    let count = |options: Options| match mechanism.solver().with_options(options).sweep(times) {
        Ok(trajectory) => trajectory.states.len(),
        Err(error) => error.trajectory.states.len(),
    };
    let mut tracker = solver.tracker(&first).expect("it closes");
    let mut planned = solver.planned(&first).expect("it closes");
    let until =
        |go: &mut dyn FnMut(&Instant<'_>) -> bool| 1 + times[1..].iter().take_while(|t| go(&Instant::at(**t))).count();
    let start: Vec<_> = start.into_iter().map(Column::Shared).collect();
    let parameters: Vec<_> = mechanism.parameters::<f64>().as_ref().iter().map(|p| Column::Shared(*p)).collect();
    let sweeps = Sweeps { parameters: &parameters, times, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(1, Vec::new());
    sweep(mechanism, &sweeps, &mut out, &always, |_: &mut Vec<f64>, _| ()).expect("columns of the right length");
    [
        count(Options::default()),
        count(Options { use_plan: false, ..Options::default() }),
        until(&mut |at| tracker.update(at).is_ok()),
        until(&mut |at| planned.at(at).is_ok()),
        out.ends().next().flatten().map_or(times.len(), |end| end.instant),
    ]
}

const GRIDS: [&[f64]; 4] =
    [&[0.0, 4.0], &[0.0, 2.0, 4.0], &[0.0, 3.1, 3.2], &[0.0, 1.0, 2.0, 3.0, 3.1, 3.13, 3.15, 3.2]];

/// The instants before t = π.
fn before(times: &[f64]) -> usize {
    times.iter().filter(|t| **t < std::f64::consts::PI).count()
}

#[test]
fn a_length_that_jumps_ends_the_motion() {
    for times in GRIDS {
        for a in [1e-3, 0.02, 0.3, 1.0, 100.0] {
            for far in [0.0, 100.0] {
                assert_eq!([before(times); 5], reached(&Carriage { far, a }, times), "carriage {far} {a} {times:?}");
            }
            // The jump of a base may be small beside the motion of a slider in the same step.
            if a >= 0.3 {
                assert_eq!([before(times); 5], reached(&OnBase { a }, times), "base {a} {times:?}");
            }
        }
    }
}

#[test]
fn a_roller_does_not_jump_over_a_cusp() {
    for times in GRIDS {
        for a in [0.1, 0.5] {
            assert_eq!([before(times); 5], reached(&Cusp { a }, times), "{a} {times:?}");
        }
    }
}

#[test]
fn kinks_are_passed() {
    for times in GRIDS {
        for a in [1e-3, 1.0, 100.0] {
            assert_eq!([times.len(); 5], reached(&Kinked { a }, times), "{a} {times:?}");
        }
    }
}

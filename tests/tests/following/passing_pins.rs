//! Pins that pass each other at a small distance: a crank that is longer than the distance of the pivots by a gap. The
//! arm turns by half a turn while the crank turns by a few gaps, at rates of 1/gap, and all of that is regular.

use kin_runtime::{Instant, Kinematics, Mechanism, Planned, SweepError, Trajectory, mechanism};
use std::f64::consts::PI;

/// The pin of the crank slides in an arm.
#[mechanism]
#[bodies(crank, arm)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(P: ground @ (1, 0), arm @ (0, 0))]
#[point_on_line(slot: arm @ (0, 0), crank @ (1 + gap, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
struct Slot {
    gap: f64,
}

/// A four-bar whose coupler and rocker are equally long.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (1 + gap, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.5, 0), rocker @ (0.5, 0))]
#[revolute(P: ground @ (1, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct Kite {
    gap: f64,
}

/// The direction from the pivot to the pin of the crank, between 0 and a whole turn, its rate, and their distance.
fn direction(gap: f64, t: f64) -> [f64; 3] {
    let half = (0.5 * t).sin();
    let square = gap * gap + 4.0 * (1.0 + gap) * half * half;
    let angle = ((1.0 + gap) * t.sin()).atan2(gap * t.cos() - 2.0 * half * half);
    // From −π/2 at t < 0 through 0 to π/2.
    [angle, (1.0 + gap) * (gap + 2.0 * half * half) / square, square.sqrt()]
}

/// Half of the angle of the kite at its pivot.
fn half_of_kite(distance: f64) -> f64 {
    distance.acos()
}

/// The instants of three motions: through the passage at once, with an instant in it, and in equal steps.
fn grids(gap: f64) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = (-20..=20).map(|k| vec![-0.8, 0.5 * f64::from(k) * gap, 0.8]).collect();
    all.push(vec![-0.8, 0.8]);
    all.push((-400..=400).map(|k| 0.002 * f64::from(k)).collect());
    all
}

/// Largest relative error of angles and rates: the conditioning of a direction between two pins a gap apart.
fn allowed(gap: f64) -> f64 {
    2e-15 / gap + 1e-13
}

fn check(found: Result<Trajectory, SweepError>, gap: f64, times: &[f64], angle: &dyn Fn([f64; 3]) -> f64) {
    let motion = found.unwrap_or_else(|error| panic!("{gap:e} {times:?}: {error}"));
    assert_eq!(times.len(), motion.states.len());
    for state in &motion.states {
        let truth = direction(gap, state.t);
        let off = state.q[5] - angle(truth);
        assert!((off - (off / (2.0 * PI)).round() * 2.0 * PI).abs() < allowed(gap), "{gap:e} {}: {off:e}", state.t);
    }
}

#[test]
fn a_slot_follows_the_pin_that_passes_its_pivot() {
    for gap in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let slot = Slot { gap };
        let start = [0.0, 0.0, -0.8, 1.0, 0.0, direction(gap, -0.8)[0]];
        for times in grids(gap) {
            check(slot.solver().sweep_from(&start, &times), gap, &times, &|[angle, ..]| angle);
            let mut planned = Planned::new(&slot, &Instant::at(-0.8), &start).unwrap();
            let mut tracker = slot.solver().tracker_from(&Instant::at(-0.8), &start).unwrap();
            for &t in &times[1..] {
                let [_, rate, _] = direction(gap, t);
                planned.at(&Instant::at(t)).unwrap_or_else(|error| panic!("{gap:e} {t}: {error}"));
                let tracked = tracker.update(&Instant::at(t)).unwrap_or_else(|error| panic!("{gap:e} {t}: {error}"));
                for found in [planned.q_dot()[5], tracked.q_dot[5]] {
                    assert!((found / rate - 1.0).abs() < allowed(gap), "{gap:e} {t}: {found} for {rate}");
                }
            }
        }
    }
}

#[test]
fn a_kite_stays_in_its_mode_where_its_pins_pass() {
    for gap in [1e-3, 1e-4, 1e-5, 1e-6] {
        let kite = Kite { gap };
        // The rocker points from the pivot to the knee, the coupler from the pin.
        let rocker = |[angle, _, distance]: [f64; 3]| angle + half_of_kite(distance);
        let at = direction(gap, -0.8);
        let knee = rocker(at);
        let pin = [(1.0 + gap) * 0.8_f64.cos(), -(1.0 + gap) * 0.8_f64.sin()];
        let (x, y) = (1.0 + 0.5 * knee.cos() - pin[0], 0.5 * knee.sin() - pin[1]);
        let start = [0.0, 0.0, -0.8, pin[0], pin[1], y.atan2(x), 1.0, 0.0, knee];
        let coupler = |truth: [f64; 3]| PI + truth[0] - half_of_kite(truth[2]);
        for times in grids(gap) {
            check(kite.solver().sweep_from(&start, &times), gap, &times, &coupler);
        }
    }
}

/// Without a gap the direction between the pins is not determined, and nor is the motion.
#[test]
fn where_pins_meet_the_motion_ends() {
    let slot = Slot { gap: 0.0 };
    let start = [0.0, 0.0, -0.8, 1.0, 0.0, direction(0.0, -0.8)[0]];
    for times in [vec![-0.8, 0.0, 0.8], vec![-0.8, 1e-6, 0.8], vec![-0.8, -1e-6, 0.8]] {
        let error = slot.solver().sweep_from(&start, &times).expect_err("the pins meet");
        let t = error.source.limit().and_then(|limit| limit.at()).unwrap_or(f64::NAN);
        assert!(t.abs() < 2e-6, "{times:?}: {error}");
    }
}

/// A scissor jack, whose knees meet on the spindle at t = 50. The spindle might turn there.
#[mechanism]
#[bodies(ll, lr, left, right)]
#[body(nut, x = 0, y = 0)]
#[body(top, x = 0, phi = 0)]
#[revolute(A: ground @ (0, 0), ll @ (0, 0))]
#[revolute(B: ground @ (0, 0), lr @ (0, 0))]
#[distance(C: ll @ (l, 0), top @ (0, 0), length = l)]
#[distance(D: lr @ (l, 0), top @ (0, 0), length = l)]
#[revolute(L: left @ (0, 0), ll @ (l, 0))]
#[revolute(R: right @ (0, 0), lr @ (l, 0))]
#[translational(spindle: left @ (0, 0), right @ (0, 0), axis = (1, 0))]
#[screw(thread: left @ (0, 0), right @ (0, 0), axis = (1, 0), lead = -p, nut = nut, offset = 0.5)]
#[driver(hand: nut.phi = 2*pi*t)]
#[guess(ll.phi = 2.6, lr.phi = 0.5, top.y = 0.2, left.phi = 0, right.phi = 0)]
struct Jack {
    l: f64,
    p: f64,
}

/// The guide says so: a crossing that shows in no sign is passed along the branch that continues the motion smoothly. Only
/// an instant at the crossing itself has no accelerations.
#[test]
fn the_knees_of_a_jack_pass_one_another() {
    let jack = Jack { l: 0.3, p: 0.01 };
    let solver = jack.solver();
    // The knees are d = 0.5 − p t apart.
    let height = |t: f64| (4.0 * 0.3_f64.powi(2) - (0.5 - 0.01 * t).powi(2)).sqrt();
    let check = |t: f64, q: &[f64]| {
        let of = |name: &str| q[Jack::model().coordinate(name).expect("a coordinate")];
        assert!((of("top.y") - height(t)).abs() < 1e-9 && of("left.phi").abs() < 1e-9, "{t}: {q:?}");
        assert!((of("left.x") + 0.5 * (0.5 - 0.01 * t)).abs() < 1e-9, "{t}: {q:?}");
    };
    for count in [3_u32, 10, 37, 333] {
        let times: Vec<f64> = (0..=count).map(|k| 70.0 * f64::from(k) / f64::from(count)).collect();
        let states = solver.sweep(&times).expect("smooth").states;
        assert_eq!(times.len(), states.len());
        states.iter().for_each(|state| check(state.t, &state.q));
        let mut planned = solver.planned(&Instant::at(0.0)).expect("it closes");
        times.iter().for_each(|&t| check(t, planned.at(&Instant::at(t)).expect("smooth").q()));
    }
    assert!(solver.sweep(&[0.0, 40.0, 50.0, 60.0]).is_err());
}

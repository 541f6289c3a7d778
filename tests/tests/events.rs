//! Unilateral conditions: limits are met where closed forms say, in either direction of time, and nothing else changes.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI, TAU};
use kin_runtime::{Crossing, Event, Instant, Kinematics, Mechanism, Signal, SolveError, Trajectory, mechanism};
use kin_tests::mechanisms::StrokeLimits;
use kin_tests::random::Random;

use Crossing::{Restored, Touched, Violated};

/// A limit so far away that it is never met.
const NEVER: f64 = 1e3;

/// All limits out of the way.
fn free() -> StrokeLimits {
    StrokeLimits {
        far: NEVER,
        near: -NEVER,
        high: NEVER,
        leaning: NEVER,
        ahead: NEVER,
        marks: [-NEVER; 3],
        ..StrokeLimits::default()
    }
}

fn grid(from: f64, to: f64, steps: usize) -> Vec<f64> {
    (0..=steps).map(|k| from + (to - from) * k as f64 / steps as f64).collect()
}

/// The events of one condition as (t, crossing), all of them certain to 1e-10.
fn events_of(trajectory: &Trajectory, name: &str) -> Vec<(f64, Crossing)> {
    let of: Vec<&Event> = trajectory.events.iter().filter(|event| event.name == name).collect();
    for event in &of {
        assert!(event.within <= 1e-10, "{name}: {}", event.within);
        assert_eq!(event.t, event.state.t);
        assert_eq!(trajectory.model.conditions[event.condition].name, name);
    }
    of.iter().map(|event| (event.t, event.crossing)).collect()
}

#[track_caller]
fn agree(found: &[(f64, Crossing)], expected: &[(f64, Crossing)]) {
    assert_eq!(found.len(), expected.len(), "{found:?} and {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found.0 - expected.0).abs() <= 1e-10 && found.1 == expected.1, "{found:?} and {expected:?}");
    }
}

fn sweep<M: Mechanism>(mechanism: &M, times: &[f64]) -> Trajectory {
    mechanism.kinematic_analysis(times).unwrap()
}

#[test]
fn a_stroke_limit_is_met_where_the_closed_form_says() {
    let mechanism = StrokeLimits { far: 0.85, near: 0.55, ..free() };
    let (far, near) = (mechanism.crank_at(0.85), mechanism.crank_at(0.55));
    for steps in [1, 7, 400] {
        let trajectory = sweep(&mechanism, &grid(0.2, TAU + 1.0, steps));
        let start = trajectory.violated_at_start.clone();
        assert_eq!(start, [0], "x is beyond 0.85 at 0.2");
        agree(&events_of(&trajectory, "front"), &[(far, Restored), (TAU - far, Violated), (TAU + far, Restored)]);
        agree(&events_of(&trajectory, "back"), &[(near, Violated), (TAU - near, Restored)]);
        assert!(trajectory.events.is_sorted_by_key(|event| event.t));
        assert!(!trajectory.stopped);
    }
}

#[test]
fn points_distances_and_defines_have_limits() {
    let mechanism = StrokeLimits { high: 0.8, leaning: 0.2, ..free() };
    let trajectory = sweep(&mechanism, &grid(0.0, PI, 5));
    let high = 0.8_f64.asin();
    agree(&events_of(&trajectory, "height"), &[(high, Violated), (PI - high, Restored)]);
    // sin of the rod's angle is −r/l sin φ.
    let leaning = (0.7 * 0.2_f64.sin() / 0.2).asin();
    agree(&events_of(&trajectory, "slope"), &[(leaning, Violated), (PI - leaning, Restored)]);
    // The pin comes as near as 2 r to the eye above it, and no nearer.
    agree(&events_of(&trajectory, "reach"), &[(FRAC_PI_2, Touched)]);
    assert_eq!(trajectory.events.len(), 5);
    for event in &trajectory.events {
        let motion = mechanism.solver().motion(&event.state).unwrap();
        assert!(motion.conditions[event.condition].value.abs() < 1e-12);
    }
}

#[test]
fn a_limit_may_move() {
    let mechanism = StrokeLimits { gap: 0.05, ahead: 0.0, ..free() };
    let trajectory = sweep(&mechanism, &grid(0.0, 7.0, 3));
    assert_eq!(trajectory.violated_at_start, [5]);
    let g = |t: f64| 0.05 * t + 0.7 - (0.2 * t.cos() + (0.49 - (0.2 * t.sin()).powi(2)).sqrt());
    let zero = |mut lo: f64, mut hi: f64| {
        assert!(g(lo) * g(hi) < 0.0);
        for _ in 0..100 {
            let middle = 0.5 * (lo + hi);
            *if g(middle) * g(lo) > 0.0 { &mut lo } else { &mut hi } = middle;
        }
        lo
    };
    let found = events_of(&trajectory, "moving");
    assert!(g(6.2) > 0.0, "later turns stay behind the limit");
    agree(&found, &[(zero(0.5, 2.0), Restored)]);
}

#[test]
fn members_of_a_family_have_events_of_their_own() {
    let mechanism = StrokeLimits { marks: [0.6, 0.7, 0.8], ..free() };
    let trajectory = sweep(&mechanism, &grid(0.0, PI, 1));
    let names: Vec<&str> = trajectory.events.iter().map(|event| event.name).collect();
    assert_eq!(names, ["mark[2]", "mark[1]", "reach", "mark[0]"]);
    for (k, x) in [0.6, 0.7, 0.8].into_iter().enumerate() {
        agree(&events_of(&trajectory, &format!("mark[{k}]")), &[(mechanism.crank_at(x), Violated)]);
    }
}

#[test]
fn a_sweep_may_run_backwards_and_turn_round() {
    let mechanism = StrokeLimits { near: 0.55, ..free() };
    let near = mechanism.crank_at(0.55);
    let back = sweep(&mechanism, &[5.0, 1.0]);
    agree(&events_of(&back, "back"), &[(TAU - near, Violated), (near, Restored)]);
    let there_and_back = sweep(&mechanism, &[1.0, 3.0, 3.0, 1.0]);
    agree(&events_of(&there_and_back, "back"), &[(near, Violated), (near, Restored)]);
    assert_eq!(there_and_back.states[0].q.len(), StrokeLimits::COORDINATES);
}

#[test]
fn two_limits_may_be_met_at_once() {
    let mechanism = StrokeLimits { near: 0.6, marks: [0.6, -NEVER, -NEVER], ..free() };
    let trajectory = sweep(&mechanism, &[1.7, 2.8]);
    let met: Vec<(&str, f64)> = trajectory.events.iter().map(|event| (event.name, event.t)).collect();
    let t = mechanism.crank_at(0.6);
    assert!(met.iter().all(|(_, at)| (at - t).abs() < 1e-10), "{met:?}");
    assert_eq!(met.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["back", "mark[0]"]);
    let stopped = mechanism.solver().stop_at_events(true).sweep(&[1.7, 2.8]).unwrap();
    assert_eq!(stopped.events.len(), 2);
}

#[test]
fn a_limit_met_at_an_instant_of_the_grid_is_met_once() {
    for high in [0.5, 0.5 + 1e-16, 0.5 - 1e-16, 0.5 + 1e-14, 0.5 - 1e-14] {
        let mechanism = StrokeLimits { high, ..free() };
        for times in [vec![0.0, FRAC_PI_6, 1.0], grid(0.0, FRAC_PI_2, 3), vec![0.1, FRAC_PI_6, FRAC_PI_6, 1.2]] {
            let trajectory = sweep(&mechanism, &times);
            agree(&events_of(&trajectory, "height"), &[(FRAC_PI_6, Violated)]);
            let back: Vec<f64> = times.iter().rev().copied().collect();
            agree(&events_of(&sweep(&mechanism, &back), "height"), &[(FRAC_PI_6, Restored)]);
        }
    }
    // The sweep may end or begin there.
    let mechanism = StrokeLimits { high: 0.5, ..free() };
    agree(&events_of(&sweep(&mechanism, &[0.0, FRAC_PI_6]), "height"), &[(FRAC_PI_6, Violated)]);
    let inwards = sweep(&mechanism, &[FRAC_PI_6, 0.0]);
    assert!(inwards.events.is_empty() && inwards.violated_at_start.is_empty(), "{:?}", inwards.events);
    let outwards = sweep(&mechanism, &[FRAC_PI_6, 1.0]);
    assert!(outwards.events.is_empty());
    assert_eq!(outwards.violated_at_start, [2]);
}

#[test]
fn a_limit_that_is_touched_is_no_crossing() {
    let mechanism = StrokeLimits { far: 0.2 + 0.7, near: 0.7 - 0.2, ..free() };
    for times in
        [vec![-1.0, 7.0], grid(-1.0, 7.0, 100), vec![-1.0, 0.0, PI, TAU, 7.0], vec![-1.0, -1e-9, 1e-9, 3.0, 7.0]]
    {
        let trajectory = sweep(&mechanism, &times);
        agree(&events_of(&trajectory, "front"), &[(0.0, Touched), (TAU, Touched)]);
        agree(&events_of(&trajectory, "back"), &[(PI, Touched)]);
        assert!(trajectory.violated_at_start.is_empty());
    }
    // Violated all the time but for the instant at which it is touched: x > r + l.
    let mechanism = StrokeLimits { near: 0.2 + 0.7, ..free() };
    let trajectory = sweep(&mechanism, &[-1.0, 1.0]);
    agree(&events_of(&trajectory, "back"), &[(0.0, Touched)]);
    assert_eq!(trajectory.violated_at_start, [1]);
}

/// Conditions that are exact squares, so that their rounding vanishes with them, beside one that is none.
#[mechanism]
#[bodies(a)]
#[revolute(pin: ground @ (0, 0), a @ (0, 0))]
#[driver(d: a.phi = omega * t)]
#[unilateral(square: pow(a.phi - at, 2) > -depth)]
#[unilateral(from_above: -scale * (a.phi - at).powi(2) > 0)]
#[unilateral(cosine: 1 - cos(a.phi - at) > 0)]
struct Squares {
    #[param(1)]
    omega: f64,
    #[param(0.5)]
    at: f64,
    #[param(0)]
    depth: f64,
    #[param(1000)]
    scale: f64,
}

#[test]
fn an_exact_square_is_touched() {
    for (omega, at) in [(1.0, 0.5), (0.01, 0.005), (300.0, 150.0), (-3.0, -1.5), (1.0, 0.1 + 0.2)] {
        let mechanism = Squares { omega, at, ..Squares::default() };
        for times in [vec![0.1, 0.9], vec![0.0, 1.0], vec![0.0, 3.0], grid(-1.0, 1.0, 7), vec![0.0, 0.5, 1.0]] {
            let back: Vec<f64> = times.iter().rev().copied().collect();
            for times in [times, back] {
                let trajectory = sweep(&mechanism, &times);
                // The cosine comes back after a turn.
                let names =
                    if omega.abs() > 1.0 { &["square", "from_above"][..] } else { &["square", "from_above", "cosine"] };
                for name in names {
                    agree(&events_of(&trajectory, name), &[(at / omega, Touched)]);
                }
                assert_eq!(trajectory.violated_at_start, [1]);
            }
        }
    }
    // Where it stays clear of the limit, however little, it is not touched; where it goes beyond, it is crossed twice.
    let clear = sweep(&Squares { depth: 1e-18, ..Squares::default() }, &[0.0, 1.0]);
    assert_eq!(events_of(&clear, "square"), []);
    let crossed = sweep(&Squares { depth: -1e-14, ..Squares::default() }, &[0.0, 1.0]);
    agree(&events_of(&crossed, "square"), &[(0.5 - 1e-7, Violated), (0.5 + 1e-7, Restored)]);
}

#[test]
fn a_limit_that_is_passed_a_little_is_crossed_twice() {
    for depth in [1e-4, 1e-8, 1e-12] {
        let mechanism = StrokeLimits { far: 0.9 - depth, ..free() };
        let trajectory = sweep(&mechanism, &[-1.0, 1.0]);
        // x = r + l − ½ (r + r²/l) φ² + …
        let about = (2.0 * depth / (0.2 + 0.04 / 0.7)).sqrt();
        let [(first, Violated), (second, Restored)] = events_of(&trajectory, "front")[..] else {
            panic!("{:?}", trajectory.events)
        };
        for t in [-first, second] {
            assert!((t - about).abs() < 1e-3 * about, "{t} and {about}");
        }
    }
}

#[test]
fn a_sweep_may_stop_at_the_first_event() {
    let mechanism = StrokeLimits { far: 0.85, near: 0.55, ..free() };
    let times = grid(1.7, 7.0, 12);
    let whole = sweep(&mechanism, &times);
    let stopped = mechanism.solver().stop_at_events(true).sweep(&times).unwrap();
    assert!(stopped.stopped && !whole.stopped);
    let near = mechanism.crank_at(0.55);
    let last = stopped.last().unwrap();
    assert!((last.t - near).abs() < 1e-10);
    assert_eq!(stopped.events.len(), 1);
    assert_eq!(stopped.events[0].state, *last);
    assert_eq!(stopped.states[..stopped.len() - 1], whole.states[..stopped.len() - 1]);
    assert!(times[stopped.len() - 2] < near && near < times[stopped.len() - 1]);
    let motion = mechanism.solver().motion(last).unwrap();
    assert!(motion.conditions[1].value.abs() < 1e-12);
    // Nothing to stop at.
    let quiet = mechanism.solver().stop_at_events(true).sweep(&[1.7, 1.9, 2.2]).unwrap();
    assert!(!quiet.stopped && quiet.len() == 3);
}

/// The slider-crank of [`StrokeLimits`] with nothing to watch.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
#[guess(rod.phi = 0, slider.x = 0.9)]
struct Unlimited;

/// The same with conditions.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
#[guess(rod.phi = 0, slider.x = 0.9)]
#[unilateral(front: slider.x < 0.85)]
#[unilateral(wave: sin(40 * t) > -0.99)]
#[unilateral(level: slider.y > 0)]
struct Limited;

#[test]
fn watching_changes_nothing() {
    for times in [grid(0.0, 7.0, 3), grid(5.0, -2.0, 50), vec![0.3, 2.0, 1.0]] {
        let (with, without) = (sweep(&Limited, &times), sweep(&Unlimited, &times));
        assert!(!with.events.is_empty() && without.events.is_empty());
        assert_eq!(with.states, without.states);
    }
}

#[test]
fn a_condition_may_change_faster_than_the_mechanism_moves() {
    let trajectory = sweep(&Limited, &[0.0, TAU]);
    let below = (-0.99_f64).asin();
    let expected: Vec<(f64, Crossing)> = (1..=40)
        .flat_map(|k| {
            let turn = f64::from(k) * TAU;
            [((turn - PI - below) / 40.0, Violated), ((turn + below) / 40.0, Restored)]
        })
        .collect();
    agree(&events_of(&trajectory, "wave"), &expected);
}

#[test]
fn what_stands_still_at_its_limit_has_no_events() {
    for times in [grid(0.0, 7.0, 3), grid(0.5, -7.0, 40)] {
        assert!(events_of(&sweep(&Limited, &times), "level").is_empty());
    }
}

/// The piston drives, up to the dead centre and beyond it.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: slider.x = 0.6 + 0.1 * t)]
#[unilateral(early: crank.phi > 1)]
#[unilateral(root: sqrt(6 - t) > 1)]
#[guess(crank.phi = 1.9, rod.phi = -0.3)]
struct Driven;

#[test]
fn events_before_the_end_of_a_branch_are_kept() {
    let start = Driven.state_at(&Instant::at(0.0)).unwrap();
    assert!(start.q[2] > 1.0);
    let error = Driven.kinematic_analysis(&[0.0, 1.0, 3.5]).unwrap_err();
    assert!(matches!(error.source, SolveError::Singular { .. } | SolveError::StepRefused { .. }), "{error}");
    assert_eq!(error.trajectory.len(), 2);
    let x = 0.2 * 1.0_f64.cos() + (0.49 - (0.2 * 1.0_f64.sin()).powi(2)).sqrt();
    agree(&events_of(&error.trajectory, "early"), &[((x - 0.6) / 0.1, Violated)]);
    let stopped = Driven.solver().stop_at_events(true).sweep(&[0.0, 1.0, 3.5]).unwrap();
    assert!(stopped.stopped && stopped.len() == 3);
}

/// A crank and a condition that has no value from t = 1 on.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[driver(drive: crank.phi = t)]
#[unilateral(root: sqrt(1 - t) > 0.1)]
#[unilateral(edge: sqrt(abs(crank.phi - 0.5)) > 0.1)]
struct Undefined;

#[test]
fn a_condition_without_a_value_is_an_error() {
    let error = Undefined.kinematic_analysis(&[0.0, 0.9, 2.0]).unwrap_err();
    let SolveError::NonFinite { what: "conditions", name: "root", t: Some(_), .. } = error.source else {
        panic!("{error}")
    };
    assert_eq!(error.trajectory.len(), 2);
    agree(&events_of(&error.trajectory, "edge"), &[(0.49, Violated), (0.51, Restored)]);
}

/// A sleigh that glides along its blade while the blade turns: a circle of radius v / ω around (0, v / ω).
#[mechanism]
#[bodies(sleigh)]
#[knife_edge(blade: sleigh @ (0, 0))]
#[speed(glide: sleigh @ (0, 0), value = 1.5)]
#[driver(turn: sleigh.phi = 0.5 * t)]
#[unilateral(wall: sleigh.y < 4)]
#[unilateral(ahead: sleigh.x > -1)]
#[guess(sleigh.x = 0, sleigh.y = 0)]
struct Sleigh;

#[test]
fn integrated_motions_meet_their_limits_too() {
    let trajectory = sweep(&Sleigh, &[0.0, 4.0, 12.0]);
    // x = 3 sin(t/2), y = 3 − 3 cos(t/2), as exact as the integration is.
    let wall = 2.0 * (-1.0_f64 / 3.0).acos();
    let ahead = 2.0 * (PI + (1.0_f64 / 3.0).asin());
    let expected = [
        ("wall", wall, Violated),
        ("ahead", ahead, Violated),
        ("wall", 2.0 * TAU - wall, Restored),
        ("ahead", 2.0 * TAU - 2.0 * (1.0_f64 / 3.0).asin(), Restored),
    ];
    assert_eq!(trajectory.events.len(), expected.len());
    for (event, (name, t, crossing)) in trajectory.events.iter().zip(expected) {
        assert_eq!((event.name, event.crossing), (name, crossing));
        assert!((event.t - t).abs() < 1e-7 && event.within <= 1e-10, "{name}: {} and {t}", event.t);
    }
}

/// Two waves that pass many levels.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[driver(drive: crank.phi = t)]
#[unilateral(above[i in 0..6]: sin(w * crank.phi) + a * sin(v * t + c) > level[i])]
#[derive(Debug)]
struct Waves {
    w: f64,
    v: f64,
    a: f64,
    c: f64,
    level: [f64; 6],
}

#[test]
fn no_crossing_of_two_waves_is_missed() {
    let mut random = Random::new(7);
    for _ in 0..20 {
        let level = core::array::from_fn(|_| random.between(-1.5, 1.5));
        let [w, v, a, c] = [(0.5, 12.0), (0.5, 12.0), (0.0, 1.0), (0.0, TAU)].map(|(lo, hi)| random.between(lo, hi));
        let waves = Waves { w, v, a, c, level };
        let trajectory = sweep(&waves, &[0.0, 6.0]);
        for (k, level) in level.into_iter().enumerate() {
            let g = |t: f64| (w * t).sin() + a * (v * t + c).sin() - level;
            let fine: Vec<f64> = grid(0.0, 6.0, 60_000);
            let crossed: Vec<(f64, Crossing)> = (fine.windows(2))
                .filter(|pair| g(pair[0]).signum() != g(pair[1]).signum())
                .map(|pair| (pair[0], if g(pair[1]) < 0.0 { Violated } else { Restored }))
                .collect();
            let found = events_of(&trajectory, &format!("above[{k}]"));
            assert_eq!(found.len(), crossed.len(), "{waves:?} {level}: {found:?} and {crossed:?}");
            for (found, crossed) in found.iter().zip(crossed) {
                assert!((0.0..1e-4).contains(&(found.0 - crossed.0)) && found.1 == crossed.1);
                assert!(g(found.0).abs() < 1e-10);
            }
        }
    }
}

/// A measured cylinder, with limits on what is measured and on where it leads.
#[mechanism]
#[input(length)]
#[body(boom, x = 0, y = 0)]
#[distance(cylinder: ground @ (0, -1), boom @ (1, 0), length = length)]
#[unilateral(stroke: length < 1.5)]
#[unilateral(up: boom.phi < 0.2)]
#[guess(boom.phi = 0)]
struct Lifted;

#[test]
fn inputs_have_limits_too() {
    let length = |t: f64, u: &mut [Signal]| {
        u[0] = Signal { value: 1.4 + 0.2 * t.sin(), rate: 0.2 * t.cos(), acceleration: -0.2 * t.sin() };
    };
    let trajectory = Lifted.solver().with_inputs(&length).sweep(&[0.0, PI]).unwrap();
    agree(&events_of(&trajectory, "stroke"), &[(FRAC_PI_6, Violated), (PI - FRAC_PI_6, Restored)]);
    // |(cos φ, sin φ + 1)|² = 2 + 2 sin φ = length².
    let at = (((2.0 + 2.0 * 0.2_f64.sin()).sqrt() - 1.4) / 0.2).asin();
    agree(&events_of(&trajectory, "up"), &[(at, Violated), (PI - at, Restored)]);
    let measured = |event: &Event| event.state.inputs[0].value;
    assert!(trajectory.events.iter().all(|e| (measured(e) - (1.4 + 0.2 * e.t.sin())).abs() < 1e-14));
}

//! Conditions combined with other features: integrated motions, inputs, ends of branches, and undefined values.

use super::*;
use kin_runtime::State;

/// The slider-crank of [`StrokeLimits`] without conditions.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
#[point(middle = rod @ (0.35, 0))]
#[guess(rod.phi = 0, slider.x = 0.9)]
struct Unlimited;

/// The slider-crank with conditions.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
#[point(middle = rod @ (0.35, 0))]
#[guess(rod.phi = 0, slider.x = 0.9)]
#[unilateral(front: slider.x < 0.85)]
#[unilateral(wave: sin(40 * t) > -0.99)]
#[unilateral(level: slider.y > 0)]
struct Limited;

/// Asserts that two trajectories agree in everything but the model and the events.
#[track_caller]
fn the_same_but_for_events(with: &Trajectory, without: &Trajectory) {
    assert!(!with.events.is_empty() && without.events.is_empty());
    assert_eq!(with.len(), without.len());
    for (with, without) in with.iter().zip(without) {
        assert_eq!(State { model: without.model, ..with.clone() }, *without);
    }
}

#[test]
fn watching_changes_nothing() {
    for times in [grid(0.0, 7.0, 3), grid(5.0, -2.0, 50), vec![0.3, 2.0, 1.0]] {
        the_same_but_for_events(&sweep(&Limited, &times), &sweep(&Unlimited, &times));
        let solvers = (Lifted.solver().with_inputs(&lifting), Unwatched.solver().with_inputs(&lifting));
        the_same_but_for_events(&solvers.0.sweep(&times).unwrap(), &solvers.1.sweep(&times).unwrap());
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

/// The slider is driven to its dead centre and beyond.
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

/// A crank with a condition that is undefined from t = 1 on.
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
    // x = 3 sin(t/2), y = 3 − 3 cos(t/2), as accurate as the integration.
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

/// A sum of two waves with several levels.
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

/// A cylinder whose length is an input, with limits on its length and on the resulting angle.
#[mechanism]
#[input(length)]
#[body(boom, x = 0, y = 0)]
#[distance(cylinder: ground @ (0, -1), boom @ (1, 0), length = length)]
#[unilateral(stroke: length < 1.5)]
#[unilateral(up: boom.phi < 0.2)]
#[guess(boom.phi = 0)]
struct Lifted;

/// The cylinder without conditions.
#[mechanism]
#[input(length)]
#[body(boom, x = 0, y = 0)]
#[distance(cylinder: ground @ (0, -1), boom @ (1, 0), length = length)]
#[guess(boom.phi = 0)]
struct Unwatched;

/// The length of the cylinder.
fn lifting(t: f64, u: &mut [Signal]) {
    u[0] = Signal { value: 1.4 + 0.2 * t.sin(), rate: 0.2 * t.cos(), acceleration: -0.2 * t.sin() };
}

#[test]
fn inputs_have_limits_too() {
    let trajectory = Lifted.solver().with_inputs(&lifting).sweep(&[0.0, PI]).unwrap();
    agree(&events_of(&trajectory, "stroke"), &[(FRAC_PI_6, Violated), (PI - FRAC_PI_6, Restored)]);
    // |(cos φ, sin φ + 1)|² = 2 + 2 sin φ = length².
    let at = (((2.0 + 2.0 * 0.2_f64.sin()).sqrt() - 1.4) / 0.2).asin();
    agree(&events_of(&trajectory, "up"), &[(at, Violated), (PI - at, Restored)]);
    let measured = |event: &Event| event.state.inputs[0].value;
    assert!(trajectory.events.iter().all(|e| (measured(e) - (1.4 + 0.2 * e.t.sin())).abs() < 1e-14));
}

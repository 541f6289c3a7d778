//! Limits that are touched or passed by a small amount, and sweeps that stop there.

use super::*;

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
    // The condition x > r + l is violated at all times, except for the instant at which the limit is touched.
    let mechanism = StrokeLimits { near: 0.2 + 0.7, ..free() };
    let trajectory = sweep(&mechanism, &[-1.0, 1.0]);
    agree(&events_of(&trajectory, "back"), &[(0.0, Touched)]);
    assert_eq!(trajectory.violated_at_start, [1]);
}

/// Conditions that are exact squares, whose rounding errors vanish together with the value, and one that is not a
/// square.
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
                // The cosine touches its limit again after a full turn.
                let names =
                    if omega.abs() > 1.0 { &["square", "from_above"][..] } else { &["square", "from_above", "cosine"] };
                for name in names {
                    agree(&events_of(&trajectory, name), &[(at / omega, Touched)]);
                }
                assert_eq!(trajectory.violated_at_start, [1]);
            }
        }
    }
    // If the square stays clear of the limit by a small amount, it is not touched; if it passes the limit, there are
    // two crossings.
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
    // Without an event the sweep does not stop.
    let quiet = mechanism.solver().stop_at_events(true).sweep(&[1.7, 1.9, 2.2]).unwrap();
    assert!(!quiet.stopped && quiet.len() == 3);
}

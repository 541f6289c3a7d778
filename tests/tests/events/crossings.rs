//! Conditions that pass their limits beside a crossing of branches that a sweep passes: no instant near it can be solved, so
//! that events are located less closely, or the condition was not watched there.

use kin_runtime::{Event, Kinematics, Trajectory, mechanism};
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

/// A scissor jack whose knees meet on the spindle at s = v t, where two motions cross.
#[mechanism]
#[bodies(ll, lr, ul, ur, spin)]
#[body(table, x = 0, phi = 0)]
#[revolute(A: ground @ (0, 0), ll @ (0, 0))]
#[revolute(B: ground @ (0, 0), lr @ (0, 0))]
#[revolute(C: ll @ (2, 0), ul @ (0, 0))]
#[revolute(D: lr @ (2, 0), ur @ (0, 0))]
#[revolute(E: ul @ (2, 0), table @ (0, 0))]
#[revolute(F: ur @ (2, 0), table @ (0, 0))]
#[revolute(G: ll @ (2, 0), spin @ (0, 0))]
#[point_on_line(level: spin @ (0, 0), lr @ (2, 0), axis = (1, 0))]
#[point_on_line(spindle: spin @ (0, 0), lr @ (2, 0), axis = (0, 1), offset = -(s - v*t))]
#[unilateral(top: table.y < bound)]
#[unilateral(knee: ll.phi > 0.5 * pi + angle)]
struct Jack {
    s: f64,
    v: f64,
    bound: f64,
    angle: f64,
}

impl Jack {
    /// The coordinates by hand.
    fn configuration(&self, t: f64) -> Vec<f64> {
        let a = ((self.s - self.v * t) / 4.0).acos();
        let (x, y) = (2.0 * a.cos(), 2.0 * a.sin());
        vec![0.0, 0.0, PI - a, 0.0, 0.0, a, -x, y, a, x, y, PI - a, -x, y, 0.0, 2.0 * y]
    }

    /// The instants from 0 to the end at which the conditions pass their limits, by hand.
    fn events(&self, end: f64) -> Vec<(&'static str, f64)> {
        let height = 4.0 * (self.bound / 4.0).acos().sin();
        let at = |distance: f64| (self.s - distance) / self.v;
        let mut all = vec![("top", at(height)), ("knee", at(4.0 * self.angle.sin())), ("top", at(-height))];
        all.retain(|(_, t)| (0.0..end).contains(t));
        all
    }
}

/// The events by hand that are neither found within their width nor lie where their condition was not watched.
fn missed(found: &Trajectory, expected: &[(&'static str, f64)]) -> Vec<(&'static str, f64)> {
    let is_found = |&&(name, t): &&(&'static str, f64)| {
        let is_it = |event: &&Event| event.name == name && (event.t - t).abs() <= event.within + 1e-8;
        let unwatched = found.unwatched.iter().any(|gap| gap.name == name && gap.from <= t && t <= gap.to);
        unwatched || found.events.iter().any(|event| is_it(&event))
    };
    expected.iter().filter(|event| !is_found(event)).copied().collect()
}

#[test]
fn events_beside_a_crossing_are_found_or_reported_as_unwatched() {
    let mut random = Random::new(5);
    let (mut exact, mut inexact) = (0, 0);
    for round in 0..200 {
        let near = 10.0_f64.powf(random.between(-5.0, -0.5));
        let (s, v) = (random.between(1.0, 2.5), random.between(0.5, 1.5));
        let bound = 4.0 * (near * random.between(0.3, 1.0)).cos();
        let jack = Jack { s, v, bound, angle: near * random.between(0.3, 1.0) };
        let (steps, end) = (random.between(3.0, 27.0).floor(), 1.7 * s / v);
        let times: Vec<f64> = (0..=steps as u32).map(|k| end * f64::from(k) / steps).collect();
        if times.iter().any(|t| (t - s / v).abs() < 0.01) {
            continue; // An instant so near to the crossing would be refused.
        }
        let found = jack.solver().sweep_from(&jack.configuration(0.0), &times);
        let found = found.unwrap_or_else(|error| panic!("{round}: {error}"));
        let off = found.states.iter().flat_map(|state| {
            let expected = jack.configuration(state.t);
            state.q.iter().zip(expected).map(|(q, expected)| (q - expected).abs()).collect::<Vec<_>>()
        });
        assert!(off.fold(0.0, f64::max) < 1e-12, "{round}: another motion");
        let missed = missed(&found, &jack.events(end));
        assert!(missed.is_empty(), "{round}, near {near:e}: missed {missed:?}, found {:?}", found.events);
        let is_exact = found.unwatched.is_empty() && found.events.iter().all(|event| event.within < 1e-8);
        assert!(is_exact || near < 0.01, "{round}, near {near:e}: {:?}", found.unwatched);
        *(if is_exact { &mut exact } else { &mut inexact }) += 1;
    }
    assert!(exact > 50 && inexact > 50, "{exact} and {inexact}");
}

/// A slider-crank of nearly equal links, which passes its change point; nearer than rounding resolves, steps end there that
/// are taken for the sake of a condition.
#[mechanism]
#[bodies(crank, rod)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (1, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[driver(turn: crank.phi = t)]
#[guess(crank.phi = 0.3, rod.phi = -0.3)]
struct Isosceles {
    l: f64,
}

/// The same with a condition.
#[mechanism]
#[bodies(crank, rod)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (1, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[driver(turn: crank.phi = t)]
#[guess(crank.phi = 0.3, rod.phi = -0.3)]
#[unilateral(reach: slider.x < 1.1)]
struct Watched {
    l: f64,
}

#[test]
fn a_motion_that_passes_a_change_point_passes_it_with_conditions_too() {
    let mut random = Random::new(11);
    let (mut passed, mut events) = (0, 0);
    for round in 0..300 {
        let l = 1.0 + 10.0_f64.powf(random.between(-11.0, -3.0));
        let (first, step) = (random.between(0.2, 0.6), random.between(0.2, 0.9));
        let times: Vec<f64> = (0..6).map(|k| first + step * f64::from(k)).collect();
        if times.iter().any(|t| (t - FRAC_PI_2).abs() < 0.02 || (t - 3.0 * FRAC_PI_2).abs() < 0.02) {
            continue;
        }
        let plain = Isosceles { l }.kinematic_analysis(&times);
        let watched = Watched { l }.kinematic_analysis(&times);
        let (Ok(plain), Ok(watched)) = (&plain, &watched) else {
            assert!(plain.is_err() && watched.is_err(), "{round}, {l}: {plain:?}, {watched:?}");
            continue;
        };
        passed += 1;
        for (a, b) in plain.states.iter().zip(&watched.states) {
            let off = a.q.iter().zip(&b.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-12, "{round}, {l}: {off:e} at t = {}", a.t);
        }
        events += watched.events.len();
    }
    assert!(passed > 200 && events > 100, "{passed} motions, {events} events");
}

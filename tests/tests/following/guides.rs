//! Guides whose direction is given by parameters: the plan solves them in every direction.

use kin_runtime::{Instant, Kinematics, Options, Solver, mechanism};
use kin_tests::random::Random;

/// A slider-crank whose rod is a distance and whose guide is tilted.
#[mechanism]
#[bodies(crank, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[distance(rod: crank @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (cos(tilt), sin(tilt)))]
#[driver(drive: crank.phi = 3 * t)]
#[guess(crank.phi = 0.1, slider.x = 0.9 * cos(tilt), slider.y = 0.9 * sin(tilt))]
struct Tilted {
    tilt: f64,
}

/// A pin on two lines.
#[mechanism]
#[bodies(pin)]
#[constraint(first: p * pin.x + q * pin.y = 0.1)]
#[constraint(second: q * pin.x - p * pin.y = 0.2 * t)]
#[driver(turn: pin.phi = t)]
struct Lines {
    p: f64,
    q: f64,
}

#[test]
fn a_slider_runs_along_a_guide_in_any_direction() {
    for tilt in [0.0, 1e-9, 0.3, std::f64::consts::FRAC_PI_2, std::f64::consts::PI, -1.2] {
        let tilted = Tilted { tilt };
        let mut planned = tilted.solver().planned(&Instant::at(0.0)).expect("it closes");
        for k in 1..30 {
            let t = 0.1 * f64::from(k);
            // Along the guide the law of cosines holds for the crank's angle from it.
            let angle = 3.0 * t - tilt;
            let along = 0.2 * angle.cos() + (0.49 - (0.2 * angle.sin()).powi(2)).sqrt();
            let q = planned.at(&Instant::at(t)).expect("the crank turns").q();
            let off = (q[3] - along * tilt.cos()).hypot(q[4] - along * tilt.sin());
            assert!(off < 1e-14, "tilt {tilt}, t = {t}: {off:e}");
        }
        let all = tilted.solver().ranges(&Instant::at(0.0), 3.0).expect("ranges");
        assert!(all.is_complete() && all.ranges.len() == 2, "{all}");
    }
}

#[test]
fn a_pin_lies_where_two_lines_meet() {
    for (p, q) in [(0.0, 1.0), (1.0, 0.0), (0.6, 0.8)] {
        let lines = Lines { p, q };
        let mut planned = lines.solver().planned(&Instant::at(0.0)).expect("the lines meet");
        let found = planned.at(&Instant::at(0.7)).expect("the lines meet").q().to_vec();
        let exact = [0.1 * p + 0.14 * q, 0.1 * q - 0.14 * p];
        assert!((found[0] - exact[0]).hypot(found[1] - exact[1]) < 1e-15, "{p} {q}: {found:?}");
    }
}

/// A rod whose ends run in two slots through the origin. No closed form: the distance of a third point is prescribed.
#[mechanism]
#[bodies(rod)]
#[point_on_line(lower: ground @ (0, 0), rod @ (0, 0), axis = (cos(a), sin(a)))]
#[point_on_line(upper: ground @ (0, 0), rod @ (1, 0), axis = (cos(b), sin(b)))]
#[driver(pull: distance(ground @ (2, 1), rod @ (0.5, 0.2)) = 1.9 + 0.1 * sin(t))]
#[guess(rod.x = 0.6, rod.y = 0.3, rod.phi = 0.8)]
struct Trammel {
    a: f64,
    b: f64,
}

/// The pose of the rod at an angle, from the intersection of the slots with its ends.
fn trammel([a, b]: [f64; 2], phi: f64) -> [f64; 3] {
    // s₂ (cos b, sin b) − s₁ (cos a, sin a) = (cos φ, sin φ), solved for s₁.
    let along = (b - phi).sin() / (a - b).sin();
    [along * a.cos(), along * a.sin(), phi]
}

/// The distance of the third point at an angle.
fn reach(slots: [f64; 2], phi: f64) -> f64 {
    let [x, y, _] = trammel(slots, phi);
    (x + 0.5 * phi.cos() - 0.2 * phi.sin() - 2.0).hypot(y + 0.5 * phi.sin() + 0.2 * phi.cos() - 1.0)
}

#[test]
fn an_iteration_contains_guides_in_any_direction() {
    for a in [0.0, 1e-12, 1e-9, 1e-5, std::f64::consts::PI] {
        let rod = Trammel { a, b: 1.5 };
        let mut planned = rod.solver().planned(&Instant::at(0.0)).expect("it closes");
        let times: Vec<f64> = (0..40).map(|k| 0.1 * f64::from(k)).collect();
        for &t in &times[1..34] {
            let q = planned.at(&Instant::at(t)).expect("before the dead centre").q();
            let off = q.iter().zip(trammel([a, 1.5], q[2])).map(|(q, exact)| (q - exact).abs()).fold(0.0, f64::max);
            let apart = (reach([a, 1.5], q[2]) - 1.9 - 0.1 * t.sin()).abs();
            assert!(off < 1e-13 && apart < 1e-13, "a = {a}, t = {t}: {off:e} {apart:e}");
        }
        // The dead centre is where the distance is smallest.
        let phi = planned.q()[2];
        let (mut low, mut high) = (phi - 0.5, phi + 0.5);
        for _ in 0..200 {
            let [left, right] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            if reach([a, 1.5], left) < reach([a, 1.5], right) { high = right } else { low = left }
        }
        let end = std::f64::consts::PI - ((reach([a, 1.5], low) - 1.9) / 0.1).asin();
        let step = planned.at(&Instant::at(3.5)).expect_err("past it");
        let sweep = rod.solver().sweep(&times).expect_err("past it").source;
        for located in [step.limit().map(|limit| &limit.located), sweep.limit().map(|limit| &limit.located)] {
            let limit = located.and_then(Option::as_ref).expect("a limit with its t");
            assert!((limit.at - end).abs() < 1e-9, "a = {a}: {} instead of {end}", limit.at);
        }
    }
}

/// A coupler between two sliders, whose travels along their guides are coupled: an iteration on more than three
/// unknowns.
#[mechanism]
#[bodies(coupler, first, second)]
#[translational(g1: ground @ (0, 0), first @ (0, 0), axis = (cos(a), sin(a)))]
#[translational(g2: ground @ (1, 0.2), second @ (0, 0), axis = (cos(b), sin(b)))]
#[distance(d1: first @ (0, 0.1), coupler @ (0, 0), length = l1)]
#[distance(d2: second @ (0, 0), coupler @ (0.6, 0), length = l2)]
#[distance(d3: ground @ (0.5, 1.5), coupler @ (0.3, 0.4), length = l3)]
#[constraint(travels: first.x * cos(a) + first.y * sin(a) + k * (second.x * cos(b) + second.y * sin(b)) = h + 0.2 * t)]
#[driver(pull: distance(ground @ (-1, 1), coupler @ (0.1, 0.1)) = l4 + 0.1 * sin(t))]
struct Coupled {
    a: f64,
    b: f64,
    l1: f64,
    l2: f64,
    l3: f64,
    l4: f64,
    k: f64,
    h: f64,
}

#[test]
fn larger_iterations_are_solved_in_every_direction_of_a_guide() {
    let times: Vec<f64> = (0..=20).map(|k| 0.02 * f64::from(k)).collect();
    let angles = [0.0, 1e-14, 1e-9, 1e-5, 1e-3, std::f64::consts::FRAC_PI_2, std::f64::consts::PI];
    for (special, a_is_special) in angles.iter().flat_map(|&angle| [(angle, true), (angle, false)]) {
        let (mut random, mut regular) = (Random::new(8), 0);
        for _ in 0..25 {
            let [other, k, h] = [3.0, 1.0, 0.5].map(|most| random.between(-most, most));
            let [l1, l2, l3, l4] = [0.5, 0.5, 0.5, 0.8].map(|least| random.between(least, least + 0.9));
            let (a, b) = if a_is_special { (special, other) } else { (other, special) };
            let coupled = Coupled { a, b, l1, l2, l3, l4, k, h };
            let newton = coupled.solver().with_options(Options { use_plan: false, ..Options::default() });
            let Ok(start) = newton.state(&Instant::at(0.0)) else { continue };
            let (newton, own) = (start_at(newton, &start.q), start_at(coupled.solver(), &start.q));
            let Ok(expected) = newton.sweep(&times) else { continue };
            if expected.iter().any(|state| newton.condition(state).is_ok_and(|condition| condition > 1e3)) {
                continue;
            }
            let swept = own.sweep(&times).unwrap_or_else(|error| panic!("{a} {b} {k} {h}: {}", error.source));
            let mut planned = own.planned(&Instant::at(0.0)).expect("the plan begins there, too");
            let last = planned.at(&Instant::at(times[20])).expect("the plan follows").q();
            let off = |(a, b): (&f64, &f64)| (a - b).abs();
            let end = expected.iter().last().expect("21 states");
            assert!(last.iter().zip(&end.q).map(off).fold(0.0, f64::max) < 1e-9, "{a} {b} {k} {h}");
            let pairs = swept.iter().zip(expected.iter()).flat_map(|(found, other)| found.q.iter().zip(&other.q));
            assert!(pairs.map(off).fold(0.0, f64::max) < 1e-9, "{a} {b} {k} {h}");
            regular += 1;
        }
        assert!(regular > 1, "{special} {a_is_special}: {regular}");
    }
}

/// The solver with this configuration as its guess.
fn start_at<'m>(solver: Solver<'m, Coupled>, q: &[f64]) -> Solver<'m, Coupled> {
    q.iter().enumerate().fold(solver, |solver, (k, q)| solver.with_guess(k, *q))
}

//! Special dimensions and starts: equal pulleys, a dimension of 0 by which the plan divides, a start beside a dead
//! centre.

use kin_runtime::{Instant, Kinematics, LimitKind, Mechanism, Options, Planned, Signal, SolveError, mechanism};

/// An arm whose platform a belt over equal pulleys keeps parallel, so that the angle of the platform does not depend on
/// that of the arm.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[bodies(platform)]
#[revolute(A: arm @ (0.4, 0), platform @ (0, 0))]
#[belt(level: ground, platform, radii = (r1, r2), carrier = arm)]
#[distance(link: platform @ (0.3, 0), ground @ (0.2, 0.9), length = 0.6 + 0.05 * t)]
#[guess(arm.phi = 1.1)]
struct Parallel {
    #[param(0.03)]
    r1: f64,
    #[param(0.03)]
    r2: f64,
}

/// The plan divides by no difference of dimensions that may be equal.
#[test]
fn equal_pulleys_are_followed_by_every_method() {
    let times: Vec<f64> = (0..=20).map(|k| 0.05 * f64::from(k)).collect();
    for ratio in [1.0, 1.0 + 1e-15, 1.0 - 1e-12, 1.0 + 1e-6, 1.1] {
        let mechanism = Parallel { r1: 0.03, r2: 0.03 * ratio };
        let swept = mechanism.kinematic_analysis(&times).unwrap();
        let newton = Options { use_plan: false, ..Options::default() };
        let by_newton = mechanism.solver().with_options(newton).sweep(&times).unwrap();
        assert!(swept.fallbacks.is_empty(), "{ratio}");
        let mut planned = Planned::new(&mechanism, &Instant::at(0.0), &swept.states[0].q).unwrap();
        for (state, other) in swept.states.iter().zip(&by_newton.states) {
            planned.at(&Instant::at(state.t)).unwrap();
            for k in 0..state.q.len() {
                let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
                assert!(near(state.q[k], other.q[k]) && near(state.q_ddot[k], other.q_ddot[k]), "{ratio}");
                assert!(near(state.q[k], planned.q()[k]) && near(state.q_dot[k], planned.q_dot()[k]), "{ratio}");
            }
            // With equal pulleys the platform does not turn.
            assert!(ratio != 1.0 || state.q[3].abs() < 1e-15, "{}", state.q[3]);
        }
    }
}

/// A dimension of 0 by which the plan divides: full Newton follows the motion.
#[mechanism]
#[coordinates(u, v)]
#[constraint(first: u + k * v + 0.3 * sin(u) = 1 + t)]
#[constraint(second: v + 0.3 * sin(v) + k * u * u = 0.5)]
#[guess(u = 0.8, v = 0.4)]
struct Coupled {
    k: f64,
}

#[test]
fn a_plan_that_divides_by_zero_is_left_to_newton() {
    let times: Vec<f64> = (0..=10).map(|k| 0.05 * f64::from(k)).collect();
    let swept = Coupled { k: 0.0 }.kinematic_analysis(&times).unwrap();
    assert_eq!(11, swept.states.len());
    for state in &swept.states {
        let (u, v) = (state.q[0], state.q[1]);
        assert!((u + 0.3 * u.sin() - 1.0 - state.t).abs() < 1e-12 && (v + 0.3 * v.sin() - 0.5).abs() < 1e-12);
        assert!((state.q_dot[0] * (1.0 + 0.3 * u.cos()) - 1.0).abs() < 1e-12 && state.q_dot[1] == 0.0);
    }
}

/// A slider whose link turns with time, with a pin in an oval slot.
#[mechanism]
#[bodies(link)]
#[body(slider, y = 0, phi = 0)]
#[revolute(A: slider @ (0, 0), link @ (0, 0))]
#[on_curve(oval: ground @ (0, h), link @ (l, 0), implicit(X, Y) = X * X / (p * p) + Y * Y / (q * q) + e * X * Y - 1)]
#[driver(turn: link.phi = start + t)]
struct Oval {
    l: f64,
    h: f64,
    p: f64,
    q: f64,
    e: f64,
    start: f64,
}

/// A group that only slides is told from a crossing by its branch value, as it has no angle. The dead centre is 1.5e-5
/// before the start.
#[test]
fn a_slider_may_start_beside_its_dead_centre() {
    let mechanism = Oval {
        l: 0.37939697113801835,
        h: -0.3935631436652173,
        p: 0.6174901176773493,
        q: 0.306954999802453,
        e: -0.11456760226780922,
        start: 3.37186774655162,
    };
    let start = [0.3798004055369866, 0.0, 3.37186774655162, 0.3798004055369866];
    let state = mechanism.solver().state_from(&Instant::at(0.0), &start).unwrap();
    let planned = Planned::new(&mechanism, &Instant::at(0.0), &start).unwrap();
    assert!((planned.q_dot()[0] - state.q_dot[0]).abs() < 1e-6 * state.q_dot[0] && state.q_dot[0] > 100.0);
    // Backwards it ends there.
    let error = mechanism.solver().sweep_from(&start, &[0.0, -0.01]).unwrap_err();
    let limit = error.source.limit().and_then(|limit| limit.at()).unwrap();
    assert!((limit + 1.50269e-5).abs() < 1e-9, "{limit:?}");
}

/// A linear system of scalars with constant coefficients.
#[mechanism]
#[coordinates(x, y, z)]
#[constraint(first: p * x + q * y = 0.1 + t)]
#[constraint(second: u * x + v * z = 0.2)]
#[constraint(third: w * y + s * z + x = 0.3 * t)]
struct Scalars {
    p: f64,
    q: f64,
    u: f64,
    v: f64,
    w: f64,
    s: f64,
}

/// Scalars of very different units: constant coefficients are small without being nearly singular.
#[test]
fn linear_systems_hold_in_any_units() {
    for y_unit in [1e-12, 1e-9, 1e-3, 1.0, 1e6, 1e12] {
        for z_unit in [1e-9, 1.0, 1e9] {
            let [p, q, u, v, w, s] = [1.0, 0.4 * y_unit, 0.3, -0.7 * z_unit, 0.9 * y_unit, 0.5 * z_unit];
            let scalars = Scalars { p, q, u, v, w, s };
            let mut planned = scalars.solver().planned(&Instant::at(0.0)).expect("it is regular");
            let t = 0.7;
            let found = planned.at(&Instant::at(t)).expect("it is regular").q();
            let [x, y, z] = [found[0], found[1] * y_unit, found[2] * z_unit];
            let rows = [x + 0.4 * y - 0.1 - t, 0.3 * x - 0.7 * z - 0.2, 0.9 * y + 0.5 * z + x - 0.3 * t];
            assert!(rows.iter().all(|row| row.abs() < 1e-14), "{y_unit} {z_unit}: {rows:?}");
        }
    }
    // Two rows that say the same.
    let [p, q, u, v, w, s] = [1.0, 0.5, 0.0, 1.0, 0.5, 0.0];
    assert!(Scalars { p, q, u, v, w, s }.solver().planned(&Instant::at(0.0)).is_err());
}

/// A pin on two links of 1 m, one of which is pinned to a carriage.
#[mechanism]
#[body(a, phi = 0, y = oy)]
#[body(pin, phi = 0)]
#[driver(pull: a.x - ox = 1 + 0.1 * t)]
#[distance(first: a @ (0, 0), pin @ (0, 0), length = 1)]
#[distance(second: ground @ (ox, oy), pin @ (0, 0), length = 1)]
#[guess(pin.x = ox + 0.5, pin.y = oy + 1)]
struct TwoCircles {
    ox: f64,
    oy: f64,
}

/// Two circles are regular wherever they are; near 1000 lengths from the origin five digits are lost.
#[test]
fn two_circles_are_regular_far_from_the_origin() {
    for ox in [0.0, 30.0, -100.0, 1000.0] {
        let circles = TwoCircles { ox, oy: 0.7 * ox };
        let swept = circles.solver().sweep(&[0.0, 2.0, 4.0]).expect("it closes");
        let mut planned = circles.solver().planned(&Instant::at(0.0)).expect("it closes");
        for state in &swept.states {
            planned.at(&Instant::at(state.t)).expect("it closes");
            let half = 0.5 + 0.05 * state.t;
            let right = [ox + half, 0.7 * ox + (1.0 - half * half).sqrt()];
            for q in [&state.q[..], planned.q()] {
                let off = (q[1] - right[0]).abs().max((q[2] - right[1]).abs());
                assert!(off < 1e-9, "{ox}: {off:e}");
            }
        }
    }
}

/// A boom lifted by a cylinder, at a place ox.
#[mechanism]
#[bodies(boom)]
#[revolute(foot: ground @ (ox, 0), boom @ (0, 0))]
#[distance(cylinder: ground @ (ox + 0.5, -0.2), boom @ (1.6, 0.4), length = 1.9 + 0.5 * sin(t))]
#[guess(boom.phi = 0.7)]
struct FarBoom {
    ox: f64,
}

/// The limit of a motion is the same wherever the mechanism is.
#[test]
fn a_limit_far_from_the_origin_is_the_one_at_the_origin() {
    // The cylinder is as long as the distances of its pins from the foot together.
    let longest = 1.6_f64.hypot(0.4) + 0.5_f64.hypot(0.2);
    let limit = ((longest - 1.9) / 0.5).asin();
    for ox in [0.0, 100.0, -1000.0, 1e4] {
        let boom = FarBoom { ox };
        for count in [3_u32, 20] {
            let times: Vec<f64> = (0..=count).map(|k| 2.0 * f64::from(k) / f64::from(count)).collect();
            let reached = times.iter().take_while(|t| **t < limit).count();
            let error = boom.solver().sweep(&times).expect_err("a dead centre");
            let mut planned = boom.solver().planned(&Instant::at(0.0)).expect("it closes");
            let by_plan = times.iter().find_map(|t| planned.at(&Instant::at(*t)).err()).expect("a dead centre");
            assert_eq!(reached, error.trajectory.states.len(), "{ox}");
            for found in [error.source.limit(), by_plan.limit()] {
                let found = found.unwrap_or_else(|| panic!("{ox}: {} {by_plan}", error.source));
                assert_eq!(Some(LimitKind::DeadCentre), found.kind(), "{ox}");
                assert!((found.at().expect("located") - limit).abs() < 1e-9, "{ox}: {found}");
            }
        }
    }
}

/// A pendulum, and a body beside it whose coordinates are finite, but not their sum.
#[mechanism]
#[bodies(rod)]
#[body(far, x = 1.5e308, y = 1.5e308, phi = 0)]
#[revolute(pin: ground @ (0, 0), rod @ (0, 0))]
#[driver(drive: rod.phi = t)]
#[point(tip = rod @ (1, 0))]
struct Distant;

#[test]
fn a_body_may_be_as_far_away_as_numbers_go() {
    let mut tracker = Distant.solver().tracker(&Instant::at(0.0)).expect("its crank turns");
    for t in [0.3, 0.5] {
        let at = Instant::at(t);
        for state in [&Distant.state_at(&at).expect("it closes"), tracker.update(&at).expect("it moves")] {
            let (far, tip) = (state[Distant::far], state[Distant::tip]);
            assert_eq!([1.5e308, 1.5e308, 0.0, 0.0], [far.x, far.y, far.x_dot, far.y_ddot]);
            assert!((tip.a[0] + t.cos()).abs() < 1e-15);
        }
    }
}

/// A pendulum, and a body that is nowhere at t = 1. No joint holds it.
#[mechanism]
#[bodies(rod)]
#[body(shade, x = 1 / (1 - t), y = 0, phi = 0)]
#[revolute(pin: ground @ (0, 0), rod @ (0, 0))]
#[driver(drive: rod.phi = t)]
struct Vanishing;

/// The error names the body; no state with infinite numbers is returned.
#[test]
fn a_body_that_is_nowhere_is_named() {
    let at = Instant::at(1.0);
    let swept = Vanishing.kinematic_analysis(&[0.0, 0.5, 1.0]).unwrap_err().source;
    let mut tracker = Vanishing.solver().tracker(&Instant::at(0.5)).unwrap();
    let tracked = tracker.update(&at).map(|_| ()).unwrap_err();
    for error in [Vanishing.state_at(&at).unwrap_err(), swept, tracked] {
        assert!(matches!(error, SolveError::NonFinite { what: "observables", name: "shade", .. }), "{error}");
    }
}

/// Two short cranks and a long rod between them, in lengths of the rod.
#[mechanism]
#[bodies(crank, rod, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), rod @ (0, 0))]
#[revolute(B: rod @ (1, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (1, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[guess(rod.phi = 0, rocker.phi = 1.57)]
struct ShortCranks {
    a: f64,
    c: f64,
}

/// The angle of the rocker, from 2 X + X² + Y² = 0 with the way (X, Y) from one crank's end to the other's: an equation
/// in which nothing cancels.
fn rocker(cranks: &ShortCranks, t: f64) -> f64 {
    let ShortCranks { a, c } = *cranks;
    (0..30).fold((a * t.cos() / c).acos(), |r, _| {
        let (x, y) = (c * r.cos() - a * t.cos(), c * r.sin() - a * t.sin());
        r - (2.0 * x + x * x + y * y) / (2.0 * c * (y * r.cos() - (1.0 + x) * r.sin()))
    })
}

/// The rows determine the angle of a crank of length c to ε/c; the dyad alone, solved for its rod first, to ε/c².
#[test]
fn short_cranks_keep_the_digits_that_they_have() {
    for c in [1e-2, 1e-3, 1e-4, 3e-5, 1e-5] {
        let cranks = ShortCranks { a: 0.5 * c, c };
        let times: Vec<f64> = (0..=60).map(|k| 0.1 * f64::from(k)).collect();
        let room = 4.0 * f64::EPSILON / c;
        let near = |q: &[f64], t: f64| {
            let off = (q[8] - rocker(&cranks, t)).abs();
            assert!(off <= room, "{off:e} of {room:e} at t = {t}, c = {c:e}");
        };
        let swept = cranks.solver().sweep(&times).unwrap_or_else(|error| panic!("{c:e}: {error}"));
        let mut tracker = cranks.solver().tracker(&Instant::at(0.0)).unwrap_or_else(|error| panic!("{c:e}: {error}"));
        for state in &swept.states {
            let at = Instant::at(state.t);
            let alone = cranks.solver().state_from(&at, &state.q).unwrap_or_else(|error| panic!("{c:e}: {error}"));
            let placed = cranks.solver().position(&at, &state.q).unwrap_or_else(|error| panic!("{c:e}: {error}"));
            let tracked = tracker.update(&at).unwrap_or_else(|error| panic!("{c:e}: {error}"));
            [&state.q, &alone.q, &placed.q, &tracked.q].iter().for_each(|q| near(q, state.t));
        }
    }
}

/// A lever of length r at the end of a cylinder of length about 1.
#[mechanism]
#[bodies(lever)]
#[input(stroke)]
#[revolute(pin: ground @ (0, 0), lever @ (0, 0))]
#[distance(ram: ground @ (1, 0), lever @ (r, 0), length = stroke)]
#[guess(lever.phi = 0.8)]
struct ShortLever {
    r: f64,
}

/// A lever that is much shorter than the distance of its pins is no branch point.
#[test]
fn short_levers_are_followed_by_the_plan() {
    for r in [1e-2, 1e-3, 1e-4, 3e-5] {
        let lever = ShortLever { r };
        for k in 0..100 {
            let phi = 0.2 + 0.027 * f64::from(k);
            let inputs = [Signal::constant((1.0 + r * r - 2.0 * r * phi.cos()).sqrt())];
            let at = Instant { t: 0.0, inputs: &inputs };
            let planned = lever.solver().planned(&at).unwrap_or_else(|error| panic!("{r:e}, {phi}: {error}"));
            let state = lever.state_at(&at).unwrap_or_else(|error| panic!("{r:e}, {phi}: {error}"));
            // An error of ε in the stroke turns the lever by ε/(r sin φ).
            let room = 4.0 * f64::EPSILON / (r * phi.sin());
            for q in [planned.q(), &state.q] {
                assert!((q[2] - phi).abs() <= room, "{:e} of {room:e} at {phi}, r = {r:e}", (q[2] - phi).abs());
            }
        }
    }
}

/// Two parallel lines: the second row is √2 times the first, whose right-hand side is smaller by t/√2.
#[mechanism]
#[coordinates(x, y)]
#[constraint(first: sqrt(2)*x + y = 1)]
#[constraint(second: 2*x + sqrt(2)*y = sqrt(2) + t)]
struct ParallelLines;

/// 2 − √2·√2 is −4e-16, which is no coefficient to divide by: x was −2e6 at t = 1e-9.
#[test]
fn numbers_that_cancel_up_to_rounding_are_no_divisor() {
    assert!(!ParallelLines::model().plan.exists());
    for t in [0.0, 1e-12, 1e-9, 1e-3] {
        let error = ParallelLines.state_at(&Instant::at(t)).expect_err("the lines have no point in common");
        assert!(
            matches!(error, SolveError::NotAssembled { .. } | SolveError::InconsistentVelocity { .. }),
            "{error:?}"
        );
    }
}

/// A vertical line, whose direction is written by functions of right angles, beside a driver across it.
#[mechanism(allow_redundant)]
#[body(block, phi = 0)]
#[point_on_line(line: ground @ (0, 0), block @ (0, 0), axis = (cos(pi/2), sin(5*pi/6 - pi/3)))]
#[driver(drive: block.x = t)]
struct Across;

/// The cosine of a right angle is 0 and not 6e-17, by which the velocity of the block was −2e16.
#[test]
fn the_cosine_of_a_right_angle_is_zero() {
    for t in [0.0, 1e-12, 0.1] {
        assert!(Across.state_at(&Instant::at(t)).is_err(), "{t}");
    }
}

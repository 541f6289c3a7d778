//! The unit of a scalar coordinate changes its numbers alone: motions, limits and digits are the same.

use kin_runtime::{Instant, Kinematics, LimitKind, Mechanism, Planned, mechanism};
use kin_tests::random::Random;

/// A platform on three cylinders by the global method; its coordinates x and y are lengths in any unit.
#[mechanism]
#[coordinates(x, u, y)]
#[constraint(c1: pow(x - y1*sin(u), 2) + pow(y + y1*cos(u), 2) = pow(l1 + v1*t, 2))]
#[constraint(c2: pow(x + x2*cos(u) - w, 2) + pow(y + x2*sin(u), 2) = pow(l2 + v2*t, 2))]
#[constraint(c3: pow(x + x3*cos(u) - y3*sin(u) - w/2, 2) + pow(y + x3*sin(u) + y3*cos(u) - w, 2) = pow(l3 + v3*t, 2))]
#[derive(Clone, Debug)]
struct Platform {
    y1: f64,
    x2: f64,
    x3: f64,
    y3: f64,
    l1: f64,
    l2: f64,
    l3: f64,
    v1: f64,
    v2: f64,
    v3: f64,
    w: f64,
}

/// A platform on two cylinders with a bar at its middle, which two rods hold: four equations that are solved together.
#[mechanism]
#[coordinates(x, u, v, y)]
#[constraint(c1: x*x + y*y = pow(l1 + v1*t, 2))]
#[constraint(c2: pow(x + a*cos(u) - w, 2) + pow(y + a*sin(u), 2) = pow(l2 + v2*t, 2))]
#[constraint(c3: pow(x + a*cos(u)/2 + b*cos(v) - w/2, 2) + pow(y + a*sin(u)/2 + b*sin(v) - w, 2) = l3*l3)]
#[constraint(c4: pow(x + a*cos(u)/2 + b*cos(v)/2 - w, 2) + pow(y + a*sin(u)/2 + b*sin(v)/2 - w, 2) = l4*l4)]
#[derive(Clone, Debug)]
struct PlatformWithBar {
    a: f64,
    b: f64,
    l1: f64,
    l2: f64,
    l3: f64,
    l4: f64,
    v1: f64,
    v2: f64,
    w: f64,
}

/// A crank that an elliptic cam turns backwards: the parameter of the curve is an angle in any unit.
#[mechanism]
#[bodies(cam, rocker)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[revolute(R: ground @ (x0, y0), rocker @ (0, 0))]
#[on_curve(C: cam @ (0, 0), rocker @ (f, 0), parametric(u) = (a*cos(k*u) + e, b*sin(k*u)))]
#[driver(drive: rocker.phi = p + w*t)]
#[derive(Clone, Debug)]
struct Cam {
    a: f64,
    b: f64,
    e: f64,
    x0: f64,
    y0: f64,
    f: f64,
    p: f64,
    w: f64,
    k: f64,
}

/// A five-bar by the global method, whose coordinates are angles in any unit.
#[mechanism]
#[coordinates(u1, u2, v1, v2)]
#[constraint(cx: 0.3*cos(k*u1) + 0.6*cos(k*v1) = 0.5 + 0.35*cos(k*u2) + 0.5*cos(k*v2))]
#[constraint(cy: 0.3*sin(k*u1) + 0.6*sin(k*v1) = 0.35*sin(k*u2) + 0.5*sin(k*v2))]
#[driver(m1: k*u1 = 1 + 0.4*t)]
#[driver(m2: k*u2 = 2 - 0.3*t)]
#[derive(Clone, Debug)]
struct FiveBar {
    k: f64,
}

/// How a motion ends: at a limit, whose kind may not be known, or at the last instant, with q, q̇ and q̈ in the units of the
/// first mechanism.
#[derive(Debug)]
enum End {
    Limit(Option<f64>, Option<LimitKind>),
    Reached(Vec<[f64; 3]>),
}

/// The motion by a sweep and by the plan, with the scalars divided by `units`.
fn ends<M: Kinematics + Clone>(mechanism: &M, start: &[f64], units: &[f64], times: &[f64]) -> [End; 2] {
    let q: Vec<f64> = start.iter().zip(units).map(|(q, unit)| q / unit).collect();
    let reached = |[q, q_dot, q_ddot]: [&[f64]; 3]| {
        End::Reached((0..q.len()).map(|k| [q[k], q_dot[k], q_ddot[k]].map(|x| x * units[k])).collect())
    };
    let kind = |limit: &kin_runtime::Limit| End::Limit(limit.at(), limit.kind());
    let sweep = match mechanism.solver().sweep_from(&q, times) {
        Ok(motion) => {
            let last = motion.states.last().expect("states");
            reached([&last.q, &last.q_dot, &last.q_ddot])
        }
        Err(error) => kind(error.source.limit().unwrap_or_else(|| panic!("{error}"))),
    };
    let mut planned = Planned::new(mechanism, &Instant::at(times[0]), &q).unwrap_or_else(|error| panic!("{error}"));
    let stopped = times.iter().find_map(|t| planned.at(&Instant::at(*t)).err());
    let planned = match stopped {
        None => reached([planned.q(), planned.q_dot(), planned.q_ddot()]),
        Some(error) => kind(error.limit().unwrap_or_else(|| panic!("{error}"))),
    };
    [sweep, planned]
}

/// Asserts that both ends are the same; limits to `at`, relative where t is above 1.
fn same(one: &End, other: &End, at: f64, what: &str) {
    match (one, other) {
        (End::Limit(Some(a), kind), End::Limit(Some(b), other_kind)) => {
            let agree = kind.zip(*other_kind).is_none_or(|(kind, other)| kind == other);
            assert!((a - b).abs() <= at * a.abs().max(1.0) && agree, "{what}: {one:?} and {other:?}");
        }
        (End::Reached(a), End::Reached(b)) => {
            for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
                assert!((a - b).abs() <= 1e-9 * a.abs().max(1.0), "{what}: {one:?} and {other:?}");
            }
        }
        _ => panic!("{what}: {one:?} and {other:?}"),
    }
}

fn grid(to: f64, steps: u32) -> Vec<f64> {
    (0..=steps).map(|k| to * f64::from(k) / f64::from(steps)).collect()
}

#[test]
fn lengths_of_the_global_method_may_have_any_unit() {
    let (pose, points) = ([0.45_f64, 0.35, 0.3], [[0.0, 0.1], [0.3, 0.0], [0.1, 0.25]]);
    let ground = [[0.0_f64, 0.0], [1.0, 0.0], [0.5, 1.0]];
    let (s, c) = pose[2].sin_cos();
    let [l1, l2, l3] = [0, 1, 2].map(|k: usize| {
        let [x, y] = points[k];
        f64::hypot(pose[0] + c * x - s * y - ground[k][0], pose[1] + s * x + c * y - ground[k][1])
    });
    let one = Platform { y1: 0.1, x2: 0.3, x3: 0.1, y3: 0.25, l1, l2, l3, v1: 0.1, v2: -0.06, v3: 0.08, w: 1.0 };
    let times = grid(10.0, 100);
    let start = [pose[0], pose[2], pose[1]];
    let expected = ends(&one, &start, &[1.0; 3], &times);
    assert!(matches!(&expected[0], End::Limit(Some(t), _) if (t - 4.475_670_461_046_9).abs() < 1e-9), "{expected:?}");
    for size in [1e-4, 1e-3, 0.1, 10.0, 1e3, 1e4, 1e5] {
        let mut scaled = one.clone();
        for index in 0..11 {
            assert!(scaled.set_parameter(index, one.parameters::<f64>()[index] * size));
        }
        let found = ends(&scaled, &start, &[1.0 / size, 1.0, 1.0 / size], &times);
        found.iter().zip(&expected).for_each(|(found, expected)| same(expected, found, 1e-9, &format!("{size:e}")));
    }
}

#[test]
fn larger_groups_may_have_any_unit_of_length() {
    let ([x, y], [u, v], [a, b]) = ([0.3_f64, 0.35], [0.3_f64, 1.2], [0.4, 0.3]);
    let middle = [x + 0.5 * a * u.cos(), y + 0.5 * a * u.sin()];
    let along = |share: f64| [middle[0] + share * b * v.cos(), middle[1] + share * b * v.sin()];
    let apart = |p: [f64; 2], q: [f64; 2]| f64::hypot(p[0] - q[0], p[1] - q[1]);
    let [l1, l2] = [x.hypot(y), apart([x + a * u.cos(), y + a * u.sin()], [1.0, 0.0])];
    let [l3, l4] = [apart(along(1.0), [0.5, 1.0]), apart(along(0.5), [1.0, 1.0])];
    let mut limits = 0;
    for speeds in [[0.05, 0.03], [-0.04, 0.05], [0.06, -0.05], [-0.05, -0.04]] {
        let one = PlatformWithBar { a, b, l1, l2, l3, l4, v1: speeds[0], v2: speeds[1], w: 1.0 };
        let (start, times) = ([x, u, v, y], grid(8.0, 80));
        let expected = ends(&one, &start, &[1.0; 4], &times);
        limits += usize::from(matches!(expected[0], End::Limit(..)));
        for size in [1e-3, 10.0, 1e3, 1e4] {
            let mut scaled = one.clone();
            for index in 0..9 {
                assert!(scaled.set_parameter(index, one.parameters::<f64>()[index] * size));
            }
            let found = ends(&scaled, &start, &[1.0 / size, 1.0, 1.0, 1.0 / size], &times);
            let what = format!("{speeds:?}, {size:e}");
            found.iter().zip(&expected).for_each(|(found, expected)| same(expected, found, 1e-8, &what));
        }
    }
    assert!(limits > 0, "some motions end at a limit");
}

#[test]
fn the_parameter_of_a_curve_may_have_any_unit() {
    let mut random = Random::new(7);
    let mut between = |low: f64, high: f64| random.between(low, high);
    let mut limits = 0;
    for case in 0..60 {
        let [a, b, e] = [between(0.35, 0.5), between(0.2, 0.3), between(-0.1, 0.1)];
        let [cam, u, p, f] = [between(-3.0, 3.0), between(-3.0, 3.0), between(-3.0, 3.0), between(0.3, 1.0)];
        let (r, [s, c]) = ([a * u.cos() + e, b * u.sin()], [cam.sin(), cam.cos()]);
        let [x0, y0] = [c * r[0] - s * r[1] - f * p.cos(), s * r[0] + c * r[1] - f * p.sin()];
        let of = |k: f64| Cam { a, b, e, x0, y0, f, p, w: 0.4, k };
        let (start, times) = ([0.0, 0.0, cam, x0, y0, p, u], grid(3.0, 37));
        let expected = ends(&of(1.0), &start, &[1.0; 7], &times);
        limits += usize::from(matches!(expected[0], End::Limit(..)));
        for k in [core::f64::consts::PI / 180.0, 1e-3, 1e3, 1e5] {
            let found = ends(&of(k), &start, &[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, k], &times);
            let what = format!("case {case}, {:?}", of(k));
            found.iter().zip(&expected).for_each(|(found, expected)| same(expected, found, 2e-8, &what));
        }
    }
    assert!(limits > 20, "{limits} limits");
}

#[test]
fn small_scalars_have_as_many_digits() {
    let (start, times) = ([1.0, 2.0, 0.7, 1.7], grid(3.0, 12));
    let first = FiveBar { k: 1.0 }.solver().state_from(&Instant::at(0.0), &start).expect("it closes").q;
    // Every instant is the last one of a motion.
    for (count, k) in (2..=times.len()).flat_map(|count| [1e-3, 1e2, 1e3, 1e4, 1e5, 1e6].map(|k| (count, k))) {
        let expected = ends(&FiveBar { k: 1.0 }, &first, &[1.0; 4], &times[..count]);
        let found = ends(&FiveBar { k }, &first, &[k; 4], &times[..count]);
        for (found, expected) in found.iter().zip(&expected) {
            let (End::Reached(found), End::Reached(expected)) = (found, expected) else { panic!("{k:e}: {found:?}") };
            for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                assert!((found - expected).abs() <= 1e-11, "{k:e}: {found:e} for {expected:e}");
            }
        }
    }
}

/// An arm whose roller rolls on a cam with three lobes; all lengths are multiplied by `size`.
#[mechanism]
#[bodies(cam, arm)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[revolute(P: ground @ (2.786 * size, 0), arm @ (0, 0))]
#[on_curve(K: cam @ (0, 0), arm @ (2.993 * size, 0), roller = -0.4966 * size, parametric(u) = (
    0.8672 * size * (1 + 0.191 * cos(3 * u)) * cos(u), 0.8672 * size * (1 + 0.191 * cos(3 * u)) * sin(u)))]
#[driver(turn: cam.phi = 0.3 + (t - t0))]
#[guess(arm.phi = 2.7, u = 1)]
struct ThreeLobes {
    size: f64,
    t0: f64,
}

#[test]
fn a_roller_may_have_any_unit_of_length_and_of_time() {
    for (size, t0) in [(1.0, 0.0), (1e-3, 10.0), (1e3, 10.0), (1e3, 1e3), (1e5, 0.0), (1e9, 0.0)] {
        let (cam, times) = (ThreeLobes { size, t0 }, grid(7.0, 14).iter().map(|t| t + t0).collect::<Vec<_>>());
        let motion = cam.kinematic_analysis(&times).unwrap_or_else(|error| panic!("{size:e}, {t0}: {error}"));
        assert!(motion.fallbacks.is_empty(), "{size:e}, {t0}: {}", motion.fallbacks.len());
        let mut planned = cam.solver().planned(&Instant::at(t0)).expect("it closes");
        for (t, state) in times.iter().zip(&motion.states) {
            planned.at(&Instant::at(*t)).unwrap_or_else(|error| panic!("{size:e}, {t}: {error}"));
            assert!((planned.q()[5] - state.q[5]).abs() < 1e-12, "{size:e}, {t}");
        }
    }
}

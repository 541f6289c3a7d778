//! The ranges in which mechanisms close, compared with known ones.

use kin_runtime::planned::LimitKind;
use kin_runtime::{Instant, Kinematics, Ranges, Signal, SolveError, Uncertified, mechanism};
use std::f64::consts::{PI, TAU};

/// A four-bar on the x axis.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(C: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct FourBar {
    #[param(0.3)]
    a: f64,
    #[param(0.25)]
    b: f64,
    #[param(0.2)]
    c: f64,
    #[param(0.5)]
    d: f64,
}

impl FourBar {
    /// The crank angles in [0, π] at which coupler and rocker are in line, from the cosine theorem: stretched or folded.
    fn dead_centres(&self) -> Vec<f64> {
        let Self { a, b, c, d } = *self;
        let cosine = |r: f64| (a * a + d * d - r * r) / (2.0 * a * d);
        let angles = [b + c, b - c].into_iter().map(cosine).filter(|cosine| cosine.abs() < 1.0).map(f64::acos);
        let mut angles: Vec<f64> = angles.collect();
        angles.sort_by(f64::total_cmp);
        angles
    }

    fn ranges(&self, from: f64, to: f64) -> Ranges {
        self.solver().ranges(&Instant::at(from), to).unwrap()
    }
}

/// Deterministic numbers in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Over a full turn, which begins between limits: as many dead centres as the cosine theorem says, each where it says, and
/// none for a crank that turns by Grashof's rule.
#[test]
fn dead_centres_of_random_four_bars_are_those_of_the_cosine_theorem() {
    let count = if cfg!(debug_assertions) { 12 } else { 10_000 };
    let mut draw = Draw(7);
    let (mut turning, mut rocking) = (0, 0);
    for _ in 0..count {
        let [a, b, c, d] = [(); 4].map(|()| 0.2 + draw.unit());
        let bar = FourBar { a, b, c, d };
        let expected = bar.dead_centres();
        let mut sides = [a, b, c, d];
        sides.sort_by(f64::total_cmp);
        let longest_reaches = sides[3] < sides[0] + sides[1] + sides[2];
        // Too near to a change point, or to a limit at 0 or π.
        let margin = sides[0] + sides[3] - sides[1] - sides[2];
        let near = |x: f64| expected.iter().any(|phi| (phi - x).abs() < 1e-3);
        if margin.abs() < 1e-3 || near(0.0) || near(PI) {
            continue;
        }
        let all = bar.ranges(-1e-4, TAU - 1e-4);
        assert!(all.is_complete(), "{a} {b} {c} {d}: {all}");
        // Grashof: the crank turns where it, or the ground, is the shortest link.
        let turns = margin < 0.0 && (sides[0] == a || sides[0] == d);
        if longest_reaches {
            assert_eq!(turns, expected.is_empty() && !all.ranges.is_empty(), "{a} {b} {c} {d}");
        }
        // Above and below the axis, in each of two modes.
        assert_eq!(all.limits.len(), 4 * expected.len(), "{a} {b} {c} {d}: {all}");
        for limit in &all.limits {
            let phi = limit.t.midpoint();
            let folded = if phi > PI { TAU - phi } else { phi };
            assert!(expected.iter().any(|x| (x - folded).abs() < 1e-9), "{phi} {expected:?}");
            assert_eq!(
                (limit.kind, limit.joints.as_slice()),
                (Some(LimitKind::DeadCentre), ["A", "B", "C"].as_slice())
            );
            assert_eq!(limit.drivers[0].0, "drive");
            // Where the motion towards the limit found it, the pins are in line there.
            if let [.., x, y, _] = limit.q.as_slice() {
                let place = [a * phi.cos(), a * phi.sin()];
                let pin = [limit.q[3] + b * limit.q[5].cos(), limit.q[4] + b * limit.q[5].sin()];
                let across = (pin[0] - place[0]) * (y - place[1]) - (pin[1] - place[1]) * (x - place[0]);
                assert!(across.abs() < 1e-8, "{across}");
            }
        }
        let circuits: usize = if expected.is_empty() { all.ranges.len() } else { all.circuits };
        assert!(circuits <= all.ranges.len(), "{all}");
        if turns { turning += 1 } else { rocking += 1 }
    }
    assert!(turning >= count / 10 && rocking > count / 10, "{turning} {rocking}");
}

#[test]
fn ranges_that_meet_at_a_dead_centre_are_one_circuit() {
    // The crank rocks between two dead centres; both modes are one motion there and back.
    let bar = FourBar::default();
    let end = bar.dead_centres()[0];
    let all = bar.ranges(-PI, PI);
    assert!(all.is_complete());
    let within = |x: f64, y: f64| (x - y).abs() < 1e-9;
    assert_eq!((all.ranges.len(), all.circuits), (2, 1), "{all}");
    assert!(all.ranges.iter().all(|range| within(range.from, -end) && within(range.to, end)), "{all}");
    assert!(all.limits.iter().all(|limit| limit.proven && limit.q.len() == 9), "{all}");

    // A crank that turns: two circuits, which no motion connects.
    let turning = FourBar { a: 0.1, b: 0.4, c: 0.3, d: 0.4 };
    let all = turning.ranges(0.0, TAU);
    assert!(all.is_complete() && all.limits.is_empty());
    assert_eq!((all.ranges.len(), all.circuits), (2, 2), "{all}");
    assert!(all.ranges.iter().all(|range| range.from == 0.0 && range.to == TAU), "{all}");

    // A parallelogram crosses its other branch where it is flat: nothing proves that it goes on there.
    let flat = FourBar { a: 0.2, b: 0.5, c: 0.2, d: 0.5 };
    let all = flat.ranges(-1.0, 1.0);
    assert!(!all.is_complete(), "{all}");
    assert!(all.limits.iter().all(|limit| limit.t.contains(0.0) && limit.t.radius() < 1e-4 && !limit.proven), "{all}");
}

/// A crank without a driver, whose angle is given.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
struct Undriven;

#[test]
fn what_has_no_ranges_says_why() {
    let refused = |error: SolveError| match error {
        SolveError::NotCertified { why, .. } => why,
        error => panic!("{error}"),
    };
    let given = Undriven.solver().with_given(2, Signal::new(0.3, 1.0, 0.0));
    let why = refused(given.ranges(&Instant::at(0.0), 1.0).unwrap_err());
    assert_eq!(why, Uncertified::Prescribed);
}

/// How many closures there are at a time, as the ranges say.
pub(crate) fn closures(all: &Ranges, t: f64) -> usize {
    all.ranges.iter().filter(|range| range.from <= t && t <= range.to).count()
}

/// Compares the ranges with the number of closures that is counted at many times, beside limits left out.
pub(crate) fn agrees(all: &Ranges, [from, to]: [f64; 2], count: impl Fn(f64) -> usize) {
    assert!(all.is_complete(), "{all}");
    let steps = if cfg!(debug_assertions) { 500 } else { 20_000 };
    let (mut seen, mut before) = (Vec::new(), None);
    for k in 0..=steps {
        let t = from + (to - from) * f64::from(k) / f64::from(steps);
        if all.limits.iter().any(|limit| (limit.t.midpoint() - t).abs() < 1e-8) {
            continue;
        }
        let found = count(t);
        assert_eq!(closures(all, t), found, "t = {t}: {all}");
        // What changes between two times has a limit between them.
        if let Some((last, other)) = before.replace((t, found))
            && other != found
        {
            assert!(all.limits.iter().any(|limit| limit.t.upper() >= last && limit.t.lower() <= t), "{t}: {all}");
        }
        if !seen.contains(&found) {
            seen.push(found);
        }
    }
    assert!(seen.len() > 1, "nothing changes: {seen:?}");
}

/// The places of a pin at distances from two others: none, or two.
pub(crate) fn pins(p: [f64; 2], r: f64, q: [f64; 2], s: f64) -> Vec<[f64; 2]> {
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let square = dx * dx + dy * dy;
    let along = (square + r * r - s * s) / (2.0 * square);
    let across = r * r / square - along * along;
    let pin = |h: f64| [p[0] + along * dx - h * dy, p[1] + along * dy + h * dx];
    if across < 0.0 { Vec::new() } else { vec![pin(across.sqrt()), pin(-across.sqrt())] }
}

/// A point of a link from p to q, at (along, across) of its own frame.
pub(crate) fn carried(p: [f64; 2], q: [f64; 2], at: [f64; 2]) -> [f64; 2] {
    let length = (q[0] - p[0]).hypot(q[1] - p[1]);
    let (cos, sin) = ((q[0] - p[0]) / length, (q[1] - p[1]) / length);
    [p[0] + at[0] * cos - at[1] * sin, p[1] + at[0] * sin + at[1] * cos]
}

/// Watt's six-bar: the second dyad hangs on the rocker.
#[mechanism]
#[bodies(crank, coupler, rocker, rod, lever)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(C: ground @ (0.4, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (0.25, 0.05), rod @ (0, 0))]
#[revolute(E: rod @ (0.3, 0), lever @ (0.2, 0))]
#[revolute(F: ground @ (0.8, 0.1), lever @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct Watt;

/// Stephenson's six-bar: the second dyad hangs on the coupler.
#[mechanism]
#[bodies(crank, coupler, rocker, rod, lever)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(C: ground @ (0.4, 0), rocker @ (0, 0))]
#[revolute(D: coupler @ (0.25, 0.15), rod @ (0, 0))]
#[revolute(E: rod @ (0.3, 0), lever @ (0.2, 0))]
#[revolute(F: ground @ (0.5, 0.5), lever @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct Stephenson;

#[test]
fn six_bars_close_where_circles_meet() {
    let (from, to) = (0.123, 0.123 + TAU);
    let first = |t: f64| {
        let a = [0.2 * t.cos(), 0.2 * t.sin()];
        (a, pins(a, 0.4, [0.4, 0.0], 0.3))
    };
    agrees(&Watt.solver().ranges(&Instant::at(from), to).unwrap(), [from, to], |t| {
        let joint = |b: &[f64; 2]| pins(carried([0.4, 0.0], *b, [0.25, 0.05]), 0.3, [0.8, 0.1], 0.2).len();
        first(t).1.iter().map(joint).sum()
    });
    agrees(&Stephenson.solver().ranges(&Instant::at(from), to).unwrap(), [from, to], |t| {
        let (a, b) = first(t);
        b.iter().map(|b| pins(carried(a, *b, [0.25, 0.15]), 0.3, [0.5, 0.5], 0.2).len()).sum()
    });
}

/// A 3-RRR robot whose platform goes along a line and turns on its way: each leg is a dyad of its own.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (0.5*cos(2*pi*i/3 - 5*pi/6), 0.5*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (0.3, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (0.28, 0), platform @ (0.12*cos(2*pi*i/3 - 5*pi/6), 0.12*sin(2*pi*i/3 - 5*pi/6)))]
#[driver(x: platform.x = t)]
#[driver(y: platform.y = 0.1)]
#[driver(turn: platform.phi = 2 * t)]
struct Robot;

#[test]
fn a_3rrr_robot_closes_as_long_as_all_of_its_legs_reach() {
    let (from, to) = (-0.61, 0.63);
    agrees(&Robot.solver().ranges(&Instant::at(from), to).unwrap(), [from, to], |t| {
        let leg = |i: usize| {
            let direction = TAU * i as f64 / 3.0 - 5.0 * PI / 6.0;
            let motor = [0.5 * direction.cos(), 0.5 * direction.sin()];
            let wrist = [t + 0.12 * (direction + 2.0 * t).cos(), 0.1 + 0.12 * (direction + 2.0 * t).sin()];
            pins(motor, 0.3, wrist, 0.28).len()
        };
        (0..3).map(leg).product()
    });
}

/// A boom on a cylinder between 0.5 and 1.5.
#[mechanism]
#[bodies(boom)]
#[input(length, default = 1)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[driver(lift: distance(ground @ (0, -0.5), boom @ (1, 0)) = length)]
#[guess(boom.phi = 0.3)]
struct Boom;

#[test]
fn inputs_go_on_with_constant_acceleration() {
    let inputs = [Signal::new(1.0, 0.1, 0.02)];
    let all = Boom.solver().ranges(&Instant { t: 2.0, inputs: &inputs }, 12.0).unwrap();
    // 0.1 dt + 0.01 dt² = 0.5.
    let end = 2.0 + (0.03_f64.sqrt() - 0.1) / 0.02;
    assert!(all.is_complete() && all.ranges.len() == 2 && all.limits.len() == 2, "{all}");
    assert!(all.ranges.iter().all(|range| range.from == 2.0 && (range.to - end).abs() < 1e-8), "{all}");
    assert!(all.limits.iter().all(|limit| limit.t.contains(end) && limit.kind == Some(LimitKind::DeadCentre)), "{all}");
    let course = |t: f64, u: &mut [Signal]| u[0] = inputs[0].after(t - 2.0);
    let ended = Boom.solver().with_inputs(&course).sweep(&[2.0, 12.0]).unwrap_err();
    assert!(ended.source.limit().and_then(|limit| limit.at()).is_some_and(|t| (t - end).abs() < 1e-8), "{ended}");
}

/// Three cranks of equal length under one platform: a row is redundant as long as the third is as long as the others.
#[mechanism(allow_redundant)]
#[bodies(left, middle, right, platform)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: ground @ (0.5, 0), middle @ (0, 0))]
#[revolute(C: ground @ (1, 0), right @ (0, 0))]
#[revolute(D: left @ (0.3, 0), platform @ (0, 0))]
#[revolute(E: middle @ (third, 0), platform @ (0.5, 0))]
#[revolute(F: right @ (0.3, 0), platform @ (1, 0))]
#[driver(drive: left.phi = 1 + t)]
#[guess(middle.phi = 1, right.phi = 1)]
struct Cranks {
    #[param(0.3)]
    third: f64,
}

#[test]
fn redundant_rows_are_not_passed_over() {
    let refused = |third| match (Cranks { third }).solver().ranges(&Instant::at(0.0), 1.0) {
        Err(SolveError::NotCertified { why, .. }) => why,
        other => panic!("{other:?}"),
    };
    assert!(matches!(refused(0.3), Uncertified::Redundant { row: "E.x" | "E.y" | "F.x" | "F.y" }), "{}", refused(0.3));
    assert!(matches!(refused(0.31), Uncertified::Redundant { .. }));
    // The antiparallelogram violates the third crank, which is proven; so does every mode of other lengths.
    let all = Cranks { third: 0.3 }.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.undecided.is_empty() && all.found.len() == 1, "{all:?}");
    assert!((all.found[0].q[2] - 1.0).abs() < 1e-9 && (all.found[0].q[5] - 1.0).abs() < 1e-9, "{all:?}");
    let none = Cranks { third: 0.31 }.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(none.is_complete() && none.found.is_empty(), "{none:?}");
}

/// A carriage, held by two dyads: the first closes up to t = 2, the second from 0.1 to 0.9.
#[mechanism]
#[body(carriage, x = t, y = 0, phi = 0)]
#[bodies(a, b, c, d)]
#[revolute(A: ground @ (0, 0), a @ (0, 0))]
#[revolute(B: a @ (1, 0), b @ (0, 0))]
#[revolute(C: b @ (1, 0), carriage @ (0, 0))]
#[revolute(D: ground @ (0, 0), c @ (0, 0))]
#[revolute(E: c @ (0.5, 0), d @ (0, 0))]
#[revolute(F: d @ (0.4, 0), carriage @ (0, 0))]
struct Both;

/// Where a group comes to its limit while another closes on neither side, no motion ends.
#[test]
fn limits_where_nothing_closes_are_none() {
    for (from, to) in [(0.5, 3.0), (3.0, 0.5), (0.01, 2.5)] {
        let all = Both.solver().ranges(&Instant::at(from), to).unwrap();
        assert!(all.is_complete(), "{all}");
        let ends = if from == 0.01 { &[0.1, 0.9][..] } else { &[0.9] };
        let is_end = |limit: &kin_runtime::RangeLimit| ends.iter().any(|end| limit.t.contains(*end));
        // Two modes of each group, and one limit of the second group for each.
        assert_eq!((4, 4 * ends.len()), (all.ranges.len(), all.limits.len()), "{all}");
        assert!(all.limits.iter().all(|limit| is_end(limit) && limit.joints == ["D", "E", "F"]), "{all}");
    }
}

//! The ranges in which mechanisms with groups without a closed form close, compared with eliminations and with curves
//! in closed form.

use super::assemblies::Forward;
use super::ranges::{carried, closures, pins};
use kin_runtime::function::Polynomial;
use kin_runtime::planned::LimitKind;
use kin_runtime::{Instant, Kinematics, Ranges, SolveError, Uncertified, mechanism};
use std::f64::consts::{PI, TAU};

/// How many times are looked at.
const TIMES: u32 = if cfg!(debug_assertions) { 25 } else { 400 };

/// Compares the number of closures with a count at many times, beside limits left out.
fn agrees(all: &Ranges, [from, to]: [f64; 2], count: impl Fn(f64) -> usize) {
    assert!(all.is_complete(), "{all}");
    let mut seen = Vec::new();
    for k in 0..TIMES {
        let t = from + (to - from) * (f64::from(k) + 0.3) / f64::from(TIMES);
        if all.limits.iter().all(|limit| (limit.t.midpoint() - t).abs() > 1e-4) {
            seen.push(count(t));
            assert_eq!(closures(all, t), seen[seen.len() - 1], "t = {t}: {all}");
        }
    }
    assert!(seen.iter().any(|count| *count != seen[0]), "nothing changes: {seen:?}");
}

/// At a dead centre two closures meet, so that both of its ranges end there with the same configuration, on the same side.
fn ends_meet(all: &Ranges) {
    assert!(!all.limits.is_empty() && all.limits.len().is_multiple_of(2), "{all}");
    for limit in &all.limits {
        let (t, q) = (limit.t.midpoint(), &limit.q);
        assert!(limit.proven && limit.kind == Some(LimitKind::DeadCentre) && limit.t.radius() < 1e-9, "{limit}");
        assert!(all.limits.iter().filter(|other| other.q == *q).count() == 2, "{limit}: {all}");
        let ends = |end: f64| (end - t).abs() < 1e-9;
        let counts = [true, false]
            .map(|first| all.ranges.iter().filter(|range| ends(if first { range.from } else { range.to })).count());
        assert!(counts == [2, 0] || counts == [0, 2], "{counts:?}: {limit}: {all}");
    }
}

/// A 3-RRR robot, one crank of which turns all the way: its dead centres are those at which the elimination finds more or
/// fewer solutions.
#[test]
fn a_3rrr_robot_has_as_many_closures_as_the_elimination_says() {
    let robot = Forward::default();
    let (from, to) = (0.0, TAU);
    let all = robot.solver().ranges(&Instant::at(from), to).unwrap();
    agrees(&all, [from, to], |t| {
        let [a, b, c] = robot.angle;
        Forward { angle: [a + t, b, c], ..Forward::default() }.platform_angles().len()
    });
    ends_meet(&all);
    // In the middle of every range is a closure, and no two ranges that overlap have the same.
    for range in &all.ranges {
        let state = robot.solver().state_from(&Instant::at(0.5 * (range.from + range.to)), &range.q).unwrap();
        let moved = state.q.iter().zip(&range.q).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(moved < 1e-9, "{moved} {range}");
        assert_eq!(all.ranges.iter().filter(|other| other.q == range.q).count(), 1, "{range}");
    }
}

#[test]
fn random_3rrr_robots_have_as_many_closures_as_the_elimination_says() {
    let count = if cfg!(debug_assertions) { 0 } else { 20 };
    let mut seed = 11_u64;
    let mut unit = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    for _ in 0..count {
        let angle = [(); 3].map(|()| TAU * unit());
        let (size, l) = (0.15 + 0.2 * unit(), 0.25 + 0.2 * unit());
        let robot = Forward { angle, size, l, base: 0.5 };
        let all = robot.solver().ranges(&Instant::at(0.0), 2.0).unwrap();
        assert!(all.is_complete(), "{angle:?} {size} {l}: {all}");
        for k in 0..40 {
            let t = 2.0 * (f64::from(k) + 0.3) / 40.0;
            if all.limits.iter().any(|limit| (limit.t.midpoint() - t).abs() < 1e-4) {
                continue;
            }
            let there = Forward { angle: [angle[0] + t, angle[1], angle[2]], size, l, base: 0.5 };
            assert_eq!(closures(&all, t), there.platform_angles().len(), "{angle:?} {size} {l} at {t}: {all}");
        }
    }
}

/// Stephenson's six-bar, driven by the lever of its second loop: crank, coupler, rocker and rod are one group.
#[mechanism]
#[bodies(crank, coupler, rocker, rod, lever)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(C: ground @ (0.4, 0), rocker @ (0, 0))]
#[revolute(D: coupler @ (0.25, 0.15), rod @ (0, 0))]
#[revolute(E: rod @ (0.3, 0), lever @ (0.2, 0))]
#[revolute(F: ground @ (0.5, 0.5), lever @ (0, 0))]
#[driver(drive: lever.phi = t)]
struct ByLever;

/// Driven by the crank, the same six-bar has closed forms: the lever's angle is a curve over the crank's, in each of four
/// modes. It closes as often as these curves pass the angle asked for.
#[test]
fn a_six_bar_driven_by_its_lever_closes_as_often_as_the_curves_of_the_lever_say() {
    let steps = 40_000;
    let lever = |s: f64, mode: usize| -> Option<f64> {
        let a = [0.2 * s.cos(), 0.2 * s.sin()];
        let b = *pins(a, 0.4, [0.4, 0.0], 0.3).get(mode % 2)?;
        let e = *pins(carried(a, b, [0.25, 0.15]), 0.3, [0.5, 0.5], 0.2).get(mode / 2)?;
        Some((e[1] - 0.5).atan2(e[0] - 0.5))
    };
    let curves: Vec<Vec<Option<f64>>> =
        (0..4).map(|mode| (0..=steps).map(|k| lever(TAU * f64::from(k) / f64::from(steps), mode)).collect()).collect();
    let (from, to) = (0.1, 0.1 + TAU);
    let all = ByLever.solver().ranges(&Instant::at(from), to).unwrap();
    // The pieces of the curves; where the rod cannot reach any further, those of its two modes are connected.
    let mut pieces: Vec<[f64; 2]> = Vec::new();
    for curve in &curves {
        pieces.extend(curve.windows(2).filter_map(|pair| Some([pair[0]?, pair[1]?])));
    }
    for pair in [[0, 2], [1, 3]] {
        let [a, b] = pair.map(|mode| &curves[mode]);
        let is_end = |k: &usize| {
            let beside = [k.wrapping_sub(1), k + 1].map(|k| a.get(k).is_some_and(Option::is_none));
            beside.contains(&true)
        };
        pieces.extend((0..a.len()).filter(is_end).filter_map(|k| Some([a[k]?, b[k]?])));
    }
    let turned = |x: f64| x - (x / TAU).round() * TAU;
    agrees(&all, [from, to], |t| {
        let passes = |[x, y]: &&[f64; 2]| {
            let (x, y) = (turned(x - t), turned(y - t));
            x * y < 0.0 && (x - y).abs() < PI
        };
        pieces.iter().filter(passes).count()
    });
    ends_meet(&all);
    assert!(all.limits.iter().all(|limit| limit.drivers.iter().all(|&(name, _)| name == "drive")), "{all}");
}

/// A platform on three legs that is a parallelogram in every direction: cranks that turn alike leave it parallel to itself,
/// and every t is singular for one of its closures.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[input(lift)]
#[revolute(motor[i in 0..3]: ground @ (0.5*cos(2*pi*i/3), 0.5*sin(2*pi*i/3)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (0.3, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (0.3, 0), platform @ (0.5*cos(2*pi*i/3), 0.5*sin(2*pi*i/3)))]
#[driver(turn[i in 0..3]: crank[i].phi = lift)]
struct Alike;

/// Where singular places are not isolated, nothing is claimed.
#[test]
fn what_is_singular_all_the_way_is_not_proven() {
    let inputs = [kin_runtime::Signal::new(0.4, 1.0, 0.0)];
    let all = Alike.solver().ranges(&Instant { t: 0.0, inputs: &inputs }, 0.1).unwrap();
    assert!(!all.is_complete(), "{all}");
}

/// Two cranks that turn in a ratio of about −2: an angle of theirs does not come round after a turn.
#[mechanism]
#[bodies(p, q, r, s)]
#[revolute(O: ground @ (0, 0), p @ (0, 0))]
#[revolute(Q: ground @ (0.6, 0), q @ (0, 0))]
#[revolute(A: p @ (0.25, 0), r @ (0, 0))]
#[revolute(B: q @ (0.1, 0), s @ (0, 0))]
#[revolute(C: r @ (0.4, 0), s @ (0.4, 0))]
#[constraint(ratio: p.phi + 2*q.phi + 0.05*sin(r.phi) = 0.3)]
#[driver(drive: p.phi + 0.01*sin(s.phi) = t)]
#[guess(r.phi = 0.8, s.phi = 2)]
struct Geared;

#[test]
fn bounds_of_the_search_are_told() {
    let all = Geared.solver().ranges(&Instant::at(0.0), 9.0).unwrap();
    let names: Vec<&str> = all.searched.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["p.phi", "q.phi"], "{all}");
    assert!(all.searched.iter().all(|(_, within)| within.contains(0.0) && within.radius() < 3.2), "{all}");
    assert!(all.is_complete() && all.ranges.len() == 2 && all.circuits == 1, "{all}");
    // All angles of three legs come round.
    assert!(Forward::default().solver().ranges(&Instant::at(0.0), 0.1).unwrap().searched.is_empty());
}

/// The same cranks, followed until the angle leaves what is searched: what happens there is not claimed.
#[test]
fn a_closure_that_leaves_the_search_is_not_proven() {
    let turned = Geared.solver().with_guess(2, -2.4).with_guess(5, 1.2);
    let all = turned.ranges(&Instant::at(-4.0), 1.0).unwrap();
    let (_, within) = all.searched[0];
    assert!(within.upper() < 0.8 && !all.is_complete(), "{within:?} {all}");
    let all = turned.ranges(&Instant::at(-4.0), 0.5).unwrap();
    assert!(all.is_complete(), "{all}");
}

/// A crank of a group that closes by iteration turns as a supplied function says.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (0.5*cos(2*pi*i/3 - 5*pi/6), 0.5*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (0.3, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (0.3, 0), platform @ (0.25*cos(2*pi*i/3 - 5*pi/6), 0.25*sin(2*pi*i/3 - 5*pi/6)))]
#[driver(a: crank[0].phi = course(1 + t))]
#[driver(b: crank[1].phi = 3.1)]
#[driver(c: crank[2].phi = -1.2)]
#[function(course)]
struct Supplied {
    course: Polynomial<[f64; 3]>,
}

#[test]
fn a_supplied_function_has_no_enclosure_along_t() {
    let supplied = Supplied { course: Polynomial([0.0, 1.0, 0.1]) };
    match supplied.solver().ranges(&Instant::at(0.0), 1.0) {
        Err(SolveError::NotCertified { why: Uncertified::Unbounded { row }, .. }) => assert_eq!(row, "a"),
        other => panic!("{other:?}"),
    }
}

/// Two angles, each of which solves sin φ + 0.4 cos 2φ = t, the other by a t that is a little larger: both have dead centres at
/// nearly the same time, with different directions in which closures come together.
#[mechanism]
#[bodies(a, b)]
#[revolute(A: ground @ (0, 0), a @ (0, 0))]
#[revolute(B: ground @ (1, 0), b @ (0, 0))]
#[constraint(first: sin(a.phi) + 0.4*cos(2*a.phi) = t)]
#[constraint(second: sin(b.phi) + 0.4*cos(2*b.phi) = faster*t)]
struct Twins {
    #[param(1.0005)]
    faster: f64,
}

/// The curve turns back where cos φ (1 − 1.6 sin φ) = 0: at −1.4 and 0.6 once, at 0.7125 twice at the same time.
#[test]
fn dead_centres_close_to_one_another_are_told_apart() {
    let count = |t: f64| {
        let steps = 100_000;
        let miss = |k: u32| {
            let phi = -PI + TAU * f64::from(k) / f64::from(steps);
            phi.sin() + 0.4 * (2.0 * phi).cos() - t
        };
        (0..steps).filter(|&k| miss(k) * miss(k + 1) < 0.0).count()
    };
    for faster in [1.0005, 1.01, 1.3] {
        let (from, to) = (-1.5, 1.0);
        let all = Twins { faster }.solver().ranges(&Instant::at(from), to).unwrap();
        agrees(&all, [from, to], |t| count(t) * count(faster * t));
        // Every dead centre of one angle is there once for each closure of the other, and two ranges end at it.
        for (end, folds) in [(-1.4, 1), (0.6, 1), (0.7125, 2)] {
            for (t, others) in [(end, count(faster * end)), (end / faster, count(end / faster))] {
                let found = all.limits.iter().filter(|limit| (limit.t.midpoint() - t).abs() < 1e-9).count();
                assert_eq!(found, 2 * folds * others, "{faster}: {t}: {all}");
            }
        }
        assert!(all.searched.is_empty() && all.limits.iter().all(|limit| limit.t.radius() < 1e-9), "{all}");
    }
}

/// An angle whose equation has a kink, where |sin φ| turns, close to a place where its slope is 0.
#[mechanism]
#[bodies(a)]
#[revolute(A: ground @ (0, 0), a @ (0, 0))]
#[constraint(kinked: height*abs(sin(a.phi)) + cos(a.phi + 0.3) = t)]
struct Kinked {
    height: f64,
}

/// Two closures come together at the kink as well, which second derivatives do not show.
#[test]
fn kinks_are_not_taken_for_regular_places() {
    let off = 0.01_f64;
    let height = (off + 0.3).sin() / off.cos();
    let value = |phi: f64| height * phi.sin().abs() + (phi + 0.3).cos();
    let (kink, top) = (value(0.0), value(off));
    let all = Kinked { height }.solver().ranges(&Instant::at(kink - 1.0), top + 1.0).unwrap();
    // The place beside the kink is proven.
    let beside = |t: f64| all.limits.iter().filter(move |limit| (limit.t.midpoint() - t).abs() < 1e-7);
    assert!(beside(top).next().is_some() && beside(top).all(|limit| limit.proven), "{all}");
    // The kink is not, and nothing is claimed of it.
    assert!(!all.is_complete() && beside(kink).all(|limit| !limit.proven) && beside(kink).next().is_some(), "{all}");
}

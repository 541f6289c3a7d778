//! Curves that are straight or round but for a bump that is narrow compared with a step, and may be steep enough to stop the
//! motion.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::slots::{Curve, fold, instants, root};
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::{Instant, Kinematics, Limit, Options, Planned, Signal, SolveError, mechanism};
use kin_tests::random::Random;
use std::fmt::Debug;

/// x + a/(1 + ((x − c)/w)²) = m + t: straight, but for a bump of the width w at c.
#[mechanism]
#[body(slider, y = 0, phi = 0)]
#[constraint(bump: slider.x + a / (1 + pow((slider.x - c) / w, 2)) = m + t)]
#[derive(Clone, Debug)]
struct Bump {
    a: f64,
    c: f64,
    w: f64,
    m: f64,
}

/// The same as a curve that rises, with a pin that can only move along x.
#[mechanism]
#[body(pin, y = 0, phi = 0)]
#[on_curve(track: ground @ (0, 0), pin @ (0, 0), implicit(X, Y) = Y + X + a / (1 + pow((X - c) / w, 2)) - m - t)]
#[derive(Clone, Debug)]
struct Track {
    a: f64,
    c: f64,
    w: f64,
    m: f64,
}

/// The same for an angle.
#[mechanism]
#[body(wheel, x = 0, y = 0)]
#[constraint(bump: wheel.phi + a / (1 + pow((wheel.phi - c) / w, 2)) = m + t)]
#[derive(Clone, Debug)]
struct Lobe {
    a: f64,
    c: f64,
    w: f64,
    m: f64,
}

/// An offset knife-edge follower on a cam with a lobe, or a notch, of the width w.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(follower, x = offset, phi = 0)]
#[on_curve(contact: cam @ (0, 0), follower @ (0, 0), polar(theta) = r + a * exp(-pow((theta - c) / w, 2)))]
#[driver(turn: cam.phi = start + rate * t)]
#[derive(Clone, Debug)]
struct Cam {
    r: f64,
    a: f64,
    c: f64,
    w: f64,
    offset: f64,
    start: f64,
    rate: f64,
}

/// A pin on a straight slot with a bump that an input moves along the slot.
#[mechanism]
#[input(c)]
#[body(pin, y = 0, phi = 0)]
#[on_curve(slot: ground @ (0, 0), pin @ (0, 0), implicit(X, Y) = Y - h - r * t - m * X - a / (1 + pow((X - c) / w, 2)))]
#[derive(Clone, Debug)]
struct Moved {
    m: f64,
    a: f64,
    w: f64,
    h: f64,
    r: f64,
}

/// An arm on a straight line with a bump that moves along it.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[on_curve(line: ground @ (0, 0), arm @ (l, 0), implicit(X, Y) = Y - h - m * X - a * exp(-pow((X - c - v * t) / w, 2)))]
#[derive(Clone, Debug)]
struct Passed {
    l: f64,
    h: f64,
    m: f64,
    a: f64,
    c: f64,
    v: f64,
    w: f64,
}

/// A slot with a stretch of small waves and, farther on, one narrow bump.
#[mechanism]
#[body(pin, y = 0, phi = 0)]
#[body(plate, x = 0, phi = 0)]
#[on_curve(
    slot: plate @ (0, 0), pin @ (0, 0),
    implicit(X, Y) = Y - m * X - a * sin(k * X + o) * exp(-pow((X - d) / g, 4)) - b * exp(-pow((X - c) / w, 2))
)]
#[driver(lift: plate.y = h + r * t)]
#[derive(Clone, Debug)]
struct Wavy {
    m: f64,
    a: f64,
    k: f64,
    o: f64,
    d: f64,
    g: f64,
    b: f64,
    c: f64,
    w: f64,
    h: f64,
    r: f64,
}

/// A motion from a place up to the dead centre at the bump; `make` takes a, c, w and m. `None` if it ends at once.
fn bump<M>(make: impl Fn([f64; 4]) -> M, [a, c, w]: [f64; 3], from: f64) -> Option<Case<M>> {
    let f: Curve = Box::new(move |x: f64| {
        let u = (x - c) / w;
        let d = 1.0 + u * u;
        let curvature = -2.0 * a / (d * d) + 8.0 * a * u * u / (d * d * d);
        [x + a / d, 1.0 - 2.0 * a * u / (w * d * d), curvature / (w * w)]
    });
    let end = fold(&f, from, 1.0, c - from + 3.0 * w).expect("a bump with a dead centre");
    let m = f(from)[0];
    let dead_centre = f(end)[0] - m;
    if f(from)[1] < 0.1 || dead_centre < 0.02 {
        return None;
    }
    let branch = move |t: f64, off: f64| {
        let s = Jet::time(t) * (1.0 + off) + m * (1.0 + off);
        Some(vec![root(&f, [from - 1.0, end], s)?])
    };
    Some(Case::new(make([a, c, w, m]), branch, [vec![dead_centre], vec![]], format!("from {from}")))
}

/// A motion of random steps past the dead centre of a random bump, most of them narrow compared with the steps.
fn follow_bump<M: Kinematics + Debug + Sync>(random: &mut Random, tally: &mut Tally, make: fn([f64; 4]) -> M) {
    let w = 0.5 * 10.0_f64.powf(random.between(-2.0, 0.0));
    let a = w * random.between(1.7, 6.0) * random.sign();
    let Some(case) = bump(make, [a, random.between(0.0, 3.0), w], random.between(-1.5, -0.2)) else { return };
    let times = instants(random, case.folds.first().copied());
    follow(tally, &Group::new(times, vec![case]));
}

/// A motion over the lobe of a random cam, which ends on its flank where the flank is too steep. θ is the polar angle of
/// the contact: the cam's angle is that of the follower's edge, atan2(y, offset), less θ.
fn cam(random: &mut Random) -> (Case<Cam>, Vec<f64>) {
    loop {
        let (r, offset) = (random.between(0.5, 1.5), random.between(0.1, 0.45) * random.sign());
        let w = 10.0_f64.powf(random.between(-2.3, -0.5));
        let a = f64::max(w * random.between(0.3, 4.0) * random.sign(), -0.9 * (r - offset.abs()));
        let (c, way) = (random.between(-1.0, 1.0), random.sign());
        // y(θ) with its derivatives, from y² = r(θ)² − offset².
        let height = move |theta: f64| {
            let u = (theta - c) / w;
            let lobe = a * (-u * u).exp();
            let [r, slope, bend] = [r + lobe, -2.0 * u / w * lobe, (4.0 * u * u - 2.0) / (w * w) * lobe];
            let y = (r * r - offset * offset).sqrt();
            let dy = r * slope / y;
            [y, dy, (slope * slope + r * bend - dy * dy) / y, r, slope]
        };
        let angle: Curve = Box::new(move |theta: f64| {
            let [y, dy, ddy, r, slope] = height(theta);
            let bend = offset * (ddy / (r * r) - 2.0 * dy * slope / (r * r * r));
            [y.atan2(offset) - theta, offset * dy / (r * r) - 1.0, bend]
        });
        let from = c - way * random.between(0.3, 1.5);
        let end = fold(&angle, from, way, (c - from).abs() + 1.5);
        let start = angle(from)[0];
        let rate = -way * random.between(0.3, 1.0);
        let dead_centre = end.map(|end| (angle(end)[0] - start) / rate);
        if angle(from)[1] > -0.2 || dead_centre.is_some_and(|t| t < 0.02) {
            continue;
        }
        let times = instants(random, dead_centre.or(Some(0.4 / rate.abs())));
        let mechanism = Cam { r, a, c, w, offset, start, rate };
        let range = [from - 0.1 * way, end.unwrap_or(c + way * 1.5)];
        let branch = move |t: f64, off: f64| {
            let phi = Jet::time(t) * (1.0 + off) * rate + start * (1.0 + off);
            let theta = root(&angle, range, phi)?;
            let [y, dy, ddy, ..] = height(theta.x);
            Some(vec![phi, Jet::new(y, dy * theta.v, ddy * theta.v * theta.v + dy * theta.a)])
        };
        let folds = dead_centre.into_iter().collect();
        return (Case::new(mechanism, branch, [folds, vec![]], format!("from {from}")), times);
    }
}

/// The curve is nearly straight where the step begins and where it could end.
#[test]
fn bumps_behind_straight_stretches() {
    let mut tally = Tally::default();
    for (a, end) in [(2.0, 8.0), (2.0, 12.0), (-3.0, 8.0), (-3.0, 12.0), (1.6, 9.0), (5.0, 14.0)] {
        let case = bump(|[a, c, w, m]| Bump { a, c, w, m }, [a, 3.0, 1.0], -3.0).expect("a long way to the bump");
        follow(&mut tally, &Group::new(vec![0.0, end], vec![case]));
    }
    tally.obeys("bumps");
}

/// The bump is between the places at which a step is looked at.
#[test]
fn narrow_bumps() {
    let (mut random, mut tally) = (Random::new(1016), Tally::default());
    for _ in 0..motions(0.3) {
        follow_bump(&mut random, &mut tally, |[a, c, w, m]| Bump { a, c, w, m });
        follow_bump(&mut random, &mut tally, |[a, c, w, m]| Lobe { a, c, w, m });
    }
    tally.obeys("narrow bumps");
}

/// The follower rests before the lobe, so that only the turn of the cam tells of it.
#[test]
fn followers_on_lobes() {
    let (mut random, mut tally) = (Random::new(1019), Tally::default());
    for _ in 0..motions(0.3) {
        let (case, times) = cam(&mut random);
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys("lobes");
}

/// The bump comes to the pin within a step, at whose ends it is far away on either side.
#[test]
fn a_bump_that_an_input_moves() {
    let at = |t: f64| {
        let (value, rate) = (1.2406112021080467 * t + 0.1425847086649289 * t.sin(), 0.1425847086649289 * t.cos());
        Signal::new(0.9725894842912413 + value, 1.2406112021080467 + rate, -0.1425847086649289 * t.sin())
    };
    let (m, a, w, start) = (0.9043620874342012, 0.06853503679598492, 0.03384479993980678, -0.27406702031805374);
    let h = -m * start - a / (1.0 + ((start - at(0.0).value) / w).powi(2));
    let moved = Moved { m, a, w, h, r: 0.9946989273050311 };
    let mut planned = Planned::new(&moved, &Instant { t: 0.0, inputs: &[at(0.0)] }, &[start]).expect("it closes");
    planned.at(&Instant { t: -0.0402267609, inputs: &[at(-0.0402267609)] }).expect("the bump is far away");
    let refused = planned.at(&Instant { t: -1.1442318927, inputs: &[at(-1.1442318927)] });
    let located = refused.err().and_then(|error| error.limit().and_then(Limit::at)).expect("a limit on the way");
    assert!((located + 0.5356).abs() < 0.05, "{located}");
}

/// A step over many waves, which are too small to stop the pin, and over the bump, which does.
#[test]
fn a_bump_behind_many_waves() {
    let wavy = Wavy {
        m: 0.6096664377607199,
        a: 0.0019257892541771624,
        k: 130.10623120561456,
        o: 0.5624482731998075,
        d: 2.8881037533010048,
        g: 0.4110349054032253,
        b: -0.03919244280391956,
        c: 3.277417623028243,
        w: 0.03670397210350562,
        h: 0.7154132716943601,
        r: 0.3735765126740489,
    };
    let start = [-1.1734503121445294, wavy.h];
    let mut planned = Planned::new(&wavy, &Instant::at(0.0), &start).expect("it closes");
    let times = [-1.2008129554039968, -1.2700577368998593, -3.2209006410515912, -4.32416833435503, -8.010656246695042];
    let refused = times.into_iter().find_map(|t| planned.at(&Instant::at(t)).err()).expect("the bump stops the pin");
    let located = refused.limit().and_then(Limit::at).expect("the limit is located");
    assert!((located + 7.168611521890879).abs() < 1e-8, "{refused}");
}

/// Rates that underflow have fewer digits than others, which is no sign of another branch.
#[test]
fn a_bump_that_has_moved_away() {
    let passed = Passed {
        l: 1.5079591427280932,
        h: 0.8246333737144488,
        m: 0.007921003717536235,
        a: 0.24901967542717027,
        c: 0.7266592186027195,
        v: 2.9369725977195653,
        w: 0.1000537267925192,
    };
    let times: Vec<f64> = (0..=4).map(|k| -0.7493453591700816 * f64::from(k)).collect();
    for use_plan in [true, false] {
        let options = Options { use_plan, ..Options::default() };
        let swept = passed.solver().with_guess(0, 0.5865022249828946).with_options(options).sweep(&times);
        let swept = swept.expect("nothing holds the arm").states;
        let rates: Vec<f64> = swept.iter().map(|state| state.q_dot[0].abs()).collect();
        assert!(rates.iter().any(|rate| *rate > 0.0 && *rate < f64::MIN_POSITIVE), "{rates:?}");
        let off = passed.l * swept[4].q[0].sin() - passed.h - passed.m * passed.l * swept[4].q[0].cos();
        assert!(off.abs() < 1e-14, "{off:e}");
    }
}

/// The row of the curve vanishes at the dead centre although its gradient does not: no contact degenerates there.
#[test]
fn a_pin_with_one_coordinate_has_a_dead_centre_on_a_curve() {
    for [a, c, w] in [[2.0, 1.0, 0.5], [-0.4, 2.0, 0.1], [0.3, 0.5, 0.05]] {
        let case = bump(|[a, c, w, m]| Track { a, c, w, m }, [a, c, w], -1.0).expect("a dead centre");
        let end = case.folds[0];
        for use_plan in [true, false] {
            let options = Options { use_plan, ..Options::default() };
            let solver = case.mechanism.solver().with_guess(0, -1.0).with_options(options);
            let refused = solver.sweep(&[0.0, 0.5 * end, 1.5 * end]).expect_err("a dead centre").source;
            let is_singular = matches!(refused, SolveError::Singular { .. } | SolveError::StepRefused { .. });
            assert!(is_singular && refused.to_string().contains("track"), "{refused}");
        }
    }
}

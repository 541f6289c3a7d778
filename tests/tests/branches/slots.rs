//! Motions with little rotation or none: pins in waved slots, long arms on them, and Kepler's equation. Since no body
//! turns far, an iteration could pass a dead centre and continue on another part of the curve.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::PI;

/// A plate that is lifted, with a slot Y = a cos X/w + b cos(k X/w + c) for a pin that slides along the ground.
#[mechanism]
#[body(pin, y = 0, phi = 0)]
#[body(plate, x = 0, phi = 0)]
#[on_curve(slot: plate @ (0, 0), pin @ (0, 0), implicit(X, Y) = Y - a * cos(X / w) - b * cos(k * X / w + c))]
#[driver(lift: plate.y = start + rate * t)]
#[derive(Clone, Debug)]
struct Slot {
    a: f64,
    b: f64,
    k: f64,
    c: f64,
    w: f64,
    start: f64,
    rate: f64,
}

/// u + e sin u = m + t.
#[mechanism]
#[coordinates(u)]
#[constraint(anomaly: u + e * sin(u) = m + t)]
#[derive(Clone, Debug)]
struct Kepler {
    e: f64,
    m: f64,
}

/// An arm with a pin in a slot Y = m X + a sin(k X + c) of a plate that is lifted. A long arm passes a wave while it turns
/// little.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[body(plate, x = 0, phi = 0)]
#[on_curve(slot: plate @ (0, 0), arm @ (l, 0), implicit(X, Y) = Y - m * X - a * sin(k * X + c))]
#[driver(lift: plate.y = start + rate * t)]
#[derive(Clone, Debug)]
struct Arm {
    l: f64,
    m: f64,
    a: f64,
    k: f64,
    c: f64,
    start: f64,
    rate: f64,
}

/// A function with its first two derivatives.
pub(crate) type Curve = Box<dyn Fn(f64) -> [f64; 3]>;

/// The first place from `from` on, in the direction of `way`, at which f′ changes its sign; `None` within the distance
/// `far`.
pub(crate) fn fold(f: &Curve, from: f64, way: f64, far: f64) -> Option<f64> {
    let rises = f(from)[1] > 0.0;
    let step = way * far / 4000.0;
    let (mut low, mut high) = (0..4000)
        .map(|k| (from + f64::from(k) * step, from + f64::from(k + 1) * step))
        .find(|(_, next)| (f(*next)[1] > 0.0) != rises)?;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle)[1] > 0.0) == rises { low = middle } else { high = middle }
    }
    Some(low)
}

/// The root u of f(u) = s between two places, between which f is monotone, with its rates.
pub(crate) fn root(f: &Curve, [mut low, mut high]: [f64; 2], s: Jet) -> Option<Jet> {
    let above = |u: f64| f(u)[0] > s.x;
    let at_low = above(low);
    if at_low == above(high) {
        return None;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if above(middle) == at_low { low = middle } else { high = middle }
    }
    let u = 0.5 * (low + high);
    let [_, d, dd] = f(u);
    let v = s.v / d;
    Some(Jet::new(u, v, (s.a - dd * v * v) / d))
}

/// Instants up to a time that is usually behind the dead centre at `fold`.
pub(crate) fn instants(random: &mut Random, fold: Option<f64>) -> Vec<f64> {
    let end = fold.map_or(2.0, |fold| fold * random.between(0.7, 3.0));
    let count = random.whole(1, 30);
    (0..=count).map(|k| end * k as f64 / count as f64).collect()
}

fn slot(random: &mut Random) -> (Case<Slot>, Vec<f64>) {
    loop {
        let (a, k, c) = (random.between(0.1, 0.3), random.whole(2, 3) as f64, random.between(-3.0, 3.0));
        let (b, w) = (a * random.between(0.2, 1.2) / k, random.between(0.2, 1.5));
        let wave = move |u: f64| {
            let (inner, outer) = (u.sin_cos(), (k * u + c).sin_cos());
            [a * inner.1 + b * outer.1, -a * inner.0 - b * k * outer.0, -a * inner.1 - b * k * k * outer.1]
        };
        let f: Curve = Box::new(wave);
        let (from, way) = (random.between(-3.0, 3.0), random.sign());
        if f(from)[1].abs() < 0.05 * a {
            continue;
        }
        // The other end of the monotone part, behind the start.
        let Some(behind) = fold(&f, from, -way, 7.0) else { continue };
        let Some(end) = fold(&f, from, way, 7.0) else { continue };
        // The plate is lifted by the amount by which the wave changes.
        let (start, rate) = (f(from)[0], 0.1 * (f(end)[0] - f(from)[0]).signum());
        let dead_centre = (f(end)[0] - start) / rate;
        let mechanism = Slot { a, b, k, c, w, start: -start, rate: -rate };
        let times = instants(random, Some(dead_centre));
        let branch = move |t: f64, off: f64| {
            let s = Jet::time(t) * (1.0 + off) * rate + start * (1.0 + off);
            let u = root(&f, [behind, end], s)?;
            Some(vec![u * w, -s])
        };
        let note = format!("from X/w = {from}");
        return (Case::new(mechanism, branch, [vec![dead_centre], vec![]], note), times);
    }
}

fn kepler(random: &mut Random) -> (Case<Kepler>, Vec<f64>) {
    let case = kepler_from(1.0 + random.small(-4.0, -0.5), random.between(0.5, 2.3));
    let times = instants(random, case.folds.first().copied());
    (case, times)
}

fn kepler_from(e: f64, from: f64) -> Case<Kepler> {
    let f: Curve = Box::new(move |u: f64| [u + e * u.sin(), 1.0 + e * u.cos(), -e * u.sin()]);
    let end = fold(&f, from, 1.0, PI);
    let m = f(from)[0];
    let dead_centre = end.map(|end| f(end)[0] - m);
    let branch = move |t: f64, off: f64| {
        let s = Jet::time(t) * (1.0 + off) + m * (1.0 + off);
        Some(vec![root(&f, [0.0, end.unwrap_or(20.0)], s)?])
    };
    let note = format!("from u = {from}");
    Case::new(Kepler { e, m }, branch, [dead_centre.into_iter().collect(), vec![]], note)
}

fn arm(random: &mut Random) -> (Case<Arm>, Vec<f64>) {
    loop {
        let mut of = |low: f64, high: f64| random.between(low, high);
        let (l, m, a, k, c) = (of(0.5, 6.0), of(-0.6, 0.6), of(0.1, 0.6), of(1.0, 4.0), of(-3.0, 3.0));
        let from = of(-1.3, 1.3);
        let f: Curve = Box::new(move |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            let (x, x1, x2) = (l * cos, -l * sin, -l * cos);
            let (wave, slope) = (k * x + c).sin_cos();
            let outer = m + a * k * slope;
            [l * sin - m * x - a * wave, l * cos - outer * x1, -l * sin - outer * x2 + a * k * k * wave * x1 * x1]
        });
        let way = random.sign();
        let (Some(behind), Some(end)) = (fold(&f, from, -way, 3.0), fold(&f, from, way, 3.0)) else { continue };
        if f(from)[1].abs() < 0.2 * l || (end - from).abs() < 0.02 {
            continue;
        }
        let start = f(from)[0];
        let rate = (f(end)[0] - start).signum() * random.between(0.3, 1.0);
        let dead_centre = (f(end)[0] - start) / rate;
        let mechanism = Arm { l, m, a, k, c, start, rate };
        let times = instants(random, Some(dead_centre));
        let branch = move |t: f64, off: f64| {
            let s = Jet::time(t) * (1.0 + off) * rate + start * (1.0 + off);
            Some(vec![root(&f, [behind, end], s)?, s])
        };
        return (Case::new(mechanism, branch, [vec![dead_centre], vec![]], format!("from {from}")), times);
    }
}

#[test]
fn arms_on_waved_slots() {
    let (mut random, mut tally) = (Random::new(1014), Tally::default());
    for _ in 0..motions(0.4) {
        let (case, times) = arm(&mut random);
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys("arms");
}

#[test]
fn pins_in_waved_slots() {
    let (mut random, mut tally) = (Random::new(1012), Tally::default());
    for _ in 0..motions(0.4) {
        let (case, times) = slot(&mut random);
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys("slots");
}

#[test]
fn anomalies_of_kepler() {
    let (mut random, mut tally) = (Random::new(1013), Tally::default());
    for _ in 0..motions(0.4) {
        let (case, times) = kepler(&mut random);
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys("Kepler's equation");
}

/// Two dead centres that are 0.33 rad apart, and a step of 1.7 rad across both.
#[test]
fn an_anomaly_with_two_dead_centres_in_one_step() {
    let case = kepler_from(1.0135490680531092, 2.4130066668324575);
    assert_eq!(1, case.folds.len());
    let mut tally = Tally::default();
    follow(&mut tally, &Group::new(vec![0.0, 0.1953327218975706], vec![case]));
    tally.obeys("Kepler's equation");
}

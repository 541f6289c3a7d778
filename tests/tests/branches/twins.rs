//! Two four-bars on one crank, whose limits coincide or nearly coincide: where both closures change at once, the sign
//! of the determinant of Φ_q does not change.

use crate::case::{Case, Group};
use crate::closure::FourBar;
use crate::crossings::crossing;
use crate::draw::{Draw, near_a_crossing};
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::{PI, TAU};

/// The pin of the second four-bar is at the angle `turned` on the crank, and its ground link is rotated by `ahead`
/// more.
#[mechanism]
#[bodies(crank, coupler, rocker, second_coupler, second_rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[revolute(A2: crank @ (a2*cos(turned), a2*sin(turned)), second_coupler @ (0, 0))]
#[revolute(B2: second_coupler @ (b2, 0), second_rocker @ (c2, 0))]
#[revolute(D2: ground @ (d2*cos(turned + ahead), d2*sin(turned + ahead)), second_rocker @ (0, 0))]
#[driver(drive: crank.phi = start + t)]
#[derive(Clone, Debug)]
struct Twins {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    a2: f64,
    b2: f64,
    c2: f64,
    d2: f64,
    turned: f64,
    ahead: f64,
    start: f64,
}

/// Both four-bars in closed form.
fn twins([one, other]: [FourBar; 2], turned: f64, ahead: f64, start: f64, span: [f64; 2]) -> Case<Twins> {
    let mechanism = Twins {
        a: one.a,
        b: one.b,
        c: one.c,
        d: one.d,
        a2: other.a,
        b2: other.b,
        c2: other.c,
        d2: other.d,
        turned,
        ahead,
        start,
    };
    let branch = move |t: f64, off: f64| {
        let phi = Jet::time(t) + start;
        let [coupler, rocker] = one.close(phi, off)?;
        let [second_coupler, second_rocker] = other.close(phi - ahead, off)?.map(|angle| angle + turned + ahead);
        let pin = |length: f64, angle: Jet| [angle.cos() * length, angle.sin() * length];
        let ground = |length: f64, angle: f64| [Jet::from(length * angle.cos()), Jet::from(length * angle.sin())];
        let bodies = [
            ([Jet::default(); 2], phi),
            (pin(one.a, phi), coupler),
            (ground(one.d, 0.0), rocker),
            (pin(other.a, phi + turned), second_coupler),
            (ground(other.d, turned + ahead), second_rocker),
        ];
        Some(bodies.into_iter().flat_map(|([x, y], phi)| [x, y, phi]).collect())
    };
    let [low, high] = span.map(|t| start + t);
    let [mut folds, mut crossings] = one.places(low, high);
    let [more_folds, more_crossings] = other.places(low - ahead, high - ahead);
    folds.extend(more_folds.iter().map(|place| place + ahead));
    crossings.extend(more_crossings.iter().map(|place| place + ahead));
    let in_time = |places: Vec<f64>| places.into_iter().map(|place| place - start).collect();
    let note = format!("signs {} {}", one.sign, other.sign);
    Case::new(mechanism, branch, [folds, crossings].map(in_time), note)
}

/// Four pairs over one grid of times that leads each of them past its limit.
fn drawn(random: &mut Random, equal: bool) -> Group<Twins> {
    let end = random.sign() * random.between(2.5, 6.5);
    let times = random.grid(end);
    let mut cases = Vec::new();
    while cases.len() < 4 {
        let outer = random.chance(0.5);
        let bar = |random: &mut Random| {
            let off = if random.chance(0.1) { 0.0 } else { random.small(-9.0, -3.0) };
            // Some of them are parallelograms and kites.
            let (bar, limit) = crossing(random);
            if random.chance(0.3) && limit == if outer { PI } else { TAU } {
                FourBar { d: bar.d + off, ..bar }
            } else {
                near_a_crossing(random, outer, off)
            }
        };
        let (one, other) = (bar(random), bar(random));
        let sign = random.sign();
        let (other, ahead) = if equal {
            (FourBar { sign, ..one }, 0.0)
        } else {
            (other, if random.chance(0.5) { 0.0 } else { random.small(-9.0, -2.0) })
        };
        let turned = if random.chance(0.3) { 0.0 } else { random.between(-PI, PI) };
        // The limit is in the first two thirds of the motion.
        let limit = if outer { PI } else { TAU };
        let start = limit - random.meeting(&times, 0.05, 0.65);
        if one.is_free(start, 0.05) && other.is_free(start - ahead, 0.05) {
            cases.push(twins([one, other], turned, ahead, start, [0.0, end]));
        }
    }
    Group::new(times, cases)
}

#[test]
fn equal_twins() {
    let (mut random, mut tally) = (Random::new(201), Tally::default());
    for _ in 0..motions(0.15).div_ceil(4) {
        follow(&mut tally, &drawn(&mut random, true));
    }
    tally.obeys("equal twins");
}

#[test]
fn different_twins_of_nearly_one_limit() {
    let (mut random, mut tally) = (Random::new(202), Tally::default());
    for _ in 0..motions(0.15).div_ceil(4) {
        follow(&mut tally, &drawn(&mut random, false));
    }
    tally.obeys("different twins");
}

/// Two four-bars with links 0.1, 0.4 and 0.35, and a ground link near 0.65, where branches cross with stretched links.
#[test]
fn two_crank_rockers() {
    let (mut random, mut tally) = (Random::new(203), Tally::default());
    let offs = [0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, -1e-9, -1e-8, -1e-7, -1e-6, -1e-5, -1e-4];
    for _ in 0..motions(0.08).div_ceil(4 * offs.len()) {
        for off in offs {
            let times = random.grid(6.0);
            let pairs = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
            // 0.1 + 0.65 equals 0.4 + 0.35 to the last bit.
            let bar = |sign: f64| FourBar { a: 0.1, b: 0.4, c: 0.35, d: 0.65 + off, sign };
            let cases = pairs.map(|signs| twins(signs.map(bar), 0.0, 0.0, 0.5 + random.between(0.0, 0.5), [0.0, 6.0]));
            follow(&mut tally, &Group::new(times, cases.into()));
        }
    }
    tally.obeys("two crank-rockers");
}

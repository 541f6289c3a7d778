//! A platform on three parallel cranks: where two cranks lie along the line of their pins, the third one determines how
//! they continue. The branches of the whole mechanism do not cross there, and the motion must pass.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::PI;

/// Ground pins at (0, 0), (b, 0) and (x, y); all cranks have the same length and angle.
#[mechanism(allow_redundant)]
#[bodies(first, second, third, platform)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: ground @ (b, 0), second @ (0, 0))]
#[revolute(C: ground @ (x, y), third @ (0, 0))]
#[revolute(D: first @ (r, 0), platform @ (0, 0))]
#[revolute(E: second @ (r, 0), platform @ (b, 0))]
#[revolute(F: third @ (r, 0), platform @ (x, y))]
#[driver(drive: first.phi = start + t)]
#[derive(Clone, Debug)]
struct Platform {
    r: f64,
    b: f64,
    x: f64,
    y: f64,
    start: f64,
}

/// A parallelogram whose coupler is kept parallel to the ground by a redundant row.
#[mechanism(allow_redundant)]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (r, 0))]
#[revolute(D: ground @ (b, 0), rocker @ (0, 0))]
#[distance(link: ground @ (x, y), coupler @ (x, y), length = r)]
#[driver(drive: crank.phi = start + t)]
#[derive(Clone, Debug)]
struct Linked {
    r: f64,
    b: f64,
    x: f64,
    y: f64,
    start: f64,
}

fn case<M>(mechanism: M, bodies: Vec<([f64; 2], f64, f64)>, start: f64) -> Case<M> {
    let branch = move |t: f64, off: f64| {
        let phi = (Jet::time(t) + start) * (1.0 + off);
        let body = |&([x, y], radius, turns): &([f64; 2], f64, f64)| {
            [phi.cos() * radius + x, phi.sin() * radius + y, phi * turns]
        };
        Some(bodies.iter().flat_map(body).collect())
    };
    // The times at which the first two cranks are in line.
    let plan_ends = (-5..=5).map(|half| PI * f64::from(half) - start).collect();
    Case { plan_ends, ..Case::new(mechanism, branch, [vec![], vec![]], String::new()) }
}

fn drawn<M>(random: &mut Random, new: impl Fn(f64, f64, [f64; 2], f64) -> Case<M>) -> Group<M> {
    let end = random.sign() * random.between(3.5, 7.0);
    let times = random.grid(end);
    let mut one = || {
        let aside = random.sign() * random.between(0.1, 0.8);
        let (r, b, x) = (random.length(), random.length(), random.between(-0.5, 1.0));
        // In a quarter of the cases an instant of the grid is the one at which two cranks are in line.
        let turn = random.between(0.2, 2.9);
        let start = if random.chance(0.25) { -times[times.len() / 2] } else { turn };
        new(r, b, [x, aside], if start.sin().abs() < 1e-2 { turn } else { start })
    };
    let cases = [one(), one(), one(), one()].into();
    Group::new(times, cases)
}

#[test]
fn redundant_cranks_pass() {
    let (mut random, mut tally) = (Random::new(241), Tally::default());
    for _ in 0..motions(0.07).div_ceil(8) {
        let platforms = drawn(&mut random, |r, b, [x, y], start| {
            let pins = vec![([0.0; 2], 0.0, 1.0), ([b, 0.0], 0.0, 1.0), ([x, y], 0.0, 1.0), ([0.0; 2], r, 0.0)];
            case(Platform { r, b, x, y, start }, pins, start)
        });
        follow(&mut tally, &platforms);
        let linked = drawn(&mut random, |r, b, [x, y], start| {
            let pins = vec![([0.0; 2], 0.0, 1.0), ([0.0; 2], r, 0.0), ([b, 0.0], 0.0, 1.0)];
            case(Linked { r, b, x, y, start }, pins, start)
        });
        follow(&mut tally, &linked);
    }
    tally.obeys("redundant cranks");
}

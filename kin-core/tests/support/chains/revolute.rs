//! A mechanism from a chain with ground and driven link: random pins, and links between them.

use super::{Case, Draft, FIXED, Pose, SHORTEST, Vector, length, minus, plus, turned};
use std::f64::consts::TAU;

/// A mechanism made of a chain.
pub struct Linkage {
    pub draft: Draft,
    /// Where the joints are drawn.
    pins: Vec<Vector>,
    /// The body of every link.
    number: Vec<usize>,
}

/// The mechanism of `case` with random dimensions.
pub fn linkage(case: &Case, seed: u64) -> Linkage {
    driven_at(case, [case.ground, case.driven], 0, seed)
}

/// The same with another joint driven, that of two links, and `sliding` of a hundred of the others translational.
pub fn driven_at(case: &Case, driver: [usize; 2], sliding: usize, seed: u64) -> Linkage {
    let mut draft = Draft::new(seed);
    let pins = spread(case, &mut draft);
    let mut number = vec![FIXED; case.chain.links];
    // Bodies are declared in any order.
    let mut links: Vec<usize> = (0..case.chain.links).filter(|&link| link != case.ground).collect();
    for k in (1..links.len()).rev() {
        let other = draft.random.below(k + 1);
        links.swap(k, other);
    }
    for link in links {
        let own = case.chain.joints.iter().zip(&pins).filter(|(joint, _)| joint.contains(&link));
        let mut own: Vec<Vector> = own.map(|(_, pin)| *pin).collect();
        let first = draft.random.below(own.len());
        own.swap(0, first);
        number[link] = draft.link(&own);
    }
    let [from, to] = driver;
    for (&[a, b], pin) in case.chain.joints.iter().zip(&pins) {
        if [[from, to], [to, from]].contains(&[a, b]) || !draft.random.chance(sliding) {
            draft.pin(number[a], number[b], *pin);
        } else {
            let psi = draft.random.between(0.0, TAU);
            draft.slide(number[a], number[b], *pin, psi);
        }
    }
    let omega = if draft.random.chance(50) { 1.0 } else { -1.0 } * draft.random.between(0.5, 1.5);
    draft.drive(number[from], number[to], omega);
    draft.shuffle();
    Linkage { draft, pins, number }
}

/// A pin for every joint; those of one link are not close together.
fn spread(case: &Case, draft: &mut Draft) -> Vec<Vector> {
    let mut pins: Vec<Vector> = Vec::new();
    for [a, b] in &case.chain.joints {
        let near = |pin: Vector| {
            let mut others =
                case.chain.joints.iter().zip(&pins).filter(|(joint, _)| joint.contains(a) || joint.contains(b));
            others.any(|(_, other)| length(minus(*other, pin)) < SHORTEST)
        };
        let pin = loop {
            let pin = [0; 2].map(|_| draft.random.between(-2.0, 2.0));
            if !near(pin) {
                break pin;
            }
        };
        pins.push(pin);
    }
    pins
}

impl Linkage {
    /// The bodies that are not driven.
    pub fn carried_along(&self, case: &Case) -> Vec<usize> {
        let links = (0..case.chain.links).filter(|link| ![case.ground, case.driven].contains(link));
        links.map(|link| self.number[link]).collect()
    }

    /// The joint of two links, by its place in the chain.
    fn joint(&self, case: &Case, a: usize, b: usize) -> usize {
        let joins = |joint: &[usize; 2]| *joint == [a, b] || *joint == [b, a];
        case.chain.joints.iter().position(joins).expect("links that are joined")
    }

    /// Where a link takes one of its pins in the configuration q.
    fn moved(&self, link: usize, pin: usize, q: &[f64]) -> Vector {
        let number = self.number[link];
        if number == FIXED {
            return self.pins[pin];
        }
        let [x, y, phi]: Pose = self.draft.poses[number];
        let now = &q[3 * (number - 1)..3 * number];
        plus([now[0], now[1]], turned(now[2] - phi, minus(self.pins[pin], [x, y])))
    }

    /// By how much the lengths of the first dyad that does not close miss what they would have to be, relative to the
    /// largest, where all links before it are as in q; positive where all close. For chains of dyads only.
    pub fn slack(&self, case: &Case, q: &[f64]) -> f64 {
        let mut known = vec![case.ground, case.driven];
        for pair in case.dyads().0 {
            let inner = self.joint(case, pair[0], pair[1]);
            let mut ends = Vec::new();
            for link in pair {
                let before = *case.chain.neighbours(link).iter().find(|link| known.contains(link)).expect("a dyad");
                let outer = self.joint(case, link, before);
                ends.push((self.moved(before, outer, q), length(minus(self.pins[outer], self.pins[inner]))));
            }
            let (apart, b, c) = (length(minus(ends[0].0, ends[1].0)), ends[0].1, ends[1].1);
            let slack = (b + c - apart).min(apart - (b - c).abs()) / (b + c);
            if slack <= 0.0 {
                return slack;
            }
            known.extend(pair);
        }
        1.0
    }
}

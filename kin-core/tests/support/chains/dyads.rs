//! Dyads of every kind one after another, between the ground, driven bodies and one another: with bodies for both links,
//! or with `distance` or `point_on_line` as a link without mass.

use super::super::Random;
use super::{Draft, FIXED, SHORTEST, Vector, length, minus};
use kin_core::joints::{Belt, Fixed, Gear, RelativeAngle};
use kin_core::mechanism::{Operands, Radii, Value};
use std::f64::consts::TAU;

/// The kinds, by their joints from one known body to the other: revolute or prismatic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Rrr,
    Rrp,
    Rpr,
    Prp,
    Rpp,
}

impl Kind {
    pub const ALL: [Self; 5] = [Self::Rrr, Self::Rrp, Self::Rpr, Self::Prp, Self::Rpp];

    pub const fn letters(self) -> &'static str {
        match self {
            Self::Rrr => "RRR",
            Self::Rrp => "RRP",
            Self::Rpr => "RPR",
            Self::Prp => "PRP",
            Self::Rpp => "RPP",
        }
    }

    /// Ways to assemble it, given what it hangs on.
    pub const fn closures(self) -> usize {
        match self {
            Self::Rrr | Self::Rrp | Self::Rpr => 2,
            Self::Prp | Self::Rpp => 1,
        }
    }

    /// Ways to write it: with two bodies, and with one link without mass.
    pub const fn writings(self) -> usize {
        if matches!(self, Self::Rrp) { 3 } else { 2 }
    }
}

/// A mechanism of dyads.
pub struct Dyads {
    pub draft: Draft,
    /// In an order in which they can be solved.
    pub kinds: Vec<Kind>,
}

/// `count` dyads, the first of which is of the given kind and writing.
pub fn dyads(kind: Kind, writing: usize, count: usize, seed: u64) -> Dyads {
    let mut draft = Draft::new(seed);
    draft.carried = 25;
    let mut known = vec![FIXED];
    // With a body that is driven, and others whose motion follows from its at once.
    let pivot = somewhere(&mut draft);
    let crank = draft.link(&[pivot]);
    draft.pin(FIXED, crank, pivot);
    let omega = if draft.random.chance(50) { 1.0 } else { -1.0 } * draft.random.between(0.5, 1.5);
    draft.drive(FIXED, crank, omega);
    known.push(crank);
    if draft.random.chance(30) {
        known.push(geared(&mut draft, crank));
    }
    if draft.random.chance(20) {
        known.push(welded(&mut draft, crank));
    }
    let mut kinds = Vec::new();
    for k in 0..count {
        let (kind, writing) = if k == 0 {
            (kind, writing)
        } else {
            let kind = Kind::ALL[draft.random.below(Kind::ALL.len())];
            (kind, draft.random.below(kind.writings()))
        };
        let first = draft.random.below(known.len());
        let second = (first + 1 + draft.random.below(known.len() - 1)) % known.len();
        let shape = Shape::random(&mut draft.random);
        let new = close(&mut draft, kind, writing, [known[first], known[second]], &shape);
        known.extend(new);
        kinds.push(kind);
    }
    draft.shuffle();
    Dyads { draft, kinds }
}

fn somewhere(draft: &mut Draft) -> Vector {
    [0; 2].map(|_| draft.random.between(-2.0, 2.0))
}

/// A body pinned to the ground that a gear, a belt or an angle makes turn with another.
fn geared(draft: &mut Draft, crank: usize) -> usize {
    let pivot = somewhere(draft);
    let wheel = draft.link(&[pivot]);
    draft.pin(FIXED, wheel, pivot);
    let radii = [0; 2].map(|_| draft.random.between(0.5, 1.5));
    let choice = draft.random.below(3);
    let [a, b] = [draft.poses[crank][2], draft.poses[wheel][2]];
    let offset = match choice {
        0 => radii[0] * a + radii[1] * b,
        1 => radii[0] * a - radii[1] * b,
        _ => b - a,
    };
    let [i, j] = radii.map(|value| Value { value: draft.value(value), origin: super::super::AT });
    let offset = draft.value(offset);
    let (a, b, carrier) = (draft.named(crank), draft.named(wheel), draft.named(FIXED));
    let radii = Radii { i, j, origin: super::super::AT };
    draft.add(match choice {
        0 => Gear { a, b, radii, carrier, offset }.into(),
        1 => Belt { a, b, radii, carrier, offset }.into(),
        _ => RelativeAngle { a, b, value: offset }.into(),
    });
    wheel
}

/// A body fixed to another.
fn welded(draft: &mut Draft, to: usize) -> usize {
    let at = somewhere(draft);
    let plate = draft.link(&[at]);
    let (p, q) = (draft.place(to, at), draft.place(plate, at));
    let angle = draft.value(draft.poses[plate][2] - draft.poses[to][2]);
    draft.add(Fixed { p, q, angle }.into());
    plate
}

/// Where a dyad stands, as far as its kind has such a thing.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// The pin on the first known body.
    pub a: Vector,
    /// The inner pin, or a point of the guide.
    pub b: Vector,
    /// The pin, or a point of the guide, on the second known body.
    pub c: Vector,
    /// A point of the guide that goes with the inner pin.
    pub beside: Vector,
    /// The direction of the guide.
    pub psi: f64,
    /// The direction of the other guide.
    pub across: f64,
}

impl Shape {
    fn random(random: &mut Random) -> Self {
        let mut point = || [0; 2].map(|_| random.between(-2.0, 2.0));
        let [a, b, c] = loop {
            let [a, b, c] = [point(), point(), point()];
            if length(minus(a, b)).min(length(minus(b, c))) > SHORTEST {
                break [a, b, c];
            }
        };
        let other = point();
        let psi = random.between(0.0, TAU);
        // Two guides that are far from parallel; a guide through the pin, or beside it.
        let across = psi + random.between(0.5, 2.6);
        let beside = if random.chance(40) { b } else { other };
        Self { a, b, c, beside, psi, across }
    }
}

/// A dyad between two known bodies; the bodies that it adds.
pub fn close(draft: &mut Draft, kind: Kind, writing: usize, [i, j]: [usize; 2], shape: &Shape) -> Vec<usize> {
    let Shape { a, b, c, beside, psi, across } = *shape;
    match (kind, writing) {
        (Kind::Rrr, 0) => {
            let (first, second) = (draft.link(&[a, b]), draft.link(&[c, b]));
            draft.pin(i, first, a);
            draft.pin(first, second, b);
            draft.pin(j, second, c);
            vec![first, second]
        }
        (Kind::Rrr, _) => {
            let link = draft.link(&[c, b]);
            draft.rod((i, a), (link, b));
            draft.pin(j, link, c);
            vec![link]
        }
        (Kind::Rrp, 0) => {
            let (link, slider) = (draft.link(&[a, b]), draft.link(&[b]));
            draft.pin(i, link, a);
            draft.pin(link, slider, b);
            draft.slide(j, slider, beside, psi);
            vec![link, slider]
        }
        (Kind::Rrp, 1) => {
            let slider = draft.link(&[b]);
            draft.rod((i, a), (slider, b));
            draft.slide(j, slider, beside, psi);
            vec![slider]
        }
        (Kind::Rrp, _) => {
            let link = draft.link(&[a, b]);
            draft.pin(i, link, a);
            draft.on_line(j, link, b, psi);
            vec![link]
        }
        (Kind::Rpr, 0) => {
            let (first, second) = (draft.link(&[a]), draft.link(&[c]));
            draft.pin(i, first, a);
            draft.slide(first, second, b, psi);
            draft.pin(j, second, c);
            vec![first, second]
        }
        (Kind::Rpr, _) => {
            let link = draft.link(&[a]);
            draft.pin(i, link, a);
            draft.on_line(link, j, c, psi);
            vec![link]
        }
        (Kind::Prp, 0) => {
            let (first, second) = (draft.link(&[b]), draft.link(&[b]));
            draft.slide(i, first, beside, psi);
            draft.pin(first, second, b);
            draft.slide(j, second, c, across);
            vec![first, second]
        }
        (Kind::Prp, _) => {
            let slider = draft.link(&[b]);
            draft.slide(i, slider, beside, psi);
            draft.on_line(j, slider, b, across);
            vec![slider]
        }
        (Kind::Rpp, 0) => {
            let (first, second) = (draft.link(&[a]), draft.link(&[c]));
            draft.pin(i, first, a);
            draft.slide(first, second, b, psi);
            draft.slide(j, second, c, across);
            vec![first, second]
        }
        (Kind::Rpp, _) => {
            let slider = draft.link(&[c]);
            draft.on_line(slider, i, a, psi);
            draft.slide(j, slider, c, across);
            vec![slider]
        }
    }
}

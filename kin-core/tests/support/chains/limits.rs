//! A dyad that is about to reach a limit, between a crank and the ground: as far from it as one likes, or on it.

use super::{Draft, FIXED, Kind, Shape, Vector, close, plus, turned};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Which limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The links of RRR are in line, the inner pin between the others.
    Stretched,
    /// The links of RRR are in line, the inner pin beyond the others.
    Folded,
    /// The rod of RRP stands across the guide.
    Across,
    /// The guide of RPR stands across the line of the pins.
    Beside,
    /// The guides of PRP are parallel.
    Guides,
    /// The guides of RPP are parallel.
    Slots,
}

impl Limit {
    /// Those that are reached when something becomes too short or too long; two closures meet there.
    pub const OF_LENGTH: [Self; 4] = [Self::Stretched, Self::Folded, Self::Across, Self::Beside];

    /// Those of directions: no closure, or no end of them.
    pub const OF_DIRECTION: [Self; 2] = [Self::Guides, Self::Slots];

    pub const fn kind(self) -> Kind {
        match self {
            Self::Stretched | Self::Folded => Kind::Rrr,
            Self::Across => Kind::Rrp,
            Self::Beside => Kind::Rpr,
            Self::Guides => Kind::Prp,
            Self::Slots => Kind::Rpp,
        }
    }

    /// The dyad from the pin `a` on, in the direction χ, with the small offset or angle `lean` from the limit; sizes
    /// are near 1, or integers for the factor 2.
    fn shape(self, a: Vector, chi: f64, lean: f64, factor: f64) -> Shape {
        let from = |point: Vector, length: f64, off: f64| plus(point, turned(chi, [factor * length, factor * off]));
        let psi = chi + FRAC_PI_2;
        let (b, c) = match self {
            Self::Stretched => (from(a, 1.0, lean), from(a, 2.5, 0.0)),
            Self::Folded => (from(a, 2.5, lean), from(a, 1.0, 0.0)),
            _ => (from(a, 1.0, lean), from(a, 1.5, 0.0)),
        };
        match self {
            // The guide itself is turned away from the limit, through both points.
            Self::Beside => Shape { a, b: c, c, beside: c, psi: psi + lean, across: psi },
            Self::Guides | Self::Slots => Shape { a, b, c, beside: b, psi: psi + lean, across: psi },
            _ => Shape { a, b, c, beside: b, psi, across: psi },
        }
    }
}

/// A crank and a dyad with random frames and directions, `lean` away from the limit.
pub fn near(limit: Limit, writing: usize, lean: f64, seed: u64) -> Draft {
    let mut draft = Draft::new(seed);
    let chi = draft.random.between(0.0, TAU);
    let a = [0; 2].map(|_| draft.random.between(-1.0, 1.0));
    // Beside the dyad's line, so that it comes nearer to its limit or goes away from it.
    let pivot = plus(a, turned(chi, [draft.random.between(-0.3, 0.3), 0.8]));
    with_crank(draft, limit, writing, pivot, limit.shape(a, chi, lean, 1.0))
}

/// On the limit to the last bit at t = 0, before it on one side of that and beyond it on the other; all dimensions are
/// integers.
pub fn on(limit: Limit, writing: usize) -> Draft {
    let mut draft = Draft::new(1);
    draft.plain = true;
    let shape = limit.shape([1.0, 0.0], FRAC_PI_2, 0.0, 2.0);
    let whole = |v: Vector| v.map(f64::round);
    let shape = Shape { a: whole(shape.a), b: whole(shape.b), c: whole(shape.c), beside: whole(shape.beside), ..shape };
    with_crank(draft, limit, writing, [0.0, 0.0], shape)
}

fn with_crank(mut draft: Draft, limit: Limit, writing: usize, pivot: Vector, shape: Shape) -> Draft {
    let crank = draft.link(&[pivot]);
    draft.pin(FIXED, crank, pivot);
    draft.drive(FIXED, crank, 1.0);
    close(&mut draft, limit.kind(), writing, [crank, FIXED], &shape);
    draft
}

//! The closed form of a four-bar that is accurate near its folds and at its crossings.

use crate::jet::Jet;
use std::f64::consts::{PI, TAU};

/// A four-bar in its own frame: crank a about the origin, ground pin at (d, 0), coupler b, rocker c.
///
/// With D the distance from the crank's pin to the ground pin, the dyad closes where
///
/// ```text
/// U = (b + c)² − D² = (b + c − a − d)(b + c + a + d) + 4ad cos²(θ/2)   and
/// V = D² − (b − c)² = (|a − d| − |b − c|)(|a − d| + |b − c|) + 4ad sin²(θ/2)
/// ```
///
/// are positive. Where U or V is a square, its root passes through 0 and changes its sign there: a crossing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FourBar {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
    pub(crate) d: f64,
    /// The sign of the closure √U √V.
    pub(crate) sign: f64,
}

impl FourBar {
    /// b + c − a − d and |a − d| − |b − c|, which are 0 if branches cross where the links are stretched or folded.
    fn spare(&self) -> [f64; 2] {
        let Self { a, b, c, d, .. } = *self;
        [(b + c) - (a + d), (a - d).abs() - (b - c).abs()]
    }

    /// U and V, each as (constant, amplitude of the square).
    fn margins(&self, off: f64) -> [(f64, f64); 2] {
        let Self { a, b, c, d, .. } = *self;
        let [outer, inner] = self.spare();
        let size = b + c + a + d;
        // An exact crossing remains a crossing for every `off`.
        let beside = |spare: f64| if spare == 0.0 { 0.0 } else { spare + off * size };
        [(beside(outer) * size, 4.0 * a * d), (beside(inner) * ((a - d).abs() + (b - c).abs()), 4.0 * a * d)]
    }

    /// The angles of the coupler (about the crank's pin) and of the rocker (about the ground pin), relative to the line
    /// of the ground pins, for the crank angle θ.
    pub(crate) fn close(&self, theta: Jet, off: f64) -> Option<[Jet; 2]> {
        let Self { a, b, c, d, sign } = *self;
        let theta = theta * (1.0 + off);
        let half = theta * 0.5;
        let [u, v] = self.margins(off);
        let root = |(constant, square): (f64, f64), wave: Jet| {
            if constant == 0.0 {
                return Some(wave * square.sqrt());
            }
            let margin = wave * wave * square + constant;
            (margin.x > 0.0).then(|| margin.sqrt())
        };
        let (u, v) = (root(u, half.cos())?, root(v, half.sin())?);
        let area = u * v * sign;
        let (x, y) = (-theta.cos() * a + d, -theta.sin() * a);
        let square = x * x + y * y;
        let along = square + (b - c) * (b + c);
        // Both vectors have 2 D² times their length.
        let (bx, by) = (along * x - area * y, along * y + area * x);
        let (cx, cy) = (bx - square * x * 2.0, by - square * y * 2.0);
        Some([by.atan2(bx), cy.atan2(cx)])
    }

    /// The crank angles between `from` and `to` at which the four-bar folds, and those at which branches cross.
    pub(crate) fn places(&self, from: f64, to: f64) -> [Vec<f64>; 2] {
        let [outer, inner] = self.margins(0.0);
        let (mut folds, mut crossings) = (Vec::new(), Vec::new());
        // Where the crank's pin comes so near to the ground pin, the dyad turns at least 10⁶ times as fast as the
        // crank, and Φ_q is singular within rounding.
        let meets = (self.a - self.d).abs() < 1e-6;
        for ((constant, square), at) in [(outer, PI), (inner, 0.0)] {
            let half = -constant / square;
            let (list, width) = if half == 0.0 || at == 0.0 && meets {
                (&mut crossings, 0.0)
            } else if half > 0.0 {
                (&mut folds, 2.0 * half.sqrt().min(1.0).asin())
            } else {
                continue;
            };
            for turn in -4..=4 {
                for place in [at - width, at + width].map(|place| place + TAU * f64::from(turn)) {
                    if from.min(to) - 0.1 < place && place < from.max(to) + 0.1 {
                        list.push(place);
                    }
                }
            }
        }
        [folds, crossings]
    }

    /// Whether the four-bar closes at θ and is farther than `distance` from all folds and crossings.
    pub(crate) fn is_free(&self, theta: f64, distance: f64) -> bool {
        let [folds, crossings] = self.places(theta - TAU, theta + TAU);
        let far = |place: &f64| (theta - place).abs() > distance;
        self.close(Jet::from(theta), 0.0).is_some() && folds.iter().chain(&crossings).all(far)
    }
}

/// The nearest number with 20 binary places; sums of such numbers are exact.
pub(crate) fn dyadic(x: f64) -> f64 {
    (x * 1_048_576.0).round() / 1_048_576.0
}

//! Detection of iterated rows whose slopes change so fast that rounding errors dominate what they determine.
//!
//! If a row f determines a coordinate x, then ẍ = −(f″/f′) ẋ² + …. Rounding changes x by ε|x|, so it changes f″/f′ by about
//! ε|x|w² with w = |f″/f′|, the turn of the row per unit of x ([`turns_with`](crate::Mechanism::turns_with)). What this
//! does to ẍ must be small compared with ẍ or, where its terms cancel, with ẋ². And within the last correction of the
//! iteration, λ = 3·10⁻⁹ √(1 + |x|), or 3·10⁻⁹ |x| for a length, the slope must be about the same: beside a pole of f
//! corrections are small, too, although there is no root.
//!
//! ```text
//! ε |x| w² ẋ² ≤ 4·10⁻⁶ max(|ẍ|, u ẋ²),   λ w ≤ 0.1
//! ```
//!
//! Here u is 1 for an angle, w for a length, whose unit is arbitrary, and the smaller of 1 and w for a scalar coordinate,
//! whose unit is not known.
//!
//! The unit vector of a distance in the rows turns with all coordinates that move its points, whether they are iterated or
//! not. Rounding turns it by ε|x|w, which is the relative error of velocities.

use super::follower::{PlanFollower, PlanSolution};
use super::ill_conditioned::MAX_ACCELERATION_NOISE;
use crate::mechanism::Mechanism;
use crate::model::{Component, CoordinateKind, Model};
use crate::plan::LAST_CORRECTION;
use crate::scalar::compare::{Compare, least_or_nan};
use crate::signal::Instant;
use crate::workspace::Array;

/// Largest relative change of a slope within the last correction.
const LARGEST_SLOPE_CHANGE: f64 = 0.1;
/// Largest turn of the unit vector of a distance by rounding.
const ROUNDED_TURN: f64 = 1e-9;

/// Whether rounding errors may dominate a solution because gradients of rows change fast.
pub(crate) fn may_be_steep<M: Mechanism>() -> bool {
    M::ROWS_TURN && (M::model().plan.iterates() || M::DISTANCES_IN_ROWS)
}

/// Not negative where rounding errors are small in all unknowns of iterations and in their rates; NaN where this is not
/// certain. The arguments are the turns of rows per unit of each coordinate, and q, q̇ and q̈; and whether the rows contain
/// distances.
#[cfg(all(feature = "simd", feature = "alloc"))]
pub(crate) fn certainty_of_slopes<V: Compare>(
    model: &Model,
    has_distances: bool,
    turns: &[V],
    solution: [&[V]; 3],
) -> V {
    let mut least = V::from_f64(1.0);
    for k in model.plan.iterated_coordinates() {
        least = least_or_nan(least, certainty(model.coordinates[k].kind, turns[k], solution.map(|list| list[k])));
    }
    if has_distances {
        turns.iter().zip(solution[0]).for_each(|(w, x)| least = least_or_nan(least, certainty_of_direction(*w, *x)));
    }
    least
}

impl<M: Mechanism> PlanFollower<M> {
    /// The first coordinate of the trial state that rounding errors dominate, where the gradients of rows turn by these
    /// angles per unit of each coordinate; `turns` is used only if rows turn otherwise than bodies.
    #[inline]
    pub(super) fn first_steep_unknown(&self, turns: &M::Coordinates<f64>) -> Option<usize> {
        if !may_be_steep::<M>() {
            return None;
        }
        let PlanSolution { q, q_dot, q_ddot, .. } = self.trial();
        let solution = [q.as_ref(), q_dot.as_ref(), q_ddot.as_ref()];
        first_steep(M::model(), M::DISTANCES_IN_ROWS, turns.as_ref(), solution)
    }

    /// The angles by which the gradients of rows turn per unit of each coordinate at the trial state; `None` where rounding
    /// errors dominate a coordinate.
    pub(super) fn turns_unless_steep(&self, mechanism: &M, at: &Instant<'_>) -> Option<M::Coordinates<f64>> {
        let mut turns = M::Coordinates::<f64>::filled(0.0);
        let q = self.trial().q.as_ref();
        let counted = mechanism.turns_with(self.parameters.as_ref(), at, q, turns.as_mut());
        debug_assert!(counted.is_ok(), "q and turns have n numbers");
        self.first_steep_unknown(&turns).is_none().then_some(turns)
    }
}

/// The first coordinate that rounding errors dominate, in rows with or without distances.
pub(crate) fn first_steep(model: &Model, has_distances: bool, turns: &[f64], solution: [&[f64]; 3]) -> Option<usize> {
    // The comparisons are written so that NaN is rejected.
    let is_certain = |k: usize| certainty(model.coordinates[k].kind, turns[k], solution.map(|list| list[k])) >= 0.0;
    let turns_little = |k: &usize| certainty_of_direction(turns[*k], solution[0][*k]) >= 0.0;
    let of_distance = || (0..if has_distances { turns.len() } else { 0 }).find(|k| !turns_little(k));
    model.plan.iterated_coordinates().find(|k| !is_certain(*k)).or_else(of_distance)
}

/// Not negative where the rounding of a coordinate x turns gradients little.
fn certainty_of_direction<V: Compare>(w: V, x: V) -> V {
    V::from_f64(ROUNDED_TURN) - V::from_f64(f64::EPSILON) * x.abs() * w
}

/// The smaller of the differences, right side less left side, of the two conditions above for one coordinate: both hold if
/// it is not negative.
fn certainty<V: Compare>(kind: CoordinateKind, w: V, [x, v, a]: [V; 3]) -> V {
    let one = V::from_f64(1.0);
    let [unit, last] = match kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => [one, (one + x.abs()).sqrt()],
        CoordinateKind::Pose { .. } => [w, x.abs()],
        CoordinateKind::Scalar => [w.least(one), (one + x.abs()).sqrt()],
    };
    let noise = V::from_f64(f64::EPSILON) * x.abs() * (w * v) * (w * v);
    let of_rates = V::from_f64(MAX_ACCELERATION_NOISE) * a.abs().greatest(unit * v * v) - noise;
    least_or_nan(of_rates, V::from_f64(LARGEST_SLOPE_CHANGE) - V::from_f64(LAST_CORRECTION) * last * w)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLE: CoordinateKind = CoordinateKind::Pose { body: 0, component: Component::Phi };
    const LENGTH: CoordinateKind = CoordinateKind::Pose { body: 0, component: Component::X };

    /// At w² |x| = 4·10⁻⁶/ε the rounding of an angle is as large as allowed.
    #[test]
    fn an_acceleration_is_uncertain_where_rounding_makes_too_much_of_it() {
        let edge = (4e-6 / f64::EPSILON).sqrt();
        for (w, certain) in [(0.999 * edge, true), (1.001 * edge, false)] {
            let is_certain = |kind: CoordinateKind, w: f64, solution: [f64; 3]| certainty(kind, w, solution) >= 0.0;
            for v in [1.0, -30.0] {
                for x in [1.0, -1.0] {
                    assert_eq!(certain, is_certain(ANGLE, w, [x, v, 0.0]), "{w:e} {x} {v}");
                    assert_eq!(certain, is_certain(CoordinateKind::Scalar, w, [x, v, 0.0]), "{w:e} {x} {v}");
                    // A larger acceleration has more digits.
                    assert!(is_certain(ANGLE, w, [x, v, 1.1 * v * v]) && is_certain(ANGLE, w, [x, v, -1.1 * v * v]));
                    // A quarter of the rounding is as good as half of the turn.
                    assert_eq!(certain, is_certain(ANGLE, 2.0 * w, [0.25 * x, v, 0.0]));
                }
            }
            // What rests has no acceleration to lose.
            assert!(is_certain(ANGLE, w, [1.0, 0.0, 0.0]) && is_certain(LENGTH, w, [1.0, 1.0, 0.0]));
        }
        // The unit of a length is arbitrary; in a larger unit of a scalar the turn per unit is larger.
        let scalar = |x: f64| certainty(CoordinateKind::Scalar, 1e-3, [x, 3.0, 0.0]) >= 0.0;
        assert!(scalar(0.999e3 * edge * edge) && !scalar(1.001e3 * edge * edge));
        assert!(certainty(ANGLE, f64::NAN, [1.0, 1.0, 0.0]).is_nan());
    }

    /// Beside a pole the slope changes within a correction that is small enough to be the last.
    #[test]
    fn a_slope_does_not_change_within_the_last_correction() {
        for (factor, certain) in [(0.999, true), (1.001, false)] {
            // An acceleration so large that rounding does not matter.
            let is_certain = |kind: CoordinateKind, w: f64, x: f64| certainty(kind, w, [x, 1.0, 1e30]) >= 0.0;
            let edge = factor * 0.1 / 3e-9;
            assert_eq!([certain; 2], [ANGLE, CoordinateKind::Scalar].map(|kind| is_certain(kind, edge, 0.0)));
            assert_eq!([certain; 2], [ANGLE, CoordinateKind::Scalar].map(|kind| is_certain(kind, 0.25 * edge, -15.0)));
            assert_eq!([certain; 2], [0.2, -40.0].map(|x: f64| is_certain(LENGTH, edge / x.abs(), x)));
        }
    }
}

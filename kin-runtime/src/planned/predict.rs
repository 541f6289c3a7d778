//! Prediction of the next configuration: by the parabola through q, q̇ and q̈ of the last state, and for unknowns of
//! iterations by the quintic through the last two states.
//!
//! ```text
//! q(t + h) ≈ q + h q̇ + ½ h² q̈
//! q(t + h) ≈ q + h q̇ + ½ h² q̈ + x³ (c₃ + c₄ x + c₅ x²),   x = h/H
//! ```
//!
//! H is the time between the two states. The last term makes the quintic match q, q̇ and q̈ of the earlier state as
//! well. The error of the quintic is of sixth order in the step and that of the parabola of third order, so that one
//! correction suffices instead of two.

use crate::model::{Component, CoordinateKind, Model};
use crate::quintic::coefficients;
use crate::scalar::compare::Compare;

/// Writes the factors that convert coordinates to radians at a configuration q; see [`weight`].
pub(crate) fn weights<V: Compare>(model: &Model, q: &[V], weights: &mut [V]) {
    for ((to, coordinate), q) in weights.iter_mut().zip(model.coordinates).zip(q) {
        *to = weight(coordinate.kind, *q);
    }
}

/// The factor that converts a coordinate of the value q to radians: 1 for an angle; 0 for a length, because the unit of
/// length is arbitrary; and for a scalar coordinate, whose meaning is unknown, 1 / (1 + |q|).
pub(crate) fn weight<V: Compare>(kind: CoordinateKind, q: V) -> V {
    let one = V::from_f64(1.0);
    match kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => one,
        CoordinateKind::Pose { .. } => V::from_f64(0.0),
        CoordinateKind::Scalar => one / (one + q.abs()),
    }
}

/// Writes the prediction by the parabola; returns the largest rotation by velocity or by acceleration alone.
#[inline(always)]
pub(crate) fn parabola<V: Compare>(to: &mut [V], [q, q_dot, q_ddot]: [&[V]; 3], weights: &[V], h: f64) -> V {
    let (step, half) = (V::from_f64(h), V::from_f64(0.5 * h * h));
    let one = |to: &mut V, q: V, v: V, a: V, weight: V| {
        let (by_velocity, by_acceleration) = (step * v, half * a);
        *to = q + (by_velocity + by_acceleration);
        weight * by_velocity.abs().greatest(by_acceleration.abs())
    };
    // Four maxima in parallel, in chunks, so that the loop vectorises.
    let mut most = [V::from_f64(0.0); 4];
    let (to, to_rest) = to.as_chunks_mut::<4>();
    let [(q, q_rest), (v, v_rest), (a, a_rest), (weights, weights_rest)] =
        [q, q_dot, q_ddot, weights].map(|column| column.as_chunks::<4>());
    for ((to, q), ((v, a), weights)) in to.iter_mut().zip(q).zip(v.iter().zip(a).zip(weights)) {
        for k in 0..4 {
            most[k] = most[k].greatest(one(&mut to[k], q[k], v[k], a[k], weights[k]));
        }
    }
    let rest = to_rest.iter_mut().zip(q_rest).zip(v_rest.iter().zip(a_rest).zip(weights_rest));
    for ((to, q), ((v, a), weight)) in rest {
        most[0] = most[0].greatest(one(to, *q, *v, *a, *weight));
    }
    greatest_of(most)
}

/// The largest rotation in a step by velocity or by acceleration alone; `weights` converts coordinates to radians.
#[inline]
pub(crate) fn largest_turn<V: Compare>([q_dot, q_ddot]: [&[V]; 2], weights: &[V], h: f64) -> V {
    let (step, half) = (V::from_f64(h), V::from_f64(0.5 * h * h));
    q_dot.iter().zip(q_ddot).zip(weights).fold(V::from_f64(0.0), |most, ((v, a), weight)| {
        most.greatest(*weight * (step * *v).abs().greatest((half * *a).abs()))
    })
}

/// The largest rotation between two configurations.
#[inline(always)]
pub(crate) fn turned<V: Compare>(a: &[V], b: &[V], weights: &[V]) -> V {
    let turn = |a: V, b: V, weight: V| weight * (a - b).abs();
    // Four maxima in parallel, in chunks: measured to be faster than a remainder of the index here.
    let mut most = [V::from_f64(0.0); 4];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let (weights, weights_rest) = weights.as_chunks::<4>();
    for ((a, b), weights) in a.iter().zip(b).zip(weights) {
        for k in 0..4 {
            most[k] = most[k].greatest(turn(a[k], b[k], weights[k]));
        }
    }
    let rest = a_rest.iter().zip(b_rest).zip(weights_rest);
    most[0] = rest.fold(most[0], |most, ((a, b), weight)| most.greatest(turn(*a, *b, *weight)));
    greatest_of(most)
}

/// The greatest of four numbers, by halves: in another order the compiler would exchange numbers between lanes in the
/// loop before.
#[inline(always)]
fn greatest_of<V: Compare>([a, b, c, d]: [V; 4]) -> V {
    a.greatest(c).greatest(b.greatest(d))
}

/// Range of the extrapolation by the quintic, in steps H.
const REACH: core::ops::RangeInclusive<f64> = -1.0..=2.0;

/// Largest ratio of the additional terms of the quintic to the motion by the parabola; where it is exceeded, the motion
/// is not smooth.
const SMOOTH: f64 = 0.25;

/// The difference between the quintic and the parabola of one coordinate, from its q, q̇ and q̈ in the states `before`
/// and `now`; 0 where the quintic is not reliable.
#[inline]
pub(super) fn beyond_parabola(before: [f64; 3], now: [f64; 3], span: f64, h: f64) -> f64 {
    let x = h / span;
    if !REACH.contains(&x) {
        return 0.0;
    }
    let [q, v, a] = now;
    // The error of the parabola of the current state at the state before.
    let r0 = before[0] - (q - span * (v - 0.5 * span * a));
    let r1 = span * (before[1] - (v - span * a));
    let r2 = span * span * (before[2] - a);
    // The interval 0 … 1 of the quintic goes backwards, from the current state to the one before.
    let [c3, c4, c5] = coefficients([r0, -r1, r2]);
    let beyond = -x * x * x * (c3 - x * (c4 - x * c5));
    let moved = (h * v).abs() + (0.5 * h * h * a).abs();
    if beyond.abs() <= SMOOTH * moved { beyond } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::{beyond_parabola, largest_turn, parabola, turned, weights};
    use crate::Mechanism;
    use crate::fixture::{FourBarLoop, PlannedFourBar};

    #[test]
    fn a_quintic_is_met_to_the_last_digits() {
        let at = |t: f64| {
            let q = 1.0 + t * (0.5 - t * (0.3 + t * (0.2 - t * (0.7 + 0.1 * t))));
            let v = 0.5 - t * (0.6 + t * (0.6 - t * (2.8 + 0.5 * t)));
            let a = -0.6 - t * (1.2 - t * (8.4 + 2.0 * t));
            [q, v, a]
        };
        for h in [0.05, 0.1, 0.19, -0.02, -0.1] {
            let [q, v, a] = at(0.3);
            let parabola = q + h * (v + 0.5 * h * a);
            let found = parabola + beyond_parabola(at(0.2), [q, v, a], 0.1, h);
            assert!((found - at(0.3 + h)[0]).abs() < 1e-13, "{h}: {found}");
        }
    }

    #[test]
    fn what_jumped_is_left_to_the_parabola() {
        let now = [0.0, 1.0, 0.0];
        assert_eq!(beyond_parabola([0.5, 1.0, 0.0], now, 0.1, 0.1), 0.0);
        for span in [0.0, f64::NAN, -0.1, 0.01] {
            assert_eq!(beyond_parabola([-0.1, 1.1, 0.1], now, span, 0.1), 0.0);
        }
    }

    /// For steps in both directions and rates of both signs, the rotation is the larger of those by the two terms.
    #[test]
    fn a_parabola_turns_as_far_as_the_larger_of_its_terms() {
        let (q, v, a) = ([1.0, -2.0, 0.5, 3.0], [0.2, -4.0, 0.1, 50.0], [-1.0, 2.0, 30.0, 0.0]);
        let weights = [1.0, 0.5, 1.0, 0.0];
        for h in [0.1, -0.1] {
            let mut to = [0.0; 4];
            let turn: f64 = parabola(&mut to, [&q, &v, &a], &weights, h);
            for k in 0..4 {
                assert!((to[k] - (q[k] + h * v[k] + 0.5 * h * h * a[k])).abs() < 1e-15, "{k}");
            }
            // The rotations are ½ 0.1² 30 and 0.5·0.1·4; the weight of the last coordinate, with 0.1·50, is 0.
            assert!((turn - 0.2).abs() < 1e-15, "{turn}");
            assert_eq!(turn, largest_turn([&v, &a], &weights, h));
            let slower: f64 = parabola(&mut to, [&q, &[0.2, -2.0, 0.1, 50.0], &a], &weights, h);
            assert!((slower - 0.15).abs() < 1e-15, "{slower}");
            assert_eq!(slower, largest_turn([&[0.2, -2.0, 0.1, 50.0], &a], &weights, h));
        }
    }

    /// Every element counts with its own weight, whatever the length of the list.
    #[test]
    fn the_largest_turn_is_found_at_every_place() {
        for count in 1..=23 {
            let zeros = vec![0.0; count];
            for index in 0..count {
                for change in [0.7, -0.7] {
                    let (mut to, mut weights) = (zeros.clone(), vec![1.0; count]);
                    to[index] = change;
                    weights[index] = 0.5;
                    assert_eq!([0.35; 2], [turned(&to, &zeros, &weights), turned(&zeros, &to, &weights)]);
                    assert_eq!(0.35, parabola(&mut zeros.clone(), [&zeros, &to, &zeros], &weights, 1.0));
                }
            }
        }
    }

    #[test]
    fn angles_count_as_they_are_lengths_not_and_scalars_by_their_size() {
        let mut found = [f64::NAN; 9];
        weights(PlannedFourBar::model(), &[5.0; 9], &mut found);
        assert_eq!([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0], found);
        let mut found = [f64::NAN; 3];
        weights(FourBarLoop::model(), &[0.0, 3.0, -1.0], &mut found);
        assert_eq!([1.0, 0.25, 0.5], found);
    }

    /// Where the additional terms of the quintic exceed a quarter of the motion by the parabola, they are not used.
    #[test]
    fn a_quintic_that_bends_too_much_is_left_to_the_parabola() {
        // q = t + c t³, starting at 0.1 before the current time.
        let at = |c: f64, t: f64| [t + c * t * t * t, 1.0 + 3.0 * c * t * t, 6.0 * c * t];
        for (c, counts) in [(20.0, true), (24.0, true), (26.0, false), (60.0, false), (-24.0, true), (-26.0, false)] {
            let found = beyond_parabola(at(c, -0.1), at(c, 0.0), 0.1, 0.1);
            let expected = if counts { c * 0.001 } else { 0.0 };
            assert!((found - expected).abs() < 1e-15, "{c}: {found}");
        }
        // The motion by the parabola is the sum of |h q̇| and |½ h² q̈|, here 0.2 + 0.1.
        for (v, a) in [(2.0, 20.0), (2.0, -20.0), (-2.0, 20.0), (-2.0, -20.0)] {
            for (c, counts) in [(74.0, true), (76.0, false), (-74.0, true), (-76.0, false)] {
                let bent = |t: f64| [t * (v + t * (0.5 * a + t * c)), v + t * (a + 3.0 * t * c), a + 6.0 * t * c];
                let found = beyond_parabola(bent(-0.1), bent(0.0), 0.1, 0.1);
                assert_eq!(counts, found != 0.0, "{v} {a} {c}: {found}");
            }
        }
        // The quintic is used up to twice the last step ahead, and back to the state before.
        for (h, counts) in [(0.199, true), (0.201, false), (-0.099, true), (-0.101, false)] {
            let found = beyond_parabola(at(1.0, -0.1), at(1.0, 0.0), 0.1, h);
            assert_eq!(counts, found != 0.0, "{h}: {found}");
        }
    }
}

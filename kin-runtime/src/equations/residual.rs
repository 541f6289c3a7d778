//! The residuals of a solution, Φ, Φ_q q̇ + Φ_t and Φ_q q̈ − γ, row by row, and the tolerances with which they are
//! compared.
//!
//! The tolerance of every row is derived from the entries of this row, so that it does not depend on other
//! configurations, nor on the unit of length where angles have arms:
//!
//! ```text
//! Rᵢ = Σⱼ |∂Φᵢ/∂qⱼ| cⱼ        cⱼ = 1 for angles and scalars, L for lengths
//! |Φᵢ| ≤ ε Rᵢ        |Φ_q q̇ + Φ_t|ᵢ ≤ δ Rᵢ maxⱼ |q̇ⱼ|/cⱼ        |Φ_q q̈ − γ|ᵢ ≤ δ Rᵢ maxⱼ |q̈ⱼ|/cⱼ
//! ```
//!
//! where L is the largest arm of an angle in a row of lengths, 1 if there is none. If |Φ_t|ᵢ or |γ|ᵢ is larger than Rᵢ
//! times the largest rate, it takes the place of this product. ε is at least the rounding error of q, and no residual
//! counts that has underflowed.

use crate::equations::system::Parts;
use crate::model::{Level, Model};
use crate::nonlinear::newton::rounding;

/// Relative tolerances of the residuals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerances {
    /// ε, the tolerance of positions.
    pub(crate) position: f64,
    /// δ, the tolerance of velocities and accelerations.
    pub(crate) rates: f64,
}

/// Residuals up to this are rounding: smaller numbers have fewer digits than others.
pub(crate) const UNDERFLOW: f64 = f64::MIN_POSITIVE;

/// The sums over one row of Φ_q.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RowSums {
    /// Σ |∂Φᵢ/∂qⱼ| over coordinates that are lengths.
    lengths: f64,
    /// Σ |∂Φᵢ/∂qⱼ| over angles and scalars.
    angles: f64,
    /// The row of Φ_q q̇.
    velocity: f64,
    /// The row of Φ_q q̈.
    acceleration: f64,
}

/// Writes 1 for every coordinate that is x or y of a body, and 0 for the others.
pub(crate) fn write_lengths(model: &Model, lengths: &mut [f64]) {
    for (length, coordinate) in lengths.iter_mut().zip(model.coordinates) {
        *length = f64::from(u8::from(coordinate.kind.is_length()));
    }
}

/// max |xⱼ|/cⱼ, where `inverse` is 1/L.
fn largest(x: &[f64], lengths: &[f64], inverse: f64) -> f64 {
    x.iter().zip(lengths).fold(0.0, |most, (x, length)| {
        let size = x.abs() * if *length > 0.0 { inverse } else { 1.0 };
        if size > most { size } else { most }
    })
}

/// The largest arm of an angle in rows of lengths.
fn largest_arm(rows: &[RowSums]) -> f64 {
    let arms = rows.iter().map(|row| if row.lengths > 0.0 { row.angles / row.lengths } else { 0.0 });
    arms.fold(0.0, |most, arm| if arm > most { arm } else { most })
}

/// L for the largest arm. An arm that is a rounding error, as the slope of a cam at its highest place, counts as none.
fn unit_of(arm: f64, q: &[f64], lengths: &[f64]) -> f64 {
    let far = q.iter().zip(lengths).fold(0.0, |most, (x, length)| f64::max(most, x.abs() * length));
    if arm > rounding(far) && arm.is_finite() { arm } else { 1.0 }
}

/// Writes Rᵢ for every row; returns the largest residual allowed at q, relative to these sizes. `sizes` and the buffer
/// `angles` have one element per row.
pub(crate) fn write_sizes(
    model: &Model,
    phi_q: &[f64],
    q: &[f64],
    lengths: &[f64],
    position: f64,
    [sizes, angles]: [&mut [f64]; 2],
) -> f64 {
    // Entries are sorted by rows, so each row is summed before anything is stored.
    sizes.fill(0.0);
    angles.fill(0.0);
    let entries = model.constraint_pattern.entries;
    let (mut arm, mut row, mut sums) = (0.0, usize::MAX, [0.0; 2]);
    let mut finish = |row: usize, [by_angles, by_lengths]: [f64; 2]| {
        if let (Some(size), Some(angle)) = (sizes.get_mut(row), angles.get_mut(row)) {
            (*size, *angle) = (by_lengths, by_angles);
            let arm_of_row = if by_lengths > 0.0 { by_angles / by_lengths } else { 0.0 };
            arm = if arm_of_row > arm { arm_of_row } else { arm };
        }
    };
    for (&(i, j), a) in entries.iter().zip(phi_q) {
        if i != row {
            finish(row, sums);
            (row, sums) = (i, [0.0; 2]);
        }
        let length = lengths[j];
        sums[0] += (1.0 - length) * a.abs();
        sums[1] += length * a.abs();
    }
    finish(row, sums);
    let unit = unit_of(arm, q, lengths);
    sizes.iter_mut().zip(angles).for_each(|(size, angle)| *size = *size * unit + *angle);
    position.max(rounding(largest(q, lengths, 1.0 / unit)))
}

/// The largest |Φᵢ| if every row is certainly within the tolerance of [`closed_position`], without Φ_q: its constant
/// entries make a row at least as large as `least_sizes` ([`Model::least_sizes`]), with L as the factor of those for x and
/// y of bodies.
#[inline]
pub(crate) fn certainly_closed(
    least_sizes: &[[f64; 2]],
    phi: &[f64],
    [q, lengths]: [&[f64]; 2],
    position: f64,
) -> Option<f64> {
    let far = q.iter().zip(lengths).fold(0.0, |most, (x, length)| f64::max(most, x.abs() * length));
    let of_length = rounding(1.0) * far;
    let (mut residual, mut all) = (0.0, least_sizes.len() == phi.len());
    for (phi, [of_lengths, of_others]) in phi.iter().zip(least_sizes) {
        let phi = phi.abs();
        all &= phi <= f64::max(of_length * of_lengths, position * of_others);
        residual = if phi > residual { phi } else { residual };
    }
    all.then_some(residual)
}

/// The largest |Φᵢ| if every row is within tolerance; `None` otherwise. Rows of velocity level have Φᵢ = 0.
#[inline]
pub(crate) fn closed_position(phi: &[f64], sizes: &[f64], allowed: f64) -> Option<f64> {
    let (mut residual, mut all) = (0.0, true);
    // The loop has no early exit, so that it vectorises.
    for (phi, size) in phi.iter().zip(sizes) {
        let phi = phi.abs();
        all &= phi <= allowed * size;
        residual = if phi > residual { phi } else { residual };
    }
    all.then_some(residual)
}

/// The largest |Φᵢ| if all residuals of position, velocity and acceleration are within tolerance; `None` otherwise.
/// `lengths` comes from [`write_lengths`], `rows` is a buffer with one element per row.
pub(crate) fn closed(
    model: &Model,
    parts: &Parts<'_>,
    [q, q_dot, q_ddot]: [&[f64]; 3],
    lengths: &[f64],
    tolerances: Tolerances,
    rows: &mut [RowSums],
) -> Option<f64> {
    rows.fill(RowSums::default());
    for (&(i, j), a) in model.constraint_pattern.entries.iter().zip(parts.phi_q) {
        let (row, size, length) = (&mut rows[i], a.abs(), lengths[j]);
        row.lengths += length * size;
        row.angles += (1.0 - length) * size;
        row.velocity += a * q_dot[j];
        row.acceleration += a * q_ddot[j];
    }
    let unit = unit_of(largest_arm(rows), q, lengths);
    let inverse = 1.0 / unit;
    let allowed = tolerances.position.max(rounding(largest(q, lengths, inverse)));
    let [fast, faster] = [q_dot, q_ddot].map(|rates| tolerances.rates * largest(rates, lengths, inverse));
    let delta = tolerances.rates;
    let (mut residual, mut all) = (0.0, true);
    let right = parts.phi.iter().zip(parts.phi_t).zip(parts.gamma);
    for ((row, info), ((phi, phi_t), gamma)) in rows.iter().zip(model.rows).zip(right) {
        let size = row.lengths * unit + row.angles;
        if info.level == Level::Position {
            let phi = phi.abs();
            all &= phi <= allowed * size;
            residual = if phi > residual { phi } else { residual };
        }
        let (v, a) = ((row.velocity + phi_t).abs(), (row.acceleration - gamma).abs());
        all &= v <= f64::max(size * fast, delta * phi_t.abs()).max(UNDERFLOW);
        all &= a <= f64::max(size * faster, delta * gamma.abs()).max(UNDERFLOW);
    }
    all.then_some(residual)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows: of a pin, with two constant entries, and of an angle.
    #[test]
    fn what_is_certainly_closed_is_within_the_bounds_of_constant_entries() {
        let closed =
            |phi: [f64; 2]| certainly_closed(&[[2.0, 0.0], [0.0, 1.0]], &phi, [&[-0.5, 100.0], &[1.0, 0.0]], 1e-12);
        // 16 ε · 0.5 · 2, and the tolerance.
        assert_eq!(Some(9e-13), closed([-3.5e-15, 9e-13]));
        for phi in [[3.6e-15, 0.0], [0.0, -1.1e-12], [f64::NAN, 0.0], [0.0, f64::INFINITY]] {
            assert_eq!(None, closed(phi), "{phi:?}");
        }
        assert_eq!(None, certainly_closed(&[], &[0.0], [&[1.0], &[1.0]], 1e-12));
    }

    /// Every row that is certainly closed is closed with the sizes of its row.
    #[test]
    fn the_bounds_are_below_what_is_allowed() {
        use crate::fixture::FourBarLoop;
        use crate::mechanism::Mechanism;
        let model = FourBarLoop::model();
        let pattern = model.constraint_pattern;
        let mut lengths = vec![0.0; model.coordinates.len()];
        write_lengths(model, &mut lengths);
        // All entries are 1: those that count as constants, a part of them, make smaller sizes.
        let phi_q = vec![1.0; pattern.entries.len()];
        let mut least = vec![[0.0; 2]; pattern.rows];
        for (k, &(row, column)) in pattern.entries.iter().enumerate() {
            if k % 2 == 0 {
                least[row][usize::from(lengths[column] == 0.0)] += 1.0;
            }
        }
        for far in [1e-3, 1.0, 1e5] {
            let q: Vec<f64> = lengths.iter().map(|length| far * length + 0.3).collect();
            let [mut sizes, mut angles] = [(); 2].map(|()| vec![0.0; pattern.rows]);
            let allowed = write_sizes(model, &phi_q, &q, &lengths, 1e-12, [&mut sizes, &mut angles]);
            for row in 0..pattern.rows {
                for size in [1e-16, 1e-14, 1e-12, 1e-10, 1e-8] {
                    let mut phi = vec![0.0; pattern.rows];
                    phi[row] = size;
                    if certainly_closed(&least, &phi, [&q, &lengths], 1e-12).is_some() {
                        assert!(closed_position(&phi, &sizes, allowed).is_some(), "{far}: {size:e} of {}", sizes[row]);
                    }
                }
            }
        }
    }
}

//! The lecture's four-bar by dual numbers: Φ is written once for any scalar type, and everything else is a derivative
//! of it.

use crate::four_bar::{ByHand, FourBar};
use kin_runtime::nalgebra::{SMatrix, SVector};
use num_dual::{Dual2_64, DualNum, jacobian};

/// Φ, with one sine and cosine per angle.
fn phi<D: DualNum<Primitive = f64> + Copy>(four_bar: &FourBar, t: D, q: [D; 9]) -> SVector<D, 9> {
    let half = |phi: D, length: f64| {
        let (sin, cos) = phi.sin_cos();
        (cos * (0.5 * length), sin * (0.5 * length))
    };
    let ((x1, y1), (x2, y2), (x3, y3)) = (half(q[2], four_bar.l1), half(q[5], four_bar.l2), half(q[8], four_bar.l3));
    SVector::from([
        q[0] - x1,
        q[1] - y1,
        q[3] - x2 - q[0] - x1,
        q[4] - y2 - q[1] - y1,
        q[6] - x3 - q[3] - x2,
        q[7] - y3 - q[4] - y2,
        -q[6] - x3 + four_bar.d1,
        -q[7] - y3 + four_bar.d2,
        q[2] - t * four_bar.omega - four_bar.phi0,
    ])
}

/// γ: the negative second derivative of s ↦ Φ(q + s q̇, t + s) at 0.
fn gamma(four_bar: &FourBar, t: f64, q: &[f64; 9], w: &[f64; 9]) -> [f64; 9] {
    let s = Dual2_64::from_re(0.0).derivative();
    phi(four_bar, s + t, core::array::from_fn(|k| s * w[k] + q[k])).map(|row| -row.v2).into()
}

/// The results: Φ, its derivatives with respect to q and t in one matrix, and γ.
pub struct ByDuals {
    /// Φ.
    pub phi: SVector<f64, 9>,
    /// Φ_q in columns 0 to 8, Φ_t in column 9.
    pub derivatives: SMatrix<f64, 9, 10>,
    /// γ.
    pub gamma: [f64; 9],
}

impl Default for ByDuals {
    fn default() -> Self {
        Self { phi: SVector::zeros(), derivatives: SMatrix::zeros(), gamma: [0.0; 9] }
    }
}

/// The straightforward use of dual numbers, without knowledge about Φ: dual vectors over q and t.
#[inline(never)]
pub fn by_duals(four_bar: &FourBar, t: f64, q: &[f64; 9], w: &[f64; 9], out: &mut ByDuals) {
    let at = SVector::<f64, 10>::from_fn(|k, _| if k < 9 { q[k] } else { t });
    (out.phi, out.derivatives) = jacobian(|x| phi(four_bar, x[9], core::array::from_fn(|k| x[k])), &at);
    out.gamma = gamma(four_bar, t, q, w);
}

/// The use of dual numbers with the knowledge that Φ is linear in everything but the angles: dual vectors over the
/// three angles and t; the other columns of Φ_q are constant and have been written to `out` before.
#[inline(never)]
pub fn by_few_duals(four_bar: &FourBar, t: f64, q: &[f64; 9], w: &[f64; 9], out: &mut ByHand) {
    let turning = SVector::from([q[2], q[5], q[8], t]);
    let (phi, derivatives) = jacobian(
        |x| {
            let q = core::array::from_fn(|k| if k % 3 == 2 { x[k / 3] } else { q[k].into() });
            phi(four_bar, x[3], q)
        },
        &turning,
    );
    out.phi = phi.into();
    for (row, of_row) in out.phi_q.iter_mut().enumerate() {
        (0..3).for_each(|body| of_row[3 * body + 2] = derivatives[(row, body)]);
        out.phi_t[row] = derivatives[(row, 3)];
    }
    out.gamma = gamma(four_bar, t, q, w);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::four_bar::by_hand;

    #[test]
    fn dual_numbers_say_what_is_written_by_hand() {
        let (q, w) = (core::array::from_fn(|k| 0.3 + 0.7 * k as f64), core::array::from_fn(|k| 1.0 - 0.2 * k as f64));
        let (four_bar, mut hand) = (FourBar::default(), ByHand::default());
        let (mut duals, mut few) = (ByDuals::default(), ByHand::default());
        by_hand(&four_bar, 0.4, &q, &w, &mut hand);
        by_duals(&four_bar, 0.4, &q, &w, &mut duals);
        by_few_duals(&four_bar, 0.4, &q, &w, &mut few);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} {b}");
        for row in 0..9 {
            close(duals.phi[row], hand.phi[row]);
            close(duals.derivatives[(row, 9)], hand.phi_t[row]);
            close(duals.gamma[row], hand.gamma[row]);
            close(few.phi[row], hand.phi[row]);
            close(few.phi_t[row], hand.phi_t[row]);
            close(few.gamma[row], hand.gamma[row]);
            for column in 0..9 {
                close(duals.derivatives[(row, column)], hand.phi_q[row][column]);
                close(few.phi_q[row][column], hand.phi_q[row][column]);
            }
        }
    }
}

//! Null vectors from a rank-revealing factorisation.
//!
//! With A P = Q [R₁₁ R₁₂; 0 0], the columns of P [−R₁₁⁻¹ R₁₂; 1] span the null space; a QR factorisation makes them
//! orthonormal. A singular value decomposition is not used because of nalgebra issue 1172.

use nalgebra::{ColPivQR, DMatrix};

/// An orthonormal basis of {y : A y = 0}, one vector per column; pivots below `tolerance` times the largest count as
/// zero.
pub(crate) fn null_space(a: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    let n = a.ncols();
    if n == 0 {
        return DMatrix::zeros(0, 0);
    }
    if a.nrows() == 0 {
        return DMatrix::identity(n, n);
    }
    let qr = ColPivQR::new(a.clone());
    let r = qr.r();
    let pivots: Vec<f64> = (0..r.nrows()).map(|k| r[(k, k)].abs()).collect();
    let largest = pivots.iter().copied().fold(0.0, f64::max);
    let rank = pivots.iter().filter(|&&p| p > tolerance * largest).count();
    let mut basis = DMatrix::zeros(n, n - rank);
    let mut dependent = -r.view((0, rank), (rank, n - rank)).into_owned();
    r.view((0, 0), (rank, rank)).solve_upper_triangular_mut(&mut dependent);
    basis.rows_mut(0, rank).copy_from(&dependent);
    basis.rows_mut(rank, n - rank).fill_with_identity();
    qr.p().inv_permute_rows(&mut basis);
    if basis.ncols() == 0 { basis } else { basis.qr().q() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_orthonormal_and_annihilated() {
        let a = DMatrix::from_row_slice(
            3,
            5,
            &[
                1.0, 2.0, 3.0, 4.0, 5.0, //
                0.0, 1.0, -1.0, 2.0, 0.5, //
                1.0, 3.0, 2.0, 6.0, 5.5,
            ],
        );
        let n = null_space(&a, 1e-9);
        assert_eq!(n.shape(), (5, 3));
        assert!((&a * &n).amax() < 1e-14);
        assert!((n.transpose() * &n - DMatrix::identity(3, 3)).amax() < 1e-14);
    }

    #[test]
    fn a_regular_matrix_has_none_and_an_empty_one_has_all() {
        assert_eq!(null_space(&DMatrix::identity(3, 3), 1e-9).ncols(), 0);
        assert_eq!(null_space(&DMatrix::zeros(0, 2), 1e-9).ncols(), 2);
        assert_eq!(null_space(&DMatrix::zeros(2, 2), 1e-9).ncols(), 2);
    }
}

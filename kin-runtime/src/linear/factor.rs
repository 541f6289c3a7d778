//! Least-norm least-squares solution of A x = b, by LU where A is square and well conditioned, otherwise by a complete
//! orthogonal decomposition.
//!
//! The pivots of a sparse LU factorisation do not reveal the rank. They are therefore compared with the pivots of a
//! column-pivoted QR factorisation of the n×n matrix B = A D: its last pivot is the smallest, and its inverse is the
//! 2-norm of a row of B⁻¹; its first pivot is the largest, and is the 2-norm of a column of B. So the ratio of the
//! smallest to the largest pivot is at least 1 / (c r), with the largest of these norms, c and r, and this is at least
//! 1 / (√n ‖B‖₁ ‖B⁻¹‖₁). Where the bound is far above the tolerance, the rank is n and no rank-revealing factorisation
//! is needed. The second bound costs nothing, because the condition number is reported anyway; the first is sharper for
//! large matrices, and is computed where the second does not decide.
//!
//! Rank and conditioning refer to A D, with columns on the common scale; "least norm" is the Euclidean norm of x
//! itself. With the column-pivoted A D P = Q R of rank r, the leading r rows T = R P^T D⁻¹ give T x = (Qᵀ b)₁…ᵣ, and
//! the QR factorisation Tᵀ = Z U gives x = Z U⁻ᵀ (Qᵀ b)₁…ᵣ.

use super::inverse_norm::{Inverse, inverse_norm};
use super::sparse::NumericLu;
use nalgebra::{ColPivQR, DMatrix, DVector, Dyn, LU};

/// Smallest ratio of LU pivots at which the LU factorisation is used.
const LU_TRUST: f64 = 1e-5;
/// Safety factor between the estimated condition number and 1 / tolerance at which the rank counts as full. It exceeds
/// the largest error of the estimate.
const RANK_TRUST: f64 = 10.0;

/// A factorised matrix.
#[derive(Clone, Debug)]
pub(crate) struct Factorization {
    kind: FactorKind,
    columns: Vec<f64>,
    /// The numerical rank.
    pub(crate) rank: usize,
    /// An estimate of the condition number of A D: ‖A D‖₁ ‖(A D)⁻¹‖₁ if A D is square and its rank was determined and
    /// is full; otherwise the ratio of the largest to the smallest pivot within the rank.
    pub(crate) condition: f64,
    /// The ratio of the largest to the smallest of all pivots; infinite where the matrix is exactly rank-deficient.
    pub(crate) full_condition: f64,
}

#[derive(Clone, Debug)]
enum FactorKind {
    Sparse(Box<NumericLu>),
    Lu(LU<f64, Dyn, Dyn>),
    /// Rank equal to the number of columns: the QR factorisation and R.
    Tall(ColPivQR<f64, Dyn, Dyn>, DMatrix<f64>),
    /// Rank below the number of columns: the QR factorisation, Z (n×r) and U (r×r).
    Wide(ColPivQR<f64, Dyn, Dyn>, DMatrix<f64>, DMatrix<f64>),
}

impl Factorization {
    /// From the sparse LU of A D, without determining the rank; `None` where the ratio of its pivots is too small.
    pub(crate) fn sparse_quick(lu: Box<NumericLu>, columns: Vec<f64>) -> Option<Self> {
        let (smallest, largest) = lu.pivot_range();
        (smallest > LU_TRUST * largest).then(|| Self::sparse(lu, columns, largest / smallest))
    }

    /// From the sparse LU of A D, if its estimated condition number proves full rank, also in the sense of
    /// [`absolute`](Self::absolute); `None` otherwise.
    pub(crate) fn sparse_of_full_rank(mut lu: Box<NumericLu>, columns: Vec<f64>, tolerance: f64) -> Option<Self> {
        let (norm, inverse) = lu.norms();
        let doubt = RANK_TRUST * (columns.len() as f64).sqrt() * norm.max(1.0) * inverse * tolerance;
        let no_doubt = doubt < 1.0 || {
            let (column, row) = lu.largest_norms();
            RANK_TRUST * column.max(1.0) * row * tolerance < 1.0
        };
        no_doubt.then(|| Self::sparse(lu, columns, norm * inverse))
    }

    fn sparse(lu: Box<NumericLu>, columns: Vec<f64>, condition: f64) -> Self {
        let rank = columns.len();
        Self { kind: FactorKind::Sparse(lu), columns, rank, condition, full_condition: condition }
    }

    /// Returns the buffers of the sparse LU and of the columns for reuse.
    pub(crate) fn into_buffers(self) -> (Box<NumericLu>, Vec<f64>) {
        match self.kind {
            FactorKind::Sparse(lu) => (lu, self.columns),
            _ => (Box::default(), self.columns),
        }
    }

    /// Whether the determinant of a square matrix is positive; `None` where the factorisation does not give its sign.
    pub(crate) fn is_positive(&self) -> Option<bool> {
        match &self.kind {
            FactorKind::Sparse(lu) => Some(lu.is_positive()),
            _ => None,
        }
    }

    /// LU where its pivots are large enough, otherwise [`revealing`](Self::revealing).
    ///
    /// The rows of `a` are on the common scale; `columns` is D.
    pub(crate) fn quick(a: &DMatrix<f64>, columns: &[f64], tolerance: f64) -> Self {
        if a.is_square() && !a.is_empty() {
            let lu = LU::new(scale_columns(a.clone(), columns));
            let (smallest, largest) = smallest_and_largest(lu.u().diagonal().as_slice());
            if smallest > LU_TRUST * largest {
                let condition = largest / smallest;
                let kind = FactorKind::Lu(lu);
                let columns = columns.to_vec();
                return Self { kind, columns, rank: a.ncols(), condition, full_condition: condition };
            }
        }
        Self::revealing(a, columns, tolerance)
    }

    /// Complete orthogonal decomposition, in which pivots below `tolerance` times the largest count as zero.
    pub(crate) fn revealing(a: &DMatrix<f64>, columns: &[f64], tolerance: f64) -> Self {
        Self::orthogonal(a, columns, tolerance, 0.0)
    }

    /// As [`revealing`](Self::revealing), for a scale computed at this configuration: pivots below `tolerance` count as
    /// zero as well, so that a matrix whose entries are all small has rank zero.
    pub(crate) fn absolute(a: &DMatrix<f64>, columns: &[f64], tolerance: f64) -> Self {
        Self::orthogonal(a, columns, tolerance, 1.0)
    }

    /// Pivots below `tolerance` times the larger of `unit` and the largest pivot count as zero.
    fn orthogonal(a: &DMatrix<f64>, columns: &[f64], tolerance: f64, unit: f64) -> Self {
        let qr = ColPivQR::new(scale_columns(a.clone(), columns));
        let r = qr.r();
        let pivots: Vec<f64> = (0..r.nrows().min(r.ncols())).map(|k| r[(k, k)].abs()).collect();
        let (_, largest) = smallest_and_largest(&pivots);
        let counts = |p: f64| p > tolerance * largest.max(unit);
        let rank = pivots.iter().filter(|&&p| counts(p)).count();
        let counted = pivots.iter().copied().filter(|&p| counts(p)).fold(f64::INFINITY, f64::min);
        let smallest = pivots.iter().copied().fold(f64::INFINITY, f64::min);
        let ratio = |large: f64, small: f64| if pivots.is_empty() { 1.0 } else { large / small };
        let condition = match rank {
            0 => 1.0,
            _ if rank == a.nrows() && rank == a.ncols() => {
                one_norm(&scale_columns(a.clone(), columns)) * inverse_of_qr(&qr, &r)
            }
            _ => ratio(largest, counted),
        };
        let full_condition = ratio(largest.max(unit), smallest);
        let kind = if rank == a.ncols() {
            FactorKind::Tall(qr, r)
        } else {
            let mut leading = r.rows(0, rank).into_owned();
            qr.p().inv_permute_columns(&mut leading);
            for (mut column, &d) in leading.column_iter_mut().zip(columns) {
                column /= d;
            }
            let second = leading.transpose().qr();
            FactorKind::Wide(qr, second.q(), second.r())
        };
        Self { kind, columns: columns.to_vec(), rank, condition, full_condition }
    }

    /// The x of least norm among those that minimise |A x − b|.
    pub(crate) fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        match &self.kind {
            FactorKind::Sparse(lu) => self.unscaled(DVector::from_vec(lu.solve(b.as_slice()))),
            FactorKind::Lu(lu) => {
                let mut y = b.clone();
                lu.solve_mut(&mut y);
                self.unscaled(y)
            }
            FactorKind::Tall(qr, r) => {
                let mut right = b.clone();
                qr.q_tr_mul(&mut right);
                let mut x = right.rows(0, self.rank).into_owned();
                r.view((0, 0), (self.rank, self.rank)).solve_upper_triangular_mut(&mut x);
                qr.p().inv_permute_rows(&mut x);
                self.unscaled(x)
            }
            FactorKind::Wide(qr, z, u) => {
                let mut right = b.clone();
                qr.q_tr_mul(&mut right);
                let mut x = right.rows(0, self.rank).into_owned();
                u.tr_solve_upper_triangular_mut(&mut x);
                z * x
            }
        }
    }

    /// D y.
    fn unscaled(&self, mut y: DVector<f64>) -> DVector<f64> {
        y.iter_mut().zip(&self.columns).for_each(|(x, d)| *x *= d);
        y
    }
}

/// A D, where D is the diagonal matrix of the factors of the columns.
pub(crate) fn scale_columns(mut a: DMatrix<f64>, columns: &[f64]) -> DMatrix<f64> {
    for (mut column, &d) in a.column_iter_mut().zip(columns) {
        column *= d;
    }
    a
}

/// ‖A‖₁.
fn one_norm(a: &DMatrix<f64>) -> f64 {
    a.column_iter().map(|column| column.lp_norm(1)).fold(0.0, f64::max)
}

/// An estimate of ‖A⁻¹‖₁, where A P = Q R is square and regular.
fn inverse_of_qr(qr: &ColPivQR<f64, Dyn, Dyn>, r: &DMatrix<f64>) -> f64 {
    inverse_norm(&Orthogonal { q: qr.q(), r }, &mut vec![0.0; 4 * r.nrows()])
}

/// The factorisation Q R. A⁻¹ = P R⁻¹ Qᵀ, and the permutation P does not change the norm.
struct Orthogonal<'r> {
    q: DMatrix<f64>,
    r: &'r DMatrix<f64>,
}

impl Inverse for Orthogonal<'_> {
    fn solve<const W: usize>(&self, x: &mut [f64]) {
        let mut y = self.q.tr_mul(&DMatrix::from_row_slice(x.len() / W, W, x));
        self.r.solve_upper_triangular_mut(&mut y);
        x.as_chunks_mut::<W>()
            .0
            .iter_mut()
            .zip(y.row_iter())
            .for_each(|(x, y)| x.iter_mut().zip(&y).for_each(|(x, y)| *x = *y));
    }

    fn solve_transposed(&self, x: &mut [f64]) {
        let mut y = DVector::from_column_slice(x);
        self.r.tr_solve_upper_triangular_mut(&mut y);
        x.copy_from_slice((&self.q * y).as_slice());
    }
}

/// The smallest and the largest absolute value.
fn smallest_and_largest(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, 0.0), |(low, high), v| (f64::min(low, v.abs()), f64::max(high, v.abs())))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least-norm x from the normal equations of the second kind, A Aᵀ y = b and x = Aᵀ y, for full row rank.
    fn least_norm(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
        let gram = a * a.transpose();
        a.transpose() * gram.lu().solve(b).unwrap()
    }

    #[test]
    fn square_systems_agree_by_both_ways() {
        let a = DMatrix::from_row_slice(3, 3, &[4.0, 1.0, 0.5, -2.0, 3.0, 1.0, 0.1, 0.2, -5.0]);
        let b = DVector::from_vec(vec![1.0, 2.0, 3.0]);
        let d = [1.0, 10.0, 0.1];
        let lu = Factorization::quick(&a, &d, 1e-8);
        let qr = Factorization::revealing(&a, &d, 1e-8);
        assert_eq!((lu.rank, qr.rank), (3, 3));
        for x in [lu.solve(&b), qr.solve(&b)] {
            assert!((&a * x - &b).amax() < 1e-14);
        }
    }

    #[test]
    fn column_scales_do_not_change_the_least_norm_solution() {
        let a = DMatrix::from_row_slice(2, 4, &[1.0, 2.0, 0.0, -1.0, 0.5, 0.0, 3.0, 1.0]);
        let b = DVector::from_vec(vec![1.0, -2.0]);
        let expected = least_norm(&a, &b);
        for d in [[1.0; 4], [1.0, 0.01, 5.0, 300.0]] {
            let found = Factorization::revealing(&a, &d, 1e-10);
            assert_eq!(found.rank, 2);
            assert!((found.solve(&b) - &expected).amax() < 1e-13);
        }
    }

    #[test]
    fn repeated_rows_are_counted_once_and_solved() {
        let a = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 3.0, 0.0, 1.0, 1.0, 1.0, 3.0, 4.0]);
        let b = DVector::from_vec(vec![6.0, 2.0, 8.0]);
        let found = Factorization::quick(&a, &[1.0; 3], 1e-8);
        assert_eq!(found.rank, 2);
        assert!(found.full_condition > 1e12);
        let x = found.solve(&b);
        assert!((&a * &x - b).amax() < 1e-13);
        assert!((x - least_norm(&a.rows(0, 2).into_owned(), &DVector::from_vec(vec![6.0, 2.0]))).amax() < 1e-13);
    }

    #[test]
    fn a_zero_matrix_has_rank_zero_and_the_zero_solution() {
        let found = Factorization::quick(&DMatrix::zeros(2, 2), &[1.0; 2], 1e-8);
        assert_eq!(found.rank, 0);
        assert_eq!(found.solve(&DVector::from_vec(vec![1.0, 1.0])), DVector::zeros(2));
    }

    #[test]
    fn more_rows_than_columns_are_solved_in_the_least_squares_sense() {
        let a = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 1.0, 1.0, 1.0, 2.0]);
        let b = DVector::from_vec(vec![1.0, 0.0, 2.0]);
        let x = Factorization::quick(&a, &[1.0; 2], 1e-8).solve(&b);
        assert!((a.transpose() * (&a * x - b)).amax() < 1e-14);
    }
}

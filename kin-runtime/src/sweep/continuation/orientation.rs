//! The orientation of a branch: the sign of a determinant that cannot change without passing a singular configuration.
//!
//! For a square regular Φ_q this is the determinant of Φ_q. With redundant rows it is the determinant of a set of
//! independent rows. With degrees of freedom left, the matrix is bordered by the null vectors of one configuration, so
//! that the next configuration nearby is compared using the same border.

use crate::equations::Equations;
use crate::linear::{Factorization, independent_rows, null_space, positive_determinant};
use nalgebra::{DMatrix, DVector, SVD, Schur};

/// Largest number of rounds of the QR algorithm for every eigenvalue or singular value; usually two or three suffice.
const ROUNDS: usize = 30;

/// True if Φ_q certainly keeps its rank on the straight line from an earlier one, factorised as `before`, to the one evaluated
/// last: all eigenvalues of Φ_q(before)⁺ Φ_q have positive real parts on the row space of Φ_q(before). Where two pairs of
/// solutions meet at once, two eigenvalues change their signs, but the determinant does not.
pub(crate) fn stays_regular(equations: &Equations<'_>, before: &Factorization) -> bool {
    let (s, n, rank) = (equations.rows(), equations.coordinates(), before.rank);
    let columns = &equations.scale.columns;
    let all: Vec<usize> = (0..s).collect();
    let now = equations.scaled(&all);
    // Φ_q(before)⁺ of a matrix, on the common scale.
    let solved = |right: &DMatrix<f64>| {
        let mut solution = DMatrix::zeros(n, right.ncols());
        for (k, column) in right.column_iter().enumerate() {
            let found = before.solve(&column.into_owned());
            solution.set_column(k, &DVector::from_iterator(n, found.iter().zip(columns).map(|(x, d)| x / d)));
        }
        solution
    };
    let mut ratio = solved(&now);
    if rank < n {
        // The columns of Φ_q(before)⁺ span the row space.
        let Some(space) =
            SVD::try_new(solved(&DMatrix::identity(s, s)), true, false, f64::EPSILON, ROUNDS * n).and_then(|svd| svd.u)
        else {
            return false;
        };
        let basis = space.columns(0, rank.min(space.ncols())).into_owned();
        ratio = basis.transpose() * ratio * &basis;
    }
    if !ratio.iter().all(|x| x.is_finite()) {
        return false;
    }
    let size = ratio.nrows();
    // By this norm no eigenvalue is farther from 1 than 1.
    let off = DMatrix::identity(size, size) - &ratio;
    if off.row_iter().all(|row| row.iter().map(|x| x.abs()).sum::<f64>() < 1.0) {
        return true;
    }
    let schur = Schur::try_new(ratio, f64::EPSILON, ROUNDS * size);
    schur.is_some_and(|schur| schur.complex_eigenvalues().iter().all(|eigenvalue| eigenvalue.re > 0.0))
}

/// Smallest relative pivot of an LU factorisation at which the sign of the determinant is above rounding.
const SIGN_TRUST: f64 = 1e-12;

/// The determinant that identifies the branch, and its sign.
#[derive(Clone, Debug)]
pub(crate) struct Orientation {
    /// The rows and border that form the matrix; `None` where the matrix is Φ_q itself.
    chosen: Option<BorderedRows>,
    positive: bool,
}

/// A matrix built from selected rows of Φ_q and bordering null vectors.
#[derive(Clone, Debug)]
struct BorderedRows {
    rows: Vec<usize>,
    border: DMatrix<f64>,
}

impl Orientation {
    /// The orientation at the configuration at which Φ_q was last evaluated and factorised as `factor`; `None` where
    /// that configuration is singular.
    pub(crate) fn here(equations: &Equations<'_>, factor: &Factorization) -> Option<Self> {
        let (s, n, rank) = (equations.rows(), equations.coordinates(), factor.rank);
        let mut orientation = Self { chosen: None, positive: true };
        if rank < n || s > n {
            let all: Vec<usize> = (0..s).collect();
            let matrix = equations.scaled(&all);
            let rows = if rank == s { all } else { independent_rows(&matrix, rank) };
            let border = null_space(&equations.scaled(&rows), equations.options.rank_tolerance).transpose();
            orientation.chosen = Some(BorderedRows { rows, border });
        }
        orientation.positive = orientation.sign(equations, factor)?;
        Some(orientation)
    }

    /// Writes to `to` the orientation at a neighbouring configuration, at which Φ_q was last evaluated and factorised
    /// as `factor`. Returns false if the sign of the determinant differs.
    pub(crate) fn keep(&self, equations: &Equations<'_>, factor: &Factorization, to: &mut Self) -> bool {
        if self.sign(equations, factor) != Some(self.positive) {
            return false;
        }
        // The matrix is Φ_q itself, so no rows or border have to be chosen again.
        let orientation = if self.chosen.is_none() { Some(self.clone()) } else { Self::here(equations, factor) };
        orientation.is_some_and(|orientation| {
            *to = orientation;
            true
        })
    }

    /// Whether the determinant is positive; `None` where it vanishes or the bordered matrix is not square.
    fn sign(&self, equations: &Equations<'_>, factor: &Factorization) -> Option<bool> {
        let n = equations.coordinates();
        if n == 0 {
            return Some(true);
        }
        let Some(BorderedRows { rows, border }) = &self.chosen else {
            let dense = || {
                let rows: Vec<usize> = (0..n).collect();
                positive_determinant(&mut equations.scaled(&rows), SIGN_TRUST)
            };
            return factor.is_positive().or_else(dense);
        };
        if rows.len() + border.nrows() != n {
            return None;
        }
        let mut matrix = DMatrix::zeros(n, n);
        matrix.rows_mut(0, rows.len()).copy_from(&equations.scaled(rows));
        matrix.rows_mut(rows.len(), border.nrows()).copy_from(border);
        positive_determinant(&mut matrix, SIGN_TRUST)
    }
}

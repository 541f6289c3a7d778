//! The orientation of a branch: the sign of a determinant that cannot change without passing a singular configuration.
//!
//! For a square regular Φ_q it is its own determinant. With redundant rows it is that of independent rows; with degrees
//! of freedom left, the null vectors of one configuration border the matrix, so that the next one nearby is compared
//! with it.

use crate::equations::Equations;
use crate::linear::{independent_rows, null_space, positive_determinant};
use nalgebra::DMatrix;

/// Smallest relative LU pivot of a determinant whose sign means something.
const SIGN_TRUST: f64 = 1e-12;

/// Which rows and bordering vectors make up the determinant, and its sign.
#[derive(Clone, Debug)]
pub(crate) struct Orientation {
    rows: Vec<usize>,
    border: DMatrix<f64>,
    positive: bool,
}

impl Orientation {
    /// The orientation at the configuration whose Φ_q was evaluated last; none where it is singular.
    pub(crate) fn here(equations: &Equations<'_>, rank: usize) -> Option<Self> {
        let all: Vec<usize> = (0..equations.rows()).collect();
        let n = equations.coordinates();
        let (rows, border) = if rank == n && all.len() == n {
            (all, DMatrix::zeros(0, n))
        } else {
            let matrix = equations.scaled(&all);
            let rows = if rank == all.len() { all } else { independent_rows(&matrix, rank) };
            let border = null_space(&equations.scaled(&rows), equations.options.rank_tolerance).transpose();
            (rows, border)
        };
        let mut orientation = Self { rows, border, positive: true };
        orientation.positive = orientation.sign(equations)?;
        Some(orientation)
    }

    /// The orientation at the configuration whose Φ_q was evaluated last, a little further on, if it is oriented alike.
    pub(crate) fn kept(&self, equations: &Equations<'_>, rank: usize) -> Option<Self> {
        if self.sign(equations) != Some(self.positive) {
            return None;
        }
        // All rows and no border: there is nothing to choose anew.
        let n = equations.coordinates();
        if rank == n && equations.rows() == n { Some(self.clone()) } else { Self::here(equations, rank) }
    }

    /// True for a positive determinant; none for a vanishing one or one that is not square.
    fn sign(&self, equations: &Equations<'_>) -> Option<bool> {
        let n = equations.coordinates();
        if n == 0 {
            return Some(true);
        }
        if self.rows.len() + self.border.nrows() != n {
            return None;
        }
        if self.border.nrows() == 0 {
            return positive_determinant(&mut equations.scaled(&self.rows), SIGN_TRUST);
        }
        let mut matrix = DMatrix::zeros(n, n);
        matrix.rows_mut(0, self.rows.len()).copy_from(&equations.scaled(&self.rows));
        matrix.rows_mut(self.rows.len(), self.border.nrows()).copy_from(&self.border);
        positive_determinant(&mut matrix, SIGN_TRUST)
    }
}

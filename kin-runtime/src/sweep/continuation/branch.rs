//! The orientation of a branch: the sign of a determinant that cannot change without passing a singular configuration.
//!
//! For a square regular Φ_q it is its own determinant. With redundant rows it is that of independent rows; with degrees
//! of freedom left, the null vectors of one configuration border the matrix, so that the next one nearby is compared
//! with it.

use crate::equations::Equations;
use crate::linear::{Factorization, independent_rows, null_space, positive_determinant};
use nalgebra::DMatrix;

/// Smallest relative LU pivot of a determinant whose sign means something.
const SIGN_TRUST: f64 = 1e-12;

/// Which determinant it is, and its sign.
#[derive(Clone, Debug)]
pub(crate) struct Orientation {
    /// What makes it up where it is not that of Φ_q itself.
    chosen: Option<Chosen>,
    positive: bool,
}

/// Some rows, and bordering vectors.
#[derive(Clone, Debug)]
struct Chosen {
    rows: Vec<usize>,
    border: DMatrix<f64>,
}

impl Orientation {
    /// The orientation at the configuration whose Φ_q was evaluated last and has the factorisation `factor`; none where it
    /// is singular.
    pub(crate) fn here(equations: &Equations<'_>, factor: &Factorization) -> Option<Self> {
        let (s, n, rank) = (equations.rows(), equations.coordinates(), factor.rank);
        let mut orientation = Self { chosen: None, positive: true };
        if rank < n || s > n {
            let all: Vec<usize> = (0..s).collect();
            let matrix = equations.scaled(&all);
            let rows = if rank == s { all } else { independent_rows(&matrix, rank) };
            let border = null_space(&equations.scaled(&rows), equations.options.rank_tolerance).transpose();
            orientation.chosen = Some(Chosen { rows, border });
        }
        orientation.positive = orientation.sign(equations, factor)?;
        Some(orientation)
    }

    /// Writes to `to` the orientation at the configuration whose Φ_q was evaluated last and has the factorisation `factor`,
    /// a little further on; false where it is not oriented alike.
    pub(crate) fn keep(&self, equations: &Equations<'_>, factor: &Factorization, to: &mut Self) -> bool {
        if self.sign(equations, factor) != Some(self.positive) {
            return false;
        }
        // The determinant of Φ_q itself: there is nothing to choose anew.
        let here = if self.chosen.is_none() { Some(self.clone()) } else { Self::here(equations, factor) };
        here.is_some_and(|here| {
            *to = here;
            true
        })
    }

    /// True for a positive determinant; none for a vanishing one or one that is not square.
    fn sign(&self, equations: &Equations<'_>, factor: &Factorization) -> Option<bool> {
        let n = equations.coordinates();
        if n == 0 {
            return Some(true);
        }
        let Some(Chosen { rows, border }) = &self.chosen else {
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

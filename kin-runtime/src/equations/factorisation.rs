//! Φ_q of the equations at hand, factorised: by elimination in its fixed pattern where that leaves no doubt, otherwise
//! densely and with its rank revealed.
//!
//! The sparse elimination is for as many rows as coordinates. It is given up, and nalgebra decides, where a multiplier
//! grows too large in any order; for solutions, where its smallest pivot is small beside the largest; where the rank is
//! asked for, too, where the estimated condition number does not say for sure that it is full (see [`Factorization`]). So
//! what is reported of rank and singular configurations is what the dense factorisation says.

use crate::equations::Equations;
use crate::linear::{Elimination, Factorization, Ordered};

/// What is wanted of a factorisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Solutions; rank and condition only where they are in doubt.
    Solutions,
    /// Also the rank, by pivots relative to the largest.
    Rank,
    /// Also the rank, by pivots relative to the largest or to 1: for a scale taken at this very configuration.
    AbsoluteRank,
}

impl Equations<'_> {
    /// Factorises Φ_q as evaluated last, all rows; the memory of an earlier factorisation is used again.
    pub(crate) fn factorise(&mut self, wanted: Wanted, memory: Option<Factorization>) -> Factorization {
        if let Some(found) = self.factorise_sparse(wanted, memory) {
            return found;
        }
        let rows: Vec<usize> = (0..self.rows()).collect();
        let (matrix, columns) = (self.scaled_rows(&rows), &self.scale.columns);
        let tolerance = self.options.rank_tolerance;
        match wanted {
            Wanted::Solutions => Factorization::quick(&matrix, columns, tolerance),
            Wanted::Rank => Factorization::revealing(&matrix, columns, tolerance),
            Wanted::AbsoluteRank => Factorization::absolute(&matrix, columns, tolerance),
        }
    }

    /// [`factorise`](Self::factorise), but none where only a dense factorisation will do.
    pub(crate) fn factorise_sparse(&mut self, wanted: Wanted, memory: Option<Factorization>) -> Option<Factorization> {
        if !self.options.use_sparse || self.rows() != self.coordinates() || self.rows() == 0 {
            return None;
        }
        let (mut elimination, mut sizes) = memory.map_or_else(Default::default, Factorization::into_memory);
        let (rows, columns) = (&self.scale.rows, &self.scale.columns);
        sizes.clone_from(columns);
        let entries = self.ordered.entries().iter().zip(&self.phi_q);
        elimination.values.clear();
        elimination.values.extend(entries.map(|(&(row, column), value)| value * rows[row] * columns[column]));
        if !self.ordered.factorise(&mut elimination) {
            return None;
        }
        match wanted {
            Wanted::Solutions => Factorization::sparse_quick(elimination, sizes),
            _ => Factorization::sparse_of_full_rank(elimination, sizes, self.options.rank_tolerance),
        }
    }

    /// As many of the rows of Φ_q as of its columns, for solutions, given the places of their entries among all and among
    /// themselves, and the sizes of these columns; none where only a dense factorisation will do.
    pub(crate) fn factorise_part(
        &self,
        places: &[usize],
        ordered: &mut Ordered,
        rows: &[usize],
        sizes: &[f64],
    ) -> Option<Factorization> {
        if !self.options.use_sparse || rows.is_empty() {
            return None;
        }
        let mut elimination = Box::<Elimination>::default();
        let entries = places.iter().zip(ordered.entries());
        let value =
            |(&place, &(i, j)): (&usize, &(usize, usize))| self.phi_q[place] * self.scale.rows[rows[i]] * sizes[j];
        elimination.values.extend(entries.map(value));
        ordered.factorise(&mut elimination).then(|| Factorization::sparse_quick(elimination, sizes.to_vec()))?
    }

    /// Φ_q x, with Φ_q as evaluated last.
    pub(crate) fn times(&self, x: &[f64]) -> nalgebra::DVector<f64> {
        let mut product = nalgebra::DVector::zeros(self.rows());
        self.entries().for_each(|((row, column), value)| product[row] += value * x[column]);
        product
    }
}

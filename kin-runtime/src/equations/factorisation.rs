//! Factorisation of Φ_q: sparse with a fixed pattern where that proves full rank, otherwise dense and rank-revealing.
//!
//! The sparse LU applies where there are as many rows as coordinates. The dense factorisation by nalgebra replaces it
//! where a multiplier is too large in every order of elimination; where the smallest pivot is small compared with the
//! largest; and, if the rank is requested, where the estimated condition number does not prove full rank (see
//! [`Factorization`]). So everything that is reported about rank and singular configurations comes from the dense
//! factorisation.

use crate::equations::Equations;
use crate::linear::{Factorization, NumericLu, Ordered};

/// What a factorisation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Solutions; the rank only where it is in doubt.
    Solutions,
    /// Solutions and the rank, by pivots relative to the largest.
    Rank,
    /// Solutions and the rank, by pivots relative to the largest or to 1, for a scale computed at this configuration.
    AbsoluteRank,
}

impl Equations<'_> {
    /// Factorises all rows of Φ_q as evaluated last; the buffers of an earlier factorisation are reused.
    pub(crate) fn factorise(&mut self, purpose: Purpose, memory: Option<Factorization>) -> Factorization {
        if let Some(found) = self.factorise_sparse(purpose, memory) {
            return found;
        }
        let rows: Vec<usize> = (0..self.rows()).collect();
        let (matrix, columns) = (self.scaled_rows(&rows), &self.scale.columns);
        let tolerance = self.options.rank_tolerance;
        match purpose {
            Purpose::Solutions => Factorization::quick(&matrix, columns, tolerance),
            Purpose::Rank => Factorization::revealing(&matrix, columns, tolerance),
            Purpose::AbsoluteRank => Factorization::absolute(&matrix, columns, tolerance),
        }
    }

    /// As [`factorise`](Self::factorise), but `None` where only a dense factorisation is possible.
    pub(crate) fn factorise_sparse(
        &mut self,
        purpose: Purpose,
        memory: Option<Factorization>,
    ) -> Option<Factorization> {
        if !self.options.use_sparse || self.rows() != self.coordinates() || self.rows() == 0 {
            return None;
        }
        let (mut lu, mut sizes) = memory.map_or_else(Default::default, Factorization::into_buffers);
        let (rows, columns) = (&self.scale.rows, &self.scale.columns);
        sizes.clone_from(columns);
        let entries = self.ordered.entries().iter().zip(&self.phi_q);
        lu.values.clear();
        lu.values.extend(entries.map(|(&(row, column), value)| value * rows[row] * columns[column]));
        if !self.ordered.factorise(&mut lu) {
            return None;
        }
        match purpose {
            Purpose::Solutions => Factorization::sparse_quick(lu, sizes),
            _ => Factorization::sparse_of_full_rank(lu, sizes, self.options.rank_tolerance),
        }
    }

    /// Factorises a square part of Φ_q for solutions; `None` where only a dense factorisation is possible. `places` are
    /// the indices of its entries among all entries, `ordered` is its own pattern, and `sizes` are the scales of its
    /// columns.
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
        let mut lu = Box::<NumericLu>::default();
        let entries = places.iter().zip(ordered.entries());
        let value =
            |(&index, &(i, j)): (&usize, &(usize, usize))| self.phi_q[index] * self.scale.rows[rows[i]] * sizes[j];
        lu.values.extend(entries.map(value));
        ordered.factorise(&mut lu).then(|| Factorization::sparse_quick(lu, sizes.to_vec()))?
    }

    /// The product Φ_q x, with Φ_q as evaluated last.
    pub(crate) fn times(&self, x: &[f64]) -> nalgebra::DVector<f64> {
        let mut product = nalgebra::DVector::zeros(self.rows());
        self.entries().for_each(|((row, column), value)| product[row] += value * x[column]);
        product
    }
}

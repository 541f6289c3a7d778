//! Pivots of large matrices by faer: columns in an order that keeps the fill small (COLAMD), rows by partial pivoting.

use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{NumericLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMat, Triplet};

/// The size from which on faer's order pays: below it, Markowitz' search is over sooner.
pub(super) const LARGE: usize = 200;

/// Row and column of every pivot of the n×n matrix with these entries and their values; none where it is singular.
pub(super) fn pivots(n: usize, entries: &[(usize, usize)], values: &[f64]) -> Option<Vec<(usize, usize)>> {
    let triplet = |(&(row, column), &value): (&(usize, usize), &f64)| Triplet::new(row, column, value);
    let triplets: Vec<_> = entries.iter().zip(values).map(triplet).collect();
    let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets).ok()?;
    let symbolic = factorize_symbolic_lu(matrix.symbolic(), Default::default()).ok()?;
    let mut memory = MemBuffer::new(symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default()));
    let (mut numeric, stack) = (NumericLu::new(), MemStack::new(&mut memory));
    let lu = symbolic.factorize_numeric_lu(&mut numeric, matrix.as_ref(), Par::Seq, stack, Default::default()).ok()?;
    let (rows, columns) = (lu.row_perm().arrays().0, lu.col_perm().arrays().0);
    Some(rows.iter().copied().zip(columns.iter().copied()).collect())
}

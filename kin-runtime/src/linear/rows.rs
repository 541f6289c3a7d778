//! Linear dependencies among the rows of a matrix.

use nalgebra::{ColPivQR, DMatrix, DVector};

/// A row that is a linear combination of rows before it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dependency {
    /// Index of the dependent row.
    pub(crate) row: usize,
    /// The terms of row = Σ factor · earlier row, without negligible factors.
    pub(crate) combination: Vec<(usize, f64)>,
}

/// Finds the rows that depend on earlier rows (modified Gram–Schmidt, applied twice).
///
/// The rows are on the common scale. A row is dependent if its remainder is below `tolerance` times the larger of 1 and
/// the length of the longest row, as in the determination of the rank. The length of the row itself does not enter, so
/// that a row that contains only rounding errors counts as dependent; its combination is empty, since it is that short
/// before anything is subtracted.
pub(crate) fn dependencies(a: &DMatrix<f64>, tolerance: f64) -> Vec<Dependency> {
    let longest = a.row_iter().map(|row| row.norm()).fold(1.0, f64::max);
    let negligible = tolerance * longest;
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut independent: Vec<usize> = Vec::new();
    // Element k expresses basis vector k as a combination of the kept rows.
    let mut origins: Vec<Vec<f64>> = Vec::new();
    let mut found = Vec::new();
    for row in 0..a.nrows() {
        let mut rest: DVector<f64> = a.row(row).transpose();
        let size = rest.norm();
        let mut projections = vec![0.0; basis.len()];
        for _ in 0..2 {
            for (projection, vector) in projections.iter_mut().zip(&basis) {
                let part = rest.dot(vector);
                rest.axpy(-part, vector, 1.0);
                *projection += part;
            }
        }
        let mut factors = vec![0.0; independent.len()];
        for (projection, origin) in projections.iter().zip(&origins) {
            factors.iter_mut().zip(origin).for_each(|(f, o)| *f += projection * o);
        }
        let remainder = rest.norm();
        if size <= negligible {
            found.push(Dependency { row, combination: Vec::new() });
        } else if remainder <= negligible {
            let largest = factors.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let combination =
                independent.iter().copied().zip(factors).filter(|(_, f)| f.abs() > 1e-6 * largest).collect();
            found.push(Dependency { row, combination });
        } else {
            let mut origin: Vec<f64> = factors.iter().map(|f| -f / remainder).collect();
            origin.push(1.0 / remainder);
            basis.push(rest / remainder);
            independent.push(row);
            origins.push(origin);
        }
    }
    found
}

/// Indices of `count` rows, sorted, that a column-pivoted factorisation of Aᵀ finds most independent of one another.
pub(crate) fn independent_rows(a: &DMatrix<f64>, count: usize) -> Vec<usize> {
    let mut order = DMatrix::from_fn(1, a.nrows(), |_, j| j as f64);
    if a.ncols() > 0 && a.nrows() > 0 {
        ColPivQR::new(a.transpose()).p().permute_columns(&mut order);
    }
    let mut rows: Vec<usize> = order.iter().take(count).map(|&j| j as usize).collect();
    rows.sort_unstable();
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_later_row_is_named_with_its_combination() {
        let a = DMatrix::from_row_slice(4, 3, &[1.0, 0.0, 0.0, 0.0, 2.0, 1.0, 2.0, -2.0, -1.0, 0.0, 0.0, 1.0]);
        let found = dependencies(&a, 1e-9);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].row, 2);
        let [(0, first), (1, second)] = found[0].combination[..] else { panic!("{found:?}") };
        assert!((first - 2.0).abs() < 1e-12 && (second + 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_row_of_rounding_depends_on_none_and_says_nothing() {
        // Tested beside long rows, and where all rows are short.
        for size in [1.0_f64, 1e3, 1e-3] {
            let e = 1e-16 * size.max(1.0);
            let a = DMatrix::from_row_slice(4, 3, &[size, 0.0, 0.0, e, -e, 2.0 * e, 0.0, size, size, 0.0, e, -e]);
            let found = dependencies(&a, 1e-7);
            let expected = [1, 3].map(|row| Dependency { row, combination: Vec::new() });
            assert_eq!(found, expected, "{size}");
        }
    }

    #[test]
    fn independent_rows_leave_the_repeated_one_out() {
        let a = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
        let rows = independent_rows(&a, 2);
        assert!(rows == [0, 2] || rows == [1, 2]);
    }
}

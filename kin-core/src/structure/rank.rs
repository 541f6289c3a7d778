//! Sparse elimination in F_p, row by row: which rows depend on earlier ones, and with which coefficients.

use super::field::Residue;
use std::collections::BTreeSet;

/// A sparse row: entries in ascending order of columns, without zeros.
pub(super) type Row = Vec<(usize, Residue)>;

/// Adds `value` to the entry in `column`.
pub(super) fn add_to(row: &mut Row, column: usize, value: Residue) {
    match row.binary_search_by_key(&column, |(c, _)| *c) {
        Ok(index) => {
            row[index].1 = row[index].1 + value;
            if row[index].1.is_zero() {
                row.remove(index);
            }
        }
        Err(_) if value.is_zero() => {}
        Err(index) => row.insert(index, (column, value)),
    }
}

/// A row after elimination: its pivot entry is 1, and its entries in the columns of earlier pivots are 0.
#[derive(Clone, Debug)]
struct EliminatedRow {
    column: usize,
    /// How the row was formed: (row `source` − Σ factor · earlier pivot row) · `scale`.
    source: usize,
    factors: Vec<(usize, Residue)>,
    scale: Residue,
    entries: Row,
}

/// The independent rows found so far.
#[derive(Clone, Debug)]
pub(super) struct Elimination {
    pivots: Vec<EliminatedRow>,
    pivot_of: Vec<Option<usize>>,
    /// The number of entries per column, an estimate of the fill-in of a pivot there.
    weights: Vec<usize>,
    /// The row that is being reduced, in dense form.
    work: Vec<Residue>,
}

impl Elimination {
    /// An elimination without rows; `weights` gives the number of entries of each column.
    pub(super) fn new(weights: Vec<usize>) -> Self {
        let columns = weights.len();
        Self { pivots: Vec::new(), pivot_of: vec![None; columns], weights, work: vec![Residue::ZERO; columns] }
    }

    /// The number of independent rows.
    pub(super) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Adds the next row, identified by `source`. If it depends on earlier rows, fails with the coefficients of
    /// row = Σ factor · earlier row. Only columns below `last` can be pivots.
    pub(super) fn push(&mut self, source: usize, row: &Row, last: usize) -> Result<(), Vec<(usize, Residue)>> {
        let mut touched: BTreeSet<usize> = BTreeSet::new();
        let mut waiting: BTreeSet<usize> = BTreeSet::new();
        for &(column, value) in row {
            self.work[column] = value;
            touched.insert(column);
            waiting.extend(self.pivot_of[column]);
        }
        let mut factors = Vec::new();
        // A pivot row has entries only in columns of later pivots, so ascending order visits each pivot once.
        while let Some(next) = waiting.pop_first() {
            let pivot = &self.pivots[next];
            let factor = self.work[pivot.column];
            if factor.is_zero() {
                continue;
            }
            factors.push((next, factor));
            for &(column, value) in &pivot.entries {
                self.work[column] = self.work[column] - factor * value;
                touched.insert(column);
                waiting.extend(self.pivot_of[column].filter(|later| *later > next));
            }
        }
        let mut rest: Row = Vec::new();
        for column in touched {
            let value = std::mem::take(&mut self.work[column]);
            if !value.is_zero() {
                rest.push((column, value));
            }
        }
        let best = rest.iter().filter(|(c, _)| *c < last).min_by_key(|(c, _)| self.weights[*c]).copied();
        let Some((column, value)) = best else { return Err(self.sources(factors)) };
        let scale = value.inverse();
        rest.iter_mut().for_each(|(_, value)| *value = *value * scale);
        self.pivot_of[column] = Some(self.pivots.len());
        self.pivots.push(EliminatedRow { column, source, factors, scale, entries: rest });
        Ok(())
    }

    /// Expresses Σ factor · pivot row in terms of the rows that were added.
    fn sources(&self, factors: Vec<(usize, Residue)>) -> Vec<(usize, Residue)> {
        let mut of_pivot: Row = Vec::new();
        factors.into_iter().for_each(|(pivot, factor)| add_to(&mut of_pivot, pivot, factor));
        let mut found = Vec::new();
        while let Some((pivot, factor)) = of_pivot.pop() {
            let pivot = &self.pivots[pivot];
            let factor = factor * pivot.scale;
            found.push((pivot.source, factor));
            for &(earlier, part) in &pivot.factors {
                add_to(&mut of_pivot, earlier, -(factor * part));
            }
        }
        found.sort_unstable_by_key(|(source, _)| *source);
        found
    }

    /// A solution of the equations `row · (x, 1) = 0`, whose last column is that of the constants; `free` gives the
    /// values of undetermined unknowns.
    pub(super) fn solve(&self, free: impl Fn(usize) -> Residue) -> Vec<Residue> {
        let columns = self.pivot_of.len();
        let mut x: Vec<Residue> = (0..columns).map(free).collect();
        if let Some(constant) = x.last_mut() {
            *constant = Residue::ONE;
        }
        for pivot in self.pivots.iter().rev() {
            let other_entries = pivot.entries.iter().filter(|(column, _)| *column != pivot.column);
            x[pivot.column] = other_entries.fold(Residue::ZERO, |sum, &(column, value)| sum - value * x[column]);
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::super::field::Draw;
    use super::*;

    fn row(entries: &[(usize, i64)]) -> Row {
        entries.iter().map(|&(column, value)| (column, Residue::integer(value))).collect()
    }

    #[test]
    fn a_dependent_row_comes_with_its_factors() {
        let mut elimination = Elimination::new(vec![1; 3]);
        assert!(elimination.push(10, &row(&[(0, 1)]), 3).is_ok());
        assert!(elimination.push(11, &row(&[(1, 2), (2, 1)]), 3).is_ok());
        let found = elimination.push(12, &row(&[(0, 2), (1, -2), (2, -1)]), 3).unwrap_err();
        assert_eq!(found, [(10, Residue::integer(2)), (11, Residue::integer(-1))]);
        assert_eq!(elimination.push(13, &Vec::new(), 3), Err(Vec::new()));
        assert!(elimination.push(14, &row(&[(2, 1)]), 3).is_ok());
        assert_eq!(elimination.rank(), 3);
    }

    /// A random product of thin matrices has the rank of the inner dimension, and the coefficients of dependent rows
    /// are right.
    #[test]
    fn ranks_of_products_are_found() {
        let draw = Draw(3);
        for rank in 1..8 {
            let (rows, columns) = (12, 9);
            let left = |i: usize, k: usize| draw.residue(1, (i * 100 + k) as u64);
            let right = |k: usize, j: usize| draw.residue(2, (k * 100 + j) as u64);
            let matrix: Vec<Row> = (0..rows)
                .map(|i| {
                    (0..columns)
                        .map(|j| (j, (0..rank).fold(Residue::ZERO, |sum, k| sum + left(i, k) * right(k, j))))
                        .collect()
                })
                .collect();
            let mut elimination = Elimination::new(vec![0; columns]);
            for (i, row) in matrix.iter().enumerate() {
                let Err(combination) = elimination.push(i, row, columns) else { continue };
                for column in 0..columns {
                    let implied = combination.iter().fold(Residue::ZERO, |s, (k, f)| s + *f * matrix[*k][column].1);
                    assert_eq!(implied, row[column].1);
                }
            }
            assert_eq!(elimination.rank(), rank);
        }
    }

    #[test]
    fn linear_equations_are_solved() {
        // The equations x + y = 5 and x − z = 1, where z is free.
        let mut elimination = Elimination::new(vec![0, 1, 2, 0]);
        assert!(elimination.push(0, &row(&[(0, 1), (1, 1), (3, -5)]), 3).is_ok());
        assert!(elimination.push(1, &row(&[(0, 1), (2, -1), (3, -1)]), 3).is_ok());
        // An inconsistent equation is rejected.
        assert!(elimination.push(2, &row(&[(1, 1), (2, 1), (3, -7)]), 3).is_err());
        let x = elimination.solve(|k| Residue::integer(10 + k as i64));
        assert_eq!(x[0] + x[1], Residue::integer(5));
        assert_eq!(x[0] - x[2], Residue::ONE);
    }
}

//! The order of pivots in the elimination of a sparse square matrix.
//!
//! The next pivot is an entry with a small product (r − 1)(c − 1), where r and c are the numbers of remaining entries
//! in its row and column; the product bounds the fill-in. Among entries with equal products the largest is chosen. Only
//! the shortest rows are searched. An entry is a candidate only if it is at least [`THRESHOLD`] times the largest of
//! its column, which bounds the multipliers. H. M. Markowitz, The elimination form of the inverse and its application
//! to linear programming, Management Science 3 (1957) 255–269; Z. Zlatev, On some pivotal strategies in Gaussian
//! elimination by sparse technique, SIAM J. Numer. Anal. 17 (1980) 18–30.

/// Smallest pivot, relative to the largest entry of its column.
const THRESHOLD: f64 = 0.1;
/// Number of the shortest rows that are searched for a pivot.
const SEARCHED_ROWS: usize = 4;

/// Row and column of every pivot of the n×n matrix with these entries (row, column) and values; `None` where it is
/// singular.
pub(super) fn pivots(n: usize, entries: &[(usize, usize)], values: &[f64]) -> Option<Vec<(usize, usize)>> {
    let mut rest = Remainder::new(n, entries, values);
    (0..n).map(|_| rest.eliminate_next()).collect()
}

/// The part of the matrix that has not been eliminated yet.
struct Remainder {
    /// Columns and values of every remaining row; empty for eliminated rows.
    rows: Vec<Vec<(usize, f64)>>,
    /// For every remaining column, the remaining rows that have an entry in it.
    columns: Vec<Vec<usize>>,
    /// The remaining rows.
    open: Vec<usize>,
}

impl Remainder {
    fn new(n: usize, entries: &[(usize, usize)], values: &[f64]) -> Self {
        let (mut rows, mut columns) = (vec![Vec::new(); n], vec![Vec::new(); n]);
        for (&(row, column), &value) in entries.iter().zip(values) {
            rows[row].push((column, value));
            columns[column].push(row);
        }
        Self { rows, columns, open: (0..n).collect() }
    }

    /// Chooses a pivot and eliminates its column from the remaining rows.
    fn eliminate_next(&mut self) -> Option<(usize, usize)> {
        let (pivot_row, pivot_column) = self.choose()?;
        let entries = core::mem::take(&mut self.rows[pivot_row]);
        let pivot = entries.iter().find(|entry| entry.0 == pivot_column)?.1;
        self.open.retain(|row| *row != pivot_row);
        entries.iter().for_each(|entry| self.columns[entry.0].retain(|row| *row != pivot_row));
        for row in core::mem::take(&mut self.columns[pivot_column]) {
            let list = &mut self.rows[row];
            let Some(index) = list.iter().position(|entry| entry.0 == pivot_column) else { continue };
            let factor = list.swap_remove(index).1 / pivot;
            for &(column, value) in entries.iter().filter(|entry| entry.0 != pivot_column) {
                match list.iter_mut().find(|entry| entry.0 == column) {
                    Some(entry) => entry.1 -= factor * value,
                    None => {
                        list.push((column, -factor * value));
                        self.columns[column].push(row);
                    }
                }
            }
        }
        Some((pivot_row, pivot_column))
    }

    /// Row and column of the next pivot.
    fn choose(&self) -> Option<(usize, usize)> {
        let mut shortest: Vec<(usize, usize)> = Vec::with_capacity(SEARCHED_ROWS + 1);
        for &row in &self.open {
            let length = self.rows[row].len();
            if shortest.len() < SEARCHED_ROWS || length < shortest[SEARCHED_ROWS - 1].0 {
                let place = shortest.partition_point(|other| other.0 <= length);
                shortest.insert(place, (length, row));
                shortest.truncate(SEARCHED_ROWS);
            }
        }
        // If none of the shortest rows has a suitable pivot, all rows are searched.
        let few = self.best(shortest.iter().map(|entry| entry.1));
        few.or_else(|| self.best(self.open.iter().copied()))
    }

    /// The best pivot in the given rows.
    fn best(&self, rows: impl Iterator<Item = usize>) -> Option<(usize, usize)> {
        let mut best: Option<((usize, usize), usize, f64)> = None;
        for row in rows {
            let list = &self.rows[row];
            for &(column, value) in list {
                let size = value.abs();
                let cost = (list.len() - 1) * (self.columns[column].len() - 1);
                if best.is_none_or(|(_, least, most)| cost < least || (cost == least && size > most))
                    && size > 0.0
                    && size.is_finite()
                    && size >= THRESHOLD * self.largest(column)
                {
                    best = Some(((row, column), cost, size));
                }
            }
        }
        best.map(|(index, ..)| index)
    }

    /// The largest absolute value in a column.
    fn largest(&self, column: usize) -> f64 {
        let size_in_row =
            |row: &usize| self.rows[*row].iter().find(|entry| entry.0 == column).map_or(0.0, |entry| entry.1.abs());
        self.columns[column].iter().map(size_in_row).fold(0.0, f64::max)
    }
}

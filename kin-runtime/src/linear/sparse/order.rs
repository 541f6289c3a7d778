//! In which order the unknowns of a sparse square matrix are eliminated, and where that leaves entries.
//!
//! Markowitz: the next pivot is the entry with the smallest (r − 1)(c − 1), which bounds the new entries, where r and c
//! count what is left in its row and column; among equals the largest. An entry counts only if it is at least
//! [`THRESHOLD`] times the largest of its column, which bounds the multipliers. H. M. Markowitz, The elimination form of
//! the inverse and its application to linear programming, Management Science 3 (1957) 255–269; Duff, Erisman and Reid,
//! Direct Methods for Sparse Matrices (2017), chapters 5 and 7.

use core::cmp::Ordering;

/// Smallest pivot, relative to the largest entry of its column.
const THRESHOLD: f64 = 0.1;

/// How a pattern is eliminated. Rows and columns are counted by pivots: row k is the row of pivot k.
///
/// The entries of L below the diagonal, of U above it, and the pivots are one array of numbers, in this order, the first two
/// by rows.
#[derive(Clone, Debug)]
pub(super) struct Order {
    /// Row and column of every pivot.
    pub(super) pivots: Vec<(usize, usize)>,
    /// True where the exchanges of rows and columns together change the sign of the determinant.
    pub(super) odd: bool,
    /// Row and column of every entry of the matrix.
    pub(super) entries: Vec<(u32, u32)>,
    /// Where every entry of the matrix is among the numbers.
    pub(super) places: Vec<u32>,
    /// Row and column of the entries of L and of U.
    pub(super) lower: Vec<(u32, u32)>,
    pub(super) upper: Vec<(u32, u32)>,
    /// For every entry of L, in order, where its `updates` end.
    pub(super) ends: Vec<u32>,
    /// Places of a number, and of the entry of U that is taken off it, times the entry of L.
    pub(super) updates: Vec<(u32, u32)>,
}

impl Order {
    /// An order for the n×n matrix with these entries (row, column) and their values; none where it is singular.
    pub(super) fn new(n: usize, entries: &[(usize, usize)], values: &[f64]) -> Option<Self> {
        let mut rest = Remainder::new(n, entries, values);
        let pivots: Vec<(usize, usize)> = (0..n).map(|_| rest.eliminate_next()).collect::<Option<_>>()?;
        let (mut of_row, mut of_column) = (vec![0; n], vec![0; n]);
        for (k, &(row, column)) in pivots.iter().enumerate() {
            (of_row[row], of_column[column]) = (k, k);
        }
        let by_pivots = |lists: &[Vec<usize>]| -> Vec<(u32, u32)> {
            let own = pivots.iter().enumerate().flat_map(|(k, &(row, _))| {
                let mut list: Vec<usize> = lists[row].iter().map(|&column| of_column[column]).collect();
                list.sort_unstable();
                list.into_iter().map(move |column| (k as u32, column as u32))
            });
            own.collect()
        };
        let (lower, upper) = (by_pivots(&rest.lower), by_pivots(&rest.upper));
        let entries: Vec<(u32, u32)> =
            entries.iter().map(|&(row, column)| (of_row[row] as u32, of_column[column] as u32)).collect();
        let odd = is_odd(&of_row) ^ is_odd(&of_column);
        let none = Vec::new;
        let mut order = Self { pivots, odd, entries, places: none(), lower, upper, ends: none(), updates: Vec::new() };
        order.places = order.entries.iter().map(|&(row, column)| order.place(row, column)).collect();
        for k in 0..order.lower.len() {
            let (row, through) = order.lower[k];
            let first = order.upper.partition_point(|entry| entry.0 < through);
            for place in first..order.upper.partition_point(|entry| entry.0 <= through) {
                let to = order.place(row, order.upper[place].1);
                order.updates.push((to, (order.lower.len() + place) as u32));
            }
            order.ends.push(order.updates.len() as u32);
        }
        Some(order)
    }

    /// Where the entry of a row and a column is among the numbers.
    fn place(&self, row: u32, column: u32) -> u32 {
        let before = |list: &[(u32, u32)]| list.partition_point(|entry| *entry < (row, column)) as u32;
        let (lower, upper) = (self.lower.len() as u32, self.upper.len() as u32);
        match column.cmp(&row) {
            Ordering::Less => before(&self.lower),
            Ordering::Greater => lower + before(&self.upper),
            Ordering::Equal => lower + upper + row,
        }
    }
}

/// What is left to eliminate.
struct Remainder {
    /// Rows that are left, with their columns and values.
    rows: Vec<Vec<(usize, f64)>>,
    open: Vec<bool>,
    /// Rows in which a column has an entry, and the size of the largest.
    counts: Vec<usize>,
    largest: Vec<f64>,
    /// Columns of what a row was reduced by, and of what it had when it became a pivot's, without the pivot.
    lower: Vec<Vec<usize>>,
    upper: Vec<Vec<usize>>,
}

impl Remainder {
    fn new(n: usize, entries: &[(usize, usize)], values: &[f64]) -> Self {
        let mut rows = vec![Vec::new(); n];
        for (&(row, column), &value) in entries.iter().zip(values) {
            rows[row].push((column, value));
        }
        let lists = || vec![Vec::new(); n];
        Self { rows, open: vec![true; n], counts: vec![0; n], largest: vec![0.0; n], lower: lists(), upper: lists() }
    }

    /// Chooses a pivot and eliminates its column from the rows that are left.
    fn eliminate_next(&mut self) -> Option<(usize, usize)> {
        let (pivot_row, pivot_column) = self.choose()?;
        let own = core::mem::take(&mut self.rows[pivot_row]);
        self.open[pivot_row] = false;
        let pivot = own.iter().find(|entry| entry.0 == pivot_column)?.1;
        let others: Vec<(usize, f64)> = own.into_iter().filter(|entry| entry.0 != pivot_column).collect();
        for (row, list) in self.rows.iter_mut().enumerate() {
            let Some(place) = list.iter().position(|entry| entry.0 == pivot_column) else { continue };
            let factor = list.swap_remove(place).1 / pivot;
            self.lower[row].push(pivot_column);
            for &(column, value) in &others {
                match list.iter_mut().find(|entry| entry.0 == column) {
                    Some(entry) => entry.1 -= factor * value,
                    None => list.push((column, -factor * value)),
                }
            }
        }
        self.upper[pivot_row] = others.into_iter().map(|entry| entry.0).collect();
        Some((pivot_row, pivot_column))
    }

    /// Row and column of the next pivot.
    fn choose(&mut self) -> Option<(usize, usize)> {
        self.counts.fill(0);
        self.largest.fill(0.0);
        for &(column, value) in self.rows.iter().flatten() {
            self.counts[column] += 1;
            self.largest[column] = self.largest[column].max(value.abs());
        }
        let mut best: Option<((usize, usize), usize, f64)> = None;
        for (row, list) in self.rows.iter().enumerate().filter(|(row, _)| self.open[*row]) {
            for &(column, value) in list {
                let size = value.abs();
                if !(size > 0.0 && size >= THRESHOLD * self.largest[column] && size.is_finite()) {
                    continue;
                }
                let cost = (list.len() - 1) * (self.counts[column] - 1);
                if best.is_none_or(|(_, least, most)| cost < least || (cost == least && size > most)) {
                    best = Some(((row, column), cost, size));
                }
            }
        }
        best.map(|(place, ..)| place)
    }
}

/// True for a permutation that is an odd number of exchanges.
fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut place = start;
        let mut length = 0;
        while !core::mem::replace(&mut seen[place], true) {
            place = permutation[place];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

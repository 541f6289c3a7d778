//! Symbolic factorisation: the pattern of L and U for a given order of pivots, including fill-in.

use core::cmp::Ordering;
use std::collections::BTreeSet;

/// The elimination of a pattern in a given order of pivots. Rows and columns are numbered by pivots: row k is the row
/// of pivot k.
///
/// The entries of L below the diagonal, those of U above it, and the pivots are stored in one array of numbers, in this
/// order; L and U are stored by rows.
#[derive(Clone, Debug)]
pub(super) struct SymbolicLu {
    /// Row and column of every pivot in the original matrix.
    pub(super) pivots: Vec<(usize, usize)>,
    /// True where the permutations of rows and columns together change the sign of the determinant.
    pub(super) odd: bool,
    /// Row and column of every entry of the matrix, numbered by pivots.
    pub(super) entries: Places,
    /// Index of every entry of the matrix in the array of numbers.
    pub(super) places: Vec<u32>,
    /// Row and column of every entry of L, and of every entry of U.
    pub(super) lower: Places,
    pub(super) upper: Places,
    /// For every entry of L, in order, the end of its range in `updates`.
    pub(super) ends: Vec<u32>,
    /// Each update subtracts from the first number the product of the second, an entry of U, and the entry of L to
    /// which the update belongs.
    pub(super) updates: Vec<(u32, u32)>,
}

impl SymbolicLu {
    /// The elimination of the n×n matrix with these entries (row, column), in the given order of pivots.
    pub(super) fn new(entries: &[(usize, usize)], pivots: Vec<(usize, usize)>) -> Self {
        let n = pivots.len();
        let (mut of_row, mut of_column) = (vec![0; n], vec![0; n]);
        for (k, &(row, column)) in pivots.iter().enumerate() {
            (of_row[row], of_column[column]) = (k, k);
        }
        let entries: Vec<(u32, u32)> =
            entries.iter().map(|&(row, column)| (of_row[row] as u32, of_column[column] as u32)).collect();
        let odd = is_odd(&of_row) ^ is_odd(&of_column);
        let (lower, upper) = filled(n, &entries);
        let (places, ends, updates) = (Vec::new(), Vec::new(), Vec::new());
        let mut symbolic = Self { pivots, odd, entries, places, lower, upper, ends, updates };
        symbolic.places = symbolic.entries.iter().map(|&(row, column)| symbolic.place(row, column)).collect();
        for k in 0..symbolic.lower.len() {
            let (row, through) = symbolic.lower[k];
            let first = symbolic.upper.partition_point(|entry| entry.0 < through);
            for index in first..symbolic.upper.partition_point(|entry| entry.0 <= through) {
                let to = symbolic.place(row, symbolic.upper[index].1);
                symbolic.updates.push((to, (symbolic.lower.len() + index) as u32));
            }
            symbolic.ends.push(symbolic.updates.len() as u32);
        }
        symbolic
    }

    /// Index of the entry (row, column) in the array of numbers.
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

/// Rows and columns of a list of entries.
type Places = Vec<(u32, u32)>;

/// The entries of L (below the diagonal) and of U (above it) with fill-in, sorted by rows.
fn filled(n: usize, entries: &[(u32, u32)]) -> (Places, Places) {
    let mut rows = vec![Vec::new(); n];
    entries.iter().for_each(|&(row, column)| rows[row as usize].push(column));
    let (mut lower, mut upper, mut starts) = (Vec::new(), Vec::new(), vec![0]);
    for (row, entries_of_row) in (0_u32..).zip(&rows) {
        let mut columns: BTreeSet<u32> = entries_of_row.iter().copied().collect();
        let mut reached = None;
        // Subtracting row `through` adds entries only in columns further to the right, so one pass suffices.
        while let Some(through) = columns.range(reached.map_or(0, |last| last + 1)..row).next().copied() {
            lower.push((row, through));
            let entries_right: &[(u32, u32)] = &upper[starts[through as usize]..starts[through as usize + 1]];
            columns.extend(entries_right.iter().map(|entry| entry.1));
            reached = Some(through);
        }
        upper.extend(columns.range(row + 1..).map(|&column| (row, column)));
        starts.push(upper.len());
    }
    (lower, upper)
}

/// True for an odd permutation.
fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut index = start;
        let mut length = 0;
        while !core::mem::replace(&mut seen[index], true) {
            index = permutation[index];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

//! Linear algebra with bounds: products of a fixed matrix C with intervals, with every rounding error included.
//!
//! Sums are computed in round-to-nearest, together with the sum of the absolute values of their terms. The error of a
//! sum of m products is less than (m + 2) u times the latter (N. J. Higham, Accuracy and Stability of Numerical
//! Algorithms, 2nd ed. 2002, section 3.1); bounds use twice that, which covers the rounding of the bounds themselves,
//! and add the smallest normal number for every product that underflows.

use crate::scalar::Interval;
use nalgebra::DMatrix;

/// An upper bound of the exact value of a computed sum of m nonnegative products.
fn up(sum: f64, m: usize) -> f64 {
    (sum + m as f64 * f64::MIN_POSITIVE) * (1.0 + (m + 4) as f64 * f64::EPSILON)
}

/// C: an approximate inverse of a matrix, by which linear equations are multiplied from the left.
pub(super) struct Preconditioner {
    n: usize,
    /// Column by column.
    columns: Vec<f64>,
}

/// Replaces an n×n matrix, given row by row, by its inverse: the algorithm of Gauss and Jordan with partial pivoting, in place.
/// Nothing is left if a pivot is 0 or not a number.
fn inverted(mut a: Vec<f64>, n: usize) -> Option<Vec<f64>> {
    let mut exchanges = Vec::with_capacity(n);
    for k in 0..n {
        let size = |&row: &usize| a[row * n + k].abs();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        exchanges.push(pivot);
        for column in (0..n).filter(|_| pivot != k) {
            a.swap(k * n + column, pivot * n + column);
        }
        let factor = 1.0 / std::mem::replace(&mut a[k * n + k], 1.0);
        a[k * n..][..n].iter_mut().for_each(|x| *x *= factor);
        let (before, rest) = a.split_at_mut(k * n);
        let (row, after) = rest.split_at_mut(n);
        for other in before.chunks_exact_mut(n).chain(after.chunks_exact_mut(n)) {
            let factor = std::mem::replace(&mut other[k], 0.0);
            other.iter_mut().zip(&*row).for_each(|(x, &pivot)| *x -= factor * pivot);
        }
    }
    // Exchanged rows of the matrix are exchanged columns of its inverse.
    for (k, &pivot) in exchanges.iter().enumerate().rev().filter(|&(k, &pivot)| pivot != k) {
        for row in a.chunks_exact_mut(n) {
            row.swap(k, pivot);
        }
    }
    a.iter().all(|x| x.is_finite()).then_some(a)
}

/// Bounds of |I − C A| for all matrices A of a matrix of intervals.
pub(super) struct Rest(DMatrix<f64>);

impl Preconditioner {
    /// An approximate inverse of the n×n matrix with these entries; none if it is singular in `f64`.
    pub(super) fn new(n: usize, entries: &[(usize, usize)], values: impl Iterator<Item = f64>) -> Option<Self> {
        // The rows of the transposed matrix, whose inverse has the columns of C as its rows.
        let mut matrix = vec![0.0; n * n];
        for (&(row, column), value) in entries.iter().zip(values) {
            matrix[column * n + row] += value;
        }
        Some(Self { n, columns: inverted(matrix, n)? })
    }

    /// Bounds for a matrix with these entries.
    pub(super) fn rest(&self, entries: &[(usize, usize)], values: &[Interval]) -> Rest {
        let n = self.n;
        // C A and |C| |A| with the midpoints of A, and |C| times the radii of A.
        let [mut product, mut sizes, mut radii] = [const { 0.0 }; 3].map(|zero| vec![zero; n * n]);
        let mut terms = vec![0_usize; n];
        for (&(row, column), value) in entries.iter().zip(values) {
            let (middle, radius) = (value.midpoint(), value.radius());
            terms[column] += 1;
            let of_row = &self.columns[row * n..][..n];
            let lists = [&mut product, &mut sizes, &mut radii].map(|list| &mut list[column * n..][..n]);
            let [product, sizes, radii] = lists;
            for (((&c, product), size), with_radius) in of_row.iter().zip(product).zip(sizes).zip(radii) {
                let term = c * middle;
                *product += term;
                *size += term.abs();
                *with_radius += c.abs() * radius;
            }
        }
        Rest(DMatrix::from_fn(n, n, |i, k| {
            let (at, m, one) = (k * n + i, terms[k], if i == k { 1.0 } else { 0.0 });
            let rounding = (m + 4) as f64 * f64::EPSILON * (sizes[at] + one);
            up((one - product[at]).abs() + radii[at] + rounding, 3 * m + 4)
        }))
    }

    /// C b for a list of intervals.
    pub(super) fn times(&self, b: &[Interval]) -> Vec<Interval> {
        let n = b.len();
        let [mut sums, mut sizes, mut radii] = [const { 0.0 }; 3].map(|zero| vec![zero; n]);
        for (b, column) in b.iter().zip(self.columns.chunks_exact(n.max(1))) {
            let (middle, radius) = (b.midpoint(), b.radius());
            for (((&c, sum), size), with_radius) in column.iter().zip(&mut sums).zip(&mut sizes).zip(&mut radii) {
                let term = c * middle;
                *sum += term;
                *size += term.abs();
                *with_radius += c.abs() * radius;
            }
        }
        let rounding = |i: usize| (n + 4) as f64 * f64::EPSILON * sizes[i];
        (0..n).map(|i| Interval::around(sums[i], up(radii[i] + rounding(i), 3 * n + 4))).collect()
    }

    /// 1 / κ in the maximum norm of the matrix with these entries, rows scaled to size 1 and columns by `sizes`.
    pub(super) fn inverse_condition(&self, entries: &[(usize, usize)], values: &[Interval], sizes: &[f64]) -> f64 {
        let n = sizes.len();
        let mut rows = vec![0.0; n];
        for (&(row, column), entry) in entries.iter().zip(values) {
            rows[row] += entry.magnitude() * sizes[column];
        }
        let sum = |i: usize| (0..n).map(|r| self.columns[r * n + i].abs() * rows[r]).sum::<f64>() / sizes[i];
        1.0 / (0..n).map(sum).fold(1.0, f64::max)
    }
}

impl Rest {
    /// Bounds of |I − C A| v for a list v of nonnegative numbers.
    pub(super) fn times(&self, v: &[f64]) -> Vec<f64> {
        let n = v.len();
        let mut sums = vec![0.0; n];
        for (&v, column) in v.iter().zip(self.0.as_slice().chunks_exact(n.max(1))) {
            for (sum, &rest) in sums.iter_mut().zip(column) {
                *sum += rest * v;
            }
        }
        sums.into_iter().map(|sum| up(sum, n)).collect()
    }
}

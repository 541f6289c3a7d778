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
pub(super) struct Preconditioner(DMatrix<f64>);

/// Bounds of |I − C A| for all matrices A of a matrix of intervals.
pub(super) struct Rest(DMatrix<f64>);

impl Preconditioner {
    /// An approximate inverse of the n×n matrix with these entries; none if it is singular in `f64`.
    pub(super) fn new(n: usize, entries: &[(usize, usize)], values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut matrix = DMatrix::zeros(n, n);
        for (&place, value) in entries.iter().zip(values) {
            matrix[place] += value;
        }
        matrix.try_inverse().filter(|inverse| inverse.iter().all(|c: &f64| c.is_finite())).map(Self)
    }

    /// Bounds for a matrix with these entries.
    pub(super) fn rest(&self, entries: &[(usize, usize)], values: &[Interval]) -> Rest {
        let n = self.0.nrows();
        // C A and |C| |A| with the midpoints of A, and |C| times the radii of A.
        let [mut product, mut sizes, mut radii] = [const { 0.0 }; 3].map(|zero| vec![zero; n * n]);
        let mut terms = vec![0_usize; n];
        for (&(row, column), value) in entries.iter().zip(values) {
            let (middle, radius) = (value.midpoint(), value.radius());
            terms[column] += 1;
            let of_row = &self.0.as_slice()[row * n..][..n];
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
        for (row, b) in b.iter().enumerate() {
            let (middle, radius) = (b.midpoint(), b.radius());
            for (i, &c) in self.0.column(row).iter().enumerate() {
                sums[i] += c * middle;
                sizes[i] += (c * middle).abs();
                radii[i] += c.abs() * radius;
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
        let sum = |i: usize| (0..n).map(|r| self.0[(i, r)].abs() * rows[r]).sum::<f64>() / sizes[i];
        1.0 / (0..n).map(sum).fold(1.0, f64::max)
    }
}

impl Rest {
    /// Bounds of |I − C A| v for a list v of nonnegative numbers.
    pub(super) fn times(&self, v: &[f64]) -> Vec<f64> {
        let n = v.len();
        let mut sums = vec![0.0; n];
        for (k, &v) in v.iter().enumerate() {
            for (sum, &rest) in sums.iter_mut().zip(self.0.column(k).iter()) {
                *sum += rest * v;
            }
        }
        sums.into_iter().map(|sum| up(sum, n)).collect()
    }
}

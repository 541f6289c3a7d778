//! Linear algebra with bounds: products of a fixed matrix C with intervals, with every rounding error included.
//!
//! Sums are computed in round-to-nearest, together with bounds of their errors. The error of a sum of m products is less than
//! (m + 2) u times the sum of the products' absolute values (N. J. Higham, Accuracy and Stability of Numerical Algorithms,
//! 2nd ed. 2002, section 3.1); bounds use twice that, which covers the rounding of the bounds themselves, and add a tiny
//! number for every product that may underflow.

use crate::scalar::Interval;

/// How many numbers are processed at once; columns are padded with zeros to a multiple of it.
const LANES: usize = 4;

/// 2⁻⁹⁶⁰: far more than the error of an underflow, and large enough for products with it to be normal numbers, because
/// arithmetic with subnormal numbers is slow.
const TINY: f64 = f64::from_bits((1023 - 960) << 52);

/// A list of zeros. `vec!` requests cleared memory from the allocator, which is slower for short lists.
pub(crate) fn zeros(n: usize) -> Vec<f64> {
    core::iter::repeat_n(0.0, n).collect()
}

/// An upper bound of the exact value of a computed sum of m nonnegative products.
fn up(sum: f64, m: usize) -> f64 {
    (sum + m as f64 * TINY) * (1.0 + (m + 4) as f64 * f64::EPSILON)
}

/// C: an approximate inverse of a matrix, by which linear equations are multiplied from the left.
pub(super) struct Preconditioner {
    n: usize,
    /// How many numbers a column has, zeros at its end included.
    height: usize,
    /// Column by column.
    columns: Vec<f64>,
    /// Buffers: another matrix, sums and bounds of their errors.
    product: Vec<f64>,
    sums: Vec<f64>,
    errors: Vec<f64>,
}

/// `list` + `factor` · `other`, number by number; lengths are multiples of [`LANES`].
#[inline]
fn add(list: &mut [f64], factor: f64, other: &[f64]) {
    for (list, other) in list.as_chunks_mut::<LANES>().0.iter_mut().zip(other.as_chunks::<LANES>().0) {
        for k in 0..LANES {
            list[k] += factor * other[k];
        }
    }
}

/// `list` + `factor` · |`other`|, number by number.
#[inline]
fn add_sizes(list: &mut [f64], factor: f64, other: &[f64]) {
    for (list, other) in list.as_chunks_mut::<LANES>().0.iter_mut().zip(other.as_chunks::<LANES>().0) {
        for k in 0..LANES {
            list[k] += factor * other[k].abs();
        }
    }
}

/// The error bound of one product in a sum of `count`, divided by the size of its other factor; the first factor is an interval
/// with this middle and radius.
#[inline]
fn weight(middle: f64, radius: f64, count: usize) -> f64 {
    radius + (count + 4) as f64 * f64::EPSILON * middle.abs() + TINY
}

/// Replaces a matrix of n rows of equal lengths by its inverse: the algorithm of Gauss and Jordan with partial pivoting, in place.
/// False if a pivot is 0 or not a number.
fn invert(a: &mut [f64], n: usize, length: usize, exchanges: &mut Vec<usize>) -> bool {
    exchanges.clear();
    for k in 0..n {
        let size = |row: usize| a[row * length + k].abs();
        let pivot = (k + 1..n).fold(k, |most, row| if size(row) > size(most) { row } else { most });
        exchanges.push(pivot);
        if pivot != k {
            let (upper, lower) = a.split_at_mut(pivot * length);
            upper[k * length..][..length].swap_with_slice(&mut lower[..length]);
        }
        let (before, rest) = a.split_at_mut(k * length);
        let (row, after) = rest.split_at_mut(length);
        let factor = 1.0 / std::mem::replace(&mut row[k], 1.0);
        if factor != 1.0 {
            row.iter_mut().for_each(|x| *x *= factor);
        }
        for other in before.chunks_exact_mut(length).chain(after.chunks_exact_mut(length)) {
            let factor = std::mem::replace(&mut other[k], 0.0);
            // Most entries of a mechanism's matrix are 0.
            if factor != 0.0 {
                add(other, -factor, row);
            }
        }
    }
    // Exchanged rows of the matrix are exchanged columns of its inverse.
    for (k, &pivot) in exchanges.iter().enumerate().rev().filter(|&(k, &pivot)| pivot != k) {
        for row in a.chunks_exact_mut(length) {
            row.swap(k, pivot);
        }
    }
    // NaN and infinite numbers times 0 are NaN.
    let mut sums = [0.0; LANES];
    for numbers in a.as_chunks::<LANES>().0 {
        for k in 0..LANES {
            sums[k] += 0.0 * numbers[k];
        }
    }
    sums == [0.0; LANES]
}

impl Preconditioner {
    /// Room for n×n matrices.
    pub(super) fn with_room(n: usize) -> Self {
        let height = n.next_multiple_of(LANES).max(LANES);
        let [columns, product] = [(); 2].map(|()| zeros(n * height));
        Self { n, height, columns, product, sums: zeros(height), errors: zeros(height) }
    }

    /// An approximate inverse of the n×n matrix with these entries; `None` if it is singular in `f64`.
    pub(super) fn new(n: usize, entries: &[(usize, usize)], values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut inverse = Self::with_room(n);
        inverse.set(entries, values, &mut Vec::with_capacity(n)).then_some(inverse)
    }

    /// Sets it to an approximate inverse of the matrix with these entries, at most one for each place; false if it is
    /// singular in `f64`.
    pub(super) fn set(
        &mut self,
        entries: &[(usize, usize)],
        values: impl Iterator<Item = f64>,
        exchanges: &mut Vec<usize>,
    ) -> bool {
        // The rows of the transposed matrix, whose inverse has the columns of C as its rows.
        self.columns.fill(0.0);
        for (&(row, column), value) in entries.iter().zip(values) {
            self.columns[column * self.height + row] = value;
        }
        invert(&mut self.columns, self.n, self.height, exchanges)
    }

    /// Writes bounds of |I − C A| v, for a list v of nonnegative numbers and all matrices A with entries in these intervals.
    pub(super) fn rest(&mut self, entries: &[(usize, usize)], values: &[Interval], v: &[f64], bounds: &mut [f64]) {
        let Self { n, height, columns, product, sums, errors } = self;
        let (n, height) = (*n, *height);
        // C A with the midpoints of A; for every row of A the bounds of its entries' errors, times v.
        product.fill(0.0);
        errors.fill(0.0);
        for (&(row, column), value) in entries.iter().zip(values) {
            let middle = value.midpoint();
            // A column of A has at most n entries.
            errors[row] += weight(middle, value.radius(), n) * v[column] + TINY;
            add(&mut product[column * height..][..height], middle, &columns[row * height..][..height]);
        }
        sums.fill(0.0);
        for (row, column) in columns.chunks_exact(height).enumerate() {
            add_sizes(sums, errors[row], column);
        }
        for (k, (column, &v)) in product.chunks_exact_mut(height).zip(v).enumerate() {
            column[k] -= 1.0;
            add_sizes(sums, v, column);
        }
        let underflow = n as f64 * TINY * v.iter().sum::<f64>();
        for (bound, &sum) in bounds.iter_mut().zip(&*sums) {
            *bound = up(sum + underflow, 4 * n + 8);
        }
    }

    /// Writes C b for a list of intervals.
    pub(super) fn times_to(&mut self, b: &[Interval], product: &mut [Interval]) {
        let Self { n, height, columns, sums, errors, .. } = self;
        sums.fill(0.0);
        errors.fill(0.0);
        for (b, column) in b.iter().zip(columns.chunks_exact(*height)) {
            let (middle, radius) = (b.midpoint(), b.radius());
            add(sums, middle, column);
            add_sizes(errors, weight(middle, radius, *n), column);
        }
        for ((product, &sum), &error) in product.iter_mut().zip(&*sums).zip(&*errors) {
            *product = Interval::around(sum, up(error, 3 * *n + 4));
        }
    }

    /// C b for a list of intervals.
    pub(super) fn times(&mut self, b: &[Interval]) -> Vec<Interval> {
        let mut product = vec![Interval::ZERO; b.len()];
        self.times_to(b, &mut product);
        product
    }

    /// 1 / κ in the maximum norm of the matrix with these entries, rows scaled to size 1 and columns by `sizes`.
    pub(super) fn inverse_condition(&self, entries: &[(usize, usize)], values: &[Interval], sizes: &[f64]) -> f64 {
        let n = sizes.len();
        let mut rows = vec![0.0; n];
        for (&(row, column), entry) in entries.iter().zip(values) {
            rows[row] += entry.magnitude() * sizes[column];
        }
        let sum = |i: usize| (0..n).map(|r| self.columns[r * self.height + i].abs() * rows[r]).sum::<f64>() / sizes[i];
        1.0 / (0..n).map(sum).fold(1.0, f64::max)
    }
}

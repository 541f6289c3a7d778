//! The factorisation A = L U of a sparse square matrix with a fixed pattern. The order of elimination is computed once,
//! and computed again only where a pivot has become too small for the new values.
//!
//! With rows and columns numbered by their pivots, one row after the other:
//!
//! ```text
//! u_k = a_k − Σ_{j<k} l_kj u_j,    l_kj = (a_k − Σ_{i<j} l_ki u_i)_j / u_jj
//! ```
//!
//! The multipliers l_kj are checked: if one exceeds [`LARGEST_MULTIPLIER`], the order of elimination is discarded. One
//! step of iterative refinement restores the accuracy that multipliers below this bound may cost.

mod markowitz;
mod order;

use super::inverse_norm::{Inverse, inverse_norm, largest_row};
use order::Order;
use std::rc::Rc;

/// Largest multiplier for which an order of elimination is kept.
const LARGEST_MULTIPLIER: f64 = 1e4;

/// A pattern with the order of elimination that was used last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ordered {
    n: usize,
    /// Row and column of every entry.
    entries: Vec<(usize, usize)>,
    order: Option<Rc<Order>>,
}

impl Ordered {
    /// A pattern of an n×n matrix without an order of elimination.
    pub(crate) const fn new(n: usize, entries: Vec<(usize, usize)>) -> Self {
        Self { n, entries, order: None }
    }

    pub(crate) fn entries(&self) -> &[(usize, usize)] {
        &self.entries
    }

    /// Factorises the matrix with the values in `elimination`, in the order used last or, if that fails, in a new one;
    /// false where the matrix is singular.
    pub(crate) fn factorise(&mut self, elimination: &mut Elimination) -> bool {
        if let Some(order) = &self.order
            && elimination.follow(order)
        {
            return true;
        }
        let pivots = markowitz::pivots(self.n, &self.entries, &elimination.values);
        self.order = pivots.map(|pivots| Rc::new(Order::new(&self.entries, pivots)));
        self.order.as_ref().is_some_and(|order| elimination.follow(order))
    }
}

/// A factorised matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct Elimination {
    /// The values of the entries of A.
    pub(crate) values: Vec<f64>,
    order: Option<Rc<Order>>,
    /// The values of L, then of U, then the pivots (the diagonal of U).
    numbers: Vec<f64>,
    /// The inverses of the pivots.
    inverse: Vec<f64>,
    /// The values of U, each divided by the pivot of its row.
    upper: Vec<f64>,
    work: Vec<f64>,
}

impl Elimination {
    /// Computes L and U in a given order; false where a multiplier is too large or a number is not finite.
    fn follow(&mut self, order: &Rc<Order>) -> bool {
        if self.order.as_ref().is_none_or(|own| !Rc::ptr_eq(own, order)) {
            self.order = Some(Rc::clone(order));
        }
        let (n, lower, upper) = (order.pivots.len(), order.lower.len(), order.upper.len());
        let Self { values, numbers, inverse, .. } = self;
        numbers.clear();
        numbers.resize(lower + upper + n, 0.0);
        order.places.iter().zip(values.iter()).for_each(|(&place, value)| numbers[place as usize] += value);
        inverse.resize(n, 0.0);
        let mut largest = 0.0_f64;
        let (mut next, mut first) = (0, 0);
        for k in 0..n {
            while let Some(&(_, through)) = order.lower.get(next).filter(|entry| entry.0 as usize == k) {
                let multiplier = numbers[next] * inverse[through as usize];
                numbers[next] = multiplier;
                largest = largest.max(multiplier.abs());
                let end = order.ends[next] as usize;
                for &(to, of) in &order.updates[first..end] {
                    numbers[to as usize] -= multiplier * numbers[of as usize];
                }
                (next, first) = (next + 1, end);
            }
            inverse[k] = 1.0 / numbers[lower + upper + k];
        }
        self.upper.clear();
        let upper_values = self.numbers[lower..].iter().zip(&order.upper);
        self.upper.extend(upper_values.map(|(value, &(row, _))| value * self.inverse[row as usize]));
        // If all multipliers are within their bound, every number is finite.
        largest <= LARGEST_MULTIPLIER && self.pivots().iter().fold(true, |all, pivot| all & pivot.is_normal())
    }

    fn pivots(&self) -> &[f64] {
        &self.numbers[self.numbers.len() - self.inverse.len()..]
    }

    /// The smallest and the largest absolute value of the pivots.
    pub(crate) fn extremes(&self) -> (f64, f64) {
        let sizes = self.pivots().iter().map(|pivot| pivot.abs());
        sizes.fold((f64::INFINITY, 0.0), |(low, high), size| (f64::min(low, size), f64::max(high, size)))
    }

    /// Whether the determinant is positive.
    pub(crate) fn is_positive(&self) -> bool {
        let odd = self.order.as_ref().is_some_and(|order| order.odd);
        self.pivots().iter().fold(!odd, |positive, pivot| positive ^ (*pivot < 0.0))
    }

    /// ‖A‖₁ and an estimate of ‖A⁻¹‖₁.
    pub(crate) fn norms(&mut self) -> (f64, f64) {
        let Some(order) = self.order.clone() else { return (0.0, 0.0) };
        let n = order.pivots.len();
        let mut work = core::mem::take(&mut self.work);
        work.clear();
        work.resize(4 * n, 0.0);
        let entries = order.entries.iter().zip(&self.values);
        entries.for_each(|(&(_, column), value)| work[column as usize] += value.abs());
        let norm = work[..n].iter().copied().fold(0.0, f64::max);
        // Permutations of rows and columns do not change these norms.
        let inverse = inverse_norm(&Permuted { elimination: self, order: &order }, &mut work);
        self.work = work;
        (norm, inverse)
    }

    /// The largest 2-norm of a column of A, and an estimate of the largest 2-norm of a row of A⁻¹.
    pub(crate) fn extents(&mut self) -> (f64, f64) {
        let Some(order) = self.order.clone() else { return (0.0, 0.0) };
        let n = order.pivots.len();
        let mut work = core::mem::take(&mut self.work);
        work.clear();
        work.resize(n, 0.0);
        let entries = order.entries.iter().zip(&self.values);
        entries.for_each(|(&(_, column), value)| work[column as usize] += value * value);
        let column = work.iter().copied().fold(0.0, f64::max).sqrt();
        let row = largest_row(&Permuted { elimination: self, order: &order }, n, &mut work);
        self.work = work;
        (column, row)
    }

    /// Solves A x = b, with one step of iterative refinement.
    pub(crate) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let Some(order) = &self.order else { return Vec::new() };
        let permuted = Permuted { elimination: self, order };
        let mut y: Vec<f64> = order.pivots.iter().map(|&(row, _)| b[row]).collect();
        let mut correction = y.clone();
        permuted.solve::<1>(&mut y);
        for (&(row, column), value) in order.entries.iter().zip(&self.values) {
            correction[row as usize] -= value * y[column as usize];
        }
        permuted.solve::<1>(&mut correction);
        let mut x = vec![0.0; y.len()];
        for (&(_, column), (y, correction)) in order.pivots.iter().zip(y.iter().zip(&correction)) {
            x[column] = y + correction;
        }
        x
    }
}

/// The product L U, whose rows and columns are numbered by pivots.
struct Permuted<'e> {
    elimination: &'e Elimination,
    order: &'e Order,
}

impl Inverse for Permuted<'_> {
    fn solve<const W: usize>(&self, x: &mut [f64]) {
        let x = x.as_chunks_mut::<W>().0;
        let Elimination { numbers, inverse, upper, .. } = self.elimination;
        for (factor, &(row, column)) in numbers.iter().zip(&self.order.lower) {
            let known = x[column as usize];
            x[row as usize].iter_mut().zip(known).for_each(|(x, known)| *x -= factor * known);
        }
        x.iter_mut().zip(inverse).for_each(|(x, inverse)| x.iter_mut().for_each(|x| *x *= inverse));
        for (factor, &(row, column)) in upper.iter().zip(&self.order.upper).rev() {
            let known = x[column as usize];
            x[row as usize].iter_mut().zip(known).for_each(|(x, known)| *x -= factor * known);
        }
    }

    fn solve_transposed(&self, x: &mut [f64]) {
        let Elimination { numbers, inverse, upper, .. } = self.elimination;
        for (factor, &(row, column)) in upper.iter().zip(&self.order.upper) {
            x[column as usize] -= factor * x[row as usize];
        }
        x.iter_mut().zip(inverse).for_each(|(x, inverse)| *x *= inverse);
        let lower = &numbers[..self.order.lower.len()];
        for (factor, &(row, column)) in lower.iter().zip(&self.order.lower).rev() {
            x[column as usize] -= factor * x[row as usize];
        }
    }
}

#[cfg(test)]
mod tests;

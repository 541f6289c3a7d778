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
mod symbolic;

use super::inverse_norm::{Inverse, inverse_norm, largest_row};
use std::rc::Rc;
use symbolic::SymbolicLu;

/// Largest multiplier for which an order of elimination is kept.
const LARGEST_MULTIPLIER: f64 = 1e4;

/// A pattern with the order of elimination that was used last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ordered {
    n: usize,
    /// Row and column of every entry.
    entries: Vec<(usize, usize)>,
    symbolic: Option<Rc<SymbolicLu>>,
}

impl Ordered {
    /// A pattern of an n×n matrix without an order of elimination.
    pub(crate) const fn new(n: usize, entries: Vec<(usize, usize)>) -> Self {
        Self { n, entries, symbolic: None }
    }

    pub(crate) fn entries(&self) -> &[(usize, usize)] {
        &self.entries
    }

    /// Factorises the matrix with the values in `lu`, in the order used last or, if that fails, in a new one;
    /// false where the matrix is singular.
    pub(crate) fn factorise(&mut self, lu: &mut NumericLu) -> bool {
        if let Some(symbolic) = &self.symbolic
            && lu.refactor(symbolic)
        {
            return true;
        }
        let pivots = markowitz::pivots(self.n, &self.entries, &lu.values);
        self.symbolic = pivots.map(|pivots| Rc::new(SymbolicLu::new(&self.entries, pivots)));
        self.symbolic.as_ref().is_some_and(|symbolic| lu.refactor(symbolic))
    }
}

/// A factorised matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct NumericLu {
    /// The values of the entries of A.
    pub(crate) values: Vec<f64>,
    symbolic: Option<Rc<SymbolicLu>>,
    /// The values of L, then of U, then the pivots (the diagonal of U).
    numbers: Vec<f64>,
    /// The inverses of the pivots.
    inverse: Vec<f64>,
    /// The values of U, each divided by the pivot of its row.
    upper: Vec<f64>,
    work: Vec<f64>,
}

impl NumericLu {
    /// Computes L and U in a given order; false where a multiplier is too large or a number is not finite.
    fn refactor(&mut self, symbolic: &Rc<SymbolicLu>) -> bool {
        if self.symbolic.as_ref().is_none_or(|current| !Rc::ptr_eq(current, symbolic)) {
            self.symbolic = Some(Rc::clone(symbolic));
        }
        let (n, lower, upper) = (symbolic.pivots.len(), symbolic.lower.len(), symbolic.upper.len());
        let Self { values, numbers, inverse, .. } = self;
        numbers.clear();
        numbers.resize(lower + upper + n, 0.0);
        symbolic.places.iter().zip(values.iter()).for_each(|(&index, value)| numbers[index as usize] += value);
        inverse.resize(n, 0.0);
        let mut largest = 0.0_f64;
        let (mut next, mut first) = (0, 0);
        for k in 0..n {
            while let Some(&(_, through)) = symbolic.lower.get(next).filter(|entry| entry.0 as usize == k) {
                let multiplier = numbers[next] * inverse[through as usize];
                numbers[next] = multiplier;
                largest = largest.max(multiplier.abs());
                let end = symbolic.ends[next] as usize;
                for &(to, from) in &symbolic.updates[first..end] {
                    numbers[to as usize] -= multiplier * numbers[from as usize];
                }
                (next, first) = (next + 1, end);
            }
            inverse[k] = 1.0 / numbers[lower + upper + k];
        }
        self.upper.clear();
        let upper_values = self.numbers[lower..].iter().zip(&symbolic.upper);
        self.upper.extend(upper_values.map(|(value, &(row, _))| value * self.inverse[row as usize]));
        // If all multipliers are within their bound, every number is finite.
        largest <= LARGEST_MULTIPLIER && self.pivots().iter().fold(true, |all, pivot| all & pivot.is_normal())
    }

    fn pivots(&self) -> &[f64] {
        &self.numbers[self.numbers.len() - self.inverse.len()..]
    }

    /// The smallest and the largest absolute value of the pivots.
    pub(crate) fn pivot_range(&self) -> (f64, f64) {
        let sizes = self.pivots().iter().map(|pivot| pivot.abs());
        sizes.fold((f64::INFINITY, 0.0), |(low, high), size| (f64::min(low, size), f64::max(high, size)))
    }

    /// Whether the determinant is positive.
    pub(crate) fn is_positive(&self) -> bool {
        let odd = self.symbolic.as_ref().is_some_and(|symbolic| symbolic.odd);
        self.pivots().iter().fold(!odd, |positive, pivot| positive ^ (*pivot < 0.0))
    }

    /// ‖A‖₁ and an estimate of ‖A⁻¹‖₁.
    pub(crate) fn norms(&mut self) -> (f64, f64) {
        let Some(symbolic) = self.symbolic.clone() else { return (0.0, 0.0) };
        let n = symbolic.pivots.len();
        let mut work = core::mem::take(&mut self.work);
        work.clear();
        work.resize(4 * n, 0.0);
        let entries = symbolic.entries.iter().zip(&self.values);
        entries.for_each(|(&(_, column), value)| work[column as usize] += value.abs());
        let norm = work[..n].iter().copied().fold(0.0, f64::max);
        // Permutations of rows and columns do not change these norms.
        let inverse = inverse_norm(&Permuted { lu: self, symbolic: &symbolic }, &mut work);
        self.work = work;
        (norm, inverse)
    }

    /// The largest 2-norm of a column of A, and an estimate of the largest 2-norm of a row of A⁻¹.
    pub(crate) fn largest_norms(&mut self) -> (f64, f64) {
        let Some(symbolic) = self.symbolic.clone() else { return (0.0, 0.0) };
        let n = symbolic.pivots.len();
        let mut work = core::mem::take(&mut self.work);
        work.clear();
        work.resize(n, 0.0);
        let entries = symbolic.entries.iter().zip(&self.values);
        entries.for_each(|(&(_, column), value)| work[column as usize] += value * value);
        let column = work.iter().copied().fold(0.0, f64::max).sqrt();
        let row = largest_row(&Permuted { lu: self, symbolic: &symbolic }, n, &mut work);
        self.work = work;
        (column, row)
    }

    /// Solves A x = b, with one step of iterative refinement.
    pub(crate) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let Some(symbolic) = &self.symbolic else { return Vec::new() };
        let permuted = Permuted { lu: self, symbolic };
        let mut y: Vec<f64> = symbolic.pivots.iter().map(|&(row, _)| b[row]).collect();
        let mut correction = y.clone();
        permuted.solve::<1>(&mut y);
        for (&(row, column), value) in symbolic.entries.iter().zip(&self.values) {
            correction[row as usize] -= value * y[column as usize];
        }
        permuted.solve::<1>(&mut correction);
        let mut x = vec![0.0; y.len()];
        for (&(_, column), (y, correction)) in symbolic.pivots.iter().zip(y.iter().zip(&correction)) {
            x[column] = y + correction;
        }
        x
    }
}

/// The product L U, whose rows and columns are numbered by pivots.
struct Permuted<'e> {
    lu: &'e NumericLu,
    symbolic: &'e SymbolicLu,
}

impl Inverse for Permuted<'_> {
    fn solve<const W: usize>(&self, x: &mut [f64]) {
        let x = x.as_chunks_mut::<W>().0;
        let NumericLu { numbers, inverse, upper, .. } = self.lu;
        for (factor, &(row, column)) in numbers.iter().zip(&self.symbolic.lower) {
            let known = x[column as usize];
            x[row as usize].iter_mut().zip(known).for_each(|(x, known)| *x -= factor * known);
        }
        x.iter_mut().zip(inverse).for_each(|(x, inverse)| x.iter_mut().for_each(|x| *x *= inverse));
        for (factor, &(row, column)) in upper.iter().zip(&self.symbolic.upper).rev() {
            let known = x[column as usize];
            x[row as usize].iter_mut().zip(known).for_each(|(x, known)| *x -= factor * known);
        }
    }

    fn solve_transposed(&self, x: &mut [f64]) {
        let NumericLu { numbers, inverse, upper, .. } = self.lu;
        for (factor, &(row, column)) in upper.iter().zip(&self.symbolic.upper) {
            x[column as usize] -= factor * x[row as usize];
        }
        x.iter_mut().zip(inverse).for_each(|(x, inverse)| *x *= inverse);
        let lower = &numbers[..self.symbolic.lower.len()];
        for (factor, &(row, column)) in lower.iter().zip(&self.symbolic.lower).rev() {
            x[column as usize] -= factor * x[row as usize];
        }
    }
}

#[cfg(test)]
mod tests;

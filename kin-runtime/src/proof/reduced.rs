//! Elimination of coordinates that occur in rows with constant factors.
//!
//! The x and y of bodies occur in the rows of pins with factors ±1. In sums and differences of rows they cancel
//! exactly. The resulting equations contain only other coordinates, mostly angles: they are the closure equations of
//! loops. The remaining rows determine x and y afterwards.

use super::krawczyk::Square;
use crate::scalar::Interval;
use nalgebra::DMatrix;

/// The largest factor of a row: sums of integers up to this size are exact.
const MAX_FACTOR: f64 = 1_048_576.0;

/// A sum of rows with integer factors.
type Sum = Vec<(usize, f64)>;

/// The rows of a mechanism, reduced.
pub(super) struct Reduced {
    /// The sums of rows that do not depend on eliminated coordinates.
    equations: Vec<Sum>,
    /// The eliminated coordinates, each with the sum of rows that determines it and its factor in that sum.
    eliminated: Vec<(usize, Sum, f64)>,
    /// The remaining coordinates.
    pub(super) remaining: Vec<usize>,
    /// The derivative of every equation with respect to every remaining coordinate: a sum over the entries of the rows.
    derivatives: Vec<Vec<Sum>>,
}

impl Reduced {
    /// Eliminates every coordinate whose entries are all literal integers.
    pub(super) fn new(square: &Square) -> Self {
        let n = square.coordinates();
        let mut constant = vec![true; n];
        let mut matrix = DMatrix::<f64>::zeros(n, n);
        for (&(row, column), value) in square.entries().iter().zip(square.constants()) {
            match value.filter(|value| value.fract() == 0.0 && value.abs() <= MAX_FACTOR) {
                Some(value) => matrix[(row, column)] += value,
                None => constant[column] = false,
            }
        }
        // Row k of this matrix has the factors of the rows whose sum is the reduced row k.
        let mut sums = DMatrix::<f64>::identity(n, n);
        let (mut free, mut eliminated) = ((0..n).collect::<Vec<usize>>(), Vec::new());
        for column in (0..n).filter(|&column| constant[column]) {
            let Some(at) = free.iter().position(|&row| matrix[(row, column)].abs() == 1.0) else { continue };
            let pivot = free[at];
            let factors: Vec<f64> = (0..n).map(|row| matrix[(row, column)] / matrix[(pivot, column)]).collect();
            let (mut reduced, mut added) = (matrix.clone(), sums.clone());
            for row in (0..n).filter(|&row| row != pivot && factors[row] != 0.0) {
                for k in 0..n {
                    reduced[(row, k)] -= factors[row] * matrix[(pivot, k)];
                    added[(row, k)] -= factors[row] * sums[(pivot, k)];
                }
            }
            if reduced.iter().chain(added.iter()).any(|factor| factor.abs() > MAX_FACTOR) {
                continue;
            }
            (matrix, sums) = (reduced, added);
            free.remove(at);
            eliminated.push((column, pivot));
        }
        let sum =
            |row: usize| (0..n).map(|k| (k, sums[(row, k)])).filter(|(_, factor)| *factor != 0.0).collect::<Sum>();
        let remaining: Vec<usize> =
            (0..n).filter(|column| eliminated.iter().all(|(other, _)| other != column)).collect();
        let equations: Vec<Sum> = free.iter().map(|&row| sum(row)).collect();
        let derivative = |equation: &Sum, by: usize| -> Sum {
            let factor = |row: usize| equation.iter().find(|(term_row, _)| *term_row == row).map(|(_, factor)| *factor);
            let entries = square.entries().iter().enumerate().filter(|(_, (_, column))| *column == by);
            entries.filter_map(|(entry, &(row, _))| Some((entry, factor(row)?))).collect()
        };
        let derivatives =
            equations.iter().map(|equation| remaining.iter().map(|&by| derivative(equation, by)).collect()).collect();
        let eliminated = eliminated.iter().map(|&(column, row)| (column, sum(row), matrix[(row, column)])).collect();
        Self { equations, eliminated, remaining, derivatives }
    }

    /// Whether an equation depends on a remaining coordinate, given by its index among them.
    pub(super) fn depends(&self, equation: usize, coordinate: usize) -> bool {
        !self.derivatives[equation][coordinate].is_empty()
    }

    /// Writes the reduced equations' values, given those of the rows.
    pub(super) fn values(&self, rows: &[Interval], values: &mut Vec<Interval>) {
        values.clear();
        values.extend(self.equations.iter().map(|sum| total(sum, rows)));
    }

    /// The derivative of a reduced equation with respect to a remaining coordinate, given the entries of the rows.
    pub(super) fn derivative(&self, entries: &[Interval], equation: usize, coordinate: usize) -> Interval {
        total(&self.derivatives[equation][coordinate], entries)
    }

    /// The derivatives of a reduced equation with respect to all remaining coordinates.
    pub(super) fn gradient(&self, entries: &[Interval], equation: usize) -> Vec<Interval> {
        (0..self.remaining.len()).map(|k| self.derivative(entries, equation, k)).collect()
    }

    /// Writes the eliminated coordinates, given the values of the rows with these coordinates at 0.
    pub(super) fn complete(&self, rows: &[Interval], q: &mut [Interval]) {
        for (column, sum, factor) in &self.eliminated {
            q[*column] = -(total(sum, rows) / Interval::from(*factor));
        }
    }
}

fn total(sum: &Sum, numbers: &[Interval]) -> Interval {
    let term = |&(index, factor): &(usize, f64)| match factor {
        1.0 => numbers[index],
        -1.0 => -numbers[index],
        _ => Interval::from(factor) * numbers[index],
    };
    let mut terms = sum.iter().map(term);
    let first = terms.next().unwrap_or(Interval::new(0.0, 0.0));
    terms.fold(first, |sum, term| sum + term)
}

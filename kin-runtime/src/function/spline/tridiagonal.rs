//! Diagonally dominant tridiagonal systems, plain and cyclic.

use alloc::vec::Vec;

/// Row i: `lower[i]` x_{i−1} + `diagonal[i]` x_i + `upper[i]` x_{i+1} = right-hand side.
pub(super) struct Tridiagonal {
    pub(super) lower: Vec<f64>,
    pub(super) diagonal: Vec<f64>,
    pub(super) upper: Vec<f64>,
}

impl Tridiagonal {
    /// Solves the system by Thomas' algorithm; `lower[0]` and the last of `upper` are not read. Elimination without
    /// pivoting is stable because every row is diagonally dominant.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let n = right.len();
        let (mut x, mut factor) = (right.to_vec(), Vec::with_capacity(n));
        for i in 0..n {
            let (mut pivot, mut value) = (self.diagonal[i], x[i]);
            if i > 0 {
                pivot -= self.lower[i] * factor[i - 1];
                value -= self.lower[i] * x[i - 1];
            }
            factor.push(self.upper[i] / pivot);
            x[i] = value / pivot;
        }
        for i in (0..n.saturating_sub(1)).rev() {
            x[i] -= factor[i] * x[i + 1];
        }
        x
    }

    /// Solves the cyclic system, in which `lower[0]` multiplies the last unknown and the last of `upper` the first one:
    /// the plain system with a correction of rank one (Sherman–Morrison). Requires at least three unknowns.
    pub(super) fn solve_cyclic(&self, right: &[f64]) -> Vec<f64> {
        let last = right.len() - 1;
        let (corner_right, corner_left) = (self.lower[0], self.upper[last]);
        let gamma = -self.diagonal[0];
        let mut diagonal = self.diagonal.clone();
        diagonal[0] -= gamma;
        diagonal[last] -= corner_left * corner_right / gamma;
        let plain = Self { lower: self.lower.clone(), diagonal, upper: self.upper.clone() };
        let mut u = alloc::vec![0.0; last + 1];
        u[0] = gamma;
        u[last] = corner_left;
        let (x, z) = (plain.solve(right), plain.solve(&u));
        let ratio = corner_right / gamma;
        let factor = (x[0] + ratio * x[last]) / (1.0 + z[0] + ratio * z[last]);
        x.iter().zip(&z).map(|(x, z)| x - factor * z).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn system(n: usize) -> (Tridiagonal, Vec<f64>) {
        let at = |i: usize| 0.3 + 0.1 * (i as f64 * 1.7).sin();
        let matrix = Tridiagonal {
            lower: (0..n).map(at).collect(),
            diagonal: (0..n).map(|i| 2.0 + at(3 * i)).collect(),
            upper: (0..n).map(|i| at(i + 5)).collect(),
        };
        (matrix, (0..n).map(|i| (i as f64).cos()).collect())
    }

    #[test]
    fn both_solutions_satisfy_their_equations() {
        for n in [1, 2, 3, 4, 11] {
            let (m, b) = system(n);
            let x = m.solve(&b);
            for i in 0..n {
                let left = if i > 0 { m.lower[i] * x[i - 1] } else { 0.0 };
                let right = if i + 1 < n { m.upper[i] * x[i + 1] } else { 0.0 };
                assert!((left + m.diagonal[i] * x[i] + right - b[i]).abs() < 1e-15);
            }
        }
        for n in [3, 4, 11] {
            let (m, b) = system(n);
            let x = m.solve_cyclic(&b);
            for i in 0..n {
                let terms = [m.lower[i] * x[(i + n - 1) % n], m.diagonal[i] * x[i], m.upper[i] * x[(i + 1) % n]];
                assert!((terms.iter().sum::<f64>() - b[i]).abs() < 1e-15);
            }
        }
    }
}

//! The globalised iteration on functions with known roots.

use crate::nonlinear::newton::{Iteration, NewtonSettings, Residual, solve};
use nalgebra::{DMatrix, DVector};

/// r and J.
type Values<const ROWS: usize, const COLUMNS: usize> = ([f64; ROWS], [[f64; COLUMNS]; ROWS]);

/// r and J as functions of q.
struct Function<const ROWS: usize, const COLUMNS: usize> {
    of: fn(&[f64]) -> Values<ROWS, COLUMNS>,
    last: Values<ROWS, COLUMNS>,
}

impl<const R: usize, const C: usize> Residual for Function<R, C> {
    fn evaluate(&mut self, q: &[f64]) -> bool {
        self.last = (self.of)(q);
        self.last.0.iter().chain(self.last.1.as_flattened()).all(|x| x.is_finite())
    }

    fn residual(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.last.0)
    }

    fn jacobian(&self) -> DMatrix<f64> {
        DMatrix::from_fn(R, C, |i, j| self.last.1[i][j])
    }

    fn columns(&self) -> &[f64] {
        &[1.0; 8][..C]
    }
}

fn run<const R: usize, const C: usize>(of: fn(&[f64]) -> Values<R, C>, q: &mut [f64; C]) -> Iteration {
    let settings = NewtonSettings { max_iterations: 200, tolerance: 1e-11, trust_radius: 0.5, rank_tolerance: 1e-8 };
    solve(&mut Function { of, last: ([0.0; R], [[0.0; C]; R]) }, q, &settings)
}

#[test]
fn a_far_start_reaches_the_root_of_a_banana() {
    let mut q = [-1.2, 1.0];
    let outcome = run(|q| ([10.0 * (q[1] - q[0] * q[0]), 1.0 - q[0]], [[-20.0 * q[0], 10.0], [-1.0, 0.0]]), &mut q);
    assert!(outcome.converged && outcome.gap < 1e-14, "{outcome:?}");
    assert!((q[0] - 1.0).abs() < 1e-14 && (q[1] - 1.0).abs() < 1e-14);
}

#[test]
fn a_double_root_is_as_accurate_as_it_can_be() {
    let mut q = [0.7];
    let outcome = run(|q| ([1.0 - q[0].cos()], [[q[0].sin()]]), &mut q);
    assert!(outcome.converged && q[0].abs() < 3e-8, "{q:?} {outcome:?}");
}

#[test]
fn no_root_is_an_open_gap() {
    let mut q = [0.9, 0.2];
    let outcome = run(|q| ([q[0] * q[0] + 1.0, q[1]], [[2.0 * q[0], 0.0], [0.0, 1.0]]), &mut q);
    assert!(!outcome.converged && outcome.worst == 0 && outcome.iterations < 200, "{outcome:?}");
    assert!((outcome.gap - 1.0).abs() < 1e-3, "{outcome:?}");
}

#[test]
fn fewer_rows_move_as_little_as_possible() {
    let mut q = [2.0, 2.0];
    let outcome = run(|q| ([q[0] + q[1] - 1.0], [[1.0, 1.0]]), &mut q);
    assert!(outcome.converged && (q[0] - 0.5).abs() < 1e-15 && (q[1] - 0.5).abs() < 1e-15, "{q:?}");
}

#[test]
fn repeated_rows_converge_and_contradictions_do_not() {
    let mut q = [2.0];
    assert!(run(|q| ([q[0] - 1.0, 2.0 * q[0] - 2.0], [[1.0], [2.0]]), &mut q).converged);
    assert!(!run(|q| ([q[0] - 1.0, q[0] - 1.1], [[1.0], [1.0]]), &mut q).converged);
}

#[test]
fn a_step_out_of_the_domain_is_shortened() {
    let mut q = [3.0];
    let outcome = run(|q| ([q[0].ln() + 3.0], [[1.0 / q[0]]]), &mut q);
    assert!(outcome.converged && (q[0] - (-3.0_f64).exp()).abs() < 1e-15, "{q:?} {outcome:?}");
}

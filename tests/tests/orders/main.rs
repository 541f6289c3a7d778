//! Derivatives above the second order: closed forms, the functions of the language, errors, and absence of allocations.

mod by_plan;
mod closed_forms;
mod functions;
mod long;
mod refusals;
mod rounding;
mod scaling;

use kin_runtime::{Kinematics, Solver};

/// q at t + h, the Taylor polynomial of the derivatives at t.
fn expanded(derivatives: &[Vec<f64>], h: f64) -> Vec<f64> {
    let n = derivatives[0].len();
    let mut sum = vec![0.0; n];
    for (order, derivative) in derivatives.iter().enumerate().rev() {
        // Horner's scheme: the remainder is multiplied by h/(order + 1).
        for (sum, value) in sum.iter_mut().zip(derivative) {
            *sum = *sum * h / (order + 1) as f64 + value;
        }
    }
    sum
}

/// The Taylor series at `t` gives the positions at t ± h.
fn expands<M: Kinematics>(solver: &Solver<'_, M>, t: f64, h: f64, order: usize, tolerance: f64) {
    let state = solver.state(&t.into()).unwrap();
    let derivatives = solver.derivatives(&state, order).unwrap();
    for h in [h, -h] {
        let reached = solver.position(&(t + h).into(), &state.q).unwrap().q;
        let expanded = expanded(&derivatives.q, h);
        for ((found, expected), name) in expanded.iter().zip(&reached).zip(M::model().coordinates) {
            assert!((found - expected).abs() < tolerance, "{} at {}: {found} {expected}", name.name, t + h);
        }
    }
}

//! Laws of the sparse factorisation of Φ_q: results agree with those by dense rank-revealing factorisations.

use crate::motion::grid;
use kin_runtime::Options;
use kin_tests::compare::{Differences, largest};
use kin_tests::subject::{Analyses, Subject};

/// A solver by full Newton, with sparse or dense factorisations.
fn newton(mechanism: &dyn Subject, use_sparse: bool) -> Box<dyn Analyses + '_> {
    let options = Options { use_plan: false, use_sparse, ..Options::default() };
    mechanism.driven(options)
}

/// Sweeps by both factorisations agree, and so do single states.
pub(crate) fn sparse_elimination_changes_nothing(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let times = grid(from, to, 24);
    let [sparse, dense] = [true, false].map(|use_sparse| newton(mechanism, use_sparse));
    let mut differences = Differences::new();
    let name = |place: usize| model.coordinates[place].name;
    let (swept, expected) = (sparse.sweep(&times).unwrap(), dense.sweep(&times).unwrap());
    differences.equal("states", expected.len(), swept.len());
    for (swept, expected) in swept.iter().zip(&expected) {
        let alone = sparse.state_from(&expected.instant(), &expected.q).unwrap();
        for (how, found) in [("swept", swept), ("alone", &alone)] {
            differences.at(format_args!("{how}, t = {}", expected.t));
            differences.equal("degrees of freedom", expected.degrees_of_freedom_left, found.degrees_of_freedom_left);
            for (what, expected, found) in [
                ("q", &expected.q, &found.q),
                ("q_dot", &expected.q_dot, &found.q_dot),
                ("q_ddot", &expected.q_ddot, &found.q_ddot),
            ] {
                differences.vector(what, name, expected, found, 1e-12 * largest(expected).max(1.0));
            }
            differences.number("residual", 0.0, found.residual, 1e-12);
        }
        conditions_are_true(&*sparse, &alone, &mut differences);
    }
    differences.finish();
}

/// κ₁ and κ₂ of an n×n matrix differ at most by a factor of n; the estimate may be too small by a factor of three.
fn conditions_are_true(solver: &dyn Analyses, state: &kin_runtime::State, differences: &mut Differences) {
    let mobility = solver.mobility(&state.instant(), &state.q).unwrap();
    let n = state.model.coordinates.len() as f64;
    if state.model.rows.len() == state.model.coordinates.len() && mobility.rank == state.model.coordinates.len() {
        let condition = solver.condition(state).unwrap();
        let share = condition / mobility.condition;
        if share.is_nan() || share < 1.0 / (3.0 * n) || share > 1.001 * n {
            differences.report(format_args!("condition {condition} where {} is that of |x|", mobility.condition));
        }
    }
}

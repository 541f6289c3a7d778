//! Laws of solved configurations.

use crate::When;
use kin_runtime::{Options, SolveError, Subset, Trajectory};
use kin_tests::compare::{Differences, largest};
use kin_tests::random::Random;
use kin_tests::stencil::Stencil;
use kin_tests::subject::Subject;

/// `count` + 1 times from `from` to `to`.
pub(crate) fn grid(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * f64::from(k) / f64::from(count)).collect()
}

pub(crate) fn swept(mechanism: &dyn Subject, times: &[f64]) -> Trajectory {
    mechanism.driven(Options::default()).sweep(times).unwrap_or_else(|error| panic!("{error}"))
}

/// After solving, |Φ| ≤ 1e-12, and Φ_q q̇ + Φ_t and Φ_q q̈ − γ vanish.
pub(crate) fn solved_configurations_close(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let mut differences = Differences::new();
    for state in &swept(mechanism, &grid(from, to, 12)) {
        let found = mechanism.evaluate(Subset::ALL, &state.instant(), &state.q, &state.q_dot);
        let times = |vector: &[f64]| {
            let mut product = vec![0.0; model.rows.len()];
            for (&(row, column), entry) in model.constraint_pattern.entries.iter().zip(&found.phi_q) {
                product[row] += entry * vector[column];
            }
            product
        };
        differences.at(format_args!("t = {}", state.t));
        let row = |row: usize| model.rows[row].name;
        differences.vector("Φ", row, &vec![0.0; model.rows.len()], &found.phi, 1e-12);
        let nu: Vec<f64> = found.phi_t.iter().map(|entry| -entry).collect();
        differences.vector("ν", row, &nu, &times(&state.q_dot), 1e-11 * largest(&state.q_dot).max(1.0));
        differences.vector("γ", row, &found.gamma, &times(&state.q_ddot), 1e-11 * largest(&state.q_ddot).max(1.0));
    }
    differences.finish();
}

/// q̇ and q̈ are the derivatives of q.
pub(crate) fn rates_are_derivatives(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let mut differences = Differences::new();
    for stencil in Stencil::several(from, to) {
        let states = swept(mechanism, &stencil.times(from)).states;
        let states = &states[1..];
        let middle = &states[Stencil::REACH];
        if middle.degrees_of_freedom_left > 0 {
            return;
        }
        differences.at(format_args!("t = {}", middle.t));
        let (slow, slower) = (largest(&middle.q_dot), largest(&middle.q_ddot));
        for place in 0..model.coordinates.len() {
            let samples: Vec<f64> = states.iter().map(|state| state.q[place]).collect();
            let found = [middle.q_dot[place], middle.q_ddot[place]];
            stencil.compare(&mut differences, model.coordinates[place].name, &samples, found, [slow, slower]);
        }
    }
    differences.finish();
}

/// A sweep between two distant instants ends in the same state as one with many instants in between.
pub(crate) fn far_instants_equal_close_ones(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let close = swept(mechanism, &grid(from, to, 200));
    let far = swept(mechanism, &[from, to]);
    let (close, far) = (&close.states[200], &far.states[1]);
    if close.degrees_of_freedom_left > 0 {
        return;
    }
    let mut differences = Differences::new();
    differences.at(format_args!("t = {to}"));
    let name = |place: usize| model.coordinates[place].name;
    for (what, close, far) in
        [("q", &close.q, &far.q), ("q_dot", &close.q_dot, &far.q_dot), ("q_ddot", &close.q_ddot, &far.q_ddot)]
    {
        differences.vector(what, name, close, far, 1e-10 * largest(close).max(1.0));
    }
    differences.finish();
}

/// From any start, a position analysis assembles the mechanism or returns an error.
pub(crate) fn any_start_closes_or_fails(mechanism: &dyn Subject, from: f64) {
    let when = When::of(mechanism, from);
    let at = when.at();
    let near = mechanism.state_at(&at).unwrap().q;
    let mut random = Random::new(17);
    for (spread, starts) in [(0.05, 4), (0.5, 4), (3.0, 4), (100.0, 2)] {
        for _ in 0..starts {
            let start: Vec<f64> = near.iter().map(|q| q + random.between(-spread, spread)).collect();
            match mechanism.solver().position(&at, &start) {
                Ok(position) => {
                    let phi = mechanism.constraints(&at, &position.q).unwrap();
                    assert!(largest(&phi) <= 1e-12, "{:e} from {start:?}", largest(&phi));
                }
                Err(SolveError::NotAssembled { gap, .. }) => assert!(gap.is_finite() && gap > 0.0, "{start:?}"),
                // A root or a logarithm in a free equation may be undefined at the start.
                Err(SolveError::Singular { .. } | SolveError::NonFinite { what: "Φ", .. }) => {}
                Err(error) => panic!("{error} from {start:?}"),
            }
        }
    }
}

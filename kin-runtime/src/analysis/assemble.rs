//! Assembly from guesses, some or all of which may be missing.
//!
//! 1. **Propagate**: a row with only one unknown coordinate, in which it is affine, determines that coordinate; this is
//!    repeated until nothing changes. It finds driven angles and, from the ground outwards, the origins of bodies whose
//!    angle is known.
//! 2. **Partial**: coordinates that are still unknown start at zero; Newton moves only these.
//! 3. **Full** position analysis from there.
//!
//! If that fails, further attempts vary the coordinates without a guess, by the same pseudo-random values in every run.
//! Guesses are not varied, because they choose the mode.

use crate::analysis::position::{Position, close_all, finish};
use crate::analysis::subsystem_residual::close;
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::random::Random;
use crate::workspace::Subset;

/// The configuration that the guesses lead to.
pub(crate) fn assemble(equations: &mut Equations<'_>, guesses: &[Option<f64>]) -> Result<Position, SolveError> {
    let mut assembled = attempts(equations, guesses);
    if let Err(SolveError::NotAssembled { all_guessed, .. }) = &mut assembled {
        *all_guessed = !guesses.is_empty() && guesses.iter().all(Option::is_some);
    }
    assembled
}

/// All attempts: one, and further ones if there are coordinates to vary.
fn attempts(equations: &mut Equations<'_>, guesses: &[Option<f64>]) -> Result<Position, SolveError> {
    let start: Vec<f64> = guesses.iter().map(|g| g.unwrap_or(0.0)).collect();
    equations.check("guess", &start)?;
    let (q, _) = propagate(equations, guesses, &start);
    equations.scale = Scale::before_assembly(equations, &q);
    let unguessed: Vec<usize> = (0..guesses.len()).filter(|&k| guesses[k].is_none()).collect();

    let mut random = Random::new(0x00a5_5e3b_1e00);
    let mut attempt = |equations: &mut Equations<'_>, number: usize| {
        let mut start = start.clone();
        if number > 0 {
            for &k in &unguessed {
                start[k] += equations.scale.columns[k] * core::f64::consts::PI * random.symmetric();
            }
        }
        let (mut q, open) = propagate(equations, guesses, &start);
        if open.is_empty() && number > 0 {
            // Propagation found all coordinates: perturb them.
            for &k in &unguessed {
                q[k] += equations.scale.columns[k] * 0.5 * random.symmetric();
            }
        }
        if !open.is_empty() && number.is_multiple_of(2) {
            // Rows without an unknown coordinate are left out.
            let moves = |e: &Equations<'_>, row| e.row(row).any(|(k, _)| open.binary_search(&k).is_ok());
            let rows = equations.rows_where(|e, row| e.holonomic(row) && moves(e, row));
            close(equations, &rows, &open, &mut q);
        }
        let outcome = close_all(equations, &mut q);
        (q, outcome)
    };
    let (mut q, mut outcome) = attempt(equations, 0);
    let further = if unguessed.is_empty() { 0 } else { equations.options.restarts };
    for number in 1..=further {
        if outcome.converged {
            break;
        }
        let (other, second) = attempt(equations, number);
        if second.converged || second.gap < outcome.gap {
            (q, outcome) = (other, second);
        }
    }
    finish(equations, q, outcome)
}

/// The guesses, the coordinates that rows determine by propagation, and 0 for the rest.
pub(crate) fn propagated(equations: &mut Equations<'_>, guesses: &[Option<f64>]) -> Vec<f64> {
    let start: Vec<f64> = guesses.iter().map(|g| g.unwrap_or(0.0)).collect();
    propagate(equations, guesses, &start).0
}

/// Determines unguessed coordinates row by row; returns q and the coordinates that stay undetermined.
fn propagate(equations: &mut Equations<'_>, guesses: &[Option<f64>], start: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let mut q = start.to_vec();
    let mut known: Vec<bool> = guesses.iter().map(Option::is_some).collect();
    let rows: Vec<(usize, Vec<usize>)> =
        equations.rows_where(Equations::holonomic).into_iter().map(|row| (row, columns_of(equations, row))).collect();
    // A coordinate that a single row determines, such as a driven angle, needs no guess, and no guess can change it.
    for (row, columns) in &rows {
        let &[k] = columns.as_slice() else { continue };
        if let Some(value) = affine_root(equations, *row, k, &mut q) {
            q[k] = value;
            known[k] = true;
        }
    }
    loop {
        let mut changed = false;
        for (row, columns) in &rows {
            let mut unknown = columns.iter().copied().filter(|&k| !known[k]);
            let (Some(k), None) = (unknown.next(), unknown.next()) else { continue };
            if let Some(value) = affine_root(equations, *row, k, &mut q) {
                q[k] = value;
                known[k] = true;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    let open = (0..q.len()).filter(|&k| !known[k]).collect();
    (q, open)
}

/// Columns in which a row has entries.
fn columns_of(equations: &Equations<'_>, row: usize) -> Vec<usize> {
    equations.row(row).map(|(column, _)| column).collect()
}

/// The root of a row in one coordinate, if one Newton step solves it.
fn affine_root(equations: &mut Equations<'_>, row: usize, k: usize, q: &mut [f64]) -> Option<f64> {
    let before = q[k];
    equations.evaluate(Subset::POSITION, q, None).ok()?;
    let (value, slope) = (equations.phi[row], equations.entry(row, k));
    q[k] = before - value / slope;
    let root = q[k];
    let solved = root.is_finite()
        && equations.evaluate(Subset::POSITION, q, None).is_ok()
        && equations.phi[row].abs() <= 1e-9 * value.abs().max(slope.abs() * (root.abs() + before.abs()))
        && (equations.entry(row, k) - slope).abs() <= 1e-9 * slope.abs();
    q[k] = before;
    solved.then_some(root)
}

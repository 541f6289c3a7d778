//! Comparison of the plan with the equations, and with full Newton.
//!
//! At every configuration the plan solves in the assembly modes of that configuration. Its solution must satisfy Φ = 0,
//! Φ_q q̇ = −Φ_t and Φ_q q̈ = γ, row by row. From configurations given by the caller full Newton solves as well, and q,
//! q̇ and q̈ are compared number by number.

use super::configuration::{Centre, Configuration, CrossCheckOptions, random_configuration};
use super::result::CrossCheck;
use crate::equations::system::System;
use crate::error::SolveError;
use crate::observer::{Observed, Observer};
use crate::plan::{Depth, Solved};
use crate::planned::PlanError;
use crate::random::Random;
use crate::signal::Instant;
use crate::state::State;
use crate::workspace::Subset;

/// Where a margin is below this, the configuration is too near to a limit: rounding errors are larger than those of the
/// plan.
const MIN_MARGIN: f64 = 1e-3;

/// Solves by full Newton from a start.
type Newton<'n> = dyn Fn(&Instant<'_>, &[f64]) -> Result<State, SolveError> + 'n;

/// Checks the plan of a mechanism at the configurations that `options` describe.
pub(crate) fn plan_check(
    system: &mut dyn System,
    options: &CrossCheckOptions,
    centre: &Centre,
    observer: Option<Observer<'_>>,
    newton: &Newton<'_>,
) -> Result<CrossCheck, SolveError> {
    let model = system.model();
    if let Some(why) = model.plan.absent {
        return Err(SolveError::Plan(PlanError::NoPlan { why }));
    }
    let mut check = CrossCheck::new();
    let mut random = Random::new(options.seed);
    let given_count = options.given.len();
    let mut observed = Observed::new(observer, given_count + options.configurations);
    for number in 0..given_count + options.configurations {
        let drawn;
        let configuration = match options.given.get(number) {
            Some(given) => given,
            None => {
                drawn = random_configuration(model, &mut random, number - given_count, centre);
                &drawn
            }
        };
        let at = Instant { t: configuration.t, inputs: &configuration.inputs };
        let Some(planned) = solve(system, &at, configuration)? else {
            check.skipped += 1;
            observed.finish(at.t, None)?;
            continue;
        };
        check.configurations += 1;
        rows(&mut check, system, &at, &planned)?;
        if number < given_count {
            let state = newton(&at, &planned[0])?;
            for (letter, found, expected) in
                [("q", &planned[0], state.q), ("q̇", &planned[1], state.q_dot), ("q̈", &planned[2], state.q_ddot)]
            {
                let size = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                for ((&found, &expected), coordinate) in found.iter().zip(&expected).zip(model.coordinates) {
                    let (error, at) = ((found - expected).abs() / size, (at.t, &planned[0][..], &planned[1][..]));
                    check.add([letter, coordinate.name, ""], [found, expected], error, at);
                }
            }
        }
        observed.finish(at.t, None)?;
    }
    check.worst.error = check.worst.error.max(0.0);
    Ok(check)
}

/// q, q̇ and q̈ by the plan; `None` where the plan has no solution or the solution is near a limit.
fn solve(
    system: &mut dyn System,
    at: &Instant<'_>,
    configuration: &Configuration,
) -> Result<Option<[Vec<f64>; 3]>, SolveError> {
    let (plan, coordinates) = (&system.model().plan, system.model().coordinates.len());
    let mut modes = vec![0.0; plan.signs()];
    system.branches(at, &configuration.q, &mut modes)?;
    modes.truncate(plan.modes.len());
    modes.iter_mut().for_each(|mode| *mode = if *mode < 0.0 { -1.0 } else { 1.0 });
    let mut found = [(); 3].map(|()| vec![0.0; coordinates]);
    let mut margins = vec![0.0; plan.margins];
    let [q, q_dot, q_ddot] = &mut found;
    let solved = Solved { q, q_dot, q_ddot, margins: &mut margins };
    system.solve(at, &modes, &configuration.q, Depth::Acceleration, solved)?;
    Ok(margins.iter().all(|margin| *margin > MIN_MARGIN).then_some(found))
}

/// Compares every row of Φ and of the velocity and acceleration equations.
fn rows(
    check: &mut CrossCheck,
    system: &mut dyn System,
    at: &Instant<'_>,
    [q, q_dot, q_ddot]: &[Vec<f64>; 3],
) -> Result<(), SolveError> {
    let model = system.model();
    system.evaluate(Subset::ALL, at, q, q_dot)?;
    let parts = system.constraints();
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    // The terms of γ are coefficients times two rates, one of which belongs to an angle or a scalar. Where these terms
    // cancel and all accelerations vanish, the rounding error still has the size of the terms.
    let turning = (model.coordinates.iter().zip(q_dot))
        .filter(|(coordinate, _)| !coordinate.kind.is_length())
        .fold(0.0_f64, |most, (_, rate)| most.max(rate.abs()));
    let sizes = [largest(q), largest(q_dot), largest(q_ddot).max(turning * largest(q_dot))];
    let mut sums = [parts.phi, parts.phi_t, parts.gamma].map(<[f64]>::to_vec);
    sums[2].iter_mut().for_each(|gamma| *gamma = -*gamma);
    let mut terms = vec![[0.0_f64; 3]; model.rows.len()];
    for (row, terms) in terms.iter_mut().enumerate() {
        *terms = [0.0, sums[1][row].abs(), sums[2][row].abs()];
    }
    for (&(row, column), &entry) in model.constraint_pattern.entries.iter().zip(parts.phi_q) {
        sums[1][row] += entry * q_dot[column];
        sums[2][row] += entry * q_ddot[column];
        terms[row].iter_mut().zip(sizes).for_each(|(most, size)| *most = most.max(entry.abs() * size));
    }
    for (sums, (k, equation)) in sums.iter().zip([(0, "Φ"), (1, "Φ_q q̇ = −Φ_t"), (2, "Φ_q q̈ = γ")]) {
        for (row, info) in model.rows.iter().enumerate() {
            let error = if sums[row] == 0.0 { 0.0 } else { sums[row].abs() / terms[row][k] };
            check.add([equation, info.name, ""], [sums[row], 0.0], error, (at.t, q, q_dot));
        }
    }
    Ok(())
}

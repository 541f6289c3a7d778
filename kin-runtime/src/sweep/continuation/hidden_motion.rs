//! The motion within a step of full Newton.

use crate::analysis::velocity::scaled;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::planned::hidden_motion::FRACTIONS;
use crate::planned::interior::on_cubic;
use crate::workspace::Subset;

/// True if a step hides no motion: at instants within it the Newton step from the cubic through both
/// ends is not longer than `allowed` on the common scale (see [`planned::hidden_motion`](crate::planned::hidden_motion)). `ends` are q
/// and q̇ at both ends, and `factor` is the factorisation of Φ_q at the last one, where the equations are left evaluated.
pub(super) fn hides_nothing(
    equations: &mut Equations<'_>,
    [from, s]: [f64; 2],
    ends: [&[f64]; 4],
    factor: &Factorization,
    allowed: f64,
) -> Result<bool, SolveError> {
    let (h, q) = (s - from, ends[2]);
    if !equations.system.known_values_curve() || h == 0.0 {
        return Ok(true);
    }
    let (mut cubic, mut is_near) = (vec![0.0; q.len()], true);
    for fraction in FRACTIONS {
        on_cubic(&mut cubic, ends, h, fraction);
        let moved = equations.move_to(from + fraction * h);
        is_near &= moved.and_then(|()| equations.evaluate(Subset::POSITION, &cubic, None)).is_ok_and(|()| {
            let step = factor.solve(&scaled(equations, &equations.phi));
            // The comparison is written so that NaN is rejected.
            equations.scale.size(step.as_slice()) <= allowed
        });
    }
    equations.move_to(s)?;
    equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, q, None)?;
    Ok(is_near)
}

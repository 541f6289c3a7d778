//! The motion within a step of full Newton.

use crate::analysis::velocity::scaled;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::planned::between::on_cubic;
use crate::planned::within::PLACES;
use crate::workspace::Subset;

/// True if a step between two places hides no motion: at places within it the Newton step from the cubic through both
/// ends is not longer than `allowed` on the common scale (see [`planned::within`](crate::planned::within)). `ends` are q
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
    for place in PLACES {
        on_cubic(&mut cubic, ends, h, place);
        let moved = equations.move_to(from + place * h);
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

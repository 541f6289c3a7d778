//! The motion within a step of full Newton.

use super::step::{Fault, NEGLIGIBLE, Start};
use crate::analysis::velocity::scaled;
use crate::equations::Equations;
use crate::linear::Factorization;
use crate::planned::between::on_cubic;
use crate::planned::within::places_within;
use crate::workspace::Subset;

/// True if a step hides no motion: at places within it the Newton step from the cubic through both ends is short
/// (see [`planned::within`](crate::planned::within)). `end` are s, q and q̇ at the end, and `factor` is the factorisation
/// of Φ_q there. The equations are left evaluated at the end.
pub(super) fn hides_nothing(
    equations: &mut Equations<'_>,
    from: Start<'_>,
    (s, q, q_dot): (f64, &[f64], &[f64]),
    factor: &Factorization,
) -> Result<bool, Fault> {
    let h = s - from.s;
    if !equations.system.known_values_curve() || h == 0.0 {
        return Ok(true);
    }
    let motion: Vec<f64> = from.q_dot.iter().zip(from.q_ddot).map(|(v, a)| h * (v + 0.5 * h * a)).collect();
    let allowed = equations.options.prediction_tolerance * equations.scale.size(&motion) + NEGLIGIBLE;
    let (mut cubic, mut is_near) = (vec![0.0; q.len()], true);
    for place in places_within() {
        on_cubic(&mut cubic, [&from.node.state.q, from.q_dot, q, q_dot], h, place);
        let moved = equations.move_to(from.s + place * h);
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

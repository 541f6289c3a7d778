//! The motion within a step of full Newton.

use crate::analysis::velocity::scaled;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::planned::interior::{IRREGULAR_FRACTIONS, on_cubic};
use crate::planned::narrow_curves::Resolution;
use crate::planned::parts::Span;
use crate::signal::Instant;
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
    let mut cubic = vec![0.0; q.len()];
    let mut is_near = |equations: &mut Equations<'_>, fraction: f64| {
        on_cubic(&mut cubic, ends, h, fraction);
        let moved = equations.move_to(from + fraction * h);
        moved.and_then(|()| equations.evaluate(Subset::POSITION, &cubic, None)).is_ok_and(|()| {
            let step = factor.solve(&scaled(equations, &equations.phi));
            // The comparison is written so that NaN is rejected.
            equations.scale.size(step.as_slice()) <= allowed
        })
    };
    let mut hides_nothing = IRREGULAR_FRACTIONS.into_iter().all(|fraction| is_near(equations, fraction));
    if hides_nothing {
        let places = places_of_narrow_curves(equations, [from, s], ends, Resolution::OF_POSITIONS)?;
        hides_nothing = places.into_iter().all(|place| is_near(equations, place));
    }
    equations.move_to(s)?;
    equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, q, None)?;
    Ok(hides_nothing)
}

/// Fractions of a step at which it must be looked into because known functions may have a narrow feature there (see
/// [`planned::narrow_curves`](crate::planned::narrow_curves)). The equations are left at the end of the step.
pub(super) fn places_of_narrow_curves(
    equations: &mut Equations<'_>,
    [from, s]: [f64; 2],
    ends: [&[f64]; 4],
    resolution: Resolution,
) -> Result<Vec<f64>, SolveError> {
    equations.move_to(from)?;
    let (t, inputs) = (equations.t, equations.inputs.clone());
    equations.move_to(s)?;
    let span = Span { ends, inputs: &inputs, h: s - from };
    let mut places = Vec::new();
    let mut look = |place: f64| {
        places.push(place);
        Ok(true)
    };
    let instants = [&Instant { t, inputs: &inputs }, &equations.instant()];
    let found = equations.system.follows_narrow_curves(instants, span, resolution, &mut look);
    debug_assert!(found == Ok(true), "the lists have the right lengths");
    Ok(places)
}

//! One step of a motion with rows of velocity level: integrate, project onto Φ = 0, check the branch.
//!
//! Rows of velocity level do not determine the position, which follows from the preceding motion. With Φ of the rows of
//! position level and B, b of the others, the differential equation
//!
//! ```text
//! q̇ = v(q, t):   [Φ_q; B] q̇ = −[Φ_t; b]
//! ```
//!
//! is integrated by the Runge–Kutta pair of [`dormand_prince`](crate::nonlinear::dormand_prince). The step length keeps
//! the estimated error of every coordinate below `Options::integration_tolerance` on the common scale. The result is
//! then moved onto Φ(q, t) = 0 by the correction of least norm, which is of the size of that error. Where degrees of
//! freedom are left, v is the velocity of least Euclidean norm, as in all analyses. With redundant rows v solves all
//! rows in the sense of least squares; on Φ = 0 the rows are consistent. Rank and orientation of the branch are checked
//! as in [`step`](super::step), so that no singular configuration is passed.
//!
//! The estimated error only knows the stages: a velocity that rises and falls between them would be missed. Therefore v is
//! also compared with the slope of the quartic through the stages at the [`IRREGULAR_FRACTIONS`] of a step, and wherever a
//! function in it may have a narrow peak (see [`planned::narrow_curves`](crate::planned::narrow_curves)). A difference up to
//! [`MAX_DEFECT`] tolerances is accepted: one that is found at no neighbouring place lasts for a small part of the step, and
//! what it moves is a small part of that.

use super::hidden_motion::places_of_narrow_curves;
use super::step::{Fault, Node, StepBuffers, StepStart, correct, settle};
use crate::analysis::velocity::scaled;
use crate::equations::Equations;
use crate::equations::factorisation::Purpose;
use crate::nonlinear::dormand_prince::{StepResult, bow, runge_kutta_step};
use crate::planned::interior::{IRREGULAR_FRACTIONS, on_cubic, slope_of_cubic};
use crate::planned::narrow_curves::Resolution;
use crate::workspace::Subset;

/// Safety factor of the step length that the error estimate allows.
const SAFETY: f64 = 0.9;
/// Factor by which a correction onto Φ = 0 may exceed the tolerance of one step.
const MAX_DRIFT: f64 = 1e3;
/// Factor by which the difference of the velocity from the quartic within a step, times its length, may exceed the
/// tolerance of one step.
const MAX_DEFECT: f64 = 1e3;

/// Writes the node at the place `s` to `to`; returns the factor by which the next step may be longer.
pub(super) fn integrate(
    equations: &mut Equations<'_>,
    scratch: &mut StepBuffers,
    from: StepStart<'_>,
    to: &mut Node,
    s: f64,
    last: bool,
) -> Result<f64, Fault> {
    let h = s - from.s;
    let q = &from.node.state.q;
    let rank = from.basis.factor.rank;
    let mut stages = vec![from.q_dot.to_vec()];
    let result = runge_kutta_step(h, q, from.q_dot, |since, q| {
        let found = velocity(equations, rank, [from.s, since], q)?;
        stages.push(found.clone());
        Ok::<_, Fault>(found)
    })?;
    let tolerance = equations.options.integration_tolerance;
    let effort = error(equations, q, &result) / tolerance;
    let factor = SAFETY * effort.powf(-0.2);
    if effort > 1.0 || effort.is_nan() {
        return Err(Fault::Coarse(if factor.is_finite() { factor.clamp(0.1, 0.8) } else { 0.1 }));
    }
    equations.move_to(s)?;
    let size = 1.0 + equations.scale.size(&result.y);
    scratch.predicted.clone_from(&result.y);
    let corrected = correct(equations, scratch, &mut to.state.q, MAX_DRIFT * tolerance * size, 1e-9)?;
    settle(equations, scratch, from, to, corrected, s, last)?;
    let is_regular = follows_quartic(equations, rank, ([q, &result.y], &stages), [from.s, s])?;
    equations.move_to(s)?;
    scratch.local_error = Some(result.error);
    if is_regular { Ok(factor.clamp(0.5, 4.0)) } else { Err(Fault::Coarse(0.5)) }
}

/// True if, at instants within a step of the length h, the velocity is the slope of the quartic through its stages. The
/// difference times h is of the order of the error estimate, and measured like it, coordinate by coordinate: neither a long
/// way nor the motion of other coordinates hides a turn.
fn follows_quartic(
    equations: &mut Equations<'_>,
    rank: usize,
    ([before, after], stages): ([&[f64]; 2], &[Vec<f64>]),
    [from, s]: [f64; 2],
) -> Result<bool, Fault> {
    let h = s - from;
    let ends = [before, &stages[0], after, &stages[stages.len() - 1]];
    let bow = bow(h, stages);
    let allowed = MAX_DEFECT * equations.options.integration_tolerance;
    let (mut within, mut off) = (vec![0.0; before.len()], vec![0.0; before.len()]);
    let mut is_near = |equations: &mut Equations<'_>, fraction: f64| -> Result<bool, Fault> {
        let [share, slope] = quartic(fraction);
        on_cubic(&mut within, ends, h, fraction);
        within.iter_mut().zip(&bow).for_each(|(q, d)| *q += share * d);
        let found = velocity(equations, rank, [from, fraction * h], &within)?;
        slope_of_cubic(&mut off, ends, h, fraction);
        off.iter_mut().zip(&bow).zip(found).for_each(|((v, d), found)| *v = h * (*v - found) + slope * d);
        // The comparison is written so that NaN is rejected.
        Ok(largest_share(equations, [before, after], &off) <= allowed)
    };
    for fraction in IRREGULAR_FRACTIONS {
        if !is_near(equations, fraction)? {
            return Ok(false);
        }
    }
    for place in places_of_narrow_curves(equations, [from, s], ends, Resolution::OF_VELOCITIES)? {
        if !is_near(equations, place)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// θ² (1 − θ)² and its slope at the fraction θ of a step.
fn quartic(fraction: f64) -> [f64; 2] {
    let product = fraction * (1.0 - fraction);
    [product * product, 2.0 * product * (1.0 - 2.0 * fraction)]
}

/// q̇ at a stage of the Runge–Kutta step, which is near Φ = 0 but not on it: at a place after another one.
pub(super) fn velocity(
    equations: &mut Equations<'_>,
    rank: usize,
    [from, since]: [f64; 2],
    q: &[f64],
) -> Result<Vec<f64>, Fault> {
    equations.move_from(from, since)?;
    equations.evaluate(Subset::VELOCITY, q, None)?;
    let factor = equations.factorise(Purpose::Solutions, None);
    if factor.rank < rank {
        return Err(Fault::Coarse(0.5));
    }
    Ok(factor.solve(&-scaled(equations, &equations.phi_t)).as_slice().to_vec())
}

/// Largest estimated error of a coordinate.
fn error(equations: &Equations<'_>, before: &[f64], result: &StepResult) -> f64 {
    largest_share(equations, [before, &result.y], &result.error)
}

/// The largest of these errors of coordinates on the common scale, relative to the size of the coordinate, at either end of
/// a step, where that exceeds 1; NaN where a coordinate is not finite.
fn largest_share(equations: &Equations<'_>, [before, after]: [&[f64]; 2], errors: &[f64]) -> f64 {
    let mut largest = 0.0;
    for (k, d) in equations.scale.columns.iter().enumerate() {
        let size = 1.0 + before[k].abs().max(after[k].abs()) / d;
        let error = (errors[k] / d).abs() / size;
        if error.is_nan() || !after[k].is_finite() {
            return f64::NAN;
        }
        largest = f64::max(largest, error);
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::system::Evaluator;
    use crate::fixture::StretchedSlider;
    use crate::options::Options;
    use crate::signal::Instant;

    /// Where Φ_q loses rank the velocity is not determined, so the step counts as too long.
    #[test]
    fn a_stage_that_loses_rank_has_no_velocity() {
        let slider = StretchedSlider;
        let system = Box::new(Evaluator::<_, StretchedSlider>::new(&slider));
        let mut equations = Equations::new(system, Options::default(), &[], None, &Instant::at(0.0)).unwrap();
        let at = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            [0.0, 0.0, phi, 0.23 * cos + 0.355, 0.23 * sin, 0.0, 0.23 * cos + 0.71, 0.0, 0.0]
        };
        assert!(velocity(&mut equations, 9, [0.475, 0.0], &at(0.4)).is_ok());
        let stretched = velocity(&mut equations, 9, [0.475, 0.0], &at(0.0));
        assert!(matches!(stretched, Err(Fault::Coarse(factor)) if factor < 1.0), "{stretched:?}");
    }

    /// The error is relative to the scaled size of the coordinate where that exceeds 1.
    #[test]
    fn an_error_is_that_of_the_worst_coordinate_beside_its_size() {
        let slider = StretchedSlider;
        let system = Box::new(Evaluator::<_, StretchedSlider>::new(&slider));
        let mut equations = Equations::new(system, Options::default(), &[], None, &Instant::at(0.0)).unwrap();
        equations.scale.columns.fill(2.0);
        let of = |before: f64, after: f64, found: [f64; 2]| {
            let (mut start, mut y, mut errors) = (vec![0.0; 9], vec![0.0; 9], vec![0.0; 9]);
            (start[3], y[3], errors[3], errors[8]) = (before, after, found[0], found[1]);
            error(&equations, &start, &StepResult { y, error: errors })
        };
        let is = |expected: f64, found: f64| assert!((found - expected).abs() < 1e-15, "{found} for {expected}");
        is(0.5, of(0.0, 0.0, [1.0, -0.4]));
        is(0.5, of(0.0, 0.0, [0.4, -1.0]));
        is(0.1, of(-8.0, 2.0, [-1.0, 0.0]));
        is(0.1, of(2.0, -8.0, [-1.0, 0.1]));
        assert!(of(0.0, 0.0, [f64::NAN, 1.0]).is_nan() && of(0.0, 0.0, [1.0, f64::NAN]).is_nan());
    }
}

//! Messages of the errors of analyses.

use super::{Refusal, SolveError};
use crate::planned::{Limit, PlanError};
use crate::text::{entry, rounded};
use core::fmt;

impl fmt::Display for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAssembled { t, gap, residual, row_name, joint, iterations, all_guessed, limit, .. } => {
                write!(
                    f,
                    "not assembled at t = {t}: joint `{joint}` stays open, row `{row_name}` at {residual:.3e} \
                     (scaled {gap:.3e}) after {iterations} iterations",
                    t = rounded(*t)
                )?;
                write_limit(f, limit)?;
                if !all_guessed {
                    return Ok(());
                }
                f.write_str(
                    "; every coordinate has a guess, so no others were tried: change a guess, or leave some out",
                )
            }
            Self::Singular { limit: Some(limit), .. } | Self::StepRefused { limit: Some(limit), .. }
                if limit.locks_at().is_some() =>
            {
                write!(f, "{}: {limit}", limit.step.mechanism())
            }
            Self::Singular { t, rank, expected_rank, rows, condition, limit } => {
                write!(
                    f,
                    "singular configuration at t = {t}: rank {rank} instead of {expected_rank} \
                     (condition {condition:.1e})",
                    t = rounded(*t)
                )?;
                if !rows.is_empty() {
                    write!(f, "; dependent rows: {}", rows.join(", "))?;
                }
                write_limit(f, limit)
            }
            Self::InconsistentVelocity { t, residual, row_name, joint, rank } => write!(
                f,
                "no velocity satisfies all rows at t = {t}: row `{row_name}` of joint `{joint}` is off by \
                 {residual:.3e} (scaled; rank {rank})",
                t = rounded(*t)
            ),
            Self::InconsistentAcceleration { t, residual, row_name, joint, rank } => write!(
                f,
                "no acceleration satisfies all rows at t = {t}: row `{row_name}` of joint `{joint}` is off by \
                 {residual:.3e} (scaled; rank {rank})",
                t = rounded(*t)
            ),
            Self::Rounded { t, coordinate } => PlanError::Rounded { t: *t, coordinate }.fmt(f),
            Self::InconsistentDerivative { t, order, residual, row_name, joint, rank } => write!(
                f,
                "no derivative of order {order} satisfies all rows at t = {t}: row `{row_name}` of joint `{joint}` is \
                 off by {residual:.3e} (scaled; rank {rank})",
                t = rounded(*t)
            ),
            Self::UnknownDerivative { t, order, what, name, known } => write!(
                f,
                "the derivative of order {order} at t = {t} needs a derivative of the {what} `{name}` above order \
                 {known}, which is not known",
                t = rounded(*t)
            ),
            Self::NotSmooth { t, order, row_name, joint } => write!(
                f,
                "row `{row_name}` of joint `{joint}` has no derivative of order {order} at t = {t}: a root, a divisor \
                 or an absolute value in it is 0",
                t = rounded(*t)
            ),
            Self::OutOfRange { t, order } => {
                write!(f, "the derivative of order {order} at t = {t} is beyond the range of numbers", t = rounded(*t))
            }
            Self::StepRefused { t, t_refused, reason: reason @ Refusal::TooManySteps, .. } => {
                write!(
                    f,
                    "{reason} on the way from t = {t} to t = {t_refused}; add instants in between",
                    t = rounded(*t),
                    t_refused = rounded(*t_refused)
                )
            }
            Self::StepRefused { t, t_refused, reason: reason @ Refusal::StepTooSmall, .. } => {
                write!(
                    f,
                    "no step is short enough to follow the motion from t = {t} towards t = {t_refused}: {reason}",
                    t = rounded(*t),
                    t_refused = rounded(*t_refused)
                )
            }
            Self::StepRefused { t, reason: Refusal::TimeTooCoarse, .. } => {
                let (spacing, t) = (t.abs().next_up() - t.abs(), rounded(*t));
                f.write_str("the motion cannot be followed from t = ")?;
                if t.abs() < 1e6 { write!(f, "{t}") } else { write!(f, "{t:e}") }?;
                write!(
                    f,
                    ": neighbouring floating-point numbers are {spacing:.1e} apart there, too far for a step of this \
                     motion; if t is large, let it begin at a smaller number, and otherwise the motion grows without \
                     bound there"
                )
            }
            Self::StepRefused { t, t_refused, row_name, joint, reason, limit } => {
                write!(
                    f,
                    "the branch ends after t = {t}: at t = {t_refused} {reason} (joint `{joint}`, row `{row_name}`)",
                    t = rounded(*t),
                    t_refused = rounded(*t_refused)
                )?;
                write_limit(f, limit)
            }
            Self::NoLoads { mechanism } => write!(
                f,
                "{mechanism} has neither masses nor loads: forces follow from `mass`, `gravity`, `force`, `torque`, \
                 `spring` and `torsion_spring`"
            ),
            Self::NegativeMass { body, is_inertia, value } => {
                let quantity = if *is_inertia { "moment of inertia" } else { "mass" };
                write!(f, "a {quantity} of `{body}` is {value}; neither masses nor moments of inertia are negative")
            }
            Self::NotDetermined { t, open: 0, .. } => write!(
                f,
                "at t = {t} parameters do not determine the position: with nonholonomic rows it depends on the \
                 preceding motion",
                t = rounded(*t)
            ),
            Self::NotDetermined { t, open, could_be_given } => {
                let freedoms = if *open == 1 { "degree of freedom is" } else { "degrees of freedom are" };
                let t = rounded(*t);
                write!(f, "at t = {t} parameters do not determine the position: {open} {freedoms} left open")?;
                if could_be_given.is_empty() {
                    Ok(())
                } else {
                    write!(f, "; could be prescribed: {}", could_be_given.join(", "))
                }
            }
            Self::NoSensitivity { t, parameter, row_name: Some(row) } => write!(
                f,
                "no derivative with respect to `{parameter}` at t = {t}: the redundant rows agree only at exactly \
                 this value of it; at any other, row `{row}` is violated",
                t = rounded(*t)
            ),
            Self::NoSensitivity { t, parameter, row_name: None } => write!(
                f,
                "no derivative with respect to `{parameter}` at t = {t}: a function or a quantity has none there, \
                 or none that is known",
                t = rounded(*t)
            ),
            Self::UnknownParameter { index, parameters } => {
                write!(f, "no parameter has the index {index}: there are {parameters}")
            }
            Self::NotCertified { t, why } => write!(f, "nothing is proven at t = {t}: {why}", t = rounded(*t)),
            Self::NoArc { t, why } => write!(f, "no sweep along the arc from t = {t}: {why}", t = rounded(*t)),
            Self::NotHeld { t, open, could_be_given } => {
                let freedoms = if *open == 1 { "degree of freedom is" } else { "degrees of freedom are" };
                write!(
                    f,
                    "at t = {t} loads act along a degree of freedom that no driver holds: {open} {freedoms} left open",
                    t = rounded(*t)
                )?;
                if could_be_given.is_empty() {
                    Ok(())
                } else {
                    write!(f, "; could be prescribed: {}", could_be_given.join(", "))
                }
            }
            Self::UnboundedForces { t, joints, limit, .. } => {
                write!(
                    f,
                    "singular configuration at t = {t}: near it forces grow without bounds in {}",
                    joints.join(", "),
                    t = rounded(*t)
                )?;
                write_limit(f, limit)
            }
            Self::DegenerateGeometry { t, joint, fault } => {
                write!(f, "joint `{joint}` at t = {t}: {fault}", t = rounded(*t))
            }
            Self::DegenerateContact { t, joint, what, .. } => {
                write!(f, "degenerate contact of joint `{joint}` at t = {t}: {what}", t = rounded(*t))
            }
            Self::NonFinite { what, index, name, t } => {
                entry(f, what, *index, name)?;
                f.write_str(" is not a finite number")?;
                t.map_or(Ok(()), |t| write!(f, " at t = {t}", t = rounded(t)))
            }
            Self::Length(error) => error.fmt(f),
            Self::Option { name, value, most } => {
                write!(f, "the option `{name}` is {value}; it must be above 0")?;
                if *most < f64::MAX { write!(f, " and at most {most}") } else { Ok(()) }
            }
            Self::UnknownCoordinate { index, coordinates } => {
                write!(f, "there is no coordinate {index}; the mechanism has {coordinates}, counted from 0")
            }
            Self::GivenConflict { t, coordinate, value, open, given } => write!(
                f,
                "`{coordinate}` = {value} cannot be given at t = {t}: it repeats or contradicts the other rows \
                 ({given} given, {open} degrees of freedom left)",
                t = rounded(*t)
            ),
            Self::Plan(error) => error.fmt(f),
            Self::Stopped { t, done, total } => {
                write!(f, "stopped at t = {t}, {done} of {total} done", t = rounded(*t))
            }
            Self::UnknownMode { mode, modes } if modes.is_empty() => {
                write!(f, "there is no mode {mode}; the mechanism closes in one way only")
            }
            Self::UnknownMode { mode, modes } => {
                write!(f, "there is no mode {mode}; there are `{}`", modes.join("`, `"))
            }
            Self::ModeNotAssembled { t, modes, limit } => {
                let modes: Vec<String> = modes.iter().map(|(name, sign)| format!("{name} = {sign}")).collect();
                write!(f, "not assembled at t = {t} in the mode {}", modes.join(", "), t = rounded(*t))?;
                write_limit(f, limit)
            }
            Self::NothingCompared { skipped: 0 } => f.write_str("nothing was compared: there are no configurations"),
            Self::NothingCompared { skipped } => {
                write!(f, "nothing was compared: Φ is not finite at any of {skipped} configurations")
            }
        }
    }
}

/// Appends the group that cannot close.
fn write_limit(f: &mut fmt::Formatter<'_>, limit: &Option<Limit>) -> fmt::Result {
    limit.as_ref().map_or(Ok(()), |limit| write!(f, "; {limit}"))
}

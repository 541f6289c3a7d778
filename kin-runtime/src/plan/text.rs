//! Display of plans without the names of the model; [`Step`](crate::planned::Step) prints those, too.

use super::{ModeInfo, Plan, PlanStep, Solved, StepKind};
use crate::text::{counted, numbers};
use core::fmt;

/// q, q̇, q̈ and the margins.
impl<T: fmt::Display> fmt::Display for Solved<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("q = ")?;
        numbers(f, self.q)?;
        f.write_str(", q̇ = ")?;
        numbers(f, self.q_dot)?;
        f.write_str(", q̈ = ")?;
        numbers(f, self.q_ddot)?;
        f.write_str(", margins ")?;
        numbers(f, self.margins)
    }
}

/// `group RRR in closed form, gives 6 coordinates, singular with …`.
impl fmt::Display for PlanStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.group.is_empty() {
            write!(f, "group {} ", self.group)?;
        }
        match self.kind {
            StepKind::RedundantRows => {
                counted(f, self.rows.len(), "redundant row").and_then(|()| f.write_str(" checked"))?
            }
            kind => kind.fmt(f)?,
        }
        if !self.coordinates.is_empty() {
            f.write_str(", gives ").and_then(|()| counted(f, self.coordinates.len(), "coordinate"))?;
        }
        match self.singular {
            "" | "never" => Ok(()),
            singular => write!(f, ", singular with {singular}"),
        }
    }
}

/// Its name.
impl fmt::Display for ModeInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// A line per step, or the reason why there is no plan.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(why) = self.absent {
            return write!(f, "no plan: {why}");
        }
        self.steps.iter().enumerate().try_for_each(|(k, step)| {
            let end = if k == 0 { "" } else { "\n" };
            write!(f, "{end}{}  {step}", k + 1)
        })
    }
}

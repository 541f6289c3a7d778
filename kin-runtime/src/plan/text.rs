//! A plan in words, without the names that only the model has; [`Step`](crate::planned::Step) has those.

use super::{Depth, ModeInfo, Plan, PlanStep, Solved, StepKind};
use crate::text::{counted, numbers};
use core::fmt;

impl fmt::Display for Depth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Position => "q",
            Self::Velocity => "q and q̇",
            Self::Acceleration => "q, q̇ and q̈",
        })
    }
}

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

/// How a step is solved.
impl fmt::Display for StepKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Explicit => f.write_str("by formula"),
            Self::Linear(1) => f.write_str("by a linear equation"),
            Self::Linear(n) => write!(f, "by a {n}×{n} linear system"),
            Self::Closure => f.write_str("in closed form"),
            Self::Newton(n) => write!(f, "by a {n}×{n} Newton iteration"),
            Self::Watched(rows) => counted(f, rows.len(), "redundant row").and_then(|()| f.write_str(" watched")),
        }
    }
}

/// `group RRR in closed form, gives 6 coordinates, singular with …`.
impl fmt::Display for PlanStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.group.is_empty() {
            write!(f, "group {} ", self.group)?;
        }
        self.kind.fmt(f)?;
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

/// A line per step, or why there is none.
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

//! Prints plans as text, with numbers for joints and coordinates.

use super::SolutionPlan;
use core::fmt;

impl fmt::Display for SolutionPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(why) = &self.absent {
            return writeln!(f, "no plan: {why}");
        }
        for (number, step) in self.steps.iter().enumerate() {
            write!(f, "{}: {:?} {} joints {:?} gives", number + 1, step.kind, step.group, step.joints)?;
            for (k, joint) in &step.coordinates {
                write!(f, " q{k} by {joint},")?;
            }
            for mode in &self.modes[step.modes.clone()] {
                write!(f, " mode {},", mode.name)?;
            }
            writeln!(f, " singular: {}", step.singular)?;
        }
        Ok(())
    }
}

//! Display of a mechanism that is solved by its plan.

use super::Planned;
use crate::mechanism::Mechanism;
use crate::text::numbers;
use core::fmt;

impl<M: Mechanism> fmt::Debug for Planned<'_, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Planned")
            .field("mechanism", &M::model().name)
            .field("t", &self.t())
            .field("q", &self.q())
            .field("q_dot", &self.q_dot())
            .field("q_ddot", &self.q_ddot())
            .field("margins", &self.margins())
            .finish_non_exhaustive()
    }
}

/// The last accepted state, for example `FourBar at t = 0.1, q = (…)`.
impl<M: Mechanism> fmt::Display for Planned<'_, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at t = {}, q = ", M::model().name, self.t())?;
        numbers(f, self.q())
    }
}

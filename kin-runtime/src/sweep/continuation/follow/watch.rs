//! The unilateral conditions along the steps.

use super::super::between::state_between;
use super::super::step::{Node, StepStart};
use super::Continuation;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::state::State;

impl Continuation {
    /// The first event, if the sweep is to stop at events and one was passed.
    pub(crate) fn stopped(&self, equations: &Equations<'_>) -> Option<&State> {
        let watch = self.watch.as_ref().filter(|_| equations.options.stop_at_events)?;
        watch.events().first().map(|event| &event.state)
    }

    /// Passes the accepted step to the watch over the unilateral conditions.
    pub(super) fn watch_step(
        &mut self,
        equations: &mut Equations<'_>,
        moved: bool,
        from: f64,
    ) -> Result<(), SolveError> {
        let Self { node, accepted, next, plan, step, scratch, watch, q_dot, q_ddot, .. } = self;
        let Some(watch) = watch else { return Ok(()) };
        let (node, rates): (&Node, [&[f64]; 2]) =
            if moved { (accepted, [&accepted.state.q_dot, &accepted.state.q_ddot]) } else { (node, [q_dot, q_ddot]) };
        let by_plan = next.basis.is_none();
        let mut between = |equations: &mut Equations<'_>, s: f64| match (&mut *plan, &node.basis) {
            (Some(plan), _) if by_plan => {
                equations.move_to(s).ok()?;
                let mut state = node.state.clone();
                plan.peek(equations, &mut state).map(|()| state)
            }
            (_, Some(basis)) => {
                let start = StepStart { node, basis, s: from, q_dot: rates[0], q_ddot: rates[1] };
                state_between(equations, *step, scratch, start, s)
            }
            _ => None,
        };
        watch.pass(equations, &next.state, &mut between)?;
        if equations.options.stop_at_events {
            watch.keep_first();
        }
        Ok(())
    }
}

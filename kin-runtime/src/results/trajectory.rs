//! Solved configurations over time.

use super::arc::SolutionArc;
use super::event::{Event, Unwatched};
use crate::model::{ConditionInfo, Model};
use crate::planned::Limit;
use crate::state::State;
use crate::text::counted;
use core::fmt;

/// An internal step on which the plan had no acceptable solution and full Newton took over, with the same checks of the
/// result.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Fallback {
    /// Time of the step's end.
    pub t: f64,
    /// The step of the plan that has no solution at the instant to which the plan was to go, which may lie beyond this
    /// step; `None` for other reasons, such as a driver that jumps, or a solution of the plan that does not satisfy all
    /// rows.
    pub limit: Option<Limit>,
}

impl fmt::Display for Fallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.limit {
            Some(limit) => write!(f, "at t = {}: {limit}", self.t),
            None => write!(f, "at t = {}: the plan has no solution that continues the motion", self.t),
        }
    }
}

/// The states of one motion, in the order of the requested instants.
#[derive(Clone, PartialEq)]
pub struct Trajectory {
    /// The mechanism's names.
    pub model: &'static Model,
    /// The states.
    pub states: Vec<State>,
    /// The instants at which unilateral conditions met their limits, in the order of the sweep.
    pub events: Vec<Event>,
    /// Unilateral conditions that were violated at the first instant, by their indices in [`Model::conditions`].
    pub violated_at_start: Vec<usize>,
    /// Stretches in which unilateral conditions changed too fast to be watched, or the motion could not be solved, so
    /// that `events` may be incomplete.
    pub unwatched: Vec<Unwatched>,
    /// True if the sweep ended at its first event because [`stop_at_events`](crate::Options::stop_at_events) is set;
    /// the last state is the one at the event.
    pub stopped: bool,
    /// Internal steps on which full Newton took over from the plan.
    pub fallbacks: Vec<Fallback>,
    /// q at the limit itself, if the motion ended at a limit that was located.
    pub q_at_limit: Option<Vec<f64>>,
    /// What a sweep along the arc found; none for a sweep over instants.
    pub arc: Option<SolutionArc>,
    /// Number of instants that were reached, whether their states were kept or not; with that of the event at which the
    /// sweep stopped, if it did.
    pub reached: usize,
}

impl Trajectory {
    /// A trajectory without states.
    pub(crate) fn new(model: &'static Model) -> Self {
        Self {
            model,
            states: Vec::new(),
            events: Vec::new(),
            violated_at_start: Vec::new(),
            unwatched: Vec::new(),
            stopped: false,
            fallbacks: Vec::new(),
            q_at_limit: None,
            arc: None,
            reached: 0,
        }
    }

    /// Number of states.
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// True without states.
    pub fn is_empty(&self) -> bool {
        self.states.is_empty()
    }

    /// The states in order.
    pub fn iter(&self) -> core::slice::Iter<'_, State> {
        self.states.iter()
    }

    /// The last state.
    pub fn last(&self) -> Option<&State> {
        self.states.last()
    }

    /// Names of columns for [`column`](Self::column): `t`, then every coordinate with its rate and acceleration.
    pub fn column_names(&self) -> Vec<String> {
        let coordinates = self.model.coordinates.iter().flat_map(|coordinate| self.model.with_rates(coordinate.name));
        core::iter::once("t".to_owned()).chain(coordinates).collect()
    }

    /// The conditions that were violated at the first instant.
    pub fn violated_at_start(&self) -> impl Iterator<Item = &'static ConditionInfo> {
        self.violated_at_start.iter().filter_map(|&k| self.model.conditions.get(k))
    }
}

impl fmt::Debug for Trajectory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trajectory")
            .field("model", &self.model.name)
            .field("states", &self.states)
            .field("events", &self.events)
            .field("violated_at_start", &self.violated_at_start)
            .field("unwatched", &self.unwatched)
            .field("stopped", &self.stopped)
            .field("fallbacks", &self.fallbacks)
            .finish()
    }
}

impl<'a> IntoIterator for &'a Trajectory {
    type Item = &'a State;
    type IntoIter = core::slice::Iter<'a, State>;

    fn into_iter(self) -> Self::IntoIter {
        self.states.iter()
    }
}

impl IntoIterator for Trajectory {
    type Item = State;
    type IntoIter = std::vec::IntoIter<State>;

    fn into_iter(self) -> Self::IntoIter {
        self.states.into_iter()
    }
}

/// `FourBar: 101 states from t = 0 to t = 1`, with the events and the stretches that were not watched.
impl fmt::Display for Trajectory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.model.name)?;
        counted(f, self.len(), "state")?;
        if let (Some(first), Some(last)) = (self.states.first(), self.last()) {
            write!(f, " from t = {} to t = {}", first.t, last.t)?;
        }
        if self.stopped {
            f.write_str(", stopped at an event")?;
        }
        self.events.iter().try_for_each(|event| write!(f, "; {event}"))?;
        self.unwatched.iter().try_for_each(|unwatched| write!(f, "; {unwatched}"))?;
        self.arc.as_ref().map_or(Ok(()), |arc| write!(f, "; {arc}"))
    }
}

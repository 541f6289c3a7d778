//! Solved configurations over time.

use crate::events::Event;
use crate::model::{ConditionInfo, Model};
use crate::planned::Limit;
use crate::state::State;
use core::fmt;

/// An internal step on which the plan had no good answer and full Newton took over, with the same claims to its result.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Fallback {
    /// Time of the step's end.
    pub t: f64,
    /// The step of the plan that said nothing there; none where it was its answer that did not fit the motion.
    pub limit: Option<Limit>,
}

impl fmt::Display for Fallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.limit {
            Some(limit) => write!(f, "at t = {}: {limit}", self.t),
            None => write!(f, "at t = {}: its answer does not fit the motion", self.t),
        }
    }
}

/// The states of one motion, in the order of the instants asked for.
#[derive(Clone, PartialEq)]
pub struct Trajectory {
    /// The mechanism's names.
    pub model: &'static Model,
    /// The states.
    pub states: Vec<State>,
    /// Where unilateral conditions met their limits, in the order in which the sweep came to it.
    pub events: Vec<Event>,
    /// Unilateral conditions that were violated at the first instant, by their places in [`Model::conditions`].
    pub violated_at_start: Vec<usize>,
    /// True when the sweep ended at its first event, as it was asked to; the last state is the one at the event.
    pub stopped: bool,
    /// Internal steps that full Newton had to take although there is a plan.
    pub fallbacks: Vec<Fallback>,
}

impl Trajectory {
    /// A trajectory without states.
    pub(crate) fn new(model: &'static Model) -> Self {
        let (states, events, violated_at_start, fallbacks) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { model, states, events, violated_at_start, stopped: false, fallbacks }
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

    /// The conditions that were violated at the first instant.
    pub fn violated_at_start(&self) -> impl Iterator<Item = &'static ConditionInfo> {
        self.violated_at_start.iter().filter_map(|&k| self.model.conditions.get(k))
    }

    /// Names of all columns: `t`, then every coordinate with its rate and acceleration.
    pub fn column_names(&self) -> Vec<String> {
        let mut names = vec!["t".to_owned()];
        for coordinate in self.model.coordinates {
            for suffix in ["", "_dot", "_ddot"] {
                names.push(format!("{}{suffix}", coordinate.name));
            }
        }
        names
    }

    /// One quantity over all states: `t`, a coordinate (`crank.phi`), its rate (`crank.phi_dot`) or its acceleration
    /// (`crank.phi_ddot`). A coordinate's own name wins over a rate of the same name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let place = |name: &str| self.model.coordinates.iter().position(|c| c.name == name);
        let of = |part: fn(&State) -> &[f64], k: usize| {
            self.states.iter().map(|s| part(s).get(k).copied().unwrap_or(f64::NAN)).collect()
        };
        if let Some(k) = place(name) {
            return Some(of(|s| &s.q, k));
        }
        if let Some(k) = name.strip_suffix("_ddot").and_then(place) {
            return Some(of(|s| &s.q_ddot, k));
        }
        if let Some(k) = name.strip_suffix("_dot").and_then(place) {
            return Some(of(|s| &s.q_dot, k));
        }
        (name == "t").then(|| self.states.iter().map(|s| s.t).collect())
    }
}

impl fmt::Debug for Trajectory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trajectory")
            .field("model", &self.model.name)
            .field("states", &self.states)
            .field("events", &self.events)
            .field("violated_at_start", &self.violated_at_start)
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

#[cfg(feature = "serde")]
impl serde::Serialize for Trajectory {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let names: Vec<&str> = self.model.coordinates.iter().map(|c| c.name).collect();
        let violated: Vec<&str> = self.violated_at_start().map(|condition| condition.name).collect();
        let mut s = serializer.serialize_struct("Trajectory", 7)?;
        s.serialize_field("mechanism", self.model.name)?;
        s.serialize_field("coordinates", &names)?;
        s.serialize_field("states", &self.states)?;
        s.serialize_field("events", &self.events)?;
        s.serialize_field("violated_at_start", &violated)?;
        s.serialize_field("stopped", &self.stopped)?;
        s.serialize_field("fallbacks", &self.fallbacks)?;
        s.end()
    }
}

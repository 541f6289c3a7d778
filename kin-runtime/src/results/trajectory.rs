//! Solved configurations over time.

use super::arc::SolutionArc;
use super::event::{Event, Unwatched};
use crate::model::{Component, ConditionInfo, Model};
use crate::motion::PointMotion;
use crate::planned::Limit;
use crate::signal::Signal;
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
    /// The step of the plan that has no solution there; `None` for other reasons, such as a driver that jumps, or a
    /// solution of the plan that does not satisfy all rows.
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
    /// Stretches in which unilateral conditions changed too fast to be watched, so that `events` may be incomplete.
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
    /// Number of instants that were reached, whether their states were kept or not.
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

    /// One quantity over all states: `t`, a coordinate (`crank.phi`), x, y or φ of a body (held and carried ones, too),
    /// or x or y of a named point (`tip.x`); also its rate (`crank.phi_dot`) and its acceleration (`crank.phi_ddot`). A
    /// quantity that itself has such a name takes precedence over a rate.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let rates = |quantity: fn(Signal) -> f64, name: &str| {
            let of = quantity_named(self.model, name)?;
            Some(self.states.iter().map(|state| quantity(of.rates(state))).collect())
        };
        rates(|r| r.value, name)
            .or_else(|| rates(|r| r.acceleration, name.strip_suffix("_ddot")?))
            .or_else(|| rates(|r| r.rate, name.strip_suffix("_dot")?))
            .or_else(|| (name == "t").then(|| self.states.iter().map(|s| s.t).collect()))
    }
}

/// What the name of a column without `_dot` and `_ddot` refers to.
enum Named {
    Coordinate(usize),
    Body(usize, Component),
    Point(usize, Component),
}

fn quantity_named(model: &Model, name: &str) -> Option<Named> {
    if let Some(place) = model.coordinate(name) {
        return Some(Named::Coordinate(place));
    }
    let (owner, component) = name.rsplit_once('.')?;
    let component = match component {
        "x" => Component::X,
        "y" => Component::Y,
        "phi" => Component::Phi,
        _ => return None,
    };
    if let Some(place) = model.bodies.iter().position(|body| body.name == owner) {
        return Some(Named::Body(place, component));
    }
    let place = model.points.iter().position(|point| point.name == owner)?;
    (component != Component::Phi).then_some(Named::Point(place, component))
}

impl Named {
    /// Its value and rates; NaN if a state that was constructed by hand has no such entry.
    fn rates(&self, state: &State) -> Signal {
        let at = |list: &[f64], place: usize| list.get(place).copied().unwrap_or(f64::NAN);
        match *self {
            Self::Coordinate(k) => {
                Signal { value: at(&state.q, k), rate: at(&state.q_dot, k), acceleration: at(&state.q_ddot, k) }
            }
            Self::Body(k, component) => state.bodies.get(k).map_or(Signal::UNKNOWN, |body| body.rates(component)),
            Self::Point(k, component) => {
                let axis = usize::from(component == Component::Y);
                let of = |point: &PointMotion| Signal {
                    value: point.r[axis],
                    rate: point.v[axis],
                    acceleration: point.a[axis],
                };
                state.points.get(k).map_or(Signal::UNKNOWN, of)
            }
        }
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

//! Motions that are written to JSON while they are computed.

use std::ops::ControlFlow;

use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Serialize, Serializer};

use super::condition;
use super::json::Record;
use crate::forces::ContactChange;
use crate::measure::Measure;
use crate::model::Model;
use crate::motion::Motion;
use crate::serial::{NamedValues, coordinate_names};
use crate::signal::Signal;
use crate::state::State;
use crate::trajectory::Trajectory;

/// Parameters with their values.
pub(crate) type Parameters = NamedValues<f64>;

impl Parameters {
    pub(crate) fn new(model: &Model, values: &[f64]) -> Self {
        model.parameters.iter().map(|p| p.name).zip(values.iter().copied()).collect()
    }
}

/// An instant of a motion, with angles in degrees if requested.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InstantRow<'r> {
    pub(crate) state: &'r State,
    /// Points, defines and joint quantities, if they are wanted.
    pub(crate) motion: Option<&'r Motion>,
    /// The values of the requested quantities.
    pub(crate) values: &'r [f64],
}

/// A function that writes a row of a sweep.
pub(crate) type Visit<'v> = &'v mut dyn FnMut(&InstantRow<'_>) -> ControlFlow<()>;

/// Passes the result of a finished sweep to a function: its trajectory, the contacts that lift off or press again, and
/// whether it is complete.
pub(crate) type Ended<'e> = &'e dyn Fn(&mut dyn FnMut(&Trajectory, &[ContactChange], bool));

/// A sweep whose states are computed while they are written.
pub(crate) struct SweepRecord<'a> {
    pub(crate) model: &'static Model,
    /// The parameters that vary, if this is one of several motions.
    pub(crate) varied: Option<Parameters>,
    pub(crate) parameters: Parameters,
    pub(crate) units: Record,
    /// The quantities that were requested by name; if there are none, whole states are written.
    pub(crate) quantities: &'a [Measure],
    /// Computes the states one by one and passes each to a function.
    pub(crate) walk: &'a dyn Fn(Visit<'_>),
    /// The result of the sweep after that.
    pub(crate) ended: Ended<'a>,
}

impl Serialize for SweepRecord<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if let Some(varied) = &self.varied {
            map.serialize_entry("varied", varied)?;
        }
        map.serialize_entry("mechanism", self.model.name)?;
        map.serialize_entry("parameters", &self.parameters)?;
        map.serialize_entry("units", &self.units)?;
        if self.quantities.is_empty() {
            map.serialize_entry("coordinates", &coordinate_names(self.model))?;
        }
        map.serialize_entry("states", &States { model: self.model, quantities: self.quantities, walk: self.walk })?;
        let mut rest = Ok(());
        (self.ended)(&mut |trajectory, contacts, complete| rest = end(&mut map, trajectory, contacts, complete));
        rest?;
        map.end()
    }
}

/// Writes the motion with an index as a record; true if it is the last one.
pub(crate) type WriteMotion<'a> = &'a dyn Fn(usize, &mut dyn FnMut(&SweepRecord<'_>)) -> bool;

/// Several motions, computed one after another while they are written.
pub(crate) struct MotionsRecord<'a> {
    pub(crate) model: &'static Model,
    /// The parameters that vary.
    pub(crate) varied: Vec<&'static str>,
    pub(crate) count: usize,
    pub(crate) record: WriteMotion<'a>,
}

impl Serialize for MotionsRecord<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("mechanism", self.model.name)?;
        map.serialize_entry("varied", &self.varied)?;
        map.serialize_entry("motions", &Several(self))?;
        map.end()
    }
}

struct Several<'a>(&'a MotionsRecord<'a>);

impl Serialize for Several<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        for place in 0..self.0.count {
            let mut written = Ok(());
            let is_last = (self.0.record)(place, &mut |record| written = list.serialize_element(record));
            written?;
            if is_last {
                break;
            }
        }
        list.end()
    }
}

/// Writes the entries that follow the states.
fn end<M: SerializeMap>(
    map: &mut M,
    trajectory: &Trajectory,
    contacts: &[ContactChange],
    complete: bool,
) -> Result<(), M::Error> {
    let violated: Vec<&str> = trajectory.violated_at_start().map(|condition| condition.name).collect();
    let events: Vec<Record> = trajectory.events.iter().map(condition::event).collect();
    // False when the sweep ended early: the states are those before the failure, or up to the event.
    map.serialize_entry("complete", &(complete && !trajectory.stopped))?;
    map.serialize_entry("stopped", &trajectory.stopped)?;
    map.serialize_entry("violated_at_start", &violated)?;
    map.serialize_entry("events", &events)?;
    if trajectory.model.has_one_sided_forces() {
        map.serialize_entry("contacts", contacts)?;
    }
    if let Some(arc) = &trajectory.arc {
        map.serialize_entry("arc", arc)?;
    }
    map.serialize_entry("unwatched", &trajectory.unwatched)?;
    map.serialize_entry("fallbacks", &trajectory.fallbacks)
}

/// All instants, computed and written one after another.
struct States<'a> {
    model: &'static Model,
    quantities: &'a [Measure],
    walk: &'a dyn Fn(Visit<'_>),
}

impl Serialize for States<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        let mut failed = None;
        (self.walk)(&mut |row| {
            let written = match self.quantities.is_empty() {
                true => list.serialize_element(&SweepState::new(self.model, row.state, row.motion)),
                false => list.serialize_element(&QuantitiesState::new(row.state.t, self.quantities, row.values)),
            };
            match written {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    failed = Some(error);
                    ControlFlow::Break(())
                }
            }
        });
        failed.map_or(Ok(()), Err)?;
        list.end()
    }
}

/// Quantities that were requested by name, at one instant.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct QuantitiesState<'a> {
    t: f64,
    quantities: NamedValues<f64, &'a str>,
}

impl<'a> QuantitiesState<'a> {
    pub(crate) fn new(t: f64, measures: &'a [Measure], values: &[f64]) -> Self {
        Self { t, quantities: measures.iter().map(Measure::name).zip(values.iter().copied()).collect() }
    }
}

/// One instant of a sweep.
#[derive(Clone, Debug, Serialize)]
struct SweepState<'a> {
    t: f64,
    q: &'a [f64],
    q_dot: &'a [f64],
    q_ddot: &'a [f64],
    #[serde(flatten)]
    motion: Option<&'a Motion>,
    inputs: NamedValues<Signal>,
    residual: f64,
    condition: Option<f64>,
    degrees_of_freedom_left: usize,
}

impl<'a> SweepState<'a> {
    fn new(model: &Model, state: &'a State, motion: Option<&'a Motion>) -> Self {
        Self {
            t: state.t,
            q: &state.q,
            q_dot: &state.q_dot,
            q_ddot: &state.q_ddot,
            motion,
            inputs: inputs(model, state),
            residual: state.residual,
            condition: state.condition,
            degrees_of_freedom_left: state.degrees_of_freedom_left,
        }
    }
}

/// The inputs of a state by name.
pub(crate) fn inputs(model: &Model, state: &State) -> NamedValues<Signal> {
    model.inputs.iter().copied().zip(state.inputs.iter().copied()).collect()
}

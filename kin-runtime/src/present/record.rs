//! Results as records with fields in a fixed order, for JSON.

use std::ops::ControlFlow;

use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Serialize, Serializer};

use super::certificate::{CertificateRecord, Certified};
use super::condition::EventRecord;
use super::plan::ModeRecord;
use super::text::coordinate_names as names_at;
use super::units::{Units, UnitsRecord};
use crate::forces::ContactChange;
use crate::measure::Measure;
use crate::mobility::Mobility;
use crate::model::{ForceModel, Model};
use crate::modes::Mode;
use crate::motion::Motion;
use crate::ratios::{VelocityRatio, VelocityRatios};
use crate::serial::{Named, coordinate_names};
use crate::signal::Signal;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::transmission::TransmissionAngle;

/// Parameters with their values.
pub(crate) type Parameters = Named<f64>;

impl Parameters {
    pub(crate) fn new(model: &Model, values: &[f64]) -> Self {
        model.parameters.iter().map(|p| p.name).zip(values.iter().copied()).collect()
    }
}

/// Everything about one solved instant.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct StateRecord<'a> {
    t: f64,
    coordinates: Vec<&'static str>,
    q: &'a [f64],
    q_dot: &'a [f64],
    q_ddot: &'a [f64],
    #[serde(flatten)]
    motion: &'a Motion,
    mechanism: &'static str,
    parameters: Parameters,
    units: UnitsRecord,
    inputs: Named<Signal>,
    degrees_of_freedom: usize,
    degrees_of_freedom_left: usize,
    independent: Vec<&'static str>,
    dependent: Vec<&'static str>,
    residual: f64,
    iterations: usize,
    condition: f64,
    transmission_angles: &'a [TransmissionAngle],
    velocity_ratios: Named<&'a VelocityRatio>,
    input_ratios: Named<&'a VelocityRatio>,
    modes: Vec<ModeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<CertificateRecord>,
}

impl<'a> StateRecord<'a> {
    pub(crate) fn new(
        model: &'static Model,
        state: &'a State,
        motion: &'a Motion,
        parameters: Parameters,
        mobility: &Mobility,
        ratios: &'a VelocityRatios,
        transmission_angles: &'a [TransmissionAngle],
    ) -> Self {
        Self {
            t: state.t,
            coordinates: coordinate_names(model),
            q: &state.q,
            q_dot: &state.q_dot,
            q_ddot: &state.q_ddot,
            motion,
            mechanism: model.name,
            parameters,
            units: Units::of(model).record(),
            inputs: inputs(model, state),
            degrees_of_freedom: mobility.degrees_of_freedom,
            degrees_of_freedom_left: mobility.degrees_of_freedom_left,
            independent: names_at(model, &mobility.independent),
            dependent: names_at(model, &mobility.dependent),
            residual: state.residual,
            iterations: state.iterations,
            condition: mobility.condition,
            transmission_angles,
            velocity_ratios: ratios.drivers.iter().map(|d| (d.name, d)).collect(),
            input_ratios: ratios.inputs.iter().map(|u| (u.name, u)).collect(),
            modes: Vec::new(),
            certificate: None,
        }
    }

    /// Marks the angles as being in degrees.
    pub(crate) fn in_degrees(self, model: &Model, degrees: bool) -> Self {
        Self { units: Units::of(model).in_degrees(degrees).record(), ..self }
    }

    /// Adds the assembly modes.
    pub(crate) fn with_modes(self, modes: &[Mode]) -> Self {
        Self { modes: ModeRecord::of(modes), ..self }
    }

    /// Adds the certificate that was asked for.
    pub(crate) fn with_certificate(self, certified: Option<&Certified>) -> Self {
        Self { certificate: certified.map(CertificateRecord::of), ..self }
    }
}

/// An instant of a motion, with angles in degrees if asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<'r> {
    pub(crate) state: &'r State,
    /// Points, defines and joint quantities, if they are wanted.
    pub(crate) motion: Option<&'r Motion>,
    /// The values of the quantities that were asked for.
    pub(crate) values: &'r [f64],
}

/// A function that writes a row of a sweep.
pub(crate) type Visit<'v> = &'v mut dyn FnMut(&Row<'_>) -> ControlFlow<()>;

/// Gives the result of a finished sweep: its trajectory, the contacts that lift off or press again, and whether it is
/// complete.
pub(crate) type Ended<'e> = &'e dyn Fn(&mut dyn FnMut(&Trajectory, &[ContactChange], bool));

/// A sweep whose states are computed while they are written.
pub(crate) struct SweepRecord<'a> {
    pub(crate) model: &'static Model,
    /// The parameters that vary, if this is one of several motions.
    pub(crate) varied: Option<Parameters>,
    pub(crate) parameters: Parameters,
    pub(crate) units: UnitsRecord,
    /// The quantities that were asked for by name; without any, the states are written whole.
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
            map.serialize_entry("coordinates", &self.model.coordinates.iter().map(|c| c.name).collect::<Vec<_>>())?;
        }
        map.serialize_entry("states", &States { model: self.model, quantities: self.quantities, walk: self.walk })?;
        let mut rest = Ok(());
        (self.ended)(&mut |trajectory, contacts, complete| rest = end(&mut map, trajectory, contacts, complete));
        rest?;
        map.end()
    }
}

/// Writes the motion with an index as a record; true if it is the last one.
pub(crate) type Record<'a> = &'a dyn Fn(usize, &mut dyn FnMut(&SweepRecord<'_>)) -> bool;

/// Several motions, computed one after another while they are written.
pub(crate) struct MotionsRecord<'a> {
    pub(crate) model: &'static Model,
    /// The parameters that vary.
    pub(crate) varied: Vec<&'static str>,
    pub(crate) count: usize,
    pub(crate) record: Record<'a>,
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
    let events: Vec<EventRecord<'_>> = trajectory.events.iter().map(EventRecord::new).collect();
    // False when the sweep ended early: the states are those before the failure, or up to the event.
    map.serialize_entry("complete", &(complete && !trajectory.stopped))?;
    map.serialize_entry("stopped", &trajectory.stopped)?;
    map.serialize_entry("violated_at_start", &violated)?;
    map.serialize_entry("events", &events)?;
    if trajectory.model.forces.is_some_and(ForceModel::has_contacts) {
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

/// One instant of quantities that were asked for by name.
#[derive(Clone, Debug, Serialize)]
struct QuantitiesState<'a> {
    t: f64,
    quantities: Named<f64, &'a str>,
}

impl<'a> QuantitiesState<'a> {
    fn new(t: f64, measures: &'a [Measure], values: &[f64]) -> Self {
        Self { t, quantities: measures.iter().map(Measure::name).zip(values.iter().copied()).collect() }
    }
}

/// Quantities that were asked for by name, at one instant.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct QuantitiesRecord<'a> {
    #[serde(flatten)]
    state: QuantitiesState<'a>,
    mechanism: &'static str,
    parameters: Parameters,
    units: UnitsRecord,
}

impl<'a> QuantitiesRecord<'a> {
    pub(crate) fn new(
        model: &Model,
        parameters: Parameters,
        units: Units,
        (t, measures, values): (f64, &'a [Measure], &[f64]),
    ) -> Self {
        let state = QuantitiesState::new(t, measures, values);
        Self { state, mechanism: model.name, parameters, units: units.record() }
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
    inputs: Named<Signal>,
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

fn inputs(model: &Model, state: &State) -> Named<Signal> {
    model.inputs.iter().copied().zip(state.inputs.iter().copied()).collect()
}

//! Results as records whose fields stand in a fixed order, for JSON.

use serde::Serialize;
use serde::ser::{Error, SerializeSeq};
use serde_json::value::to_raw_value;

use super::condition::EventRecord;
use super::plan::ModeRecord;
use super::text::coordinate_names as names_at;
use crate::events::Unwatched;
use crate::mobility::Mobility;
use crate::model::Model;
use crate::modes::Mode;
use crate::motion::Motion;
use crate::ratios::{VelocityRatio, VelocityRatios};
use crate::serial::{Named, coordinate_names};
use crate::signal::Signal;
use crate::state::State;
use crate::trajectory::{Fallback, Trajectory};
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
        }
    }

    /// Adds the assembly modes.
    pub(crate) fn with_modes(self, modes: &[Mode]) -> Self {
        Self { modes: ModeRecord::of(modes), ..self }
    }
}

/// A sweep.
#[derive(Serialize)]
pub(crate) struct SweepRecord<'a> {
    mechanism: &'static str,
    parameters: Parameters,
    coordinates: Vec<&'static str>,
    /// False when the sweep ended early: the states are those before the failure, or up to the event where it was to stop.
    complete: bool,
    /// True when the sweep ended at an event, as it was asked to.
    stopped: bool,
    violated_at_start: Vec<&'static str>,
    events: Vec<EventRecord<'a>>,
    /// Where conditions were too fast to be watched.
    unwatched: &'a [Unwatched],
    /// Internal steps of full Newton although there is a plan.
    fallbacks: &'a [Fallback],
    states: States<'a>,
}

/// All instants on a line each, made and told when they are written.
struct States<'a> {
    count: usize,
    state: Box<dyn Fn(usize) -> Option<SweepState<'a>> + 'a>,
    written: &'a dyn Fn(usize),
}

impl Serialize for States<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut states = serializer.serialize_seq(Some(self.count))?;
        for place in 0..self.count {
            (self.written)(place);
            if let Some(state) = (self.state)(place) {
                states.serialize_element(&to_raw_value(&state).map_err(S::Error::custom)?)?;
            }
        }
        states.end()
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

impl<'a> SweepRecord<'a> {
    /// `motions` is either empty or as long as `states`; `written` is told every state.
    pub(crate) fn new(
        model: &'static Model,
        parameters: Parameters,
        trajectory: &'a Trajectory,
        motions: &'a [Motion],
        complete: bool,
        written: &'a dyn Fn(usize),
    ) -> Self {
        let state = move |i: usize, state: &'a State| SweepState {
            t: state.t,
            q: &state.q,
            q_dot: &state.q_dot,
            q_ddot: &state.q_ddot,
            motion: motions.get(i),
            inputs: inputs(model, state),
            residual: state.residual,
            condition: state.condition,
            degrees_of_freedom_left: state.degrees_of_freedom_left,
        };
        Self {
            mechanism: model.name,
            parameters,
            coordinates: coordinate_names(model),
            complete: complete && !trajectory.stopped,
            stopped: trajectory.stopped,
            violated_at_start: trajectory.violated_at_start().map(|condition| condition.name).collect(),
            events: trajectory.events.iter().map(EventRecord::new).collect(),
            unwatched: &trajectory.unwatched,
            fallbacks: &trajectory.fallbacks,
            states: States {
                count: trajectory.states.len(),
                state: Box::new(move |i| trajectory.states.get(i).map(|found| state(i, found))),
                written,
            },
        }
    }
}

fn inputs(model: &Model, state: &State) -> Named<Signal> {
    model.inputs.iter().copied().zip(state.inputs.iter().copied()).collect()
}

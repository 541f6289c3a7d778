//! Sensitivities by name: of every quantity, with respect to every parameter.

use super::{NamedValues, coordinate_names};
use crate::forces::{Effort, Reaction, Wrench};
use crate::motion::PointMotion;
use crate::sensitivities::{Sensitivities, Sensitivity};
use crate::signal::Signal;
use serde::{Serialize, Serializer};

/// The derivatives of one quantity with respect to all parameters.
type By<T> = NamedValues<T>;

/// Derivatives of q, q̇ and q̈ with respect to every parameter, then those of everything that is reported, by name and
/// parameter.
impl Serialize for Sensitivities {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Record::new(self).serialize(serializer)
    }
}

#[derive(Serialize)]
struct Record<'a> {
    t: f64,
    mechanism: &'static str,
    coordinates: Vec<&'static str>,
    parameters: Vec<&'static str>,
    dq: By<&'a [f64]>,
    dq_dot: By<&'a [f64]>,
    dq_ddot: By<&'a [f64]>,
    points: NamedValues<By<PointMotion>>,
    defines: NamedValues<By<Signal>>,
    joints: NamedValues<NamedValues<By<Signal>>>,
    conditions: NamedValues<By<Signal>>,
    #[serde(skip_serializing_if = "NamedValues::is_empty")]
    efforts: NamedValues<By<EffortRates>>,
    #[serde(skip_serializing_if = "NamedValues::is_empty")]
    reactions: NamedValues<By<ReactionRates>>,
    #[serde(skip_serializing_if = "NamedValues::is_empty")]
    shaking: By<Wrench>,
}

/// The effort of a driver and the rate of what it drives, differentiated.
#[derive(Serialize)]
struct EffortRates {
    value: Option<f64>,
    rate: f64,
}

#[derive(Serialize)]
struct ReactionRates {
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moment: Option<f64>,
}

impl<'a> Record<'a> {
    fn new(sensitivities: &'a Sensitivities) -> Self {
        let Sensitivities { t, model, by, .. } = sensitivities;
        let vectors = |list: fn(&Sensitivity) -> &[f64]| by.iter().map(|by| (by.parameter, list(by))).collect();
        let joints = model.joints.iter().enumerate().filter(|(_, joint)| !joint.quantities.is_empty());
        let joint = |(index, joint): (usize, &'static crate::model::JointInfo)| {
            let quantities = joint.quantities.iter().enumerate();
            let all = quantities.map(|(k, info)| (info.name, each(by, |by| by.joints[index][k])));
            (joint.name, all.collect())
        };
        let forces = by.first().and_then(|by| by.forces.as_ref());
        let of_forces = || by.iter().filter_map(|by| Some((by.parameter, by.forces.as_ref()?)));
        let effort = |(k, effort): (usize, &Effort)| {
            let record = |effort: &Effort| EffortRates { value: effort.effort, rate: effort.rate };
            (effort.name, of_forces().map(|(name, forces)| (name, record(&forces.efforts[k]))).collect())
        };
        let reaction = |(k, reaction): (usize, &Reaction)| {
            let record = |reaction: &Reaction| ReactionRates { force: reaction.force, moment: reaction.moment };
            (reaction.name, of_forces().map(|(name, forces)| (name, record(&forces.reactions[k]))).collect())
        };
        Self {
            t: *t,
            mechanism: model.name,
            coordinates: coordinate_names(model),
            parameters: by.iter().map(|by| by.parameter).collect(),
            dq: vectors(|by| &by.q),
            dq_dot: vectors(|by| &by.q_dot),
            dq_ddot: vectors(|by| &by.q_ddot),
            points: model.points.iter().enumerate().map(|(k, p)| (p.name, each(by, |by| by.points[k]))).collect(),
            defines: model.defines.iter().enumerate().map(|(k, d)| (d.name, each(by, |by| by.defines[k]))).collect(),
            joints: joints.map(joint).collect(),
            conditions: {
                let conditions = model.conditions.iter().enumerate();
                conditions.map(|(k, info)| (info.name, each(by, |by| by.conditions[k]))).collect()
            },
            efforts: forces.iter().flat_map(|forces| forces.efforts.iter().enumerate().map(effort)).collect(),
            reactions: forces.iter().flat_map(|forces| forces.reactions.iter().enumerate().map(reaction)).collect(),
            shaking: of_forces().map(|(name, forces)| (name, forces.shaking)).collect(),
        }
    }
}

/// The derivatives of a quantity with respect to every parameter.
fn each<T>(by: &[Sensitivity], value: impl Fn(&Sensitivity) -> T) -> By<T> {
    by.iter().map(|by| (by.parameter, value(by))).collect()
}

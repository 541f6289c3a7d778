//! Forces by name.

use super::NamedValues;
use crate::forces::{Effort, Forces, Reaction, SpringForce, Wrench};
use crate::model::ForceUnits;
use serde::{Serialize, Serializer};

/// Drivers, joints and springs by name; undetermined values are left out.
impl Serialize for Forces {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        ForcesRecord::new(self).serialize(serializer)
    }
}

/// Forces by name.
#[derive(Serialize)]
struct ForcesRecord<'a> {
    t: f64,
    efforts: NamedValues<EffortRecord>,
    #[serde(skip_serializing_if = "NamedValues::is_empty")]
    inputs: NamedValues<EffortRecord>,
    reactions: NamedValues<ReactionRecord<'a>>,
    #[serde(skip_serializing_if = "NamedValues::is_empty")]
    springs: NamedValues<SpringRecord>,
    shaking: Wrench,
    inertia: Wrench,
    energy: Energy,
    power: Power,
    multipliers: NamedValues<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    units: Option<ForceUnits>,
}

#[derive(Serialize)]
struct EffortRecord {
    effort: Option<f64>,
    rate: f64,
    #[serde(skip_serializing_if = "is_true")]
    determined: bool,
}

#[derive(Serialize)]
struct ReactionRecord<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    on: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    point: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moment: Option<f64>,
    #[serde(skip_serializing_if = "NamedValues::is_empty")]
    torques: NamedValues<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    generalized: Option<&'a f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tension: Option<f64>,
    #[serde(skip_serializing_if = "is_true")]
    determined: bool,
}

fn is_true(value: &bool) -> bool {
    *value
}

#[derive(Serialize)]
struct SpringRecord {
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle: Option<f64>,
    rate: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    tension: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque: Option<f64>,
    energy: f64,
    damping_power: f64,
}

#[derive(Serialize)]
struct Energy {
    kinetic: f64,
    gravity: f64,
    springs: f64,
}

#[derive(Serialize)]
struct Power {
    drivers: f64,
    applied: f64,
    dampers: f64,
    energy_rate: f64,
}

impl<'a> ForcesRecord<'a> {
    fn new(forces: &'a Forces) -> Self {
        let effort = |e: &Effort| (e.name, EffortRecord { effort: e.effort, rate: e.rate, determined: e.determined });
        let reaction = |r: &'a Reaction| {
            let torques = r.couples.iter().map(|(frame, couple)| (forces.body(*frame), *couple)).collect();
            let (on, generalized) = (r.on.map(|frame| forces.body(frame)), r.generalized.first());
            let &Reaction { point, force, moment, normal, tangential, tension, determined, .. } = r;
            (
                r.name,
                ReactionRecord {
                    on,
                    point,
                    force,
                    moment,
                    torques,
                    generalized,
                    normal,
                    tangential,
                    tension,
                    determined,
                },
            )
        };
        let spring = |s: &SpringForce| {
            let value_if = |wanted: bool, value: f64| (s.turns == wanted).then_some(value);
            let record = SpringRecord {
                length: value_if(false, s.length),
                angle: value_if(true, s.length),
                rate: s.rate,
                tension: value_if(false, s.force),
                torque: value_if(true, s.force),
                energy: s.energy,
                damping_power: s.damper_power,
            };
            (s.name, record)
        };
        Self {
            t: forces.t,
            efforts: forces.efforts.iter().map(effort).collect(),
            inputs: forces.inputs.iter().map(effort).collect(),
            reactions: forces.reactions.iter().map(reaction).collect(),
            springs: forces.springs.iter().map(spring).collect(),
            shaking: forces.shaking,
            inertia: forces.inertia,
            energy: Energy { kinetic: forces.kinetic, gravity: forces.gravity, springs: forces.elastic },
            power: Power {
                drivers: forces.driver_power,
                applied: forces.applied_power,
                dampers: forces.damper_power,
                energy_rate: forces.energy_rate,
            },
            units: forces.model.forces.map(|info| info.units).filter(|units| *units != ForceUnits::default()),
            multipliers: forces
                .model
                .rows
                .iter()
                .zip(&forces.multipliers)
                .filter(|(row, _)| forces.has_numbers(row.joint))
                .map(|(row, multiplier)| (row.name, *multiplier))
                .collect(),
        }
    }
}

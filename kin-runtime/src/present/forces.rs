//! Forces as tables for people, as a record for JSON, and as columns.

use serde::Serialize;

use super::table::Table;
use super::text::section;
use crate::forces::{Effort, Forces, Reaction, SpringForce, Wrench};
use crate::serial::Named;

/// Forces by name.
#[derive(Serialize)]
pub(crate) struct ForcesRecord<'a> {
    t: f64,
    efforts: Named<EffortRecord>,
    reactions: Named<ReactionRecord<'a>>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    springs: Named<SpringRecord>,
    shaking: Wrench,
    inertia: Wrench,
    energy: Energy,
    power: Power,
    multipliers: Named<f64>,
}

#[derive(Serialize)]
struct EffortRecord {
    effort: Option<f64>,
    rate: f64,
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
    #[serde(skip_serializing_if = "Named::is_empty")]
    torques: Named<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    generalized: Option<&'a f64>,
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
}

impl<'a> ForcesRecord<'a> {
    pub(crate) fn new(forces: &'a Forces) -> Self {
        let effort = |e: &Effort| (e.name, EffortRecord { effort: e.effort, rate: e.rate });
        let reaction = |r: &'a Reaction| {
            let torques = r.couples.iter().map(|(frame, couple)| (forces.body(*frame), *couple)).collect();
            let (on, generalized) = (r.on.map(|frame| forces.body(frame)), r.generalized.first());
            let (point, force, moment) = (r.point, r.force, r.moment);
            (r.name, ReactionRecord { on, point, force, moment, torques, generalized, determined: r.determined })
        };
        let spring = |s: &SpringForce| {
            let of = |wanted: bool, value: f64| (s.turns == wanted).then_some(value);
            let record = SpringRecord {
                length: of(false, s.length),
                angle: of(true, s.length),
                rate: s.rate,
                tension: of(false, s.force),
                torque: of(true, s.force),
                energy: s.energy,
                damping_power: s.damper_power,
            };
            (s.name, record)
        };
        Self {
            t: forces.t,
            efforts: forces.efforts.iter().map(effort).collect(),
            reactions: forces.reactions.iter().map(reaction).collect(),
            springs: forces.springs.iter().map(spring).collect(),
            shaking: forces.shaking,
            inertia: forces.inertia,
            energy: Energy { kinetic: forces.kinetic, gravity: forces.gravity, springs: forces.elastic },
            power: Power { drivers: forces.driver_power, applied: forces.applied_power, dampers: forces.damper_power },
            multipliers: forces.model.rows.iter().map(|row| row.name).zip(forces.multipliers.iter().copied()).collect(),
        }
    }
}

/// Names and numbers of everything but multipliers, as columns of a table over time; what is undetermined is NaN.
pub(crate) fn columns(forces: &Forces) -> Vec<(String, f64)> {
    let mut all: Vec<(String, f64)> = Vec::new();
    for effort in &forces.efforts {
        all.push((format!("{}.effort", effort.name), effort.effort.unwrap_or(f64::NAN)));
    }
    for reaction in &forces.reactions {
        let name = reaction.name;
        if reaction.point.is_some() {
            let [x, y] = reaction.force.unwrap_or([f64::NAN; 2]);
            all.push((format!("{name}.force_x"), x));
            all.push((format!("{name}.force_y"), y));
            all.push((format!("{name}.force"), x.hypot(y)));
        }
        if let Some(moment) = reaction.moment {
            all.push((format!("{name}.moment"), moment));
        }
        for (frame, couple) in &reaction.couples {
            all.push((format!("{name}.torque_{}", forces.body(*frame)), *couple));
        }
        for value in &reaction.generalized {
            all.push((format!("{name}.generalized"), *value));
        }
    }
    for spring in &forces.springs {
        let what = if spring.turns { "torque" } else { "tension" };
        all.push((format!("{}.{what}", spring.name), spring.force));
    }
    let Wrench { force: [x, y], moment } = forces.shaking;
    let totals = [
        ("shaking.force_x", x),
        ("shaking.force_y", y),
        ("shaking.force", x.hypot(y)),
        ("shaking.moment", moment),
        ("energy.kinetic", forces.kinetic),
        ("energy.gravity", forces.gravity),
        ("energy.springs", forces.elastic),
        ("power.drivers", forces.driver_power),
        ("power.applied", forces.applied_power),
        ("power.dampers", forces.damper_power),
    ];
    all.extend(totals.map(|(name, value)| (name.to_owned(), value)));
    all
}

/// Tables of efforts, reactions, springs, shaking, energies and powers.
pub(crate) fn text(forces: &Forces) -> String {
    let mut out = String::new();
    if !forces.efforts.is_empty() {
        let efforts = || forces.efforts.iter();
        let table = Table::new()
            .words("driver", efforts().map(|e| e.name))
            .right("effort", efforts().map(|e| known(e.effort)))
            .numbers("rate", efforts().map(|e| e.rate))
            .right("power", efforts().map(|e| known(e.effort.map(|effort| effort * e.rate))));
        out += &section("Drivers: what they supply", &table);
    }
    let held = || forces.reactions.iter().filter(|r| r.on.is_some());
    if held().next().is_some() {
        let component = |c: usize| move |r: &Reaction| known_or_none(r.force.map(|force| force[c]), r.point.is_some());
        let table = Table::new()
            .words("joint", held().map(|r| r.name))
            .words("on", held().map(|r| r.on.map_or("", |frame| forces.body(frame))))
            .right("force x", held().map(component(0)))
            .right("force y", held().map(component(1)))
            .right("|force|", held().map(|r| known_or_none(r.force.map(|[x, y]| x.hypot(y)), r.point.is_some())))
            .right("moment", held().map(|r| known_or_none(r.moment, !r.determined)));
        out += &section("Joints: what they exert on a body, and the opposite on the other", &table);
    }
    let couples: Vec<_> =
        forces.reactions.iter().flat_map(|r| r.couples.iter().map(move |couple| (r.name, couple))).collect();
    if !couples.is_empty() {
        let table = Table::new()
            .words("joint", couples.iter().map(|(name, _)| *name))
            .words("on", couples.iter().map(|(_, (frame, _))| forces.body(*frame)))
            .numbers("couple", couples.iter().map(|(_, (_, couple))| *couple));
        out += &section("Couples", &table);
    }
    let free: Vec<_> = forces.reactions.iter().filter_map(|r| Some((r.name, *r.generalized.first()?))).collect();
    if !free.is_empty() {
        let table = Table::new()
            .words("row", free.iter().map(|(name, _)| *name))
            .numbers("generalized force", free.iter().map(|(_, value)| *value));
        out += &section("Free equations", &table);
    }
    if !forces.springs.is_empty() {
        let springs = || forces.springs.iter();
        let table = Table::new()
            .words("spring", springs().map(|s| s.name))
            .numbers("length", springs().map(|s| s.length))
            .numbers("rate", springs().map(|s| s.rate))
            .numbers("tension", springs().map(|s| s.force))
            .numbers("energy", springs().map(|s| s.energy))
            .numbers("damper power", springs().map(|s| s.damper_power));
        out += &section("Springs", &table);
    }
    let Wrench { force: [x, y], moment } = forces.shaking;
    let totals = [
        ("shaking force x", x),
        ("shaking force y", y),
        ("shaking moment", moment),
        ("kinetic energy", forces.kinetic),
        ("energy of gravity", forces.gravity),
        ("energy of springs", forces.elastic),
        ("power of drivers", forces.driver_power),
        ("applied power", forces.applied_power),
        ("power of dampers", forces.damper_power),
    ];
    let table =
        Table::new().words("total", totals.iter().map(|(name, _)| *name)).numbers("", totals.iter().map(|(_, v)| *v));
    out + &section("Shaking, energy and power", &table)
}

fn known(value: Option<f64>) -> String {
    value.map_or_else(|| "undetermined".to_owned(), super::number::rounded)
}

fn known_or_none(value: Option<f64>, is_there: bool) -> String {
    if value.is_none() && !is_there { String::new() } else { known(value) }
}

//! Forces as tables for people, and as columns.

use super::table::Table;
use super::text::section;
use super::units::{Measure, Units};
use crate::forces::{Forces, Reaction, Wrench};
use crate::model::{ForceModel, ForceUnits, Frame, Model};

/// The names of the columns of forces; none for a mechanism without masses and loads.
pub(crate) fn column_names(model: &Model) -> Vec<String> {
    let Some(info) = model.forces else { return Vec::new() };
    let mut names = Vec::new();
    visit(model, info, None, &mut |name, _, _| names.push(name));
    names
}

/// The numbers of [`column_names`]; NaN for what is undetermined.
pub(crate) fn column_values(model: &Model, forces: Option<&Forces>, out: &mut Vec<f64>) {
    if let Some(info) = model.forces {
        visit(model, info, forces, &mut |_, _, value| out.push(value));
    }
}

/// The units of [`column_names`].
pub(crate) fn column_units(model: &Model) -> Vec<Option<&'static str>> {
    let Some(info) = model.forces else { return Vec::new() };
    let mut units = Vec::new();
    visit(model, info, None, &mut |_, unit, _| units.push(unit));
    units
}

/// The unit of a driver's effort: that of a force where it drives a length, that of a moment where it drives an angle.
fn unit_of_effort(model: &Model, info: &ForceModel, driver: &str) -> Option<&'static str> {
    let ForceUnits { force, moment, .. } = info.units;
    let of = |name: &str| match Units::of(model).measure(name) {
        Measure::Length => force,
        Measure::Angle => moment,
        Measure::In(unit) if Some(unit) == model.units.length => force,
        Measure::In(_) | Measure::Unknown => None,
    };
    let Some(joint) = model.joints.iter().find(|joint| joint.name == driver) else { return of(driver) };
    if joint.keeps_distance() {
        return force;
    }
    // A row of one quantity says what it drives.
    let entries = model.constraint_pattern.entries.iter().filter(|(row, _)| *row == joint.first_row);
    let mut units = entries.map(|(_, column)| of(model.coordinates[*column].name));
    let first = units.next()?;
    units.all(|unit| unit == first).then_some(first)?
}

/// A number of the whole mechanism.
type Total = fn(&Forces) -> f64;

/// Every column with its number, in order.
fn visit(
    model: &Model,
    info: &ForceModel,
    forces: Option<&Forces>,
    f: &mut dyn FnMut(String, Option<&'static str>, f64),
) {
    let ForceUnits { force, moment, energy, power } = info.units;
    let body = |frame: Frame| match frame {
        Frame::Ground => "ground",
        Frame::Body(place) => model.bodies.get(place).map_or("", |body| body.name),
    };
    for (k, effort) in info.efforts.iter().enumerate() {
        let value = forces.and_then(|forces| forces.efforts.get(k)?.effort);
        f(format!("{}.effort", effort.name), unit_of_effort(model, info, effort.name), value.unwrap_or(f64::NAN));
    }
    for (k, reaction) in info.reactions.iter().enumerate() {
        let (name, found) = (reaction.name, forces.and_then(|forces| forces.reactions.get(k)));
        if reaction.has_force {
            let [x, y] = found.and_then(|found| found.force).unwrap_or([f64::NAN; 2]);
            for (what, value) in [("force_x", x), ("force_y", y), ("force", x.hypot(y))] {
                f(format!("{name}.{what}"), force, value);
            }
        }
        if reaction.has_moment {
            f(format!("{name}.moment"), moment, found.and_then(|found| found.moment).unwrap_or(f64::NAN));
        }
        for (c, frame) in reaction.couples.iter().enumerate() {
            let value = found.and_then(|found| Some(found.couples.get(c)?.1));
            f(format!("{name}.torque_{}", body(*frame)), moment, value.unwrap_or(f64::NAN));
        }
        for c in 0..reaction.generalized {
            let value = found.and_then(|found| found.generalized.get(c).copied());
            f(format!("{name}.generalized"), None, value.unwrap_or(f64::NAN));
        }
        if reaction.has_normal {
            f(format!("{name}.normal"), force, found.and_then(|found| found.normal).unwrap_or(f64::NAN));
        }
        if reaction.has_tangential {
            f(format!("{name}.tangential"), force, found.and_then(|found| found.tangential).unwrap_or(f64::NAN));
        }
    }
    for (k, spring) in info.springs.iter().enumerate() {
        let what = if spring.turns { "torque" } else { "tension" };
        let value = forces.and_then(|forces| Some(forces.springs.get(k)?.force));
        f(format!("{}.{what}", spring.name), if spring.turns { moment } else { force }, value.unwrap_or(f64::NAN));
    }
    let total = |of: Total| forces.map_or(f64::NAN, of);
    let totals: [(&str, Total); 10] = [
        ("shaking.force_x", |forces| forces.shaking.force[0]),
        ("shaking.force_y", |forces| forces.shaking.force[1]),
        ("shaking.force", |forces| forces.shaking.force[0].hypot(forces.shaking.force[1])),
        ("shaking.moment", |forces| forces.shaking.moment),
        ("energy.kinetic", |forces| forces.kinetic),
        ("energy.gravity", |forces| forces.gravity),
        ("energy.springs", |forces| forces.elastic),
        ("power.drivers", |forces| forces.driver_power),
        ("power.applied", |forces| forces.applied_power),
        ("power.dampers", |forces| forces.damper_power),
    ];
    for (name, of) in totals {
        let unit = match name.split_once('.') {
            Some(("energy", _)) => energy,
            Some(("power", _)) => power,
            Some((_, "moment")) => moment,
            _ => force,
        };
        f(name.to_owned(), unit, total(of));
    }
}

/// Tables of efforts, reactions, springs, shaking, energies and powers.
pub(crate) fn text(forces: &Forces) -> String {
    let mut out = String::new();
    let units = forces.model.forces.map_or_else(String::new, |info| info.units.to_string());
    if !units.is_empty() {
        out += &format!("  {units}\n");
    }
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
    let contacts = || forces.reactions.iter().filter(|r| r.normal.is_some());
    if contacts().next().is_some() {
        let table = Table::new()
            .words("contact", contacts().map(|r| r.name))
            .words("on", contacts().map(|r| r.on.map_or("", |frame| forces.body(frame))))
            .right("normal", contacts().map(|r| known_or_none(r.normal, true)))
            .right("tangential", contacts().map(|r| known_or_none(r.tangential, false)));
        out += &section("Contacts: positive normal forces press, negative ones would pull", &table);
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

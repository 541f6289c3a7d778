//! Forces as text tables.

use super::number::Style;
use super::table::Table;
use super::text::section;
use crate::forces::{Effort, Forces, Reaction, Wrench};
use crate::measure::{Dimension, dimension_of_driven};

/// Tables of efforts, reactions, springs, shaking, energies and powers. Angles are in degrees if `degrees`.
pub(crate) fn text(forces: &Forces, degrees: bool) -> String {
    let mut out = String::new();
    let units = forces.model.forces.map_or_else(String::new, |info| info.units.to_string());
    if !units.is_empty() {
        out += &format!("  {units}\n");
    }
    // Efforts are those along radians.
    let is_turned = |e: &Effort| degrees && dimension_of_driven(forces.model, e.name) == Dimension::Angle;
    let rate = |e: &Effort| if is_turned(e) { e.rate.to_radians() } else { e.rate };
    // An input that equals the driven quantity of a driver has the effort of that driver, and is not listed again.
    let is_listed = |input: &Effort| {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs();
        let same = |driver: &Effort| Some(near(driver.effort?, input.effort?) && near(rate(driver), rate(input)));
        forces.efforts.iter().any(|driver| same(driver) == Some(true))
    };
    let inputs: Vec<&Effort> = forces.inputs.iter().filter(|input| !is_listed(input)).collect();
    for (heading, title, efforts) in [
        ("driver", "Drivers: what they supply", forces.efforts.iter().collect()),
        ("input", "Inputs: their share of the power", inputs),
    ] {
        if efforts.is_empty() {
            continue;
        }
        let efforts = || efforts.iter();
        let table = Table::new()
            .words(heading, efforts().map(|e| e.name))
            .right("effort", column(efforts().map(|e| (e.effort, true))))
            .numbers("rate", efforts().map(|e| e.rate))
            .right("power", column(efforts().map(|e| (e.effort.map(|effort| effort * rate(e)), true))));
        out += &section(title, &table);
    }
    let held = || forces.reactions.iter().filter(|r| r.on.is_some());
    if held().next().is_some() {
        let component = |c: usize| move |r: &Reaction| (r.force.map(|force| force[c]), r.point.is_some());
        let table = Table::new()
            .words("joint", held().map(|r| r.name))
            .words("on", held().map(|r| r.on.map_or("", |frame| forces.body(frame))))
            .right("force x", column(held().map(component(0))))
            .right("force y", column(held().map(component(1))))
            .right("|force|", column(held().map(|r| (r.force.map(|[x, y]| x.hypot(y)), r.point.is_some()))))
            .right("moment", column(held().map(|r| (r.moment, !r.determined))));
        out += &section("Joints: what they exert on a body, and the opposite on the other", &table);
    }
    let contacts = || forces.reactions.iter().filter(|r| r.normal.is_some());
    if contacts().next().is_some() {
        let table = Table::new()
            .words("contact", contacts().map(|r| r.name))
            .words("on", contacts().map(|r| r.on.map_or("", |frame| forces.body(frame))))
            .right("normal", column(contacts().map(|r| (r.normal, true))))
            .right("tangential", column(contacts().map(|r| (r.tangential, false))));
        out += &section("Contacts: positive normal forces press, negative ones would pull", &table);
    }
    let ropes = || forces.reactions.iter().filter(|r| r.tension.is_some());
    if ropes().next().is_some() {
        let table = Table::new()
            .words("rope", ropes().map(|r| r.name))
            .right("tension", column(ropes().map(|r| (r.tension, true))));
        out += &section("Ropes: negative tensions would push", &table);
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
    for (title, turns, [extent, force]) in [
        ("Springs", false, ["length", "tension"]),
        ("Torsion springs: torques on their second bodies", true, ["angle", "torque"]),
    ] {
        let springs = || forces.springs.iter().filter(|spring| spring.turns == turns);
        if springs().next().is_none() {
            continue;
        }
        let table = Table::new()
            .words("spring", springs().map(|s| s.name))
            .numbers(extent, springs().map(|s| s.length))
            .numbers("rate", springs().map(|s| s.rate))
            .numbers(force, springs().map(|s| s.force))
            .numbers("energy", springs().map(|s| s.energy))
            .numbers("damper power", springs().map(|s| s.damper_power));
        out += &section(title, &table);
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

/// The cells of a column of numbers, all in one style; a number that is not known is undetermined, or else not there.
fn column(values: impl Iterator<Item = (Option<f64>, bool)> + Clone) -> Vec<String> {
    let style = Style::of(values.clone().filter_map(|(value, _)| value));
    let cell = |(value, is_there): (Option<f64>, bool)| match value {
        Some(value) => style.write(value),
        None => (if is_there { "undetermined" } else { "" }).to_owned(),
    };
    values.map(cell).collect()
}

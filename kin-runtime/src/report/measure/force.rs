//! Forces as columns of numbers.

use super::{Dimension, Source, driven_dimension};
use crate::forces::Forces;
use crate::model::{ForceModel, ForceUnits, Frame, Model};

/// The columns of forces: the name, the dimension and where the number comes from, none where no closed form gives it. Empty
/// for a mechanism without masses and loads.
pub(crate) fn columns(model: &Model) -> Vec<(String, Dimension, Option<Source>)> {
    let Some(info) = model.forces else { return Vec::new() };
    let mut columns = Vec::new();
    visit(model, info, None, &mut |name, unit, source, _| {
        columns.push((name, unit.map_or(Dimension::Unknown, Dimension::In), source.filter(|_| info.solved)));
    });
    columns
}

/// The numbers of [`columns`]; NaN for what is undetermined.
pub(crate) fn column_values(model: &Model, forces: Option<&Forces>, out: &mut Vec<f64>) {
    if let Some(info) = model.forces {
        visit(model, info, forces, &mut |_, _, _, value| out.push(value));
    }
}

/// The columns of the components of a force whose magnitude is in a column of this name: they stand before it.
pub(crate) fn magnitude_parts(name: &str, index: usize) -> Option<[usize; 2]> {
    name.ends_with(".force").then(|| [index - 2, index - 1])
}

/// The dimension of the effort along a coordinate, given by its name; none for a mechanism without masses and loads.
pub(super) fn dimension_of_effort(model: &'static Model) -> impl Fn(&str) -> Option<Dimension> {
    move |coordinate| Some(unit_of_effort(model, model.forces?, coordinate).map_or(Dimension::Unknown, Dimension::In))
}

/// The unit of a driver's effort: that of a force where it drives a length, that of a moment where it drives an angle.
fn unit_of_effort(model: &Model, info: &ForceModel, driver: &str) -> Option<&'static str> {
    let ForceUnits { force, moment, .. } = info.units;
    let unit_of = |driven: Dimension| match driven {
        Dimension::Length => force,
        Dimension::Angle => moment,
        Dimension::In(unit) if Some(unit) == model.units.length => force,
        Dimension::In(_) | Dimension::Unknown => None,
    };
    unit_of(dimension_of_driven(model, driver))
}

/// The dimension of what a driver drives, or of the input or the coordinate with this name.
pub(crate) fn dimension_of_driven(model: &Model, name: &str) -> Dimension {
    match model.row_of_effort(name) {
        Some(row) => driven_dimension(model, row),
        None => Dimension::named(&model.units, name),
    }
}

/// A number of the whole mechanism.
type Total = fn(&Forces) -> f64;

/// Every column with its number, in order.
fn visit(
    model: &Model,
    info: &ForceModel,
    forces: Option<&Forces>,
    f: &mut dyn FnMut(String, Option<&'static str>, Option<Source>, f64),
) {
    let ForceUnits { force, moment, energy, power } = info.units;
    let body = |frame: Frame| match frame {
        Frame::Ground => "ground",
        Frame::Body(index) => model.bodies.get(index).map_or("", |body| body.name),
    };
    for (k, effort) in info.efforts.iter().enumerate() {
        let value = forces.and_then(|forces| forces.efforts.get(k)?.effort);
        let (unit, source) = (unit_of_effort(model, info, effort.name), Some(Source::Force(effort.place)));
        f(format!("{}.effort", effort.name), unit, source, value.unwrap_or(f64::NAN));
    }
    for (k, reaction) in info.reactions.iter().enumerate() {
        let (name, found) = (reaction.name, forces.and_then(|forces| forces.reactions.get(k)));
        if reaction.has_force {
            let [x, y] = found.and_then(|found| found.force).unwrap_or([f64::NAN; 2]);
            let index = reaction.force().unwrap_or(reaction.place);
            for (suffix, source, value) in [
                ("force_x", Source::Force(index), x),
                ("force_y", Source::Force(index + 1), y),
                ("force", Source::ForceLength(index), x.hypot(y)),
            ] {
                f(format!("{name}.{suffix}"), force, Some(source), value);
            }
        }
        if reaction.has_moment {
            let source = reaction.moment().map(Source::Force);
            f(format!("{name}.moment"), moment, source, found.and_then(|found| found.moment).unwrap_or(f64::NAN));
        }
        for (c, frame) in reaction.couples.iter().enumerate() {
            let value = found.and_then(|found| Some(found.couples.get(c)?.1));
            let source = Some(Source::Force(reaction.couples() + c));
            f(format!("{name}.torque_{}", body(*frame)), moment, source, value.unwrap_or(f64::NAN));
        }
        for c in 0..reaction.generalized {
            let value = found.and_then(|found| found.generalized.get(c).copied());
            let source = Some(Source::Force(reaction.couples() + reaction.couples.len() + c));
            f(format!("{name}.generalized"), None, source, value.unwrap_or(f64::NAN));
        }
        if reaction.has_normal {
            let source = reaction.normal().map(Source::Force);
            f(format!("{name}.normal"), force, source, found.and_then(|found| found.normal).unwrap_or(f64::NAN));
        }
        if reaction.has_tangential {
            // The column after the normal part.
            let source = reaction.normal().map(|index| Source::Force(index + 1));
            let value = found.and_then(|found| found.tangential).unwrap_or(f64::NAN);
            f(format!("{name}.tangential"), force, source, value);
        }
        if reaction.has_tension {
            let source = reaction.tension().map(Source::Force);
            f(format!("{name}.tension"), force, source, found.and_then(|found| found.tension).unwrap_or(f64::NAN));
        }
    }
    for (k, spring) in info.springs.iter().enumerate() {
        let quantity = if spring.turns { "torque" } else { "tension" };
        let value = forces.and_then(|forces| Some(forces.springs.get(k)?.force));
        let (unit, source) = (if spring.turns { moment } else { force }, Some(Source::Force(spring.place + 2)));
        f(format!("{}.{quantity}", spring.name), unit, source, value.unwrap_or(f64::NAN));
    }
    let total = |number: Total| forces.map_or(f64::NAN, number);
    let at = Source::Force;
    let totals: [(&str, Source, Total); 10] = [
        ("shaking.force_x", at(ForceModel::SHAKING), |forces| forces.shaking.force[0]),
        ("shaking.force_y", at(ForceModel::SHAKING + 1), |forces| forces.shaking.force[1]),
        ("shaking.force", Source::ForceLength(ForceModel::SHAKING), |forces| {
            forces.shaking.force[0].hypot(forces.shaking.force[1])
        }),
        ("shaking.moment", at(ForceModel::SHAKING + 2), |forces| forces.shaking.moment),
        ("energy.kinetic", at(ForceModel::KINETIC), |forces| forces.kinetic),
        ("energy.gravity", at(ForceModel::GRAVITY), |forces| forces.gravity),
        ("energy.springs", at(ForceModel::SPRINGS), |forces| forces.elastic),
        ("power.drivers", at(ForceModel::DRIVER_POWER), |forces| forces.driver_power),
        ("power.applied", at(ForceModel::APPLIED_POWER), |forces| forces.applied_power),
        ("power.dampers", at(ForceModel::DAMPER_POWER), |forces| forces.damper_power),
    ];
    for (name, source, number) in totals {
        let unit = match name.split_once('.') {
            Some(("energy", _)) => energy,
            Some(("power", _)) => power,
            Some((_, "moment")) => moment,
            _ => force,
        };
        f(name.to_owned(), unit, Some(source), total(number));
    }
}

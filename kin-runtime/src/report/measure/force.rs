//! Forces as columns of numbers.

use crate::forces::Forces;
use crate::model::{ForceModel, Frame, Model};

/// The names of the columns of forces; none for a mechanism without masses and loads.
pub(crate) fn column_names(model: &Model) -> Vec<String> {
    let Some(info) = model.forces else { return Vec::new() };
    let mut names = Vec::new();
    visit(model, info, None, &mut |name, _| names.push(name));
    names
}

/// The numbers of [`column_names`]; NaN for what is undetermined.
pub(crate) fn column_values(model: &Model, forces: Option<&Forces>, out: &mut Vec<f64>) {
    if let Some(info) = model.forces {
        visit(model, info, forces, &mut |_, value| out.push(value));
    }
}

/// A number of the whole mechanism.
type Total = fn(&Forces) -> f64;

/// Every column with its number, in order.
fn visit(model: &Model, info: &ForceModel, forces: Option<&Forces>, f: &mut dyn FnMut(String, f64)) {
    let body = |frame: Frame| match frame {
        Frame::Ground => "ground",
        Frame::Body(place) => model.bodies.get(place).map_or("", |body| body.name),
    };
    for (k, effort) in info.efforts.iter().enumerate() {
        let value = forces.and_then(|forces| forces.efforts.get(k)?.effort);
        f(format!("{}.effort", effort.name), value.unwrap_or(f64::NAN));
    }
    for (k, reaction) in info.reactions.iter().enumerate() {
        let (name, found) = (reaction.name, forces.and_then(|forces| forces.reactions.get(k)));
        if reaction.has_force {
            let [x, y] = found.and_then(|found| found.force).unwrap_or([f64::NAN; 2]);
            for (what, value) in [("force_x", x), ("force_y", y), ("force", x.hypot(y))] {
                f(format!("{name}.{what}"), value);
            }
        }
        if reaction.has_moment {
            f(format!("{name}.moment"), found.and_then(|found| found.moment).unwrap_or(f64::NAN));
        }
        for (c, frame) in reaction.couples.iter().enumerate() {
            let value = found.and_then(|found| Some(found.couples.get(c)?.1));
            f(format!("{name}.torque_{}", body(*frame)), value.unwrap_or(f64::NAN));
        }
        for c in 0..reaction.generalized {
            let value = found.and_then(|found| found.generalized.get(c).copied());
            f(format!("{name}.generalized"), value.unwrap_or(f64::NAN));
        }
    }
    for (k, spring) in info.springs.iter().enumerate() {
        let what = if spring.turns { "torque" } else { "tension" };
        let value = forces.and_then(|forces| Some(forces.springs.get(k)?.force));
        f(format!("{}.{what}", spring.name), value.unwrap_or(f64::NAN));
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
        f(name.to_owned(), total(of));
    }
}

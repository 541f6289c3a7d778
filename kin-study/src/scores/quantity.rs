//! The quantities of a mechanism by name.

use crate::suggest::unknown;
use kin_runtime::model::{Frame, Geometry, JointInfo, Model, Role};
use kin_runtime::transmission::neighbours;

/// The last letters of a name, for a value, its rate and its acceleration.
const SUFFIXES: [&str; 3] = ["", "_dot", "_ddot"];

/// Where a quantity comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// An entry of q, q̇ or q̈.
    Coordinate { place: usize, order: usize },
    /// A row of the observables, its rate or its acceleration.
    Observable { row: usize, order: usize },
    /// An angle between three points of joints; its deviation from π/2 where that is meant.
    Transmission { points: [Geometry; 3], deviation: bool },
    /// One of the numbers of forces.
    Force(usize),
    /// The length of the vector of two of them.
    ForceLength(usize),
}

/// A quantity, or its magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quantity {
    pub(super) source: Source,
    pub(super) magnitude: bool,
}

impl Quantity {
    /// The quantity with a name.
    pub(super) fn find(model: &Model, name: &str) -> Result<Self, String> {
        let (base, magnitude) = match name.strip_prefix('|').and_then(|rest| rest.strip_suffix('|')) {
            Some(inner) => (inner.trim(), true),
            None => (name, false),
        };
        let all = sources(model);
        let found = all.iter().find(|(known, _)| known == base).map(|(_, source)| *source);
        let source = found.ok_or_else(|| unknown("quantity", base, all.iter().map(|(name, _)| name.as_str())))?;
        Ok(Self { source, magnitude })
    }
}

/// The names of all quantities of a mechanism.
pub(crate) fn names(model: &Model) -> Vec<String> {
    sources(model).into_iter().map(|(name, _)| name).collect()
}

fn sources(model: &Model) -> Vec<(String, Source)> {
    let mut all = Vec::new();
    let mut with_rates = |name: &str, source: &dyn Fn(usize) -> Source| {
        all.extend(SUFFIXES.iter().enumerate().map(|(order, suffix)| (format!("{name}{suffix}"), source(order))));
    };
    for (place, coordinate) in model.coordinates.iter().enumerate() {
        with_rates(coordinate.name, &|order| Source::Coordinate { place, order });
    }
    let observable = |row: usize| move |order: usize| Source::Observable { row, order };
    for body in model.bodies {
        for (k, axis) in ["x", "y", "phi"].into_iter().enumerate() {
            if body.coordinates[k].is_none() {
                with_rates(&format!("{}.{axis}", body.name), &observable(body.observables[k]));
            }
        }
    }
    for point in model.points {
        for (row, axis) in point.observables.into_iter().zip(["x", "y"]) {
            with_rates(&format!("{}.{axis}", point.name), &observable(row));
        }
    }
    for define in model.defines {
        with_rates(define.name, &observable(define.observable));
    }
    for joint in model.joints {
        for quantity in joint.quantities {
            with_rates(&format!("{}.{}", joint.name, quantity.name), &observable(quantity.observable));
        }
    }
    for condition in model.conditions {
        with_rates(condition.name, &observable(condition.observable));
    }
    transmissions(model, &mut all);
    forces(model, &mut all);
    all
}

/// Transmission angles: by the joint alone where it has one, and by its neighbours.
fn transmissions(model: &Model, all: &mut Vec<(String, Source)>) {
    let found = neighbours(model);
    for &[joint, a, b] in &found {
        let on = |k: usize, body: Frame| point_on(&model.joints[k], body);
        let [Some(first), Some(second)] = model.joints[joint].frames else { continue };
        let (Some(centre), Some(from), Some(to)) = (on(joint, first), on(a, first), on(b, second)) else { continue };
        let name = model.joints[joint].name;
        let alone = found.iter().filter(|other| other[0] == joint).count() == 1;
        let pair = format!("{name}.transmission({}, {})", model.joints[a].name, model.joints[b].name);
        let deviation = format!("{name}.deviation({}, {})", model.joints[a].name, model.joints[b].name);
        let points = [centre, from, to];
        for (names, deviation) in
            [([format!("{name}.transmission"), pair], false), ([format!("{name}.deviation"), deviation], true)]
        {
            let [short, long] = names;
            all.extend(alone.then_some((short, Source::Transmission { points, deviation })));
            all.push((long, Source::Transmission { points, deviation }));
        }
    }
}

/// The point of a joint on a body.
fn point_on(joint: &JointInfo, body: Frame) -> Option<Geometry> {
    let is_point = |geometry: &&Geometry| matches!(geometry.role, Role::P | Role::Q) && geometry.frame == body;
    joint.geometry.iter().find(is_point).copied()
}

/// Forces by the names of their columns, where closed forms hold them.
fn forces(model: &Model, all: &mut Vec<(String, Source)>) {
    let Some(info) = model.forces.filter(|info| info.solved) else { return };
    all.extend(info.efforts.iter().map(|effort| (format!("{}.effort", effort.name), Source::Force(effort.place))));
    for reaction in info.reactions {
        let mut place = reaction.place;
        if reaction.has_force {
            let force = place + 2;
            for (what, source) in [
                ("force_x", Source::Force(force)),
                ("force_y", Source::Force(force + 1)),
                ("force", Source::ForceLength(force)),
            ] {
                all.push((format!("{}.{what}", reaction.name), source));
            }
            place += 4;
        }
        if reaction.has_moment {
            all.push((format!("{}.moment", reaction.name), Source::Force(place)));
        }
    }
    for spring in info.springs {
        let what = if spring.turns { "torque" } else { "tension" };
        all.push((format!("{}.{what}", spring.name), Source::Force(spring.place + 2)));
    }
    for (name, source) in [
        ("shaking.force_x", Source::Force(0)),
        ("shaking.force_y", Source::Force(1)),
        ("shaking.force", Source::ForceLength(0)),
        ("shaking.moment", Source::Force(2)),
        ("energy.kinetic", Source::Force(6)),
        ("energy.gravity", Source::Force(7)),
        ("energy.springs", Source::Force(8)),
        ("power.drivers", Source::Force(9)),
        ("power.applied", Source::Force(10)),
        ("power.dampers", Source::Force(11)),
    ] {
        all.push((name.to_owned(), source));
    }
}

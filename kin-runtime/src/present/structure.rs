//! The structure of a mechanism, as a record for JSON.

use super::json::{Record, record};
use super::text::{coordinate_names, frame_name, third_body};
use super::units::ResultUnits;
use super::{condition, plan};
use crate::mobility::Mobility;
use crate::model::{Level, Model, OperationCount, OriginKind};
use crate::modes::Mode;
use crate::serial::coordinate_names as all_coordinates;

/// A configuration and its mobility.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KnownConfiguration<'a> {
    pub(crate) t: f64,
    pub(crate) q: &'a [f64],
    pub(crate) mobility: &'a Mobility,
    pub(crate) modes: &'a [Mode],
}

/// The structure; entries that need a configuration are null without one.
pub(crate) fn structure(model: &'static Model, values: &[f64], known: Option<KnownConfiguration<'_>>) -> Record {
    let mobility = known.map(|k| k.mobility);
    let names = |places: fn(&Mobility) -> &[usize]| mobility.map(|m| coordinate_names(model, places(m)));
    let mut all = record! {
        mechanism: model.name,
        doc: model.doc,
        coordinates: all_coordinates(model),
        rows: rows(model),
        degrees_of_freedom: mobility.map(|m| m.degrees_of_freedom),
        degrees_of_freedom_left: mobility.map(|m| m.degrees_of_freedom_left),
        position_degrees_of_freedom: mobility.map(|m| m.position_degrees_of_freedom),
        position_degrees_of_freedom_left: mobility.map(|m| m.position_degrees_of_freedom_left),
        operations: operations(model.operations),
    };
    all.extend(model.forces.map(|forces| ("force_operations".to_owned(), operations(forces.operations).into())));
    all.extend(record! {
        counts: counts(model),
        bodies: bodies(model),
        parameters: parameters(model, values),
        inputs: model.inputs,
        units: ResultUnits::of(model).record(),
        functions: model.functions,
        points: model.points.iter().map(|p| p.name).collect::<Vec<_>>(),
        defines: model.defines.iter().map(|d| d.name).collect::<Vec<_>>(),
        joints: joints(model),
        conditions: condition::records(model),
        drivers: drivers(model),
        independent: names(|m| &m.independent),
        dependent: names(|m| &m.dependent),
        could_be_given: names(|m| &m.could_be_given),
        rank: mobility.map(|m| m.rank),
        rank_without_driving: mobility.map(|m| m.rank_without_driving),
        // Ranks at a general pose and for general dimensions; null if the model does not have them.
        generic_rank: model.structure.map(|s| s.rank),
        generic_degrees_of_freedom: model.structure.map(|s| model.coordinates.len() - s.rank_without_driving),
        generic_redundant: generic(model),
        redundant: mobility.map(|m| &m.redundant),
        condition: mobility.map(|m| m.condition),
        singular_values: mobility.map(|m| &m.singular_values),
        // The configuration at which ranks and degrees of freedom were determined.
        configuration: known.map(|k| record! { t: k.t, q: k.q }),
        plan: plan::record(model, known.map(|k| k.modes).filter(|modes| !modes.is_empty())),
    });
    all
}

fn operations(count: OperationCount) -> Record {
    let OperationCount { add, mul, neg, div, sqrt, sincos, function } = count;
    record! { add: add, mul: mul, neg: neg, div: div, sqrt: sqrt, sincos: sincos, function: function }
}

/// Joints that have a driving row.
pub(crate) fn drivers(model: &Model) -> Vec<&'static str> {
    let drives = |index: usize| model.rows.iter().any(|r| r.joint == index && r.driving);
    model.joints.iter().enumerate().filter(|(index, _)| drives(*index)).map(|(_, j)| j.name).collect()
}

/// Rows that are redundant for all dimensions.
fn generic(model: &Model) -> Vec<Record> {
    let record = |found: &crate::model::GenericRedundancy| {
        let row = model.rows.get(found.row);
        let joint = row.and_then(|row| model.joints.get(row.joint));
        let (row, joint) = (row.map_or("", |r| r.name), joint.map_or("", |j| j.name));
        record! { row: row, joint: joint, circuit: found.circuit }
    };
    model.structure.iter().flat_map(|structure| structure.redundant).map(record).collect()
}

fn rows(model: &Model) -> Vec<Record> {
    let record = |row: &crate::model::RowInfo| {
        let joint = model.joints.get(row.joint);
        record! {
            name: row.name,
            joint: joint.map_or("", |j| j.name),
            kind: joint.map_or("", |j| j.kind.keyword()),
            classes: row.classes(),
            holonomic: row.level == Level::Position,
            rheonomic: row.rheonomic,
            bilateral: row.bilateral,
            driving: row.driving,
        }
    };
    model.rows.iter().map(record).collect()
}

fn counts(model: &Model) -> Record {
    record! {
        bodies: model.bodies.len(),
        coordinates: model.coordinates.len(),
        rows: model.rows.len(),
        driving_rows: model.rows.iter().filter(|r| r.driving).count(),
        velocity_level_rows: model.rows.iter().filter(|r| r.level == Level::Velocity).count(),
        joints: model.joints.len(),
        conditions: model.conditions.len(),
        drivers: drivers(model).len(),
        parameters: model.parameters.len(),
        inputs: model.inputs.len(),
        points: model.points.len(),
        defines: model.defines.len(),
        jacobian_entries: model.constraint_pattern.entries.len(),
        constant_jacobian_entries: model.constraint_pattern.constants.len(),
    }
}

fn bodies(model: &Model) -> Vec<Record> {
    let record = |body: &crate::model::BodyInfo| {
        let places: Vec<usize> = body.coordinates.iter().flatten().copied().collect();
        let carried_by = match body.origin {
            OriginKind::Free => None,
            OriginKind::Carried(frame) => Some(frame_name(model, frame)),
        };
        record! { name: body.name, coordinates: coordinate_names(model, &places), carried_by: carried_by }
    };
    model.bodies.iter().map(record).collect()
}

fn parameters(model: &Model, values: &[f64]) -> Vec<Record> {
    let pairs = model.parameters.iter().zip(values);
    pairs
        .map(|(p, value)| record! { name: p.name, value: value, default: p.default, unit: p.unit, doc: p.doc })
        .collect()
}

fn joints(model: &Model) -> Vec<Record> {
    let record = |(index, joint): (usize, &crate::model::JointInfo)| {
        record! {
            name: joint.name,
            kind: joint.kind.keyword(),
            between: joint.frames.iter().flatten().map(|f| frame_name(model, *f)).collect::<Vec<_>>(),
            // The carrier of gears, the pinion of a rack.
            third_body: third_body(model, joint),
            rows: model.rows.iter().filter(|r| r.joint == index).map(|r| r.name).collect::<Vec<_>>(),
            quantities: joint.quantities.iter().map(|q| q.name).collect::<Vec<_>>(),
        }
    };
    model.joints.iter().enumerate().map(record).collect()
}

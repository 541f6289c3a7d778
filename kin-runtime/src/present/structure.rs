//! The structure of a mechanism, as a record for JSON.

use serde::Serialize;

use super::condition::{self, ConditionRecord};
use super::plan::PlanRecord;
use super::text::{coordinate_names, frame_name, third_body};
use super::units::{Units, UnitsRecord};
use crate::mobility::{Mobility, RedundantRow};
use crate::model::{BodyInfo, Level, Model, OperationCount, OriginKind};
use crate::modes::Mode;

/// A configuration and its mobility.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known<'a> {
    pub(crate) t: f64,
    pub(crate) q: &'a [f64],
    pub(crate) mobility: &'a Mobility,
    pub(crate) modes: &'a [Mode],
}

/// The structure; entries that need a configuration are null without one.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct StructureRecord<'a> {
    mechanism: &'static str,
    doc: &'static str,
    coordinates: Vec<&'static str>,
    rows: Vec<RowRecord>,
    degrees_of_freedom: Option<usize>,
    degrees_of_freedom_left: Option<usize>,
    position_degrees_of_freedom: Option<usize>,
    position_degrees_of_freedom_left: Option<usize>,
    operations: OperationRecord,
    #[serde(skip_serializing_if = "Option::is_none")]
    force_operations: Option<OperationRecord>,
    counts: CountRecord,
    bodies: Vec<BodyRecord>,
    parameters: Vec<ParameterRecord>,
    inputs: &'static [&'static str],
    units: UnitsRecord,
    functions: &'static [&'static str],
    points: Vec<&'static str>,
    defines: Vec<&'static str>,
    joints: Vec<JointRecord>,
    conditions: Vec<ConditionRecord>,
    drivers: Vec<&'static str>,
    independent: Option<Vec<&'static str>>,
    dependent: Option<Vec<&'static str>>,
    could_be_given: Option<Vec<&'static str>>,
    rank: Option<usize>,
    rank_without_driving: Option<usize>,
    /// Ranks at a general pose and for general dimensions; null if the model does not know them.
    generic_rank: Option<usize>,
    generic_degrees_of_freedom: Option<usize>,
    generic_redundant: Vec<GenericRecord>,
    redundant: Option<&'a [RedundantRow]>,
    condition: Option<f64>,
    singular_values: Option<&'a [f64]>,
    /// The configuration at which ranks and degrees of freedom were determined.
    configuration: Option<ConfigurationRecord<'a>>,
    plan: PlanRecord,
}

impl<'a> StructureRecord<'a> {
    pub(crate) fn new(model: &'static Model, values: &[f64], known: Option<Known<'a>>) -> Self {
        let mobility = known.map(|k| k.mobility);
        let names = |places: fn(&Mobility) -> &[usize]| mobility.map(|m| coordinate_names(model, places(m)));
        Self {
            mechanism: model.name,
            doc: model.doc,
            coordinates: model.coordinates.iter().map(|c| c.name).collect(),
            rows: rows(model),
            degrees_of_freedom: mobility.map(|m| m.degrees_of_freedom),
            degrees_of_freedom_left: mobility.map(|m| m.degrees_of_freedom_left),
            position_degrees_of_freedom: mobility.map(|m| m.position_degrees_of_freedom),
            position_degrees_of_freedom_left: mobility.map(|m| m.position_degrees_of_freedom_left),
            operations: model.operations.into(),
            force_operations: model.forces.map(|forces| forces.operations.into()),
            counts: counts(model),
            bodies: model.bodies.iter().map(|b| body(model, b)).collect(),
            parameters: parameters(model, values),
            inputs: model.inputs,
            units: Units::of(model).record(),
            functions: model.functions,
            points: model.points.iter().map(|p| p.name).collect(),
            defines: model.defines.iter().map(|d| d.name).collect(),
            joints: joints(model),
            conditions: condition::records(model),
            drivers: drivers(model),
            independent: names(|m| &m.independent),
            dependent: names(|m| &m.dependent),
            could_be_given: names(|m| &m.could_be_given),
            rank: mobility.map(|m| m.rank),
            rank_without_driving: mobility.map(|m| m.rank_without_driving),
            generic_rank: model.structure.map(|s| s.rank),
            generic_degrees_of_freedom: model.structure.map(|s| model.coordinates.len() - s.rank_without_driving),
            generic_redundant: generic(model),
            redundant: mobility.map(|m| m.redundant.as_slice()),
            condition: mobility.map(|m| m.condition),
            singular_values: mobility.map(|m| m.singular_values.as_slice()),
            configuration: known.map(|k| ConfigurationRecord { t: k.t, q: k.q }),
            plan: PlanRecord::new(model, known.map(|k| k.modes).filter(|modes| !modes.is_empty())),
        }
    }
}

#[derive(Clone, Debug, Serialize)]
struct ConfigurationRecord<'a> {
    t: f64,
    q: &'a [f64],
}

#[derive(Clone, Debug, Serialize)]
struct RowRecord {
    name: &'static str,
    joint: &'static str,
    kind: &'static str,
    classes: [&'static str; 3],
    holonomic: bool,
    rheonomic: bool,
    bilateral: bool,
    driving: bool,
}

#[derive(Clone, Debug, Serialize)]
struct GenericRecord {
    row: &'static str,
    joint: &'static str,
    circuit: &'static [&'static str],
}

#[derive(Clone, Debug, Serialize)]
struct OperationRecord {
    add: usize,
    mul: usize,
    neg: usize,
    div: usize,
    sqrt: usize,
    sincos: usize,
    function: usize,
}

impl From<OperationCount> for OperationRecord {
    fn from(count: OperationCount) -> Self {
        let OperationCount { add, mul, neg, div, sqrt, sincos, function } = count;
        Self { add, mul, neg, div, sqrt, sincos, function }
    }
}

#[derive(Clone, Debug, Serialize)]
struct CountRecord {
    bodies: usize,
    coordinates: usize,
    rows: usize,
    driving_rows: usize,
    velocity_level_rows: usize,
    joints: usize,
    conditions: usize,
    drivers: usize,
    parameters: usize,
    inputs: usize,
    points: usize,
    defines: usize,
    jacobian_entries: usize,
    constant_jacobian_entries: usize,
}

#[derive(Clone, Debug, Serialize)]
struct BodyRecord {
    name: &'static str,
    coordinates: Vec<&'static str>,
    /// The body that carries the origin, if the origin is carried.
    carried_by: Option<&'static str>,
}

#[derive(Clone, Debug, Serialize)]
struct ParameterRecord {
    name: &'static str,
    value: f64,
    default: Option<f64>,
    unit: Option<&'static str>,
    doc: &'static str,
}

#[derive(Clone, Debug, Serialize)]
struct JointRecord {
    name: &'static str,
    kind: &'static str,
    between: Vec<&'static str>,
    /// The carrier of gears, the pinion of a rack.
    third_body: Option<&'static str>,
    rows: Vec<&'static str>,
    quantities: Vec<&'static str>,
}

/// Joints that have a driving row.
pub(crate) fn drivers(model: &Model) -> Vec<&'static str> {
    let drives = |place: usize| model.rows.iter().any(|r| r.joint == place && r.driving);
    model.joints.iter().enumerate().filter(|(place, _)| drives(*place)).map(|(_, j)| j.name).collect()
}

/// Rows that are redundant whatever the dimensions.
fn generic(model: &Model) -> Vec<GenericRecord> {
    let record = |found: &crate::model::GenericRedundancy| {
        let row = model.rows.get(found.row);
        let joint = row.and_then(|row| model.joints.get(row.joint));
        GenericRecord { row: row.map_or("", |r| r.name), joint: joint.map_or("", |j| j.name), circuit: found.circuit }
    };
    model.structure.iter().flat_map(|structure| structure.redundant).map(record).collect()
}

fn rows(model: &Model) -> Vec<RowRecord> {
    let record = |row: &crate::model::RowInfo| {
        let joint = model.joints.get(row.joint);
        RowRecord {
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

fn counts(model: &Model) -> CountRecord {
    CountRecord {
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

fn body(model: &Model, info: &BodyInfo) -> BodyRecord {
    let places: Vec<usize> = info.coordinates.iter().flatten().copied().collect();
    BodyRecord {
        name: info.name,
        coordinates: coordinate_names(model, &places),
        carried_by: match info.origin {
            OriginKind::Free => None,
            OriginKind::Carried(frame) => Some(frame_name(model, frame)),
        },
    }
}

fn parameters(model: &Model, values: &[f64]) -> Vec<ParameterRecord> {
    let pairs = model.parameters.iter().zip(values);
    pairs
        .map(|(p, &value)| ParameterRecord { name: p.name, value, default: p.default, unit: p.unit, doc: p.doc })
        .collect()
}

fn joints(model: &Model) -> Vec<JointRecord> {
    let record = |(place, joint): (usize, &crate::model::JointInfo)| JointRecord {
        name: joint.name,
        kind: joint.kind.keyword(),
        between: joint.frames.iter().flatten().map(|f| frame_name(model, *f)).collect(),
        third_body: third_body(model, joint),
        rows: model.rows.iter().filter(|r| r.joint == place).map(|r| r.name).collect(),
        quantities: joint.quantities.iter().map(|q| q.name).collect(),
    };
    model.joints.iter().enumerate().map(record).collect()
}

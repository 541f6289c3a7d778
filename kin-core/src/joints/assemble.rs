//! Assembly: writes the rows of all joints of a mechanism.

use super::kinds::rows_of;
use crate::constraint::{
    Assembly, ConstraintRow, ConstraintSet, CurveInstance, Family, Geometry, JointInstance, JointRows, ObservableKind,
    Quantity, RowMeaning, indexed, mark_scalars,
};
use crate::error::ModelError;
use crate::mechanism::{Mechanism, Operands, Statement, contains_signal};
use crate::vocabulary::StatementKind;
use core::ops::Range;

/// Assembles Φ and everything that is reported.
///
/// # Errors
/// Indices out of range and cyclic definitions, which [`check`](crate::check::check) also finds; and operands that are
/// degenerate for a member of a family or after constant folding, such as a radius of 0 or a negative mass, of which `check` finds only
/// literal ones.
pub fn assemble(mechanism: &Mechanism) -> Result<ConstraintSet, Vec<ModelError>> {
    let mut set = ConstraintSet { name: mechanism.name.clone(), ..ConstraintSet::default() };
    let mut assembly = Assembly::new(mechanism, &mut set);
    assembly.bodies(&mut set);
    assembly.points(&mut set);
    assembly.defines(&mut set);
    joints(&mut assembly, &mut set);
    assembly.conditions(&mut set);
    assembly.guesses(&mut set);
    assembly.check_loads();
    (set.graph, set.distances) = (assembly.graph, assembly.distances);
    mark_scalars(&mut set);
    if assembly.errors.is_empty() { Ok(set) } else { Err(assembly.errors) }
}

fn joints(a: &mut Assembly<'_>, set: &mut ConstraintSet) {
    for (family, joint) in a.mechanism.joints.iter().enumerate() {
        let first = set.rows.len();
        let instances = Assembly::instances(joint.range);
        let members = instances.len();
        for (shown, index) in instances {
            a.index = index;
            let name = indexed(&joint.name, shown.is_some(), index);
            a.member = shown.map(|_| name.clone());
            let rows = rows_of(a, &joint.operands);
            write(a, set, joint, (family, index), name, rows);
        }
        a.member = None;
        if joint.range.is_some() && members > 0 {
            let stride = (set.rows.len() - first) / members;
            set.row_families.push(Family { name: joint.name.clone(), first, members, stride });
        }
    }
}

fn write(
    a: &mut Assembly<'_>,
    set: &mut ConstraintSet,
    joint: &Statement,
    family: (usize, i64),
    name: String,
    rows: JointRows,
) {
    let StatementKind::Joint(kind) = joint.operands.kind() else { return };
    let index = set.joints.len();
    let geometry = rows
        .geometry
        .into_iter()
        .map(|(role, frame, numbers)| {
            let offset = set.geometry.len();
            set.geometry.extend(numbers);
            Geometry { role, frame, offset }
        })
        .collect();
    let quantities = (rows.quantities.iter().enumerate())
        .map(|(k, (name, value))| Quantity {
            name,
            observable: a.observe(set, ObservableKind::Joint(index, k), *value),
        })
        .collect();
    let first_row = set.rows.len();
    let total = rows.residuals.len() + usize::from(rows.velocity.is_some());
    let moving = moving_rows(a.mechanism, &joint.operands, total);
    for (k, (suffix, meaning, phi)) in rows.residuals.into_iter().enumerate() {
        let name = if suffix.is_empty() { name.clone() } else { format!("{name}.{suffix}") };
        let operands_move = moving.contains(&k);
        set.rows.push(ConstraintRow { name, joint: index, phi, meaning, velocity: None, operands_move });
    }
    if let Some(velocity) = rows.velocity {
        let (name, phi, operands_move) = (name.clone(), a.graph.zero(), !moving.is_empty());
        let (meaning, velocity) = (RowMeaning::Other, Some(velocity));
        set.rows.push(ConstraintRow { name, joint: index, phi, meaning, velocity, operands_move });
    }
    let count = set.rows.len() - first_row;
    if let Some(point) = a.outline.take() {
        set.curves.push(CurveInstance { joint: index, point });
    }
    set.joints.push(JointInstance {
        name,
        keyword: joint.keyword,
        family,
        kind,
        frames: rows.frames,
        first_row,
        rows: count,
        geometry,
        quantities,
    });
}

/// The rows, of `rows` in all, whose own operands contain t or an input. Such rows are driving: a length, angle,
/// offset or right-hand side that varies with time prescribes a motion. A joint of a body with a held coordinate
/// that varies with time also contains t, but only through the pose of the body; it is not driving.
fn moving_rows(mechanism: &Mechanism, operands: &Operands, rows: usize) -> Range<usize> {
    let moves = |formulas: Vec<_>| formulas.into_iter().any(|formula| contains_signal(mechanism, formula));
    let moving = operands.iter().filter(|(slot, operand)| slot.may_move() && moves(operand.formulas()));
    let first = moving.map(|(slot, _)| if slot.in_last_row { rows.saturating_sub(1) } else { 0 }).min();
    first.unwrap_or(rows)..rows
}

//! A sheet from the expression graph, while the mechanism is compiled.

use super::content::{Dynamics, Joint, Rows, Sheet};
use super::shown::{Row, ShownFormula};
use super::steps::SheetStep;
use crate::constraint::{Frame, JointInstance};
use crate::loads::dynamics;
use crate::mechanism::Mechanism;
use crate::plan::SolutionPlan;
use crate::system::{Equation, KinematicSystem};
use crate::vectors::NamedJoint;
use crate::vocabulary::JointKind;
use crate::vocabulary::Role;

impl Sheet {
    /// The derivation of a system. Of the members of a family that differ only in their indices, the first is written,
    /// with the names of the others. There are steps only if the plan was made with its formulas, and equations of
    /// motion only if the mechanism has masses or loads.
    pub fn of_system(mechanism: &Mechanism, system: &KinematicSystem, plan: &SolutionPlan) -> Self {
        let set = &system.set;
        let mut joints: Vec<Joint> = Vec::new();
        let mut shapes: Vec<(usize, JointKind, Vec<String>)> = Vec::new();
        for joint in &set.joints {
            let shape = (joint.family.0, joint.kind, shape(system, joint));
            match shapes.iter().position(|other| *other == shape) {
                Some(index) => joints[index].alike.push(joint.name.clone()),
                None => {
                    shapes.push(shape);
                    joints.push(of_joint(system, joint));
                }
            }
        }
        let coordinates: Vec<String> = set.coordinates.iter().map(|coordinate| coordinate.name.clone()).collect();
        let dynamics = dynamics(mechanism, system).map(|terms| {
            let mass = terms.mass.iter().map(|(row, column, entry)| (*row, *column, entry.as_str()));
            Dynamics::new(&coordinates, mass, terms.forces.iter().map(String::as_str))
        });
        let (steps, unsolved) = (SheetStep::of_plan(plan), String::new());
        let sheet = Self {
            name: set.name.clone(),
            doc: String::new(),
            coordinates,
            joints,
            rows: Rows::ByJoint,
            steps,
            unsolved,
            dynamics,
        };
        sheet.with_distinct_symbols()
    }
}

/// The shape of a member of a family: the texts of its residuals without indices, which are equal for members that
/// differ only in these.
fn shape(system: &KinematicSystem, joint: &JointInstance) -> Vec<String> {
    let without_indices = |text: String| {
        let parts = text.split('[').enumerate();
        parts.map(|(k, part)| part.trim_start_matches(|c: char| k > 0 && c.is_ascii_digit())).collect::<String>()
    };
    let rows = joint.first_row..joint.first_row + joint.rows;
    rows.map(|row| without_indices(system.set.show(residual(system, row)))).collect()
}

fn residual(system: &KinematicSystem, row: usize) -> crate::expr::ExprId {
    system.set.rows[row].velocity.map_or(system.equations[row].phi, |velocity| velocity.eta)
}

fn of_joint(system: &KinematicSystem, joint: &JointInstance) -> Joint {
    let set = &system.set;
    let name = |frame: Frame| match frame {
        Frame::Ground => None,
        Frame::Body(body) => set.bodies.get(body).map(|body| body.name.as_str()),
    };
    let point = |role: Role| joint.geometry.iter().find(|entry| entry.role == role).map(|entry| name(entry.frame));
    let frames = joint.frames.map(|frame| frame.map(name));
    let points = [point(Role::P), point(Role::Q)];
    let named = NamedJoint { kind: joint.kind, name: &joint.name, frames, points };
    let mut out = Joint::new(&named);
    let rows = joint.first_row..joint.first_row + joint.rows;
    let classes = rows.clone().map(|row| &system.classes[row]);
    let [mut driving, mut rheonomic] = [false; 2];
    for class in classes {
        (driving, rheonomic) = (driving || class.driving, rheonomic || class.rheonomic);
    }
    out.what.push_str(if rheonomic { "; rheonomic" } else { "; scleronomic" });
    out.what.push_str(if driving && joint.kind != JointKind::Driver { ", driving" } else { "" });
    out.rows = rows.map(|row| of_row(system, row)).collect();
    out
}

fn of_row(system: &KinematicSystem, row: usize) -> Row {
    let set = &system.set;
    let Equation { phi_q, phi_t, gamma, .. } = &system.equations[row];
    let shown = |id| ShownFormula::new(&set.show(id));
    let entries = phi_q.iter().map(|&(k, entry)| (set.coordinate_name(k).to_owned(), shown(entry)));
    Row {
        name: set.rows[row].name.clone(),
        position: set.rows[row].velocity.is_none(),
        phi: shown(residual(system, row)),
        phi_q: entries.collect(),
        phi_t: shown(*phi_t),
        gamma: shown(*gamma),
    }
}

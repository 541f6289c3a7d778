//! The derivation for people: joint by joint, each with its own equation first, then its rows of Φ, Φ_q, Φ_t and γ;
//! with masses or loads the equations of motion.
//!
//! The formulas are those from which the code was generated, as the tables of the mechanism hold them; kin-core writes
//! them.

use crate::model::{EquationText, Frame, JointInfo, Level, LineText, Model, Role, StepText};
use kin_core::sheet::{Dynamics, Joint, Row, Rows, Sheet, SheetStep, ShownFormula, StepLine};
use kin_core::vectors::NamedJoint;

/// The requested part of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SheetPart {
    /// Joints, matrices and steps.
    All,
    /// Joints and matrices.
    Rows,
    /// Φ, Φ_q, Φ_t and γ of all joints together.
    Matrices,
    /// Steps of the plan.
    Solution,
}

/// The sheet of the joints with these indices, of all joints if the list is empty, and of the steps of the plan in
/// which they take part.
pub(crate) fn sheet(model: &Model, chosen: &[usize], part: SheetPart) -> Sheet {
    let all = model.joints.iter().enumerate();
    let joints = all.filter(|(index, _)| part != SheetPart::Solution && (chosen.is_empty() || chosen.contains(index)));
    let takes_part = |step: &&StepText| {
        let joints_of_step = model.plan.steps.get(step.step).map_or(&[][..], |step| step.joints);
        matches!(part, SheetPart::All | SheetPart::Solution)
            && (chosen.is_empty() || joints_of_step.iter().any(|joint| chosen.contains(joint)))
    };
    let unsolved = model.plan.absent.filter(|_| matches!(part, SheetPart::All | SheetPart::Solution));
    let rows = match part {
        SheetPart::Matrices => Rows::Together,
        SheetPart::All | SheetPart::Rows if chosen.is_empty() => Rows::Both,
        _ => Rows::ByJoint,
    };
    let coordinates: Vec<String> = model.coordinates.iter().map(|coordinate| coordinate.name.to_owned()).collect();
    let dynamics = model.forces.filter(|forces| rows == Rows::Both && !forces.generalized.is_empty()).map(|forces| {
        Dynamics::new(&coordinates, forces.mass_matrix.iter().copied(), forces.generalized.iter().copied())
    });
    let sheet = Sheet {
        name: model.name.to_owned(),
        doc: model.doc.to_owned(),
        coordinates,
        joints: joints.map(|(_, info)| joint(model, info)).collect(),
        rows,
        steps: model.solution.iter().filter(takes_part).map(step).collect(),
        unsolved: unsolved.unwrap_or_default().to_owned(),
        dynamics,
    };
    sheet.with_distinct_symbols()
}

fn step(step: &StepText) -> SheetStep {
    let line = |line: &LineText| match *line {
        LineText::Equation { left, right } => StepLine::equation(left, right, false),
        LineText::Zero { left, right } => StepLine::equation(left, right, true),
        LineText::System { matrix, unknowns, right } => {
            let shown = |texts: &[&str]| texts.iter().map(|text| ShownFormula::new(text)).collect();
            StepLine::System {
                matrix: matrix.iter().map(|row| shown(row)).collect(),
                unknowns: unknowns.iter().map(|&name| name.to_owned()).collect(),
                right: shown(right),
            }
        }
    };
    SheetStep {
        number: step.step + 1,
        what: step.what.to_owned(),
        lines: step.lines.map(|lines| lines.iter().map(line).collect()),
    }
}

fn joint(model: &Model, joint: &JointInfo) -> Joint {
    let name = |frame: Frame| match frame {
        Frame::Ground => None,
        Frame::Body(body) => model.bodies.get(body).map(|body| body.name),
    };
    let point = |role: Role| joint.geometry.iter().find(|entry| entry.role == role).map(|entry| name(entry.frame));
    let frames = joint.frames.map(|frame| frame.map(name));
    let points = [point(Role::P), point(Role::Q)];
    let mut out = Joint::new(&NamedJoint { kind: joint.kind, name: joint.name, frames, points });
    let rows = joint.first_row..joint.first_row + joint.rows;
    out.rows = rows.filter_map(|index| row(model, index)).collect();
    out
}

fn row(model: &Model, index: usize) -> Option<Row> {
    let (info, text): (_, &EquationText) = (model.rows.get(index)?, model.equations.get(index)?);
    Some(Row {
        name: info.name.to_owned(),
        position: info.level == Level::Position,
        phi: ShownFormula::new(text.phi),
        phi_q: text.phi_q.iter().map(|&(name, entry)| (name.to_owned(), ShownFormula::new(entry))).collect(),
        phi_t: ShownFormula::new(text.phi_t),
        gamma: ShownFormula::new(text.gamma),
    })
}

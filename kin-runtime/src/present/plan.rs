//! The solution plan and the assembly modes: in words, and as records for JSON.

use super::json::{Record, record};
use super::table::{Table, wrapped};
use super::text::section;
use crate::model::Model;
use crate::modes::Mode;
use crate::plan::{PlanStep, StepKind};
use crate::planned::Step;

/// Width of a text in columns.
const COLUMNS: usize = 96;

/// The plan, with the modes of a configuration if there is one; without steps if there is no plan, and why.
pub(crate) fn record(model: &'static Model, known: Option<&[Mode]>) -> Record {
    let steps: Vec<Record> = steps(model).map(|step| of_step(model, step)).collect();
    record! { absent: model.plan.absent, steps: steps, modes: modes(model, known) }
}

fn steps(model: &'static Model) -> impl Iterator<Item = Step> {
    (0..model.plan.steps.len()).filter_map(move |index| Step::new(model, index))
}

/// The modes of a configuration, or all modes without signs and closures.
pub(crate) fn modes(model: &'static Model, known: Option<&[Mode]>) -> Vec<Mode> {
    let unknown = |mode: &crate::plan::ModeInfo| {
        let step = Step::new(model, mode.step);
        let group = step.map_or("", |step| step.info().group);
        let joints = step.map_or_else(Vec::new, |step| step.joints().collect());
        Mode { name: mode.name, group, joints, sign: None, closure: f64::NAN }
    };
    known.map_or_else(|| model.plan.modes.iter().map(unknown).collect(), <[Mode]>::to_vec)
}

fn of_step(model: &'static Model, step: Step) -> Record {
    let info = step.info();
    let (kind, unknowns) = match info.kind {
        StepKind::Explicit => ("explicit", None),
        StepKind::Linear(n) => ("linear", Some(n)),
        StepKind::Closure => ("closure", None),
        StepKind::Newton(n) => ("newton", Some(n)),
        StepKind::RedundantRows => ("redundant_rows", None),
    };
    let given = |&(coordinate, joint): &(usize, usize)| {
        let joint = model.joints.get(joint).map_or("", |j| j.name);
        record! { name: model.coordinates.get(coordinate).map_or("", |c| c.name), joint: joint }
    };
    record! {
        kind: kind,
        unknowns: unknowns,
        group: (!info.group.is_empty()).then_some(info.group),
        joints: step.joints().collect::<Vec<_>>(),
        redundant_rows: redundant_rows(model, info),
        coordinates: info.coordinates.iter().map(given).collect::<Vec<_>>(),
        modes: mode_names(model, info),
        singular: info.singular,
    }
}

/// The names of the redundant rows that a step checks.
fn redundant_rows(model: &Model, step: &PlanStep) -> Vec<&'static str> {
    step.rows.iter().filter_map(|&row| model.rows.get(row)).map(|row| row.name).collect()
}

fn mode_names(model: &Model, step: &PlanStep) -> Vec<&'static str> {
    let (first, end) = step.modes;
    model.plan.modes.get(first..end).unwrap_or_default().iter().map(|mode| mode.name).collect()
}

/// The plan step by step: the method, which joint gives which coordinate, and when the step is singular.
pub(crate) fn plan(model: &'static Model) -> String {
    let mut out = "\nSolution plan\n".to_owned();
    if let Some(why) = model.plan.absent {
        out.push_str(&wrapped("  none: ", [why, "full Newton on all coordinates"], ",", COLUMNS));
        return out;
    }
    let digits = model.plan.steps.len().to_string().len();
    for step in steps(model) {
        let info = step.info();
        let (how, mut words) = (how(model, &step), given(model, info));
        match words.first_mut() {
            // After a list of joints a comma would seem to continue it.
            Some(first) if matches!(info.kind, StepKind::Newton(_)) => *first = format!("{how}: {first}"),
            _ => words.insert(0, how),
        }
        if !info.singular.is_empty() && info.singular != "never" {
            words.push(format!("singular with {}", info.singular));
        }
        out.push_str(&wrapped(&format!("  {:>digits$}  ", step.index() + 1), words, ",", COLUMNS));
    }
    out
}

/// The method of a step in words.
fn how(model: &Model, step: &Step) -> String {
    let info = step.info();
    match info.kind {
        StepKind::Explicit if info.group.is_empty() => "by formula".to_owned(),
        StepKind::Explicit => format!("{step} by formula"),
        StepKind::Linear(_) => format!("{step} in closed form"),
        StepKind::Closure => format!("{step} in closed form, mode {}", mode_names(model, info).join(", ")),
        StepKind::Newton(_) => step.to_string(),
        StepKind::RedundantRows => {
            let rows = redundant_rows(model, info);
            let (is, its) = if rows.len() == 1 { ("is", "its") } else { ("are", "their") };
            format!("{} {is} redundant and not used: {its} residual is checked", rows.join(" and "))
        }
    }
}

/// `C gives crank.x and crank.y`, joint by joint in the order of the coordinates.
fn given(model: &Model, step: &PlanStep) -> Vec<String> {
    let joint = |pair: &(usize, usize)| model.joints.get(pair.1).map_or("", |joint| joint.name);
    let name = |pair: &(usize, usize)| model.coordinates.get(pair.0).map_or("", |c| c.name);
    let groups = step.coordinates.chunk_by(|a, b| a.1 == b.1);
    let sentence = |group: &[(usize, usize)]| {
        let names: Vec<&str> = group.iter().map(name).collect();
        let (last, before) = names.split_last().map_or(("", &[][..]), |(last, before)| (*last, before));
        let names = if before.is_empty() { last.to_owned() } else { format!("{} and {last}", before.join(", ")) };
        match group.first().map(joint) {
            None | Some("") => format!("gives {names}"),
            Some(joint) => format!("{joint} gives {names}"),
        }
    };
    groups.map(sentence).collect()
}

/// A table of modes, with signs if they are known.
pub(crate) fn text(modes: &[Mode]) -> String {
    let closure = |mode: &Mode| if mode.closure.is_nan() { String::new() } else { format!("{:.6}", mode.closure) };
    let table = Table::new()
        .words("mode", modes.iter().map(|mode| mode.name))
        .words("group", modes.iter().map(|mode| mode.group))
        .words("joints", modes.iter().map(|mode| mode.joints.join(", ")))
        .words("sign", modes.iter().map(|mode| mode.sign.map_or_else(String::new, |sign| sign.to_string())))
        .right("closure", modes.iter().map(closure));
    section("Assembly modes (0 is the limit where both closures meet)", &table)
}

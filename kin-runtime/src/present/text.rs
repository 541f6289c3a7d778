//! The results of an analysis as text, section by section.
//!
//! Every section ends with a line break; a section without content is empty.

use super::number::{magnitude, plain, rounded};
use super::table::{Table, width, wrapped};
use super::units::ResultUnits;
use crate::measure::Dimension;
use crate::mobility::Mobility;
use crate::model::{Frame, JointInfo, Model};
use crate::motion::Motion;
use crate::ratios::VelocityRatios;
use crate::state::State;
use crate::transmission::TransmissionAngle;

/// Width of a text in columns.
const COLUMNS: usize = 96;

/// A heading with its table.
pub(crate) fn section(heading: &str, table: &Table) -> String {
    if table.is_empty() { String::new() } else { format!("\n{heading}\n{}", table.render()) }
}

/// Lines, each with a label, a value and words.
#[derive(Default)]
pub(crate) struct Facts(Vec<(String, String, Vec<String>)>);

impl Facts {
    pub(crate) fn add<S: Into<String>>(
        &mut self,
        label: &str,
        value: impl ToString,
        words: impl IntoIterator<Item = S>,
    ) -> &mut Self {
        self.0.push((label.to_owned(), value.to_string(), words.into_iter().map(Into::into).collect()));
        self
    }

    pub(crate) fn render(&self) -> String {
        let label = self.0.iter().map(|f| width(&f.0)).max().unwrap_or(0);
        let value = self.0.iter().map(|f| width(&f.1)).max().unwrap_or(0);
        let mut out = String::new();
        for (name, number, words) in &self.0 {
            let pad = " ".repeat(label.saturating_sub(width(name)));
            let gap = " ".repeat(value.saturating_sub(width(number)));
            let line = wrapped(&format!("  {name}{pad}  {gap}{number}  "), words, ",", COLUMNS);
            out.push_str(line.trim_end());
            out.push('\n');
        }
        out
    }
}

/// Name and description.
pub(crate) fn title(model: &Model) -> String {
    let doc = wrapped("  ", model.doc.split_whitespace(), "", COLUMNS);
    format!("{}\n{}", model.name, if doc.trim().is_empty() { "" } else { &doc })
}

/// `1 row`, `2 rows`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

/// Values of the parameters.
pub(crate) fn parameters(model: &Model, values: &[f64]) -> String {
    let table = Table::new()
        .words("parameter", model.parameters.iter().map(|p| p.name))
        .right("value", values.iter().map(|v| plain(*v)))
        .words("unit", model.parameters.iter().map(|p| p.unit.unwrap_or_default()))
        .words("", model.parameters.iter().map(|p| p.doc.split('\n').next().unwrap_or_default()));
    section("Parameters", &table)
}

/// Joints and drivers with their rows; rows of the same class are on one line.
pub(crate) fn rows(model: &Model) -> String {
    let mut lines: Vec<[String; 5]> = Vec::new();
    for (index, joint) in model.joints.iter().enumerate() {
        let rows_of_joint: Vec<_> = model.rows.iter().filter(|r| r.joint == index).collect();
        for group in rows_of_joint.chunk_by(|a, b| a.classes() == b.classes() && a.driving == b.driving) {
            let Some(first) = group.first() else { continue };
            let bodies: Vec<&str> = joint.frames.iter().flatten().map(|f| frame_name(model, *f)).collect();
            let third = third_body(model, joint).map(|name| format!(" ({name})")).unwrap_or_default();
            let mut class = first.classes().join(" ");
            if first.driving {
                class.push_str(", driving");
            }
            lines.push([
                joint.name.to_owned(),
                joint.kind.to_string(),
                bodies.join(" – ") + &third,
                group.iter().map(|r| short(r.name, joint.name)).collect::<Vec<_>>().join(", "),
                class,
            ]);
        }
    }
    let column = |k: usize| lines.iter().map(move |l| l.get(k).cloned().unwrap_or_default());
    let table = Table::new()
        .words("joint", column(0))
        .words("kind", column(1))
        .words("between", column(2))
        .words("rows", column(3))
        .words("class", column(4));
    section("Joints and drivers", &table)
}

/// The name of a row without its joint's: `x` for `A.x`.
fn short<'a>(row: &'a str, joint: &str) -> &'a str {
    row.strip_prefix(joint).and_then(|rest| rest.strip_prefix('.')).unwrap_or(row)
}

/// The name of a body, or `ground`.
pub(crate) fn frame_name(model: &Model, frame: Frame) -> &'static str {
    match frame {
        Frame::Ground => "ground",
        Frame::Body(index) => model.bodies.get(index).map_or("?", |b| b.name),
    }
}

/// The carrier of gears or of a belt, the pinion of a rack: a body that is no operand of its joint.
pub(crate) fn third_body(model: &Model, joint: &JointInfo) -> Option<&'static str> {
    let is_third = |frame: &Frame| matches!(frame, Frame::Body(_)) && !joint.frames.contains(&Some(*frame));
    joint.geometry.iter().map(|geometry| geometry.frame).find(is_third).map(|frame| frame_name(model, frame))
}

/// The names of coordinates.
pub(crate) fn coordinate_names(model: &Model, places: &[usize]) -> Vec<&'static str> {
    places.iter().filter_map(|&k| model.coordinates.get(k)).map(|c| c.name).collect()
}

/// q, q̇, q̈; the unit is that of q, as rates and accelerations are per unit of time.
pub(crate) fn coordinates(model: &Model, units: ResultUnits, state: &State) -> String {
    let table = Table::new()
        .words("coordinate", model.coordinates.iter().map(|c| c.name))
        .numbers("q", state.q.iter().copied())
        .numbers("q̇", state.q_dot.iter().copied())
        .numbers("q̈", state.q_ddot.iter().copied())
        .words("unit", model.coordinates.iter().map(|c| units.of_name(c.name)));
    section("Generalized coordinates", &table)
}

/// Poses of bodies with fewer than three coordinates of their own; the poses of the others are among the coordinates.
pub(crate) fn bodies(model: &Model, units: ResultUnits, motion: &Motion) -> String {
    let chosen: Vec<_> =
        model.bodies.iter().zip(&motion.bodies).filter(|(b, _)| b.coordinates.iter().any(Option::is_none)).collect();
    let column = |f: fn(&crate::motion::BodyMotion) -> f64| chosen.iter().map(move |(_, m)| f(m));
    let names = [Dimension::Length, Dimension::Angle].map(|dimension| units.of_dimension(dimension));
    let names = names.iter().filter(|unit| !unit.is_empty()).map(String::as_str).collect::<Vec<_>>().join(", ");
    let positions = Table::new()
        .words("body", chosen.iter().map(|(b, _)| b.name))
        .numbers("x", column(|m| m.x))
        .numbers("y", column(|m| m.y))
        .numbers("φ", column(|m| m.phi))
        .numbers("ẋ", column(|m| m.x_dot))
        .numbers("ẏ", column(|m| m.y_dot))
        .numbers("φ̇", column(|m| m.phi_dot))
        .words("unit", chosen.iter().map(|_| names.as_str()));
    let accelerations = Table::new()
        .words("body", chosen.iter().map(|(b, _)| b.name))
        .numbers("ẍ", column(|m| m.x_ddot))
        .numbers("ÿ", column(|m| m.y_ddot))
        .numbers("φ̈", column(|m| m.phi_ddot));
    let mut out = section("Bodies with held or carried coordinates", &positions);
    if !accelerations.is_empty() {
        out.push('\n');
        out.push_str(&accelerations.render());
    }
    out
}

/// Named points.
pub(crate) fn points(model: &Model, units: ResultUnits, motion: &Motion) -> String {
    let column = |f: fn(&crate::motion::PointMotion) -> f64| motion.points.iter().map(f);
    let table = Table::new()
        .words("point", model.points.iter().map(|p| p.name))
        .numbers("x", column(|m| m.r[0]))
        .numbers("y", column(|m| m.r[1]))
        .numbers("ẋ", column(|m| m.v[0]))
        .numbers("ẏ", column(|m| m.v[1]))
        .numbers("ẍ", column(|m| m.a[0]))
        .numbers("ÿ", column(|m| m.a[1]))
        .words("unit", motion.points.iter().map(|_| units.of_dimension(Dimension::Length)));
    section("Points", &table)
}

/// Named expressions.
pub(crate) fn defines(model: &Model, units: ResultUnits, motion: &Motion) -> String {
    let table = Table::new()
        .words("define", model.defines.iter().map(|d| d.name))
        .numbers("value", motion.defines.iter().map(|r| r.value))
        .numbers("rate", motion.defines.iter().map(|r| r.rate))
        .numbers("acceleration", motion.defines.iter().map(|r| r.acceleration))
        .words("unit", model.defines.iter().map(|d| units.of_name(d.name)));
    section("Defines", &table)
}

/// Quantities of joints.
pub(crate) fn joints(model: &Model, units: ResultUnits, motion: &Motion) -> String {
    let lines: Vec<_> = model
        .joints
        .iter()
        .zip(&motion.joints)
        .flat_map(|(joint, rates)| joint.quantities.iter().zip(rates).map(|(q, r)| (joint.name, q.name, *r)))
        .collect();
    let table = Table::new()
        .words("joint", lines.iter().map(|l| l.0))
        .words("quantity", lines.iter().map(|l| l.1))
        .numbers("value", lines.iter().map(|l| l.2.value))
        .numbers("rate", lines.iter().map(|l| l.2.rate))
        .numbers("acceleration", lines.iter().map(|l| l.2.acceleration))
        .words("unit", lines.iter().map(|l| units.of_name(&format!("{}.{}", l.0, l.1))));
    section("Joint quantities", &table)
}

/// The inputs with their values, rates and accelerations.
pub(crate) fn inputs(model: &Model, units: ResultUnits, state: &State) -> String {
    let table = Table::new()
        .words("input", model.inputs.iter().copied())
        .numbers("value", state.inputs.iter().map(|u| u.value))
        .numbers("rate", state.inputs.iter().map(|u| u.rate))
        .numbers("acceleration", state.inputs.iter().map(|u| u.acceleration))
        .words("unit", model.inputs.iter().map(|name| units.of_name(name)));
    section("Inputs", &table)
}

/// Velocity ratios: one table per driving row and per input.
pub(crate) fn ratios(model: &Model, ratios: &VelocityRatios) -> String {
    let mut out = String::new();
    for driver in &ratios.drivers {
        let table = Table::new()
            .words("coordinate", model.coordinates.iter().map(|c| c.name))
            .numbers("k = ∂q/∂f", driver.first.iter().copied())
            .numbers("l = ∂²q/∂f²", driver.second.iter().copied());
        out.push_str(&section(&format!("Velocity ratios of the driving row {}", driver.name), &table));
    }
    for input in &ratios.inputs {
        let table = Table::new()
            .words("coordinate", model.coordinates.iter().map(|c| c.name))
            .numbers("k = ∂q/∂u", input.first.iter().copied())
            .numbers("l = ∂²q/∂u²", input.second.iter().copied());
        out.push_str(&section(&format!("Velocity ratios of the input {}", input.name), &table));
    }
    out
}

/// Transmission angles.
pub(crate) fn transmission(angles: &[TransmissionAngle], degrees: bool) -> String {
    let in_degrees = |angle: &TransmissionAngle| if degrees { angle.angle } else { angle.angle.to_degrees() };
    let table = Table::new()
        .words("at", angles.iter().map(|a| a.joint))
        .words("between", angles.iter().map(|a| a.between.join(" and ")))
        .numbers("angle", angles.iter().map(|a| a.angle).filter(|_| !degrees))
        .right("degrees", angles.iter().map(|a| format!("{:.2}", in_degrees(a))));
    section("Transmission angles (best at 90 degrees)", &table)
}

/// The accuracy of the position: residual and condition number.
pub(crate) fn quality(state: &State, mobility: &Mobility) -> String {
    let mut facts = Facts::default();
    facts.add("largest |Φ|", magnitude(state.residual), [count(state.iterations, "iteration")]).add(
        "condition",
        rounded_condition(mobility.condition),
        ["of the scaled Φ_q; 1 is best"],
    );
    format!("\n{}", facts.render())
}

fn rounded_condition(condition: f64) -> String {
    if condition < 1e6 { rounded((condition * 100.0).round() / 100.0) } else { magnitude(condition) }
}

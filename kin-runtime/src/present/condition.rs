//! Unilateral conditions and their events, as text and as records.

use super::json::{Record, record};
use super::number::rounded;
use super::table::Table;
use super::text::section;
use crate::events::Event;
use crate::model::{ConditionInfo, Model};
use crate::motion::Motion;

/// The class of a condition in words.
pub(crate) fn classes(condition: &ConditionInfo) -> [&'static str; 3] {
    ["holonomic", if condition.rheonomic { "rheonomic" } else { "scleronomic" }, "unilateral"]
}

/// The declared conditions.
pub(crate) fn declared(model: &Model) -> String {
    let table = Table::new()
        .words("condition", model.conditions.iter().map(|c| c.name))
        .words("satisfied while", model.conditions.iter().map(|c| c.text))
        .words("class", model.conditions.iter().map(|c| classes(c).join(" ")));
    section("Unilateral conditions", &table)
}

/// The conditions at an instant: the margin g (the side that must be larger minus the other) with its derivatives.
pub(crate) fn values(model: &Model, motion: &Motion) -> String {
    let table = Table::new()
        .words("condition", model.conditions.iter().map(|c| c.name))
        .words("", motion.conditions.iter().map(|c| if c.satisfied { "satisfied" } else { "violated" }))
        .numbers("margin", motion.conditions.iter().map(|c| c.value))
        .numbers("rate", motion.conditions.iter().map(|c| c.rate))
        .numbers("acceleration", motion.conditions.iter().map(|c| c.acceleration));
    section("Unilateral conditions (satisfied while the margin is positive)", &table)
}

/// An event in one line.
pub(crate) fn line(model: &Model, event: &Event) -> String {
    let text = model.conditions.get(event.condition).map_or("", |c| c.text);
    format!("event: t = {}: {} {} ({text})", rounded(event.t), event.name, event.crossing)
}

/// The declared conditions, for JSON.
pub(crate) fn records(model: &Model) -> Vec<Record> {
    let record = |c: &ConditionInfo| record! { name: c.name, condition: c.text, classes: classes(c) };
    model.conditions.iter().map(record).collect()
}

/// An event, for JSON.
pub(crate) fn event(event: &Event) -> Record {
    let Event { name, t, crossing, within, state, .. } = event;
    record! {
        t: t, name: name, crossing: crossing, within: within, q: state.q, q_dot: state.q_dot, q_ddot: state.q_ddot,
    }
}

//! Sentences about forces: contacts that would have to pull or that lift off, ropes that would have to push, and why a force
//! is not determined.

use super::engine::Engine;
use super::setup::Setup;
use crate::forces::{ContactChange, Forces, Reaction};
use crate::measure::Measure;
use crate::present::number::rounded;
use crate::state::State;

/// `contact would have to pull at t = 0.1: normal force -3.2 N; a contact that only presses has lifted off`.
fn pulls(contact: &Reaction, forces: &Forces) -> String {
    let unit = unit(forces);
    let normal = contact.normal.map_or_else(String::new, rounded);
    let (name, t) = (contact.name, rounded(forces.t));
    format!(
        "`{name}` would have to pull at t = {t}: normal force {normal}{unit}; a contact that only presses has lifted off"
    )
}

/// Sentences about the contacts that would have to pull and the ropes that would have to push.
pub(super) fn unilateral_violations(forces: &Forces) -> Vec<String> {
    let contacts = forces.pulling().map(|contact| pulls(contact, forces));
    contacts.chain(forces.slack_ropes().map(|(name, tension)| pushes(name, tension, forces))).collect()
}

/// `stay would have to push at t = 0.1: tension -3.2 N; a rope is slack there`.
fn pushes(name: &str, tension: f64, forces: &Forces) -> String {
    let (t, tension) = (rounded(forces.t), rounded(tension));
    format!("`{name}` would have to push at t = {t}: tension {tension}{}; a rope is slack there", unit(forces))
}

/// The unit of forces, after a space.
fn unit(forces: &Forces) -> String {
    forces.model.forces.and_then(|info| info.units.force).map_or_else(String::new, |unit| format!(" {unit}"))
}

/// `event: contact lifts off at t = 0.3`, `event: stay goes slack at t = 0.3`.
pub(super) fn contact(change: &ContactChange) -> String {
    format!("event: {} {} at t = {}", change.name, change.event(), rounded(change.t))
}

/// A note on the first force among the quantities that is not determined at a state.
pub(super) fn missing_force(
    (engine, setup): (&dyn Engine, &Setup),
    state: &State,
    measures: &[Measure],
    values: &[f64],
) -> Option<String> {
    let mut all = measures.iter().zip(values);
    let (measure, _) = all.find(|(measure, value)| measure.is_force() && value.is_nan())?;
    let why = match engine.forces(setup, state) {
        Err(error) => error.to_string(),
        Ok(_) if measure.is_given_effort() => "only a coordinate that is given (--given) has an effort".to_owned(),
        Ok(_) => {
            "redundant rows share the load, and equilibrium alone does not determine how; --least-norm gives the forces \
             of least norm"
                .to_owned()
        }
    };
    Some(format!("note: `{}` has no value at t = {}: {why}", measure.name(), rounded(state.t)))
}

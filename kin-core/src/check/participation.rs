//! Rules on coordinates and rows: rows contain coordinates, and every coordinate that can vary is in a row.

use super::geometry::is_within_ground;
use super::mention::{MemberCoordinate, held, mentioned, mentioned_at};
use super::names::is_reserved;
use crate::error::{ModelError, quoted};
use crate::mechanism::{Body, Component, Mechanism};
use std::collections::BTreeSet;

/// Rule: every row contains a coordinate, because otherwise it constrains nothing.
pub(super) fn rows_contain_coordinates(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        // A joint of the ground with itself is reported by another rule.
        if is_within_ground(joint) {
            continue;
        }
        let i = joint.range.map_or(0, |range| range.start);
        if mentioned_at(mechanism, joint, i).is_empty() {
            let (keyword, name) = (joint.operands.keyword(), &joint.name);
            let held = held(mechanism, joint, [i]);
            let right = match held.len() {
                0 => "so that every motion satisfies it or none does; a row needs at least one coordinate that is not \
                      held"
                    .to_owned(),
                n => {
                    let names = quoted(held.iter().map(|held| held.name.as_str()), "and");
                    let (are, them) = if n == 1 { ("is", "it") } else { ("are", "them") };
                    format!("because {names} {are} held by `body` already; remove `{name}`, or do not hold {them}")
                }
            };
            let message = format!("{keyword} `{name}` contains no free coordinate, {right}");
            errors.push(ModelError::new(joint.keyword, message));
        }
    }
}

/// True if the body has a generalized coordinate.
fn has_free(body: &Body) -> bool {
    Component::ALL.into_iter().any(|component| body.is_free(component))
}

/// Rule: a mechanism has at least one coordinate.
pub(super) fn has_coordinates(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    if !mechanism.scalars.is_empty() || mechanism.bodies.iter().any(has_free) {
        return;
    }
    let name = &mechanism.name;
    let message = match mechanism.bodies.len() {
        0 => format!(
            "`{name}` has no coordinates; bodies are declared with `#[bodies(crank, …)]`, scalar coordinates with `#[coordinates(u, …)]`"
        ),
        1 => format!(
            "`{name}` has no coordinates: everything of its body is held; leave at least one of x, y and phi free"
        ),
        n => format!(
            "`{name}` has no coordinates: everything of its {n} bodies is held; leave at least one of x, y and phi free"
        ),
    };
    errors.push(ModelError::new(mechanism.origin, message));
}

/// Rule: some row contains a coordinate of every body that has coordinates.
pub(super) fn bodies_are_in_rows(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let touched: BTreeSet<(usize, usize)> = all_mentioned(mechanism)
        .into_iter()
        .filter_map(|coordinate| match coordinate {
            MemberCoordinate::Pose(family, member, _) => Some((family, member)),
            MemberCoordinate::Scalar(..) => None,
        })
        .collect();
    // Uses of a reserved word do not mean the body with its name, so that this body would seem to be unused.
    for (family, body) in mechanism.bodies.iter().enumerate().filter(|(_, body)| !is_reserved(&body.name)) {
        let members = if has_free(body) { body.len.unwrap_or(1) } else { 0 };
        let untouched = (0..members).filter(|&m| !touched.contains(&(family, m)));
        if let Some(names) = missing(&body.name, body.len, untouched.collect()) {
            let message = format!(
                "no joint or equation contains a coordinate of {names}; add a joint, fix its whole pose with \
                 `body`, or remove it"
            );
            errors.push(ModelError::new(body.origin, message));
        }
    }
}

/// Rule: some row contains every scalar coordinate.
pub(super) fn scalars_are_in_rows(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let mentioned = all_mentioned(mechanism);
    for (family, scalar) in mechanism.scalars.iter().enumerate().filter(|(_, scalar)| !is_reserved(&scalar.name)) {
        let unmentioned =
            (0..scalar.len.unwrap_or(1)).filter(|&m| !mentioned.contains(&MemberCoordinate::Scalar(family, m)));
        if let Some(names) = missing(&scalar.name, scalar.len, unmentioned.collect()) {
            let message = format!("no row mentions {names}; use it in a row, or leave it out");
            errors.push(ModelError::new(scalar.origin, message));
        }
    }
}

fn all_mentioned(mechanism: &Mechanism) -> BTreeSet<MemberCoordinate> {
    mechanism.joints.iter().flat_map(|joint| mentioned(mechanism, joint)).collect()
}

/// The missing members of a family as text for a message.
fn missing(name: &str, len: Option<usize>, members: Vec<usize>) -> Option<String> {
    const SHOWN: usize = 4;
    match (members.len(), len) {
        (0, _) => None,
        (_, None) => Some(format!("`{name}`")),
        (n, Some(len)) if n == len => Some(format!("any of the {n} members of `{name}`")),
        (n, Some(_)) => {
            let shown: Vec<String> = members.iter().take(SHOWN).map(|m| format!("`{name}[{m}]`")).collect();
            let rest = if n > SHOWN { format!(", … ({n} in all)") } else { String::new() };
            Some(format!("{}{rest}", shown.join(", ")))
        }
    }
}

//! The rule for guesses.

use super::mention::MemberCoordinate;
use crate::error::ModelError;
use crate::mechanism::{BodyRef, GuessTarget, Mechanism, Range, Source};
use std::collections::BTreeSet;

/// Rule: a guess is for a free coordinate, and there is at most one for each.
pub(super) fn guesses_are_for_coordinates(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let mut given = BTreeSet::new();
    for guess in &mechanism.guesses {
        let range = guess.range.unwrap_or(Range { start: 0, end: 1 });
        let wrong = range.indices().find_map(|i| wrong(mechanism, &guess.target, i, &mut given));
        if let Some(message) = wrong {
            errors.push(ModelError::new(guess.origin, message));
        }
    }
}

fn wrong(
    mechanism: &Mechanism,
    target: &GuessTarget,
    i: i64,
    given: &mut BTreeSet<MemberCoordinate>,
) -> Option<String> {
    match *target {
        GuessTarget::Pose(BodyRef::Ground(_), _) => {
            Some("the ground does not move; a guess is for a coordinate of a body".to_owned())
        }
        GuessTarget::Pose(BodyRef::Body { family, index, .. }, component) => {
            let (body, member) = (mechanism.bodies.get(family)?, index.at(i)?);
            let name = match body.len {
                Some(_) => format!("{}[{member}].{component}", body.name),
                None => format!("{}.{component}", body.name),
            };
            let coordinate = MemberCoordinate::Pose(family, member, component);
            match body.source(component) {
                Source::Free => twice(given, coordinate, &name),
                Source::Held(_) => {
                    Some(format!("`{name}` is held at a value; a guess is for a coordinate that is not"))
                }
                Source::Carried(_) => Some(format!(
                    "`{name}` follows from the body that carries `{}`; guess that body and the angle",
                    body.name
                )),
            }
        }
        GuessTarget::Scalar(member) => {
            let (scalar, index) = (mechanism.scalars.get(member.family)?, member.index.at(i)?);
            let name = match scalar.len {
                Some(_) => format!("{}[{index}]", scalar.name),
                None => scalar.name.clone(),
            };
            twice(given, MemberCoordinate::Scalar(member.family, index), &name)
        }
    }
}

fn twice(given: &mut BTreeSet<MemberCoordinate>, coordinate: MemberCoordinate, name: &str) -> Option<String> {
    (!given.insert(coordinate)).then(|| format!("`{name}` is guessed twice; one guess for each coordinate"))
}

//! What is wrong with a mechanism before any equation is written: one function per rule.
//!
//! Part by part ([`check_parts`]):
//! - `names_differ`: bodies, coordinates, parameters, points, defines, functions and inputs share one namespace;
//! - `names_are_free`: none of them is a word of the language;
//! - `row_names_differ`: rows have a namespace of their own;
//! - `families_have_members`: lengths and ranges are not empty and not absurd;
//! - `indices_exist`: every index is within its family at every step of the range;
//! - `origins_end_somewhere`: no body is carried by itself, directly or around a circle;
//! - `defines_end_somewhere`: no define uses itself;
//! - `joints_join_two_bodies`: a joint has two different bodies;
//! - the rules of each kind of joint: the carrier of two gears is a third body, discs on one another have two centres;
//! - `axes_have_a_direction`: an axis is not (0, 0);
//! - `lengths_are_positive`: a literal length is greater than 0;
//! - `radii_have_a_size`: a radius is not a literal 0;
//! - `divisors_are_not_zero`: nothing is divided by a literal 0;
//! - `curves_are_curves`: a literal polar radius is positive, and a curve holds its variables;
//! - `rollers_know_their_curve`: a roller runs on no curve that has only two derivatives;
//! - `velocity_rows_are_linear`: a row of velocity level is linear in `dot(…)`, and holds one of something that
//!   changes;
//! - `guesses_are_for_coordinates`: a guess is for a free coordinate, one for each;
//! - `rows_hold_coordinates`: a row that mentions no coordinate constrains nothing;
//! - `conditions_change`: a condition of parameters alone is always or never satisfied;
//! - `loads_act_on_bodies`: a mass or a force belongs to a body, a spring joins two;
//! - `centres_differ`: no two masses have one centre;
//! - `loads_have_a_size`: masses are not negative, and a spring has a stiffness or a damping;
//! - `one_field_of_gravity`: gravity is written once.
//!
//! As a whole ([`check`]), the last two where no row is wrong in what it joins or holds:
//! - `has_coordinates`: something can move;
//! - `bodies_are_touched`: some row mentions a coordinate of every body;
//! - `scalars_are_mentioned`: some row mentions every scalar coordinate;
//! - `gravity_pulls_masses`: where there is gravity, there is a mass.

mod condition;
mod curve;
pub mod cycle;
mod geometry;
mod guess;
mod loads;
mod mention;
mod names;
mod participation;
mod scope;
mod velocity;

use crate::error::ModelError;
use crate::joints;
use crate::mechanism::{Body, BodyOrigin, BodyRef, Mechanism, defines_in};
use scope::scopes;
use std::collections::BTreeSet;

pub(crate) use mention::meets_held;
pub use names::{RESERVED, is_reserved};

use condition::conditions_change;
use curve::{curves_are_curves, rollers_know_their_curve};
use geometry::{
    axes_have_a_direction, divisors_are_not_zero, joints_join_two_bodies, lengths_are_positive, radii_have_a_size,
};
use guess::guesses_are_for_coordinates;
use loads::{centres_differ, gravity_pulls_masses, loads_act_on_bodies, loads_have_a_size, one_field_of_gravity};
use names::{names_are_free, names_differ, row_names_differ};
use participation::{bodies_are_touched, has_coordinates, rows_hold_coordinates, scalars_are_mentioned};
use velocity::velocity_rows_are_linear;

/// The most members that a family can have: each becomes coordinates and equations of its own.
pub const MAX_MEMBERS: usize = 10_000;

/// Everything that is wrong with `mechanism`, in the order of its origins.
pub fn check(mechanism: &Mechanism) -> Vec<ModelError> {
    let mut errors = check_parts(mechanism);
    // Of two things with one name only one is used, which is the other's fault.
    if is_sound(mechanism) && names::are_distinct(mechanism) {
        let before = errors.len();
        has_coordinates(mechanism, &mut errors);
        let mut of_rows = Vec::new();
        check_rows(mechanism, &mut of_rows);
        // A row that is wrong may be the one that was to hold what no row holds now.
        if errors.len() == before && of_rows.is_empty() {
            bodies_are_touched(mechanism, &mut errors);
            scalars_are_mentioned(mechanism, &mut errors);
        }
        gravity_pulls_masses(mechanism, &mut errors);
    }
    sorted(errors)
}

/// What is wrong with the parts of `mechanism`, each for itself: also right when other parts are missing.
pub fn check_parts(mechanism: &Mechanism) -> Vec<ModelError> {
    let mut errors = Vec::new();
    names_differ(mechanism, &mut errors);
    names_are_free(mechanism, &mut errors);
    row_names_differ(mechanism, &mut errors);
    families_have_members(mechanism, &mut errors);
    indices_exist(mechanism, &mut errors);
    origins_end_somewhere(mechanism, &mut errors);
    defines_end_somewhere(mechanism, &mut errors);
    axes_have_a_direction(mechanism, &mut errors);
    lengths_are_positive(mechanism, &mut errors);
    radii_have_a_size(mechanism, &mut errors);
    divisors_are_not_zero(mechanism, &mut errors);
    curves_are_curves(mechanism, &mut errors);
    rollers_know_their_curve(mechanism, &mut errors);
    loads_have_a_size(mechanism, &mut errors);
    one_field_of_gravity(mechanism, &mut errors);
    if is_sound(mechanism) {
        check_rows(mechanism, &mut errors);
        guesses_are_for_coordinates(mechanism, &mut errors);
        conditions_change(mechanism, &mut errors);
        loads_act_on_bodies(mechanism, &mut errors);
        centres_differ(mechanism, &mut errors);
    }
    sorted(errors)
}

/// What is wrong with the rows of a sound mechanism: with what they join and hold.
fn check_rows(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    joints_join_two_bodies(mechanism, errors);
    mechanism.joints.iter().for_each(|joint| joints::check(joint, mechanism, errors));
    rows_hold_coordinates(mechanism, errors);
    velocity_rows_are_linear(mechanism, errors);
}

/// True when families can be unrolled and names followed to their ends.
fn is_sound(mechanism: &Mechanism) -> bool {
    let mut errors = Vec::new();
    families_have_members(mechanism, &mut errors);
    if errors.is_empty() {
        indices_exist(mechanism, &mut errors);
        origins_end_somewhere(mechanism, &mut errors);
        defines_end_somewhere(mechanism, &mut errors);
    }
    errors.is_empty()
}

/// A point that is used twice would have its mistakes told twice.
fn sorted(mut errors: Vec<ModelError>) -> Vec<ModelError> {
    errors.sort_by_key(|error| error.origin);
    errors.dedup();
    errors
}

/// The families of defines, each after those that it uses as far as there is no circle.
pub(crate) fn order_of_defines(mechanism: &Mechanism) -> cycle::Order {
    let uses = |formula| defines_in(formula).map(|member| member.family).collect();
    let edges: Vec<Vec<usize>> = mechanism.defines.iter().map(|define| uses(&define.formula)).collect();
    cycle::order(&edges)
}

/// A family has at least one member and at most [`MAX_MEMBERS`].
fn families_have_members(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let bodies = mechanism.bodies.iter().map(|b| (&b.name, b.len, b.origin));
    let scalars = mechanism.scalars.iter().map(|s| (&s.name, s.len, s.origin));
    let inputs = mechanism.inputs.iter().map(|i| (&i.name, i.len, i.origin));
    for (name, len, origin) in bodies.chain(scalars).chain(inputs) {
        match len {
            Some(0) => {
                errors.push(ModelError::new(origin, format!("`{name}` has no member; a family has at least one")))
            }
            Some(n) if n > MAX_MEMBERS => {
                errors.push(ModelError::new(
                    origin,
                    format!("`{name}` has {n} members; at most {MAX_MEMBERS} are possible"),
                ));
            }
            _ => {}
        }
    }
    let points = mechanism.points.iter().map(|p| (&p.name, p.range, p.origin));
    let defines = mechanism.defines.iter().map(|d| (&d.name, d.range, d.origin));
    let joints = mechanism.joints.iter().chain(&mechanism.loads).map(|j| (&j.name, j.range, j.origin));
    let conditions = mechanism.conditions.iter().map(|c| (&c.name, c.range, c.origin));
    for (name, range, origin) in points.chain(defines).chain(joints).chain(conditions) {
        let Some(range) = range else { continue };
        let (start, end) = (range.start, range.end);
        if start >= end {
            let message = format!("the range {start}..{end} of `{name}` is empty; it ends before its second bound");
            errors.push(ModelError::new(origin, message));
        } else if start < 0 || end > MAX_MEMBERS as i64 {
            let message = format!("the range {start}..{end} of `{name}` leaves 0..{MAX_MEMBERS}");
            errors.push(ModelError::new(origin, message));
        }
    }
}

/// Every index is within its family at both ends of the range; between them it is, since it is linear.
fn indices_exist(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    // A point stands in the model wherever it is used; its mistakes are told once, at its declaration.
    let mut told = BTreeSet::new();
    for scope in scopes(mechanism) {
        for used in scope.uses(mechanism) {
            let Some((i, value)) = used.outside(scope.range) else { continue };
            if !told.insert(used.origin) {
                continue;
            }
            let (name, first, last) = (used.name, used.members.start, used.members.end - 1);
            let at = scope.range.map_or(String::new(), |_| format!(" (where the index variable is {i})"));
            let message = if used.members.is_empty() {
                format!("`{name}` has no elements, so that `{name}[{value}]` does not exist")
            } else {
                format!("`{name}[{value}]` does not exist{at}; there are `{name}[{first}]` to `{name}[{last}]`")
            };
            errors.push(ModelError::new(used.origin, message));
        }
    }
}

/// The origins of carried bodies lead to a body that is not carried, or to the ground.
fn origins_end_somewhere(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let carriers: Vec<Vec<usize>> = mechanism.bodies.iter().map(carriers).collect();
    for circle in cycle::order(&carriers).cycles {
        let names: Vec<&str> = circle.iter().map(|&k| mechanism.bodies[k].name.as_str()).collect();
        let origin = circle.first().map_or(mechanism.origin, |&k| match &mechanism.bodies[k].origin_at {
            BodyOrigin::Carried(place) => place.origin,
            BodyOrigin::Free { .. } => mechanism.bodies[k].origin,
        });
        let right = "a chain of origins ends at a body that is not carried, or at the ground";
        errors.push(ModelError::new(origin, format!("{}; {right}", chain(&names, "is carried by", "carries itself"))));
    }
}

fn carriers(body: &Body) -> Vec<usize> {
    match &body.origin_at {
        BodyOrigin::Carried(place) => match place.body {
            BodyRef::Body { family, .. } => vec![family],
            BodyRef::Ground(_) => Vec::new(),
        },
        BodyOrigin::Free { .. } => Vec::new(),
    }
}

/// Defines lead to formulas without defines.
fn defines_end_somewhere(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for circle in order_of_defines(mechanism).cycles {
        let names: Vec<&str> = circle.iter().map(|&k| mechanism.defines[k].name.as_str()).collect();
        let origin = circle.first().map_or(mechanism.origin, |&k| mechanism.defines[k].origin);
        let message = format!("{}; a define is made of what does not need it", chain(&names, "uses", "uses itself"));
        errors.push(ModelError::new(origin, message));
    }
}

/// `` `a` uses `b`, `b` uses `a` ``, or `` `a` uses itself ``.
pub fn chain(names: &[&str], verb: &str, alone: &str) -> String {
    if let [name] = names {
        return format!("`{name}` {alone}");
    }
    let next = names.iter().cycle().skip(1);
    names.iter().zip(next).map(|(a, b)| format!("`{a}` {verb} `{b}`")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;

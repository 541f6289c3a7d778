//! The rules that a mechanism must satisfy before any equation is written, one function per rule.
//!
//! Rules for single parts ([`check_parts`]):
//! - `names_differ`: bodies, coordinates, parameters, points, defines, functions and inputs share one namespace;
//! - `names_are_not_reserved`: none of these names is a reserved word;
//! - `row_names_differ`: rows have a namespace of their own;
//! - `families_have_members`: lengths and ranges are neither empty nor too large;
//! - `indices_exist`: every index is valid for its family over the whole range;
//! - `carriers_are_acyclic`: no body is carried by itself, directly or through other bodies;
//! - `defines_are_acyclic`: no define uses itself;
//! - `joints_join_two_bodies`: a joint connects two different bodies;
//! - the rules of each kind of joint: the carrier of two gears is a third body, two rolling discs have different
//!   centres;
//! - `axes_have_a_direction`: an axis is not (0, 0);
//! - `lengths_are_positive`: a literal length is greater than 0;
//! - `radii_are_not_zero`: a radius is not a literal 0;
//! - `divisors_are_not_zero`: no divisor is a literal 0;
//! - `curves_depend_on_their_variables`: a literal polar radius is positive, an implicit curve contains X or Y, and a
//!   parametric curve its parameter;
//! - `roller_curves_have_derivatives`: the curve of a roller has a third derivative;
//! - `velocity_rows_are_linear`: a row of velocity level is linear in `dot(…)` and contains the rate of something that
//!   varies;
//! - `guesses_are_for_coordinates`: a guess is for a free coordinate, at most one for each;
//! - `rows_contain_coordinates`: every row contains a coordinate, because otherwise it constrains nothing;
//! - `conditions_vary`: a condition does not depend on parameters alone;
//! - `loads_act_on_bodies`: a mass or a force belongs to a body, a spring connects two;
//! - `centres_differ`: no two masses have the same centre;
//! - `loads_have_valid_sizes`: masses are not negative, and a spring has a stiffness or a damping;
//! - `one_field_of_gravity`: gravity is declared at most once.
//!
//! Rules for the mechanism as a whole ([`check`]); the second and third are checked only if the first is satisfied and
//! all rows are correct:
//! - `has_coordinates`: there is at least one coordinate;
//! - `bodies_are_in_rows`: the rows contain a coordinate of every body;
//! - `scalars_are_in_rows`: the rows contain every scalar coordinate;
//! - `gravity_has_masses`: if there is gravity, there is a mass.

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

pub(crate) use mention::{HeldCoordinate, held};
pub use names::{RESERVED, is_reserved, meaning_of_reserved};

use condition::conditions_vary;
use curve::{curves_depend_on_their_variables, roller_curves_have_derivatives};
use geometry::{
    axes_have_a_direction, divisors_are_not_zero, joints_join_two_bodies, lengths_are_positive, radii_are_not_zero,
};
use guess::guesses_are_for_coordinates;
use loads::{centres_differ, gravity_has_masses, loads_act_on_bodies, loads_have_valid_sizes, one_field_of_gravity};
use names::{names_are_not_reserved, names_differ, row_names_differ};
use participation::{bodies_are_in_rows, has_coordinates, rows_contain_coordinates, scalars_are_in_rows};
use velocity::velocity_rows_are_linear;

/// The maximum number of members of a family; each member has coordinates and equations of its own.
pub const MAX_MEMBERS: usize = 10_000;

/// All errors of `mechanism`, ordered by origin.
pub fn check(mechanism: &Mechanism) -> Vec<ModelError> {
    let mut errors = check_parts(mechanism);
    if is_resolved(mechanism) {
        let before = errors.len();
        has_coordinates(mechanism, &mut errors);
        let mut of_rows = Vec::new();
        check_rows(mechanism, &mut of_rows);
        // A coordinate may be missing in all rows only because one of them is incorrect.
        if errors.len() == before && of_rows.is_empty() {
            bodies_are_in_rows(mechanism, &mut errors);
            scalars_are_in_rows(mechanism, &mut errors);
        }
        gravity_has_masses(mechanism, &mut errors);
    }
    sorted(errors)
}

/// The errors in the parts of `mechanism`, considered one by one; valid even if other parts are missing.
pub fn check_parts(mechanism: &Mechanism) -> Vec<ModelError> {
    let mut errors = Vec::new();
    names_differ(mechanism, &mut errors);
    names_are_not_reserved(mechanism, &mut errors);
    row_names_differ(mechanism, &mut errors);
    families_have_members(mechanism, &mut errors);
    indices_exist(mechanism, &mut errors);
    carriers_are_acyclic(mechanism, &mut errors);
    defines_are_acyclic(mechanism, &mut errors);
    axes_have_a_direction(mechanism, &mut errors);
    lengths_are_positive(mechanism, &mut errors);
    radii_are_not_zero(mechanism, &mut errors);
    divisors_are_not_zero(mechanism, &mut errors);
    curves_depend_on_their_variables(mechanism, &mut errors);
    roller_curves_have_derivatives(mechanism, &mut errors);
    loads_have_valid_sizes(mechanism, &mut errors);
    one_field_of_gravity(mechanism, &mut errors);
    if references_resolve(mechanism) {
        check_rows(mechanism, &mut errors);
        guesses_are_for_coordinates(mechanism, &mut errors);
        conditions_vary(mechanism, &mut errors);
        loads_act_on_bodies(mechanism, &mut errors);
        centres_differ(mechanism, &mut errors);
    }
    sorted(errors)
}

/// Checks the rows of a mechanism whose names and indices are valid: what they connect and contain.
fn check_rows(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    joints_join_two_bodies(mechanism, errors);
    mechanism.joints.iter().for_each(|joint| joints::check(joint, mechanism, errors));
    rows_contain_coordinates(mechanism, errors);
    velocity_rows_are_linear(mechanism, errors);
}

/// True if references lead to what they name. If two objects share a name, references find only one of them, and the other
/// would seem to be unused.
pub fn is_resolved(mechanism: &Mechanism) -> bool {
    references_resolve(mechanism) && names::are_distinct(mechanism)
}

/// True if families can be expanded and references followed without cycles.
fn references_resolve(mechanism: &Mechanism) -> bool {
    let mut errors = Vec::new();
    families_have_members(mechanism, &mut errors);
    if errors.is_empty() {
        indices_exist(mechanism, &mut errors);
        carriers_are_acyclic(mechanism, &mut errors);
        defines_are_acyclic(mechanism, &mut errors);
    }
    errors.is_empty()
}

/// Sorts the errors and removes duplicates, which arise if a point with an error is used several times.
fn sorted(mut errors: Vec<ModelError>) -> Vec<ModelError> {
    errors.sort_by_key(|error| error.origin);
    errors.dedup();
    errors
}

/// The families of defines, each after those that it uses unless they form a cycle.
pub(crate) fn order_of_defines(mechanism: &Mechanism) -> cycle::Order {
    let uses = |formula| defines_in(formula).map(|member| member.family).collect();
    let edges: Vec<Vec<usize>> = mechanism.defines.iter().map(|define| uses(&define.formula)).collect();
    cycle::order(&edges)
}

/// Rule: a family has at least one member and at most [`MAX_MEMBERS`].
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
            let message = format!("the range {start}..{end} of `{name}` is empty; its second bound is not included");
            errors.push(ModelError::new(origin, message));
        } else if start < 0 || end > MAX_MEMBERS as i64 {
            let message = format!("the range {start}..{end} of `{name}` leaves 0..{MAX_MEMBERS}");
            errors.push(ModelError::new(origin, message));
        }
    }
}

/// Rule: every index exists at both ends of the range; since indices are linear, they exist in between, too.
fn indices_exist(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    // A named point is copied wherever it is used; its errors are reported once, at its declaration.
    let mut reported = BTreeSet::new();
    for scope in scopes(mechanism) {
        for used in scope.uses(mechanism) {
            let Some((i, value)) = used.outside(scope.range) else { continue };
            if !reported.insert(used.origin) {
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

/// Rule: a chain of carried bodies ends at a body that is not carried, or at the ground.
fn carriers_are_acyclic(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
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

/// Rule: no define uses itself, directly or through other defines.
fn defines_are_acyclic(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for circle in order_of_defines(mechanism).cycles {
        let names: Vec<&str> = circle.iter().map(|&k| mechanism.defines[k].name.as_str()).collect();
        let origin = circle.first().map_or(mechanism.origin, |&k| mechanism.defines[k].origin);
        let message = format!("{}; a define must not depend on itself", chain(&names, "uses", "uses itself"));
        errors.push(ModelError::new(origin, message));
    }
}

/// The text `` `a` uses `b`, `b` uses `a` ``, or `` `a` uses itself ``.
pub fn chain(names: &[&str], verb: &str, alone: &str) -> String {
    if let [name] = names {
        return format!("`{name}` {alone}");
    }
    let next = names.iter().cycle().skip(1);
    names.iter().zip(next).map(|(a, b)| format!("`{a}` {verb} `{b}`")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;

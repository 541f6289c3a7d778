//! Errors for redundant rows: which joints repeat the same constraint, and how to correct it.

use super::diagnosis::{Redundancy, Structure};
use crate::check::{HeldCoordinate, held};
use crate::constraint::{ConstraintSet, RowMeaning};
use crate::error::{ModelError, quoted};
use crate::mechanism::Mechanism;
use crate::system::KinematicSystem;
use crate::vocabulary::JointKind;
use std::collections::{BTreeMap, BTreeSet};

/// An error for every declaration with redundant rows, in order of declaration.
pub fn explain(mechanism: &Mechanism, system: &KinematicSystem, structure: &Structure) -> Vec<ModelError> {
    let mut found: BTreeMap<usize, Vec<&Redundancy>> = BTreeMap::new();
    for redundancy in &structure.redundant {
        let family = system.set.joints[system.set.rows[redundancy.row].joint].family.0;
        found.entry(family).or_default().push(redundancy);
    }
    found
        .into_iter()
        .filter_map(|(family, rows)| {
            let joint = mechanism.joints.get(family)?;
            let held = held_in(mechanism, system, &rows);
            Some(ModelError::new(joint.origin, message(system, structure, &rows, &held)))
        })
        .collect()
}

/// The held coordinates that the redundant rows and their circuits involve.
fn held_in(mechanism: &Mechanism, system: &KinematicSystem, redundant: &[&Redundancy]) -> BTreeSet<HeldCoordinate> {
    let set = &system.set;
    let rows = redundant.iter().flat_map(|r| r.circuit.iter().chain([&r.row]));
    let joints: BTreeSet<usize> = rows.map(|row| set.rows[*row].joint).collect();
    let families = joints.into_iter().map(|joint| set.joints[joint].family);
    families
        .filter_map(|(family, index)| Some(held(mechanism, mechanism.joints.get(family)?, [index])))
        .flatten()
        .collect()
}

/// The message for one declaration; `held` are the held coordinates that its rows and their circuits involve.
fn message(
    system: &KinematicSystem,
    structure: &Structure,
    redundant: &[&Redundancy],
    held: &BTreeSet<HeldCoordinate>,
) -> String {
    let set = &system.set;
    let joint_of = |row: usize| set.rows[row].joint;
    let joints = distinct(redundant.iter().map(|r| joint_of(r.row)));
    let circuit = redundant.iter().flat_map(|r| &r.circuit).map(|row| joint_of(*row));
    let mut other_joints: Vec<usize> = distinct(circuit.filter(|joint| !joints.contains(joint)));
    other_joints.sort_unstable();
    let names = quoted(joints.iter().map(|joint| set.joints[*joint].name.as_str()), "and");
    let other_names = quoted(other_joints.iter().map(|joint| set.joints[*joint].name.as_str()), "and");
    let driving = redundant.iter().all(|r| system.classes[r.row].driving);
    let (n, s, rank) = (structure.coordinates, structure.rows, structure.rank);
    let advice = advice(set, &joints, redundant, driving);
    let plural = joints.len() > 1;
    if redundant.iter().all(|r| r.circuit.is_empty()) {
        return redundant_by_itself(set, &joints, redundant, &advice, held);
    }
    let held = match held.len() {
        0 => String::new(),
        1 => format!("; the held coordinate {} counts as prescribed", names_of(held)),
        _ => format!("; the held coordinates {} count as prescribed", names_of(held)),
    };
    if driving {
        let (freedom, drivers) = (structure.degrees_of_freedom(), drivers(system));
        let freedom = match freedom {
            0 => "no degree of freedom".to_owned(),
            1 => "1 degree of freedom".to_owned(),
            _ => format!("{freedom} degrees of freedom"),
        };
        let verb = if plural { "prescribe" } else { "prescribes" };
        let already = if other_joints.is_empty() {
            "what the other members of its family already do".to_owned()
        } else {
            format!("what {other_names} already {}", if other_joints.len() > 1 { "determine" } else { "determines" })
        };
        let rows = if drivers == 1 { "1 driving row".to_owned() } else { format!("{drivers} driving rows") };
        // If joints are redundant for special lengths, the mechanism has more degrees of freedom than the generic rank
        // shows.
        let has_lengths = |joint: &usize| {
            let joint = &set.joints[*joint];
            let is_angle = set.meanings(joint).iter().all(|meaning| *meaning == RowMeaning::Angle);
            !is_angle && !system.classes[joint.first_row].driving
        };
        let by_lengths = other_joints.iter().any(has_lengths);
        let unless = if by_lengths { ", if special lengths give the mechanism more degrees of freedom," } else { "" };
        return format!(
            "the mechanism has {freedom} and {rows}: {names} {verb} {already}; {advice}, or{unless} write \
             `#[mechanism(allow_redundant)]`{held}"
        );
    }
    let rows = rows(set, &joints, redundant);
    let several_rows = rows.starts_with("rows");
    let verb = if plural || several_rows { "repeat or contradict" } else { "repeats or contradicts" };
    let already = match other_joints.len() {
        0 => "itself".to_owned(),
        1 => format!("what joint {other_names} already prescribes"),
        _ => format!("what joints {other_names} already prescribe"),
    };
    format!(
        "{rows}{names} {verb} {already}, for all dimensions: {n} coordinates, {s} rows, rank {rank}; {advice}, or \
         write `#[mechanism(allow_redundant)]`{held}"
    )
}

fn names_of(held: &BTreeSet<HeldCoordinate>) -> String {
    quoted(held.iter().map(|held| held.name.as_str()), "and")
}

/// The message for rows that are redundant by themselves: their residuals depend on no coordinate.
fn redundant_by_itself(
    set: &ConstraintSet,
    joints: &[usize],
    redundant: &[&Redundancy],
    advice: &str,
    held: &BTreeSet<HeldCoordinate>,
) -> String {
    let (rows, names) =
        (rows(set, joints, redundant), quoted(joints.iter().map(|joint| set.joints[*joint].name.as_str()), "and"));
    let plural = joints.len() > 1;
    let residual = |row: usize| set.rows[row].velocity.map_or(set.rows[row].phi, |velocity| velocity.eta);
    let is_equation = |joint: &usize| set.joints[*joint].kind.is_free_equation();
    let same_sides = redundant.iter().all(|r| set.graph.is_zero(residual(r.row)));
    if same_sides && joints.iter().all(is_equation) {
        let (constrains, each, pronoun) =
            if plural { ("constrain", "of each", "them") } else { ("constrains", "of it", "it") };
        return format!(
            "{names} {constrains} nothing: both sides {each} are the same; write the intended value on the right \
             side, or remove {pronoun}"
        );
    }
    let (constrains, residual) = if plural {
        ("constrain", "their residuals do not depend")
    } else {
        ("constrains", "its residual does not depend")
    };
    let text = format!(
        "{rows}{names} {constrains} nothing: {residual} on any coordinate; {advice}, or write \
         `#[mechanism(allow_redundant)]`"
    );
    let (names, freed) = match held.len() {
        0 => return text,
        1 => (format!("coordinate {}", names_of(held)), "that coordinate"),
        _ => (format!("coordinates {}", names_of(held)), "one of them"),
    };
    let it_is = if plural { "they are" } else { "it is" };
    format!("{text}; because of the held {names} {it_is} either always or never satisfied: leave {freed} free instead")
}

/// `row `N.angle` of `, or nothing if all rows of the joint are redundant.
fn rows(set: &ConstraintSet, joints: &[usize], redundant: &[&Redundancy]) -> String {
    let [joint] = joints else { return String::new() };
    let joint = &set.joints[*joint];
    if redundant.len() == joint.rows {
        return String::new();
    }
    let names: Vec<String> = redundant.iter().map(|r| format!("`{}`", set.rows[r.row].name)).collect();
    format!("{} {} of ", if names.len() == 1 { "row" } else { "rows" }, names.join(" and "))
}

/// The correction to suggest, which depends on the kinds of the joints and on which of their rows are redundant.
fn advice(set: &ConstraintSet, redundant_joints: &[usize], redundant: &[&Redundancy], driving: bool) -> String {
    let pronoun = if redundant_joints.len() > 1 { "them" } else { "it" };
    if driving {
        return format!("remove {pronoun}");
    }
    // Members of a family may differ in which of their rows are redundant.
    let mut kinds: Vec<(Option<String>, Vec<usize>)> = Vec::new();
    for &joint in redundant_joints {
        let instead = instead_of(set, joint, redundant);
        match kinds.iter_mut().find(|(known, _)| *known == instead) {
            Some((_, joints)) => joints.push(joint),
            None => kinds.push((instead, vec![joint])),
        }
    }
    if let [(None, _)] = kinds[..] {
        return format!("remove {pronoun}");
    }
    // The shorter part of the advice, a removal, comes first.
    kinds.sort_by_key(|(instead, _)| instead.is_some());
    let parts = kinds.iter().map(|(instead, joints)| {
        let names = quoted(joints.iter().map(|joint| set.joints[*joint].name.as_str()), "and");
        match instead {
            Some(instead) => format!("replace {names} by {instead}"),
            None => format!("remove {names}"),
        }
    });
    parts.collect::<Vec<_>>().join(", and ")
}

/// What has only the rows of this joint that are not redundant; `None` if there are none.
fn instead_of(set: &ConstraintSet, index: usize, redundant: &[&Redundancy]) -> Option<String> {
    let joint = &set.joints[index];
    let is_redundant = |row: &usize| redundant.iter().any(|r| r.row == *row);
    let (redundant_rows, rest): (Vec<usize>, Vec<usize>) =
        (joint.first_row..joint.first_row + joint.rows).partition(is_redundant);
    let meanings = |rows: &[usize]| rows.iter().map(|row| set.rows[*row].meaning).collect::<Vec<_>>();
    use RowMeaning::{AcrossAxis, Angle, Coincidence};
    let instead = match (&meanings(&redundant_rows)[..], &meanings(&rest)[..]) {
        (_, []) => return None,
        ([Angle], [AcrossAxis(_)]) => "`point_on_line`, which does not prescribe the angle",
        ([Angle], [Coincidence(_), Coincidence(_)]) => "`revolute`, which does not prescribe the angle",
        (_, [Angle]) => "`relative_angle`, which does not prescribe the position",
        (_, [Coincidence(_)]) => "`point_on_line`, which holds the point in one direction only",
        ([Coincidence(_)], [Coincidence(_), Angle]) => "`translational`, which lets the point move in one direction",
        _ if joint.kind == JointKind::RollingOnLine && rest.contains(&joint.first_row) => {
            "`point_on_line`, which does not prescribe how far the disc rolls"
        }
        _ if joint.kind == JointKind::RollingOnLine => {
            "`rack_pinion` with the opposite radius, which does not prescribe the distance from the line"
        }
        _ => {
            let names = quoted(rest.iter().map(|row| set.rows[*row].name.as_str()), "and");
            return Some(format!(
                "statements that prescribe only what {names} {}",
                match rest.len() {
                    1 => "does",
                    _ => "do",
                }
            ));
        }
    };
    Some(instead.to_owned())
}

/// The number of driving rows.
fn drivers(system: &KinematicSystem) -> usize {
    system.classes.iter().filter(|class| class.driving).count()
}

/// Each joint once, in order of first occurrence.
fn distinct(joints: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut all = Vec::new();
    joints.for_each(|joint| {
        if !all.contains(&joint) {
            all.push(joint);
        }
    });
    all
}

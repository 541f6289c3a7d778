//! Rules for names.

use crate::error::{ModelError, Origin};
use crate::mechanism::{Mechanism, Statement};
use std::collections::BTreeMap;

/// The reserved words of the language.
pub const RESERVED: [&str; 17] = [
    "t", "pi", "ground", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "exp", "ln", "abs", "pow",
    "distance", "dot",
];

/// True if `name` is a reserved word.
pub fn is_reserved(name: &str) -> bool {
    RESERVED.contains(&name)
}

/// The meaning of a reserved word.
pub fn meaning_of_reserved(name: &str) -> Option<&'static str> {
    is_reserved(name).then_some(match name {
        "t" => "time",
        "pi" => "the number π",
        "ground" => "the fixed frame",
        _ => "a function",
    })
}

/// All names of the shared namespace, in the order of the source.
fn declared(mechanism: &Mechanism) -> Vec<(&str, &'static str, Origin)> {
    let mut all: Vec<(&str, &'static str, Origin)> = Vec::new();
    all.extend(mechanism.parameters.iter().map(|p| (p.name.as_str(), "a parameter", p.origin)));
    all.extend(mechanism.functions.iter().map(|f| (f.name.as_str(), "a function", f.origin)));
    all.extend(mechanism.inputs.iter().map(|i| (i.name.as_str(), "an input", i.origin)));
    all.extend(mechanism.bodies.iter().map(|b| (b.name.as_str(), "a body", b.origin)));
    all.extend(mechanism.scalars.iter().map(|s| (s.name.as_str(), "a coordinate", s.origin)));
    all.extend(mechanism.points.iter().map(|p| (p.name.as_str(), "a point", p.origin)));
    all.extend(mechanism.defines.iter().map(|d| (d.name.as_str(), "a define", d.origin)));
    all.sort_by_key(|(_, _, origin)| *origin);
    all
}

/// Rule: names are unique; the error is at the second declaration and names the first.
pub(super) fn names_differ(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let mut first = BTreeMap::new();
    for (name, kind, origin) in declared(mechanism) {
        match first.get(name) {
            None => _ = first.insert(name, kind),
            Some(&other) if other == kind => {
                let noun = kind.trim_start_matches("a ").trim_start_matches("an ");
                let message = format!("there is {kind} `{name}` already; declare it once, or rename this {noun}");
                errors.push(ModelError::new(origin, message));
            }
            Some(other) => {
                let message = format!(
                    "`{name}` is {other} already, and here {kind}; bodies, coordinates, parameters, points, defines, functions and inputs share one namespace"
                );
                errors.push(ModelError::new(origin, message));
            }
        }
    }
}

/// True if no name is declared twice.
pub(super) fn are_distinct(mechanism: &Mechanism) -> bool {
    let mut errors = Vec::new();
    names_differ(mechanism, &mut errors);
    errors.is_empty()
}

/// Rule: no name is a reserved word.
pub(super) fn names_are_not_reserved(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for (name, kind, origin) in declared(mechanism) {
        if let Some(meaning) = meaning_of_reserved(name) {
            let message = format!("`{name}` is {meaning} in every mechanism; {kind} needs another name");
            errors.push(ModelError::new(origin, message));
        }
    }
}

/// Rule: names of rows are unique. Conditions, and masses and loads with a name, share the namespace of the rows.
pub(super) fn row_names_differ(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let named = |load: &&Statement| load.operands.form().named || load.name != load.operands.keyword();
    let statements = mechanism.joints.iter().chain(mechanism.loads.iter().filter(named));
    let joints = statements.map(|joint| (joint.name.as_str(), joint.operands.keyword(), joint.origin));
    let conditions = mechanism.conditions.iter().map(|c| (c.name.as_str(), "unilateral", c.origin));
    let mut rows: Vec<_> = joints.chain(conditions).collect();
    rows.sort_by_key(|(_, _, origin)| *origin);
    let mut first = BTreeMap::new();
    for (name, keyword, origin) in rows {
        match first.get(name) {
            None => _ = first.insert(name, keyword),
            Some(other) => {
                let message =
                    format!("the name `{name}` is already used by a `{other}`; statements need different names");
                errors.push(ModelError::new(origin, message));
            }
        }
    }
}

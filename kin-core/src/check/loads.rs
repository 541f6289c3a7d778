//! Rules for masses and loads.

use crate::error::{ModelError, Origin};
use crate::mechanism::{BodyRef, Mechanism, Operand, Place, Range, Statement};
use crate::vocabulary::{LoadKind, StatementKind};

/// Rule: every mass and load acts on a body, and between two different bodies if it has two.
pub(super) fn loads_act_on_bodies(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for load in &mechanism.loads {
        let StatementKind::Load(kind) = load.operands.kind() else { continue };
        let (keyword, name) = (load.operands.keyword(), &load.name);
        let bodies: Vec<BodyRef> = (load.operands.iter().filter(|(slot, _)| slot.key != "frame"))
            .flat_map(|(_, operand)| operand.bodies())
            .collect();
        match (kind, bodies.as_slice()) {
            (LoadKind::Mass, [body]) if body.is_ground() => {
                let message =
                    "the ground does not move, so that its mass makes no difference; a mass belongs to a body";
                errors.push(ModelError::new(body.origin(), message));
            }
            (LoadKind::Force | LoadKind::Torque, [body]) if body.is_ground() => {
                let message =
                    format!("{keyword} `{name}` acts on the ground, which does not move; a load acts on a body");
                errors.push(ModelError::new(body.origin(), message));
            }
            (_, [a, b]) => {
                if let Some(body) = mechanism.common_member(load.range, *a, *b) {
                    let message = format!(
                        "{keyword} `{name}` acts between `{body}` and itself, so that it does nothing; its operands \
                         belong to two different bodies"
                    );
                    errors.push(ModelError::new(b.origin(), message));
                }
            }
            _ => {}
        }
    }
}

/// All masses and loads of a kind.
fn loads_of(mechanism: &Mechanism, kind: LoadKind) -> impl Iterator<Item = &Statement> {
    mechanism.loads.iter().filter(move |load| load.operands.kind() == StatementKind::Load(kind))
}

/// Rule: gravity is declared at most once.
pub(super) fn one_field_of_gravity(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for second in loads_of(mechanism, LoadKind::Gravity).skip(1) {
        let message = "there is a `gravity` already; one field pulls all masses";
        errors.push(ModelError::new(second.keyword, message));
    }
}

/// Rule: if there is gravity, there is a mass.
pub(super) fn gravity_has_masses(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let first = |kind| loads_of(mechanism, kind).next();
    if let (Some(gravity), None) = (first(LoadKind::Gravity), first(LoadKind::Mass)) {
        let message = "gravity pulls masses, and no body has one: `#[mass(crank @ (l1/2, 0), mass = m1)]`";
        errors.push(ModelError::new(gravity.keyword, message));
    }
}

/// Rule: no two masses have the same centre, because such a mass has probably been declared twice.
pub(super) fn centres_differ(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    let mut known: Vec<(&Place, Option<Range>)> = Vec::new();
    for load in &mechanism.loads {
        if load.operands.kind() != StatementKind::Load(LoadKind::Mass) {
            continue;
        }
        let Some((_, Operand::Point(centre))) = load.operands.iter().next() else { continue };
        let same = |(other, range): &&(&Place, Option<Range>)| {
            let body = mechanism.common_member(*range, other.body, centre.body);
            body.is_some() && load.range.is_none() && other.x == centre.x && other.y == centre.y
        };
        if known.iter().find(same).is_some() {
            let message = "a mass has its centre here already; several masses of one body have different centres";
            errors.push(ModelError::new(centre.origin, message));
        }
        known.push((centre, load.range));
    }
}

/// Rule: masses and moments of inertia are not negative, and a spring has a stiffness or a damping.
pub(super) fn loads_have_valid_sizes(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for load in &mechanism.loads {
        let literal = |key: &str| {
            let found = load.operands.iter().find(|(slot, _)| slot.key == key)?;
            if let Operand::Value(value) = found.1 { Some((value.value.literal()?, value.origin)) } else { None }
        };
        match load.operands.kind() {
            StatementKind::Load(LoadKind::Mass) => {
                for key in ["mass", "inertia"] {
                    negative(key, literal(key), errors);
                }
            }
            StatementKind::Load(LoadKind::Spring | LoadKind::TorsionSpring) => {
                let is_zero = |key| literal(key).is_some_and(|(value, _)| value == 0.0);
                if is_zero("stiffness") && is_zero("damping") {
                    errors.push(ModelError::new(load.keyword, does_nothing(load)));
                }
            }
            _ => {}
        }
    }
}

fn negative(key: &str, found: Option<(f64, Origin)>, errors: &mut Vec<ModelError>) {
    if let Some((value, origin)) = found
        && value < 0.0
    {
        let quantity = if key == "mass" { "a mass" } else { "a moment of inertia" };
        errors.push(ModelError::new(origin, format!("{quantity} must not be negative; this one is {value}")));
    }
}

fn does_nothing(load: &Statement) -> String {
    let (keyword, name) = (load.operands.keyword(), &load.name);
    format!("{keyword} `{name}` has neither `stiffness = …` nor `damping = …`, so that it does nothing")
}

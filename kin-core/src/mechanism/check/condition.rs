//! The rule on unilateral conditions.

use super::scope::nodes;
use crate::error::ModelError;
use crate::mechanism::{Body, BodyOrigin, BodyRef, Component, Formula, Mechanism};
use std::collections::BTreeSet;

/// A condition holds a coordinate, t or an input: otherwise no motion can change it.
pub(super) fn conditions_change(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for condition in &mechanism.conditions {
        if !changes(mechanism, &[&condition.left, &condition.right]) {
            let message = format!(
                "unilateral `{}` holds no coordinate, no input and no `t`, so that no motion changes it; \
                 one of its sides moves",
                condition.name
            );
            errors.push(ModelError::new(condition.keyword, message));
        }
    }
}

/// A define, or a component of a body: all members of a family are made alike.
type Part = (bool, usize, Component);

/// False only for what certainly stays as it is: formulas are followed through defines, held and carried coordinates.
pub(super) fn changes<'m>(mechanism: &'m Mechanism, formulas: &[&'m Formula]) -> bool {
    let mut seen: BTreeSet<Part> = BTreeSet::new();
    let mut open = formulas.to_vec();
    while let Some(formula) = open.pop() {
        let mut bodies = Vec::new();
        for node in nodes(formula) {
            match node {
                Formula::Time | Formula::Input(_) | Formula::Scalar(_) => return true,
                Formula::Pose(body, component) => bodies.push((*body, vec![*component])),
                Formula::PointCoordinate(place, _) => bodies.push((place.body, Component::ALL.to_vec())),
                Formula::Distance(p, q) => bodies.extend([p, q].map(|place| (place.body, Component::ALL.to_vec()))),
                Formula::Define(member) if seen.insert((true, member.family, Component::X)) => {
                    open.extend(mechanism.defines.get(member.family).map(|define| &define.formula));
                }
                _ => {}
            }
        }
        while let Some((body, components)) = bodies.pop() {
            let BodyRef::Body { family, .. } = body else { continue };
            let Some(body) = mechanism.bodies.get(family) else { continue };
            for component in components {
                if !seen.insert((false, family, component)) {
                    continue;
                }
                match source(body, component) {
                    Source::Free => return true,
                    Source::Held(formula) => open.push(formula),
                    Source::Carried(by) => bodies.push((by, Component::ALL.to_vec())),
                }
            }
        }
    }
    false
}

/// Where a component of a pose comes from.
enum Source<'m> {
    Free,
    Held(&'m Formula),
    Carried(BodyRef),
}

fn source(body: &Body, component: Component) -> Source<'_> {
    let held = match (component, &body.origin_at) {
        (Component::Phi, _) => &body.phi,
        (_, BodyOrigin::Carried(place)) => return Source::Carried(place.body),
        (Component::X, BodyOrigin::Free { x, .. }) => x,
        (Component::Y, BodyOrigin::Free { y, .. }) => y,
    };
    held.as_ref().map_or(Source::Free, Source::Held)
}

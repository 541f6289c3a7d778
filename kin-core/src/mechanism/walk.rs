//! Traversal of formulas, and resolution of references to bodies.

use super::{BodyRef, Formula, Mechanism, Member, Range};
use std::collections::BTreeSet;

/// All nodes of a formula, including those of the coordinates of its points.
pub(crate) fn nodes(formula: &Formula) -> Vec<&Formula> {
    let mut open = vec![formula];
    let mut all = Vec::new();
    while let Some(node) = open.pop() {
        all.push(node);
        match node {
            Formula::Neg(a)
            | Formula::Pow(a, _)
            | Formula::Call(_, a)
            | Formula::Supplied(_, a)
            | Formula::Dot(a, _) => open.push(a),
            Formula::Add(a, b)
            | Formula::Sub(a, b)
            | Formula::Mul(a, b)
            | Formula::Div(a, b, _)
            | Formula::Atan2(a, b) => open.extend([&**a, &**b]),
            Formula::PointCoordinate(place, _) => open.extend([&place.x, &place.y]),
            Formula::Distance(p, q) => open.extend([&p.x, &p.y, &q.x, &q.y]),
            Formula::Number(_)
            | Formula::Pi
            | Formula::Time
            | Formula::Index(_)
            | Formula::Parameter(_)
            | Formula::Input(_)
            | Formula::Pose(..)
            | Formula::Scalar(_)
            | Formula::Curve(_)
            | Formula::Define(_) => {}
        }
    }
    all
}

/// The defines that a formula uses directly.
pub(crate) fn defines_in(formula: &Formula) -> impl Iterator<Item = &Member> {
    nodes(formula).into_iter().filter_map(|node| match node {
        Formula::Define(member) => Some(member),
        _ => None,
    })
}

/// True if the formula, or a define that it uses, contains t or an input. Poses of bodies are not followed: a held
/// coordinate that varies with time belongs to the body.
pub(crate) fn contains_signal(mechanism: &Mechanism, formula: &Formula) -> bool {
    contains(mechanism, formula, |node| matches!(node, Formula::Time | Formula::Input(_)))
}

/// True if the formula, or a define that it uses, contains a coordinate of any kind, held ones included.
pub(crate) fn contains_coordinate(mechanism: &Mechanism, formula: &Formula) -> bool {
    contains(mechanism, formula, |node| {
        matches!(node, Formula::Pose(..) | Formula::Scalar(_) | Formula::PointCoordinate(..) | Formula::Distance(..))
    })
}

/// True for one of the nodes of the formula and of the defines that it uses.
fn contains(mechanism: &Mechanism, formula: &Formula, is_found: impl Fn(&Formula) -> bool) -> bool {
    let (mut open, mut visited) = (vec![formula], BTreeSet::new());
    while let Some(formula) = open.pop() {
        for node in nodes(formula) {
            match node {
                Formula::Define(member) if visited.insert(member.family) => {
                    open.extend(mechanism.defines.get(member.family).map(|define| &define.formula));
                }
                node if is_found(node) => return true,
                _ => {}
            }
        }
    }
    false
}

impl Mechanism {
    /// The name of the body that both references denote for some index of a range.
    pub(crate) fn common_member(&self, range: Option<Range>, a: BodyRef, b: BodyRef) -> Option<String> {
        match (a, b) {
            (BodyRef::Ground(_), BodyRef::Ground(_)) => Some("ground".to_owned()),
            (BodyRef::Body { family, index, .. }, BodyRef::Body { family: other, index: with, .. })
                if family == other =>
            {
                let range = range.unwrap_or(Range { start: 0, end: 1 });
                let body = self.bodies.get(family)?;
                let common = range.indices().find_map(|i| index.at(i).filter(|k| with.at(i) == Some(*k)));
                common.map(|k| if body.len.is_some() { format!("{}[{k}]", body.name) } else { body.name.clone() })
            }
            _ => None,
        }
    }
}

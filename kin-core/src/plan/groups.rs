//! Names dyads by the letters of their joints (R revolute, P prismatic). A dyad of joints is named by traversing it
//! from one outer joint to the other; the point at which another body carries a body's origin counts as a pin. A dyad
//! of free equations of the user is named after its closed form.

use super::step::Step;
use super::tree::{BlockPart, Core, Pair, PairValue, SolutionMethod};
use crate::constraint::{ConstraintSet, Frame, RowMeaning};
use crate::expr::{Graph, Node, Symbol};
use crate::vocabulary::JointKind;
use crate::vocabulary::StepKind;
use std::collections::BTreeSet;

/// The letters of a core of two rows, which intersects two circles or a circle and a line.
pub(super) fn letters_of_method(method: &SolutionMethod) -> Option<&'static str> {
    match method {
        SolutionMethod::Circle { second: Some(_), .. } => Some("RRR"),
        SolutionMethod::Circle { second: None, .. } => Some("RRP"),
        _ => None,
    }
}

/// The letters of a pair whose inner block is a single closure. The pair gives either the angle of a link or the stroke
/// along a guide, whose direction depends on the unknown of the closure (RPR) or not (RRP).
pub(super) fn letters_of_pair(graph: &Graph, pair: &Pair) -> Option<&'static str> {
    let [BlockPart::Core(Core { coordinates, method, .. })] = pair.inner.parts.as_slice() else { return None };
    let &[k] = coordinates.as_slice() else { return None };
    match (&pair.value, method) {
        (PairValue::Angle { square: Some(_), .. }, SolutionMethod::Angle { .. }) => Some("RRR"),
        (PairValue::Angle { square: Some(_), .. }, SolutionMethod::Quadratic { .. }) => Some("RRP"),
        (PairValue::Linear { by, .. }, SolutionMethod::Angle { .. }) => {
            let symbol = Node::Symbol(Symbol::Coordinate(k));
            let turns = graph.reachable(*by).into_iter().any(|id| graph.node(id) == symbol);
            Some(if turns { "RPR" } else { "RRP" })
        }
        _ => None,
    }
}

/// Orders the joints of a dyad from one end to the other, and sets the `group` and `singular` of the step.
pub(super) fn name_group(set: &ConstraintSet, step: &mut Step) {
    let bodies = std::mem::take(&mut step.bodies);
    let free = step.joints.iter().all(|&joint| set.joints[joint].kind == JointKind::Constraint);
    let along = if step.kind == StepKind::Explicit { None } else { walk(set, &step.joints, &bodies) };
    let walked = along.is_some();
    if let Some((joints, letters)) = along {
        (step.joints, step.group) = (joints, letters);
    } else if let (true, Some(letters)) = (free, step.closed_as) {
        letters.clone_into(&mut step.group);
    }
    let joints = names(set, &step.joints);
    let carried = bodies.iter().any(|&body| set.bodies[body].carried_by.is_some());
    step.singular = match (step.kind, step.group.as_str()) {
        (StepKind::Explicit | StepKind::RedundantRows, _) => String::new(),
        (StepKind::Closure, "RRR") if walked && carried => {
            format!("{joints} and the pins that carry origins on one line")
        }
        (StepKind::Closure, "RRR") if walked => format!("{joints} on one line"),
        (StepKind::Closure, "RRP") => "the link square to the guide".to_owned(),
        (StepKind::Closure, _) => format!("both solutions of {joints} coinciding"),
        (StepKind::Linear(_), "PRP") => "both guides parallel".to_owned(),
        (StepKind::Linear(n), _) => format!("determinant {n}×{n} of {joints} zero"),
        (StepKind::Newton(n), _) => format!("Jacobian {n}×{n} of {joints} singular"),
    };
}

/// Says in words when a formula is singular whose divisor is 0 for some configurations.
pub(super) fn name_zero_divisor(set: &ConstraintSet, step: &mut Step) {
    if step.singular.is_empty() {
        step.singular = format!("divisor of {} zero", names(set, &step.joints));
    }
}

/// The names of joints, as in `A, B and C`.
fn names(set: &ConstraintSet, joints: &[usize]) -> String {
    let names: Vec<&str> = joints.iter().map(|&joint| set.joints[joint].name.as_str()).collect();
    match names.as_slice() {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

/// A joint of a dyad. The pin at which another body carries an origin has no declared joint.
struct Hinge {
    joint: Option<usize>,
    frames: [Option<Frame>; 2],
}

/// The joints of a dyad from one end to the other, and its letters; `None` if the step is not a dyad.
fn walk(set: &ConstraintSet, joints: &[usize], bodies: &BTreeSet<usize>) -> Option<(Vec<usize>, String)> {
    let inside = |frame: Option<Frame>| match frame {
        Some(Frame::Body(body)) => bodies.contains(&body).then_some(body),
        _ => None,
    };
    let named = joints.iter().map(|&joint| Hinge { joint: Some(joint), frames: set.joints[joint].frames });
    let carried = bodies.iter().filter_map(|&body| {
        let carrier = set.bodies[body].carried_by?;
        Some(Hinge { joint: None, frames: [Some(carrier), Some(Frame::Body(body))] })
    });
    let hinges: Vec<Hinge> = named.chain(carried).collect();
    let ends = |hinge: &Hinge| hinge.frames.map(inside);
    let hinges_with = |count: usize| hinges.iter().filter(move |hinge| ends(hinge).iter().flatten().count() == count);
    let (outer, inner): (Vec<&Hinge>, Vec<&Hinge>) = (hinges_with(1).collect(), hinges_with(2).collect());
    let (&[first, last], true) = (outer.as_slice(), inner.len() <= 1 && outer.len() + inner.len() == hinges.len())
    else {
        return None;
    };
    if inner.len() + 1 != bodies.len() {
        return None;
    }
    let mut letters = String::new();
    // A joint is crossed forwards if the traversal goes from its body i to its body j: the first joint from the outside
    // into `start`, the inner joint out of it, the last joint to the outside.
    let entered = ends(first);
    let start = entered.iter().flatten().next().copied();
    let along = || std::iter::once(first).chain(inner.iter().copied()).chain(std::iter::once(last));
    for (index, hinge) in along().enumerate() {
        let bodies_of_hinge = ends(hinge);
        let is_last = index == inner.len() + 1;
        let forwards = if index == 0 {
            bodies_of_hinge[1].is_some()
        } else {
            is_last && bodies_of_hinge[0].is_some() || bodies_of_hinge[0] == start
        };
        let Some(joint) = hinge.joint else {
            letters.push('R');
            continue;
        };
        // A driven distance between two points is a link of variable length; a row without frames is a formula of
        // coordinates.
        let joins = set.joints[joint].frames.iter().all(Option::is_some);
        letters.push_str(match (&set.meanings(&set.joints[joint])[..], forwards) {
            ([RowMeaning::Coincidence(_), RowMeaning::Coincidence(_)], _) => "R",
            ([RowMeaning::AcrossAxis(_), RowMeaning::Angle], _) => "P",
            ([RowMeaning::SquaredDistance], _) if joins => "RR",
            ([RowMeaning::AcrossAxis(_)], true) => "PR",
            ([RowMeaning::AcrossAxis(_)], false) => "RP",
            _ => return None,
        });
    }
    if letters.len() != 3 {
        return None;
    }
    let ordered = along().filter_map(|hinge| hinge.joint).collect();
    let reversed: String = letters.chars().rev().collect();
    let letters = match reversed.as_str() {
        "RRP" | "RPP" => reversed,
        _ => letters,
    };
    Some((ordered, letters))
}

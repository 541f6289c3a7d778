//! Determines which coordinates a row contains, directly or through points, defines and carried origins.
//!
//! The result may contain too many coordinates but never too few, so that a rule can rely on a coordinate that is
//! missing.

use crate::mechanism::{
    BodyRef, Component, Formula, Mechanism, Member, Operand, Place, Sees, Source, Statement, nodes,
};
use std::collections::BTreeSet;

/// A generalized coordinate of a member of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum MemberCoordinate {
    /// The body family, the member and the component of a coordinate of a body.
    Pose(usize, usize, Component),
    /// The family and the member of a scalar coordinate.
    Scalar(usize, usize),
}

/// A reference: a define, or a coordinate, which may be held or carried and then leads to further references.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Mention {
    Coordinate(MemberCoordinate),
    Define(usize, usize),
}

/// The free coordinates that the joint contains for any index of its range.
pub(super) fn mentioned(mechanism: &Mechanism, joint: &Statement) -> BTreeSet<MemberCoordinate> {
    let indices = joint.range.map_or(0..1, |range| range.indices());
    let mut all = Mentions::new(mechanism);
    indices.for_each(|i| all.joint(joint, i));
    all.follow()
}

/// The free coordinates that the joint contains for the index `i`.
pub(super) fn mentioned_at(mechanism: &Mechanism, joint: &Statement, i: i64) -> BTreeSet<MemberCoordinate> {
    let mut all = Mentions::new(mechanism);
    all.joint(joint, i);
    all.follow()
}

/// False only if the formulas are certainly constant for the index `i`: they contain no coordinate, no t and no input.
pub(super) fn changes(mechanism: &Mechanism, formulas: &[&Formula], i: i64) -> bool {
    let mut all = Mentions::new(mechanism);
    formulas.iter().for_each(|formula| all.formula(formula, i));
    all.close();
    all.rheonomic || !all.follow().is_empty()
}

/// True if the formula contains a free coordinate for the index `i`.
pub(super) fn moves(mechanism: &Mechanism, formula: &Formula, i: i64) -> bool {
    let mut all = Mentions::new(mechanism);
    all.formula(formula, i);
    !all.follow().is_empty()
}

/// The held coordinates that the joint involves for one of these indices.
pub(crate) fn held(
    mechanism: &Mechanism,
    joint: &Statement,
    indices: impl IntoIterator<Item = i64>,
) -> BTreeSet<HeldCoordinate> {
    let mut all = Mentions::new(mechanism);
    indices.into_iter().for_each(|i| all.joint(joint, i));
    all.close();
    let held = all.seen.iter().filter_map(|mention| match *mention {
        Mention::Coordinate(MemberCoordinate::Pose(family, member, component)) => {
            let body = mechanism.bodies.get(family)?;
            let index = body.len.map_or(String::new(), |_| format!("[{member}]"));
            let name = format!("{}{index}.{component}", body.name);
            matches!(body.source(component), Source::Held(_))
                .then_some(HeldCoordinate { place: (family, member, component), name })
        }
        Mention::Coordinate(MemberCoordinate::Scalar(..)) | Mention::Define(..) => None,
    });
    held.collect()
}

/// A held coordinate. The order is that of the bodies.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct HeldCoordinate {
    /// The family, the member and the component.
    place: (usize, usize, Component),
    /// The name, such as `crank.phi` or `link[3].x`.
    pub(crate) name: String,
}

/// How a component of the bodies of a family is determined.
fn source(mechanism: &Mechanism, family: usize, component: Component) -> Option<Source<'_>> {
    mechanism.bodies.get(family).map(|body| body.source(component))
}

struct Mentions<'a> {
    mechanism: &'a Mechanism,
    seen: BTreeSet<Mention>,
    open: Vec<Mention>,
    /// True if t or an input has been found.
    rheonomic: bool,
}

impl<'a> Mentions<'a> {
    fn new(mechanism: &'a Mechanism) -> Self {
        Self { mechanism, seen: BTreeSet::new(), open: Vec::new(), rheonomic: false }
    }

    fn note(&mut self, mention: Mention) {
        if self.seen.insert(mention) {
            self.open.push(mention);
        }
    }

    /// Follows all references that have been recorded.
    fn close(&mut self) {
        let mechanism = self.mechanism;
        while let Some(mention) = self.open.pop() {
            match mention {
                Mention::Define(family, member) => {
                    if let Some(define) = mechanism.defines.get(family) {
                        self.formula(&define.formula, index(member));
                    }
                }
                Mention::Coordinate(MemberCoordinate::Pose(family, member, component)) => {
                    match source(mechanism, family, component) {
                        Some(Source::Carried(place)) => self.place(place, &[component], index(member)),
                        Some(Source::Held(formula)) => self.formula(formula, index(member)),
                        Some(Source::Free) | None => {}
                    }
                }
                Mention::Coordinate(MemberCoordinate::Scalar(..)) => {}
            }
        }
    }

    /// The free coordinates among all references, after following them.
    fn follow(mut self) -> BTreeSet<MemberCoordinate> {
        let mechanism = self.mechanism;
        self.close();
        let coordinates = self.seen.into_iter().filter_map(|mention| match mention {
            Mention::Coordinate(coordinate) => Some(coordinate),
            Mention::Define(..) => None,
        });
        coordinates
            .filter(|coordinate| match *coordinate {
                MemberCoordinate::Pose(family, _, component) => {
                    matches!(source(mechanism, family, component), Some(Source::Free))
                }
                MemberCoordinate::Scalar(..) => true,
            })
            .collect()
    }

    fn joint(&mut self, joint: &Statement, i: i64) {
        for (slot, operand) in joint.operands.iter() {
            match operand {
                Operand::Point(place) => self.point(place, slot.sees, i),
                Operand::Points(places) => places.iter().for_each(|place| self.point(place, slot.sees, i)),
                Operand::Body(body) => self.pose(*body, Component::Phi, i),
                // Axes and radii are formulas of parameters.
                Operand::Axis(_) | Operand::Radii(_) => {}
                Operand::Bodies(bodies) => bodies.iter().for_each(|body| self.pose(*body, Component::Phi, i)),
                Operand::Scalar(_) | Operand::Vector(_) | Operand::Value(_) | Operand::Curve(_) => {
                    operand.formulas().into_iter().for_each(|formula| self.formula(formula, i));
                    operand.scalar().iter().for_each(|member| self.scalar(member, i));
                }
            }
        }
    }

    /// Records the coordinates of a point that appear in the rows.
    fn point(&mut self, place: &Place, sees: Sees, i: i64) {
        match sees {
            Sees::Component(component) => self.place(place, &[component], i),
            Sees::Point | Sees::PointAndAngle => self.place(place, &[Component::X, Component::Y], i),
        }
        if sees == Sees::PointAndAngle {
            self.pose(place.body, Component::Phi, i);
        }
    }

    fn formula(&mut self, formula: &Formula, i: i64) {
        for node in nodes(formula) {
            match node {
                Formula::Pose(body, component) => self.pose(*body, *component, i),
                Formula::PointCoordinate(place, component) => self.place(place, &[*component], i),
                Formula::Distance(p, q) => {
                    self.place(p, &[Component::X, Component::Y], i);
                    self.place(q, &[Component::X, Component::Y], i);
                }
                Formula::Time | Formula::Input(_) => self.rheonomic = true,
                Formula::Scalar(member) => self.scalar(member, i),
                Formula::Define(member) => {
                    if let Some(index) = member.index.at(i) {
                        self.note(Mention::Define(member.family, index));
                    }
                }
                _ => {}
            }
        }
    }

    fn scalar(&mut self, member: &Member, i: i64) {
        if let Some(index) = member.index.at(i) {
            self.note(Mention::Coordinate(MemberCoordinate::Scalar(member.family, index)));
        }
    }

    fn pose(&mut self, body: BodyRef, component: Component, i: i64) {
        if let BodyRef::Body { family, index, .. } = body
            && let Some(member) = index.at(i)
        {
            self.note(Mention::Coordinate(MemberCoordinate::Pose(family, member, component)));
        }
    }

    /// Records the given components of a point, and the angle of its body unless the point is the body's origin.
    fn place(&mut self, place: &Place, components: &[Component], i: i64) {
        for component in components {
            self.pose(place.body, *component, i);
        }
        let is_origin = place.x.literal() == Some(0.0) && place.y.literal() == Some(0.0);
        if !is_origin {
            self.pose(place.body, Component::Phi, i);
        }
    }
}

/// The index of a member as the value of an index variable.
fn index(member: usize) -> i64 {
    i64::try_from(member).unwrap_or(i64::MAX)
}

//! Assembly: walks the mechanism and asks every joint for its rows.

use super::gear::Pair;
use super::layout::indexed;
use super::moving_operands::moving_rows;
use super::placed::{PlacedPoint, Pose};
use super::set::{
    ConstraintRow, ConstraintSet, CurveInstance, DefineInstance, Family, Frame, Geometry, JointInstance, Observable,
    ObservableKind, PointInstance, Quantity, Role, VelocityRow,
};
use super::tag::JointTag;
use super::{
    angle, belt, coordinate, curve, distance, driver, fixed, gear, knife_edge, nonholonomic, point_on_line,
    rack_pinion, revolute, rolling_on_disc, rolling_on_line, speed, translational,
};
use crate::error::{ModelError, Origin};
use crate::expr::{ExprId, Graph};
use crate::mechanism::{BodyOrigin, Component, Curve, GuessTarget, Joint, JointKind, Mechanism, Radius, Range};
use std::collections::HashMap;

/// What a joint hands back: rows as (suffix of the name, residual), and what it reports.
#[derive(Default)]
pub(super) struct Rows {
    pub(super) residuals: Vec<(&'static str, ExprId)>,
    /// The row of velocity level; its joint has no other.
    pub(super) velocity: Option<VelocityRow>,
    pub(super) geometry: Vec<(Role, Frame, Vec<ExprId>)>,
    pub(super) quantities: Vec<(&'static str, ExprId)>,
    pub(super) frames: [Option<Frame>; 2],
}

impl Rows {
    /// The two points of a joint, with their geometry.
    pub(super) fn between(p: &PlacedPoint, q: &PlacedPoint) -> Self {
        Self {
            frames: [Some(p.frame), Some(q.frame)],
            geometry: vec![(Role::P, p.frame, p.local.to_vec()), (Role::Q, q.frame, q.local.to_vec())],
            ..Self::default()
        }
    }
}

/// The state of an assembly.
pub(super) struct Assembly<'m> {
    pub(super) mechanism: &'m Mechanism,
    pub(super) graph: Graph,
    /// First instance of every body family.
    pub(super) first_body: Vec<usize>,
    /// The poses of all bodies, as far as known.
    pub(super) poses: Vec<Pose>,
    pub(super) coordinates_of: Vec<[Option<u32>; 3]>,
    pub(super) first_scalar: Vec<u32>,
    pub(super) first_parameter: Vec<u32>,
    pub(super) first_input: Vec<u32>,
    pub(super) first_function: Vec<u32>,
    /// Defines by family and index; `None` while one is being built.
    pub(super) defines: HashMap<(usize, i64), Option<ExprId>>,
    /// The index variable of the range that is being laid out.
    pub(super) index: i64,
    /// The name of what is being written, where it is a member of a family.
    pub(super) member: Option<String>,
    /// What the variables of the curve that is being written stand for.
    pub(super) variables: curve::Variables,
    /// Every q̇ is 0: rates of formulas are their partial derivatives with respect to time.
    pub(super) at_rest: bool,
    /// The curve of the joint that is being written, for a drawing.
    pub(super) outline: Option<[ExprId; 4]>,
    pub(super) errors: Vec<ModelError>,
}

/// Assembles Φ and everything that is reported.
///
/// # Errors
/// Indices out of range and cycles, at their origins; a mechanism that [`check`](crate::mechanism::check::check)
/// accepts has none.
pub fn assemble(mechanism: &Mechanism) -> Result<ConstraintSet, Vec<ModelError>> {
    let mut set = ConstraintSet { name: mechanism.name.clone(), ..ConstraintSet::default() };
    let mut assembly = Assembly::new(mechanism, &mut set);
    assembly.bodies(&mut set);
    assembly.points(&mut set);
    assembly.defines(&mut set);
    assembly.joints(&mut set);
    assembly.conditions(&mut set);
    assembly.guesses(&mut set);
    set.graph = assembly.graph;
    if assembly.errors.is_empty() { Ok(set) } else { Err(assembly.errors) }
}

impl Assembly<'_> {
    pub(super) fn error(&mut self, origin: Origin, message: impl Into<String>) -> ExprId {
        self.errors.push(ModelError::new(origin, message));
        self.graph.zero()
    }

    /// What is wrong with a family is told once, of the first member that has it.
    pub(super) fn error_once(&mut self, origin: Origin, message: impl Into<String>) {
        if self.errors.iter().all(|error| error.origin != origin) {
            self.error(origin, message);
        }
    }

    /// What is degenerate in a joint; a member of a family is named.
    pub(super) fn degenerate(&mut self, origin: Origin, what: &str, message: impl core::fmt::Display) {
        let member = self.member.as_ref().map_or(String::new(), |name| format!(" of `{name}`"));
        self.error_once(origin, format!("{what}{member} {message}"));
    }

    /// The radius of a disc or gear, which is not 0; plain numbers have their own rule.
    pub(super) fn radius(&mut self, radius: &Radius) -> ExprId {
        let before = self.errors.len();
        let value = self.formula(&radius.value);
        if self.graph.is_zero(value) && self.errors.len() == before {
            let right = "a radius is positive, or negative for a disc or gear that the other runs inside of";
            self.degenerate(radius.origin, "this radius", format_args!("is 0; {right}"));
        }
        value
    }

    pub(super) fn observe(&self, set: &mut ConstraintSet, kind: ObservableKind, value: ExprId) -> usize {
        set.observables.push(Observable { kind, value });
        set.observables.len() - 1
    }

    fn bodies(&mut self, set: &mut ConstraintSet) {
        for place in 0..set.bodies.len() {
            let (family, index) = set.bodies[place].family;
            let pose = self.pose_of(place);
            if let BodyOrigin::Carried(carrier) = &self.mechanism.bodies[family].origin_at {
                set.bodies[place].carried_by = self.resolve(&carrier.body, index as i64);
                self.index = index as i64;
                set.bodies[place].carried_at = Some([self.formula(&carrier.x), self.formula(&carrier.y)]);
            }
            set.bodies[place].pose = pose;
            set.bodies[place].observables =
                std::array::from_fn(|c| self.observe(set, ObservableKind::Pose(place, Component::ALL[c]), pose[c]));
        }
    }

    /// The instances of a range: a single one, or one for every index.
    pub(super) fn instances(range: Option<Range>) -> Vec<(Option<i64>, i64)> {
        match range {
            None => vec![(None, 0)],
            Some(range) => range.indices().map(|i| (Some(i), i)).collect(),
        }
    }

    fn points(&mut self, set: &mut ConstraintSet) {
        for (family, point) in self.mechanism.points.iter().enumerate() {
            for (shown, index) in Self::instances(point.range) {
                self.index = index;
                let placed = self.place(&point.place);
                let local = set.geometry.len();
                set.geometry.extend(placed.local);
                let place = set.points.len();
                let observables = [(Component::X, 0), (Component::Y, 1)]
                    .map(|(component, c)| self.observe(set, ObservableKind::Point(place, component), placed.r[c]));
                set.points.push(PointInstance {
                    name: indexed(&point.name, shown.is_some(), index),
                    family: (family, index.max(0) as usize),
                    frame: placed.frame,
                    local,
                    observables,
                });
            }
        }
    }

    fn defines(&mut self, set: &mut ConstraintSet) {
        for (family, define) in self.mechanism.defines.iter().enumerate() {
            for (shown, index) in Self::instances(define.range) {
                let value = self.define_at(family, index, define.origin);
                let observable = self.observe(set, ObservableKind::Define(set.defines.len()), value);
                set.defines.push(DefineInstance {
                    name: indexed(&define.name, shown.is_some(), index),
                    origin: define.origin,
                    family: (family, index.max(0) as usize),
                    observable,
                    varies: !self.graph.depends(value).is_static(),
                });
            }
        }
    }

    fn joints(&mut self, set: &mut ConstraintSet) {
        for (family, joint) in self.mechanism.joints.iter().enumerate() {
            let first = set.rows.len();
            let instances = Self::instances(joint.range);
            let members = instances.len();
            for (shown, index) in instances {
                self.index = index;
                let name = indexed(&joint.name, shown.is_some(), index);
                self.member = shown.map(|_| name.clone());
                let rows = self.rows_of(joint);
                self.write(set, joint, (family, index), name, rows);
            }
            self.member = None;
            if joint.range.is_some() && members > 0 {
                let stride = (set.rows.len() - first) / members;
                set.row_families.push(Family { name: joint.name.clone(), first, members, stride });
            }
        }
    }

    fn rows_of(&mut self, joint: &Joint) -> Rows {
        match &joint.kind {
            JointKind::Revolute { p, q } => revolute::rows(self, p, q),
            JointKind::Translational { p, q, axis, angle } => translational::rows(self, p, q, axis, angle),
            JointKind::Fixed { p, q, angle } => fixed::rows(self, p, q, angle),
            JointKind::PointOnLine { p, q, axis, offset } => point_on_line::rows(self, p, q, axis, offset),
            JointKind::Distance { p, q, length, length_origin } => distance::rows(self, p, q, length, *length_origin),
            JointKind::Coordinate { p, component, value } => coordinate::rows(self, p, *component, value),
            JointKind::Angle { body, value } => angle::absolute(self, body, value),
            JointKind::RelativeAngle { a, b, value } => angle::relative(self, a, b, value),
            JointKind::OnCurve { p, q, curve } => curve::rows(self, p, q, curve),
            JointKind::FlatFollower { p, q, axis, support } => curve::flat_follower::rows(self, p, q, axis, support),
            JointKind::Gear { a, b, radii, carrier, offset } => gear::rows(self, Pair { a, b, radii, carrier }, offset),
            JointKind::Belt { a, b, radii, carrier, offset } => belt::rows(self, Pair { a, b, radii, carrier }, offset),
            JointKind::RackPinion { p, q, axis, pinion, radius, offset } => {
                rack_pinion::rows(self, [p, q], axis, (pinion, radius), offset)
            }
            JointKind::RollingOnLine { p, q, axis, radius, offset } => {
                rolling_on_line::rows(self, [p, q], axis, radius, offset)
            }
            JointKind::RollingOnDisc { p, q, radii, along, offset } => {
                rolling_on_disc::rows(self, [p, q], radii, along, offset)
            }
            JointKind::Constraint { left, right } => driver::equation(self, left, right),
            JointKind::KnifeEdge { p, angle } => knife_edge::rows(self, p, angle),
            JointKind::Speed { p, angle, value } => speed::rows(self, p, angle, value),
            JointKind::Nonholonomic { left, right } => nonholonomic::rows(self, left, right),
            JointKind::Driver { left, right, right_origin } => driver::rows(self, left, right, *right_origin),
        }
    }

    fn write(&mut self, set: &mut ConstraintSet, joint: &Joint, family: (usize, i64), name: String, rows: Rows) {
        let place = set.joints.len();
        let geometry = rows
            .geometry
            .into_iter()
            .map(|(role, frame, numbers)| {
                let offset = set.geometry.len();
                set.geometry.extend(numbers);
                Geometry { role, frame, offset }
            })
            .collect();
        let quantities = (rows.quantities.iter().enumerate())
            .map(|(k, (name, value))| Quantity {
                name,
                observable: self.observe(set, ObservableKind::Joint(place, k), *value),
            })
            .collect();
        let first_row = set.rows.len();
        let total = rows.residuals.len() + usize::from(rows.velocity.is_some());
        let moving = moving_rows(self.mechanism, &joint.kind, total);
        for (k, (suffix, phi)) in rows.residuals.into_iter().enumerate() {
            let name = if suffix.is_empty() { name.clone() } else { format!("{name}.{suffix}") };
            let operands_move = moving.contains(&k);
            set.rows.push(ConstraintRow { name, joint: place, phi, velocity: None, operands_move });
        }
        if let Some(velocity) = rows.velocity {
            let (name, phi, operands_move) = (name.clone(), self.graph.zero(), !moving.is_empty());
            set.rows.push(ConstraintRow { name, joint: place, phi, velocity: Some(velocity), operands_move });
        }
        let count = set.rows.len() - first_row;
        if let Some(point) = self.outline.take() {
            set.curves.push(CurveInstance { joint: place, point });
        }
        let tag = tag(&joint.kind);
        set.joints.push(JointInstance {
            name,
            origin: joint.keyword,
            family,
            tag,
            frames: rows.frames,
            first_row,
            rows: count,
            geometry,
            quantities,
        });
    }

    fn guesses(&mut self, set: &mut ConstraintSet) {
        for guess in &self.mechanism.guesses {
            for (_, index) in Self::instances(guess.range) {
                self.index = index;
                let coordinate = match &guess.target {
                    GuessTarget::Pose(body, component) => match self.frame(body) {
                        Some(Frame::Body(place)) => self.coordinates_of[place][*component as usize],
                        _ => None,
                    },
                    GuessTarget::Scalar(member) => self.scalar(member),
                };
                let value = self.formula(&guess.value);
                match coordinate {
                    Some(coordinate) => set.guesses.push((coordinate, value)),
                    None => {
                        self.error(guess.origin, "this coordinate does not vary, so it cannot have a guess");
                    }
                }
            }
        }
    }
}

/// The kind without operands.
fn tag(kind: &JointKind) -> JointTag {
    match kind {
        JointKind::Revolute { .. } => JointTag::Revolute,
        JointKind::Translational { .. } => JointTag::Translational,
        JointKind::Fixed { .. } => JointTag::Fixed,
        JointKind::PointOnLine { .. } => JointTag::PointOnLine,
        JointKind::Distance { .. } => JointTag::Distance,
        JointKind::Coordinate { component: Component::Y, .. } => JointTag::Y,
        JointKind::Coordinate { .. } => JointTag::X,
        JointKind::Angle { .. } => JointTag::Angle,
        JointKind::RelativeAngle { .. } => JointTag::RelativeAngle,
        JointKind::OnCurve { curve: Curve::Polar { .. }, .. } => JointTag::OnPolarCurve,
        JointKind::OnCurve { curve: Curve::Implicit { .. }, .. } => JointTag::OnImplicitCurve,
        JointKind::OnCurve { curve: Curve::Parametric { .. }, .. } => JointTag::OnParametricCurve,
        JointKind::FlatFollower { .. } => JointTag::FlatFollower,
        JointKind::Gear { .. } => JointTag::Gear,
        JointKind::Belt { .. } => JointTag::Belt,
        JointKind::RackPinion { .. } => JointTag::RackPinion,
        JointKind::RollingOnLine { .. } => JointTag::RollingOnLine,
        JointKind::RollingOnDisc { .. } => JointTag::RollingOnDisc,
        JointKind::Constraint { .. } => JointTag::Constraint,
        JointKind::KnifeEdge { .. } => JointTag::KnifeEdge,
        JointKind::Speed { .. } => JointTag::Speed,
        JointKind::Nonholonomic { .. } => JointTag::Nonholonomic,
        JointKind::Driver { .. } => JointTag::Driver,
    }
}

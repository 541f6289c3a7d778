//! Assembly: walks the mechanism, lays out its families, and asks every joint for its rows.

use super::set::{
    BodyInstance, ConstraintRow, ConstraintSet, Coordinate, CoordinateKind, DefineInstance, Frame, Geometry,
    JointInstance, JointTag, Observable, ObservableKind, PointInstance, Quantity, Role,
};
use super::{angle, coordinate, distance, driver, fixed, point_on_line, revolute, translational};
use crate::error::{ModelError, Origin};
use crate::expr::{ExprId, Graph, Symbol};
use crate::mechanism::{
    Axis, BodyOrigin, BodyRef, Component, Formula, Function, GuessTarget, Joint, JointKind, Mechanism, Member, Place,
    Range,
};

/// A point in the inertial frame: r = r_i + A_i s.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedPoint {
    pub(super) frame: Frame,
    /// s.
    pub(super) local: [ExprId; 2],
    /// r_i.
    pub(super) base: [ExprId; 2],
    /// r.
    pub(super) r: [ExprId; 2],
    /// φ_i.
    pub(super) angle: ExprId,
}

/// A unit axis fixed in a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedAxis {
    /// v̂ in the frame.
    pub(super) local: [ExprId; 2],
    /// u = A v̂.
    pub(super) u: [ExprId; 2],
    /// The angle it turns with.
    pub(super) angle: ExprId,
}

/// What a joint hands back: rows as (suffix of the name, residual), and what it reports.
#[derive(Default)]
pub(super) struct Rows {
    pub(super) residuals: Vec<(&'static str, ExprId)>,
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
    mechanism: &'m Mechanism,
    pub(super) graph: Graph,
    /// First instance of every body family, and the instances' poses as far as known.
    first_body: Vec<usize>,
    poses: Vec<Option<[ExprId; 3]>>,
    coordinates_of: Vec<[Option<u32>; 3]>,
    first_scalar: Vec<u32>,
    first_parameter: Vec<u32>,
    /// The index variable of the range that is being laid out.
    index: i64,
    /// Defines and poses that are being built, to stop at a cycle.
    depth: usize,
    errors: Vec<ModelError>,
}

/// Nesting of defines and carried origins beyond which there must be a cycle.
const MAX_DEPTH: usize = 512;

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
    assembly.guesses(&mut set);
    set.graph = assembly.graph;
    if assembly.errors.is_empty() { Ok(set) } else { Err(assembly.errors) }
}

/// `name` or `name[index]`.
fn indexed(name: &str, is_array: bool, index: impl core::fmt::Display) -> String {
    if is_array { format!("{name}[{index}]") } else { name.to_owned() }
}

impl<'m> Assembly<'m> {
    fn new(mechanism: &'m Mechanism, set: &mut ConstraintSet) -> Self {
        let mut first_parameter = Vec::new();
        for parameter in &mechanism.parameters {
            first_parameter.push(set.parameters.len() as u32);
            for index in 0..parameter.len.unwrap_or(1) {
                set.parameters.push(indexed(&parameter.name, parameter.len.is_some(), index));
            }
        }
        set.functions = mechanism.functions.iter().map(|f| f.name.clone()).collect();
        set.inputs = mechanism.inputs.iter().map(|input| input.name.clone()).collect();
        let (mut first_body, mut coordinates_of) = (Vec::new(), Vec::new());
        for (family, body) in mechanism.bodies.iter().enumerate() {
            first_body.push(coordinates_of.len());
            let held = match &body.origin_at {
                BodyOrigin::Free { x, y } => [x.is_some(), y.is_some(), body.phi.is_some()],
                BodyOrigin::Carried(_) => [true, true, body.phi.is_some()],
            };
            for index in 0..body.len.unwrap_or(1) {
                let name = indexed(&body.name, body.len.is_some(), index);
                let place = coordinates_of.len();
                let coordinates = std::array::from_fn(|c| {
                    (!held[c]).then(|| {
                        let component = Component::ALL[c];
                        set.coordinates.push(Coordinate {
                            name: format!("{name}.{component}"),
                            kind: CoordinateKind::Pose(place, component),
                        });
                        set.coordinates.len() as u32 - 1
                    })
                });
                coordinates_of.push(coordinates);
                set.bodies.push(BodyInstance {
                    name,
                    family: (family, index),
                    coordinates,
                    carried_by: None,
                    pose: [ExprId::default(); 3],
                    observables: [0; 3],
                });
            }
        }
        let mut first_scalar = Vec::new();
        for scalar in &mechanism.scalars {
            first_scalar.push(set.coordinates.len() as u32);
            for index in 0..scalar.len.unwrap_or(1) {
                let name = indexed(&scalar.name, scalar.len.is_some(), index);
                set.coordinates.push(Coordinate { name, kind: CoordinateKind::Scalar });
            }
        }
        let poses = vec![None; coordinates_of.len()];
        Self {
            mechanism,
            graph: Graph::new(),
            first_body,
            poses,
            coordinates_of,
            first_scalar,
            first_parameter,
            index: 0,
            depth: 0,
            errors: Vec::new(),
        }
    }

    fn error(&mut self, origin: Origin, message: impl Into<String>) -> ExprId {
        self.errors.push(ModelError::new(origin, message));
        self.graph.zero()
    }

    fn observe(&self, set: &mut ConstraintSet, kind: ObservableKind, value: ExprId) -> usize {
        set.observables.push(Observable { kind, value });
        set.observables.len() - 1
    }

    fn bodies(&mut self, set: &mut ConstraintSet) {
        for place in 0..set.bodies.len() {
            let (family, index) = set.bodies[place].family;
            let pose = self.pose_of(place, Origin::default());
            if let BodyOrigin::Carried(carrier) = &self.mechanism.bodies[family].origin_at {
                self.index = index as i64;
                set.bodies[place].carried_by = self.frame(&carrier.body);
            }
            set.bodies[place].pose = pose;
            set.bodies[place].observables = std::array::from_fn(|c| {
                self.observe(set, ObservableKind::Pose(place, Component::ALL[c]), pose[c])
            });
        }
    }

    /// The instances of a range: a single one, or one for every index.
    fn instances(range: Option<Range>) -> Vec<(Option<i64>, i64)> {
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
                self.index = index;
                let value = self.formula(&define.formula);
                let observable = self.observe(set, ObservableKind::Define(set.defines.len()), value);
                set.defines.push(DefineInstance {
                    name: indexed(&define.name, shown.is_some(), index),
                    family: (family, index.max(0) as usize),
                    observable,
                    varies: !self.graph.depends(value).is_static(),
                });
            }
        }
    }

    fn joints(&mut self, set: &mut ConstraintSet) {
        for (family, joint) in self.mechanism.joints.iter().enumerate() {
            for (shown, index) in Self::instances(joint.range) {
                self.index = index;
                let rows = self.rows_of(joint);
                self.write(set, joint, (family, index), indexed(&joint.name, shown.is_some(), index), rows);
            }
        }
    }

    fn rows_of(&mut self, joint: &Joint) -> Rows {
        match &joint.kind {
            JointKind::Revolute { p, q } => revolute::rows(self, p, q),
            JointKind::Translational { p, q, axis, angle } => translational::rows(self, p, q, axis, angle),
            JointKind::Fixed { p, q, angle } => fixed::rows(self, p, q, angle),
            JointKind::PointOnLine { p, q, axis, offset } => point_on_line::rows(self, p, q, axis, offset),
            JointKind::Distance { p, q, length, .. } => distance::rows(self, p, q, length),
            JointKind::Coordinate { p, component, value } => coordinate::rows(self, p, *component, value),
            JointKind::Angle { body, value } => angle::absolute(self, body, value),
            JointKind::RelativeAngle { a, b, value } => angle::relative(self, a, b, value),
            JointKind::Constraint { left, right } => driver::equation(self, left, right),
            JointKind::Driver { left, right } => driver::rows(self, left, right),
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
        let (first_row, count) = (set.rows.len(), rows.residuals.len());
        for (suffix, phi) in rows.residuals {
            let name = if suffix.is_empty() { name.clone() } else { format!("{name}.{suffix}") };
            set.rows.push(ConstraintRow { name, joint: place, phi });
        }
        let tag = tag(&joint.kind);
        set.joints.push(JointInstance {
            name,
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

    /// The frame that a body reference means at the current index.
    pub(super) fn frame(&mut self, body: &BodyRef) -> Option<Frame> {
        match body {
            BodyRef::Ground(_) => Some(Frame::Ground),
            BodyRef::Body { family, index, origin } => {
                let len = self.mechanism.bodies.get(*family).map_or(0, |b| b.len.unwrap_or(1));
                let found = index.at(self.index).filter(|i| *i < len);
                if found.is_none() {
                    self.error(*origin, format!("the index is out of range: there are {len} bodies of this name"));
                }
                found.map(|i| Frame::Body(self.first_body[*family] + i))
            }
        }
    }

    /// x, y, φ of a body at the current index.
    pub(super) fn pose(&mut self, body: &BodyRef) -> [ExprId; 3] {
        match self.frame(body) {
            Some(Frame::Body(place)) => self.pose_of(place, body.origin()),
            _ => [self.graph.zero(); 3],
        }
    }

    fn pose_of(&mut self, place: usize, origin: Origin) -> [ExprId; 3] {
        if let Some(pose) = self.poses[place] {
            return pose;
        }
        if self.depth > MAX_DEPTH {
            return [self.error(origin, "this origin is carried by itself, directly or through other bodies"); 3];
        }
        let family = self.first_body.partition_point(|first| *first <= place) - 1;
        let outer = std::mem::replace(&mut self.index, (place - self.first_body[family]) as i64);
        self.depth += 1;
        let body = &self.mechanism.bodies[family];
        let [x, y] = match &body.origin_at {
            BodyOrigin::Free { x, y } => {
                [self.held_or_free(x.as_ref(), place, 0), self.held_or_free(y.as_ref(), place, 1)]
            }
            BodyOrigin::Carried(carrier) => self.place(carrier).r,
        };
        let phi = self.held_or_free(body.phi.as_ref(), place, 2);
        self.depth -= 1;
        self.index = outer;
        self.poses[place] = Some([x, y, phi]);
        [x, y, phi]
    }

    fn held_or_free(&mut self, held: Option<&Formula>, place: usize, component: usize) -> ExprId {
        match (held, self.coordinates_of[place][component]) {
            (Some(formula), _) => self.formula(formula),
            (None, Some(k)) => self.graph.symbol(Symbol::Coordinate(k)),
            (None, None) => self.graph.zero(),
        }
    }

    /// A body-fixed point in the inertial frame.
    pub(super) fn place(&mut self, place: &Place) -> PlacedPoint {
        let frame = self.frame(&place.body).unwrap_or(Frame::Ground);
        let [x, y, angle] = self.pose(&place.body);
        let local = [self.formula(&place.x), self.formula(&place.y)];
        let rho = self.graph.rotate(angle, local);
        let r = [self.graph.add(x, rho[0]), self.graph.add(y, rho[1])];
        PlacedPoint { frame, local, base: [x, y], r, angle }
    }

    /// The unit vector of an axis fixed in the frame of `p`, v̂ = v/|v|.
    pub(super) fn axis(&mut self, axis: &Axis, p: &PlacedPoint) -> PlacedAxis {
        let v = [self.formula(&axis.x), self.formula(&axis.y)];
        let local = match (self.graph.literal(v[0]), self.graph.literal(v[1])) {
            (Some(x), Some(y)) => {
                let norm = x.hypot(y);
                if norm == 0.0 {
                    self.error(axis.origin, "an axis of length zero has no direction");
                    v
                } else {
                    [self.graph.number(x / norm), self.graph.number(y / norm)]
                }
            }
            _ => {
                let square = self.graph.plain_dot(v, v);
                let norm = self.graph.call(Function::Sqrt, square);
                [self.graph.div(v[0], norm), self.graph.div(v[1], norm)]
            }
        };
        PlacedAxis { local, u: self.graph.rotate(p.angle, local), angle: p.angle }
    }

    fn scalar(&mut self, member: &Member) -> Option<u32> {
        let len = self.mechanism.scalars.get(member.family)?.len.unwrap_or(1);
        let index = member.index.at(self.index).filter(|i| *i < len)?;
        Some(self.first_scalar[member.family] + index as u32)
    }

    /// A formula at the current index.
    pub(super) fn formula(&mut self, formula: &Formula) -> ExprId {
        match formula {
            Formula::Number(value) => self.graph.number(*value),
            Formula::Pi => self.graph.number(core::f64::consts::PI),
            Formula::Time => self.graph.symbol(Symbol::Time),
            Formula::Parameter(member) => {
                let len = self.mechanism.parameters.get(member.family).map_or(0, |p| p.len.unwrap_or(1));
                match member.index.at(self.index).filter(|i| *i < len) {
                    Some(i) => {
                        let first = self.first_parameter[member.family];
                        self.graph.symbol(Symbol::Parameter(first + i as u32))
                    }
                    None => {
                        self.error(member.origin, format!("the index is out of range: the array has {len} elements"))
                    }
                }
            }
            Formula::Input(member) => self.graph.symbol(Symbol::Input(member.family as u32, 0)),
            Formula::Pose(body, component) => self.pose(body)[*component as usize],
            Formula::Scalar(member) => match self.scalar(member) {
                Some(k) => self.graph.symbol(Symbol::Coordinate(k)),
                None => self.error(member.origin, "the index is out of range"),
            },
            Formula::PointCoordinate(place, component) => {
                let r = self.place(place).r;
                r[usize::from(*component != Component::X)]
            }
            Formula::Distance(p, q) => {
                let (p, q) = (self.place(p), self.place(q));
                distance::length(self, &p, &q)
            }
            Formula::Define(member) => self.define(member),
            Formula::Neg(a) => {
                let a = self.formula(a);
                self.graph.neg(a)
            }
            Formula::Add(a, b) => self.binary(a, b, Graph::add),
            Formula::Sub(a, b) => self.binary(a, b, Graph::sub),
            Formula::Mul(a, b) => self.binary(a, b, Graph::mul),
            Formula::Div(a, b, origin) => {
                let (a, b) = (self.formula(a), self.formula(b));
                if self.graph.is_zero(b) {
                    return self.error(*origin, "division by zero");
                }
                self.graph.div(a, b)
            }
            Formula::Pow(a, n) => {
                let a = self.formula(a);
                self.graph.powf(a, *n)
            }
            Formula::Call(f, a) => {
                let a = self.formula(a);
                self.graph.call(*f, a)
            }
            Formula::Atan2(y, x) => self.binary(y, x, Graph::atan2),
            Formula::Supplied(member, a) => {
                let a = self.formula(a);
                self.graph.supplied(member.family as u32, 0, a)
            }
        }
    }

    fn binary(
        &mut self,
        a: &Formula,
        b: &Formula,
        f: impl FnOnce(&mut Graph, ExprId, ExprId) -> ExprId,
    ) -> ExprId {
        let (a, b) = (self.formula(a), self.formula(b));
        f(&mut self.graph, a, b)
    }

    fn define(&mut self, member: &Member) -> ExprId {
        let Some(define) = self.mechanism.defines.get(member.family) else { return self.graph.zero() };
        if self.depth > MAX_DEPTH {
            return self.error(member.origin, format!("`{}` is defined by itself", define.name));
        }
        let index = member.index.at(self.index).map_or(0, |i| i as i64);
        let outer = std::mem::replace(&mut self.index, index);
        self.depth += 1;
        let value = self.formula(&define.formula);
        self.depth -= 1;
        self.index = outer;
        value
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
        JointKind::Constraint { .. } => JointTag::Constraint,
        JointKind::Driver { .. } => JointTag::Driver,
    }
}

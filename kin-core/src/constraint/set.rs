//! The constraint set: Φ with everything that is reported about it, families expanded into members.

use crate::error::Origin;
use crate::expr::{ExprId, Graph, Names, Symbol};
use crate::mechanism::Component;
use crate::vocabulary::{Frame, JointKind, Role, UnknownKind};
use core::fmt;
use std::collections::BTreeSet;

/// The kind of a generalized coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// A component of the pose of a body, which is given by its index.
    Pose(usize, Component),
    /// A scalar coordinate.
    Scalar,
}

impl CoordinateKind {
    /// True for x and y of a body. Scalar coordinates count as dimensionless, because they need not have a unit.
    pub fn is_length(self) -> bool {
        matches!(self, Self::Pose(_, Component::X | Component::Y))
    }
}

/// An entry of q.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// `crank.phi`, `link[3].x` or the scalar's name.
    pub name: String,
    /// The kind of the coordinate.
    pub kind: CoordinateKind,
    /// True for coordinates of bodies that are lengths, and for scalars of which the rows contain no sine, cosine,
    /// exponential, logarithm or supplied function: powers and roots alone, as of lengths. Columns of Φ_q for such
    /// coordinates have a common scale of their own, which depends on the unit.
    pub scales_with_length: bool,
}

impl Coordinate {
    /// What kind of unknown of an iteration it is.
    pub fn unknown_kind(&self) -> UnknownKind {
        match self.kind {
            _ if self.scales_with_length => UnknownKind::Length,
            CoordinateKind::Pose(..) => UnknownKind::Angle,
            CoordinateKind::Scalar => UnknownKind::Scalar,
        }
    }
}

/// A body and its pose.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyInstance {
    /// `crank` or `link[3]`.
    pub name: String,
    /// The index of the body's family in the mechanism, and the body's index in the family.
    pub family: (usize, usize),
    /// The indices in q of x, y, φ; `None` for components that are held or carried.
    pub coordinates: [Option<u32>; 3],
    /// The body that carries the origin.
    pub carried_by: Option<Frame>,
    /// The point of the carrier at which the origin is, in the carrier's frame.
    pub carried_at: Option<[ExprId; 2]>,
    /// The expressions of x, y, φ.
    pub pose: [ExprId; 3],
    /// The observables of x, y, φ.
    pub observables: [usize; 3],
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointInstance {
    /// The name of the point.
    pub name: String,
    /// The index of the point's family in the mechanism, and the point's index in the family.
    pub family: (usize, usize),
    /// The body that the point belongs to.
    pub frame: Frame,
    /// The index of the point's body-fixed coordinates in [`ConstraintSet::geometry`].
    pub local: usize,
    /// The observables of x and y.
    pub observables: [usize; 2],
}

/// A named expression.
#[derive(Clone, Debug, PartialEq)]
pub struct DefineInstance {
    /// The name of the expression.
    pub name: String,
    /// The token that declares it.
    pub origin: Origin,
    /// The index of its family in the mechanism, and its index in the family.
    pub family: (usize, usize),
    /// The observable.
    pub observable: usize,
    /// True if the expression contains coordinates, t or inputs.
    pub varies: bool,
}

/// A geometric operand of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// The role of the operand.
    pub role: Role,
    /// The frame in which it is fixed.
    pub frame: Frame,
    /// The index of its first number in [`ConstraintSet::geometry`].
    pub offset: usize,
}

/// A quantity that a joint reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// `angle`, `stroke`, `distance`, `length` or `theta`.
    pub name: &'static str,
    /// The observable.
    pub observable: usize,
}

/// A joint and its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct JointInstance {
    /// `A` or `N[3]`.
    pub name: String,
    /// The token of the keyword.
    pub keyword: Origin,
    /// The index of the joint's family in the mechanism, and the joint's index in the family.
    pub family: (usize, i64),
    /// The kind of joint.
    pub kind: JointKind,
    /// The frames of the operands.
    pub frames: [Option<Frame>; 2],
    /// The index of the first row.
    pub first_row: usize,
    /// The number of rows.
    pub rows: usize,
    /// The geometric operands, for drawings.
    pub geometry: Vec<Geometry>,
    /// The quantities that the joint reports.
    pub quantities: Vec<Quantity>,
}

/// The curve of a joint for drawings, in the frame of the joint's first operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurveInstance {
    /// The index of the joint.
    pub joint: usize,
    /// x, y and their derivatives with respect to the argument of the curve, as functions of [`Symbol::ARGUMENT`].
    pub point: [ExprId; 4],
}

/// The geometric meaning of a row of Φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowMeaning {
    /// A component of r_Q − r_P: 0 for x, 1 for y.
    Coincidence(usize),
    /// A component of r_P minus the joint's value: 0 for x, 1 for y.
    Coordinate(usize),
    /// perp(A v̂)·(r_Q − r_P), minus the offset if there is one.
    AcrossAxis(Option<ExprId>),
    /// |r_Q − r_P|² − e².
    SquaredDistance,
    /// The angle of a body, or between two bodies.
    Angle,
    /// Any other meaning.
    Other,
}

/// A row of Φ or of velocity level.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstraintRow {
    /// `A.x`, or the joint's name if it has a single row.
    pub name: String,
    /// The index of the joint.
    pub joint: usize,
    /// The residual; 0 for a row of velocity level.
    pub phi: ExprId,
    /// The geometric meaning.
    pub meaning: RowMeaning,
    /// The equation of a row of velocity level.
    pub velocity: Option<VelocityRow>,
    /// True if the joint's own operands for this row contain t or an input; false if t enters only by the pose of a
    /// body.
    pub operands_move: bool,
}

/// A row of velocity level, η = B(q, t) q̇ + b(q, t) = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VelocityRow {
    /// The expression η, in which rates are symbols.
    pub eta: ExprId,
    /// The expression b, which is η for q̇ = 0.
    pub b: ExprId,
}

/// A unilateral condition: an inequality that is monitored but not solved.
#[derive(Clone, Debug, PartialEq)]
pub struct ConditionInstance {
    /// `limit` or `limit[3]`.
    pub name: String,
    /// The index of its family in the mechanism, and its index in the family.
    pub family: (usize, i64),
    /// The inequality as the user wrote it.
    pub text: String,
    /// The observable g: the side that is to be larger minus the other one.
    pub observable: usize,
    /// The number of observables that follow it: expressions at whose zeros g has a corner.
    pub corners: usize,
    /// True if the condition contains t or an input.
    pub rheonomic: bool,
    /// The token that declares it.
    pub origin: Origin,
}

/// A family after expansion; its members are consecutive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Family {
    /// The name without index.
    pub name: String,
    /// The index of the first body or row of the first member.
    pub first: usize,
    /// The number of members.
    pub members: usize,
    /// The number of bodies or rows of a member; those of member k start at `first + k * stride`.
    pub stride: usize,
}

/// The kind of an observable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservableKind {
    /// x, y or φ of a body.
    Pose(usize, Component),
    /// x or y of a point.
    Point(usize, Component),
    /// A named expression.
    Define(usize),
    /// A quantity of a joint: the index of the joint, and the index of the quantity in its list.
    Joint(usize, usize),
    /// A unilateral condition.
    Condition(usize),
}

/// A value that is reported together with its rate and acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observable {
    /// The kind of the observable.
    pub kind: ObservableKind,
    /// The expression of the value.
    pub value: ExprId,
}

/// Φ of a mechanism, its coordinates, and everything that is reported.
#[derive(Clone, Debug, Default)]
pub struct ConstraintSet {
    /// The name of the mechanism.
    pub name: String,
    /// The graph of all expressions.
    pub graph: Graph,
    /// The names of the parameters; arrays element by element.
    pub parameters: Vec<String>,
    /// The names of the supplied functions; arrays element by element.
    pub functions: Vec<String>,
    /// The names of the inputs; arrays element by element.
    pub inputs: Vec<String>,
    /// The entries of q.
    pub coordinates: Vec<Coordinate>,
    /// The bodies.
    pub bodies: Vec<BodyInstance>,
    /// The named points.
    pub points: Vec<PointInstance>,
    /// The named expressions.
    pub defines: Vec<DefineInstance>,
    /// The joints.
    pub joints: Vec<JointInstance>,
    /// The curves of joints.
    pub curves: Vec<CurveInstance>,
    /// The rows of Φ.
    pub rows: Vec<ConstraintRow>,
    /// The distances of points that may coincide, among the expressions.
    pub distances: BTreeSet<ExprId>,
    /// The unilateral conditions.
    pub conditions: Vec<ConditionInstance>,
    /// The observables.
    pub observables: Vec<Observable>,
    /// The numbers of the geometry: body-fixed coordinates of points, axes, values and radii.
    pub geometry: Vec<ExprId>,
    /// The families of bodies, by indices of `bodies`.
    pub body_families: Vec<Family>,
    /// The families of rows, by indices of `rows`.
    pub row_families: Vec<Family>,
    /// The coordinates that have a guess, each with its value.
    pub guesses: Vec<(u32, ExprId)>,
}

impl Names for ConstraintSet {
    fn symbol(&self, symbol: Symbol) -> String {
        let name = |list: &[String], k: u32| list.get(k as usize).cloned().unwrap_or_default();
        match symbol {
            Symbol::Parameter(k) => name(&self.parameters, k),
            Symbol::Time => "t".to_owned(),
            Symbol::Input(k, order) => self.rate_name(&name(&self.inputs, k), order),
            Symbol::Coordinate(k) => self.coordinate_name(k).to_owned(),
            Symbol::Rate(k) => self.rate_name(self.coordinate_name(k), 1),
            Symbol::Acceleration(k) => self.rate_name(self.coordinate_name(k), 2),
            Symbol::Start(k) => format!("{}_start", self.coordinate_name(k)),
            Symbol::Unknown(k) => self.coordinate_name(k).to_owned(),
            other => other.of_plan(),
        }
    }

    fn function(&self, index: u32) -> String {
        self.functions.get(index as usize).cloned().unwrap_or_default()
    }
}

impl ConstraintSet {
    /// The lengths that joints prescribe (links, cylinders, drivers of distances), in the order of the joints.
    pub fn kept_lengths(&self) -> impl Iterator<Item = ExprId> + '_ {
        let has = |joint: &JointInstance, role: Role| joint.geometry.iter().any(|piece| piece.role == role);
        let keeps = move |joint: &&JointInstance| joint.kind.keeps_length(has(joint, Role::Q));
        let value = |joint: &JointInstance| {
            let piece = joint.geometry.iter().find(|piece| piece.role == Role::Value)?;
            self.geometry.get(piece.offset).copied()
        };
        self.joints.iter().filter(keeps).filter_map(value)
    }

    /// The meanings of the rows of a joint.
    pub fn meanings(&self, joint: &JointInstance) -> Vec<RowMeaning> {
        let rows = self.rows.get(joint.first_row..joint.first_row + joint.rows).unwrap_or_default();
        rows.iter().map(|row| row.meaning).collect()
    }

    /// The name of q_k.
    pub fn coordinate_name(&self, k: u32) -> &str {
        self.coordinates.get(k as usize).map_or("", |c| c.name.as_str())
    }

    /// The name of the derivative of this order of `name`: `u_dot`, or `dot(u)` if the user has given the name `u_dot`
    /// to something else.
    pub(crate) fn rate_name(&self, name: &str, order: u8) -> String {
        let suffix = crate::expr::suffix(order);
        let rate = format!("{name}{suffix}");
        // Names with a dot or an index are no identifiers, and neither are those of their rates.
        let mut given = (self.parameters.iter().chain(&self.inputs))
            .chain(self.coordinates.iter().map(|coordinate| &coordinate.name));
        match order > 0 && !name.contains(['.', '[']) && given.any(|given| *given == rate) {
            true => format!("{}({name})", suffix.trim_start_matches('_')),
            false => rate,
        }
    }

    /// The name of input `k`.
    pub fn input_name(&self, k: u32) -> &str {
        self.inputs.get(k as usize).map_or("", String::as_str)
    }

    /// The text of `id` in the user's names.
    pub fn show(&self, id: ExprId) -> String {
        crate::expr::Shown { graph: &self.graph, names: self, id }.to_string()
    }
}

impl fmt::Display for ConstraintSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} coordinates, {} rows", self.name, self.coordinates.len(), self.rows.len())?;
        for row in &self.rows {
            let value = row.velocity.map_or(row.phi, |velocity| velocity.eta);
            writeln!(f, "  {}: {} = 0", row.name, self.show(value))?;
        }
        for condition in &self.conditions {
            let value = self.observables.get(condition.observable).map(|observable| self.show(observable.value));
            writeln!(f, "  {}: {} > 0", condition.name, value.unwrap_or_default())?;
        }
        Ok(())
    }
}

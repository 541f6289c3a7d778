//! The constraint set: Φ with everything that is reported about it, all families laid out.

use crate::error::Origin;
use crate::expr::{ExprId, Graph, Names, Symbol};
use crate::mechanism::Component;
use crate::vocabulary::{Frame, JointKind, Role};
use core::fmt;

/// What a generalized coordinate is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// Of a body's pose.
    Pose(usize, Component),
    /// A scalar coordinate.
    Scalar,
}

impl CoordinateKind {
    /// True for x and y of a body: what counts in units of length. Scalars say nothing of what they are.
    pub fn is_length(self) -> bool {
        matches!(self, Self::Pose(_, Component::X | Component::Y))
    }
}

/// An entry of q.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// `crank.phi`, `link[3].x` or the scalar's name.
    pub name: String,
    /// What it is.
    pub kind: CoordinateKind,
}

/// A body with its pose.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyInstance {
    /// `crank` or `link[3]`.
    pub name: String,
    /// Place of its family in the mechanism, and its index there.
    pub family: (usize, usize),
    /// Places in q of x, y, φ; `None` where held or carried.
    pub coordinates: [Option<u32>; 3],
    /// The body that carries its origin.
    pub carried_by: Option<Frame>,
    /// The point of that body which is its origin.
    pub carried_at: Option<[ExprId; 2]>,
    /// x, y, φ.
    pub pose: [ExprId; 3],
    /// Observables of x, y, φ.
    pub observables: [usize; 3],
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointInstance {
    /// Its name.
    pub name: String,
    /// Place of its family in the mechanism, and its index there.
    pub family: (usize, usize),
    /// The body that carries it.
    pub frame: Frame,
    /// Place of its body-fixed coordinates in the geometry.
    pub local: usize,
    /// Observables of x and y.
    pub observables: [usize; 2],
}

/// A named expression.
#[derive(Clone, Debug, PartialEq)]
pub struct DefineInstance {
    /// Its name.
    pub name: String,
    /// The token that declared it.
    pub origin: Origin,
    /// Place of its family in the mechanism, and its index there.
    pub family: (usize, usize),
    /// Its observable.
    pub observable: usize,
    /// True when it holds coordinates, t or inputs.
    pub varies: bool,
}

/// A piece of geometry of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// What it is for.
    pub role: Role,
    /// The frame it is fixed in.
    pub frame: Frame,
    /// Place of its first number in [`ConstraintSet::geometry`].
    pub offset: usize,
}

/// A quantity that a joint reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// `angle`, `stroke` or `distance`.
    pub name: &'static str,
    /// Its observable.
    pub observable: usize,
}

/// A joint with its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct JointInstance {
    /// `A` or `N[3]`.
    pub name: String,
    /// The keyword's token.
    pub origin: Origin,
    /// Place of its family in the mechanism, and its index there.
    pub family: (usize, i64),
    /// Kind.
    pub kind: JointKind,
    /// Frames of the operands.
    pub frames: [Option<Frame>; 2],
    /// First row.
    pub first_row: usize,
    /// Number of rows.
    pub rows: usize,
    /// For a drawing.
    pub geometry: Vec<Geometry>,
    /// What it reports.
    pub quantities: Vec<Quantity>,
}

/// The curve of a joint, for a drawing, in the frame of the joint's first operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurveInstance {
    /// Its joint.
    pub joint: usize,
    /// x, y and their derivatives by the curve's argument, as formulas of [`Symbol::ARGUMENT`].
    pub point: [ExprId; 4],
}

/// What a row of Φ says of the points, axes and bodies of its joint, as far as others can use it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowMeaning {
    /// A coordinate of r_Q − r_P: 0 for x, 1 for y.
    Coincidence(usize),
    /// A coordinate of r_P, 0 for x, 1 for y, minus the joint's value.
    Coordinate(usize),
    /// perp(A v̂)·(r_Q − r_P), minus an offset where there is one.
    AcrossAxis(Option<ExprId>),
    /// |r_Q − r_P|² − e².
    SquaredDistance,
    /// The angle of a body, or between two.
    Angle,
    /// Something else.
    Other,
}

/// A row of Φ, or of velocity level.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstraintRow {
    /// `A.x`, or the joint's name.
    pub name: String,
    /// Its joint.
    pub joint: usize,
    /// Its residual; 0 for a row of velocity level.
    pub phi: ExprId,
    /// What it says.
    pub meaning: RowMeaning,
    /// What a row of velocity level says.
    pub velocity: Option<VelocityRow>,
    /// True when its own operands contain t or an input; false when t reaches it only through the pose of a body.
    pub operands_move: bool,
}

/// η = B(q, t) q̇ + b(q, t), of a row of velocity level: η = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VelocityRow {
    /// η, with rates as symbols.
    pub eta: ExprId,
    /// b, which is η at q̇ = 0.
    pub b: ExprId,
}

/// A unilateral condition: an inequality that is watched and never solved.
#[derive(Clone, Debug, PartialEq)]
pub struct ConditionInstance {
    /// `limit` or `limit[3]`.
    pub name: String,
    /// Place of its family in the mechanism, and its index there.
    pub family: (usize, i64),
    /// The inequality as it was written.
    pub text: String,
    /// Its observable: by how much the larger side exceeds the other.
    pub observable: usize,
    /// True when t or an input appears.
    pub rheonomic: bool,
    /// Where it was declared.
    pub origin: Origin,
}

/// A family after it has been laid out: its members stand one after another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Family {
    /// Name without index.
    pub name: String,
    /// Place of the first member's first body or row.
    pub first: usize,
    /// Number of members.
    pub members: usize,
    /// Bodies or rows of one member; that of member k begins at `first + k * stride`.
    pub stride: usize,
}

/// What an observable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservableKind {
    /// x, y or φ of a body.
    Pose(usize, Component),
    /// x or y of a point.
    Point(usize, Component),
    /// A named expression.
    Define(usize),
    /// Joint, and place in its quantities.
    Joint(usize, usize),
    /// A unilateral condition.
    Condition(usize),
}

/// Something that is reported with rate and acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observable {
    /// What it is.
    pub kind: ObservableKind,
    /// Its value.
    pub value: ExprId,
}

/// Φ of a mechanism, its coordinates, and everything that is reported.
#[derive(Clone, Debug, Default)]
pub struct ConstraintSet {
    /// Name of the mechanism.
    pub name: String,
    /// The expressions.
    pub graph: Graph,
    /// Parameters, element by element.
    pub parameters: Vec<String>,
    /// Supplied functions, element by element.
    pub functions: Vec<String>,
    /// Inputs.
    pub inputs: Vec<String>,
    /// Entries of q.
    pub coordinates: Vec<Coordinate>,
    /// Bodies.
    pub bodies: Vec<BodyInstance>,
    /// Points.
    pub points: Vec<PointInstance>,
    /// Defines.
    pub defines: Vec<DefineInstance>,
    /// Joints.
    pub joints: Vec<JointInstance>,
    /// Curves of joints.
    pub curves: Vec<CurveInstance>,
    /// Rows of Φ.
    pub rows: Vec<ConstraintRow>,
    /// Unilateral conditions.
    pub conditions: Vec<ConditionInstance>,
    /// Observables.
    pub observables: Vec<Observable>,
    /// Local points, axes and values.
    pub geometry: Vec<ExprId>,
    /// Families of bodies, by place in `bodies`.
    pub body_families: Vec<Family>,
    /// Families of rows, by place in `rows`.
    pub row_families: Vec<Family>,
    /// Guessed coordinates and values.
    pub guesses: Vec<(u32, ExprId)>,
}

impl Names for ConstraintSet {
    fn symbol(&self, symbol: Symbol) -> String {
        let name = |list: &[String], k: u32| list.get(k as usize).cloned().unwrap_or_default();
        match symbol {
            Symbol::Parameter(k) => name(&self.parameters, k),
            Symbol::Time => "t".to_owned(),
            Symbol::Input(k, order) => name(&self.inputs, k) + crate::expr::suffix(order),
            Symbol::Coordinate(k) => self.coordinate_name(k).to_owned(),
            Symbol::Rate(k) => format!("{}_dot", self.coordinate_name(k)),
            Symbol::Acceleration(k) => format!("{}_ddot", self.coordinate_name(k)),
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
    /// The distances that joints keep: links, cylinders, drivers of distances, in the order of the joints.
    pub fn kept_lengths(&self) -> impl Iterator<Item = ExprId> + '_ {
        let has = |joint: &JointInstance, role: Role| joint.geometry.iter().any(|piece| piece.role == role);
        let keeps = move |joint: &&JointInstance| joint.kind.keeps_length(has(joint, Role::Q));
        let value = |joint: &JointInstance| {
            let piece = joint.geometry.iter().find(|piece| piece.role == Role::Value)?;
            self.geometry.get(piece.offset).copied()
        };
        self.joints.iter().filter(keeps).filter_map(value)
    }

    /// What the rows of a joint say.
    pub fn meanings(&self, joint: &JointInstance) -> Vec<RowMeaning> {
        let rows = self.rows.get(joint.first_row..joint.first_row + joint.rows).unwrap_or_default();
        rows.iter().map(|row| row.meaning).collect()
    }

    /// The name of q_k.
    pub fn coordinate_name(&self, k: u32) -> &str {
        self.coordinates.get(k as usize).map_or("", |c| c.name.as_str())
    }

    /// The name of an input.
    pub fn input_name(&self, k: u32) -> &str {
        self.inputs.get(k as usize).map_or("", String::as_str)
    }

    /// `id` as text.
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

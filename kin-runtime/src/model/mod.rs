//! What is known about a mechanism at compile time, whatever the values of its parameters: names, rows, patterns,
//! geometry.
//!
//! Generated code holds one static [`Model`] per mechanism. All indices are 0-based.

use crate::plan::Plan;

mod derivation;
pub(crate) mod forces;
mod handles;
mod joint;
mod text;
mod units;

#[doc(hidden)]
pub use derivation::{EquationText, LineText, StepText};
#[doc(hidden)]
pub use forces::{EffortInfo, ReactionInfo, SpringInfo};
pub use forces::{ForceModel, ForceUnits};
#[doc(hidden)]
pub use forces::{LoadInfo, MassInfo};
pub use handles::{Body, Coordinate, Input, Point, Quantity};
#[doc(hidden)]
pub use joint::Role;
pub use joint::{Geometry, JointInfo, JointKind};
#[doc(hidden)]
pub use kin_core::vocabulary::{Component, Frame, OperationCount};
pub use units::Units;

/// What a generalized coordinate is.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// x, y or φ of a body.
    Pose {
        /// Index in [`Model::bodies`].
        body: usize,
        /// Which of the three.
        component: Component,
    },
    /// A scalar coordinate.
    Scalar,
}

impl CoordinateKind {
    /// True for x and y of a body. A scalar coordinate counts as neither a length nor an angle, because it need not
    /// have a unit.
    pub(crate) fn is_length(self) -> bool {
        matches!(self, Self::Pose { component: Component::X | Component::Y, .. })
    }

    /// True for the angle φ of a body.
    pub(crate) fn is_angle(self) -> bool {
        matches!(self, Self::Pose { component: Component::Phi, .. })
    }
}

/// A generalized coordinate: one entry of q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordinateInfo {
    /// `crank.phi`, `link[3].x`, or the scalar's own name.
    pub name: &'static str,
    /// What it is.
    #[doc(hidden)]
    pub kind: CoordinateKind,
}

/// A parameter, array fields element by element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterInfo {
    /// `l1` or `l[3]`.
    pub name: &'static str,
    /// The unit, as written in the description.
    pub unit: Option<&'static str>,
    /// Default value.
    pub default: Option<f64>,
    /// The field's documentation, first paragraph.
    pub doc: &'static str,
}

/// How the origin of a body is given.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OriginKind {
    /// x and y are generalized coordinates, unless held.
    Free,
    /// The origin is a point of another body.
    Carried(Frame),
}

/// A body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyInfo {
    /// `crank` or `link[3]`.
    pub name: &'static str,
    /// Indices in q of x, y, φ; `None` where held or carried.
    pub coordinates: [Option<usize>; 3],
    /// Where its origin comes from.
    #[doc(hidden)]
    pub origin: OriginKind,
    /// Observables of x, y, φ in [`Model::observables`].
    #[doc(hidden)]
    pub observables: [usize; 3],
}

/// A named point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointInfo {
    /// Its name.
    pub name: &'static str,
    /// The body that carries it.
    #[doc(hidden)]
    pub frame: Frame,
    /// Index of its two body-fixed coordinates in the geometry array.
    #[doc(hidden)]
    pub local: usize,
    /// Observables of x and y in [`Model::observables`].
    #[doc(hidden)]
    pub observables: [usize; 2],
}

/// A named expression, or a quantity that a joint reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DefineInfo {
    /// Its name.
    pub name: &'static str,
    /// Its observable in [`Model::observables`].
    #[doc(hidden)]
    pub observable: usize,
    /// True if it contains coordinates, t or inputs.
    pub varies: bool,
}

/// On which level a row constrains the motion.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// Φ(q, t) = 0: holonomic.
    Position,
    /// η(q, q̇, t) = 0, linear in q̇: non-holonomic; enters velocity and acceleration analysis only.
    Velocity,
}

/// A row of Φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowInfo {
    /// `A.x`, `A.y`, `slide.angle`, or the joint's name where it has one row.
    pub name: &'static str,
    /// Its joint, in [`Model::joints`].
    pub joint: usize,
    /// Holonomic or not.
    #[doc(hidden)]
    pub level: Level,
    /// Rheonomic (t or an input appears) or scleronomic.
    pub rheonomic: bool,
    /// Declared by `driver` or `speed`, or t or an input appears in its own length, angle, offset or right-hand side. A
    /// joint that is rheonomic only because a held coordinate of its body moves does not drive.
    pub driving: bool,
    /// Equation or inequality; every row of Φ is bilateral.
    pub bilateral: bool,
}

/// A unilateral condition: an inequality that is watched and never solved as an equation.
///
/// It is not a row of Φ. Its observable is g, the side that must be larger minus the other one: satisfied while g > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConditionInfo {
    /// `limit` or `limit[3]`; it differs from the names of all joints.
    pub name: &'static str,
    /// The inequality as it is written, a family's with its index variable: `slider.x < stroke`, `link[i].phi > 0`.
    pub text: &'static str,
    /// Its observable in [`Model::observables`].
    #[doc(hidden)]
    pub observable: usize,
    /// The number of observables that follow it: expressions at whose zeros g has a corner, because it contains their
    /// absolute values. Those inside of others come first.
    #[doc(hidden)]
    pub corners: usize,
    /// Rheonomic (t or an input appears) or scleronomic; it is holonomic and unilateral.
    pub rheonomic: bool,
}

/// What an observable is.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observable {
    /// x, y or φ of a body.
    Pose {
        /// Index in [`Model::bodies`].
        body: usize,
        /// Which of the three.
        component: Component,
    },
    /// x or y of a named point.
    Point {
        /// Index in [`Model::points`].
        point: usize,
        /// [`Component::X`] or [`Component::Y`].
        component: Component,
    },
    /// A named expression.
    Define(usize),
    /// A quantity of a joint.
    Joint {
        /// Index in [`Model::joints`].
        joint: usize,
        /// Index in its [`JointInfo::quantities`].
        quantity: usize,
    },
    /// g of a unilateral condition (see [`ConditionInfo`]).
    Condition(usize),
}

/// Sparsity of a Jacobian: the entries in row-major order, and which of them never change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// Number of rows.
    pub rows: usize,
    /// (row, column) of every entry that is not identically zero, row by row.
    pub entries: &'static [(usize, usize)],
    /// Entries that are literal constants: index in `entries` and value.
    pub constants: &'static [(usize, f64)],
}

/// A row that depends on other rows at every pose and for all dimensions: it repeats or contradicts them.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GenericRedundancy {
    /// Index in [`Model::rows`]: of the rows of a circuit the one declared last, where driving rows count as declared
    /// after all others.
    pub row: usize,
    /// The other joints of the circuit, in order of declaration.
    pub circuit: &'static [&'static str],
}

/// Generic ranks: those of Φ_q at a general pose of a mechanism with the same joints, directions, ratios and angle
/// relations, and general dimensions.
///
/// No pose and no dimensions give a larger rank. Smaller ones are possible: a parallelogram with a fifth bar moves only
/// because of its lengths. [`Mobility`](crate::Mobility) distinguishes the two.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Rank of all rows.
    pub rank: usize,
    /// Rank of the rows that do not drive.
    pub rank_without_driving: usize,
    /// Rank of the rows of position level that do not drive.
    pub position_rank_without_driving: usize,
    /// Redundant rows, those that do not drive first.
    pub redundant: &'static [GenericRedundancy],
}

/// Everything about a mechanism that does not depend on numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model {
    /// Name of the struct.
    pub name: &'static str,
    /// First paragraph of its documentation.
    pub doc: &'static str,
    /// Entries of q.
    pub coordinates: &'static [CoordinateInfo],
    /// Parameters, array fields element by element.
    pub parameters: &'static [ParameterInfo],
    /// Inputs.
    pub inputs: &'static [&'static str],
    /// The default value of every input, `default = …`, which the command line and its examples use.
    pub input_defaults: &'static [Option<f64>],
    /// Units of lengths, of time and of named quantities.
    pub units: Units,
    /// Supplied functions, array fields element by element.
    pub functions: &'static [&'static str],
    /// The supplied function, by its index in `functions`, of every argument that
    /// [`Mechanism::write_arguments`](crate::Mechanism::write_arguments) writes.
    #[doc(hidden)]
    pub arguments: &'static [usize],
    /// Bodies.
    pub bodies: &'static [BodyInfo],
    /// Named points.
    pub points: &'static [PointInfo],
    /// Named expressions.
    pub defines: &'static [DefineInfo],
    /// Joints, constraints and drivers in order of declaration.
    pub joints: &'static [JointInfo],
    /// Rows of Φ.
    pub rows: &'static [RowInfo],
    /// Unilateral conditions in order of declaration.
    pub conditions: &'static [ConditionInfo],
    /// Sparsity of Φ_q.
    pub constraint_pattern: Pattern,
    /// The reported quantities besides q.
    #[doc(hidden)]
    pub observables: &'static [Observable],
    /// Sparsity of the observables' Jacobian.
    #[doc(hidden)]
    pub observable_pattern: Pattern,
    /// Coordinates that have a guess, in the order of the values that
    /// [`Mechanism::write_guesses`](crate::Mechanism::write_guesses) writes.
    #[doc(hidden)]
    pub guesses: &'static [usize],
    /// Length of the geometry array.
    #[doc(hidden)]
    pub geometry: usize,
    /// True if a joint follows a curve ([`JointKind::follows_curve`]).
    #[doc(hidden)]
    pub has_curves: bool,
    /// True if the geometry of a joint has a number that may be degenerate for some parameters
    /// ([`JointKind::may_degenerate`]).
    #[doc(hidden)]
    pub has_sizes: bool,
    /// For every row the sums of the sizes of the constant entries of Φ_q: those for x and y of bodies and those for other
    /// coordinates. Empty if a row has none.
    #[doc(hidden)]
    pub least_sizes: &'static [[f64; 2]],
    /// True with `#[mechanism(allow_redundant)]`.
    pub allow_redundant: bool,
    /// Generic ranks and redundant rows; `None` in a model that was written by hand.
    #[doc(hidden)]
    pub structure: Option<Structure>,
    /// The plan that solves the mechanism block by block.
    pub plan: Plan,
    /// Operations of one combined evaluation.
    #[doc(hidden)]
    pub operations: OperationCount,
    /// The layout of the numbers of forces; `None` for a mechanism without masses and loads.
    pub forces: Option<&'static ForceModel>,
    /// The derivation as text; empty without the feature `equations`.
    #[doc(hidden)]
    pub equations: &'static [EquationText],
    /// The closed forms of the plan as text; empty without the feature `equations`, and where there is no plan.
    #[doc(hidden)]
    pub solution: &'static [StepText],
}

impl Model {
    /// A whole turn in the unit of a coordinate: 2π, unless it is a scalar in degrees or turns. These names of units are
    /// those of `units::parse` in kin-core, which is compiled for the command line only.
    #[cfg(feature = "std")]
    pub(crate) fn turn(&self, coordinate: usize) -> f64 {
        match self.coordinates.get(coordinate).and_then(|info| self.units.of(info.name)) {
            Some("deg" | "°") => 360.0,
            Some("rev" | "turn" | "turns") => 1.0,
            _ => core::f64::consts::TAU,
        }
    }

    /// The index in q of the coordinate called `name`: `crank.phi`, `link[3].x`, or a scalar's own name.
    pub fn coordinate(&self, name: &str) -> Option<usize> {
        self.coordinates.iter().position(|coordinate| coordinate.name == name)
    }

    /// The names of a value, its rate and its acceleration: `u`, `u_dot`, `u_ddot`; for a rate `dot(u)`, if something
    /// else is called `u_dot`.
    #[cfg(feature = "std")]
    pub(crate) fn with_rates(&self, name: &str) -> [String; 3] {
        let is_given = |name: &str| {
            let defines = self.defines.iter().map(|define| define.name);
            self.coordinate(name).is_some() || self.inputs.contains(&name) || defines.into_iter().any(|d| d == name)
        };
        ["", "dot", "ddot"].map(|derivative| match format!("{name}_{derivative}") {
            _ if derivative.is_empty() => name.to_owned(),
            given if is_given(&given) => format!("{derivative}({name})"),
            rate => rate,
        })
    }

    /// The input called `name`.
    pub fn input(&self, name: &str) -> Option<Input> {
        self.inputs.iter().position(|input| *input == name).map(Input)
    }

    /// The angles of bodies that are unknowns of iterations.
    #[cfg(any(feature = "std", all(feature = "simd", feature = "alloc")))]
    #[inline(always)]
    pub(crate) fn iterated_angles(&self) -> impl Iterator<Item = usize> + use<> {
        let coordinates = self.coordinates;
        self.plan.iterated_coordinates().filter(move |&k| coordinates[k].kind.is_angle())
    }

    /// True if no coordinate is held or carried and there are no named points: then all poses are coordinates.
    #[cfg(feature = "std")]
    pub(crate) fn poses_are_coordinates(&self) -> bool {
        self.points.is_empty() && self.bodies.iter().all(|body| !body.coordinates.contains(&None))
    }
}

//! The words that all crates share: what kinds of joints there are and what their geometry is for, what kinds of steps a
//! solution plan has, and how far a solution goes.

use core::fmt;

/// What kind of joint, constraint or driver a row belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum JointKind {
    /// r_Q − r_P.
    Revolute,
    /// perp(A_i v̂)·(r_Q − r_P); φ_j − φ_i − c.
    Translational,
    /// r_Q − r_P; φ_j − φ_i − c.
    Fixed,
    /// perp(A_i v̂)·(r_Q − r_P) − e.
    PointOnLine,
    /// |r_Q − r_P|² − e².
    Distance,
    /// x_P − e.
    X,
    /// y_P − e.
    Y,
    /// φ − e.
    Angle,
    /// φ_b − φ_a − e.
    RelativeAngle,
    /// |w| − ρ(θ): a point on a curve in polar form.
    OnPolarCurve,
    /// e(X, Y) at w: a point on a curve in implicit form.
    OnImplicitCurve,
    /// r_Q − r_P − A_i c(u): a point on a curve in parametric form.
    OnParametricCurve,
    /// n·(r_Q − r_P) − h(θ): a flat-faced follower on a cam.
    FlatFollower,
    /// R_a(φ_a − φ_c) + R_b(φ_b − φ_c) − e.
    Gear,
    /// R_a(φ_a − φ_c) − R_b(φ_b − φ_c) − e.
    Belt,
    /// (A_i v̂)·(r_Q − r_P) − R(φ_b − φ_i) − e.
    RackPinion,
    /// A disc on a line: perp(A_i v̂)·d − R; (A_i v̂)·d + R(φ_j − φ_i) − e, where d = r_Q − r_P.
    RollingOnLine,
    /// A disc on a disc: d − (R_i + R_j)(cos ψ, sin ψ); R_i(φ_i − ψ) + R_j(φ_j − ψ) − e.
    RollingOnDisc,
    /// (A_i v̂)·(r_Q − r_P) − p/(2π) (φ_b − φ_i) − e.
    Screw,
    /// Σ |r_{k+1} − r_k| − e.
    Rope,
    /// A free-form holonomic row.
    Constraint,
    /// No velocity of a point across a direction of its body.
    KnifeEdge,
    /// Velocity of a point along a direction of its body.
    Speed,
    /// A free-form row of velocity level.
    Nonholonomic,
    /// A driving constraint.
    Driver,
}

impl JointKind {
    /// The keyword of the language.
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Translational => "translational",
            Self::Fixed => "fixed",
            Self::PointOnLine => "point_on_line",
            Self::Distance => "distance",
            Self::X => "x",
            Self::Y => "y",
            Self::Angle => "angle",
            Self::RelativeAngle => "relative_angle",
            Self::OnPolarCurve | Self::OnImplicitCurve | Self::OnParametricCurve => "on_curve",
            Self::FlatFollower => "flat_follower",
            Self::Gear => "gear",
            Self::Belt => "belt",
            Self::RackPinion => "rack_pinion",
            Self::RollingOnLine | Self::RollingOnDisc => "rolling",
            Self::Screw => "screw",
            Self::Rope => "rope",
            Self::Constraint => "constraint",
            Self::KnifeEdge => "knife_edge",
            Self::Speed => "speed",
            Self::Nonholonomic => "nonholonomic",
            Self::Driver => "driver",
        }
    }
}

impl JointKind {
    /// True for what is declared to drive; a joint may drive, too, with a length or an angle that moves.
    pub const fn drives(self) -> bool {
        matches!(self, Self::Driver | Self::Speed)
    }

    /// True for an equation whose both sides are the user's own formulas.
    pub const fn is_free_equation(self) -> bool {
        matches!(self, Self::Constraint | Self::Nonholonomic | Self::Driver)
    }

    /// True where it keeps a distance between points, which is not negative: a link, a cylinder, a rope, or a driver of a
    /// distance, which is the only driver with a second point.
    pub const fn keeps_length(self, has_second_point: bool) -> bool {
        matches!(self, Self::Distance | Self::Rope) || matches!(self, Self::Driver) && has_second_point
    }
}

impl fmt::Display for JointKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.keyword())
    }
}

/// What kind of mass or load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LoadKind {
    /// A field that pulls every mass.
    Gravity,
    /// A mass with its centre and its moment of inertia.
    Mass,
    /// A force on a point of a body.
    Force,
    /// A couple on a body, or between two.
    Torque,
    /// A spring with a damper between two points.
    Spring,
    /// A spring with a damper between the angles of two bodies.
    TorsionSpring,
}

impl LoadKind {
    /// The keyword of the language.
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Gravity => "gravity",
            Self::Mass => "mass",
            Self::Force => "force",
            Self::Torque => "torque",
            Self::Spring => "spring",
            Self::TorsionSpring => "torsion_spring",
        }
    }
}

impl fmt::Display for LoadKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.keyword())
    }
}

/// What a statement of the language that has operands declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StatementKind {
    /// A joint, constraint or driver: it has rows of Φ.
    Joint(JointKind),
    /// A mass or a load: it has no rows.
    Load(LoadKind),
}

impl StatementKind {
    /// True for a mass or a load.
    pub const fn is_load(self) -> bool {
        matches!(self, Self::Load(_))
    }

    /// The keyword of the language.
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Joint(kind) => kind.keyword(),
            Self::Load(kind) => kind.keyword(),
        }
    }
}

/// What a piece of geometry is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Role {
    /// Body-fixed coordinates of the first operand's point, two numbers.
    P,
    /// Body-fixed coordinates of the second operand's point, two numbers.
    Q,
    /// Body-fixed coordinates of a point between the first and the last, two numbers; in the order of the joint.
    Via,
    /// Unit vector of an axis in the frame it is fixed in, two numbers.
    Axis,
    /// Length, angle, offset or right-hand side, one number; may depend on t and inputs. The frame of a gear's or a
    /// belt's is that of its carrier.
    Value,
    /// Radius of a disc or gear of that frame's body, one number; negative where the other runs inside. A roller's is that
    /// to the left of the curve that it runs on.
    Radius,
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::P => "first point",
            Self::Q => "second point",
            Self::Via => "point between",
            Self::Axis => "axis",
            Self::Value => "value",
            Self::Radius => "radius",
        })
    }
}

/// What kind of step of a solution plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// Given by a formula of what is known.
    Explicit,
    /// A linear system of so many unknowns.
    Linear(usize),
    /// A group that closes without iteration, in one of two ways.
    Closure,
    /// An iteration over so many unknowns.
    Newton(usize),
    /// Redundant rows that all other steps do without, whole or but for a sign that they decide. It gives no coordinate; a
    /// margin for each of them says whether the solution satisfies it, too, with its velocities and accelerations as far
    /// as they are solved.
    Watched,
}

/// How far a solution goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// q.
    Position,
    /// q and q̇.
    Velocity,
    /// q, q̇ and q̈.
    Acceleration,
}

/// How a step is solved.
impl fmt::Display for StepKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Explicit => f.write_str("by formula"),
            Self::Linear(1) => f.write_str("by a linear equation"),
            Self::Linear(n) => write!(f, "by a {n}×{n} linear system"),
            Self::Closure => f.write_str("in closed form"),
            Self::Newton(n) => write!(f, "by a {n}×{n} Newton iteration"),
            Self::Watched => f.write_str("redundant rows watched"),
        }
    }
}

impl fmt::Display for Depth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Position => "q",
            Self::Velocity => "q and q̇",
            Self::Acceleration => "q, q̇ and q̈",
        })
    }
}

//! Terms that all crates share: kinds of joints and loads, roles of their geometry, frames, components of poses,
//! functions of formulas, kinds of steps of a solution plan, depths of solutions, and operation counts.

mod operations;

pub use operations::OperationCount;

use core::fmt;

/// An enum with a word for every variant.
macro_rules! words {
    (
        $(#[$meta:meta])* $name:ident, $(#[$what:meta])* $word:ident:
        $($(#[$doc:meta])* $variant:ident $text:literal,)+
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $name {
            $($(#[$doc])* $variant,)+
        }

        impl $name {
            /// Every variant.
            pub const ALL: [Self; [$(stringify!($variant)),+].len()] = [$(Self::$variant),+];

            $(#[$what])*
            pub const fn $word(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)+
                }
            }

            /// The variant as code writes it.
            pub const fn variant(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($variant),)+
                }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.$word())
            }
        }
    };
}

words! {
    /// The kind of a joint, constraint or driver.
    ///
    /// The variants show their rows of Φ. P is the first point, of body i, and Q the second, of body j; v̂ is the axis
    /// as a unit vector, w = A_iᵀ(r_Q − r_P), perp(v) = (−v_y, v_x), R a radius, p the lead, c an angle and e a value.
    #[non_exhaustive]
    JointKind,
    /// The keyword of the language.
    keyword:
    /// r_Q − r_P.
    Revolute "revolute",
    /// perp(A_i v̂)·(r_Q − r_P); φ_j − φ_i − c.
    Translational "translational",
    /// r_Q − r_P; φ_j − φ_i − c.
    Fixed "fixed",
    /// perp(A_i v̂)·(r_Q − r_P) − e.
    PointOnLine "point_on_line",
    /// |r_Q − r_P|² − e².
    Distance "distance",
    /// x_P − e.
    X "x",
    /// y_P − e.
    Y "y",
    /// φ − e.
    Angle "angle",
    /// φ_b − φ_a − e.
    RelativeAngle "relative_angle",
    /// |w| − ρ(θ): a point on a curve in polar form.
    OnPolarCurve "on_curve",
    /// e(X, Y) at w: a point on a curve in implicit form.
    OnImplicitCurve "on_curve",
    /// r_Q − r_P − A_i c(u): a point on a curve in parametric form.
    OnParametricCurve "on_curve",
    /// n·(r_Q − r_P) − h(θ): a flat-faced follower on a cam.
    FlatFollower "flat_follower",
    /// R_a(φ_a − φ_c) + R_b(φ_b − φ_c) − e.
    Gear "gear",
    /// R_a(φ_a − φ_c) − R_b(φ_b − φ_c) − e.
    Belt "belt",
    /// (A_i v̂)·(r_Q − r_P) − R(φ_b − φ_i) − e.
    RackPinion "rack_pinion",
    /// A disc on a line: perp(A_i v̂)·d − R; (A_i v̂)·d + R(φ_j − φ_i) − e, where d = r_Q − r_P.
    RollingOnLine "rolling",
    /// A disc on a disc: d − (R_i + R_j)(cos ψ, sin ψ); R_i(φ_i − ψ) + R_j(φ_j − ψ) − e.
    RollingOnDisc "rolling",
    /// (A_i v̂)·(r_Q − r_P) − p/(2π) (φ_b − φ_i) − e.
    Screw "screw",
    /// Σ |r_{k+1} − r_k| − e; between two points |r_Q − r_P|² − e².
    Rope "rope",
    /// A free-form holonomic row.
    Constraint "constraint",
    /// No velocity of a point across a direction of its body.
    KnifeEdge "knife_edge",
    /// Velocity of a point along a direction of its body.
    Speed "speed",
    /// A free-form row of velocity level.
    Nonholonomic "nonholonomic",
    /// A driving constraint.
    Driver "driver",
}

impl JointKind {
    /// True for the kinds that always drive. A joint of another kind drives if one of its operands, such as a length or
    /// an angle, depends on t or an input.
    pub const fn drives(self) -> bool {
        matches!(self, Self::Driver | Self::Speed)
    }

    /// True for an equation both sides of which are the user's own formulas.
    pub const fn is_free_equation(self) -> bool {
        matches!(self, Self::Constraint | Self::Nonholonomic | Self::Driver)
    }

    /// True for kinds that prescribe a length, which must not be negative: a distance (link, cylinder), a rope, or a
    /// driver of a distance, which is the only driver with a second point.
    pub const fn keeps_length(self, has_second_point: bool) -> bool {
        matches!(self, Self::Distance | Self::Rope) || matches!(self, Self::Driver) && has_second_point
    }

    /// True for kinds with one row that is a length, or the square of one: what drives it is a force.
    pub const fn prescribes_length(self) -> bool {
        matches!(
            self,
            Self::Distance | Self::Rope | Self::PointOnLine | Self::X | Self::Y | Self::RackPinion | Self::Screw
        )
    }

    /// True for kinds with one row that is an angle: what drives it is a moment.
    pub const fn prescribes_angle(self) -> bool {
        matches!(self, Self::Angle | Self::RelativeAngle)
    }

    /// True if a number with this role may be degenerate for some parameters: an axis without a direction, a radius of 0,
    /// a negative length.
    pub const fn may_degenerate(self, role: Role, has_second_point: bool) -> bool {
        match role {
            Role::Axis | Role::Radius => true,
            Role::Value => self.keeps_length(has_second_point),
            Role::P | Role::Q | Role::Via => false,
        }
    }

    /// True for kinds with a curve that may have no tangent or no normal at some of its points.
    pub const fn follows_curve(self) -> bool {
        matches!(self, Self::OnPolarCurve | Self::OnImplicitCurve | Self::OnParametricCurve)
    }
}

words! {
    /// The kind of a mass or load.
    #[non_exhaustive]
    LoadKind,
    /// The keyword of the language.
    keyword:
    /// A field that pulls every mass.
    Gravity "gravity",
    /// A mass with its centre and its moment of inertia.
    Mass "mass",
    /// A force on a point of a body.
    Force "force",
    /// A couple on a body, or between two.
    Torque "torque",
    /// A spring with a damper between two points.
    Spring "spring",
    /// A spring with a damper between the angles of two bodies.
    TorsionSpring "torsion_spring",
}

/// The kind of a statement of the language that has operands.
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

words! {
    /// The role of a geometric operand of a joint.
    #[non_exhaustive]
    Role,
    /// The role in words.
    words:
    /// Body-fixed coordinates of the first operand's point, two numbers.
    P "first point",
    /// Body-fixed coordinates of the second operand's point, two numbers.
    Q "second point",
    /// Body-fixed coordinates of a point between the first and the last, two numbers; several are in the order along
    /// the rope.
    Via "point between",
    /// Unit vector of an axis in the frame it is fixed in, two numbers.
    Axis "axis",
    /// Length, angle, offset or right-hand side, one number; may depend on t and inputs. For a gear or a belt the
    /// frame is that of the carrier.
    Value "value",
    /// Radius of a disc or gear fixed in the frame, one number; negative for a ring, inside which the other one runs,
    /// and for a disc to the right of the line on which it rolls. For a roller on a curve the frame is that of the
    /// curve, and the radius is positive to the left of the direction in which the parameter grows.
    Radius "radius",
}

/// A body or the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Frame {
    /// The inertial frame O–xy.
    Ground,
    /// A moving body, by its index among all bodies.
    Body(usize),
}

/// `ground`, or `body` and its index.
impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ground => f.write_str("ground"),
            Self::Body(place) => write!(f, "body {place}"),
        }
    }
}

words! {
    /// One of the three coordinates of a body's pose, in the order of q.
    Component,
    /// The component as it is written in the name of a coordinate.
    name:
    /// x of the body's origin in the inertial frame.
    X "x",
    /// y of the body's origin in the inertial frame.
    Y "y",
    /// φ, the rotation of the body's frame: counter-clockwise, never wrapped.
    Phi "phi",
}

words! {
    /// A function of one argument.
    Function,
    /// The name of the function in the user's language.
    name:
    /// Sine.
    Sin "sin",
    /// Cosine.
    Cos "cos",
    /// Tangent.
    Tan "tan",
    /// Inverse sine.
    Asin "asin",
    /// Inverse cosine.
    Acos "acos",
    /// Inverse tangent.
    Atan "atan",
    /// Square root.
    Sqrt "sqrt",
    /// Exponential.
    Exp "exp",
    /// Natural logarithm.
    Ln "ln",
    /// Absolute value.
    Abs "abs",
}

impl Function {
    /// The function with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.name() == name)
    }
}

/// The kind of a step of a solution plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// A formula of known quantities.
    Explicit,
    /// A linear system; the number of its unknowns.
    Linear(usize),
    /// A group that closes without iteration, in one of two ways.
    Closure,
    /// Newton's iteration; the number of its unknowns.
    Newton(usize),
    /// Redundant rows, which no other step uses, except that a row may determine a sign. The step gives no coordinate;
    /// the margin of each row shows whether the solution satisfies it, including its velocity and acceleration
    /// equations as far as these are solved.
    RedundantRows,
}

impl StepKind {
    /// The variant as code writes it, without its number of unknowns.
    pub const fn variant(self) -> &'static str {
        match self {
            Self::Explicit => "Explicit",
            Self::Linear(_) => "Linear",
            Self::Closure => "Closure",
            Self::Newton(_) => "Newton",
            Self::RedundantRows => "RedundantRows",
        }
    }

    /// How many unknowns a system or an iteration has.
    pub const fn unknowns(self) -> Option<usize> {
        match self {
            Self::Linear(n) | Self::Newton(n) => Some(n),
            Self::Explicit | Self::Closure | Self::RedundantRows => None,
        }
    }
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
            Self::RedundantRows => f.write_str("redundant rows checked"),
        }
    }
}

words! {
    /// The highest time derivative of q that a solution includes.
    Depth,
    /// The quantities that are solved for.
    solved:
    /// q.
    Position "q",
    /// q and q̇.
    Velocity "q and q̇",
    /// q, q̇ and q̈.
    Acceleration "q, q̇ and q̈",
}

words! {
    /// A kind of unknown of an iteration, which determines what its corrections are compared with.
    UnknownKind,
    /// In words.
    word:
    /// The angle of a body, in radians.
    Angle "angle",
    /// A length, or a scalar that scales as lengths do. Its corrections are compared with the size of all lengths
    /// together, so that a mechanism of micrometres is solved to the same number of digits in metres.
    Length "length",
    /// A scalar of another kind, such as the parameter of a curve, in any unit. Its corrections are compared with its own
    /// size, too.
    Scalar "scalar",
}

//! The words that all crates share: what kinds of joints there are.

/// The kind of a joint without its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// See [`crate::mechanism::JointKind`].
    Revolute,
    /// Likewise.
    Translational,
    /// Likewise.
    Fixed,
    /// Likewise.
    PointOnLine,
    /// Likewise.
    Distance,
    /// Absolute x.
    X,
    /// Absolute y.
    Y,
    /// Absolute angle.
    Angle,
    /// Relative angle.
    RelativeAngle,
    /// Point on a curve in polar form.
    OnPolarCurve,
    /// Point on a curve in implicit form.
    OnImplicitCurve,
    /// Point on a curve in parametric form.
    OnParametricCurve,
    /// Flat-faced follower on a cam.
    FlatFollower,
    /// Gear pair.
    Gear,
    /// Belt.
    Belt,
    /// Rack and pinion.
    RackPinion,
    /// A disc on a line.
    RollingOnLine,
    /// A disc on a disc.
    RollingOnDisc,
    /// Free-form equation.
    Constraint,
    /// No velocity across a direction of the body.
    KnifeEdge,
    /// Velocity along a direction of the body.
    Speed,
    /// Free-form equation of velocity level.
    Nonholonomic,
    /// Driving constraint.
    Driver,
}

impl JointKind {
    /// The keyword of the user's language.
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
            Self::Constraint => "constraint",
            Self::KnifeEdge => "knife_edge",
            Self::Speed => "speed",
            Self::Nonholonomic => "nonholonomic",
            Self::Driver => "driver",
        }
    }
}

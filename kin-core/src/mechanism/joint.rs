//! Joints, drivers and free equations: what contributes rows to Φ.

use super::{BodyRef, Component, Curve, Formula, Member, Place, Range};
use crate::error::Origin;

/// An axis direction in the frame of the first operand's body (a flat follower's: of the second); kin normalises it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// First component, a formula of parameters.
    pub x: Formula,
    /// Second component.
    pub y: Formula,
    /// The tokens of the axis.
    pub origin: Origin,
}

/// The radius of a disc or a gear; negative for one that the other runs inside of.
#[derive(Clone, Debug, PartialEq)]
pub struct Radius {
    /// Its value, a formula of parameters.
    pub value: Formula,
    /// The tokens it is written with.
    pub origin: Origin,
}

/// The radii of a pair of discs, or of two gears.
#[derive(Clone, Debug, PartialEq)]
pub struct Radii {
    /// Of body i.
    pub i: Radius,
    /// Of body j.
    pub j: Radius,
    /// The pair.
    pub origin: Origin,
}

/// What a joint says. Operands come in the user's order: first belongs to body i, second to body j.
#[derive(Clone, Debug, PartialEq)]
pub enum JointKind {
    /// r_Q − r_P.
    Revolute {
        /// Point of body i.
        p: Place,
        /// Point of body j.
        q: Place,
    },
    /// perp(A_i v̂)·(r_Q − r_P); φ_j − φ_i − c.
    Translational {
        /// Point of body i.
        p: Place,
        /// Point of body j.
        q: Place,
        /// v in body i.
        axis: Axis,
        /// c.
        angle: Formula,
    },
    /// r_Q − r_P; φ_j − φ_i − c.
    Fixed {
        /// Point of body i.
        p: Place,
        /// Point of body j.
        q: Place,
        /// c.
        angle: Formula,
    },
    /// perp(A_i v̂)·(r_Q − r_P) − e.
    PointOnLine {
        /// Point of body i on the line.
        p: Place,
        /// Point of body j.
        q: Place,
        /// v in body i.
        axis: Axis,
        /// e.
        offset: Formula,
    },
    /// |r_Q − r_P|² − e².
    Distance {
        /// Point of body i.
        p: Place,
        /// Point of body j.
        q: Place,
        /// e, and the tokens it is written with.
        length: Formula,
        /// The tokens of the length.
        length_origin: Origin,
    },
    /// x_P − e or y_P − e.
    Coordinate {
        /// The point.
        p: Place,
        /// X or Y.
        component: Component,
        /// e.
        value: Formula,
    },
    /// φ − e.
    Angle {
        /// The body.
        body: BodyRef,
        /// e.
        value: Formula,
    },
    /// φ_b − φ_a − e.
    RelativeAngle {
        /// Body i.
        a: BodyRef,
        /// Body j.
        b: BodyRef,
        /// e.
        value: Formula,
    },
    /// Q on a curve fixed in body i, centred at P: |w| − ρ(θ), e(X, Y), or r_Q − r_P − A_i c(u); w = A_iᵀ(r_Q − r_P).
    OnCurve {
        /// The curve's centre, of body i.
        p: Place,
        /// Point of body j.
        q: Place,
        /// The curve.
        curve: Curve,
    },
    /// n·(r_Q − r_P) − h(θ), n = perp(A_j v̂), θ the angle of n in body i.
    FlatFollower {
        /// The centre of the support function, of body i.
        p: Place,
        /// Point of body j on its face.
        q: Place,
        /// v along the face, in body j.
        axis: Axis,
        /// h.
        support: Formula,
    },
    /// R_a(φ_a − φ_c) + R_b(φ_b − φ_c) − e.
    Gear {
        /// Body i.
        a: BodyRef,
        /// Body j.
        b: BodyRef,
        /// R_a and R_b.
        radii: Radii,
        /// The body that carries both axles; the ground unless another is given.
        carrier: BodyRef,
        /// e.
        offset: Formula,
    },
    /// R_a(φ_a − φ_c) − R_b(φ_b − φ_c) − e.
    Belt {
        /// Body i.
        a: BodyRef,
        /// Body j.
        b: BodyRef,
        /// R_a and R_b.
        radii: Radii,
        /// The body that carries both axles; the ground unless another is given.
        carrier: BodyRef,
        /// e.
        offset: Formula,
    },
    /// (A_i v̂)·(r_Q − r_P) − R(φ_b − φ_i) − e.
    RackPinion {
        /// Point of the guide, body i.
        p: Place,
        /// Point of the rack, body j.
        q: Place,
        /// v in body i.
        axis: Axis,
        /// The pinion, whose axle the guide carries.
        pinion: BodyRef,
        /// R.
        radius: Radius,
        /// e.
        offset: Formula,
    },
    /// A disc on a line: perp(A_i v̂)·d − R; (A_i v̂)·d + R(φ_j − φ_i) − e, where d = r_Q − r_P.
    RollingOnLine {
        /// Point of body i on the line.
        p: Place,
        /// Centre of the disc, body j.
        q: Place,
        /// v in body i.
        axis: Axis,
        /// R.
        radius: Radius,
        /// e.
        offset: Formula,
    },
    /// A disc on a disc: d − (R_i + R_j)(cos ψ, sin ψ); R_i(φ_i − ψ) + R_j(φ_j − ψ) − e, where d = r_Q − r_P.
    RollingOnDisc {
        /// Centre of the disc of body i.
        p: Place,
        /// Centre of the disc of body j.
        q: Place,
        /// R_i and R_j.
        radii: Radii,
        /// ψ, a scalar coordinate: the direction of d in the inertial frame.
        along: Member,
        /// e.
        offset: Formula,
    },
    /// Left minus right, a free-form holonomic row.
    Constraint {
        /// Left side.
        left: Formula,
        /// Right side.
        right: Formula,
    },
    /// −ẋ_P sin ψ + ẏ_P cos ψ with ψ = φ_i + α, at velocity level.
    KnifeEdge {
        /// Point of body i.
        p: Place,
        /// α.
        angle: Formula,
    },
    /// ẋ_P cos ψ + ẏ_P sin ψ − f with ψ = φ_i + α, at velocity level; drives.
    Speed {
        /// Point of body i.
        p: Place,
        /// α.
        angle: Formula,
        /// f.
        value: Formula,
    },
    /// Left minus right, a free-form row of velocity level, linear in [`Formula::Dot`].
    Nonholonomic {
        /// Left side.
        left: Formula,
        /// Right side.
        right: Formula,
    },
    /// Left minus right, a driving constraint; `distance(P, Q) = f` gives |r_Q − r_P|² − f².
    Driver {
        /// Left side.
        left: Formula,
        /// Right side.
        right: Formula,
        /// The tokens of the right side.
        right_origin: Origin,
    },
}

impl JointKind {
    /// The keyword of the user's language.
    pub const fn keyword(&self) -> &'static str {
        match self {
            Self::Revolute { .. } => "revolute",
            Self::Translational { .. } => "translational",
            Self::Fixed { .. } => "fixed",
            Self::PointOnLine { .. } => "point_on_line",
            Self::Distance { .. } => "distance",
            Self::Coordinate { component: Component::Y, .. } => "y",
            Self::Coordinate { .. } => "x",
            Self::Angle { .. } => "angle",
            Self::RelativeAngle { .. } => "relative_angle",
            Self::OnCurve { .. } => "on_curve",
            Self::FlatFollower { .. } => "flat_follower",
            Self::Gear { .. } => "gear",
            Self::Belt { .. } => "belt",
            Self::RackPinion { .. } => "rack_pinion",
            Self::RollingOnLine { .. } | Self::RollingOnDisc { .. } => "rolling",
            Self::Constraint { .. } => "constraint",
            Self::KnifeEdge { .. } => "knife_edge",
            Self::Speed { .. } => "speed",
            Self::Nonholonomic { .. } => "nonholonomic",
            Self::Driver { .. } => "driver",
        }
    }
}

/// A joint, driver or equation, or a family of them over a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name without index.
    pub name: String,
    /// Range, when repeated.
    pub range: Option<Range>,
    /// What it says.
    pub kind: JointKind,
    /// The keyword's token.
    pub keyword: Origin,
    /// The name's token.
    pub origin: Origin,
}

/// What a guess sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuessTarget {
    /// A coordinate of a body.
    Pose(BodyRef, Component),
    /// A scalar coordinate.
    Scalar(Member),
}

/// The start of assembly for one coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// Which coordinate.
    pub target: GuessTarget,
    /// Its value, a formula of parameters.
    pub value: Formula,
    /// Range, when repeated.
    pub range: Option<Range>,
    /// The target's token.
    pub origin: Origin,
}

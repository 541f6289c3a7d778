//! Points, axes and poses of bodies as expressions in the inertial frame.

use crate::expr::ExprId;
use crate::vocabulary::Frame;

/// A point in the inertial frame, r = r_i + A_i s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedPoint {
    pub(crate) frame: Frame,
    /// The body-fixed coordinates s.
    pub(crate) local: [ExprId; 2],
    /// The origin r_i of the body.
    pub(crate) base: [ExprId; 2],
    /// The position r.
    pub(crate) r: [ExprId; 2],
    /// The angle φ_i of the body.
    pub(crate) angle: ExprId,
}

/// A unit axis fixed in the frame of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedAxis {
    /// The components of v̂ in that frame.
    pub(crate) local: [ExprId; 2],
    /// The direction u = A v̂ in the inertial frame.
    pub(crate) u: [ExprId; 2],
    /// The angle of the frame.
    pub(crate) angle: ExprId,
}

/// The pose of a body during the assembly.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pose {
    Unknown,
    /// The pose is being built; if it is needed now, the body is carried by itself.
    Building,
    Known([ExprId; 3]),
}

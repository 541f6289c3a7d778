//! Bodies, points and axes in the inertial frame.

use crate::expr::ExprId;
use crate::vocabulary::Frame;

/// A point in the inertial frame: r = r_i + A_i s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedPoint {
    pub(crate) frame: Frame,
    /// s.
    pub(crate) local: [ExprId; 2],
    /// r_i.
    pub(crate) base: [ExprId; 2],
    /// r.
    pub(crate) r: [ExprId; 2],
    /// φ_i.
    pub(crate) angle: ExprId,
}

/// A unit axis fixed in a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedAxis {
    /// v̂ in the frame.
    pub(crate) local: [ExprId; 2],
    /// u = A v̂.
    pub(crate) u: [ExprId; 2],
    /// The angle it turns with.
    pub(crate) angle: ExprId,
}

/// The pose of a body, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pose {
    Unknown,
    /// It is being built; to need it now is to need itself.
    Building,
    Known([ExprId; 3]),
}

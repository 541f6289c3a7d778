//! Joints, constraints and drivers: kinds, geometry for a drawing, and reported quantities.

use super::{DefineInfo, Frame};
pub use kin_core::vocabulary::{JointKind, Role};

/// A piece of geometry of a joint, whose numbers are in the geometry array.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// Its role in the joint.
    pub role: Role,
    /// The frame it is fixed in.
    pub frame: Frame,
    /// Index of its first number in the geometry array.
    pub offset: usize,
}

/// A joint, constraint or driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointInfo {
    /// Its name, `A` or `N[3]`.
    pub name: &'static str,
    /// Its kind.
    pub kind: JointKind,
    /// Frames of the first and second operand, where the kind has them.
    #[doc(hidden)]
    pub frames: [Option<Frame>; 2],
    /// First row in Φ.
    pub first_row: usize,
    /// Number of rows.
    pub rows: usize,
    /// Points, axes and values, for a drawing.
    #[doc(hidden)]
    pub geometry: &'static [Geometry],
    /// The reported quantities: `angle` (φ_j − φ_i), `stroke` (displacement along the axis), `distance`, or `theta`
    /// (direction of a flat follower's face relative to the cam); the rate is the relative angular velocity, the
    /// sliding velocity or the rate of change of the distance.
    pub quantities: &'static [DefineInfo],
}

impl JointInfo {
    /// True where it keeps a distance between points: a link, a cylinder, a rope, or a driver of a distance.
    pub(crate) fn keeps_distance(&self) -> bool {
        self.kind.keeps_length(self.geometry.iter().any(|geometry| geometry.role == Role::Q))
    }
}

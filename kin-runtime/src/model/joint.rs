//! Joints, constraints and drivers: kinds, geometry for a drawing, and what they report.

use super::Frame;
pub use kin_core::vocabulary::{JointKind, Role};

/// A piece of geometry of a joint: where its numbers stand in the geometry array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// What it is for.
    pub role: Role,
    /// The frame it is fixed in.
    pub frame: Frame,
    /// Place of the first number in the geometry array.
    pub offset: usize,
}

/// A quantity that a joint reports: relative angle, stroke, distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointQuantity {
    /// `angle` (φ_j − φ_i), `stroke` (displacement along the axis), `distance`, or `theta` (direction of a flat
    /// follower's face as the cam sees it); its rate is the relative angular velocity, the sliding velocity or the rate of
    /// change of the distance.
    pub name: &'static str,
    /// Its observable in [`Model::observables`](super::Model::observables).
    pub observable: usize,
}

/// A joint, constraint or driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointInfo {
    /// Its name, `A` or `N[3]`.
    pub name: &'static str,
    /// Its kind.
    pub kind: JointKind,
    /// Frames of the first and second operand, where the kind has them.
    pub frames: [Option<Frame>; 2],
    /// First row in Φ.
    pub first_row: usize,
    /// Number of rows.
    pub rows: usize,
    /// Points, axes and values, for a drawing.
    pub geometry: &'static [Geometry],
    /// What it reports.
    pub quantities: &'static [JointQuantity],
}

impl JointInfo {
    /// True where it keeps a distance between points: a link, a cylinder, a rope, or a driver of a distance.
    pub(crate) fn keeps_distance(&self) -> bool {
        self.kind.keeps_length(self.geometry.iter().any(|geometry| geometry.role == Role::Q))
    }
}

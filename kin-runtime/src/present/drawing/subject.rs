//! The input of a drawing: the poses and the geometry at every instant.

use crate::evaluation::curve::CurvePoint;
use crate::forces::{Forces, Load};
use crate::model::{Frame, Geometry, JointInfo, Model, Role};

/// The data of one instant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Snapshot {
    /// Time.
    pub(crate) t: f64,
    /// (x, y, φ) of every body.
    pub(crate) bodies: Vec<[f64; 3]>,
    /// q.
    pub(crate) q: Vec<f64>,
    /// Positions of the named points.
    pub(crate) points: Vec<[f64; 2]>,
    /// Their velocities.
    pub(crate) velocities: Vec<[f64; 2]>,
    /// The geometry array: local points, axes, values and radii.
    pub(crate) geometry: Vec<f64>,
    /// Forces, if they are shown and known.
    pub(crate) forces: Option<Forces>,
    /// The forces of loads, if they are shown.
    pub(crate) loads: Vec<Load>,
}

/// Gives a point of a curve, for the index of the instant, that of the joint, and the argument.
pub(crate) type CurveFunction<'a> = dyn Fn(usize, usize, f64) -> Option<CurvePoint> + 'a;

/// A motion that is to be drawn; it has at least one instant.
pub(crate) struct Subject<'a> {
    /// The mechanism's names and joints.
    pub(crate) model: &'static Model,
    /// The instants in order.
    pub(crate) snapshots: &'a [Snapshot],
    /// The curves of contacts.
    pub(crate) curve: &'a CurveFunction<'a>,
    /// Places that a point is to pass.
    pub(crate) targets: &'a [[f64; 2]],
}

/// A pose: x, y, φ.
pub(crate) type Pose = [f64; 3];

impl Subject<'_> {
    /// The pose of a frame at an instant.
    pub(crate) fn pose(&self, instant: usize, frame: Frame) -> Pose {
        match frame {
            Frame::Ground => [0.0; 3],
            Frame::Body(body) => self.snapshots[instant].bodies.get(body).copied().unwrap_or_default(),
        }
    }

    /// The numbers of a piece of geometry.
    pub(crate) fn numbers<const N: usize>(&self, instant: usize, geometry: &Geometry) -> Option<[f64; N]> {
        let numbers: [f64; N] =
            self.snapshots[instant].geometry.get(geometry.offset..geometry.offset + N)?.try_into().ok()?;
        numbers.iter().all(|x| x.is_finite()).then_some(numbers)
    }

    /// A point or an axis of a joint in its own frame.
    pub(crate) fn local(&self, instant: usize, joint: &JointInfo, role: Role) -> Option<(Frame, [f64; 2])> {
        let geometry = piece(joint, role)?;
        Some((geometry.frame, self.numbers(instant, geometry)?))
    }

    /// A point of a joint in the inertial frame.
    pub(crate) fn point(&self, instant: usize, joint: &JointInfo, role: Role) -> Option<[f64; 2]> {
        let (frame, local) = self.local(instant, joint, role)?;
        Some(placed(self.pose(instant, frame), local))
    }

    /// Where a point of a joint is at every instant.
    pub(crate) fn track(&self, joint: &JointInfo, role: Role) -> Vec<[f64; 2]> {
        self.instants().filter_map(|k| self.point(k, joint, role)).collect()
    }

    /// Both points of a joint, each in its own frame, at the first instant.
    pub(crate) fn ends(&self, joint: &JointInfo) -> Option<[(Frame, [f64; 2]); 2]> {
        Some([self.local(0, joint, Role::P)?, self.local(0, joint, Role::Q)?])
    }

    /// A point of a joint with the direction of its axis, at every instant.
    pub(crate) fn along_axis(&self, joint: &JointInfo, role: Role) -> Vec<Pose> {
        let pose = |k: usize| {
            let [x, y] = self.point(k, joint, role)?;
            Some([x, y, self.direction(k, joint)?])
        };
        self.instants().filter_map(pose).collect()
    }

    /// The direction of a joint's axis in the inertial frame, as an angle.
    pub(crate) fn direction(&self, instant: usize, joint: &JointInfo) -> Option<f64> {
        let (frame, [x, y]) = self.local(instant, joint, Role::Axis)?;
        Some(self.pose(instant, frame)[2] + y.atan2(x))
    }

    /// The radii of a joint with the frames of their wheels, at the first instant.
    pub(crate) fn radii(&self, joint: &JointInfo) -> Vec<(Frame, f64)> {
        let pieces = joint.geometry.iter().filter(|geometry| geometry.role == Role::Radius);
        pieces.filter_map(|geometry| Some((geometry.frame, self.numbers::<1>(0, geometry)?[0]))).collect()
    }

    /// All instants.
    pub(crate) fn instants(&self) -> core::ops::Range<usize> {
        0..self.snapshots.len()
    }
}

/// The entry of a joint's geometry with a role.
pub(crate) fn piece(joint: &JointInfo, role: Role) -> Option<&'static Geometry> {
    joint.geometry.iter().find(|geometry| geometry.role == role)
}

/// A point of a frame in the inertial frame: r + A s′.
pub(crate) fn placed([x, y, phi]: Pose, [u, v]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = phi.sin_cos();
    [x + cos * u - sin * v, y + sin * u + cos * v]
}

/// A point of the inertial frame in a frame: Aᵀ(p − r).
pub(crate) fn seen_from([x, y, phi]: Pose, [px, py]: [f64; 2]) -> [f64; 2] {
    let ((sin, cos), (dx, dy)) = (phi.sin_cos(), (px - x, py - y));
    [cos * dx + sin * dy, cos * dy - sin * dx]
}

/// The distance of two points.
pub(crate) fn distance([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    (bx - ax).hypot(by - ay)
}

/// The least and the greatest of numbers.
pub(crate) fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// Whether a track never leaves its start.
pub(crate) fn is_still(track: &[[f64; 2]], size: f64) -> bool {
    track.iter().all(|&p| distance(p, track[0]) <= 1e-6 * size)
}

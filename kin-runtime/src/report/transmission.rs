//! Transmission angles.
//!
//! At a revolute joint N between moving bodies i and j, every pair of other joints a on i and b on j that act at points
//! gives one angle, between r_a − r_N and r_b − r_N. In a four-bar the one at the joint of coupler and rocker, between
//! the crank's end and the rocker's pivot, is that of the textbooks. A slider on a guide of the ground has the normal
//! perp(u) of the guide in place of r_b − r_N, as a rocker of infinite length has. Joints of a body whose rotation is
//! driven, of a slider that is driven, and joints whose relative angle is driven, are left out: they are on the driving
//! side. So are pairs of joints that belong to another loop than N: if the mechanism has a plan, N, a and b must be
//! joints of one of its steps.

use crate::equations::placement::Placement;
use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::model::{Component, CoordinateKind, Frame, Geometry, JointInfo, JointKind, Model, Role};
use crate::scalar::Scalar;
use core::fmt;

/// The angle at a revolute joint between the lines to the next joints of its two bodies; for a slider on a guide of the
/// ground, to the normal of the guide.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TransmissionAngle {
    /// The revolute joint.
    pub joint: &'static str,
    /// The neighbouring joint on its first body, and the one on its second.
    pub between: [&'static str; 2],
    /// The angle, in [0, π]; force is transmitted best at π/2.
    pub angle: f64,
}

impl TransmissionAngle {
    /// Deviation from the best, |angle − π/2|, in [0, π/2].
    pub fn deviation(&self) -> f64 {
        (self.angle - core::f64::consts::FRAC_PI_2).abs()
    }
}

impl fmt::Display for TransmissionAngle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} between {} and {}: {:.6}", self.joint, self.between[0], self.between[1], self.angle)
    }
}

/// Arms shorter than this, relative to the other one, have no direction.
const DEGENERATE: f64 = 1e-9;

/// Two joints next to a revolute joint, one on either of its bodies: the lines to them enclose a transmission angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    /// The revolute joint, in [`Model::joints`].
    pub(crate) joint: usize,
    /// The neighbours on its first and on its second body.
    pub(crate) between: [usize; 2],
    /// The points of the revolute joint and of its two neighbours; the axis of a guide.
    pub(crate) places: [&'static Geometry; 3],
}

/// The transmission angles at q.
pub(crate) fn transmission_angles(
    equations: &mut Equations<'_>,
    q: &[f64],
) -> Result<Vec<TransmissionAngle>, SolveError> {
    let joints = equations.model.joints;
    let pairs = pairs(equations.model);
    let angles = angles(equations, q, &pairs)?;
    let found = pairs.iter().zip(angles).filter_map(|(pair, angle)| {
        let between = pair.between.map(|joint| joints[joint].name);
        Some(TransmissionAngle { joint: joints[pair.joint].name, between, angle: angle? })
    });
    Ok(found.collect())
}

/// The angles of pairs at q; `None` if an arm has no length.
pub(crate) fn angles(equations: &mut Equations<'_>, q: &[f64], pairs: &[Pair]) -> Result<Vec<Option<f64>>, SolveError> {
    equations.check("q", q)?;
    let (model, t) = (equations.model, equations.t);
    let placement = Placement::at(equations, q)?;
    let angle = |pair: &Pair| {
        let [a, b] = pair.between;
        let mut vectors = [[0.0; 2]; 3];
        for ((geometry, joint), vector) in pair.places.iter().zip([pair.joint, a, b]).zip(&mut vectors) {
            let place = if is_axis(geometry) { placement.direction(geometry) } else { placement.point(geometry) };
            let Some(r) = place else { return Ok(None) };
            for value in r {
                finite("geometry", joint, model.joints[joint].name, value).map_err(|error| error.at(t))?;
            }
            *vector = r;
        }
        Ok(angle_between(pair, vectors).filter(|angle| angle.is_finite()))
    };
    pairs.iter().map(angle).collect()
}

/// The pairs of neighbours that transmit to an output, in order of declaration.
pub(crate) fn pairs(model: &Model) -> Vec<Pair> {
    let joints = model.joints;
    let places = places(model);
    let driven = driven(model);
    let mut found = Vec::new();
    for (index, joint) in joints.iter().enumerate() {
        let (JointKind::Revolute, [Some(Frame::Body(i)), Some(Frame::Body(j))]) = (joint.kind, joint.frames) else {
            continue;
        };
        if driven.iter().any(|bodies| matches!(bodies[..], [a] if a == i || a == j) || *bodies == sorted(i, j)) {
            continue;
        }
        let at = |body: usize| places.iter().filter(move |p| p.body == body);
        let Some(centre) = at(i).find(|p| p.joint == index) else { continue };
        for a in at(i).filter(|p| p.joint != index) {
            for b in at(j).filter(|p| p.joint != index && p.joint != a.joint) {
                let are_guides = is_axis(a.geometry) && is_axis(b.geometry);
                if !are_guides && closed_together(model, [index, a.joint, b.joint]) {
                    let places = [centre.geometry, a.geometry, b.geometry];
                    found.push(Pair { joint: index, between: [a.joint, b.joint], places });
                }
            }
        }
    }
    found
}

/// True if the joints belong to one step of the plan; always true without a plan.
fn closed_together(model: &Model, joints: [usize; 3]) -> bool {
    let mut steps = model.plan.steps.iter();
    !model.plan.exists() || steps.any(|step| joints.iter().all(|joint| step.joints.contains(joint)))
}

/// For every driving row with no other coordinates than rotations of bodies: these bodies, sorted.
fn driven(model: &Model) -> Vec<Vec<usize>> {
    let rotations = |row: usize| -> Option<Vec<usize>> {
        let columns = model.constraint_pattern.entries.iter().filter(|entry| entry.0 == row);
        let mut bodies: Vec<usize> = columns
            .map(|&(_, column)| match model.coordinates[column].kind {
                CoordinateKind::Pose { body, component: Component::Phi } => Some(body),
                _ => None,
            })
            .collect::<Option<_>>()?;
        bodies.sort_unstable();
        Some(bodies)
    };
    (0..model.rows.len()).filter(|&row| model.rows[row].driving).filter_map(rotations).collect()
}

fn sorted(i: usize, j: usize) -> Vec<usize> {
    vec![i.min(j), i.max(j)]
}

/// The point of a joint on a moving body, or the axis of the guide of the ground on which the body slides.
struct JointPoint {
    joint: usize,
    body: usize,
    geometry: &'static Geometry,
}

/// The points of all point-like joints on moving bodies, and the guides of sliders.
fn places(model: &Model) -> Vec<JointPoint> {
    let mut places = Vec::new();
    for (joint, info) in model.joints.iter().enumerate() {
        if is_point_like(info) {
            for geometry in info.geometry.iter().filter(|g| matches!(g.role, Role::P | Role::Q)) {
                if let (Frame::Body(body), true) = (geometry.frame, stands_still(info, geometry)) {
                    places.push(JointPoint { joint, body, geometry });
                }
            }
        }
        let axis = info.geometry.iter().find(|geometry| is_axis(geometry));
        if let (Some(body), Some(geometry)) = (slider(info).filter(|body| !is_driven(model, *body)), axis) {
            places.push(JointPoint { joint, body, geometry });
        }
    }
    places
}

/// The body that a translational joint guides on the ground.
fn slider(joint: &JointInfo) -> Option<usize> {
    match (joint.kind, joint.frames) {
        (
            JointKind::Translational,
            [Some(Frame::Ground), Some(Frame::Body(body))] | [Some(Frame::Body(body)), Some(Frame::Ground)],
        ) => Some(body),
        _ => None,
    }
}

/// True if a driving row has no other coordinates than those of this body.
fn is_driven(model: &Model, body: usize) -> bool {
    let is_own =
        |column: usize| matches!(model.coordinates[column].kind, CoordinateKind::Pose { body: of, .. } if of == body);
    let columns = |row: usize| model.constraint_pattern.entries.iter().filter(move |entry| entry.0 == row);
    let moves_it = |row: usize| columns(row).next().is_some() && columns(row).all(|&(_, column)| is_own(column));
    (0..model.rows.len()).any(|row| model.rows[row].driving && moves_it(row))
}

/// True for joints that act at a point.
fn is_point_like(joint: &JointInfo) -> bool {
    matches!(
        joint.kind,
        JointKind::Revolute
            | JointKind::Distance
            | JointKind::PointOnLine
            | JointKind::Fixed
            | JointKind::X
            | JointKind::Y
    )
}

/// True if the joint's point is fixed in that body; false for the body with the line of a point-on-line joint.
fn stands_still(joint: &JointInfo, geometry: &Geometry) -> bool {
    joint.kind != JointKind::PointOnLine || geometry.role == Role::Q
}

/// True for the axis of a guide.
const fn is_axis(geometry: &Geometry) -> bool {
    matches!(geometry.role, Role::Axis)
}

/// The arms of a pair: the vectors from its revolute joint to its neighbours, and the normal of a guide.
pub(crate) fn arms<T: Scalar>(pair: &Pair, [centre, a, b]: [[T; 2]; 3]) -> [[T; 2]; 2] {
    let arm = |geometry: &Geometry, [x, y]: [T; 2]| match is_axis(geometry) {
        true => [-y, x],
        false => [x - centre[0], y - centre[1]],
    };
    [arm(pair.places[1], a), arm(pair.places[2], b)]
}

/// The angle between the arms of a pair, in [0, π], whose points and axes are given; `None` if an arm has no length.
fn angle_between(pair: &Pair, vectors: [[f64; 2]; 3]) -> Option<f64> {
    let [[ax, ay], [bx, by]] = arms(pair, vectors);
    let [of_a, of_b] = [ax.hypot(ay), bx.hypot(by)];
    // The normal of a guide counts as long as the other arm.
    let la = if is_axis(pair.places[1]) { of_b } else { of_a };
    let lb = if is_axis(pair.places[2]) { of_a } else { of_b };
    (la > DEGENERATE * lb && lb > DEGENERATE * la).then(|| (ax * by - ay * bx).abs().atan2(ax * bx + ay * by))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_lie_between_zero_and_pi_and_degenerate_arms_have_none() {
        let geometry = |role| &*Box::leak(Box::new(Geometry { role, frame: Frame::Ground, offset: 0 }));
        let pair = |role| Pair { joint: 0, between: [1, 2], places: [Role::P, Role::P, role].map(geometry) };
        let at = |b| angle_between(&pair(Role::P), [[1.0, 1.0], [3.0, 1.0], b]);
        assert_eq!(at([1.0, 5.0]), Some(core::f64::consts::FRAC_PI_2));
        assert_eq!(at([1.0, -5.0]), Some(core::f64::consts::FRAC_PI_2));
        assert_eq!(at([0.0, 1.0]), Some(core::f64::consts::PI));
        assert_eq!(at([1.0, 1.0]), None);
        // An arm of any length along a guide, and across it.
        let guided = |a| angle_between(&pair(Role::Axis), [[1.0, 1.0], a, [1.0, 0.0]]);
        assert_eq!(guided([1.0 + 1e-12, 1.0]), Some(core::f64::consts::FRAC_PI_2));
        assert_eq!([guided([1.0, 4.0]), guided([1.0, -4.0])], [Some(0.0), Some(core::f64::consts::PI)]);
        assert_eq!(guided([1.0, 1.0]), None);
    }
}

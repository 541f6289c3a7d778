//! Sliders: a rail on the first body or the ground, a block on the second. The rail may belong to a joint, or to a body whose
//! other coordinates are held.

use super::carrier::{Carrier, upright};
use super::links::Links;
use super::part::{Ink, Part, Stroke};
use super::subject::{Subject, bounds, placed, seen_from};
use crate::model::{BodyInfo, Frame, JointInfo, JointKind, OriginKind, Role};
use core::f64::consts::FRAC_PI_2;

/// How far a rail extends beyond the block's travel, relative to the size of the mechanism.
const BEYOND: f64 = 0.08;

/// Pitch of a drawn thread, relative to the size of the mechanism.
const PITCH: f64 = 0.045;

/// The rail, as long as the travel of the block, and the block.
pub(super) fn slide(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links, front: &mut Vec<Carrier>) {
    let Some([(i, p), (j, q)]) = subject.ends(joint) else { return };
    let Some((axis_frame, [ax, ay])) = subject.local(0, joint, Role::Axis) else { return };
    if axis_frame != i {
        return;
    }
    let Some(way) = Travel::of(subject, joint, i, p, [ax, ay], BEYOND * links.size()) else { return };
    let (from, to) = way.ends();
    match i {
        Frame::Ground => links.add(i, Part::Hatching { from, to }),
        Frame::Body(_) => links.slot(i, from, to),
    }
    links.attach(j, q);
    front.push(Carrier::new(subject.along_axis(joint, Role::Q), vec![Part::Block(Ink::of(j))]));
    let at = subject.track(joint, Role::Q);
    links.pin(joint.name, at.clone());
    // The point of a point-on-line joint can also turn: its block carries a pin.
    if joint.kind == JointKind::PointOnLine {
        front.push(upright(at, Part::held_by(j)));
    }
}

/// A body of which only x or only y is a coordinate slides on the ground without a joint that says so: a rail through its
/// origin, and a block. Nothing is drawn where a joint to the ground shows the rail.
pub(super) fn held(subject: &Subject<'_>, body: usize, info: &BodyInfo, links: &mut Links, front: &mut Vec<Carrier>) {
    let along = match (info.coordinates, info.origin) {
        ([Some(_), None, None], OriginKind::Free) => 0,
        ([None, Some(_), None], OriginKind::Free) => 1,
        _ => return,
    };
    let frame = Frame::Body(body);
    let shows_rail = |joint: &JointInfo| {
        matches!(joint.kind, JointKind::Translational | JointKind::PointOnLine | JointKind::Screw)
            && subject.ends(joint).is_some_and(|ends| {
                ends.iter().any(|(end, _)| *end == frame) && ends.iter().any(|(end, _)| *end == Frame::Ground)
            })
    };
    if subject.model.joints.iter().any(shows_rail) {
        return;
    }
    let track: Vec<[f64; 2]> = subject.instants().map(|k| placed(subject.pose(k, frame), [0.0; 2])).collect();
    if rail(&track, along, links) {
        links.attach(frame, [0.0; 2]);
        let angle = if along == 0 { 0.0 } else { FRAC_PI_2 };
        let poses = track.into_iter().map(|[x, y]| [x, y, angle]).collect();
        // Behind the pins of joints, which lie on the block.
        front.insert(0, Carrier::new(poses, vec![Part::Block(Ink::of(frame))]));
    }
}

/// A rail on the ground under a track along x (0) or y (1); false if the track leaves this line.
pub(super) fn rail(track: &[[f64; 2]], along: usize, links: &mut Links) -> bool {
    let [(least, most), (low, high)] = [along, 1 - along].map(|axis| bounds(track.iter().map(|p| p[axis])));
    let is_straight = high - low <= 1e-6 * links.size();
    if is_straight {
        let beyond = BEYOND * links.size();
        let at = |s: f64| if along == 0 { [s, low] } else { [low, s] };
        links.add(Frame::Ground, Part::Hatching { from: at(least - beyond), to: at(most + beyond) });
    }
    is_straight
}

/// A spindle, as long as the travel of its nut, and the nut. The thread is a symbol: the drawn pitch does not depend on
/// the lead.
pub(super) fn screw(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links, front: &mut Vec<Carrier>) {
    let Some([(i, p), (j, q)]) = subject.ends(joint) else { return };
    let Some((axis_frame, axis)) = subject.local(0, joint, Role::Axis) else { return };
    if axis_frame != i {
        return;
    }
    let Some(way) = Travel::of(subject, joint, i, p, axis, BEYOND * links.size()) else { return };
    let pitch = PITCH * links.size();
    for points in [thread(&way, pitch), way.beside(0.5 * pitch), way.beside(-0.5 * pitch)] {
        links.add(i, Part::line(points, Ink::of(i), Stroke::Thin));
    }
    links.attach(j, q);
    front.push(Carrier::new(subject.along_axis(joint, Role::Q), vec![Part::Block(Ink::of(j))]));
    links.pin(joint.name, subject.track(joint, Role::Q));
}

/// The zigzag line of a thread: from side to side, twice for every turn.
fn thread(way: &Travel, pitch: f64) -> Vec<[f64; 2]> {
    let turns = ((way.most - way.least) / pitch).round().clamp(3.0, 200.0);
    let step = (way.most - way.least) / (2.0 * turns);
    let corner = |k: usize| {
        let side = if k.is_multiple_of(2) { 0.5 * pitch } else { -0.5 * pitch };
        way.off(way.least + step * k as f64, side)
    };
    (0..=2 * turns as usize).map(corner).collect()
}

/// The travel of Q along an axis of the frame of P.
pub(super) struct Travel {
    start: [f64; 2],
    axis: [f64; 2],
    least: f64,
    most: f64,
}

impl Travel {
    /// The travel over all instants, extended by `beyond` at either end; the line is that of the first instant.
    pub(super) fn of(
        subject: &Subject<'_>,
        joint: &JointInfo,
        frame: Frame,
        p: [f64; 2],
        axis: [f64; 2],
        beyond: f64,
    ) -> Option<Self> {
        let seen = |k: usize| {
            let [x, y] = seen_from(subject.pose(k, frame), subject.point(k, joint, Role::Q)?);
            let (dx, dy) = (x - p[0], y - p[1]);
            Some((axis[0] * dx + axis[1] * dy, axis[0] * dy - axis[1] * dx))
        };
        let (_, offset) = seen(0)?;
        let (least, most) = bounds(subject.instants().filter_map(|k| seen(k).map(|(along, _)| along)));
        let start = [p[0] - offset * axis[1], p[1] + offset * axis[0]];
        Some(Self { start, axis, least: least - beyond, most: most + beyond })
    }

    /// Both ends in the frame.
    pub(super) fn ends(&self) -> ([f64; 2], [f64; 2]) {
        (self.at(self.least), self.at(self.most))
    }

    /// The line at a distance to the left.
    fn beside(&self, side: f64) -> Vec<[f64; 2]> {
        vec![self.off(self.least, side), self.off(self.most, side)]
    }

    fn off(&self, s: f64, side: f64) -> [f64; 2] {
        let [x, y] = self.at(s);
        [x - side * self.axis[1], y + side * self.axis[0]]
    }

    fn at(&self, s: f64) -> [f64; 2] {
        [self.start[0] + s * self.axis[0], self.start[1] + s * self.axis[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_goes_from_side_to_side_all_the_way() {
        let way = Travel { start: [0.0; 2], axis: [0.0, 1.0], least: -1.0, most: 1.0 };
        let points = thread(&way, 0.5);
        assert_eq!((points.len(), points[0], points[8]), (9, [-0.25, -1.0], [-0.25, 1.0]));
        assert!(points.windows(2).all(|pair| pair[0][0] == -pair[1][0] && pair[0][1] < pair[1][1]));
        // However small it is, it has turns that can be seen, and not too many.
        assert_eq!([thread(&way, 10.0).len(), thread(&way, 1e-9).len()], [7, 401]);
    }
}

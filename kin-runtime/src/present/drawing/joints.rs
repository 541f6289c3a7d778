//! The drawing of joints, kind by kind.

use super::carrier::{Carrier, upright};
use super::links::Links;
use super::part::{Ink, Part, Stroke};
use super::subject::{Pose, Subject, bounds, distance, is_still};
use super::{ropes, slides, wheels};
use crate::model::{Frame, JointInfo, JointKind, Role};

/// Draws a joint: on the bodies that it connects, and on carriers of its own behind and in front of them.
pub(super) fn draw(
    subject: &Subject<'_>,
    joint: &JointInfo,
    links: &mut Links,
    behind: &mut Vec<Carrier>,
    front: &mut Vec<Carrier>,
) {
    match joint.kind {
        JointKind::Revolute => pinned(subject, joint, links, front, Part::Pin([0.0; 2])),
        JointKind::Fixed => pinned(subject, joint, links, front, Part::Weld([0.0; 2])),
        JointKind::X | JointKind::Y => prescribed(subject, joint, links, front),
        JointKind::Translational | JointKind::PointOnLine => slides::slide(subject, joint, links, front),
        JointKind::Screw => slides::screw(subject, joint, links, front),
        JointKind::Distance => massless(subject, joint, links, behind, front),
        JointKind::Driver if super::subject::piece(joint, Role::Q).is_some() => {
            massless(subject, joint, links, behind, front);
        }
        JointKind::Rope => ropes::rope(subject, joint, links, behind, front),
        JointKind::Gear => wheels::gear(subject, joint, links),
        JointKind::Belt => wheels::belt(subject, joint, links, behind),
        JointKind::RackPinion => wheels::rack(subject, joint, links),
        JointKind::RollingOnLine => wheels::rolling_on_line(subject, joint, links),
        JointKind::RollingOnDisc => wheels::rolling_on_disc(subject, joint, links),
        JointKind::KnifeEdge | JointKind::Speed => tread(subject, joint, links, front),
        _ => {}
    }
}

/// Draws two points that coincide, in general by `part`, on the ground by a foot.
fn pinned(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links, front: &mut Vec<Carrier>, part: Part) {
    let Some([(i, p), (j, q)]) = subject.ends(joint) else { return };
    links.attach(i, p);
    links.attach(j, q);
    let track = subject.track(joint, Role::P);
    let on_ground = i == Frame::Ground || j == Frame::Ground;
    links.pin(joint.name, track.clone());
    front.push(upright(track, if on_ground { Part::Foot([0.0; 2]) } else { part }));
}

/// Draws a point with a prescribed x or y: with a foot if it never moves, otherwise with a guide.
fn prescribed(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links, front: &mut Vec<Carrier>) {
    let Some((frame, local)) = subject.local(0, joint, Role::P) else { return };
    links.attach(frame, local);
    let track = subject.track(joint, Role::P);
    if is_still(&track, links.size()) {
        front.push(upright(track, Part::Foot([0.0; 2])));
        return;
    }
    // If the prescribed coordinate moves, there is no rail.
    if slides::rail(&track, if joint.kind == JointKind::X { 1 } else { 0 }, links) {
        front.push(upright(track, Part::Pin([0.0; 2])));
    }
}

/// A massless link, or an actuator where its length changes.
fn massless(
    subject: &Subject<'_>,
    joint: &JointInfo,
    links: &mut Links,
    behind: &mut Vec<Carrier>,
    front: &mut Vec<Carrier>,
) {
    for role in [Role::P, Role::Q] {
        let Some((frame, local)) = subject.local(0, joint, role) else { return };
        links.attach(frame, local);
        front.push(upright(subject.track(joint, role), Part::held_by(frame)));
    }
    let (from, to) = (subject.track(joint, Role::P), subject.track(joint, Role::Q));
    let middle = from.iter().zip(&to).map(|(&[x, y], &[u, v])| [0.5 * (x + u), 0.5 * (y + v)]);
    links.pin(joint.name, middle.collect());
    let along = |from: &[[f64; 2]], to: &[[f64; 2]]| -> Vec<Pose> {
        from.iter().zip(to).map(|(&[x, y], &[u, v])| [x, y, (v - y).atan2(u - x)]).collect()
    };
    let (least, most) = bounds(from.iter().zip(&to).map(|(&a, &b)| distance(a, b)));
    let bar = |length: f64| Part::Bar { points: vec![[0.0; 2], [length, 0.0]], ink: Ink::Ground };
    if most - least <= 1e-6 * links.size() {
        behind.push(Carrier::new(along(&from, &to), vec![bar(most)]));
        return;
    }
    // The rod still reaches into the barrel at the greatest length, and does not come out of its end at the least.
    let barrel = (0.6 * most).min(0.9 * least);
    let rod = (most - 0.8 * barrel).min(least);
    let line = Part::line(vec![[0.0; 2], [rod, 0.0]], Ink::Ground, Stroke::Full);
    behind.push(Carrier::new(along(&to, &from), vec![line]));
    behind.push(Carrier::new(along(&from, &to), vec![bar(barrel)]));
}

/// Draws a wheel or blade that does not slip sideways.
fn tread(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links, front: &mut Vec<Carrier>) {
    let Some((frame, local)) = subject.local(0, joint, Role::P) else { return };
    links.attach(frame, local);
    front.push(Carrier::new(subject.along_axis(joint, Role::P), vec![Part::Tread]));
}

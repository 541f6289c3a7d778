//! Wheels: gears, belts, racks and rolling discs.
//!
//! Radii of gears and belts may be numbers of teeth, since only their ratio matters: they are scaled so that the wheels
//! meet on the line of centres.

use super::carrier::Carrier;
use super::links::Links;
use super::part::{Ink, Part, Stroke};
use super::slides::Travel;
use super::subject::{Subject, distance, piece, placed, seen_from};
use super::teeth::{Contact, Strip, Wheel};
use crate::model::{Frame, JointInfo, JointKind, Role};
use core::f64::consts::TAU;

/// Number of teeth of the smallest wheel.
const FEWEST: f64 = 14.0;

/// A wheel of a pair: its frame, its centre there, its radius.
#[derive(Clone, Copy)]
struct Half {
    frame: Frame,
    centre: [f64; 2],
    radius: f64,
}

/// Where a wheel's axle is in its own frame: the pin that holds it on the carrier, or else one that always is where the
/// carrier has a pin or its origin, as that of a sun in the ground beside the pin of its carrier; or its origin.
fn axle(subject: &Subject<'_>, wheel: Frame, carrier: Frame, size: f64) -> [f64; 2] {
    let pins = pins(subject, wheel);
    let held = pins.iter().find(|(_, other)| *other == carrier).or_else(|| {
        let on_carrier: Vec<[f64; 2]> = self::pins(subject, carrier).into_iter().map(|(at, _)| at).collect();
        let meets = |at: [f64; 2], other: [f64; 2]| {
            let places = |k: usize| [placed(subject.pose(k, wheel), at), placed(subject.pose(k, carrier), other)];
            subject.instants().map(places).all(|[a, b]| distance(a, b) <= 1e-6 * size)
        };
        let origin = [[0.0; 2]];
        let coaxial = |(at, _): &&([f64; 2], Frame)| on_carrier.iter().chain(&origin).any(|other| meets(*at, *other));
        pins.iter().filter(|_| wheel != Frame::Ground && carrier != Frame::Ground).find(coaxial)
    });
    held.map(|(at, _)| *at).unwrap_or_else(|| match wheel {
        // A wheel that is part of the ground is centred where the carrier is pinned.
        Frame::Ground => foot_of(subject, carrier, size).unwrap_or([0.0; 2]),
        Frame::Body(_) => [0.0; 2],
    })
}

/// The pins of a frame in that frame, with the frames on their other sides.
fn pins(subject: &Subject<'_>, frame: Frame) -> Vec<([f64; 2], Frame)> {
    let pins = subject.model.joints.iter().filter(|joint| joint.kind == JointKind::Revolute);
    let on_frame = pins.filter_map(|joint| {
        let [p, q] = [subject.local(0, joint, Role::P)?, subject.local(0, joint, Role::Q)?];
        let [on_frame, on_other] = if p.0 == frame { [p, q] } else { [q, p] };
        (on_frame.0 == frame).then_some((on_frame.1, on_other.0))
    });
    on_frame.collect()
}

/// Where a body is pinned to the ground.
fn foot_of(subject: &Subject<'_>, body: Frame, size: f64) -> Option<[f64; 2]> {
    (body != Frame::Ground).then(|| axle(subject, body, Frame::Ground, size)).map(|p| placed(subject.pose(0, body), p))
}

/// Both wheels of a gear or belt, with radii scaled by `meet` so that they fit; `None` if they have the same centre.
fn pair(subject: &Subject<'_>, joint: &JointInfo, size: f64, meet: impl Fn(f64, f64, f64) -> f64) -> Option<[Half; 2]> {
    let [(a, ra), (b, rb)] = subject.radii(joint)[..] else { return None };
    let carrier = piece(joint, Role::Value).map_or(Frame::Ground, |value| value.frame);
    let (ca, cb) = (axle(subject, a, carrier, size), axle(subject, b, carrier, size));
    let apart = distance(placed(subject.pose(0, a), ca), placed(subject.pose(0, b), cb));
    let scale = meet(ra, rb, apart);
    let halves = [Half { frame: a, centre: ca, radius: ra * scale }, Half { frame: b, centre: cb, radius: rb * scale }];
    (apart > 0.0 && scale.is_finite() && scale > 0.0).then_some(halves)
}

/// Two toothed wheels.
pub(super) fn gear(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links) {
    let Some([a, b]) = pair(subject, joint, links.size(), |ra, rb, apart| apart / (ra + rb).abs()) else { return };
    let [pa, pb] = [a, b].map(|half| placed(subject.pose(0, half.frame), half.centre));
    let across = (pb[1] - pa[1]).atan2(pb[0] - pa[0]);
    let opposite = across + core::f64::consts::PI;
    // The contact in the frame of each wheel at the first instant; in an internal gear it is on the far side of the
    // pinion.
    let (at_a, at_b) = match (a.radius < 0.0, b.radius < 0.0) {
        (true, _) => (across, across),
        (_, true) => (opposite, opposite),
        _ => (across, opposite),
    };
    let internal = (a.radius < 0.0) != (b.radius < 0.0);
    let turned = |half: Half| subject.pose(0, half.frame)[2];
    let pitch = pitch(subject, links, a.radius.abs().min(b.radius.abs()));
    let first = Contact { angle: at_a - turned(a), phase: None };
    let phase = mount(links, a, pitch, first);
    let meshing = if internal { 0.5 + phase } else { 0.5 - phase };
    mount(links, b, pitch, Contact { angle: at_b - turned(b), phase: Some(meshing) });
}

/// The circular pitch of all teeth of a mechanism. The first pair of wheels determines it, so that all wheels of a
/// train mesh.
fn pitch(subject: &Subject<'_>, links: &mut Links, smaller: f64) -> f64 {
    debug_assert!(!subject.snapshots.is_empty(), "a motion has an instant");
    links.wheels().first().map_or(TAU * smaller / FEWEST, |wheel| wheel.pitch)
}

/// Puts a toothed wheel on its body, unless the body has it already; returns the phase of its teeth at the contact, 0
/// on a tooth.
fn mount(links: &mut Links, half: Half, pitch: f64, contact: Contact) -> f64 {
    let Half { frame, centre, radius } = half;
    let same = 1e-6 * links.size();
    let known = links.wheels().iter().find(|wheel| {
        wheel.frame == frame && distance(wheel.centre, centre) <= same && (wheel.radius - radius).abs() <= same
    });
    if let Some(wheel) = known {
        return wheel.between_teeth(contact.angle);
    }
    let wheel = Wheel::new(frame, centre, radius, pitch, contact);
    for part in wheel.parts() {
        links.add(frame, part);
    }
    links.wheels().push(wheel);
    wheel.between_teeth(contact.angle)
}

/// Two discs and the belt around them; crossed where the radii differ in sign.
pub(super) fn belt(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links, behind: &mut Vec<Carrier>) {
    // Radii that are too large for the distance, such as numbers of teeth, are scaled so that half of it stays free.
    let fitting = |ra: f64, rb: f64, apart: f64| {
        let sum = ra.abs() + rb.abs();
        if sum < 0.95 * apart { 1.0 } else { 0.5 * apart / sum }
    };
    let Some([a, b]) = pair(subject, joint, links.size(), fitting) else { return };
    for half in [a, b] {
        let ink = Ink::of(half.frame);
        links.add(half.frame, Part::Disc { centre: half.centre, radius: half.radius, ink });
    }
    let places = |k: usize| [a, b].map(|half| placed(subject.pose(k, half.frame), half.centre));
    let poses = subject.instants().map(|k| {
        let [[x, y], [u, v]] = places(k);
        [x, y, (v - y).atan2(u - x)]
    });
    let [pa, pb] = places(0);
    let apart = distance(pa, pb);
    let (ra, rb, crossed) = (a.radius.abs(), b.radius.abs(), (a.radius < 0.0) != (b.radius < 0.0));
    let sin = (if crossed { ra + rb } else { ra - rb }) / apart;
    let cos = (1.0 - sin * sin).max(0.0).sqrt();
    let far = if crossed { -rb } else { rb };
    let strand = |side: f64| {
        let points = vec![[ra * sin, side * ra * cos], [apart + far * sin, side * far * cos]];
        Part::line(points, Ink::Ground, Stroke::Full)
    };
    behind.push(Carrier::new(poses.collect(), vec![strand(1.0), strand(-1.0)]));
}

/// A pinion and the teeth of its rack, as long as the travel of the rack.
pub(super) fn rack(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links) {
    let Some([(guide, p), (bar, q)]) = subject.ends(joint) else { return };
    let Some((_, axis)) = subject.local(0, joint, Role::Axis) else { return };
    let &[(pinion, radius)] = &subject.radii(joint)[..] else { return };
    let Some(direction) = subject.direction(0, joint) else { return };
    links.attach(bar, q);
    let centre = axle(subject, pinion, guide, links.size());
    let pitch = pitch(subject, links, radius.abs());
    // Seen along the axis, a positive radius meshes on the right of the axle.
    let down = direction - core::f64::consts::FRAC_PI_2 * radius.signum();
    let contact = Contact { angle: down - subject.pose(0, pinion)[2], phase: None };
    let phase = mount(links, Half { frame: pinion, centre, radius: radius.abs() }, pitch, contact);
    let beyond = 0.1 * links.size();
    let Some(way) = Travel::of(subject, joint, guide, p, axis, beyond) else { return };
    let ([fx, fy], [tx, ty]) = way.ends();
    let length = (tx - fx).hypot(ty - fy);
    let [cx, cy] = placed(subject.pose(0, pinion), centre);
    let touch = [cx + radius.abs() * down.cos(), cy + radius.abs() * down.sin()];
    // Relative to the rack, the contact moves opposite to the travel of the rack.
    let start = subject.point(0, joint, Role::Q).map_or(0.0, |point| {
        let [x, y] = seen_from(subject.pose(0, guide), point);
        (x - fx) * axis[0] + (y - fy) * axis[1]
    });
    let strip = Strip { touch, direction, down, before: length - start, after: start, pitch, phase };
    let points = strip.points().into_iter().map(|place| seen_from(subject.pose(0, bar), place)).collect();
    links.add(bar, Part::line(points, Ink::of(bar), Stroke::Full));
}

/// A disc, and the line under it.
pub(super) fn rolling_on_line(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links) {
    let Some([(i, p), (j, q)]) = subject.ends(joint) else { return };
    let Some((_, [ax, ay])) = subject.local(0, joint, Role::Axis) else { return };
    let &[(_, radius)] = &subject.radii(joint)[..] else { return };
    links.attach(j, q);
    links.add(j, Part::Disc { centre: q, radius, ink: Ink::of(j) });
    let Some(way) = Travel::of(subject, joint, i, p, [ax, ay], radius.abs()) else { return };
    // The path of the centre, moved down by the radius.
    let down = |[x, y]: [f64; 2]| [x + radius * ay, y - radius * ax];
    let (from, to) = way.ends();
    let (from, to) = (down(from), down(to));
    match i {
        Frame::Ground if radius < 0.0 => links.add(i, Part::Hatching { from: to, to: from }),
        Frame::Ground => links.add(i, Part::Hatching { from, to }),
        Frame::Body(_) => links.add(i, Part::line(vec![from, to], Ink::of(i), Stroke::Full)),
    }
}

/// Two discs.
pub(super) fn rolling_on_disc(subject: &Subject<'_>, joint: &JointInfo, links: &mut Links) {
    for (role, radius) in [Role::P, Role::Q].into_iter().zip(subject.radii(joint)) {
        let Some((frame, centre)) = subject.local(0, joint, role) else { return };
        links.attach(frame, centre);
        links.add(frame, Part::Disc { centre, radius: radius.1, ink: Ink::of(frame) });
    }
}

//! Cams and other curves, and their followers.

use super::links::Links;
use super::part::{Ink, Part, Stroke};
use super::subject::{Subject, bounds, distance, seen_from};
use crate::model::{CoordinateKind, Frame, JointInfo, JointKind, Role};
use core::f64::consts::TAU;

/// Number of points of a curve.
const SAMPLES: usize = 180;

/// Draws the curve of a contact on its body, and the follower on the other.
pub(super) fn draw(subject: &Subject<'_>, place: usize, joint: &JointInfo, links: &mut Links) {
    let range = match joint.kind {
        JointKind::OnPolarCurve | JointKind::FlatFollower => Some((0.0, TAU)),
        JointKind::OnParametricCurve => parameter(subject, place, joint, links.size()),
        JointKind::OnImplicitCurve => None,
        _ => return,
    };
    let Some([(i, p), (j, q)]) = subject.ends(joint) else { return };
    links.attach(j, q);
    let points = match range {
        Some((from, to)) => sampled(subject, place, from, to),
        None => followed(subject, joint, i),
    };
    let closed = match (points.first(), points.last()) {
        (Some(&first), Some(&last)) => distance(first, last) <= 1e-6 * links.size(),
        _ => return,
    };
    if joint.kind == JointKind::FlatFollower {
        face(subject, joint, &points, p, links, Ink::of(j));
    }
    links.add(i, Part::Line { points, ink: Ink::of(i), stroke: Stroke::Full, closed });
    if let Some(&(_, radius)) = subject.radii(joint).first()
        && radius != 0.0
    {
        links.add(j, Part::Disc { centre: q, radius, ink: Ink::of(j) });
    }
}

/// A curve in the frame of its body.
fn sampled(subject: &Subject<'_>, place: usize, from: f64, to: f64) -> Vec<[f64; 2]> {
    let at = |k: usize| (subject.curve)(0, place, from + (to - from) * k as f64 / SAMPLES as f64);
    let points = (0..=SAMPLES).filter_map(|k| at(k).map(|point| point.r));
    points.filter(|r| r.iter().all(|x| x.is_finite())).collect()
}

/// The part of a curve that the contact passes during the motion: the path of the follower in the frame of the curve's
/// body.
fn followed(subject: &Subject<'_>, joint: &JointInfo, frame: Frame) -> Vec<[f64; 2]> {
    let seen = |k: usize| Some(seen_from(subject.pose(k, frame), subject.point(k, joint, Role::Q)?));
    subject.instants().filter_map(seen).collect()
}

/// The range of a curve's parameter: a whole turn if the curve closes after that, otherwise a little more than its
/// range during the motion.
fn parameter(subject: &Subject<'_>, place: usize, joint: &JointInfo, size: f64) -> Option<(f64, f64)> {
    let model = subject.model;
    let rows = joint.first_row..joint.first_row + joint.rows;
    let mut columns = model.constraint_pattern.entries.iter().filter(|(row, _)| rows.contains(row));
    let &(_, column) = columns.find(|(_, column)| model.coordinates[*column].kind == CoordinateKind::Scalar)?;
    let (least, most) = bounds(subject.snapshots.iter().filter_map(|snapshot| snapshot.q.get(column).copied()));
    let at = |u: f64| (subject.curve)(0, place, u).map(|point| point.r);
    if let (Some(start), Some(end)) = (at(least), at(least + TAU))
        && distance(start, end) <= 1e-9 * size
    {
        return Some((least, least + TAU));
    }
    let beyond = 0.05 * (most - least);
    (most > least).then_some((least - beyond, most + beyond))
}

/// The flat face of a follower. It extends to both sides of its point as far as the cam extends from its centre `p`,
/// since the contact is not farther away.
fn face(subject: &Subject<'_>, joint: &JointInfo, cam: &[[f64; 2]], p: [f64; 2], links: &mut Links, ink: Ink) {
    let Some((frame, [ax, ay])) = subject.local(0, joint, Role::Axis) else { return };
    let Some((_, [qx, qy])) = subject.local(0, joint, Role::Q) else { return };
    let reach = 1.05 * cam.iter().map(|&r| distance(r, p)).fold(0.0, f64::max);
    let end = |s: f64| [qx + s * ax, qy + s * ay];
    links.add(frame, Part::line(vec![end(-reach), end(reach)], ink, Stroke::Full));
}

//! The paths of the named points.

use super::links::Links;
use super::part::{Ink, Part, Stroke};
use super::subject::{Subject, is_still};

/// A path for every point that moves, in the inertial frame; the points themselves go on their bodies.
pub(super) fn paths(subject: &Subject<'_>, links: &mut Links) -> Vec<Part> {
    let mut paths = Vec::new();
    for (place, point) in subject.model.points.iter().enumerate() {
        let ink = Ink::Path(place);
        if let Some(&[x, y]) = subject.snapshots[0].geometry.get(point.local..point.local + 2) {
            links.add(point.frame, Part::Dot([x, y], ink));
        }
        let track = subject.snapshots.iter().filter_map(|snapshot| snapshot.points.get(place).copied());
        let points: Vec<[f64; 2]> = track.collect();
        if points.len() > 1 && !is_still(&points, links.size()) {
            paths.push(Part::Line { points, ink, stroke: Stroke::Path, closed: false });
        }
    }
    paths
}

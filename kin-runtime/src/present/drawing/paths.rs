//! The paths of the named points.

use super::links::Links;
use super::part::{Ink, Part};
use super::subject::{Snapshot, Subject, distance, is_still};

/// A path for every point that moves, in the inertial frame; the points themselves go on their bodies.
pub(super) fn paths(subject: &Subject<'_>, links: &mut Links) -> Vec<Part> {
    let mut paths = Vec::new();
    for (place, point) in subject.model.points.iter().enumerate() {
        let ink = Ink::Path(place);
        if let Some(&[x, y]) = subject.snapshots[0].geometry.get(point.local..point.local + 2) {
            links.add(point.frame, Part::Dot([x, y], ink));
        }
        let at = |snapshot: &Snapshot| snapshot.points.get(place).copied();
        let points: Vec<[f64; 2]> = subject.snapshots.iter().filter_map(at).collect();
        if points.len() > 1 && !is_still(&points, links.size()) {
            let moments: Vec<Moment> = subject
                .snapshots
                .iter()
                .filter_map(|snapshot| Some((snapshot.t, at(snapshot)?, *snapshot.velocities.get(place)?)))
                .collect();
            let controls = moments.windows(2).map(|pair| controls(pair[0], pair[1])).collect();
            paths.push(Part::Path { points, controls, ink });
        }
    }
    paths
}

/// Time, place and velocity of a point.
type Moment = (f64, [f64; 2], [f64; 2]);

/// The inner control points of the curve from one place to the next with the velocity of the point at both (Hermite's
/// cubic). Velocities grow without bounds near a limit; control points are therefore no farther from their places than
/// the two places are from one another.
fn controls((t, p, v): Moment, (u, q, w): Moment) -> [[f64; 2]; 2] {
    let (third, most) = ((u - t) / 3.0, distance(p, q));
    let handle = |[x, y]: [f64; 2]| {
        let (x, y) = (x * third, y * third);
        let length = x.hypot(y);
        let share = if length > most { most / length } else { 1.0 };
        if share.is_finite() && length.is_finite() { [x * share, y * share] } else { [0.0; 2] }
    };
    let ([a, b], [c, d]) = (handle(v), handle(w));
    [[p[0] + a, p[1] + b], [q[0] - c, q[1] - d]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_places_of_a_circle_are_enough_for_it() {
        let moment = |k: i32| {
            let t = f64::from(k) * core::f64::consts::TAU / 12.0;
            (t, [t.cos(), t.sin()], [-t.sin(), t.cos()])
        };
        for k in 0..12 {
            let (from, to) = (moment(k), moment(k + 1));
            let [a, b] = controls(from, to);
            let middle = [0, 1].map(|axis| (from.1[axis] + 3.0 * (a[axis] + b[axis]) + to.1[axis]) / 8.0);
            assert!((middle[0].hypot(middle[1]) - 1.0).abs() < 3e-4, "{middle:?}");
        }
    }

    #[test]
    fn a_velocity_without_bounds_leaves_the_curve_between_its_ends() {
        let [a, b] = controls((0.0, [0.0; 2], [1.0, 0.0]), (1.0, [1.0, 0.0], [0.0, 1e9]));
        assert_eq!((a, b[0]), ([1.0 / 3.0, 0.0], 1.0));
        assert!((b[1] + 1.0).abs() < 1e-12, "{b:?}");
    }
}

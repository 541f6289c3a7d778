//! Ropes: taut lines whose parts change their lengths.

use super::carrier::{Carrier, upright};
use super::links::Links;
use super::part::{Ink, Part, Stroke};
use super::subject::{Pose, Subject, bounds, distance, placed};
use crate::model::{Geometry, JointInfo, Role};

/// Largest number of pieces that a part of a rope is drawn with.
const PIECES: f64 = 64.0;

/// A rope over its points. A part whose length changes is drawn as pieces, which overlap when the part is short; one that
/// almost vanishes is then drawn a little too long.
pub(super) fn rope(
    subject: &Subject<'_>,
    joint: &JointInfo,
    links: &mut Links,
    behind: &mut Vec<Carrier>,
    front: &mut Vec<Carrier>,
) {
    let is_point = |piece: &&Geometry| matches!(piece.role, Role::P | Role::Via | Role::Q);
    let points: Vec<&Geometry> = joint.geometry.iter().filter(is_point).collect();
    let mut tracks: Vec<Vec<[f64; 2]>> = Vec::new();
    for point in points {
        let Some(local) = subject.numbers::<2>(0, point) else { return };
        links.attach(point.frame, local);
        let at = |k: usize| Some(placed(subject.pose(k, point.frame), subject.numbers::<2>(k, point)?));
        let track: Vec<[f64; 2]> = subject.instants().filter_map(at).collect();
        front.push(upright(track.clone(), Part::held_by(point.frame)));
        tracks.push(track);
    }
    for ends in tracks.windows(2) {
        behind.extend(taut(&ends[0], &ends[1]));
    }
}

/// A taut line between two points.
fn taut(from: &[[f64; 2]], to: &[[f64; 2]]) -> Vec<Carrier> {
    let lengths: Vec<f64> = from.iter().zip(to).map(|(&a, &b)| distance(a, b)).collect();
    let (least, most) = bounds(lengths.iter().copied());
    let count = (most / least).ceil().clamp(1.0, PIECES);
    let piece = most / count;
    let line = || Part::line(vec![[0.0; 2], [piece, 0.0]], Ink::Ground, Stroke::Full);
    let numbers = (0..count as usize).map(|k| k as f64 / (count - 1.0).max(1.0));
    let carrier = |share: f64| {
        let poses: Vec<Pose> = (from.iter().zip(to).zip(&lengths))
            .map(|((&[x, y], &[u, v]), length)| {
                let angle = (v - y).atan2(u - x);
                let (sin, cos) = angle.sin_cos();
                let ahead = share * (length - piece);
                [x + ahead * cos, y + ahead * sin, angle]
            })
            .collect();
        Carrier::new(poses, vec![line()])
    };
    numbers.map(carrier).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rope_has_no_gaps_also_where_a_part_almost_vanishes() {
        for shortest in [1.0, 0.3, 0.001, 0.0] {
            let pieces = taut(&[[0.0; 2]; 2], &[[1.0, 0.0], [shortest, 0.0]]);
            let Part::Line { points, .. } = &pieces[0].parts[0] else { panic!("no line") };
            let length = points[1][0];
            for (k, end) in [(0, 1.0), (1, shortest)] {
                let mut starts: Vec<f64> = pieces.iter().map(|piece| piece.poses[k][0]).collect();
                starts.sort_by(f64::total_cmp);
                let reach =
                    starts.iter().fold(0.0, |reach, start| if *start <= reach + 1e-9 { start + length } else { reach });
                assert!((reach - end).abs() < 0.02, "{shortest}: drawn up to {reach} instead of {end}");
            }
        }
    }
}

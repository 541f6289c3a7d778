//! The outlines of toothed wheels and racks, with teeth that mesh.

use super::part::{Ink, Part, Stroke};
use crate::model::Frame;
use core::f64::consts::TAU;

/// Height of a tooth above and below the pitch circle, relative to the pitch.
const HEIGHT: f64 = 0.28;

/// The corners of a tooth, both roots and both ends of the tip: positions as shares of the pitch, and heights.
fn corners(height: f64) -> [(f64, f64); 4] {
    [(-0.36, -height), (-0.16, height), (0.16, height), (0.36, -height)]
}

/// The angle of a contact on a wheel, in the wheel's frame, and the phase of its teeth there.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    pub(super) angle: f64,
    /// 0 on a tooth, ½ in a gap; `None` if the phase may be chosen.
    pub(super) phase: Option<f64>,
}

/// A toothed wheel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wheel {
    pub(super) frame: Frame,
    pub(super) centre: [f64; 2],
    /// Negative for a ring.
    pub(super) radius: f64,
    pub(super) pitch: f64,
    teeth: f64,
    /// The angle of a tooth.
    start: f64,
}

impl Wheel {
    pub(super) fn new(frame: Frame, centre: [f64; 2], radius: f64, pitch: f64, contact: Contact) -> Self {
        let teeth = (TAU * radius.abs() / pitch).round().clamp(6.0, 240.0);
        let start = contact.angle - contact.phase.unwrap_or(0.0) * TAU / teeth;
        Self { frame, centre, radius, pitch, teeth, start }
    }

    /// The phase of the teeth at an angle of the wheel's frame.
    pub(super) fn between_teeth(&self, angle: f64) -> f64 {
        ((angle - self.start) * self.teeth / TAU).rem_euclid(1.0)
    }

    /// The outline, the rim of a ring, and a spoke.
    pub(super) fn parts(&self) -> Vec<Part> {
        let Self { frame, centre: [x, y], radius, .. } = *self;
        let (ink, r) = (Ink::of(frame), radius.abs());
        let height = HEIGHT * self.pitch;
        let at = |angle: f64, r: f64| [x + r * angle.cos(), y + r * angle.sin()];
        let tooth = |k: usize| {
            corners(height).map(|(part, up)| {
                let up = if radius < 0.0 { -up } else { up };
                at(self.start + (k as f64 + part) * TAU / self.teeth, r + up)
            })
        };
        let mut points: Vec<[f64; 2]> = (0..self.teeth as usize).flat_map(tooth).collect();
        // A ring is hollow: its outline returns to its start without being filled.
        points.extend((radius < 0.0).then(|| points[0]));
        let outline = Part::Line { points, ink, stroke: Stroke::Full, closed: radius > 0.0 };
        let circle = |r: f64| (0..=90).map(|k| at(f64::from(k) * TAU / 90.0, r)).collect();
        let line = |points, stroke| Part::Line { points, ink, stroke, closed: false };
        let mut parts = vec![outline, line(circle(r), Stroke::Dashed)];
        match radius < 0.0 {
            true => parts.push(line(circle(r + 3.0 * height), Stroke::Full)),
            false => {
                for spoke in [0.0, TAU / 3.0, 2.0 * TAU / 3.0] {
                    let angle = self.start + spoke;
                    parts.push(line(vec![[x, y], at(angle, r - 1.5 * height)], Stroke::Thin));
                }
            }
        }
        parts
    }
}

/// The teeth of a rack in the inertial frame.
pub(super) struct Strip {
    /// The contact with the pinion.
    pub(super) touch: [f64; 2],
    /// The angle of the direction of the rack.
    pub(super) direction: f64,
    /// The angle of the direction from the pinion to the rack.
    pub(super) down: f64,
    /// How far the rack extends from the contact against its direction.
    pub(super) before: f64,
    /// How far it extends along its direction.
    pub(super) after: f64,
    pub(super) pitch: f64,
    /// The phase of the pinion's teeth at the contact.
    pub(super) phase: f64,
}

impl Strip {
    /// Corners from one end to the other.
    pub(super) fn points(&self) -> Vec<[f64; 2]> {
        let Self { touch: [x, y], direction, down, pitch, .. } = *self;
        let height = HEIGHT * pitch;
        // The pinion turns with the rack's travel if the rack is on its right, and against it if it is on its left.
        let side = if (down - direction).sin() < 0.0 { -1.0 } else { 1.0 };
        let first = (0.5 + side * self.phase) * pitch;
        let at =
            |s: f64, up: f64| [x + s * direction.cos() - up * down.cos(), y + s * direction.sin() - up * down.sin()];
        let count = |length: f64| (length / pitch).ceil() as i32;
        let teeth = -count(self.before)..=count(self.after);
        let corners = corners(height);
        teeth.flat_map(|k| corners.map(|(part, up)| at(first + (f64::from(k) + part) * pitch, up))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tooth_stands_where_the_contact_asks_for_it() {
        let contact = Contact { angle: 0.4, phase: Some(0.5) };
        let wheel = Wheel::new(Frame::Body(0), [0.0; 2], 0.2, 0.03, contact);
        assert!((wheel.between_teeth(0.4) - 0.5).abs() < 1e-12);
        assert_eq!(wheel.teeth, 42.0);
    }
}

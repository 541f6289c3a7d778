//! Forces and couples as arrows whose size is proportional to them: the reactions of joints on the body of the second
//! operand, at the joint's point, the efforts of drivers, and the forces of gravity, applied loads and springs.
//!
//! The arrow of the largest force of the whole motion is a quarter of the mechanism's size long. Couples have a scale
//! of their own; a couple without a point is drawn in the middle of its body.

use super::carrier::Carrier;
use super::links::Links;
use super::part::{Ink, Part};
use super::subject::{Pose, Subject, placed};
use crate::forces::{Effort, Forces};
use crate::model::{Component, CoordinateKind, Frame};
use core::f64::consts::{PI, TAU};

/// The length of the largest arrow, relative to the size of the mechanism.
const LONGEST: f64 = 0.25;
/// The share of the largest arrow above which arrows have a head of full size.
const FULL_HEAD: f64 = 0.1;
/// Forces and couples that never exceed this share of the largest are rounding errors and are not drawn.
const NOTHING: f64 = 1e-9;

/// The scale of the arrows of forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ForceScale {
    /// The largest force.
    pub(crate) largest: f64,
    /// The length of its arrow.
    pub(crate) length: f64,
}

/// The arrows of a motion.
pub(super) struct Arrows {
    /// Shafts, heads and couples.
    pub(super) carriers: Vec<Carrier>,
    /// The scale of forces; `None` without forces.
    pub(super) scale: Option<ForceScale>,
}

/// A force or a couple over the motion, with its point.
struct Track<T> {
    ink: Ink,
    /// The point and the value at every instant; `None` if the forces of that instant are unknown.
    values: Vec<Option<([f64; 2], T)>>,
}

impl Arrows {
    /// The arrows of all forces that the instants hold.
    pub(super) fn new(subject: &Subject<'_>, links: &Links) -> Self {
        let mut out = Self { carriers: Vec::new(), scale: None };
        let Some(known) = subject.snapshots.iter().find_map(|snapshot| snapshot.forces.as_ref()) else { return out };
        let (mut forces, mut couples) = (Vec::new(), Vec::new());
        for (place, reaction) in known.reactions.iter().enumerate() {
            let reaction_in = |forces: &Forces| forces.reactions.get(place).cloned();
            forces.push(track(subject, Ink::Reaction, |_, forces| {
                let reaction = reaction_in(forces)?;
                reaction.point.zip(reaction.force)
            }));
            couples.push(track(subject, Ink::Reaction, |k, forces| {
                let reaction = reaction_in(forces)?;
                let point = reaction.point.or_else(|| middle(subject, links, k, reaction.on?));
                point.zip(reaction.moment)
            }));
            for (which, (frame, _)) in reaction.couples.iter().enumerate() {
                couples.push(track(subject, Ink::Reaction, |k, forces| {
                    let couple = reaction_in(forces)?.couples.get(which)?.1;
                    Some((middle(subject, links, k, *frame)?, couple))
                }));
            }
        }
        for (place, effort) in known.efforts.iter().enumerate() {
            let effort_in = |forces: &Forces| forces.efforts.get(place)?.effort;
            match driven(subject, known, effort) {
                Some((body, Component::Phi)) => couples.push(track(subject, Ink::Effort, |k, forces| {
                    Some((middle(subject, links, k, Frame::Body(body))?, effort_in(forces)?))
                })),
                Some((body, component)) => forces.push(track(subject, Ink::Effort, |k, forces| {
                    let [x, y, _] = subject.pose(k, Frame::Body(body));
                    let effort = effort_in(forces)?;
                    Some(([x, y], if component == Component::X { [effort, 0.0] } else { [0.0, effort] }))
                })),
                None => {}
            }
        }
        let loads = subject.snapshots.first().map_or(0, |snapshot| snapshot.loads.len());
        for place in 0..loads {
            let load_in = |k: usize| subject.snapshots[k].loads.get(place);
            forces.push(track(subject, Ink::Load, |k, _| load_in(k)?.force.map(|[point, force]| (point, force))));
            couples.push(track(subject, Ink::Load, |k, _| {
                let load = load_in(k)?;
                middle(subject, links, k, load.on).zip(load.couple)
            }));
        }
        out.draw_couples(couples);
        out.draw_forces(forces, LONGEST * links.size());
        out
    }

    fn draw_forces(&mut self, forces: Vec<Track<[f64; 2]>>, longest: f64) {
        let size = |[x, y]: [f64; 2]| x.hypot(y);
        let Some(largest) = largest(&forces, size) else { return };
        self.scale = Some(ForceScale { largest, length: longest });
        for track in forces.into_iter().filter(|track| track.reaches(NOTHING * largest, size)) {
            let (mut shafts, mut heads) = ((Vec::new(), Vec::new()), (Vec::new(), Vec::new()));
            let (mut at, mut angle) = (track.first(), 0.0_f64);
            for value in &track.values {
                let (point, force) = value.unwrap_or((at, [0.0; 2]));
                let share = size(force) / largest;
                at = point;
                if share > NOTHING {
                    // Between two instants the arrow turns by less than half a turn.
                    angle += (force[1].atan2(force[0]) - angle + PI).rem_euclid(TAU) - PI;
                }
                let (sin, cos) = angle.sin_cos();
                let head = (share / FULL_HEAD).min(1.0);
                let length = share * longest;
                shafts.0.push([point[0], point[1], angle]);
                // The shaft ends inside of the head.
                shafts.1.push((share - 0.3 * FULL_HEAD * head).max(0.0));
                heads.0.push([point[0] + length * cos, point[1] + length * sin, angle]);
                heads.1.push(head);
            }
            let part =
                |(poses, sizes): (Vec<Pose>, Vec<f64>), part| Carrier { sizes, ..Carrier::new(poses, vec![part]) };
            self.carriers.push(part(shafts, Part::Shaft(longest, track.ink)));
            self.carriers.push(part(heads, Part::Head(track.ink)));
        }
    }

    fn draw_couples(&mut self, couples: Vec<Track<f64>>) {
        let Some(largest) = largest(&couples, f64::abs) else { return };
        for track in couples.into_iter().filter(|track| track.reaches(NOTHING * largest, f64::abs)) {
            let mut at = track.first();
            let values = track.values.iter().map(|value| {
                let (point, couple) = value.unwrap_or((at, 0.0));
                at = point;
                (point, couple / largest)
            });
            let values: Vec<([f64; 2], f64)> = values.collect();
            for clockwise in [false, true] {
                let sign = if clockwise { -1.0 } else { 1.0 };
                let sizes: Vec<f64> = values.iter().map(|(_, share)| (sign * share).max(0.0)).collect();
                if sizes.iter().any(|size| *size > NOTHING) {
                    let poses = values.iter().map(|&([x, y], _)| [x, y, 0.0]).collect();
                    let turn = Part::Turn { clockwise, ink: track.ink };
                    self.carriers.push(Carrier { sizes, ..Carrier::new(poses, vec![turn]) });
                }
            }
        }
    }
}

impl<T: Copy> Track<T> {
    fn first(&self) -> [f64; 2] {
        self.values.iter().flatten().next().map_or([0.0; 2], |(point, _)| *point)
    }

    fn reaches(&self, least: f64, size: impl Fn(T) -> f64) -> bool {
        self.values.iter().flatten().any(|(_, value)| size(*value) > least)
    }
}

/// The values of one force or couple over the motion.
fn track<T>(subject: &Subject<'_>, ink: Ink, value: impl Fn(usize, &Forces) -> Option<([f64; 2], T)>) -> Track<T> {
    let values = subject.snapshots.iter().enumerate();
    Track { ink, values: values.map(|(k, snapshot)| value(k, snapshot.forces.as_ref()?)).collect() }
}

/// The largest of all values; `None` if all are zero.
fn largest<T: Copy>(tracks: &[Track<T>], size: impl Fn(T) -> f64) -> Option<f64> {
    let values = tracks.iter().flat_map(|track| &track.values).flatten();
    let largest = values.fold(0.0, |largest: f64, (_, value)| largest.max(size(*value)));
    (largest > 0.0 && largest.is_finite()).then_some(largest)
}

/// The middle of a body, or its origin if nothing is attached to it; `None` for the ground.
fn middle(subject: &Subject<'_>, links: &Links, instant: usize, frame: Frame) -> Option<[f64; 2]> {
    match frame {
        Frame::Ground => None,
        Frame::Body(body) => Some(placed(subject.pose(instant, frame), links.middle(body).unwrap_or_default())),
    }
}

/// The body that a driver drives, with the component of its pose. If the driver prescribes the difference of two
/// angles, that is the body whose angle counts positive. `None` for other formulas, such as a sum of angles, whose effort
/// acts on both bodies alike, and for drivers that are drawn as reactions.
fn driven(subject: &Subject<'_>, forces: &Forces, effort: &Effort) -> Option<(usize, Component)> {
    let model = subject.model;
    let joint = model.joints.iter().find(|joint| joint.name == effort.name)?;
    if joint.rows != 1 || forces.reaction(joint.name).is_some_and(|reaction| reaction.on.is_some()) {
        return None;
    }
    let pattern = &model.constraint_pattern;
    let entries = pattern.entries.iter().enumerate().filter(|(_, (row, _))| *row == joint.first_row);
    let (mut found, mut subtracted) = (None, false);
    for (entry, &(_, column)) in entries {
        let constant = pattern.constants.iter().find(|(place, _)| *place == entry)?.1;
        let CoordinateKind::Pose { body, component } = model.coordinates[column].kind else { return None };
        match (constant, found) {
            (1.0, None) => found = Some((body, component)),
            (-1.0, _) if component == Component::Phi && !subtracted => subtracted = true,
            _ => return None,
        }
    }
    found.filter(|(_, component)| *component == Component::Phi || !subtracted)
}

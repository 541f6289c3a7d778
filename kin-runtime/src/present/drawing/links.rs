//! The shapes of bodies: a bar through the points where joints are attached, the plate that these points span, or arms
//! from an axle to all other points. A slot is connected with the nearest point.

use super::carrier::{Carrier, upright};
use super::part::{Ink, Part};
use super::subject::{Pose, Subject, bounds, distance, is_still, placed, seen_from};
use super::teeth::Wheel;
use crate::model::{Frame, JointKind, OriginKind, Role};

/// Places nearer than this, relative to the size of the mechanism, are one.
const SAME_PLACE: f64 = 1e-6;

/// The parts of the bodies and of the ground that have been collected so far.
pub(super) struct Links {
    bodies: Vec<BodyParts>,
    ground: Vec<Part>,
    pins: Vec<(String, Vec<[f64; 2]>)>,
    wheels: Vec<Wheel>,
    size: f64,
}

/// The parts of a body that have been collected so far.
#[derive(Default)]
struct BodyParts {
    attached: Vec<Attachment>,
    slots: Vec<[[f64; 2]; 2]>,
    parts: Vec<Part>,
}

/// A point at which something is attached to a body.
struct Attachment {
    at: [f64; 2],
    /// Whether a joint is attached here, and not only a named point.
    held: bool,
}

impl Links {
    /// Bodies with their named points, and with pins where the origin of a body is fixed to another frame.
    pub(super) fn new(subject: &Subject<'_>, front: &mut Vec<Carrier>) -> Self {
        let model = subject.model;
        let bodies = model.bodies.iter().map(|_| BodyParts::default()).collect();
        let mut links = Self { bodies, ground: Vec::new(), pins: Vec::new(), wheels: Vec::new(), size: size(subject) };
        for point in model.points {
            if let Some(&[x, y]) = subject.snapshots[0].geometry.get(point.local..point.local + 2) {
                links.place(point.frame, [x, y], false);
            }
        }
        for (body, info) in model.bodies.iter().enumerate() {
            if info.coordinates[0].is_some() || info.coordinates[1].is_some() {
                continue;
            }
            let frame = Frame::Body(body);
            let track: Vec<[f64; 2]> = subject.instants().map(|k| placed(subject.pose(k, frame), [0.0; 2])).collect();
            let carrier = match info.origin {
                OriginKind::Carried(carrier) => carrier,
                OriginKind::Free => Frame::Ground,
            };
            links.attach(frame, [0.0; 2]);
            links.attach(carrier, seen_from(subject.pose(0, carrier), track[0]));
            let on_ground = carrier == Frame::Ground;
            if !on_ground || is_still(&track, links.size) {
                front.push(upright(track, Part::held_by(carrier)));
            }
        }
        links
    }

    /// A typical length of the mechanism.
    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// Makes a joint's place part of a body's shape; the ground has none.
    pub(super) fn attach(&mut self, frame: Frame, place: [f64; 2]) {
        self.place(frame, place, true);
    }

    fn place(&mut self, frame: Frame, at: [f64; 2], held: bool) {
        let same = SAME_PLACE * self.size;
        let Some(body) = self.body(frame) else { return };
        match body.attached.iter_mut().find(|other| distance(other.at, at) <= same) {
            Some(other) => other.held |= held,
            None => body.attached.push(Attachment { at, held }),
        }
    }

    /// Gives a body a slot.
    pub(super) fn slot(&mut self, frame: Frame, from: [f64; 2], to: [f64; 2]) {
        if let Some(body) = self.body(frame) {
            body.slots.push([from, to]);
        }
        self.add(frame, Part::Slot { from, to, ink: Ink::of(frame) });
    }

    /// Puts a part on a body or on the ground.
    pub(super) fn add(&mut self, frame: Frame, part: Part) {
        match self.body(frame) {
            Some(body) => body.parts.push(part),
            None => self.ground.push(part),
        }
    }

    /// Adds the name of a joint with its positions at all instants.
    pub(super) fn pin(&mut self, name: &str, track: Vec<[f64; 2]>) {
        self.pins.push((name.to_owned(), track));
    }

    /// The names of joints with their positions at all instants.
    pub(super) fn pins(&self) -> &[(String, Vec<[f64; 2]>)] {
        &self.pins
    }

    /// The mean of the places that are attached to a body, in its frame; if one of them is near this mean, the mean of
    /// the first two.
    pub(super) fn middle(&self, body: usize) -> Option<[f64; 2]> {
        let places = &self.bodies.get(body)?.attached;
        let mean = |places: &[Attachment]| {
            let count = places.len().max(1) as f64;
            places.iter().fold([0.0; 2], |[x, y], Attachment { at: [u, v], .. }| [x + u / count, y + v / count])
        };
        let middle = mean(places);
        let reach = places.iter().map(|place| distance(place.at, middle)).fold(0.0, f64::max);
        let taken = places.iter().any(|place| distance(place.at, middle) < 0.1 * reach);
        Some(if taken { mean(&places[..2]) } else { middle })
    }

    /// The toothed wheels so far.
    pub(super) fn wheels(&mut self) -> &mut Vec<Wheel> {
        &mut self.wheels
    }

    /// The parts of the ground.
    pub(super) fn take_ground(&mut self) -> Vec<Part> {
        core::mem::take(&mut self.ground)
    }

    /// A carrier for every body, large ones behind small ones.
    pub(super) fn into_carriers(self, subject: &Subject<'_>) -> Vec<Carrier> {
        let bodies = self.bodies.into_iter().enumerate();
        let carriers = bodies.map(|(place, body)| {
            let poses: Vec<Pose> = subject.instants().map(|k| subject.pose(k, Frame::Body(place))).collect();
            Carrier { body: Some(place), ..Carrier::new(poses, body.shape(Ink::Body(place))) }
        });
        let mut carriers: Vec<Carrier> = carriers.collect();
        carriers.sort_by(|a, b| b.reach().total_cmp(&a.reach()));
        carriers
    }

    fn body(&mut self, frame: Frame) -> Option<&mut BodyParts> {
        match frame {
            Frame::Ground => None,
            Frame::Body(body) => self.bodies.get_mut(body),
        }
    }
}

impl BodyParts {
    fn shape(self, ink: Ink) -> Vec<Part> {
        let Self { mut attached, slots, parts } = self;
        if attached.len() == 1 && slots.is_empty() && parts.is_empty() && attached[0].at != [0.0; 2] {
            // The only known place of this body is one joint: it is drawn as a bar from the joint to the origin.
            attached.push(Attachment { at: [0.0; 2], held: false });
        }
        let bar = |from, to| Part::Bar { points: vec![from, to], ink };
        let hung = slots.iter().filter_map(|slot| nearest(slot, &attached)).map(|(from, to)| bar(from, to));
        let hung: Vec<Part> = hung.collect();
        let outline = hull(attached.iter().map(|place| place.at).collect());
        let outline_parts = match (outline.len(), axle(&attached, &outline)) {
            (0, _) if parts.is_empty() => vec![Part::Dot([0.0; 2], ink)],
            (0 | 1, _) => Vec::new(),
            (_, Some(axle)) => outline.into_iter().map(|corner| bar(axle, corner)).collect(),
            (_, None) => vec![Part::Bar { points: outline, ink }],
        };
        hung.into_iter().chain(outline_parts).chain(parts).collect()
    }
}

/// A joint strictly inside the outline of all joints: such a body is drawn with arms from there instead of an outline.
fn axle(attached: &[Attachment], outline: &[[f64; 2]]) -> Option<[f64; 2]> {
    let extent = outline.iter().map(|&corner| distance(corner, outline[0])).fold(0.0, f64::max);
    let within = |p: [f64; 2]| {
        let sides = outline.iter().zip(outline.iter().cycle().skip(1));
        outline.len() > 2 && sides.into_iter().all(|(&a, &b)| turn(a, b, p) > SAME_PLACE * extent * extent)
    };
    let corners_held = attached.iter().filter(|place| outline.contains(&place.at)).all(|place| place.held);
    attached.iter().find(|place| corners_held && place.held && within(place.at)).map(|place| place.at)
}

/// The line from a slot to the nearest of some points; `None` if one of them lies in the slot.
fn nearest([from, to]: &[[f64; 2]; 2], places: &[Attachment]) -> Option<([f64; 2], [f64; 2])> {
    let (along, length) = ([to[0] - from[0], to[1] - from[1]], distance(*from, *to));
    let foot = |[x, y]: [f64; 2]| {
        let part = ((x - from[0]) * along[0] + (y - from[1]) * along[1]) / (length * length).max(f64::MIN_POSITIVE);
        let part = part.clamp(0.0, 1.0);
        [from[0] + part * along[0], from[1] + part * along[1]]
    };
    let ways = places.iter().map(|place| (foot(place.at), place.at));
    let shortest = ways.min_by(|(a, b), (c, d)| distance(*a, *b).total_cmp(&distance(*c, *d)));
    shortest.filter(|(a, b)| distance(*a, *b) > SAME_PLACE * length)
}

/// The convex hull, counter-clockwise; of places on a line the two ends (Andrew's monotone chain).
fn hull(mut places: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    if places.len() < 3 {
        return places;
    }
    places.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let extent = distance(places[0], places[places.len() - 1]);
    let mut outline = chain(places.iter().copied(), extent);
    let upper = chain(places.iter().rev().copied(), extent);
    outline.pop();
    outline.extend(&upper[..upper.len() - 1]);
    outline
}

/// One side of the hull.
fn chain(places: impl Iterator<Item = [f64; 2]>, extent: f64) -> Vec<[f64; 2]> {
    let mut side: Vec<[f64; 2]> = Vec::new();
    for p in places {
        while let [.., a, b] = side[..]
            && turn(a, b, p) <= SAME_PLACE * extent * extent
        {
            side.pop();
        }
        side.push(p);
    }
    side
}

/// Twice the area of a triangle, positive where its corners go counter-clockwise.
fn turn(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The larger extent of the origins and points at the first instant and of the dimensions that joints have; 1 where
/// there are none.
fn size(subject: &Subject<'_>) -> f64 {
    let model = subject.model;
    let mut places: Vec<[f64; 2]> = subject.snapshots[0].points.clone();
    for joint in model.joints {
        for role in [Role::P, Role::Q] {
            places.extend(subject.point(0, joint, role));
        }
    }
    places.extend((0..model.bodies.len()).map(|b| placed(subject.pose(0, Frame::Body(b)), [0.0; 2])));
    let extent = |axis: usize| {
        let (low, high) = bounds(places.iter().map(|place| place[axis]));
        high - low
    };
    // Radii of gears and belts may be numbers of teeth.
    let lengths = model.joints.iter().filter(|joint| !matches!(joint.kind, JointKind::Gear | JointKind::Belt));
    let radii = lengths.flat_map(|joint| subject.radii(joint)).map(|(_, radius)| radius.abs());
    let largest = radii.fold(extent(0).max(extent(1)), f64::max);
    if largest.is_finite() && largest > 0.0 { largest } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_has_the_corners_alone_and_a_line_its_ends() {
        let square = [[0.0, 0.0], [1.0, 1.0], [0.5, 0.5], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0]];
        assert_eq!(hull(square.to_vec()), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let line = [[0.0, 0.0], [2.0, 1.0], [1.0, 0.5]];
        assert_eq!(hull(line.to_vec()), [[0.0, 0.0], [2.0, 1.0]]);
        assert_eq!(hull(vec![[3.0, 1.0]]), [[3.0, 1.0]]);
    }
    /// Joints at `held`, names at `named`.
    fn shape(held: &[[f64; 2]], named: &[[f64; 2]], slots: Vec<[[f64; 2]; 2]>) -> Vec<Vec<[f64; 2]>> {
        let place = |held: bool| move |&at: &[f64; 2]| Attachment { at, held };
        let attached = held.iter().map(place(true)).chain(named.iter().map(place(false))).collect();
        let parts = BodyParts { attached, slots, parts: Vec::new() }.shape(Ink::Ground);
        parts.into_iter().map(|part| if let Part::Bar { points, .. } = part { points } else { Vec::new() }).collect()
    }

    #[test]
    fn a_joint_amid_others_has_arms_and_a_name_amid_them_lies_on_their_plate() {
        let (corners, middle) = ([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], [1.0, 1.0]);
        let star = shape(&[corners[0], corners[1], corners[2], middle], &[], Vec::new());
        assert_eq!(star, corners.map(|corner| vec![middle, corner]));
        assert_eq!(shape(&corners, &[middle], Vec::new()), [corners.to_vec()]);
    }

    #[test]
    fn a_slot_hangs_on_the_nearest_place_and_spans_no_plate() {
        let slot = [[0.0, -1.0], [0.0, 1.0]];
        assert_eq!(
            shape(&[[3.0, 0.5], [5.0, 0.5]], &[], vec![slot]),
            [vec![[0.0, 0.5], [3.0, 0.5]], vec![[3.0, 0.5], [5.0, 0.5]]]
        );
        assert_eq!(shape(&[[0.0, 0.5], [5.0, 0.5]], &[], vec![slot]), [vec![[0.0, 0.5], [5.0, 0.5]]]);
    }
}

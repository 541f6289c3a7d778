//! The shapes of bodies: a bar through the places where something is attached, or the plate that they span.

use super::joints::{is_still, upright};
use super::part::{Ink, Part};
use super::scene::Carrier;
use super::subject::{Pose, Subject, distance, placed, seen_from};
use super::wheels::Wheel;
use crate::model::{Frame, JointKind, OriginKind, Role};

/// Places nearer than this, relative to the size of the mechanism, are one.
const SAME: f64 = 1e-6;

/// What the bodies and the ground have so far.
pub(super) struct Links {
    bodies: Vec<Body>,
    ground: Vec<Part>,
    pins: Vec<(String, Vec<[f64; 2]>)>,
    wheels: Vec<Wheel>,
    size: f64,
}

/// What a body has so far.
#[derive(Default)]
struct Body {
    attached: Vec<[f64; 2]>,
    parts: Vec<Part>,
}

impl Links {
    /// Bodies with the points that they carry and the origins that hold them.
    pub(super) fn new(subject: &Subject<'_>, front: &mut Vec<Carrier>) -> Self {
        let model = subject.model;
        let bodies = model.bodies.iter().map(|_| Body::default()).collect();
        let mut links = Self { bodies, ground: Vec::new(), pins: Vec::new(), wheels: Vec::new(), size: size(subject) };
        for point in model.points {
            if let Some(&[x, y]) = subject.snapshots[0].geometry.get(point.local..point.local + 2) {
                links.attach(point.frame, [x, y]);
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
                let part = if on_ground { Part::Foot([0.0; 2]) } else { Part::Pin([0.0; 2]) };
                front.push(upright(track, part));
            }
        }
        links
    }

    /// A length that is typical of the whole mechanism.
    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// Makes a place part of a body's shape; the ground has none.
    pub(super) fn attach(&mut self, frame: Frame, place: [f64; 2]) {
        let same = SAME * self.size;
        if let Some(body) = self.body(frame)
            && body.attached.iter().all(|&other| distance(other, place) > same)
        {
            body.attached.push(place);
        }
    }

    /// Puts a part on a body or on the ground.
    pub(super) fn add(&mut self, frame: Frame, part: Part) {
        match self.body(frame) {
            Some(body) => body.parts.push(part),
            None => self.ground.push(part),
        }
    }

    /// Notes a place by its name.
    pub(super) fn pin(&mut self, name: &str, track: Vec<[f64; 2]>) {
        self.pins.push((name.to_owned(), track));
    }

    /// The places noted, with their names.
    pub(super) fn pins(&self) -> &[(String, Vec<[f64; 2]>)] {
        &self.pins
    }

    /// The middle of what is attached to a body, in its frame.
    pub(super) fn middle(&self, body: usize) -> Option<[f64; 2]> {
        let places = &self.bodies.get(body)?.attached;
        let count = places.len().max(1) as f64;
        Some(places.iter().fold([0.0; 2], |[x, y], [u, v]| [x + u / count, y + v / count]))
    }

    /// The toothed wheels so far.
    pub(super) fn wheels(&mut self) -> &mut Vec<Wheel> {
        &mut self.wheels
    }

    /// What the ground shows.
    pub(super) fn take_ground(&mut self) -> Vec<Part> {
        core::mem::take(&mut self.ground)
    }

    /// A carrier for every body, large ones behind small ones.
    pub(super) fn into_carriers(self, subject: &Subject<'_>) -> Vec<Carrier> {
        let bodies = self.bodies.into_iter().enumerate();
        let carriers = bodies.map(|(place, body)| {
            let poses: Vec<Pose> = subject.instants().map(|k| subject.pose(k, Frame::Body(place))).collect();
            Carrier { body: Some(place), poses, parts: body.shape(Ink::Body(place)) }
        });
        let mut carriers: Vec<Carrier> = carriers.collect();
        carriers.sort_by(|a, b| reach(b).total_cmp(&reach(a)));
        carriers
    }

    fn body(&mut self, frame: Frame) -> Option<&mut Body> {
        match frame {
            Frame::Ground => None,
            Frame::Body(body) => self.bodies.get_mut(body),
        }
    }
}

impl Body {
    fn shape(self, ink: Ink) -> Vec<Part> {
        let Self { mut attached, parts } = self;
        if attached.len() == 1 && parts.is_empty() && attached[0] != [0.0; 2] {
            // All that is known of this body is where its frame is and that something holds it.
            attached.push([0.0; 2]);
        }
        let outline = hull(attached);
        let own = match outline.len() {
            0 if parts.is_empty() => Some(Part::Dot([0.0; 2], ink)),
            0 | 1 => None,
            _ => Some(Part::Bar { points: outline, ink }),
        };
        own.into_iter().chain(parts).collect()
    }
}

/// How far the parts of a carrier go from one another.
fn reach(carrier: &Carrier) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for part in &carrier.parts {
        part.reach(&mut |place| {
            for axis in 0..2 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        });
    }
    (high[0] - low[0]).max(high[1] - low[1])
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
            && (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= SAME * extent * extent
        {
            side.pop();
        }
        side.push(p);
    }
    side
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
        let (low, high) = places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
            (low.min(place[axis]), high.max(place[axis]))
        });
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
    use super::hull;

    #[test]
    fn a_hull_has_the_corners_alone_and_a_line_its_ends() {
        let square = [[0.0, 0.0], [1.0, 1.0], [0.5, 0.5], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0]];
        assert_eq!(hull(square.to_vec()), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let line = [[0.0, 0.0], [2.0, 1.0], [1.0, 0.5]];
        assert_eq!(hull(line.to_vec()), [[0.0, 0.0], [2.0, 1.0]]);
        assert_eq!(hull(vec![[3.0, 1.0]]), [[3.0, 1.0]]);
    }
}

//! Colours: bodies that are near one another in the mechanism have different ones.

use crate::model::{Frame, Model, OriginKind};
use std::collections::VecDeque;

/// Colours that people with any kind of colour vision tell apart (Okabe and Ito, 2008), without yellow and black, and
/// darker ones (of Tol's muted scheme) for mechanisms with more bodies.
const COLOURS: [&str; 11] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#332288", "#882255", "#999933", "#aa4499",
    "#661100",
];

/// The colours of bodies and of the paths of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Palette {
    bodies: usize,
    colours: Vec<usize>,
}

impl Palette {
    /// Each body, and after the bodies each point, takes an unused colour, or else the colour whose nearest use is
    /// farthest away, counted in joints.
    pub(super) fn of(model: &Model) -> Self {
        let neighbours = neighbours(model);
        let mut colours: Vec<usize> = Vec::with_capacity(neighbours.len());
        for node in 0..neighbours.len() {
            let mut nearest = [usize::MAX; COLOURS.len()];
            let distances = distances(&neighbours, node);
            for (&colour, &distance) in colours.iter().zip(&distances) {
                // A body that is connected with no other is as far away as possible, but its colour is used.
                nearest[colour] = nearest[colour].min(distance.unwrap_or(usize::MAX - 1));
            }
            let farthest = (0..COLOURS.len()).rev().max_by_key(|&colour| nearest[colour]).unwrap_or(0);
            colours.push(farthest);
        }
        Self { bodies: model.bodies.len(), colours }
    }

    /// The colour of a body.
    pub(super) fn body(&self, body: usize) -> &'static str {
        self.colours.get(body).map_or(COLOURS[0], |&colour| COLOURS[colour])
    }

    /// The colour of a point and of its path.
    pub(super) fn point(&self, point: usize) -> &'static str {
        self.body(self.bodies + point)
    }
}

/// For every body and every point, the bodies that a joint, a carried origin or the point itself connects it with.
fn neighbours(model: &Model) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); model.bodies.len() + model.points.len()];
    let mut connect = |a: usize, b: usize| {
        if a != b {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
    };
    for joint in model.joints {
        let frames = joint.geometry.iter().map(|piece| piece.frame).chain(joint.frames.into_iter().flatten());
        let mut bodies: Vec<usize> = frames.filter_map(body).collect();
        bodies.sort_unstable();
        bodies.dedup();
        for (place, &a) in bodies.iter().enumerate() {
            bodies[place + 1..].iter().for_each(|&b| connect(a, b));
        }
    }
    for (carried, info) in model.bodies.iter().enumerate() {
        if let OriginKind::Carried(Frame::Body(carrier)) = info.origin {
            connect(carried, carrier);
        }
    }
    for (place, point) in model.points.iter().enumerate() {
        if let Some(carrier) = body(point.frame) {
            connect(model.bodies.len() + place, carrier);
        }
    }
    neighbours
}

fn body(frame: Frame) -> Option<usize> {
    match frame {
        Frame::Ground => None,
        Frame::Body(body) => Some(body),
    }
}

/// How many joints are between a node and each of the others.
fn distances(neighbours: &[Vec<usize>], from: usize) -> Vec<Option<usize>> {
    let mut distances = vec![None; neighbours.len()];
    distances[from] = Some(0);
    let mut queue = VecDeque::from([(from, 0)]);
    while let Some((node, distance)) = queue.pop_front() {
        for &next in &neighbours[node] {
            if distances[next].is_none() {
                distances[next] = Some(distance + 1);
                queue.push_back((next, distance + 1));
            }
        }
    }
    distances
}

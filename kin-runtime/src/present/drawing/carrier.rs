//! Rigid groups of a drawing.

use super::part::Part;
use super::subject::Pose;

/// A group of parts that moves rigidly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Carrier {
    /// The body that it shows, if it shows one.
    pub(crate) body: Option<usize>,
    /// A pose for every instant, or a single one if it never moves.
    pub(crate) poses: Vec<Pose>,
    /// Its parts.
    pub(crate) parts: Vec<Part>,
    /// The factor by which it is enlarged at every instant, for arrows; empty if its size is constant.
    pub(crate) sizes: Vec<f64>,
}

impl Carrier {
    /// Parts that belong to no body, with their poses.
    pub(super) fn new(poses: Vec<Pose>, parts: Vec<Part>) -> Self {
        Self { body: None, poses, parts, sizes: Vec::new() }
    }

    /// The factor by which it is enlarged at an instant.
    pub(crate) fn size(&self, instant: usize) -> f64 {
        self.sizes.get(instant).copied().unwrap_or(1.0)
    }

    /// The extent of the parts.
    pub(super) fn reach(&self) -> f64 {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for part in &self.parts {
            part.reach(&mut |place| {
                for axis in 0..2 {
                    low[axis] = low[axis].min(place[axis]);
                    high[axis] = high[axis].max(place[axis]);
                }
            });
        }
        (high[0] - low[0]).max(high[1] - low[1])
    }
}

/// A part that moves along a track without turning.
pub(super) fn upright(track: Vec<[f64; 2]>, part: Part) -> Carrier {
    Carrier::new(track.into_iter().map(|[x, y]| [x, y, 0.0]).collect(), vec![part])
}

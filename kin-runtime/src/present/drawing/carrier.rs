//! What moves as a rigid whole in a drawing.

use super::part::Part;
use super::subject::Pose;

/// Something that moves as a rigid whole.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Carrier {
    /// The body it is, where it is one.
    pub(crate) body: Option<usize>,
    /// A pose for every instant, or a single one where it never moves.
    pub(crate) poses: Vec<Pose>,
    /// What it shows.
    pub(crate) parts: Vec<Part>,
    /// How large it is shown at each instant, for arrows; nothing where it never changes its size.
    pub(crate) sizes: Vec<f64>,
}

impl Carrier {
    /// Parts of no body in particular, with their poses.
    pub(super) fn new(poses: Vec<Pose>, parts: Vec<Part>) -> Self {
        Self { body: None, poses, parts, sizes: Vec::new() }
    }

    /// How large it is shown at an instant.
    pub(crate) fn size(&self, instant: usize) -> f64 {
        self.sizes.get(instant).copied().unwrap_or(1.0)
    }

    /// How far the parts go from one another.
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

/// A part that stands upright along a track.
pub(super) fn upright(track: Vec<[f64; 2]>, part: Part) -> Carrier {
    Carrier::new(track.into_iter().map(|[x, y]| [x, y, 0.0]).collect(), vec![part])
}

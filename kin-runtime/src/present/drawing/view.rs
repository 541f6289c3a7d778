//! The transformation from lengths (y up) to pixels (y down).

use super::part::Part;
use super::scene::Scene;
use super::subject::{Pose, placed};
use core::fmt;

/// Room for a drawing, in pixels of a small screen.
const ROOM: [f64; 2] = [640.0, 480.0];
/// Margin around it for symbols and names.
const MARGIN: f64 = 34.0;
/// Least ratio of the shorter side of a view to the longer one.
const NARROWEST: f64 = 0.3;

/// The rectangle of the plane that is shown, and its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    /// Pixels per length.
    pub(crate) scale: f64,
    left: f64,
    top: f64,
    /// Width and height in pixels.
    pub(crate) size: [f64; 2],
}

impl View {
    /// The view that contains all scenes at all instants.
    pub(crate) fn of<'s>(scenes: impl IntoIterator<Item = &'s Scene>) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for scene in scenes {
            for carrier in &scene.carriers {
                for part in &carrier.parts {
                    for &pose in &carrier.poses {
                        part.reach(&mut |place| {
                            let place = placed(pose, place);
                            for axis in 0..2 {
                                low[axis] = low[axis].min(place[axis]);
                                high[axis] = high[axis].max(place[axis]);
                            }
                        });
                    }
                }
            }
        }
        if !(low.iter().chain(&high).all(|x| x.is_finite())) {
            (low, high) = ([-1.0; 2], [1.0; 2]);
        }
        let extent = [0, 1].map(|axis| high[axis] - low[axis]);
        let largest = extent[0].max(extent[1]);
        let largest = if largest > 0.0 { largest } else { 1.0 };
        let shown = extent.map(|extent| extent.max(NARROWEST * largest));
        let inner = ROOM.map(|room| room - 2.0 * MARGIN);
        let scale = (inner[0] / shown[0]).min(inner[1] / shown[1]);
        let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        let size = shown.map(|length| length * scale + 2.0 * MARGIN);
        Self { scale, left: middle[0] - 0.5 * size[0] / scale, top: middle[1] + 0.5 * size[1] / scale, size }
    }

    /// A point of the plane in pixels.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.left) * self.scale, (self.top - y) * self.scale]
    }

    /// A pose in pixels and degrees, clockwise as pictures count.
    pub(crate) fn pose(&self, [x, y, phi]: Pose) -> [f64; 3] {
        let [x, y] = self.at([x, y]);
        [x, y, -phi.to_degrees()]
    }

    /// A point of a carrier in pixels from the carrier's origin.
    pub(super) fn local(&self, [u, v]: [f64; 2]) -> Pixels {
        Pixels([u * self.scale, -v * self.scale])
    }

    /// Half the width of pins and blocks: smaller where there are many of them.
    pub(super) fn symbol(&self, scene: &Scene) -> f64 {
        let symbols = |part: &&Part| matches!(part, Part::Pin(_) | Part::Foot(_) | Part::Block(_) | Part::Weld(_));
        let count = scene.carriers.iter().flat_map(|carrier| &carrier.parts).filter(symbols).count();
        (24.0 / (4.0 + count as f64).sqrt()).clamp(1.5, 5.0)
    }
}

/// A place in a picture.
#[derive(Clone, Copy)]
pub(super) struct Pixels(pub(super) [f64; 2]);

impl fmt::Display for Pixels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.0.map(short);
        write!(f, "{x},{y}")
    }
}

/// A number of pixels, to the hundredth.
pub(crate) fn short(x: f64) -> f64 {
    // Zero without a sign.
    (x * 100.0).round() / 100.0 + 0.0
}

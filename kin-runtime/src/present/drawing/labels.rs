//! The positions of names: each is on the side of its point on which it collides least with other names and with the
//! drawing, over the whole motion.

use super::part::{LabelKind, Part};
use super::scene::Scene;
use super::subject::placed;
use super::view::View;

/// Number of instants at which collisions are counted.
const INSTANTS: usize = 12;
/// Pixels between two points of a bar that a name should not cover.
const STEP: f64 = 6.0;
/// With more names than this collisions are not avoided: such drawings are read enlarged.
const MAX_PLACED_NAMES: usize = 150;
/// Cost of a collision with another name, in points of a bar.
const NAME: f64 = 40.0;
/// Cost of leaving the picture, in points of a bar.
const OUTSIDE: f64 = 20.0;

/// The position of a text relative to the point that it names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    /// The point of the baseline that `anchor` names, relative to the named point.
    pub(super) at: [f64; 2],
    /// `start`, `middle` or `end`, as SVG says it.
    pub(super) anchor: &'static str,
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    low: [f64; 2],
    high: [f64; 2],
}

/// The sides of the names of all carriers; the default side for carriers without a name.
pub(super) fn sides(scene: &Scene, view: &View, symbol: f64) -> Vec<Side> {
    let usual = candidates(symbol, 12.0)[0];
    let mut sides = vec![usual; scene.carriers.len()];
    let names = scene.carriers.iter().enumerate().filter_map(|(place, carrier)| match &carrier.parts[..] {
        [Part::Name(text, kind)] => Some((place, text.chars().count() as f64, *kind)),
        _ => None,
    });
    let names: Vec<(usize, f64, LabelKind)> = names.collect();
    if names.len() > MAX_PLACED_NAMES {
        return sides;
    }
    let count = scene.times.len();
    let instants: Vec<usize> = (0..INSTANTS.min(count)).map(|k| k * count / INSTANTS.min(count)).collect();
    let drawn: Vec<Vec<[f64; 2]>> = instants.iter().map(|&instant| ink(scene, view, instant)).collect();
    let mut taken: Vec<Vec<Frame>> = vec![Vec::new(); instants.len()];
    for (place, letters, kind) in names {
        let size = if kind == LabelKind::Joint { 10.0 } else { 12.0 };
        let width = 0.56 * size * letters;
        let origin = |k: usize| {
            let [x, y, _] = view.pose(scene.pose(&scene.carriers[place], instants[k]));
            [x, y]
        };
        let cost = |side: &Side| -> f64 {
            let one = |k: usize| {
                let frame = Frame::of(side, origin(k), width, size);
                let inside = drawn[k].iter().filter(|&&point| frame.holds(point, symbol)).count() as f64;
                let collisions = taken[k].iter().filter(|other| frame.meets(other)).count() as f64;
                let outside = if frame.within(view.size) { 0.0 } else { OUTSIDE };
                inside + NAME * collisions + outside
            };
            (0..instants.len()).map(one).sum()
        };
        let candidates = candidates(symbol, size);
        let best = candidates.iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).copied().unwrap_or(usual);
        for (k, taken) in taken.iter_mut().enumerate() {
            taken.push(Frame::of(&best, origin(k), width, size));
        }
        sides[place] = best;
    }
    sides
}

/// The eight sides, the default first.
fn candidates(symbol: f64, size: f64) -> [Side; 8] {
    let (aside, up, down) = (symbol + 1.0, -1.3 * symbol - 2.0, 1.3 * symbol + 0.8 * size);
    let (far, level) = (1.6 * symbol + 3.0, 0.35 * size);
    [
        Side { at: [aside, up], anchor: "start" },
        Side { at: [-aside, up], anchor: "end" },
        Side { at: [aside, down], anchor: "start" },
        Side { at: [-aside, down], anchor: "end" },
        Side { at: [far, level], anchor: "start" },
        Side { at: [-far, level], anchor: "end" },
        Side { at: [0.0, up - symbol], anchor: "middle" },
        Side { at: [0.0, down + symbol], anchor: "middle" },
    ]
}

impl Frame {
    fn of(side: &Side, [x, y]: [f64; 2], width: f64, size: f64) -> Self {
        let left = x + side.at[0]
            - match side.anchor {
                "start" => 0.0,
                "middle" => 0.5 * width,
                _ => width,
            };
        let base = y + side.at[1];
        Self { low: [left, base - 0.8 * size], high: [left + width, base + 0.2 * size] }
    }

    /// Whether a point lies in the rectangle enlarged by `near` on all sides.
    fn holds(&self, point: [f64; 2], near: f64) -> bool {
        (0..2).all(|axis| self.low[axis] - near <= point[axis] && point[axis] <= self.high[axis] + near)
    }

    fn meets(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    fn within(&self, size: [f64; 2]) -> bool {
        (0..2).all(|axis| self.low[axis] >= 0.0 && self.high[axis] <= size[axis])
    }
}

/// Points of everything that is drawn at an instant, a few pixels apart along bars.
fn ink(scene: &Scene, view: &View, instant: usize) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for carrier in &scene.carriers {
        let pose = scene.pose(carrier, instant);
        let at = |place| view.at(placed(pose, place));
        for part in &carrier.parts {
            let outline = match part {
                Part::Bar { points, .. } => points.clone(),
                &Part::Slot { from, to, .. } | &Part::Hatching { from, to } => vec![from, to],
                Part::Name(..) | Part::Path { .. } => continue,
                other => {
                    other.reach(&mut |place| points.push(at(place)));
                    continue;
                }
            };
            let closed = outline.len() > 2;
            let sides = outline.iter().zip(outline.iter().cycle().skip(1)).take(outline.len() - usize::from(!closed));
            for (&from, &to) in sides {
                let ([x, y], [u, v]) = (at(from), at(to));
                let pieces = ((u - x).hypot(v - y) / STEP).ceil().clamp(1.0, 200.0);
                points.extend((0..=pieces as usize).map(|k| {
                    let share = k as f64 / pieces;
                    [x + share * (u - x), y + share * (v - y)]
                }));
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::drawing::carrier::Carrier;

    #[test]
    fn names_in_one_place_take_different_sides() {
        let name = |text: &str| Carrier::new(vec![[0.0; 3]], vec![Part::Name(text.to_owned(), LabelKind::Point)]);
        let points = vec![[-1.0, -1.0], [1.0, 1.0]];
        let bar = Carrier::new(vec![[0.0; 3]], vec![Part::Bar { points, ink: super::super::part::Ink::Ground }]);
        let mut scene = Scene::empty(vec![0.0]);
        scene.carriers = vec![bar, name("first"), name("second"), name("third")];
        let view = View::of([&scene]);
        let chosen = sides(&scene, &view, 5.0);
        let frames: Vec<Frame> = (1..4)
            .map(|k| Frame::of(&chosen[k], view.at([0.0; 2]), 0.56 * 12.0 * if k == 2 { 6.0 } else { 5.0 }, 12.0))
            .collect();
        for (place, frame) in frames.iter().enumerate() {
            assert!(frames[place + 1..].iter().all(|other| !frame.meets(other)), "{frames:?}");
            // The bar goes up to the right, where names usually stand.
            assert!(ink(&scene, &view, 0).iter().all(|&point| !frame.holds(point, 0.0)), "{frame:?}");
        }
    }
}

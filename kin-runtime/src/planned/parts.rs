//! Parts of a step, over which quantities are enclosed in interval arithmetic.
//!
//! Between its ends q₀ and q₁ a step is followed along the cubic through both (see [`interior`](super::interior)). A box
//! that contains the cubic over a part of the step gives enclosures there; a part in which they are too wide is halved.

use crate::mechanism::LengthError;
use crate::scalar::Interval;
use crate::signal::Signal;

/// How often a step is halved at most: its shortest parts are a millionth of it.
pub(super) const HALVINGS: u32 = 20;

/// The largest number of parts of the same length.
pub(super) const MOST_PARTS: usize = 256;

/// If too many parts have an excess, those are left out whose excess is at most this, relative to the largest one.
const NEGLIGIBLE_EXCESS: f64 = 1e-3;

/// A step: q₀, q̇₀, q₁ and q̇₁, the inputs at its start, and its length.
#[derive(Clone, Copy)]
pub(crate) struct Span<'a> {
    /// The configurations and rates at both ends.
    pub(crate) ends: [&'a [f64]; 4],
    /// The inputs at the start.
    pub(crate) inputs: &'a [Signal],
    /// The length of the step.
    pub(crate) h: f64,
}

/// Halves a step, and each part whose excess is above 1, and looks at the middle of every such part: false where
/// `stays_at` is false, `None` where more than `most` parts of the same length would result. The whole step has been looked
/// at. The excess is a function of the beginning and the length of a part.
pub(super) fn halve(
    most: usize,
    excess: &mut dyn FnMut(f64, f64) -> Result<f64, LengthError>,
    stays_at: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<Option<bool>, LengthError> {
    divide([2, most], excess, stays_at)
}

/// Divides a step into `first` parts, and goes on as [`halve`].
pub(super) fn divide(
    [first, most]: [usize; 2],
    excess: &mut dyn FnMut(f64, f64) -> Result<f64, LengthError>,
    stays_at: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<Option<bool>, LengthError> {
    // The parts are numbered from the beginning of the step.
    let (mut parts, mut count, mut width) = ([0_u32; MOST_PARTS], first, 1.0 / first as f64);
    for (part, number) in parts.iter_mut().zip(0..first as u32) {
        *part = number;
    }
    for _ in 0..HALVINGS {
        if count == 0 {
            break;
        }
        let (mut excesses, mut halves, mut halved) = ([0.0; MOST_PARTS], [0_u32; MOST_PARTS], 0);
        for (&part, to) in parts[..count].iter().zip(&mut excesses) {
            *to = excess(f64::from(part) * width, width)?;
        }
        let wide = excesses.iter().filter(|excess| **excess > 1.0).count();
        let largest = excesses.into_iter().fold(0.0, f64::max);
        let least = if 2 * wide > most { NEGLIGIBLE_EXCESS * largest } else { 0.0 };
        for (&part, _) in parts[..count].iter().zip(excesses).filter(|(_, excess)| *excess > 1.0 && *excess >= least) {
            if !stays_at((f64::from(part) + 0.5) * width)? {
                return Ok(Some(false));
            }
            if halved + 2 > most {
                return Ok(None);
            }
            (halves[halved], halves[halved + 1]) = (2 * part, 2 * part + 1);
            halved += 2;
        }
        (parts, count, width) = (halves, halved, 0.5 * width);
    }
    Ok(Some(true))
}

/// Writes a box that contains the cubic from a place over a part of the step: the hull of its Bézier points.
pub(super) fn hull(to: &mut [Interval], Span { ends: [q0, v0, q1, v1], h, .. }: Span<'_>, start: f64, width: f64) {
    for ((to, (q0, v0)), (q1, v1)) in to.iter_mut().zip(q0.iter().zip(v0)).zip(q1.iter().zip(v1)) {
        let at = |s: f64| {
            let rest = 1.0 - s;
            let q = rest * rest * ((1.0 + 2.0 * s) * q0 + h * s * v0) + s * s * ((3.0 - 2.0 * s) * q1 - h * rest * v1);
            let slope = 6.0 * s * rest * (q1 - q0) + h * (rest * (1.0 - 3.0 * s) * v0 - s * (2.0 - 3.0 * s) * v1);
            [q, slope * width / 3.0]
        };
        let ([a, beyond_a], [b, before_b]) = (at(start), at(start + width));
        let points = [a, a + beyond_a, b - before_b, b];
        let [least, most] = [f64::min, f64::max].map(|choose| points.into_iter().fold(a, choose));
        *to = Interval::new(least, most);
    }
}

#[cfg(test)]
mod tests {
    use super::{Span, halve, hull};
    use crate::planned::interior::on_cubic;
    use crate::scalar::Interval;

    #[test]
    fn a_box_contains_the_cubic() {
        let ends: [&[f64]; 4] = [&[0.3, -2.0], &[-4.0, 1.0], &[0.5, 3.0], &[7.0, -30.0]];
        for h in [1.5, -0.7] {
            for (start, width) in [(0.0, 1.0), (0.25, 0.25), (0.875, 0.125)] {
                let mut part = [Interval::ZERO; 2];
                hull(&mut part, Span { ends, inputs: &[], h }, start, width);
                for k in 0..=20 {
                    let mut q = [f64::NAN; 2];
                    on_cubic(&mut q, ends, h, start + width * f64::from(k) / 20.0);
                    for (part, q) in part.iter().zip(q) {
                        assert!(part.lower() - 1e-12 <= q && q <= part.upper() + 1e-12, "{h} {start} {k}: {part} {q}");
                    }
                }
                // Over short parts the box is little larger than the cubic.
                let mut halves = [[Interval::ZERO; 2]; 2];
                hull(&mut halves[0], Span { ends, inputs: &[], h }, start, 0.5 * width);
                hull(&mut halves[1], Span { ends, inputs: &[], h }, start + 0.5 * width, 0.5 * width);
                for k in 0..2 {
                    let both = halves[0][k].hull(halves[1][k]);
                    assert!(part[k].lower() - 1e-12 <= both.lower() && both.upper() <= part[k].upper() + 1e-12, "{k}");
                }
            }
        }
    }

    /// The places that are looked at where the excess of a part is that of the places in it, the largest one of all.
    fn looks(most: usize, excess: &[(f64, f64)], elsewhere: f64) -> (Option<bool>, Vec<f64>) {
        let mut places = Vec::new();
        let mut of_part = |start: f64, width: f64| {
            let within = excess.iter().filter(|(place, _)| (start..start + width).contains(place));
            Ok(within.map(|(_, excess)| *excess).fold(elsewhere, f64::max))
        };
        let mut look = |place: f64| {
            places.push(place);
            Ok(true)
        };
        let found = halve(most, &mut of_part, &mut look).expect("nothing has a length");
        (found, places)
    }

    /// Neither a place without an enclosure nor a far larger excess elsewhere hides a part.
    #[test]
    fn every_part_with_an_excess_is_looked_at() {
        let (found, places) = looks(16, &[(0.3, f64::INFINITY), (0.7, 1.5), (0.9, 1e200)], 0.0);
        assert_eq!(Some(true), found);
        for place in [0.3, 0.7, 0.9] {
            assert!(places.iter().any(|look| (look - place).abs() < 1e-6), "{place}: {places:?}");
        }
        assert!(places.len() < 60, "{}", places.len());
    }

    /// Where all parts have an excess, only those count whose excess is not far smaller than the largest one.
    #[test]
    fn what_all_parts_have_tells_nothing() {
        let (found, places) = looks(16, &[(0.7, 1e6)], 10.0);
        assert!(found == Some(true) && places.iter().any(|look| (look - 0.7).abs() < 1e-6), "{places:?}");
        let (found, places) = looks(16, &[(0.7, 1e6)], 1e5);
        assert!(found.is_none() && places.len() < 32, "{places:?}");
    }
}

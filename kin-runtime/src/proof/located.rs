//! Krawczyk's test: a box in which equations have exactly one solution, and bounds of that solution.

use super::contraction::{Preconditioner, Rest};
use crate::certificate::Uncertified;
use crate::scalar::Interval;

/// The largest β with which a box is certified; it is less than 1 to leave room for rounding.
const CONTRACTING: f64 = 0.99;

/// Equations F(y) = 0 at a place that is nearly a solution.
pub(super) struct Trial<'a> {
    /// Sizes of the boxes that are tried, relative to `sizes`, largest first.
    pub(super) boxes: &'a [f64],
    /// (row, column) of the entries of the matrix A of F.
    pub(super) entries: &'a [(usize, usize)],
    pub(super) centre: &'a [f64],
    pub(super) sizes: &'a [f64],
    /// C F at the centre.
    pub(super) newton: &'a [Interval],
}

/// The entries of the matrix A over a box.
type Over<'a> = dyn FnMut(&[Interval]) -> Result<Vec<Interval>, Uncertified> + 'a;

/// A box with one solution.
pub(super) struct Located<'c> {
    inverse: &'c Preconditioner,
    rest: Rest,
    /// The radii ρ of the box.
    radii: Vec<f64>,
    /// |I − C A| ρ ≤ β ρ everywhere in the box, with β < 1.
    beta: f64,
    /// Bounds of the solution.
    pub(super) q: Vec<Interval>,
}

impl Trial<'_> {
    /// The largest of the boxes that Krawczyk's operator maps into itself; none if there is no such box. `over` gives the
    /// entries of the matrix over a box.
    ///
    /// # Errors
    /// That of `over`, if it has no answer for the smallest box either.
    pub(super) fn locate<'c>(
        &self,
        inverse: &'c Preconditioner,
        over: &mut Over<'_>,
    ) -> Result<Option<Located<'c>>, Uncertified> {
        let &Trial { boxes, entries, centre, sizes, newton } = self;
        let n = centre.len();
        let mut refused = Ok(None);
        for relative in boxes {
            // Larger than the correction, so that the solution can lie inside.
            let radius = |(size, y): (&f64, &Interval)| (relative * size).max(4.0 * y.magnitude());
            let radii: Vec<f64> = sizes.iter().zip(newton).map(radius).collect();
            let all: Vec<Interval> =
                centre.iter().zip(&radii).map(|(&x, &radius)| Interval::around(x, radius)).collect();
            let matrix = match over(&all) {
                Ok(matrix) => matrix,
                Err(unbounded) => {
                    refused = Err(unbounded);
                    continue;
                }
            };
            let rest = inverse.rest(entries, &matrix);
            let of_box = rest.times(&radii);
            let beta = (0..n).fold(0.0, |most: f64, i| most.max((of_box[i] / radii[i]).next_up()));
            let nearer: Vec<f64> = (0..n).map(|i| (newton[i].magnitude() + of_box[i]).next_up()).collect();
            let inside = (0..n).all(|i| nearer[i] < radii[i]) && beta <= CONTRACTING;
            if inside {
                // The solution is at most `nearer` away from the centre, which gives a still smaller distance from
                // y − C F.
                let left = rest.times(&nearer);
                let around = |i: usize| Interval::from(centre[i]) - newton[i] + Interval::new(-left[i], left[i]);
                let q = (0..n).map(|i| around(i).intersection(all[i]).unwrap_or(all[i])).collect();
                return Ok(Some(Located { inverse, rest, radii, beta, q }));
            }
            refused = Ok(None);
        }
        refused
    }
}

impl Located<'_> {
    /// d with A d = b for all matrices of the box: |d| ≤ |C b| + |I − C A| |d|, and so |d| ≤ max |C b|_i / ρ_i / (1 − β) ρ.
    pub(super) fn solve(&self, b: &[Interval]) -> Vec<Interval> {
        let first = self.inverse.times(b);
        let relative = first.iter().zip(&self.radii).map(|(d, radius)| (d.magnitude() / radius).next_up());
        let factor = (relative.fold(0.0, f64::max) / (1.0 - self.beta).next_down()).next_up();
        let bound: Vec<f64> = self.radii.iter().map(|radius| (factor * radius).next_up()).collect();
        let rest = self.rest.times(&bound);
        first.into_iter().zip(rest).map(|(d, rest)| d + Interval::new(-rest, rest)).collect()
    }

    /// The box around its centre in which there is no other solution, rounded inwards.
    pub(super) fn unique(&self, centre: &[f64]) -> Vec<Interval> {
        centre.iter().zip(&self.radii).map(|(&x, &radius)| inner(x, radius)).collect()
    }
}

/// The interval with this centre and radius, rounded inwards; only `centre` if nothing else remains.
fn inner(centre: f64, radius: f64) -> Interval {
    let (lower, upper) = ((centre - radius).next_up(), (centre + radius).next_down());
    Interval::new(lower.min(centre), upper.max(centre))
}

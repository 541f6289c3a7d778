//! Krawczyk's test: a box in which equations have exactly one solution, and bounds of that solution.

use super::contraction::Preconditioner;
use crate::certificate::Uncertified;
use crate::scalar::Interval;

/// The largest β with which a box is certified; it is less than 1 to leave room for rounding.
const CONTRACTING: f64 = 0.99;

/// An upper bound of the exact value of a computed nonnegative sum, product or quotient.
#[inline]
fn raised(x: f64) -> f64 {
    x * (1.0 + 2.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

/// Equations F(y) = 0 at a place that is nearly a solution.
pub(super) struct NearSolution<'a> {
    /// Sizes of the boxes that are tried, relative to `sizes`, largest first.
    pub(super) boxes: &'a [f64],
    /// (row, column) of the entries of the matrix A of F.
    pub(super) entries: &'a [(usize, usize)],
    pub(super) centre: &'a [f64],
    pub(super) sizes: &'a [f64],
    /// C F at the centre.
    pub(super) newton: &'a [Interval],
}

/// Writes the entries of the matrix A over a box.
type Over<'a> = dyn FnMut(&[Interval], &mut Vec<Interval>) -> Result<(), Uncertified> + 'a;

/// A box with one solution.
pub(super) struct SolutionBox {
    /// The radii ρ of the box.
    radii: Vec<f64>,
    /// Bounds of |I − C A| ρ everywhere in the box.
    rest: Vec<f64>,
    /// The latter are at most β ρ, with β < 1.
    beta: f64,
    /// Bounds of the solution.
    pub(super) q: Vec<Interval>,
}

impl NearSolution<'_> {
    /// The largest of the boxes that Krawczyk's operator maps into itself; `None` if there is no such box. `over` gives the
    /// entries of the matrix over a box, for which `matrix` is a buffer.
    ///
    /// # Errors
    /// That of `over`, if it fails for the smallest box, too.
    pub(super) fn locate(
        &self,
        inverse: &mut Preconditioner,
        over: &mut Over<'_>,
        matrix: &mut Vec<Interval>,
    ) -> Result<Option<SolutionBox>, Uncertified> {
        let &NearSolution { boxes, entries, centre, sizes, newton } = self;
        let n = centre.len();
        let (mut radii, mut rest, mut q) = (vec![0.0; n], vec![0.0; n], vec![Interval::ZERO; n]);
        let mut shares = vec![[0.0; 2]; n];
        let mut refused = Ok(None);
        for relative in boxes {
            for k in 0..n {
                // Larger than the correction, so that the solution can lie inside.
                radii[k] = (relative * sizes[k]).max(4.0 * newton[k].magnitude());
                q[k] = Interval::around(centre[k], radii[k]);
            }
            if let Err(unbounded) = over(&q, matrix) {
                refused = Err(unbounded);
                continue;
            }
            inverse.rest(entries, matrix, &radii, &mut rest);
            // |C F| and |I − C A| ρ relative to ρ, and their largest sum.
            let (mut beta, mut nearer, mut inside) = (0.0, 0.0, true);
            for k in 0..n {
                let [away, rest] = [newton[k].magnitude(), rest[k]].map(|x| raised(x / radii[k]));
                shares[k] = [away, rest];
                let sum = raised(away + rest);
                (beta, nearer) = (f64::max(beta, rest), f64::max(nearer, sum));
                // False for NaN, too.
                inside &= sum < 1.0;
            }
            if inside && beta <= CONTRACTING {
                // The solution is at most `nearer` ρ away from the centre, and so at most `nearer` |I − C A| ρ from y − C F, which
                // gives a smaller distance again.
                let distances = shares.iter().map(|[away, rest]| raised(away + raised(nearer * rest)));
                let nearer = distances.fold(0.0, f64::max).min(nearer);
                for i in 0..n {
                    let radius = raised(nearer * rest[i]);
                    let around = Interval::from(centre[i]) - newton[i] + Interval::new(-radius, radius);
                    q[i] = around.intersection(q[i]).unwrap_or(q[i]);
                }
                return Ok(Some(SolutionBox { radii, rest, beta, q }));
            }
            refused = Ok(None);
        }
        refused
    }
}

impl SolutionBox {
    /// d with A d = b for all matrices of the box: |d| ≤ |C b| + |I − C A| |d|, and so |d| ≤ max |C b|_i / ρ_i / (1 − β) ρ.
    pub(super) fn solve(&self, inverse: &mut Preconditioner, b: &[Interval]) -> Vec<Interval> {
        let mut d = inverse.times(b);
        let relative = d.iter().zip(&self.radii).map(|(d, radius)| raised(d.magnitude() / radius));
        let factor = raised(relative.fold(0.0, f64::max) / (1.0 - self.beta).next_down());
        for (d, rest) in d.iter_mut().zip(&self.rest) {
            let left = raised(factor * rest);
            *d = *d + Interval::new(-left, left);
        }
        d
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

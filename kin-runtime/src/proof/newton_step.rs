//! What searches by branch and prune share: steps of the interval Newton method on a box, and its division.

use super::contraction::Preconditioner;
use crate::scalar::Interval;

/// After a step that leaves less than this share of a box, another step is taken.
const MAX_KEPT_SHARE: f64 = 0.7;

/// The result of a step on a box.
pub(super) enum Shrunk {
    /// The box does not contain what is searched for.
    Empty,
    /// The box is smaller, and another step is worthwhile.
    Further,
    /// The step gives little or no information.
    Enough,
}

/// Steps for m equations f = 0 with n ≥ m coordinates.
pub(super) struct NewtonStep {
    /// The n sizes of the coordinates, and the width relative to them below which boxes are not divided any further.
    pub(super) sizes: Vec<f64>,
    narrowest: f64,
    /// (row, column) of all entries of the matrix that is inverted.
    entries: Vec<(usize, usize)>,
    /// Buffers.
    inverse: Preconditioner,
    exchanges: Vec<usize>,
    newton: Vec<Interval>,
    columns: Vec<Interval>,
    column: Vec<Interval>,
}

impl NewtonStep {
    pub(super) fn new(m: usize, sizes: Vec<f64>, narrowest: f64) -> Self {
        let [newton, columns, column] = [m, m * sizes.len(), m].map(|length| vec![Interval::ZERO; length]);
        let entries = (0..m).flat_map(|i| (0..m).map(move |k| (i, k))).collect();
        let (inverse, exchanges) = (Preconditioner::with_room(m), Vec::with_capacity(m));
        Self { sizes, narrowest, entries, inverse, exchanges, newton, columns, column }
    }

    /// Makes a box smaller. `f` are the values at its centre, and `a` the derivatives over it, row by row. If there are
    /// more coordinates than equations, `along` is the one that is not solved for.
    pub(super) fn step(
        &mut self,
        now: &mut [Interval],
        [centre, f]: [&[Interval]; 2],
        a: &[Vec<Interval>],
        along: impl FnOnce(&[f64]) -> Option<usize>,
    ) -> Shrunk {
        let before = self.width(now);
        let Self { sizes, entries, inverse, exchanges, newton, columns, column, .. } = self;
        let (m, n) = (a.len(), now.len());
        let away: Vec<Interval> = now.iter().zip(centre).map(|(&x, &c)| x - c).collect();
        let sum = |terms: &mut dyn Iterator<Item = Interval>| terms.fold(Interval::from(0.0), |sum, term| sum + term);
        let mean = |(&f, row): (&Interval, &Vec<Interval>)| f + sum(&mut row.iter().zip(&away).map(|(&a, &x)| a * x));
        if f.iter().zip(a).map(mean).any(Interval::excludes_zero) {
            return Shrunk::Empty;
        }
        let along = if n > m { along(sizes) } else { Some(n) };
        let Some(along) = along else { return Shrunk::Enough };
        let across = (0..n).filter(|&k| k != along);
        let middle = a.iter().flat_map(|row| across.clone().map(|k| row[k].midpoint()));
        if !inverse.set(entries, middle, exchanges) {
            return Shrunk::Enough;
        }
        inverse.times_to(f, newton);
        for (k, product) in columns.chunks_exact_mut(m.max(1)).enumerate() {
            column.clear();
            column.extend(a.iter().map(|row| row[k]));
            inverse.times_to(column, product);
        }
        for (i, index) in across.enumerate() {
            let derivative = |k: usize| columns[k * m + i];
            if derivative(index).contains(0.0) {
                continue;
            }
            let other_terms = &mut (0..n).filter(|&k| k != index).map(|k| derivative(k) * (now[k] - centre[k]));
            let newton = centre[index] - (newton[i] + sum(other_terms)) / derivative(index);
            match now[index].intersection(newton) {
                Some(smaller) => now[index] = smaller,
                None if newton.is_defined() => return Shrunk::Empty,
                None => {}
            }
        }
        let width = self.width(now);
        if width > MAX_KEPT_SHARE * before || width < self.narrowest { Shrunk::Enough } else { Shrunk::Further }
    }

    /// The largest width of a box relative to the sizes.
    pub(super) fn width(&self, all: &[Interval]) -> f64 {
        all.iter().zip(&self.sizes).fold(0.0, |most, (x, size)| ((x.upper() - x.lower()) / size).max(most))
    }

    /// The halves of a box, cut where `smear`, the sum of the sizes of the derivatives, times its width is largest; none
    /// if it is too narrow.
    pub(super) fn halves(&self, now: Vec<Interval>, smear: &[f64]) -> Option<[Vec<Interval>; 2]> {
        let weight = |k: usize| smear.get(k).copied().unwrap_or(1.0) * (now[k].upper() - now[k].lower());
        // A coordinate that hardly changes the equations is cut, too, once all others are narrow.
        let wide = (0..now.len()).filter(|&k| now[k].upper() - now[k].lower() >= self.narrowest * self.sizes[k]);
        let cut = wide.max_by(|&a, &b| weight(a).total_cmp(&weight(b)))?;
        let middle = now[cut].midpoint();
        let (mut lower, mut upper) = (now.clone(), now);
        lower[cut] = Interval::new(lower[cut].lower(), middle);
        upper[cut] = Interval::new(middle, upper[cut].upper());
        Some([lower, upper])
    }
}

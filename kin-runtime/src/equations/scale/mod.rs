//! The common scale of rows and coordinates, on which tolerances and ranks are judged.
//!
//! With row scales S and column scales D, the matrix S Φ_q D has entries of size one at typical configurations, and D
//! is one for angles: scaled displacements D⁻¹ δq are radians, or the displacement that a radian causes. The scales
//! come from the *typical* size of every entry over several configurations, never from the current one alone, because
//! a row or column that happens to vanish is exactly what a rank must show. What other configurations cannot tell,
//! because an entry depends on inputs or time alone, the angles do: radians need no scale, so that a column of φ that is
//! tiny beside the lengths of its rows is nearly singular, or rounding noise, and is not drawn up to size one.

mod around;

/// Scales of rows and columns.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    /// S, factor of every row of Φ.
    pub(crate) rows: Vec<f64>,
    /// D, size of every coordinate.
    pub(crate) columns: Vec<f64>,
    /// 1 over D.
    inverse: Vec<f64>,
    /// A typical length of the mechanism.
    pub(crate) length: f64,
    /// Places of angles in q.
    angles: Vec<usize>,
    /// Whether it is that of the mechanism: scaling is done where something is judged by it.
    pub(crate) is_known: bool,
}

impl Scale {
    /// No scaling.
    pub(crate) fn unit(rows: usize, columns: usize) -> Self {
        let ones = vec![1.0; columns];
        Self {
            rows: vec![1.0; rows],
            columns: ones.clone(),
            inverse: ones,
            length: 1.0,
            angles: Vec::new(),
            is_known: false,
        }
    }

    /// Largest scaled entry of a displacement, max |δq_k| / D_k.
    pub(crate) fn size(&self, displacement: &[f64]) -> f64 {
        largest_product(displacement, &self.inverse)
    }

    /// As [`size`](Self::size), but no angle counts for less than its radians.
    pub(crate) fn turn(&self, displacement: &[f64]) -> f64 {
        let radians = self.angles.iter().filter_map(|&k| displacement.get(k)).map(|x| x.abs());
        radians.fold(self.size(displacement), f64::max)
    }
}

/// max |x_k y_k|, as several maxima at once; what is not a number does not count.
#[inline]
pub(crate) fn largest_product(x: &[f64], y: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    let mut largest = [0.0_f64; 4];
    let ((x, x_rest), (y, y_rest)) = (x.as_chunks::<4>(), y.as_chunks::<4>());
    for (x, y) in x.iter().zip(y) {
        for ((largest, x), y) in largest.iter_mut().zip(x).zip(y) {
            *largest = larger(*largest, (x * y).abs());
        }
    }
    let rest = x_rest.iter().zip(y_rest).fold(0.0, |rest, (x, y)| larger(rest, (x * y).abs()));
    larger(rest, larger(larger(largest[0], largest[1]), larger(largest[2], largest[3])))
}

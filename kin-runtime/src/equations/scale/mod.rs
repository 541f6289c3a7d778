//! The common scale of rows and coordinates, to which tolerances and ranks refer.
//!
//! With row scales S and column scales D, the matrix S Φ_q D has entries of size one at typical configurations, and D
//! is one for angles: scaled displacements D⁻¹ δq are radians, or the displacement that a radian causes. The scales
//! come from the *typical* size of every entry over several configurations, never from the current configuration alone,
//! because a row or column that vanishes there must show up in the rank. These configurations are not closed; once the
//! mechanism is assembled, a row that keeps a constant distance is scaled as if its points were that far apart.
//!
//! An entry that depends on inputs or time alone is the same in all these configurations. Therefore the columns of
//! angles have a lower bound: radians need no scale, so that a column of φ that is tiny compared with the lengths of its
//! rows is nearly singular, or rounding noise, and is not scaled to size one.

mod around;

/// Scales of rows and columns.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    /// S, the factor of every row of Φ.
    pub(crate) rows: Vec<f64>,
    /// D, the size of every coordinate.
    pub(crate) columns: Vec<f64>,
    /// The inverse of D.
    inverse: Vec<f64>,
    /// A typical length of the mechanism.
    pub(crate) length: f64,
    /// Indices of angles in q.
    angles: Vec<usize>,
    /// Whether the scale of the mechanism has been computed; this is done only where something depends on it.
    pub(crate) is_known: bool,
}

impl Scale {
    /// The scale without scaling.
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

    /// The largest scaled entry of a displacement, max |δq_k| / D_k.
    pub(crate) fn size(&self, displacement: &[f64]) -> f64 {
        largest_product(displacement, &self.inverse)
    }

    /// As [`size`](Self::size), but an angle counts at least with its radians.
    pub(crate) fn turn(&self, displacement: &[f64]) -> f64 {
        let radians = self.angles.iter().filter_map(|&k| displacement.get(k)).map(|x| x.abs());
        radians.fold(self.size(displacement), f64::max)
    }
}

/// max |x_k y_k|, computed as four maxima in parallel; NaN is ignored.
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

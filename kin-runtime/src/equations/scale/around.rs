//! The scale at a configuration, from the typical sizes of the entries of Φ_q at several configurations around it.

use super::Scale;
use crate::equations::Equations;
use crate::model::{Component, CoordinateKind, Frame, Role};
use crate::random::Random;
use crate::signal::Instant;
use crate::workspace::Subset;

/// Number of configurations over which the typical size of an entry is taken.
const SAMPLES: usize = 9;
/// Arguments at which the size of a curve is sampled.
const CURVE_SAMPLES: [f64; 3] = [0.3, 2.4, 4.5];
/// Number of iterations of row and column equilibration.
const SWEEPS: usize = 6;

/// Distance of the samples near a curve, relative to that of the others. If e is a polynomial of second degree, its gradient
/// changes there in this ratio, so that the scale of its row remains the same.
const NEAR_CURVE: f64 = 1e-3;

/// Lower bound of the size of an angle's column, relative to the lengths in its rows: a smaller column is nearly
/// singular.
const SMALLEST_ANGLE_COLUMN: f64 = 1e-3;

impl Scale {
    /// The scales at the current instant, from configurations around `q`, an assembled configuration.
    pub(crate) fn around(equations: &mut Equations<'_>, q: &[f64]) -> Self {
        let distance_rows = kept_distances(equations);
        let curves: Vec<usize> = equations.rows_of_implicit_curves().collect();
        let length = size_of_joints(equations).unwrap_or(1.0);
        Self::from_samples(equations, (q, length), &distance_rows, &curves)
    }

    /// The scales at the current instant, from configurations around `q` in which distances may be far from those that
    /// joints keep. Rows of small distances have the scale of large ones, so that they do not dominate a residual. Where no
    /// joint has a size, as between points that formulas mention, the typical length is the largest length of `q`, if that
    /// exceeds 1: a guess tells how large the mechanism is, but not how far it moves, so that the scale of an assembled
    /// configuration is not taken from it.
    pub(crate) fn before_assembly(equations: &mut Equations<'_>, q: &[f64]) -> Self {
        let of_guess = || {
            let lengths = equations.model.coordinates.iter().zip(q).filter(|(of, _)| of.kind.is_length());
            lengths.map(|(_, q)| q.abs()).filter(|l| l.is_finite()).fold(1.0, f64::max)
        };
        let length = size_of_joints(equations).unwrap_or_else(of_guess);
        Self::from_samples(equations, (q, length), &[], &[])
    }

    /// The scales from samples around `q` for the typical `length`. The `distance_rows` are d² − e² with a constant e: their entries are as
    /// large as d, which is e in every solution, but larger in most samples where e is small compared with the rest of
    /// the mechanism.
    /// Of the rows `curves` of implicit curves, the samples near q show how large the entries are beside the curve.
    fn from_samples(
        equations: &mut Equations<'_>,
        (q, length): (&[f64], f64),
        distance_rows: &[(usize, f64)],
        curves: &[usize],
    ) -> Self {
        let (s, n) = (equations.rows(), equations.coordinates());
        let spread: Vec<f64> = (0..n).map(|k| spread(equations, k, q[k], length)).collect();
        let entries = equations.model.constraint_pattern.entries;
        let mut sizes = typical_sizes(equations, (q, &spread), distance_rows);
        if !curves.is_empty() {
            let narrow: Vec<f64> = spread.iter().map(|width| NEAR_CURVE * width).collect();
            let near = typical_sizes(equations, (q, &narrow), &[]);
            let largest = |row: usize, sizes: &[f64]| {
                entries
                    .iter()
                    .zip(sizes)
                    .filter(|((i, _), _)| *i == row)
                    .fold(0.0, |largest, (_, size)| size.max(largest))
            };
            for &row in curves {
                let share = largest(row, &near) / (NEAR_CURVE * largest(row, &sizes));
                let sizes_of_row = sizes.iter_mut().zip(entries).filter(|(_, entry)| entry.0 == row && share < 1.0);
                sizes_of_row.for_each(|(size, _)| *size *= share);
            }
        }
        let mut typical: Vec<(usize, usize, f64)> =
            entries.iter().zip(&sizes).map(|(&(i, j), &size)| (i, j, size)).collect();
        typical.extend(equations.entries().skip(entries.len()).map(|((row, column), _)| (row, column, 1.0)));
        let angles = (0..n).filter(|&k| equations.model.coordinates[k].kind.is_angle()).collect();
        let mut scale = Self { length, angles, is_known: true, ..Self::unit(s, n) };
        scale.start(equations, &typical);
        scale.raise_angles(&mut typical);
        scale.equilibrate(&typical);
        scale.normalise(equations);
        scale.inverse = scale.columns.iter().map(|d| 1.0 / d).collect();
        scale
    }

    /// Divides lengths by the typical length, and every row by its largest entry: the result is independent of units.
    fn start(&mut self, equations: &Equations<'_>, entries: &[(usize, usize, f64)]) {
        for (column, info) in self.columns.iter_mut().zip(equations.model.coordinates) {
            if info.kind.is_length() {
                *column = self.length;
            }
        }
        let mut largest = vec![0.0_f64; self.rows.len()];
        for &(i, j, size) in entries {
            largest[i] = largest[i].max(size * self.columns[j]);
        }
        for (row, max) in self.rows.iter_mut().zip(largest) {
            if max > 0.0 && max.is_finite() {
                *row = 1.0 / max;
            }
        }
    }

    /// Raises the entries of angle columns to at least [`SMALLEST_ANGLE_COLUMN`]; rows and lengths have been scaled
    /// before.
    fn raise_angles(&self, entries: &mut [(usize, usize, f64)]) {
        for &angle in &self.angles {
            let entries_of_angle = entries.iter().filter(|entry| entry.1 == angle);
            let largest =
                entries_of_angle.map(|&(i, j, size)| size * self.rows[i] * self.columns[j]).fold(0.0, f64::max);
            let missing = SMALLEST_ANGLE_COLUMN / largest;
            if missing > 1.0 && missing.is_finite() {
                entries.iter_mut().filter(|entry| entry.1 == angle).for_each(|entry| entry.2 *= missing);
            }
        }
    }

    /// Divides rows and columns alternately by the square roots of their largest entries.
    fn equilibrate(&mut self, entries: &[(usize, usize, f64)]) {
        for _ in 0..SWEEPS {
            let mut row_max = vec![0.0_f64; self.rows.len()];
            let mut column_max = vec![0.0_f64; self.columns.len()];
            for &(i, j, size) in entries {
                let value = size * self.rows[i] * self.columns[j];
                row_max[i] = row_max[i].max(value);
                column_max[j] = column_max[j].max(value);
            }
            let divide = |scales: &mut [f64], largest: &[f64]| {
                for (scale, &max) in scales.iter_mut().zip(largest) {
                    if max > 0.0 && max.is_finite() {
                        *scale /= max.sqrt();
                    }
                }
            };
            divide(&mut self.rows, &row_max);
            divide(&mut self.columns, &column_max);
        }
    }

    /// Makes the median column scale of angles 1; without angles that of lengths the typical length; without poses the
    /// smallest scale of scalars 1.
    fn normalise(&mut self, equations: &Equations<'_>) {
        let typical_scale = |wanted: fn(CoordinateKind) -> bool| {
            let mut scales: Vec<f64> = equations
                .model
                .coordinates
                .iter()
                .zip(&self.columns)
                .filter(|(c, _)| wanted(c.kind))
                .map(|(_, &d)| d)
                .collect();
            (!scales.is_empty()).then(|| median_of_nonzero(&mut scales))
        };
        let poses = |kind| matches!(kind, CoordinateKind::Pose { .. });
        let factor = match (typical_scale(CoordinateKind::is_angle), typical_scale(poses), typical_scale(|_| true)) {
            (Some(angle), _, _) => angle,
            (None, Some(pose), _) => pose / self.length,
            // In a mechanism in millimetres, scalars that are angles have larger entries than those that are lengths.
            (None, None, Some(_)) => self.columns.iter().copied().filter(|&d| d > 0.0).fold(f64::INFINITY, f64::min),
            (None, None, None) => 1.0,
        };
        if factor > 0.0 && factor.is_finite() {
            self.columns.iter_mut().for_each(|d| *d /= factor);
            self.rows.iter_mut().for_each(|s| *s *= factor);
        }
    }
}

/// A typical distance of joints from the origins of their bodies: of moving bodies, or else of the ground, or else the
/// radii, curves and kept distances, which come last because radii of gears may be numbers of teeth.
fn size_of_joints(equations: &Equations<'_>) -> Option<f64> {
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    let numbers = equations.system.geometry(&at).ok()?;
    let mut lengths = [Vec::new(), Vec::new(), Vec::new()];
    for geometry in equations.model.joints.iter().flat_map(|j| j.geometry) {
        let part = |k: usize| numbers.get(geometry.offset + k).copied().unwrap_or(0.0);
        match geometry.role {
            Role::P | Role::Q => {
                lengths[usize::from(geometry.frame == Frame::Ground)].push(part(0).hypot(part(1)));
            }
            Role::Radius => lengths[2].push(part(0).abs()),
            _ => {}
        }
    }
    lengths[2].extend(equations.lengths.iter().filter_map(|length| numbers.get(length.offset)).map(|e| e.abs()));
    for joint in 0..equations.model.joints.len() {
        let points = CURVE_SAMPLES.iter().filter_map(|&s| equations.system.curve(&at, joint, s));
        lengths[2].extend(points.map(|point| point.r[0].hypot(point.r[1])));
    }
    let found = lengths.map(|mut lengths| median_of_nonzero(&mut lengths));
    found.into_iter().find(|&l| l > 0.0 && l.is_finite())
}

/// The rows d² − e² of a distance d with a constant e, and e.
fn kept_distances(equations: &Equations<'_>) -> Vec<(usize, f64)> {
    if equations.lengths.is_empty() {
        return Vec::new();
    }
    let numbers = equations.system.geometry(&equations.instant()).unwrap_or_default();
    let constant = equations.lengths.iter().filter(|length| length.is_squared && !length.moves);
    let known = constant.filter_map(|length| Some((length.row, *numbers.get(length.offset)?)));
    known.filter(|(_, e)| *e > 0.0).collect()
}

/// The typical size of every entry of Φ_q around `q`, each coordinate within its `spread`. The `distance_rows` are
/// d² − e² with a constant e, and their entries are those of d = e.
fn typical_sizes(
    equations: &mut Equations<'_>,
    (q, spread): (&[f64], &[f64]),
    distance_rows: &[(usize, f64)],
) -> Vec<f64> {
    let mut random = Random::new(0x5ca1e);
    let entries = equations.model.constraint_pattern.entries;
    let mut sizes = vec![[0.0; SAMPLES]; entries.len()];
    let mut sample = q.to_vec();
    let mut shares = vec![1.0; equations.rows()];
    for k in 0..SAMPLES {
        if equations.evaluate(Subset::POSITION, &sample, None).is_ok() {
            for &(row, e) in distance_rows {
                shares[row] = (e / (equations.phi[row] + e * e).max(0.0).sqrt()).min(1.0);
            }
            let typical = sizes.iter_mut().zip(entries).zip(&equations.phi_q);
            typical.for_each(|((size, &(row, _)), entry)| size[k] = entry.abs() * shares[row]);
        }
        for ((x, &centre), &width) in sample.iter_mut().zip(q).zip(spread) {
            *x = centre + width * random.symmetric();
        }
    }
    sizes.iter_mut().map(median_of_samples).collect()
}

/// The distance from its value within which a coordinate is sampled.
fn spread(equations: &Equations<'_>, coordinate: usize, value: f64, length: f64) -> f64 {
    match equations.model.coordinates[coordinate].kind {
        CoordinateKind::Pose { component: Component::Phi, .. } => core::f64::consts::PI,
        CoordinateKind::Pose { .. } => length,
        CoordinateKind::Scalar => value.abs().max(1.0),
    }
}

/// [`median_of_nonzero`] of a fixed number of samples, none of which is negative, by insertion sort.
fn median_of_samples(values: &mut [f64; SAMPLES]) -> f64 {
    let mut positive = 0;
    for k in 0..SAMPLES {
        let value = values[k];
        if value > 0.0 && value.is_finite() {
            let mut index = positive;
            while index > 0 && values[index - 1] > value {
                values[index] = values[index - 1];
                index -= 1;
            }
            values[index] = value;
            positive += 1;
        }
    }
    if positive == 0 { 0.0 } else { values[positive / 2] }
}

/// The median of the positive finite numbers; 0 where there are none.
fn median_of_nonzero(values: &mut Vec<f64>) -> f64 {
    values.retain(|v| *v > 0.0 && v.is_finite());
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

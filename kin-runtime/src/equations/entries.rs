//! The entries of Φ_q as evaluated last, in their own units and on the common scale.

use super::Equations;
use crate::linear::scale_columns;
use crate::model::{Component, CoordinateKind, JointKind};
use nalgebra::DMatrix;

impl Equations<'_> {
    /// The entries of Φ_q with their (row, column), in the order of the rows.
    pub(crate) fn entries(&self) -> impl Iterator<Item = ((usize, usize), f64)> {
        self.ordered.entries().iter().copied().zip(self.phi_q.iter().copied())
    }

    /// The entries of a row of Φ_q with their columns.
    pub(crate) fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let first = self.ordered.entries().partition_point(|entry| entry.0 < row);
        let rest = self.entries().skip(first);
        rest.take_while(move |((of_row, _), _)| *of_row == row).map(|((_, column), value)| (column, value))
    }

    /// An entry of Φ_q.
    pub(crate) fn entry(&self, row: usize, column: usize) -> f64 {
        self.row(row).find(|entry| entry.0 == column).map_or(0.0, |entry| entry.1)
    }

    /// The largest |entry| of a row of Φ_q, with row and columns on the common scale.
    pub(crate) fn largest_scaled(&self, row: usize) -> f64 {
        let scale = &self.scale;
        let sizes = self.row(row).map(|(column, value)| (value * scale.rows[row] * scale.columns[column]).abs());
        sizes.fold(0.0, f64::max)
    }

    /// The smallest |entry| of a row of Φ_q that is not 0, with row and columns on the common scale.
    pub(crate) fn smallest_scaled(&self, row: usize) -> f64 {
        let scale = &self.scale;
        let sizes = self.row(row).map(|(column, value)| (value * scale.rows[row] * scale.columns[column]).abs());
        sizes.filter(|size| *size > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The rows of implicit curves e = 0 that show ∇e. A row in fewer coordinates than both of a point's does not: where
    /// it vanishes, the motion is at a dead centre.
    pub(crate) fn rows_of_implicit_curves(&self) -> impl Iterator<Item = usize> {
        let model = self.model;
        let is_implicit = move |row: &usize| model.joints[model.rows[*row].joint].kind == JointKind::OnImplicitCurve;
        (0..model.rows.len()).filter(is_implicit).filter(|row| self.shows_gradient(*row))
    }

    /// True if both x and y of a body are coordinates of a row.
    fn shows_gradient(&self, row: usize) -> bool {
        let body = |column: usize, wanted: Component| match self.model.coordinates.get(column)?.kind {
            CoordinateKind::Pose { body, component } if component == wanted => Some(body),
            _ => None,
        };
        let with_x = self.row(row).filter_map(|(column, _)| body(column, Component::X));
        let has_y =
            |wanted_body: usize| self.row(row).any(|(column, _)| body(column, Component::Y) == Some(wanted_body));
        with_x.into_iter().any(has_y)
    }

    /// The given rows of Φ_q as a dense matrix, rows on the common scale, columns in their own units.
    pub(crate) fn scaled_rows(&self, rows: &[usize]) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(rows.len(), self.coordinates());
        for (i, &row) in rows.iter().enumerate() {
            self.row(row).for_each(|(column, value)| matrix[(i, column)] = value * self.scale.rows[row]);
        }
        matrix
    }

    /// The given rows of Φ_q as a dense matrix, rows and columns on the common scale.
    pub(crate) fn scaled(&self, rows: &[usize]) -> DMatrix<f64> {
        scale_columns(self.scaled_rows(rows), &self.scale.columns)
    }
}

//! The sizes of the terms of which quantities are sums.

use super::{Dimension, Kind, Measure};
use crate::model::{Component, CoordinateKind};
use crate::state::State;

impl Measure {
    /// The largest coordinate of its dimension in a state, or the largest rate or acceleration of one: its own values
    /// vary by the rounding of these. 0 if it is not computed from coordinates of its dimension.
    pub(crate) fn largest_term(&self, state: &State) -> f64 {
        let is_computed =
            matches!(self.kind, Kind::Coordinate(_) | Kind::Point(..) | Kind::Speed(_) | Kind::Observable(_));
        let of_dimension = |kind: &CoordinateKind| match kind {
            CoordinateKind::Pose { component: Component::Phi, .. } => self.dimension == Dimension::Angle,
            CoordinateKind::Pose { .. } => self.dimension == Dimension::Length,
            CoordinateKind::Scalar => false,
        };
        if !is_computed || self.per.is_some() {
            return 0.0;
        }
        let column = [&state.q, &state.q_dot, &state.q_ddot][self.order];
        let terms = state.model.coordinates.iter().zip(column).filter(|(info, _)| of_dimension(&info.kind));
        terms.map(|(_, value)| value.abs()).filter(|size| size.is_finite()).fold(0.0, f64::max)
    }
}

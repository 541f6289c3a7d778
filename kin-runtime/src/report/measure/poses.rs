//! Poses of bodies that are no coordinates.

use super::{Dimension, Kind, Measure};
use crate::model::Model;

impl Measure {
    /// x, y and φ of bodies that are no coordinates, because they are held or carried.
    pub(super) fn held_poses(model: &'static Model) -> impl Iterator<Item = Self> {
        let kinds = [("x", Dimension::Length), ("y", Dimension::Length), ("phi", Dimension::Angle)];
        model.bodies.iter().flat_map(move |body| {
            let held = (0..3).filter(|&k| body.coordinates[k].is_none());
            held.flat_map(move |k| {
                let (component, dimension) = kinds[k];
                Self::with_rates(
                    model,
                    &format!("{}.{component}", body.name),
                    Kind::Observable(body.observables[k]),
                    dimension,
                )
            })
        })
    }
}

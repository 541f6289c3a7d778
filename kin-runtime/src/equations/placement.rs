//! Positions of the points of joints, from their local geometry and the poses of the bodies.

use crate::equations::Equations;
use crate::error::SolveError;
use crate::model::{Frame, Geometry, Model};
use crate::signal::Instant;

/// The geometry of joints and the poses of bodies at one configuration.
pub(crate) struct Placement<'e> {
    model: &'static Model,
    numbers: &'e [f64],
    observables: &'e [f64],
}

impl<'e> Placement<'e> {
    /// The placement at q.
    pub(crate) fn at(equations: &'e mut Equations<'_>, q: &[f64]) -> Result<Self, SolveError> {
        let Equations { system, model, t, inputs, geometry, still, .. } = equations;
        let at = Instant { t: *t, inputs };
        system.write_geometry(&at, geometry)?;
        system.observe(&at, q, still)?;
        Ok(Self { model, numbers: geometry, observables: system.observables().phi })
    }

    /// A point of a joint in the inertial frame.
    pub(crate) fn point(&self, geometry: &Geometry) -> Option<[f64; 2]> {
        let [u, v] = self.direction(geometry)?;
        let Frame::Body(body) = geometry.frame else { return Some([u, v]) };
        let [x, y, _] = self.pose(body);
        Some([x + u, y + v])
    }

    /// An axis of a joint in the inertial frame.
    pub(crate) fn direction(&self, geometry: &Geometry) -> Option<[f64; 2]> {
        let &[u, v] = self.numbers.get(geometry.offset..geometry.offset + 2)? else { return None };
        let Frame::Body(body) = geometry.frame else { return Some([u, v]) };
        let (sin, cos) = self.pose(body)[2].sin_cos();
        Some([cos * u - sin * v, sin * u + cos * v])
    }

    /// x, y and φ of a body.
    fn pose(&self, body: usize) -> [f64; 3] {
        self.model.bodies[body].observables.map(|k| self.observables[k])
    }
}

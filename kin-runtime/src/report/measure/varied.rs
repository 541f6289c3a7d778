//! The values of quantities over numbers that carry derivatives with respect to parameters.

use super::{Kind, Measure, Source};
use crate::model::{Frame, Geometry, Model, Role};
use crate::plan::Depth;
use crate::results::varied::Varied;
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::transmission::{Pair, arms};

/// What the values of quantities require besides q.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Needs {
    /// How far a solution goes.
    pub(crate) depth: Depth,
    /// Whether observables are needed.
    pub(crate) observed: bool,
    /// Whether the geometry of joints is needed.
    pub(crate) geometry: bool,
    /// Whether forces are needed.
    pub(crate) forces: bool,
}

impl Needs {
    /// q, q̇ and the margins of the plan.
    pub(crate) const LEAST: Self = Self { depth: Depth::Velocity, observed: false, geometry: false, forces: false };

    /// What all of these quantities need.
    pub(crate) fn of(measures: &[Measure]) -> Self {
        measures.iter().fold(Self::LEAST, |needs, measure| needs.and(measure.needs()))
    }

    /// What both need.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            depth: self.depth.max(other.depth),
            observed: self.observed || other.observed,
            geometry: self.geometry || other.geometry,
            forces: self.forces || other.forces,
        }
    }
}

impl Measure {
    /// Whether [`varied`](Self::varied) computes it: not for velocity ratios, forces without a closed form, and
    /// quantities that are kept fixed.
    pub(crate) const fn has_derivatives(&self) -> bool {
        !self.is_ratio() && !matches!(self.kind, Kind::Time | Kind::Input(_) | Kind::Effort(_) | Kind::Force(_, None))
    }

    /// Its rate; none for a quantity without a rate, and for an acceleration.
    #[cfg(feature = "design")]
    pub(crate) fn next_order(&self) -> Option<Self> {
        let has_rate =
            matches!(self.kind, Kind::Coordinate(_) | Kind::Point(..) | Kind::Observable(_)) && self.order < 2;
        has_rate.then(|| Self { order: self.order + 1, ..self.clone() })
    }

    /// What its value needs.
    pub(crate) fn needs(&self) -> Needs {
        let forces = matches!(self.kind, Kind::Force(..) | Kind::Effort(_));
        let depth = if forces || self.order > 1 { Depth::Acceleration } else { Depth::Velocity };
        let transmission = matches!(self.kind, Kind::Transmission(_));
        let observed = transmission || matches!(self.kind, Kind::Point(..) | Kind::Speed(_) | Kind::Observable(_));
        Needs { depth, observed, geometry: transmission, forces }
    }

    /// Its value with derivatives; none where it [has none](Self::has_derivatives), or where a number that it needs is
    /// missing.
    pub(crate) fn varied<T: Scalar>(&self, model: &Model, varied: &Varied<T>) -> Option<T> {
        if !self.has_derivatives() {
            return None;
        }
        let order = |signal: &Signal<T>| [signal.value, signal.rate, signal.acceleration].get(self.order).copied();
        let observed = |index: usize| varied.observed.get(index);
        match self.kind {
            Kind::Coordinate(index) => [&varied.q, &varied.q_dot, &varied.q_ddot].get(self.order)?.get(index).copied(),
            Kind::Point(index, axis) => observed(model.points[index].observables[axis]).and_then(order),
            Kind::Speed(index) => {
                let [x, y] = model.points[index].observables.map(observed);
                let (x, y) = (x?.rate, y?.rate);
                Some(x.hypot(y))
            }
            Kind::Observable(index) => observed(index).and_then(order),
            Kind::Transmission(pair) => transmission(model, &pair, varied),
            Kind::Force(_, Some(Source::Force(index))) => varied.forces.get(index).copied(),
            Kind::Force(_, Some(Source::ForceLength(index))) => {
                let (x, y) = (*varied.forces.get(index)?, *varied.forces.get(index + 1)?);
                Some(x.hypot(y))
            }
            Kind::Time | Kind::Input(_) | Kind::Effort(_) | Kind::Force(..) => None,
        }
    }
}

/// The angle between the arms of a pair, in [0, π].
fn transmission<T: Scalar>(model: &Model, pair: &Pair, varied: &Varied<T>) -> Option<T> {
    let [centre, a, b] = pair.places.map(|geometry| place(model, geometry, varied));
    let [[ax, ay], [bx, by]] = arms(pair, [centre?, a?, b?]);
    Some((ax * by - ay * bx).abs().atan2(ax * bx + ay * by))
}

/// A point or an axis of a joint in the inertial frame.
fn place<T: Scalar>(model: &Model, geometry: &Geometry, varied: &Varied<T>) -> Option<[T; 2]> {
    let &[u, v] = varied.geometry.get(geometry.offset..geometry.offset + 2)? else { return None };
    let Frame::Body(body) = geometry.frame else { return Some([u, v]) };
    let [x, y, phi] = model.bodies[body].observables.map(|index| Some(varied.observed.get(index)?.value));
    let (x, y) = (x?, y?);
    let (sin, cos) = phi?.sin_cos();
    let [u, v] = [cos * u - sin * v, sin * u + cos * v];
    Some(if geometry.role == Role::Axis { [u, v] } else { [x + u, y + v] })
}

//! Motion of everything that a mechanism reports: bodies, points, defines and joints.

use crate::forces::Forces;
use crate::model::{Model, Observable, Quantity};
use crate::signal::Signal;
use core::ops::Index;

mod convert;
mod text;

/// [`Signal`], by the name that it has in results.
#[doc(hidden)]
pub type Rates = Signal;

/// Pose of a body with its rates; held and carried coordinates included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BodyMotion {
    /// x of the body's origin.
    pub x: f64,
    /// y of the body's origin.
    pub y: f64,
    /// φ, counter-clockwise, never wrapped.
    pub phi: f64,
    /// ẋ.
    pub x_dot: f64,
    /// ẏ.
    pub y_dot: f64,
    /// φ̇.
    pub phi_dot: f64,
    /// ẍ.
    pub x_ddot: f64,
    /// ÿ.
    pub y_ddot: f64,
    /// φ̈.
    pub phi_ddot: f64,
}

/// Motion of a named point in the inertial frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PointMotion {
    /// Position (x, y).
    pub r: [f64; 2],
    /// Velocity.
    pub v: [f64; 2],
    /// Acceleration.
    pub a: [f64; 2],
}

/// A unilateral condition at one instant: its margin g (the side that must be larger minus the other) and its
/// derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConditionMotion {
    /// g.
    pub value: f64,
    /// ġ.
    pub rate: f64,
    /// g̈.
    pub acceleration: f64,
    /// g > 0.
    pub satisfied: bool,
}

/// Motion of bodies, points, defines, joints and conditions at one instant.
///
/// Indexed by the handles of the mechanism: `motion[FourBar::tip].v`.
#[derive(Clone, PartialEq)]
pub struct Motion {
    /// The mechanism's names.
    pub model: &'static Model,
    /// Bodies, in the order of [`Model::bodies`].
    pub bodies: Vec<BodyMotion>,
    /// Points, in the order of [`Model::points`].
    pub points: Vec<PointMotion>,
    /// Defines, in the order of [`Model::defines`].
    pub defines: Vec<Signal>,
    /// Per joint of [`Model::joints`], its quantities in the order of [`JointInfo::quantities`](crate::model::JointInfo::quantities):
    /// the rate of an angle is the relative angular velocity, of a stroke the sliding velocity.
    pub joints: Vec<Vec<Signal>>,
    /// Unilateral conditions, in the order of [`Model::conditions`].
    pub conditions: Vec<ConditionMotion>,
    /// Forces, if there are masses or loads and their effects are held by constraints and drivers.
    pub forces: Option<Forces>,
}

/// Implements the indexing by handles and the printing that all reports on bodies, points, defines and joints share.
macro_rules! report {
    ($report:ty, body: $body:ty, point: $point:ty) => {
        impl core::fmt::Debug for $report {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_struct(stringify!($report))
                    .field("model", &self.model.name)
                    .field("bodies", &self.bodies)
                    .field("points", &self.points)
                    .field("defines", &self.defines)
                    .field("joints", &self.joints)
                    .field("conditions", &self.conditions)
                    .finish()
            }
        }

        impl core::ops::Index<$crate::model::Body> for $report {
            type Output = $body;

            fn index(&self, body: $crate::model::Body) -> &$body {
                &self.bodies[body.0]
            }
        }

        impl core::ops::Index<$crate::model::Point> for $report {
            type Output = $point;

            fn index(&self, point: $crate::model::Point) -> &$point {
                &self.points[point.0]
            }
        }
    };
}
pub(crate) use report;

report!(Motion, body: BodyMotion, point: PointMotion);

impl Motion {
    /// With positions only: rates, accelerations and forces are NaN or none.
    #[cfg(feature = "cli")]
    pub(crate) fn without_rates(mut self) -> Self {
        let unknown = f64::NAN;
        self.bodies.iter_mut().for_each(|body| *body = body.without_rates());
        self.points.iter_mut().for_each(|point| *point = point.without_rates());
        for rates in self.defines.iter_mut().chain(self.joints.iter_mut().flatten()) {
            *rates = Signal { value: rates.value, ..Signal::UNKNOWN };
        }
        for condition in &mut self.conditions {
            (condition.rate, condition.acceleration) = (unknown, unknown);
        }
        self.forces = None;
        self
    }
}

impl Index<Quantity> for Motion {
    type Output = Signal;

    fn index(&self, quantity: Quantity) -> &Signal {
        &self.defines[quantity.0]
    }
}

/// The name of the body, point, define, condition or joint that an observable belongs to.
pub(crate) fn name(model: &Model, observable: usize) -> &'static str {
    match model.observables.get(observable) {
        Some(&Observable::Pose { body, .. }) => model.bodies.get(body).map_or("", |body| body.name),
        Some(&Observable::Point { point, .. }) => model.points.get(point).map_or("", |point| point.name),
        Some(&Observable::Define(define)) => model.defines.get(define).map_or("", |define| define.name),
        Some(&Observable::Condition(k)) => model.conditions.get(k).map_or("", |condition| condition.name),
        Some(&Observable::Joint { joint, .. }) => model.joints.get(joint).map_or("", |joint| joint.name),
        None => "",
    }
}

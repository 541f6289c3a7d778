//! Motion of everything that a mechanism reports: bodies, points, defines and joints.

use crate::model::{Body, Model, Point, Quantity};
use core::ops::Index;

/// A value with its first and second time derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rates {
    /// Value.
    pub value: f64,
    /// First time derivative.
    pub rate: f64,
    /// Second time derivative.
    pub acceleration: f64,
}

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

/// Motion of bodies, points, defines and joints at one instant.
///
/// Indexed by the handles of the mechanism: `motion[FourBar::tip].v`.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The mechanism's names.
    pub model: &'static Model,
    /// Bodies, in the order of [`Model::bodies`].
    pub bodies: Vec<BodyMotion>,
    /// Points, in the order of [`Model::points`].
    pub points: Vec<PointMotion>,
    /// Defines, in the order of [`Model::defines`].
    pub defines: Vec<Rates>,
    /// Per joint of [`Model::joints`], its quantities in the order of [`JointInfo::quantities`](crate::model::JointInfo::quantities):
    /// the rate of an angle is the relative angular velocity, of a stroke the sliding velocity.
    pub joints: Vec<Vec<Rates>>,
}

impl Index<Body> for Motion {
    type Output = BodyMotion;

    fn index(&self, body: Body) -> &BodyMotion {
        &self.bodies[body.0]
    }
}

impl Index<Point> for Motion {
    type Output = PointMotion;

    fn index(&self, point: Point) -> &PointMotion {
        &self.points[point.0]
    }
}

impl Index<Quantity> for Motion {
    type Output = Rates;

    fn index(&self, quantity: Quantity) -> &Rates {
        &self.defines[quantity.0]
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Motion {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        use std::collections::BTreeMap;
        let bodies: BTreeMap<_, _> = self.model.bodies.iter().map(|b| b.name).zip(&self.bodies).collect();
        let points: BTreeMap<_, _> = self.model.points.iter().map(|p| p.name).zip(&self.points).collect();
        let defines: BTreeMap<_, _> = self.model.defines.iter().map(|d| d.name).zip(&self.defines).collect();
        let joints: BTreeMap<_, BTreeMap<_, _>> = self
            .model
            .joints
            .iter()
            .zip(&self.joints)
            .filter(|(_, rates)| !rates.is_empty())
            .map(|(j, rates)| (j.name, j.quantities.iter().map(|q| q.name).zip(rates).collect()))
            .collect();
        let mut s = serializer.serialize_struct("Motion", 4)?;
        s.serialize_field("bodies", &bodies)?;
        s.serialize_field("points", &points)?;
        s.serialize_field("defines", &defines)?;
        s.serialize_field("joints", &joints)?;
        s.end()
    }
}

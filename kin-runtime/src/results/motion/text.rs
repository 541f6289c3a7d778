//! How motions print.

use super::{BodyMotion, ConditionMotion, Motion, PointMotion};
use crate::text::{number, numbers};
use core::fmt;

/// (x, y, φ) with its rates and accelerations.
impl fmt::Display for BodyMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("(x, y, φ) = ")?;
        numbers(f, &[self.x, self.y, self.phi])?;
        f.write_str(", rates ")?;
        numbers(f, &[self.x_dot, self.y_dot, self.phi_dot])?;
        f.write_str(", accelerations ")?;
        numbers(f, &[self.x_ddot, self.y_ddot, self.phi_ddot])
    }
}

/// r, v and a.
impl fmt::Display for PointMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("r = ")?;
        numbers(f, &self.r)?;
        f.write_str(", v = ")?;
        numbers(f, &self.v)?;
        f.write_str(", a = ")?;
        numbers(f, &self.a)
    }
}

/// `satisfied by 0.2, rate 1, acceleration 0`, `violated by …`.
impl fmt::Display for ConditionMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.satisfied { "satisfied by " } else { "violated by " })?;
        number(f, &self.value.abs())?;
        f.write_str(", rate ")?;
        number(f, &self.rate)?;
        f.write_str(", acceleration ")?;
        number(f, &self.acceleration)
    }
}

/// A line for everything that is reported.
impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let model = self.model;
        f.write_str(model.name)?;
        for (info, body) in model.bodies.iter().zip(&self.bodies) {
            write!(f, "\nbody {}: ", info.name)?;
            body.fmt(f)?;
        }
        for (info, point) in model.points.iter().zip(&self.points) {
            write!(f, "\npoint {}: ", info.name)?;
            point.fmt(f)?;
        }
        for (info, define) in model.defines.iter().zip(&self.defines) {
            write!(f, "\n{}: ", info.name)?;
            define.fmt(f)?;
        }
        for (info, quantities) in model.joints.iter().zip(&self.joints) {
            for (quantity, value) in info.quantities.iter().zip(quantities) {
                write!(f, "\n{} of {}: ", quantity.name, info.name)?;
                value.fmt(f)?;
            }
        }
        for (info, condition) in model.conditions.iter().zip(&self.conditions) {
            write!(f, "\ncondition {}: ", info.name)?;
            condition.fmt(f)?;
        }
        Ok(())
    }
}

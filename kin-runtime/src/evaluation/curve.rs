//! Points of the curves that contacts run on, for a drawing.

use crate::text::numbers;
use core::fmt;

/// A point of a curve with its tangent, in the frame of the joint's first operand.
///
/// What the argument s is depends on the joint's [kind](crate::model::JointKind): θ of a curve in polar form, u of one in
/// parametric form, the direction θ of the outward normal of a cam under a flat face. Curves over θ close after 2π.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint<T = f64> {
    /// Its coordinates in the body.
    pub r: [T; 2],
    /// dr/ds; zero at a cusp.
    pub tangent: [T; 2],
}

/// The point and the tangent.
impl<T: fmt::Display> fmt::Display for CurvePoint<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        numbers(f, &self.r)?;
        f.write_str(", tangent ")?;
        numbers(f, &self.tangent)
    }
}

//! Points of the curves of contacts, for drawings.

use crate::text::numbers;
use core::fmt;

/// A point of a curve with its tangent, in the frame of the joint's first operand.
///
/// The argument s depends on the joint's [kind](crate::model::JointKind): θ of a curve in polar form, u of a curve in
/// parametric form, or the direction θ of the outward normal of a cam under a flat face. Curves over θ close after 2π.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint<T = f64> {
    /// The coordinates of the point in that frame.
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

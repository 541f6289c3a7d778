//! Degenerate geometry of joints.

use core::fmt;

/// [`Degeneracy`], under the name for geometry that follows from parameters alone.
#[doc(hidden)]
pub type GeometryFault = Degeneracy;

/// A degenerate geometry of a joint: of its dimensions, which follow from the parameters, or of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Degeneracy {
    /// The point is at the centre of a polar curve, where the direction θ is undefined.
    Centre {
        /// The distance |w| of the point from the centre.
        distance: f64,
    },
    /// The row of an implicit curve vanishes: the curve has no gradient at its point (a double point or a cusp), or its
    /// normal passes through the pivots of both bodies, so that their rotation does not change the contact.
    Gradient {
        /// Largest entry of the row of Φ_q on the common scale.
        largest: f64,
    },
    /// The tangent of a parametric curve vanishes, c′ = 0, so that the side of its roller is undefined.
    Direction {
        /// The curve's parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// The radius of a gear, a pulley or a disc is 0, so that it couples no motion.
    Radius {
        /// The radius.
        value: f64,
    },
    /// Two discs that roll on one another have the same centre.
    OneCentre {
        /// The sum of their radii.
        sum: f64,
    },
    /// The axis has no direction: its components are 0, or too small or too large to be normalised.
    Axis,
    /// The distance that the joint keeps is 0, where its row has no gradient.
    Length {
        /// The distance.
        length: f64,
    },
    /// Two points coincide whose distance is in a row of the joint, as neighbouring points of a rope.
    Coincident,
    /// The distance that the joint keeps is negative.
    NegativeLength {
        /// The distance.
        length: f64,
    },
}

impl fmt::Display for Degeneracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Centre { distance } => {
                write!(
                    f,
                    "its point is at distance {distance:.1e} from the centre of the curve, where theta has no value"
                )
            }
            Self::Gradient { largest } => {
                write!(
                    f,
                    "no motion of its bodies changes the contact (scaled row {largest:.1e}): the curve has a double \
                     point or a cusp there, or its normal passes through the pivots of both bodies"
                )
            }
            Self::Radius { value } => write!(f, "a radius is {value}, so that it couples no motion"),
            Self::OneCentre { sum } => {
                write!(
                    f,
                    "the radii add up to {sum}: the centres of the two discs coincide, so that the line of centres is \
                     undefined"
                )
            }
            Self::Direction { parameter, value } => {
                write!(
                    f,
                    "the tangent vector of the curve is 0 at {parameter} = {value}, so that the side of its roller is \
                     undefined"
                )
            }
            Self::Axis => f.write_str(
                "its axis has no direction: its components cannot be normalised, being 0, too small or too large",
            ),
            Self::Length { length } => {
                write!(f, "its length is {length}; points that coincide are joined with `revolute`")
            }
            Self::Coincident => f.write_str("two of its points coincide, so that their distance has no direction"),
            Self::NegativeLength { length } => write!(f, "its length is {length}; a length must not be negative"),
        }
    }
}

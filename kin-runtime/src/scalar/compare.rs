//! Comparisons that work lane by lane: what code needs that is written once for one number and for several.

use super::Scalar;

/// Numbers that can be compared: a single one, or one in every lane.
pub(crate) trait Compare: Scalar + Default {
    /// The smaller number in every lane. Where one of them is NaN, either may come out.
    fn least(self, other: Self) -> Self;
    /// The larger number in every lane. Where one of them is NaN, either may come out.
    fn greatest(self, other: Self) -> Self;
    /// ±1 with the sign of the number; NaN for 0 and NaN.
    fn direction(self) -> Self;
}

impl Compare for f64 {
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    #[inline(always)]
    fn greatest(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    #[inline(always)]
    fn direction(self) -> Self {
        if self > 0.0 {
            1.0
        } else if self < 0.0 {
            -1.0
        } else {
            f64::NAN
        }
    }
}

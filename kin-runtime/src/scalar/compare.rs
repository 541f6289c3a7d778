//! Lane-wise comparisons, for code that is written once for a single number and for several lanes.

use super::Scalar;

/// Numbers that can be compared: a single one, or one in every lane.
pub(crate) trait Compare: Scalar + Default {
    /// The number of lanes.
    const LANES: usize;

    /// The smaller number in every lane. Where one of them is NaN, either may be returned.
    fn least(self, other: Self) -> Self;
    /// The larger number in every lane. Where one of them is NaN, either may be returned.
    fn greatest(self, other: Self) -> Self;
    /// ±1 with the sign of the number; NaN for 0 and NaN.
    fn direction(self) -> Self;
    /// The number in a lane.
    fn lane(&self, lane: usize) -> f64;
    /// Sets the number in a lane.
    fn set_lane(&mut self, lane: usize, value: f64);
}

impl Compare for f64 {
    const LANES: usize = 1;

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

    #[inline(always)]
    fn lane(&self, _lane: usize) -> f64 {
        *self
    }

    #[inline(always)]
    fn set_lane(&mut self, _lane: usize, value: f64) {
        *self = value;
    }
}

/// The smaller number, or NaN where one of them is not finite, which [`least`](Compare::least) may not show.
#[inline]
pub(crate) fn least_or_nan<V: Compare>(a: V, b: V) -> V {
    a.least(b) + V::from_f64(0.0) * (a + b)
}

/// Writes one lane of every number.
pub(crate) fn write_lane<V: Compare>(to: &mut [f64], from: &[V], lane: usize) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = from.lane(lane));
}

// The loops have no early exit, so that they vectorise.

/// True if all numbers are finite.
#[inline]
pub(crate) fn all_finite(numbers: &[f64]) -> bool {
    numbers.iter().fold(true, |all, x| all & x.is_finite())
}

/// True if all numbers are above a limit; false where one is NaN.
#[inline]
pub(crate) fn all_above(numbers: &[f64], limit: f64) -> bool {
    numbers.iter().fold(true, |all, x| all & (*x > limit))
}

#[cfg(test)]
mod tests {
    use super::least_or_nan;

    #[test]
    fn the_smaller_number_is_no_number_if_one_is_none() {
        assert_eq!([-2.0, -2.0], [least_or_nan(-2.0, 3.0), least_or_nan(3.0, -2.0)]);
        for other in [f64::NAN, f64::INFINITY] {
            assert!(least_or_nan(1.0, other).is_nan() && least_or_nan(other, 1.0).is_nan());
        }
    }
}

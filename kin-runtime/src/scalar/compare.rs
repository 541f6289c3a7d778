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

// The loops of the following functions have no early exit, so that they vectorise.

/// The bits of the exponent of an `f64`, all of which are set where it is NaN or infinite, and the lowest of them.
const EXPONENT: u64 = 0x7ff << 52;
const LOWEST_OF_EXPONENT: u64 = 1 << 52;

/// True if all numbers are finite: if adding 1 to no exponent carries into the bit above it, that of the sign. The
/// compiler does this for several numbers at once, which it does not do for a conjunction of comparisons.
#[inline]
pub(crate) fn all_finite(numbers: &[f64]) -> bool {
    let carried = |x: &f64| (x.to_bits() & EXPONENT) + LOWEST_OF_EXPONENT;
    numbers.iter().fold(0, |bits, x| bits | carried(x)) >> 63 == 0
}

/// True if all numbers are above a limit; false where one is NaN.
#[inline]
pub(crate) fn all_above(numbers: &[f64], limit: f64) -> bool {
    numbers.iter().fold(1, |all, x| all & u64::from(*x > limit)) == 1
}

#[cfg(test)]
mod tests {
    use super::{all_above, all_finite, least_or_nan};

    /// Wherever the number is among others that are finite and above the limit.
    #[test]
    fn a_single_number_decides() {
        let smallest = f64::from_bits(1);
        let finite = [0.0, -0.0, 1.0, smallest, -smallest, f64::MIN_POSITIVE, f64::MAX, f64::MIN];
        let others = [f64::NAN, -f64::NAN, f64::from_bits(0x7ff0_0000_0000_0001), f64::INFINITY, f64::NEG_INFINITY];
        for count in 1..=19 {
            for place in 0..count {
                let list = |x: f64| -> Vec<f64> { (0..count).map(|k| if k == place { x } else { 2.0 }).collect() };
                assert!(finite.iter().all(|x| all_finite(&list(*x))) && !others.iter().any(|x| all_finite(&list(*x))));
                for x in finite.into_iter().chain(others) {
                    assert_eq!(x > 1.0, all_above(&list(x), 1.0), "{x}");
                }
            }
        }
        assert!(all_finite(&[]) && all_above(&[], 1.0));
    }

    #[test]
    fn the_smaller_number_is_no_number_if_one_is_none() {
        assert_eq!([-2.0, -2.0], [least_or_nan(-2.0, 3.0), least_or_nan(3.0, -2.0)]);
        for other in [f64::NAN, f64::INFINITY] {
            assert!(least_or_nan(1.0, other).is_nan() && least_or_nan(other, 1.0).is_nan());
        }
    }
}

//! Intervals for proofs that need second derivatives.

use super::wrapped::wrap;
use crate::scalar::{Interval, Scalar};

/// An interval whose `signum` is undefined where it holds 0: the derivative of |x| jumps there, which the second
/// derivative does not show.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Smooth(pub(crate) Interval);

impl Smooth {
    #[inline]
    const fn of(interval: Interval) -> Self {
        Self(interval)
    }

    #[inline]
    const fn interval(self) -> Interval {
        self.0
    }
}

impl core::ops::Neg for Smooth {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

wrap! { Smooth {
    fn atan2(self, x: Self) -> Self {
        Self(self.0.atan2(x.0))
    }

    fn nearest(self, reference: Self) -> Self {
        Self(self.0.nearest(reference.0))
    }

    fn signum(self) -> Self {
        Self(if self.0.contains(0.0) { Interval::UNDEFINED } else { self.0.signum() })
    }
} }

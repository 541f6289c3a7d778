//! Intervals for plans, whose angles may leave the range (−π, π].

use super::wrapped::wrap;
use crate::scalar::{Interval, Scalar};

/// π.
const HALF_TURN: Interval = Interval::new(core::f64::consts::PI, core::f64::consts::PI.next_up());

/// An interval whose `atan2` is continuous across the negative x axis, where that of [`Interval`] is not: an angle may
/// differ by a whole turn from the one in (−π, π]. A plan replaces every angle by the one nearest to its start, so that
/// plans are enclosed for all directions. Rows that use such an angle directly have no valid enclosure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Winding(pub(crate) Interval);

wrap! { Winding {
    fn atan2(self, x: Self) -> Self {
        let beyond = self.0.lower() < 0.0 && self.0.upper() >= 0.0 && x.0.upper() < 0.0;
        Self(if beyond { HALF_TURN + (-self.0).atan2(-x.0) } else { self.0.atan2(x.0) })
    }

    #[inline]
    fn signum(self) -> Self {
        Self(self.0.signum())
    }
} }

//! Intervals for plans, whose angles may leave the range (−π, π].

use super::wrapped::wrap;
use crate::scalar::{Interval, Scalar};

/// π.
const HALF_TURN: Interval = Interval::new(core::f64::consts::PI, core::f64::consts::PI.next_up());

/// An interval whose `atan2` has an enclosure across the negative x axis, too, where that of [`Interval`] has none: an angle
/// that may differ by a whole turn from the one in (−π, π]. A plan replaces every angle that it solves for by the one
/// nearest to its start, so that plans are enclosed for all directions. Anything else that is computed from such an angle,
/// as by a formula of the user that contains `atan2`, jumps there and is undefined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Winding {
    interval: Interval,
    /// Whether numbers of the interval may differ from the value by a whole turn.
    is_wound: bool,
}

impl Winding {
    #[inline]
    pub(crate) const fn of(interval: Interval) -> Self {
        Self { interval, is_wound: false }
    }

    /// The numbers that it encloses; undefined where it is known only up to a whole turn.
    #[inline]
    pub(crate) const fn interval(self) -> Interval {
        if self.is_wound { Interval::UNDEFINED } else { self.interval }
    }
}

impl core::ops::Neg for Winding {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { interval: -self.interval, ..self }
    }
}

wrap! { Winding {
    fn atan2(self, x: Self) -> Self {
        let (y, x) = (self.interval(), x.interval());
        match y.lower() < 0.0 && y.upper() >= 0.0 && x.upper() < 0.0 {
            true => Self { interval: HALF_TURN + (-y).atan2(-x), is_wound: true },
            false => Self::of(y.atan2(x)),
        }
    }

    fn nearest(self, reference: Self) -> Self {
        Self::of(self.interval.nearest(reference.interval()))
    }

    #[inline]
    fn signum(self) -> Self {
        Self::of(self.interval().signum())
    }
} }

#[cfg(test)]
mod tests {
    use super::Winding;
    use crate::scalar::{Interval, Scalar};

    /// Across the negative x axis an angle that is replaced by the nearest one has an enclosure, and nothing else has.
    #[test]
    fn an_angle_up_to_whole_turns_is_no_number() {
        let angle = Winding::of(Interval::new(-0.1, 0.1)).atan2(Winding::of(Interval::from(-1.0)));
        let near = |x: f64| (-angle).nearest(Winding::of(Interval::from(x))).interval();
        assert!(near(3.0).contains(3.1) && near(3.0).contains(3.2) && near(-3.0).contains(-3.1), "{}", near(3.0));
        let one = Winding::of(Interval::from(1.0));
        for x in [angle, angle + one, one * angle, angle.abs(), angle.sqrt()] {
            assert!(!x.interval().is_defined(), "{x:?}");
        }
        let above = Winding::of(Interval::new(0.0, 0.1)).atan2(-one);
        assert!((above + one).interval().contains(4.1), "{above:?}");
    }
}

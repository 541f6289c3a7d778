//! Intervals for plans, whose angles may leave the range (−π, π].

use crate::scalar::{Interval, Scalar};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// π.
const HALF_TURN: Interval = Interval::new(core::f64::consts::PI, core::f64::consts::PI.next_up());

/// An interval whose `atan2` is continuous across the negative x axis, where that of [`Interval`] is not: an angle may
/// differ by a whole turn from the one in (−π, π]. A plan replaces every angle by the one nearest to its start, so that
/// plans are enclosed for all directions. Rows that use such an angle directly have no valid enclosure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Winding(pub(crate) Interval);

macro_rules! operators {
    ($($operator:ident $method:ident),*) => { $(
        impl $operator for Winding {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )* };
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Winding {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! functions {
    ($($name:ident),*) => { $(
        #[inline]
        fn $name(self) -> Self {
            Self(self.0.$name())
        }
    )* };
}

impl Scalar for Winding {
    const CORRECTIONS: usize = <Interval as Scalar>::CORRECTIONS;

    functions!(tan, asin, acos, atan, sqrt, exp, ln, abs, signum);

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self(Interval::from(value))
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Self(sin), Self(cos))
    }

    fn atan2(self, x: Self) -> Self {
        let beyond = self.0.lower() < 0.0 && self.0.upper() >= 0.0 && x.0.upper() < 0.0;
        Self(if beyond { HALF_TURN + (-self.0).atan2(-x.0) } else { self.0.atan2(x.0) })
    }

    fn nearest(self, reference: Self) -> Self {
        Self(self.0.nearest(reference.0))
    }

    #[inline]
    fn is_within(self, bound: f64) -> bool {
        self.0.is_within(bound)
    }

    fn powi(self, n: i32) -> Self {
        Self(self.0.powi(n))
    }

    fn powf(self, n: f64) -> Self {
        Self(self.0.powf(n))
    }

    fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
        self.0.lift(f).map(Self)
    }
}

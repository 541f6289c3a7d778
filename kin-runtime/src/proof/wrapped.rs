//! The operations that scalars wrapping an [`Interval`](crate::scalar::Interval) share with it.

/// Implements a scalar except for `neg`, and for `atan2`, `nearest` and `signum`, which are given in the braces. The type has
/// two functions of its own: `of` makes it of an interval, and `interval` is the one with which it computes.
macro_rules! wrap {
    ($Name:ident { $($own:item)* }) => {
        wrap!(operators $Name: Add add, Sub sub, Mul mul, Div div);

        impl Scalar for $Name {
            const CORRECTIONS: usize = <Interval as Scalar>::CORRECTIONS;

            $($own)*

            wrap!(functions tan, asin, acos, atan, sqrt, exp, ln, abs);

            #[inline]
            fn from_f64(value: f64) -> Self {
                Self::of(Interval::from(value))
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = self.interval().sin_cos();
                (Self::of(sin), Self::of(cos))
            }

            #[inline]
            fn is_within(self, bound: f64) -> bool {
                self.interval().is_within(bound)
            }

            fn powi(self, n: i32) -> Self {
                Self::of(self.interval().powi(n))
            }

            fn powf(self, n: f64) -> Self {
                Self::of(self.interval().powf(n))
            }

            fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
                self.interval().lift(f).map(Self::of)
            }
        }
    };
    (operators $Name:ident: $($operator:ident $method:ident),*) => { $(
        impl core::ops::$operator for $Name {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                Self::of(self.interval().$method(other.interval()))
            }
        }
    )* };
    (functions $($name:ident),*) => { $(
        #[inline]
        fn $name(self) -> Self {
            Self::of(self.interval().$name())
        }
    )* };
}

pub(super) use wrap;

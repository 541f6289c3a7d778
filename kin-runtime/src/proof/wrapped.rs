//! The operations that scalars wrapping an [`Interval`](crate::scalar::Interval) share with it.

/// Implements a scalar except for `atan2` and `signum`, which are given in the braces.
macro_rules! wrap {
    ($Name:ident { $($own:item)* }) => {
        wrap!(operators $Name: Add add, Sub sub, Mul mul, Div div);

        impl core::ops::Neg for $Name {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Scalar for $Name {
            const CORRECTIONS: usize = <Interval as Scalar>::CORRECTIONS;

            $($own)*

            wrap!(functions tan, asin, acos, atan, sqrt, exp, ln, abs);

            #[inline]
            fn from_f64(value: f64) -> Self {
                Self(Interval::from(value))
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = self.0.sin_cos();
                (Self(sin), Self(cos))
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
    };
    (operators $Name:ident: $($operator:ident $method:ident),*) => { $(
        impl core::ops::$operator for $Name {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )* };
    (functions $($name:ident),*) => { $(
        #[inline]
        fn $name(self) -> Self {
            Self(self.0.$name())
        }
    )* };
}

pub(super) use wrap;

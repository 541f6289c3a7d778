//! What sines and cosines need of a vector.

use core::ops::{Add, BitAnd, BitXor, Mul, Sub};
use wide::{bytemuck::cast, f64x2, f64x4, i64x2, i64x4};

/// Several `f64` with their bits. [`ROUND`](super::cody_waite) leaves an integer n in the lowest bits of a number; what is
/// called `quadrant` here is such a number.
pub(super) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + BitAnd<Output = Self> + BitXor<Output = Self>
{
    /// True where multiplication and addition round once.
    const FUSED: bool;

    /// `value` in every lane.
    fn splat(value: f64) -> Self;
    /// `self`·a + b.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `self`·a − b.
    fn mul_sub(self, a: Self, b: Self) -> Self;
    /// b − `self`·a.
    fn mul_neg_add(self, a: Self, b: Self) -> Self;
    /// (a, b), or (b, a) where n is odd.
    fn exchange_if_odd(quadrant: Self, a: Self, b: Self) -> (Self, Self);
    /// A minus sign where the second bit of n is set.
    fn second_bit(self) -> Self;
    /// A minus sign where the second bit of n + 1 is set.
    fn second_bit_of_next(self) -> Self;
}

macro_rules! vector {
    ($($float:ident $int:ident),*) => { $(
        impl Vector for $float {
            const FUSED: bool = cfg!(any(target_feature = "fma", all(target_arch = "aarch64", target_feature = "neon")));

            #[inline(always)]
            fn splat(value: f64) -> Self {
                $float::splat(value)
            }

            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                $float::mul_add(self, a, b)
            }

            #[inline(always)]
            fn mul_sub(self, a: Self, b: Self) -> Self {
                $float::mul_sub(self, a, b)
            }

            #[inline(always)]
            fn mul_neg_add(self, a: Self, b: Self) -> Self {
                $float::mul_neg_add(self, a, b)
            }

            #[inline(always)]
            fn exchange_if_odd(quadrant: Self, a: Self, b: Self) -> (Self, Self) {
                let n: $int = cast(quadrant);
                // By logic, which more of the units of a processor do than blends.
                let odd: $float = cast($int::splat(0) - (n & $int::splat(1)));
                let exchange = (a ^ b) & odd;
                (a ^ exchange, b ^ exchange)
            }

            #[inline(always)]
            fn second_bit(self) -> Self {
                let n: $int = cast(self);
                cast((n << 62) & $int::splat(i64::MIN))
            }

            #[inline(always)]
            fn second_bit_of_next(self) -> Self {
                let n: $int = cast(self);
                cast(((n << 62) + $int::splat(1 << 62)) & $int::splat(i64::MIN))
            }
        }
    )* };
}

vector!(f64x2 i64x2, f64x4 i64x4);

/// Several vectors that go through every step together, so that a constant is loaded once for all of them.
#[derive(Clone, Copy)]
pub(super) struct Group<const K: usize>(pub(super) [f64x4; K]);

macro_rules! operators {
    ($($Operator:ident $operator:ident),*) => { $(
        impl<const K: usize> $Operator for Group<K> {
            type Output = Self;
            #[inline(always)]
            fn $operator(mut self, other: Self) -> Self {
                for k in 0..K {
                    self.0[k] = $Operator::$operator(self.0[k], other.0[k]);
                }
                self
            }
        }
    )* };
}

operators!(Add add, Sub sub, Mul mul, BitAnd bitand, BitXor bitxor);

impl<const K: usize> Vector for Group<K> {
    const FUSED: bool = f64x4::FUSED;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([f64x4::splat(value); K])
    }

    #[inline(always)]
    fn mul_add(mut self, a: Self, b: Self) -> Self {
        for k in 0..K {
            self.0[k] = self.0[k].mul_add(a.0[k], b.0[k]);
        }
        self
    }

    #[inline(always)]
    fn mul_sub(mut self, a: Self, b: Self) -> Self {
        for k in 0..K {
            self.0[k] = self.0[k].mul_sub(a.0[k], b.0[k]);
        }
        self
    }

    #[inline(always)]
    fn mul_neg_add(mut self, a: Self, b: Self) -> Self {
        for k in 0..K {
            self.0[k] = self.0[k].mul_neg_add(a.0[k], b.0[k]);
        }
        self
    }

    #[inline(always)]
    fn exchange_if_odd(quadrant: Self, mut a: Self, mut b: Self) -> (Self, Self) {
        for k in 0..K {
            (a.0[k], b.0[k]) = f64x4::exchange_if_odd(quadrant.0[k], a.0[k], b.0[k]);
        }
        (a, b)
    }

    #[inline(always)]
    fn second_bit(mut self) -> Self {
        for k in 0..K {
            self.0[k] = self.0[k].second_bit();
        }
        self
    }

    #[inline(always)]
    fn second_bit_of_next(mut self) -> Self {
        for k in 0..K {
            self.0[k] = self.0[k].second_bit_of_next();
        }
        self
    }
}

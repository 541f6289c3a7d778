//! The operations on vectors from which sines, cosines and angles are computed.

use core::ops::{Add, BitAnd, BitXor, Div, Mul, Sub};
use wide::{bytemuck::cast, f64x2, f64x4, i64x2, i64x4};

/// Several `f64` with access to their bits. A `quadrant` is a number in whose lowest bits [`ROUND`](super::cody_waite)
/// has left an integer n.
pub(crate) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + BitAnd<Output = Self> + BitXor<Output = Self>
{
    /// True where multiplication and addition are fused, so that they round once.
    const FUSED: bool;

    /// `value` in every lane.
    fn splat(value: f64) -> Self;
    /// `self`·a + b.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `self`·a − b.
    fn mul_sub(self, a: Self, b: Self) -> Self;
    /// b − `self`·a.
    fn mul_neg_add(self, a: Self, b: Self) -> Self;
    /// Sine and cosine of x from those of |x| − n π/2: they are swapped where n is odd, and their signs follow from n
    /// and x.
    fn turned(quadrant: Self, x: Self, sin: Self, cos: Self) -> (Self, Self);
}

/// A vector with comparisons. Their results are masks: all bits of a lane are set where the comparison is true, and
/// none where it is false.
pub(crate) trait Compared: Vector + Div<Output = Self> {
    /// The absolute values.
    fn magnitude(self) -> Self;
    /// The mask of `self` > `other`.
    fn above(self, other: Self) -> Self;
    /// The mask of `self` = 0.
    fn vanishes(self) -> Self;
    /// `yes` in the lanes that the mask `self` selects, `no` in the others.
    fn select(self, yes: Self, no: Self) -> Self;
    /// True if any lane of the mask is set.
    fn any(self) -> bool;
}

macro_rules! vector {
    ($($float:ident $int:ident),*) => { $(
        impl Compared for $float {
            #[inline(always)]
            fn magnitude(self) -> Self {
                $float::abs(self)
            }

            #[inline(always)]
            fn above(self, other: Self) -> Self {
                self.simd_gt(other)
            }

            #[inline(always)]
            fn vanishes(self) -> Self {
                self.simd_eq($float::splat(0.0))
            }

            #[inline(always)]
            fn select(self, yes: Self, no: Self) -> Self {
                $float::select(self, yes, no)
            }

            #[inline(always)]
            fn any(self) -> bool {
                $float::any(self)
            }
        }

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
            fn turned(quadrant: Self, x: Self, sin: Self, cos: Self) -> (Self, Self) {
                let (n, x): ($int, $int) = (cast(quadrant), cast(x));
                // The second bit of n, and that of n + 1, shifted to the sign bit.
                let (half, signs) = (n << 62, $int::splat(i64::MIN));
                if cfg!(target_feature = "avx") {
                    let odd = n << 63;
                    let (up, across): ($float, $float) = (cast((half ^ x) & signs), cast((half ^ odd) & signs));
                    // A blend instruction only uses the sign bits.
                    let odd: $float = cast(odd);
                    (odd.select(cos, sin) ^ up, odd.select(sin, cos) ^ across)
                } else {
                    let next = half + $int::splat(1 << 62);
                    let (up, across): ($float, $float) = (cast((half ^ x) & signs), cast(next & signs));
                    let odd: $float = cast($int::splat(0) - (n & $int::splat(1)));
                    let exchange = (sin ^ cos) & odd;
                    (sin ^ exchange ^ up, cos ^ exchange ^ across)
                }
            }
        }
    )* };
}

vector!(f64x2 i64x2, f64x4 i64x4);

/// Several vectors on which operations are interleaved, so that a constant is loaded once for all of them.
#[derive(Clone, Copy)]
pub(crate) struct Group<const K: usize>(pub(crate) [f64x4; K]);

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

operators!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitXor bitxor);

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
    fn turned(quadrant: Self, x: Self, mut sin: Self, mut cos: Self) -> (Self, Self) {
        for k in 0..K {
            (sin.0[k], cos.0[k]) = f64x4::turned(quadrant.0[k], x.0[k], sin.0[k], cos.0[k]);
        }
        (sin, cos)
    }
}

impl<const K: usize> Group<K> {
    #[inline(always)]
    fn each(mut self, f: impl Fn(f64x4) -> f64x4) -> Self {
        for k in 0..K {
            self.0[k] = f(self.0[k]);
        }
        self
    }
}

impl<const K: usize> Compared for Group<K> {
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.each(Compared::magnitude)
    }

    #[inline(always)]
    fn above(mut self, other: Self) -> Self {
        for k in 0..K {
            self.0[k] = self.0[k].above(other.0[k]);
        }
        self
    }

    #[inline(always)]
    fn vanishes(self) -> Self {
        self.each(Compared::vanishes)
    }

    #[inline(always)]
    fn select(mut self, yes: Self, no: Self) -> Self {
        for k in 0..K {
            self.0[k] = Compared::select(self.0[k], yes.0[k], no.0[k]);
        }
        self
    }

    #[inline(always)]
    fn any(self) -> bool {
        let mut all = f64x4::splat(0.0);
        for k in 0..K {
            all |= self.0[k];
        }
        all.any()
    }
}

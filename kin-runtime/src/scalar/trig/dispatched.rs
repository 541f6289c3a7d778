//! Sines, cosines and angles of vectors by the instruction set found at run time: the arithmetic of
//! [`cody_waite`](super::cody_waite) and [`arctangent`](super::arctangent) in scalar loops, which the compiler
//! vectorises for every instruction set with its widest vectors; and generated code, compiled in the same way.
//!
//! Every number goes through the same operations wherever it stands in a list, so that its result does not depend on
//! its neighbours. With fused operations the last bit may differ from that without them; both results are within the
//! same bounds.

use super::arctangent::angle;
use super::cody_waite::{RANGE, sin_cos};
use super::vector::{Compared, Vector};
use core::ops::{Add, BitAnd, BitXor, Div, Mul, Sub};
use multiversion::{multiversion, target::target_cfg_f};

/// Runs `work`, which is compiled for every instruction set as far as it is inlined, by the best one of the processor.
#[cfg(all(not(target_feature = "avx2"), any(test, not(debug_assertions))))]
#[multiversion(targets("x86_64+avx2+fma"))]
pub(crate) fn by_processor<R, F: FnOnce() -> R>(work: F) -> R {
    work()
}

/// Sine and cosine of the numbers of `N` vectors by the best instruction set of the processor. Returns whether an angle
/// exceeds the range, so that the results are not valid.
#[multiversion(targets("x86_64+avx2+fma"))]
pub(super) fn best<const L: usize, const N: usize>(
    x: &[[f64; L]; N],
    sin: &mut [[f64; L]; N],
    cos: &mut [[f64; L]; N],
) -> bool {
    if target_cfg_f!(target_feature = "fma") {
        each::<true, L, N>(x, sin, cos)
    } else {
        each::<false, L, N>(x, sin, cos)
    }
}

/// The angles of vectors (x, y) by the best instruction set of the processor. Returns whether a vector was too long, so
/// that the results are not valid.
#[cfg(not(target_feature = "avx2"))]
#[multiversion(targets("x86_64+avx2+fma"))]
pub(super) fn best_angles<const L: usize, const N: usize>(
    y: &[[f64; L]; N],
    x: &[[f64; L]; N],
    out: &mut [[f64; L]; N],
) -> bool {
    if target_cfg_f!(target_feature = "fma") {
        angles::<true, L, N>(y, x, out)
    } else {
        angles::<false, L, N>(y, x, out)
    }
}

/// Sines and cosines of four angles by the best instruction set of the processor. Returns whether an angle exceeds the
/// range, so that the results are not valid.
///
/// Four zeros are appended, whose results are dropped, because a loop over eight numbers is vectorised. A loop over
/// four would be unrolled first and then vectorised badly.
#[multiversion(targets("x86_64+avx2+fma"))]
pub(super) fn best_of_four(a: f64, b: f64, c: f64, d: f64, sin: &mut [f64; 4], cos: &mut [f64; 4]) -> bool {
    let x = [[a, b, c, d], [0.0; 4]];
    let [mut sines, mut cosines] = [[[0.0; 4]; 2]; 2];
    let far = if target_cfg_f!(target_feature = "fma") {
        each::<true, 4, 2>(&x, &mut sines, &mut cosines)
    } else {
        each::<false, 4, 2>(&x, &mut sines, &mut cosines)
    };
    (*sin, *cos) = (sines[0], cosines[0]);
    far
}

/// The loop, with or without fused operations.
#[inline(always)]
pub(super) fn each<const FUSED: bool, const L: usize, const N: usize>(
    x: &[[f64; L]; N],
    sin: &mut [[f64; L]; N],
    cos: &mut [[f64; L]; N],
) -> bool {
    let mut far = false;
    for ((x, sin), cos) in x.as_flattened().iter().zip(sin.as_flattened_mut()).zip(cos.as_flattened_mut()) {
        let (One(s), One(c)) = sin_cos(One::<FUSED>(*x));
        (*sin, *cos) = (s, c);
        far |= x.abs() > RANGE;
    }
    far
}

/// The loop over the angles of vectors, with or without fused operations.
#[allow(dead_code, reason = "tests force every way")]
#[inline(always)]
pub(super) fn angles<const FUSED: bool, const L: usize, const N: usize>(
    y: &[[f64; L]; N],
    x: &[[f64; L]; N],
    out: &mut [[f64; L]; N],
) -> bool {
    let mut long = false;
    for ((y, x), out) in y.as_flattened().iter().zip(x.as_flattened()).zip(out.as_flattened_mut()) {
        let (One(found), is_long) = angle(One::<FUSED>(*y), One::<FUSED>(*x));
        *out = found;
        long |= is_long;
    }
    long
}

/// A single number, for loops that the compiler vectorises.
#[derive(Clone, Copy)]
struct One<const FUSED: bool>(f64);

macro_rules! operators {
    ($($Operator:ident $operator:ident $operation:expr),*) => { $(
        impl<const FUSED: bool> $Operator for One<FUSED> {
            type Output = Self;
            #[inline(always)]
            fn $operator(self, other: Self) -> Self {
                let operation: fn(f64, f64) -> f64 = $operation;
                Self(operation(self.0, other.0))
            }
        }
    )* };
}

operators!(
    Add add |a, b| a + b,
    Sub sub |a, b| a - b,
    Mul mul |a, b| a * b,
    Div div |a, b| a / b,
    BitAnd bitand |a, b| f64::from_bits(a.to_bits() & b.to_bits()),
    BitXor bitxor |a, b| f64::from_bits(a.to_bits() ^ b.to_bits())
);

impl<const FUSED: bool> Vector for One<FUSED> {
    const FUSED: bool = FUSED;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        if FUSED { Self(self.0.mul_add(a.0, b.0)) } else { self * a + b }
    }

    #[inline(always)]
    fn mul_sub(self, a: Self, b: Self) -> Self {
        if FUSED { Self(self.0.mul_add(a.0, -b.0)) } else { self * a - b }
    }

    #[inline(always)]
    fn mul_neg_add(self, a: Self, b: Self) -> Self {
        if FUSED { Self((-self.0).mul_add(a.0, b.0)) } else { b - self * a }
    }

    #[inline(always)]
    fn turned(quadrant: Self, x: Self, sin: Self, cos: Self) -> (Self, Self) {
        let bits = |bits: u64| Self(f64::from_bits(bits));
        let n = quadrant.0.to_bits();
        let (odd, half) = (n << 63, n << 62);
        let [up, across] = [half ^ x.0.to_bits(), half ^ odd].map(|signs| bits(signs & 1 << 63));
        let exchange = (sin ^ cos) & bits(0_u64.wrapping_sub(n & 1));
        (sin ^ exchange ^ up, cos ^ exchange ^ across)
    }
}

impl<const FUSED: bool> Compared for One<FUSED> {
    #[inline(always)]
    fn magnitude(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn above(self, other: Self) -> Self {
        Self::mask(self.0 > other.0)
    }

    #[inline(always)]
    fn vanishes(self) -> Self {
        Self::mask(self.0 == 0.0)
    }

    #[inline(always)]
    fn select(self, yes: Self, no: Self) -> Self {
        if self.any() { yes } else { no }
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.0.to_bits() != 0
    }
}

impl<const FUSED: bool> One<FUSED> {
    #[inline(always)]
    fn mask(is_set: bool) -> Self {
        Self(f64::from_bits(if is_set { u64::MAX } else { 0 }))
    }
}

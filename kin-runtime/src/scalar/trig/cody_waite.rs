//! Sine and cosine of every lane of a vector, without branches.
//!
//! Reduction and approximation in three steps (Cody and Waite; Muller, *Elementary Functions*, chapter 11):
//!
//! ```text
//! n = round(2|x|/π)                    the quadrant
//! r + ε = |x| − n π/2                  π/2 in three parts
//! sin r = r + r³ S(r²)    cos r = 1 + r² (−1/2 + r² C(r²))      minimax polynomials on |r| ≤ π/4
//! ```
//!
//! ε is the part of the reduced argument that rounding removes from r. Adding it to both results keeps them within 1
//! ulp of the standard library's, also near the zeros of either function, for |x| up to [`RANGE`]. The coefficients are
//! from the Remez exchange: the relative error of sin r is 6e-18, that of cos r 2e-19.

use super::vector::{Group, Vector};
use wide::{f64x2, f64x4};

/// The largest |x|: up to there n has at most 20 bits, and the product of n and a number of 33 bits is exact.
pub(super) const RANGE: f64 = 1_647_099.0;

/// Adding 1.5·2⁵² rounds to an integer, whose lowest bits are then the lowest bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// π/2 in three parts of 53, 33 and 53 bits for fused operations: |x| minus n times the first part is exact, and so is
/// n times the second part.
const WHOLE: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.123_233_995_384_61e-17, 3.521_559_865_183_2e-27];

/// π/2 in three parts for operations that are not fused; the first two have 33 bits, so that n times them is exact.
const SPLIT: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// The coefficients of S, lowest power first.
const SIN: [f64; 6] = [
    -1.666_666_666_666_664e-1,
    8.333_333_333_323_662e-3,
    -1.984_126_983_014_439_3e-4,
    2.755_731_365_185_318e-6,
    -2.505_073_457_106_949e-8,
    1.589_471_058_163_446_3e-10,
];

/// The coefficients of C, lowest power first.
const COS: [f64; 6] = [
    4.166_666_666_666_665e-2,
    -1.388_888_888_888_284e-3,
    2.480_158_729_462_800_4e-5,
    -2.755_731_573_861_327_7e-7,
    2.087_589_773_868_284_3e-9,
    -1.136_798_188_046_904_6e-11,
];

/// Sine and cosine of the lanes for |x| ≤ [`RANGE`]; NaN for NaN.
#[inline(always)]
pub(super) fn sin_cos<V: Vector>(x: V) -> (V, V) {
    let k = V::splat;
    // The computation uses |x| and restores the sign at the end, so that sin(−0) is −0.
    let signed = x;
    let x = x ^ (x & k(-0.0));
    let quadrant = x.mul_add(k(core::f64::consts::FRAC_2_PI), k(ROUND));
    let (r, epsilon) = reduced(x, quadrant - k(ROUND));

    let z = r * r;
    let sin = r + (r * z).mul_add(polynomial(z, SIN), epsilon);
    let cos = k(1.0) + polynomial(z, COS).mul_add(z, k(-0.5)).mul_sub(z, r * epsilon);

    V::turned(quadrant, signed, sin, cos)
}

macro_rules! of_vectors {
    ($($of_vector:ident $Vector:ty),*) => { $(
        /// [`sin_cos`] of a vector of this width. It is inlined where the caller is optimised. With debug assertions
        /// callers are usually not optimised; a call of code that is compiled once, in this crate, is faster there.
        #[cfg_attr(not(debug_assertions), inline(always))]
        pub(super) fn $of_vector(x: $Vector) -> ($Vector, $Vector) {
            sin_cos(x)
        }
    )* };
}

of_vectors!(sin_cos_of_two f64x2, sin_cos_of_four f64x4, sin_cos_of_eight Group<2>);

/// Σ cₖ zᵏ by Estrin's scheme, whose chain of dependent operations is half as long as in Horner's scheme.
#[inline(always)]
fn polynomial<V: Vector>(z: V, c: [f64; 6]) -> V {
    let pair = |k: usize| V::splat(c[k + 1]).mul_add(z, V::splat(c[k]));
    let z2 = z * z;
    pair(4).mul_add(z2, pair(2)).mul_add(z2, pair(0))
}

/// r = x − n π/2, and ε, the rounding error of r.
#[inline(always)]
fn reduced<V: Vector>(x: V, n: V) -> (V, V) {
    let k = V::splat;
    if V::FUSED {
        let (first, second, third) = (k(WHOLE[0]), k(WHOLE[1]), k(WHOLE[2]));
        let exact = n.mul_neg_add(first, x);
        let r = n.mul_neg_add(second, exact);
        return (r, n.mul_neg_add(third, n.mul_neg_add(second, exact - r)));
    }
    let (first, second, third) = (k(SPLIT[0]), k(SPLIT[1]), k(SPLIT[2]));
    let exact = x - n * first;
    let second = n * second;
    let r = exact - second;
    let rest = ((exact - r) - second) - n * third;
    let sum = r + rest;
    (sum, (r - sum) + rest)
}

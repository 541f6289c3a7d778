//! Sine and cosine of several angles at once, without branches, in SIMD lanes.
//!
//! Three steps, in this order (Cody and Waite; Muller, *Elementary Functions*, chapter 11):
//!
//! ```text
//! n = round(2x/π)                      the quadrant
//! r + ε = x − n π/2                    π/2 in three parts, the first two of 33 bits, so that n times them is exact
//! sin r = r + r³ S(r²)    cos r = 1 − r²/2 + r⁴ C(r²)      minimax polynomials on |r| ≤ π/4
//! ```
//!
//! ε, what r itself cannot hold, enters both polynomials to first order. So results are within 1 ulp of the standard
//! library's, also beside the zeros of either function, for |x| up to [`RANGE`]; beyond it the standard library computes.
//! The coefficients were found by the Remez exchange: relative error of sin r 6e-18, of cos r 2e-19.

use wide::{bytemuck::cast, f64x2, f64x4, i64x2, i64x4};

/// The largest |x|: n has at most 20 bits there, and a product of n with 33 bits is exact.
const RANGE: f64 = 1_647_099.0;

/// Adding 1.5·2⁵² rounds to an integer and leaves it in the lowest bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// π/2 in three parts.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// S, highest power first.
const SIN: [f64; 6] = [
    1.589_471_058_163_446_3e-10,
    -2.505_073_457_106_949e-8,
    2.755_731_365_185_318e-6,
    -1.984_126_983_014_439_3e-4,
    8.333_333_333_323_662e-3,
    -1.666_666_666_666_664e-1,
];

/// C, highest power first.
const COS: [f64; 6] = [
    -1.136_798_188_046_904_6e-11,
    2.087_589_773_868_284_3e-9,
    -2.755_731_573_861_327_7e-7,
    2.480_158_729_462_800_4e-5,
    -1.388_888_888_888_284e-3,
    4.166_666_666_666_665e-2,
];

macro_rules! lanes {
    ($name:ident, $float:ident, $int:ident) => {
        /// Sine and cosine of the lanes, |x| ≤ [`RANGE`].
        #[inline(always)]
        fn $name(x: $float) -> ($float, $float) {
            let k = |v: f64| $float::splat(v);
            // Sine is odd also where it is 0: of the magnitude, with the sign put back.
            let negative = x & k(-0.0);
            let x = x ^ negative;
            let polynomial = |z: $float, c: [f64; 6]| c[1..].iter().fold(k(c[0]), |p, &c| p.mul_add(z, k(c)));
            let shifted = x * k(core::f64::consts::FRAC_2_PI) + k(ROUND);
            let n: $int = cast(shifted);
            let y = shifted - k(ROUND);
            let first = y.mul_neg_add(k(HALF_PI[0]), x);
            let second = y * k(HALF_PI[1]);
            let difference = first - second;
            let back = difference - first;
            let lost = (first - (difference - back)) - (second + back);
            let tail = y.mul_neg_add(k(HALF_PI[2]), lost);
            let r = difference + tail;
            let epsilon = (difference - r) + tail;

            let z = r * r;
            let half = k(0.5) * z;
            let whole = k(1.0) - half;
            let sin = r + (z * r).mul_add(polynomial(z, SIN), epsilon * whole);
            let rest = (z * z).mul_add(polynomial(z, COS), -(r * epsilon));
            let cos = whole + (((k(1.0) - whole) - half) + rest);

            // Odd quadrants exchange the two; signs follow the quadrant.
            let one = $int::splat(1);
            let (sin, cos): ($int, $int) = (cast(sin), cast(cos));
            let exchange = (sin ^ cos) & ($int::splat(0) - (n & one));
            let sin_sign = (n & $int::splat(2)) << 62;
            let cos_sign = ((n + one) & $int::splat(2)) << 62;
            (cast::<_, $float>(sin ^ exchange ^ sin_sign) ^ negative, cast(cos ^ exchange ^ cos_sign))
        }
    };
}

lanes!(two, f64x2, i64x2);
lanes!(four, f64x4, i64x4);

/// Sine and cosine of the lanes, each within [`RANGE`] or not; what is not a number passes through.
#[inline(always)]
pub(crate) fn sin_cos_lanes(x: f64x4) -> (f64x4, f64x4) {
    let near = four(x);
    if x.abs().simd_gt(f64x4::splat(RANGE)).any() { beyond(x, near) } else { near }
}

/// With the standard library in the lanes that are beyond the range; the others keep what they have.
#[cold]
#[inline(never)]
fn beyond(x: f64x4, near: (f64x4, f64x4)) -> (f64x4, f64x4) {
    let (mut sin, mut cos) = (near.0.to_array(), near.1.to_array());
    for (lane, x) in x.to_array().into_iter().enumerate().filter(|(_, x)| x.abs() > RANGE) {
        (sin[lane], cos[lane]) = crate::scalar::Scalar::sin_cos(x);
    }
    (f64x4::new(sin), f64x4::new(cos))
}

/// Sine and cosine of every angle.
#[inline(always)]
pub(crate) fn sin_cos_all<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    // Not a number is beyond the range, too.
    if !angles.iter().all(|angle| angle.abs() <= RANGE) {
        return one_by_one(angles);
    }
    let mut out = [(0.0, 0.0); N];
    let mut first = 0;
    while first < N {
        let lane = |k: usize| if first + k < N { angles[first + k] } else { 0.0 };
        let put = |out: &mut [(f64, f64); N], sin: &[f64], cos: &[f64]| {
            for (k, pair) in sin.iter().copied().zip(cos.iter().copied()).enumerate() {
                if first + k < N {
                    out[first + k] = pair;
                }
            }
        };
        if N - first > 2 {
            let (sin, cos) = four(f64x4::new([lane(0), lane(1), lane(2), lane(3)]));
            put(&mut out, &sin.to_array(), &cos.to_array());
            first += 4;
        } else {
            let (sin, cos) = two(f64x2::new([lane(0), lane(1)]));
            put(&mut out, &sin.to_array(), &cos.to_array());
            first += 2;
        }
    }
    out
}

/// Without lanes: beyond the range, and not a number.
#[cold]
#[inline(never)]
fn one_by_one<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    angles.map(crate::scalar::Scalar::sin_cos)
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    /// Steps between two numbers of one sign.
    fn ulps(a: f64, b: f64) -> u64 {
        if a == b { 0 } else { a.to_bits().abs_diff(b.to_bits()) }
    }

    fn compare<const N: usize>(angles: [f64; N]) {
        for (angle, (sin, cos)) in angles.into_iter().zip(sin_cos_all(angles)) {
            let exact = angle.sin_cos();
            assert!(ulps(sin, exact.0) <= 1 && ulps(cos, exact.1) <= 1, "{angle}: {sin} {cos} and {exact:?}");
        }
    }

    #[test]
    fn within_one_step_of_the_standard_library() {
        let mut random = crate::random::Random::new(7);
        for size in [1e-9, 0.8, 3.2, 100.0, 1e4, RANGE] {
            for _ in 0..20_000 {
                compare([0; 3].map(|_| size * random.symmetric()));
                compare([0; 6].map(|_| size * random.symmetric()));
            }
        }
    }

    #[test]
    fn beside_the_zeros_of_both() {
        for k in 0..1_000_000_u32 {
            let zero = f64::from(k) * core::f64::consts::FRAC_PI_2;
            compare([zero, -zero]);
        }
    }

    #[test]
    fn beyond_the_range_and_without_a_number() {
        compare([1e9, 1.0, -3e15, 0.5, 1e300]);
        assert!(sin_cos_all([f64::NAN, 1.0])[0].0.is_nan() && sin_cos_all([1.0, f64::INFINITY])[1].1.is_nan());
        assert_eq!(sin_cos_all([1.0, f64::NAN])[0].0, 1.0_f64.sin());
        assert!(sin_cos_all([-0.0, 0.0, 1.0]).map(|pair| pair.0.is_sign_negative()) == [true, false, false]);
    }
}

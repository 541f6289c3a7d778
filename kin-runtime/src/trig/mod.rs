//! Sine and cosine of several angles at once, in SIMD lanes.
//!
//! [`cody_waite`] has the arithmetic, for angles up to [`RANGE`]; beyond it the standard library computes.

mod cody_waite;
mod vector;

use crate::scalar::sin_cos_of_std;
use cody_waite::{RANGE, sin_cos};
use vector::Group;
use wide::{f64x2, f64x4};

/// Sine and cosine of the lanes of `K` vectors; what is infinite or not a number gives what is not a number.
#[inline(always)]
pub(crate) fn sin_cos_lanes<const K: usize>(x: [f64x4; K]) -> ([f64x4; K], [f64x4; K]) {
    let (Group(mut sin), Group(mut cos)) = sin_cos(Group(x));
    let mut far = f64x4::splat(0.0);
    for x in &x {
        far |= x.abs().simd_gt(f64x4::splat(RANGE));
    }
    if far.any() {
        for k in 0..K {
            let (s, c) = beyond(x[k].to_array(), sin[k].to_array(), cos[k].to_array());
            (sin[k], cos[k]) = (f64x4::new(s), f64x4::new(c));
        }
    }
    (sin, cos)
}

/// With the standard library in the lanes that are beyond the range; the others keep what they have.
#[cold]
#[inline(never)]
fn beyond(x: [f64; 4], mut sin: [f64; 4], mut cos: [f64; 4]) -> ([f64; 4], [f64; 4]) {
    for (lane, x) in x.into_iter().enumerate().filter(|(_, x)| x.abs() > RANGE) {
        (sin[lane], cos[lane]) = sin_cos_of_std(x);
    }
    (sin, cos)
}

/// Sine and cosine of one angle.
#[inline(always)]
pub(crate) fn sin_cos_one(angle: f64) -> (f64, f64) {
    if angle.abs() > RANGE {
        return one_beyond(angle);
    }
    let (sin, cos) = sin_cos(f64x2::splat(angle));
    (sin.to_array()[0], cos.to_array()[0])
}

/// By the standard library.
#[cold]
#[inline(never)]
fn one_beyond(angle: f64) -> (f64, f64) {
    sin_cos_of_std(angle)
}

/// Sine and cosine of every angle.
#[inline(always)]
pub(crate) fn sin_cos_all<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    let mut out = [(0.0, 0.0); N];
    let mut beyond = false;
    let mut first = 0;
    while first < N {
        let lane = |k: usize| if first + k < N { angles[first + k] } else { 0.0 };
        if N - first > 2 {
            let x = f64x4::new([lane(0), lane(1), lane(2), lane(3)]);
            beyond |= x.abs().simd_gt(f64x4::splat(RANGE)).any();
            let (sin, cos) = sin_cos(x);
            put(&mut out, first, sin.to_array(), cos.to_array());
            first += 4;
        } else {
            let x = f64x2::new([lane(0), lane(1)]);
            beyond |= x.abs().simd_gt(f64x2::splat(RANGE)).any();
            let (sin, cos) = sin_cos(x);
            put(&mut out, first, sin.to_array(), cos.to_array());
            first += 2;
        }
    }
    if beyond {
        // Number by number: copied as a whole, the good case would go through the memory of this one.
        let exact = one_by_one(angles);
        return core::array::from_fn(|k| (exact[k][0], exact[k][1]));
    }
    out
}

#[inline(always)]
fn put<const N: usize, const L: usize>(out: &mut [(f64, f64); N], first: usize, sin: [f64; L], cos: [f64; L]) {
    for k in 0..L {
        if first + k < N {
            out[first + k] = (sin[k], cos[k]);
        }
    }
}

/// Without lanes, where an angle is beyond the range.
#[cold]
#[inline(never)]
fn one_by_one<const N: usize>(angles: [f64; N]) -> [[f64; 2]; N] {
    angles.map(|angle| {
        let (sin, cos) = sin_cos_of_std(angle);
        [sin, cos]
    })
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
            assert_eq!((sin, cos), sin_cos_one(angle));
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
        assert!(sin_cos_one(f64::NAN).0.is_nan() && sin_cos_one(f64::NEG_INFINITY).1.is_nan());
        assert!(sin_cos_all([f64::NAN, 1.0])[0].0.is_nan() && sin_cos_all([1.0, f64::INFINITY])[1].1.is_nan());
        assert_eq!(sin_cos_all([1.0, f64::NAN])[0].0, 1.0_f64.sin());
        assert!(sin_cos_all([-0.0, 0.0, 1.0]).map(|pair| pair.0.is_sign_negative()) == [true, false, false]);
    }
}

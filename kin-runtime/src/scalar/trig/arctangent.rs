//! The angle of a vector in SIMD lanes.
//!
//! By symmetry the vector is reflected into the first octant, (den, num) with 0 ≤ num ≤ den. Where num > den/2 the
//! angle is measured from the diagonal; both cases need one division (Muller, *Elementary Functions*, chapter 11):
//!
//! ```text
//! z = num/den    or    z = (num − den)/(num + den), angle π/4 + atan z
//! atan z = z + z³ P(z²)      minimax on |z| ≤ 1/2, relative error 8e-18
//! ```
//!
//! All reflections together are one constant and one sign: angle = k π/4 ± atan z, with the constant in two parts. The
//! largest error found is 1.7 ulp, near num = den/2, where num − den and num + den lose most digits.

use super::vector::{Compared, Group, Vector};
use crate::scalar::standard;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use wide::{f64x2, f64x4};

/// The coefficients of P, lowest power first, from the Remez exchange.
const P: [f64; 12] = [
    -0.333_333_333_333_331_76,
    0.199_999_999_999_391_2,
    -0.142_857_142_786_860_9,
    0.111_111_107_315_021_43,
    -0.090_908_975_083_016_58,
    0.076_920_871_565_866_19,
    -0.066_638_930_610_138_42,
    0.058_585_711_915_296_7,
    -0.051_221_929_021_234_84,
    0.041_846_982_055_133_9,
    -0.027_375_359_861_689_725,
    0.010_057_528_151_866_602,
];

/// The relative rounding error of π as an `f64`: (π − fl(π))/fl(π).
const PI_REST: f64 = 3.898_171_832_519_375_5e-17;

/// Largest component of a vector for which num + den cannot overflow.
const MAX_COMPONENT: f64 = f64::MAX / 8.0;

/// atan2(y, x) of the lanes, in [−π, π], and whether a vector was too long for the result to be valid.
#[inline(always)]
pub(super) fn angle<V: Compared>(y: V, x: V) -> (V, bool) {
    let k = V::splat;
    let (across, up) = (x.magnitude(), y.magnitude());
    let steep = up.above(across);
    let den = steep.select(up, across);
    let num = steep.select(across, up);
    let long = den.above(k(MAX_COMPONENT)).any();
    let diagonal = (num + num).above(den);
    // The zero vector has the angle of the half-axis that its signs indicate.
    let den = den.vanishes().select(k(1.0), den);
    let z = diagonal.select(num - den, num) / ((diagonal & num) + den);

    // Each reflection changes the sign of the term that is added to the constant.
    let left = x & k(-0.0);
    let sign = left ^ (steep & k(-0.0));
    let octant = diagonal & k(FRAC_PI_4);
    let from_vertical = steep.select(octant, k(FRAC_PI_2) - octant);
    let constant = k(FRAC_PI_2) - (from_vertical ^ left);
    let z = z ^ sign;
    let square = z * z;
    let small = (z * square).mul_add(polynomial(square), constant * k(PI_REST));
    ((constant + (z + small)) ^ (y & k(-0.0)), long)
}

macro_rules! of_vectors {
    ($($of_vector:ident $Vector:ty),*) => { $(
        /// [`angle`] of a vector of this width, inlined where the caller is optimised (see [`cody_waite`](super::cody_waite)).
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn $of_vector(y: $Vector, x: $Vector) -> ($Vector, bool) {
            angle(y, x)
        }
    )* };
}

of_vectors!(angle_of_two f64x2, angle_of_four f64x4, angle_of_eight Group<2>);

/// P(z) by Estrin's scheme, whose chain of dependent operations is a third as long as in Horner's scheme.
#[inline(always)]
fn polynomial<V: Vector>(z: V) -> V {
    let pair = |at: usize| V::splat(P[at + 1]).mul_add(z, V::splat(P[at]));
    let z2 = z * z;
    let z4 = z2 * z2;
    let four = |at: usize| pair(at + 2).mul_add(z2, pair(at));
    four(8).mul_add(z4, four(4)).mul_add(z4, four(0))
}

/// atan2(y, x) of the lanes, in [−π, π].
#[inline(always)]
pub(crate) fn atan2(y: f64x4, x: f64x4) -> f64x4 {
    let (angle, long) = angle_of_four(y, x);
    if long { of_long(y, x, angle) } else { angle }
}

/// The angles of two vectors of lanes, computed in an interleaved way, which hides the latency of the operations.
#[inline(always)]
pub(crate) fn atan2_of_two(y: [f64x4; 2], x: [f64x4; 2]) -> [f64x4; 2] {
    let (Group(mut angles), long) = angle_of_eight(Group(y), Group(x));
    if long {
        for k in 0..2 {
            angles[k] = of_long(y[k], x[k], angles[k]);
        }
    }
    angles
}

/// The angles of several vectors (y, x).
#[inline(always)]
pub(crate) fn atan2_all<const N: usize>(vectors: [(f64, f64); N]) -> [f64; N] {
    let mut out = [0.0; N];
    let mut beyond = false;
    let mut first = 0;
    while first < N {
        // Padding lanes contain vectors along x.
        let y = |k: usize| if first + k < N { vectors[first + k].0 } else { 0.0 };
        let x = |k: usize| if first + k < N { vectors[first + k].1 } else { 1.0 };
        if N - first > 2 {
            let vectors = [f64x4::new([y(0), y(1), y(2), y(3)]), f64x4::new([x(0), x(1), x(2), x(3)])];
            let (angles, long) = angle_of_four(vectors[0], vectors[1]);
            copy(&mut out, first, angles.to_array());
            beyond |= long;
            first += 4;
        } else {
            let (angles, long) = angle_of_two(f64x2::new([y(0), y(1)]), f64x2::new([x(0), x(1)]));
            copy(&mut out, first, angles.to_array());
            beyond |= long;
            first += 2;
        }
    }
    if beyond {
        // Computed one by one: an array copied as a whole would force the usual case through memory, too.
        let exact = one_by_one(vectors);
        return core::array::from_fn(|k| exact[k]);
    }
    out
}

/// Copies as many of the angles as fit. A copy of constant length is used because compilers turn an index loop into
/// scatters on the stack for AVX-512.
#[inline(always)]
fn copy<const N: usize, const L: usize>(out: &mut [f64; N], first: usize, angles: [f64; L]) {
    let count = if N - first < L { N - first } else { L };
    out[first..first + count].copy_from_slice(&angles[..count]);
}

/// Computes all angles by the standard library.
#[cold]
#[inline(never)]
fn one_by_one<const N: usize>(vectors: [(f64, f64); N]) -> [f64; N] {
    vectors.map(|(y, x)| standard::atan2(y, x))
}

/// Computes the angles of long and infinite vectors by the standard library; the other lanes keep their angles.
fn of_long(y: f64x4, x: f64x4, angle: f64x4) -> f64x4 {
    let mut angles = angle.to_array();
    beyond(&y.to_array(), &x.to_array(), &mut angles);
    f64x4::new(angles)
}

/// Computes the angles of long and infinite vectors by the standard library; the others keep their angles.
#[cold]
#[inline(never)]
pub(super) fn beyond(y: &[f64], x: &[f64], angles: &mut [f64]) {
    for ((y, x), angle) in y.iter().zip(x).zip(angles) {
        if y.abs() > MAX_COMPONENT || x.abs() > MAX_COMPONENT {
            *angle = standard::atan2(*y, *x);
        }
    }
}

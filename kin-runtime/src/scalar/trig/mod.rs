//! Sines and cosines of several angles at once in SIMD lanes, and the angles of several vectors.
//!
//! [`cody_waite`] contains the arithmetic for angles up to [`RANGE`]; larger angles are computed by the standard
//! library. With the feature `dispatch`, and unless the build has AVX2 anyway, several vectors of lanes, blocks of eight
//! numbers ([`eights`]), and more than two angles in `f64`, use the instruction set that `dispatched` finds at run time.
//! For fewer angles the function call would cost more than it saves.

pub(crate) mod arctangent;
mod cody_waite;
#[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
mod dispatched;
#[cfg(feature = "alloc")]
mod eights;
mod vector;

pub(crate) use arctangent::atan2_all;
#[cfg(feature = "alloc")]
pub(crate) use eights::{atan2_eights, by_processor, sin_cos_eights};

use crate::scalar::standard;
use cody_waite::{RANGE, sin_cos_of_eight, sin_cos_of_four, sin_cos_of_two};
use vector::Group;
use wide::{f64x2, f64x4};

/// Sine and cosine of the lanes of `N` vectors; NaN for infinities and NaN.
#[inline(always)]
pub(crate) fn sin_cos_lanes<const N: usize>(x: [f64x4; N]) -> [(f64x4, f64x4); N] {
    #[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
    let (mut out, far) = if N > 1 { of_this_processor(&x) } else { of_this_build(&x) };
    #[cfg(not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))))]
    let (mut out, far) = of_this_build(&x);
    if far {
        for k in 0..N {
            let (mut sin, mut cos) = (out[k].0.to_array(), out[k].1.to_array());
            beyond(&x[k].to_array(), &mut sin, &mut cos);
            out[k] = (f64x4::new(sin), f64x4::new(cos));
        }
    }
    out
}

/// Computes with the instruction set of the build. Returns also whether an angle exceeds the range.
///
/// Two vectors are interleaved, which hides the latency of the operations and fits the registers. One comparison at the
/// end covers all angles.
#[allow(dead_code, reason = "tests force every way")]
#[inline(always)]
fn of_this_build<const N: usize>(x: &[f64x4; N]) -> ([(f64x4, f64x4); N], bool) {
    let mut out = [(f64x4::splat(0.0), f64x4::splat(0.0)); N];
    let mut far = f64x4::splat(0.0);
    let mut k = 0;
    while k < N {
        far |= x[k].abs().simd_gt(f64x4::splat(RANGE));
        if N - k > 1 {
            far |= x[k + 1].abs().simd_gt(f64x4::splat(RANGE));
            let (Group(sin), Group(cos)) = sin_cos_of_eight(Group([x[k], x[k + 1]]));
            (out[k], out[k + 1]) = ((sin[0], cos[0]), (sin[1], cos[1]));
        } else {
            out[k] = sin_cos_of_four(x[k]);
        }
        k += 2;
    }
    (out, far.any())
}

/// Computes with the best instruction set of the processor. Returns also whether an angle exceeds the range.
#[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
#[allow(dead_code, reason = "tests force every way")]
#[inline(always)]
fn of_this_processor<const N: usize>(x: &[f64x4; N]) -> ([(f64x4, f64x4); N], bool) {
    let [mut sin, mut cos] = [[[0.0; 4]; N]; 2];
    let far = dispatched::best(&x.map(f64x4::to_array), &mut sin, &mut cos);
    (core::array::from_fn(|k| (f64x4::new(sin[k]), f64x4::new(cos[k]))), far)
}

/// Computes the angles beyond the range by the standard library; the others keep their results.
#[cold]
#[inline(never)]
fn beyond(x: &[f64], sin: &mut [f64], cos: &mut [f64]) {
    for ((x, sin), cos) in x.iter().zip(sin).zip(cos) {
        if x.abs() > RANGE {
            (*sin, *cos) = standard::sin_cos(*x);
        }
    }
}

/// Sine and cosine of one angle.
#[inline(always)]
pub(crate) fn sin_cos_one(angle: f64) -> (f64, f64) {
    if angle.abs() > RANGE {
        return one_beyond(angle);
    }
    let (sin, cos) = sin_cos_of_two(f64x2::splat(angle));
    (sin.to_array()[0], cos.to_array()[0])
}

/// Computes an angle beyond the range by the standard library.
#[cold]
#[inline(never)]
fn one_beyond(angle: f64) -> (f64, f64) {
    standard::sin_cos(angle)
}

/// Largest number of angles that are computed by code inlined into the caller. More angles are worth a call of code
/// that is compiled once in kin-runtime and not once per mechanism. Where only a call reaches AVX2, three angles are
/// worth it.
const MAX_INLINED_ANGLES: usize =
    if cfg!(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))) { 2 } else { 4 };

/// Sine and cosine of every angle.
///
/// There is no index loop with a condition for each element: for AVX-512 compilers turn such a loop into gathers and
/// scatters on the stack, which take longer than the arithmetic.
#[inline(always)]
pub(crate) fn sin_cos_all<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    let lane = |k: usize| if k < N { angles[k] } else { 0.0 };
    let mut out = [(0.0, 0.0); N];
    if const { N > MAX_INLINED_ANGLES } {
        let of_four = |first: usize| of_four(lane(first), lane(first + 1), lane(first + 2), lane(first + 3));
        let mut first = 0;
        let (fours, rest) = out.as_chunks_mut();
        for four in fours {
            *four = of_four(first);
            first += 4;
        }
        if !rest.is_empty() {
            rest.copy_from_slice(&of_four(first)[..N % 4]);
        }
        return out;
    }
    let beyond;
    if const { N > 2 } {
        let x = f64x4::new([lane(0), lane(1), lane(2), lane(3)]);
        beyond = x.abs().simd_gt(f64x4::splat(RANGE)).any();
        let (sin, cos) = sin_cos_of_four(x);
        put(&mut out, &pairs(sin.to_array(), cos.to_array()));
    } else {
        let x = f64x2::new([lane(0), lane(1)]);
        beyond = x.abs().simd_gt(f64x2::splat(RANGE)).any();
        let (sin, cos) = sin_cos_of_two(x);
        let ([s, t], [c, d]) = (sin.to_array(), cos.to_array());
        put(&mut out, &[(s, c), (t, d)]);
    }
    if beyond {
        // Copied number by number: an array copied as a whole would force the usual case through memory, too.
        let exact = four_beyond(lane(0), lane(1), lane(2), lane(3));
        for k in 0..N {
            out[k] = (exact[k].0, exact[k].1);
        }
    }
    out
}

/// Copies as many of the pairs as fit, at most four.
#[inline(always)]
fn put<const N: usize, const L: usize>(out: &mut [(f64, f64); N], pairs: &[(f64, f64); L]) {
    if const { N > 0 } {
        out[0] = pairs[0];
    }
    if const { N > 1 } {
        out[1] = pairs[1];
    }
    if const { N > 2 && L > 2 } {
        out[2] = pairs[2];
    }
    if const { N > 3 && L > 3 } {
        out[3] = pairs[3];
    }
}

/// Sines and cosines of four angles, by a call. The angles are passed in registers: a vector load from memory to which
/// single numbers have just been written would stall until these stores have completed.
#[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
#[inline(always)]
fn of_four(a: f64, b: f64, c: f64, d: f64) -> [(f64, f64); 4] {
    let [mut sin, mut cos] = [[0.0; 4]; 2];
    if dispatched::best_of_four(a, b, c, d, &mut sin, &mut cos) {
        return four_beyond(a, b, c, d);
    }
    pairs(sin, cos)
}

/// Sines and cosines of four angles, by a call. The angles are passed in registers: a vector load from memory to which
/// single numbers have just been written would stall until these stores have completed.
#[cfg(not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))))]
#[inline(never)]
fn of_four(a: f64, b: f64, c: f64, d: f64) -> [(f64, f64); 4] {
    let x = f64x4::new([a, b, c, d]);
    if x.abs().simd_gt(f64x4::splat(RANGE)).any() {
        return four_beyond(a, b, c, d);
    }
    let (sin, cos) = sin_cos_of_four(x);
    pairs(sin.to_array(), cos.to_array())
}

/// Computes four angles by the standard library, where one of them exceeds the range.
#[cold]
#[inline(never)]
fn four_beyond(a: f64, b: f64, c: f64, d: f64) -> [(f64, f64); 4] {
    [a, b, c, d].map(standard::sin_cos)
}

#[inline(always)]
fn pairs(sin: [f64; 4], cos: [f64; 4]) -> [(f64, f64); 4] {
    [(sin[0], cos[0]), (sin[1], cos[1]), (sin[2], cos[2]), (sin[3], cos[3])]
}

/// Replaces the angles of a list by their sines and writes their cosines, up to the length of the shorter list.
#[inline(never)]
pub(crate) fn sin_cos_in_place(angles: &mut [f64], cosines: &mut [f64]) {
    let count = angles.len().min(cosines.len());
    let (angles, cosines) = (&mut angles[..count], &mut cosines[..count]);
    if let Some(&last) = angles.last_chunk::<8>() {
        for (angles, cosines) in angles.as_chunks_mut::<8>().0.iter_mut().zip(cosines.as_chunks_mut::<8>().0) {
            (*angles, *cosines) = of_eight(angles);
        }
        if !count.is_multiple_of(8)
            && let (Some(angles), Some(cosines)) = (angles.last_chunk_mut(), cosines.last_chunk_mut())
        {
            // Some of the last eight angles have been computed already; they get the same results again.
            (*angles, *cosines) = of_eight(&last);
        }
        return;
    }
    // Padding lanes have the angle 0. The results are copied one by one, because a copy of unknown length is a function
    // call.
    let (sines, last_cosines) = of_eight(&core::array::from_fn(|k| angles.get(k).copied().unwrap_or(0.0)));
    for k in 0..8 {
        if let (Some(angle), Some(cosine)) = (angles.get_mut(k), cosines.get_mut(k)) {
            (*angle, *cosine) = (sines[k], last_cosines[k]);
        }
    }
}

/// Sines and cosines of eight angles.
#[inline(always)]
fn of_eight(angles: &[f64; 8]) -> ([f64; 8], [f64; 8]) {
    let &[a, b, c, d, e, f, g, h] = angles;
    let [(s, c), (t, d)] = sin_cos_lanes([f64x4::new([a, b, c, d]), f64x4::new([e, f, g, h])]);
    let join = |x: f64x4, y: f64x4| {
        let ([a, b, c, d], [e, f, g, h]) = (x.to_array(), y.to_array());
        [a, b, c, d, e, f, g, h]
    };
    (join(s, t), join(c, d))
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    /// The distance between two numbers of the same sign in units in the last place.
    fn ulps(a: f64, b: f64) -> u64 {
        if a == b { 0 } else { a.to_bits().abs_diff(b.to_bits()) }
    }

    fn compare<const N: usize>(angles: [f64; N]) {
        for (angle, (sin, cos)) in angles.into_iter().zip(sin_cos_all(angles)) {
            let exact = angle.sin_cos();
            // More angles than that may be computed by another instruction set.
            assert!(N > MAX_INLINED_ANGLES || (sin, cos) == sin_cos_one(angle), "{angle}");
            assert!(ulps(sin, exact.0) <= 1 && ulps(cos, exact.1) <= 1, "{angle}: {sin} {cos} and {exact:?}");
        }
    }

    #[test]
    fn within_one_step_of_the_standard_library() {
        let mut random = crate::random::Random::new(7);
        for size in [1e-9, 0.8, 3.2, 100.0, 1e4, RANGE] {
            for _ in 0..20_000 {
                compare([0; 3].map(|_| size * random.symmetric()));
                compare([0; 4].map(|_| size * random.symmetric()));
                compare([0; 11].map(|_| size * random.symmetric()));
            }
        }
    }

    #[test]
    fn in_place_as_far_as_both_lists_go() {
        let mut random = crate::random::Random::new(10);
        for (count, cosine_count) in (0..40).flat_map(|count| [(count, count), (count, count / 2), (count, count + 3)])
        {
            let angles: Vec<f64> =
                (0..count).map(|k| if k % 17 == 5 { 1e9 } else { 10.0 * random.symmetric() }).collect();
            let (mut sines, mut cosines) = (angles.clone(), vec![7.0; cosine_count]);
            sin_cos_in_place(&mut sines, &mut cosines);
            for (k, angle) in angles.iter().enumerate() {
                let exact = if k < cosine_count { angle.sin() } else { *angle };
                assert!(ulps(sines[k], exact) <= 1, "{k} of {count}: {angle}");
            }
            for (k, cosine) in cosines.iter().enumerate() {
                let exact = angles.get(k).map_or(7.0, |angle| angle.cos());
                assert!(ulps(*cosine, exact) <= 1, "{k} of {count}");
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

    /// The results of all implementations for two vectors of lanes, whatever the build supports.
    fn in_every_way(x: [f64x4; 2]) -> Vec<[(f64x4, f64x4); 2]> {
        let mut all = vec![sin_cos_lanes(x), of_this_build(&x).0];
        #[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
        {
            let ways = [dispatched::best::<4, 2>, dispatched::each::<true, 4, 2>, dispatched::each::<false, 4, 2>];
            all.push(of_this_processor(&x).0);
            all.extend(ways.map(|way| {
                let [mut sin, mut cos] = [[[0.0; 4]; 2]; 2];
                assert!(!way(&x.map(f64x4::to_array), &mut sin, &mut cos));
                core::array::from_fn(|k| (f64x4::new(sin[k]), f64x4::new(cos[k])))
            }));
        }
        all
    }

    fn compare_lanes(angles: [f64; 8]) {
        let x = [0, 4].map(|first| f64x4::new(core::array::from_fn(|lane| angles[first + lane])));
        for pairs in in_every_way(x) {
            let (sin, cos) = (pairs.map(|(sin, _)| sin.to_array()), pairs.map(|(_, cos)| cos.to_array()));
            for ((angle, sin), cos) in angles.iter().zip(sin.as_flattened()).zip(cos.as_flattened()) {
                let exact = angle.sin_cos();
                assert!(ulps(*sin, exact.0) <= 1 && ulps(*cos, exact.1) <= 1, "{angle}: {sin} {cos} and {exact:?}");
            }
        }
    }

    #[test]
    fn lanes_in_every_way_within_one_step_of_the_standard_library() {
        let mut random = crate::random::Random::new(8);
        for size in [1e-9, 0.8, 3.2, 100.0, 1e4, RANGE] {
            (0..3000).for_each(|_| compare_lanes([0; 8].map(|_| size * random.symmetric())));
        }
        for k in 0..60_000_u32 {
            let zero = f64::from(k * 17) * core::f64::consts::FRAC_PI_2;
            compare_lanes([zero, -zero, zero.next_up(), zero.next_down(), 0.0, -0.0, 0.5 * zero, 0.3]);
        }
    }

    #[test]
    fn no_lane_changes_another_in_any_way() {
        let mut random = crate::random::Random::new(9);
        for _ in 0..1000 {
            let x = [0; 2].map(|_| f64x4::new([0; 4].map(|_| 10.0 * random.symmetric())));
            let wild = [f64::NAN, 1.0, -0.0, 1e-300];
            for lane in 0..4 {
                let mut other = [f64x4::new(wild); 2];
                other[1] =
                    f64x4::new(core::array::from_fn(|k| if k == lane { x[0].to_array()[lane] } else { wild[k] }));
                for (own, moved) in in_every_way(x).into_iter().zip(in_every_way(other)) {
                    let of =
                        |(sin, cos): (f64x4, f64x4)| (sin.to_array()[lane].to_bits(), cos.to_array()[lane].to_bits());
                    assert_eq!(of(own[0]), of(moved[1]));
                }
            }
        }
    }

    #[test]
    fn beyond_the_range_and_without_a_number() {
        compare([1e9, 1.0, -3e15]);
        compare([1e9, 1.0, -3e15, 0.5, 1e300]);
        compare([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1e9, 1.0, -3e15, 0.5, 1e300, 0.1, 0.2, -0.7]);
        assert!(sin_cos_one(f64::NAN).0.is_nan() && sin_cos_one(f64::NEG_INFINITY).1.is_nan());
        assert!(sin_cos_all([f64::NAN, 1.0])[0].0.is_nan() && sin_cos_all([1.0, f64::INFINITY])[1].1.is_nan());
        assert_eq!(sin_cos_all([1.0, f64::NAN])[0].0, 1.0_f64.sin());
        assert!(sin_cos_all([-0.0, 0.0, 1.0]).map(|pair| pair.0.is_sign_negative()) == [true, false, false]);
    }
}

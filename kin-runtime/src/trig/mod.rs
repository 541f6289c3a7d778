//! Sine and cosine of several angles at once, in SIMD lanes.
//!
//! [`cody_waite`] has the arithmetic, for angles up to [`RANGE`]; beyond it the standard library computes. With the feature
//! `dispatch`, several vectors of lanes, and more than a [`FEW`] angles in `f64`, take the instruction set that `dispatched` finds
//! at run time, unless the build has AVX2 anyway. Less is done before the call of another function would be worth its while.

mod cody_waite;
#[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
mod dispatched;
pub(crate) mod vector;

use crate::scalar::sin_cos_of_std;
use cody_waite::{RANGE, sin_cos};
use vector::Group;
use wide::{f64x2, f64x4};

/// Sine and cosine of the lanes of `N` vectors; what is infinite or not a number gives what is not a number.
#[inline(always)]
pub(crate) fn sin_cos_lanes<const N: usize>(x: [f64x4; N]) -> [(f64x4, f64x4); N] {
    #[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
    let (mut out, far) = if N > 1 { of_this_processor(&x) } else { of_this_build(&x) };
    #[cfg(not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))))]
    let (mut out, far) = of_this_build(&x);
    if far {
        for k in 0..N {
            let (s, c) = beyond(x[k].to_array(), out[k].0.to_array(), out[k].1.to_array());
            out[k] = (f64x4::new(s), f64x4::new(c));
        }
    }
    out
}

/// With the instructions that this is built for, and whether an angle is beyond the range.
///
/// Two vectors go through every step together, which keeps a processor busy and fits its registers; one look at the end
/// says whether all angles are within the range.
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
            let (Group(sin), Group(cos)) = sin_cos(Group([x[k], x[k + 1]]));
            (out[k], out[k + 1]) = ((sin[0], cos[0]), (sin[1], cos[1]));
        } else {
            out[k] = sin_cos(x[k]);
        }
        k += 2;
    }
    (out, far.any())
}

/// With the best instructions that the processor has.
#[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
#[allow(dead_code, reason = "tests force every way")]
#[inline(always)]
fn of_this_processor<const N: usize>(x: &[f64x4; N]) -> ([(f64x4, f64x4); N], bool) {
    let [mut sin, mut cos] = [[[0.0; 4]; N]; 2];
    let far = dispatched::best(&x.map(f64x4::to_array), &mut sin, &mut cos);
    (core::array::from_fn(|k| (f64x4::new(sin[k]), f64x4::new(cos[k]))), far)
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

/// Angles whose sines and cosines are part of whoever asks for them. More of them are worth a call, of code that is
/// compiled with kin and not once for every mechanism.
const FEW: usize = 4;

/// Sine and cosine of every angle.
#[inline(always)]
pub(crate) fn sin_cos_all<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    let mut out = [(0.0, 0.0); N];
    if const { N > FEW } {
        let (mut sin, mut cos) = (angles, [0.0; N]);
        sin_cos_in_place(&mut sin, &mut cos);
        for k in 0..N {
            out[k] = (sin[k], cos[k]);
        }
        return out;
    }
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
        for k in 0..N {
            out[k] = (exact[k][0], exact[k][1]);
        }
    }
    out
}

/// The sines of a list of angles in their place, and the cosines, as far as both lists go.
#[inline(never)]
pub(crate) fn sin_cos_in_place(angles: &mut [f64], cosines: &mut [f64]) {
    let count = angles.len().min(cosines.len());
    let (eights, rest) = angles[..count].as_chunks_mut::<8>();
    let (cos_eights, cos_rest) = cosines[..count].as_chunks_mut::<8>();
    for (angles, cosines) in eights.iter_mut().zip(cos_eights) {
        (*angles, *cosines) = of_eight(angles);
    }
    if !rest.is_empty() {
        // Lanes to spare have the angle 0.
        let mut angles = [0.0; 8];
        angles[..rest.len()].copy_from_slice(rest);
        let (sines, cosines) = of_eight(&angles);
        let count = rest.len();
        rest.copy_from_slice(&sines[..count]);
        cos_rest.copy_from_slice(&cosines[..count]);
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
    // A loop, here and above, as it is less code for a compiler than `map`, for every N anew.
    let mut out = [[0.0; 2]; N];
    for k in 0..N {
        let (sin, cos) = sin_cos_of_std(angles[k]);
        out[k] = [sin, cos];
    }
    out
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
            // Many of them may take another instruction set.
            assert!(N > FEW || (sin, cos) == sin_cos_one(angle), "{angle}");
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
    fn beside_the_zeros_of_both() {
        for k in 0..1_000_000_u32 {
            let zero = f64::from(k) * core::f64::consts::FRAC_PI_2;
            compare([zero, -zero]);
        }
    }

    /// Every way in which two vectors of lanes may be computed, whatever this is built for.
    fn in_every_way(x: [f64x4; 2]) -> Vec<[(f64x4, f64x4); 2]> {
        let mut all = vec![sin_cos_lanes(x), of_this_build(&x).0];
        #[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
        {
            let ways = [dispatched::best::<2>, dispatched::each::<true, 2>, dispatched::each::<false, 2>];
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

//! Sines, cosines and angles of vectors in blocks of eight numbers, and the instruction set for code that computes with
//! such blocks.

#[cfg(not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))))]
pub(crate) use of_this_build::{atan2_eights, by_processor, sin_cos_eights};
#[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
pub(crate) use of_this_processor::{atan2_eights, by_processor, sin_cos_eights};

/// The sines and the cosines of `N` blocks.
type SinesAndCosines<const N: usize> = ([[f64; 8]; N], [[f64; 8]; N]);

/// With the instruction set of the build.
#[cfg(not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))))]
mod of_this_build {
    use super::SinesAndCosines;
    use crate::scalar::trig::arctangent::atan2_of_two;
    use crate::scalar::trig::sin_cos_lanes;
    use wide::f64x4;

    #[inline(always)]
    pub(crate) fn by_processor<R>(work: impl FnOnce() -> R) -> R {
        work()
    }

    #[inline(always)]
    pub(crate) fn sin_cos_eights<const N: usize>(x: &[[f64; 8]; N]) -> SinesAndCosines<N> {
        let [mut sin, mut cos] = [[[0.0; 8]; N]; 2];
        for k in 0..N {
            let [(s, c), (t, d)] = sin_cos_lanes(halves(x[k]));
            (sin[k], cos[k]) = (whole([s, t]), whole([c, d]));
        }
        (sin, cos)
    }

    #[inline(always)]
    pub(crate) fn atan2_eights<const N: usize>(y: &[[f64; 8]; N], x: &[[f64; 8]; N]) -> [[f64; 8]; N] {
        let mut angles = [[0.0; 8]; N];
        for k in 0..N {
            angles[k] = whole(atan2_of_two(halves(y[k]), halves(x[k])));
        }
        angles
    }

    #[inline(always)]
    fn halves([a, b, c, d, e, f, g, h]: [f64; 8]) -> [f64x4; 2] {
        [f64x4::new([a, b, c, d]), f64x4::new([e, f, g, h])]
    }

    #[inline(always)]
    fn whole(halves: [f64x4; 2]) -> [f64; 8] {
        let [[a, b, c, d], [e, f, g, h]] = halves.map(f64x4::to_array);
        [a, b, c, d, e, f, g, h]
    }
}

/// With the best instruction set of the processor.
#[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
mod of_this_processor {
    use super::SinesAndCosines;
    #[cfg(not(debug_assertions))]
    pub(crate) use crate::scalar::trig::dispatched::by_processor;
    use crate::scalar::trig::dispatched::{best, best_angles};
    use crate::scalar::trig::{arctangent, beyond};

    /// Without optimisation a copy for another instruction set is not faster, and takes long to compile.
    #[cfg(debug_assertions)]
    #[inline(always)]
    pub(crate) fn by_processor<R>(work: impl FnOnce() -> R) -> R {
        work()
    }

    #[inline(always)]
    pub(crate) fn sin_cos_eights<const N: usize>(x: &[[f64; 8]; N]) -> SinesAndCosines<N> {
        let [mut sin, mut cos] = [[[0.0; 8]; N]; 2];
        if best(x, &mut sin, &mut cos) {
            beyond(x.as_flattened(), sin.as_flattened_mut(), cos.as_flattened_mut());
        }
        (sin, cos)
    }

    #[inline(always)]
    pub(crate) fn atan2_eights<const N: usize>(y: &[[f64; 8]; N], x: &[[f64; 8]; N]) -> [[f64; 8]; N] {
        let mut angles = [[0.0; 8]; N];
        if best_angles(y, x, &mut angles) {
            arctangent::beyond(y.as_flattened(), x.as_flattened(), angles.as_flattened_mut());
        }
        angles
    }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    #[cfg(not(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2"))))]
    use super::by_processor;
    use super::{atan2_eights, sin_cos_eights};
    use crate::random::Random;
    #[cfg(all(feature = "dispatch", target_arch = "x86_64", not(target_feature = "avx2")))]
    use crate::scalar::trig::dispatched::by_processor;

    /// The distance between two numbers in units in the last place; zeros of different signs are far apart.
    fn ulps(a: f64, b: f64) -> u64 {
        if a.is_nan() && b.is_nan() { 0 } else { a.to_bits().abs_diff(b.to_bits()) }
    }

    /// The angles of vectors in every way, whatever the build supports.
    fn angles_in_every_way(y: [f64; 8], x: [f64; 8]) -> Vec<[f64; 8]> {
        let mut all = vec![atan2_eights(&[y], &[x])[0], atan2_eights(&[[1.0; 8], y], &[[0.5; 8], x])[1]];
        #[cfg(all(feature = "dispatch", target_arch = "x86_64"))]
        {
            use crate::scalar::trig::{arctangent, dispatched};
            all.extend([dispatched::angles::<true, 8, 1>, dispatched::angles::<false, 8, 1>].map(|way| {
                let mut out = [[0.0; 8]];
                if way(&[y], &[x], &mut out) {
                    arctangent::beyond(&y, &x, out.as_flattened_mut());
                }
                out[0]
            }));
        }
        all
    }

    #[test]
    fn angles_are_within_two_steps_of_the_standard_library_in_every_way() {
        let mut random = Random::new(21);
        let special =
            [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MAX, -1e308, 5e-324, -1e-310];
        let compare = |y: [f64; 8], x: [f64; 8]| {
            for found in angles_in_every_way(y, x) {
                for k in 0..8 {
                    let exact = y[k].atan2(x[k]);
                    assert!(ulps(found[k], exact) <= 2, "({}, {}): {} for {exact}", x[k], y[k], found[k]);
                }
            }
        };
        for _ in 0..20_000 {
            let [y, x] = [(); 2].map(|()| [(); 8].map(|()| random.symmetric() * 10_f64.powf(4.0 * random.symmetric())));
            compare(y, x);
        }
        for y in special {
            for x in special {
                // Beside usual vectors, which must not change.
                compare([y, 1.0, 0.3, y, -2.0, y, 0.0, 5.0], [x, 0.5, -0.3, x, 1.0, x, -1.0, 1e-3]);
            }
        }
    }

    /// The sines of angles beyond the range of the fast way, beside usual ones.
    #[test]
    fn large_angles_are_left_to_the_standard_library() {
        let x = [0.3, 1e9, -2.0, f64::NAN, f64::INFINITY, 1e300, -0.0, 3.0];
        let ([_, sin], [_, cos]) = sin_cos_eights(&[[0.5; 8], x]);
        for k in 0..8 {
            let (s, c) = x[k].sin_cos();
            assert!(ulps(sin[k], s) <= 1 && ulps(cos[k], c) <= 1, "{}: {} {}", x[k], sin[k], cos[k]);
        }
    }

    #[test]
    fn work_is_done_once_and_its_result_returned() {
        let mut count = 0;
        let result = by_processor(|| {
            count += 1;
            7
        });
        assert_eq!((7, 1), (result, count));
    }
}

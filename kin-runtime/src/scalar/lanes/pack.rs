//! The interface of scalars from which blocks of batches are made.

use super::Lanes;
use crate::scalar::compare::Compare;
use wide::f64x4;

/// Several numbers on which every operation acts in parallel, one for every configuration of a block.
pub(crate) trait Pack: Compare {
    /// The number of lanes.
    const COUNT: usize;
    /// `[X; COUNT]`.
    type Each<X: Copy>: Copy + AsRef<[X]> + AsMut<[X]>;
    /// True for every lane.
    const ALL: Self::Each<bool>;

    /// An array with one element per lane.
    fn each<X: Copy>(of: impl FnMut(usize) -> X) -> Self::Each<X>;
    /// Passes the numbers to `put` block by block, and returns the remainder that fills no block.
    fn read(numbers: &[f64], put: impl FnMut(usize, Self)) -> &[f64];
    /// The value of a lane.
    fn lane(&self, lane: usize) -> f64;
    /// Sets the value of one lane and leaves the others unchanged.
    fn set(&mut self, lane: usize, value: f64);

    /// The block with the values `of(lane)`.
    fn generate(mut of: impl FnMut(usize) -> f64) -> Self {
        let mut numbers = Self::default();
        (0..Self::COUNT).for_each(|lane| numbers.set(lane, of(lane)));
        numbers
    }
}

impl Compare for Lanes {
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0))
    }

    #[inline(always)]
    fn greatest(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0))
    }

    #[inline(always)]
    fn direction(self) -> Self {
        let sign = (self.0 & f64x4::splat(-0.0)) | f64x4::splat(1.0);
        Self(self.0.abs().simd_gt(f64x4::splat(0.0)).select(sign, f64x4::splat(f64::NAN)))
    }
}

impl Pack for Lanes {
    const COUNT: usize = Self::COUNT;
    type Each<X: Copy> = [X; Self::COUNT];
    const ALL: [bool; Self::COUNT] = [true; Self::COUNT];

    #[inline(always)]
    fn each<X: Copy>(of: impl FnMut(usize) -> X) -> [X; Self::COUNT] {
        core::array::from_fn(of)
    }

    #[inline(always)]
    fn read(numbers: &[f64], mut put: impl FnMut(usize, Self)) -> &[f64] {
        let (blocks, rest) = numbers.as_chunks();
        for (k, block) in blocks.iter().enumerate() {
            put(k, Self::new(*block));
        }
        rest
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        self.to_array()[lane]
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, value: f64) {
        let mut numbers = self.to_array();
        numbers[lane] = value;
        *self = Self::new(numbers);
    }
}

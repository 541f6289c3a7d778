//! The interface of scalars from which blocks of batches are made.

use super::Lanes;
use crate::scalar::Scalar;

/// Several numbers on which every operation acts in parallel, one for every configuration of a block.
pub(crate) trait Pack: Scalar + Default {
    /// The number of lanes.
    const COUNT: usize;

    /// Passes the numbers to `put` block by block, and returns the remainder that fills no block.
    fn read(numbers: &[f64], put: impl FnMut(usize, Self)) -> &[f64];
    /// The block with the values `of(lane)`.
    fn generate(element: impl FnMut(usize) -> f64) -> Self;
}

impl Pack for Lanes {
    const COUNT: usize = Self::COUNT;

    #[inline(always)]
    fn read(numbers: &[f64], mut put: impl FnMut(usize, Self)) -> &[f64] {
        let (blocks, rest) = numbers.as_chunks();
        for (k, block) in blocks.iter().enumerate() {
            put(k, Self::new(*block));
        }
        rest
    }

    fn generate(element: impl FnMut(usize) -> f64) -> Self {
        Self::generate(element)
    }
}

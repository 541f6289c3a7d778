//! What operations keep from order to order, one after another in the order of the kernel.

use super::recurrence::Sequences;

/// What a coefficient would need and nobody knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// A higher derivative of an input.
    Input {
        /// Its place.
        index: usize,
        /// The highest order that is known.
        known: usize,
    },
    /// A higher derivative of a supplied function.
    Function {
        /// Its number.
        number: usize,
        /// The highest order that is known.
        known: usize,
    },
}

/// The part of a tape that belongs to one operation: sequences of `stride` numbers.
pub(super) struct Region<'a> {
    pub(super) numbers: &'a mut [f64],
    pub(super) stride: usize,
}

impl Region<'_> {
    #[inline(always)]
    pub(super) fn at(&self, s: usize, i: usize) -> f64 {
        self.numbers[s * self.stride + i]
    }

    #[inline(always)]
    pub(super) fn put(&mut self, s: usize, i: usize, value: f64) {
        self.numbers[s * self.stride + i] = value;
    }
}

impl Sequences for Region<'_> {
    #[inline(always)]
    fn get(&self, s: usize, i: usize) -> f64 {
        self.at(s, i)
    }

    #[inline(always)]
    fn set(&mut self, s: usize, i: usize, value: f64) {
        self.put(s, i, value);
    }

    #[inline(always)]
    fn convolution(&self, a: usize, b: usize, k: usize, first: usize, last: usize) -> f64 {
        if last < first {
            return 0.0;
        }
        let (a, b) = (a * self.stride, b * self.stride);
        let forward = &self.numbers[a + first..=a + last];
        let backward = &self.numbers[b + k - last..=b + k - first];
        forward.iter().zip(backward.iter().rev()).map(|(a, b)| a * b).sum()
    }
}

/// All regions, and the place of the next.
#[derive(Default)]
pub(super) struct Tape {
    pub(super) numbers: Vec<f64>,
    pub(super) stride: usize,
}

impl Tape {
    /// A tape for series up to this order; it takes its room in the first run.
    pub(super) fn new(order: usize) -> Self {
        Self { numbers: Vec::new(), stride: order + 1 }
    }

    /// `size` numbers from `place` on, which moves behind them.
    #[inline(always)]
    pub(super) fn room(&mut self, place: &mut usize, size: usize) -> Region<'_> {
        let start = *place;
        *place += size;
        if self.numbers.len() < *place {
            self.grow(*place);
        }
        Region { numbers: &mut self.numbers[start..*place], stride: self.stride }
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self, size: usize) {
        self.numbers.resize(size, 0.0);
    }
}

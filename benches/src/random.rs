//! Pseudo-random numbers, which are the same in every run.

/// A 64-bit linear congruential generator, whose upper bits are used.
pub struct Draws(u64);

impl Draws {
    /// A generator with this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 11
    }

    /// A number between middle − size and middle + size.
    pub fn about(&mut self, middle: f64, size: f64) -> f64 {
        middle + 2.0 * size * (self.next() as f64 / (1_u64 << 53) as f64 - 0.5)
    }

    /// An index below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() >> 20) as usize % count
    }

    /// Random numbers between −6 and 6, used as angles over about two turns and as lengths.
    pub fn several_turns<const N: usize>(&mut self) -> [f64; N] {
        core::array::from_fn(|_| self.about(0.0, 6.0))
    }
}

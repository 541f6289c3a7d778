//! A random permutation of 0 … n − 1 whose elements are computed one by one, without a table.

use super::counter::bits;

/// Rounds of the network.
const ROUNDS: u64 = 6;

/// A permutation by a Feistel network over the next power of four, which is applied until the value is below the count
/// (cycle walking).
#[derive(Debug)]
pub(super) struct Permutation {
    count: u64,
    /// Bits of either half.
    half: u32,
    seed: u64,
    stream: u64,
}

impl Permutation {
    /// The permutation for a seed and a stream.
    pub(super) fn new(count: u64, seed: u64, stream: u64) -> Self {
        let digits = u64::BITS - count.saturating_sub(1).leading_zeros();
        Self { count, half: digits.div_ceil(2).max(1), seed, stream }
    }

    /// The element at a place; both are below the count.
    pub(super) fn at(&self, place: u64) -> u64 {
        let mut value = self.network(place);
        // The power of four is at most four times the count, so that few applications suffice. The loop ends, because
        // the cycle returns to `place`, which is below the count.
        while value >= self.count {
            value = self.network(value);
        }
        value
    }

    fn network(&self, value: u64) -> u64 {
        let mask = (1 << self.half) - 1;
        let (mut left, mut right) = (value >> self.half, value & mask);
        for round in 0..ROUNDS {
            let mixed = bits(self.seed, self.stream, right | (round << 56)) & mask;
            (left, right) = (right, left ^ mixed);
        }
        left << self.half | right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_has_its_own_value() {
        for count in [1, 2, 3, 4, 5, 100, 1000, 4097] {
            let order = Permutation::new(count, 3, 1);
            let mut values: Vec<u64> = (0..count).map(|place| order.at(place)).collect();
            assert!(count < 100 || values.windows(2).filter(|pair| pair[0] < pair[1]).count() < 2 * values.len() / 3);
            values.sort_unstable();
            assert!(values.iter().copied().eq(0..count), "{count}");
        }
    }
}

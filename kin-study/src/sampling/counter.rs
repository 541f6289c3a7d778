//! Counter-based random numbers: each depends only on the seed, the row and the parameter, not on the numbers before
//! it.

/// Mixes all bits (the finaliser of splitmix64: Steele, Lea and Flood, 2014).
fn mixed(bits: u64) -> u64 {
    let z = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// 64 random bits for a seed, a stream and a counter.
pub(super) fn bits(seed: u64, stream: u64, counter: u64) -> u64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let key = mixed(seed.wrapping_add(GOLDEN)) ^ mixed(stream.wrapping_mul(GOLDEN).wrapping_add(1));
    mixed(mixed(counter.wrapping_mul(GOLDEN).wrapping_add(key)).wrapping_add(key))
}

/// The upper 52 bits as a number in the open interval (0, 1).
pub(super) fn unit(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_even_and_independent_of_their_neighbours() {
        let (mut bins, mut product) = ([0_u32; 16], 0.0);
        let count = 1 << 16;
        for counter in 0..count {
            let [a, b] = [0, 1].map(|stream| unit(bits(7, stream, counter)));
            bins[(16.0 * a) as usize] += 1;
            product += (a - 0.5) * (b - 0.5);
        }
        // Expected 4096 each with a deviation of 62; of the product 0 with 21.
        assert!(bins.iter().all(|count| (3780..4412).contains(count)), "{bins:?}");
        assert!(product.abs() < 110.0, "{product}");
    }

    #[test]
    fn neither_end_of_the_interval_is_reached() {
        assert!(unit(0) > 0.0 && unit(u64::MAX) < 1.0);
    }
}

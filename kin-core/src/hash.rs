//! A hash for small keys of our own making.
//!
//! Macros are built without optimisation, where the standard library's keyed hash takes a good part of an expansion. Its
//! protection against chosen keys is of no use here: keys are ids and instructions, and whoever writes a mechanism
//! waits for it alone. Nothing iterates such a map.

use core::hash::{BuildHasherDefault, Hasher};
use std::collections::HashMap;

/// A map whose keys hash fast.
pub(crate) type FastMap<K, V> = HashMap<K, V, BuildHasherDefault<Fast>>;

/// Multiply and rotate, word by word.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Fast(u64);

impl Fast {
    fn add(&mut self, word: u64) {
        // An odd constant without structure: 2⁶⁴ divided by the golden ratio.
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}

impl Hasher for Fast {
    fn finish(&self) -> u64 {
        // A map takes its place from the lowest bits, which a product mixes least.
        self.0 ^ (self.0 >> 29)
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.add(u64::from(*byte)));
    }

    fn write_u8(&mut self, word: u8) {
        self.add(u64::from(word));
    }

    fn write_u32(&mut self, word: u32) {
        self.add(u64::from(word));
    }

    fn write_i32(&mut self, word: i32) {
        self.add(u64::from(word as u32));
    }

    fn write_u64(&mut self, word: u64) {
        self.add(word);
    }

    fn write_usize(&mut self, word: usize) {
        self.add(word as u64);
    }

    fn write_isize(&mut self, word: isize) {
        self.add(word as u64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::hash::Hash;

    #[test]
    fn neighbours_are_told_apart_by_the_bits_that_a_map_looks_at() {
        let mut lowest = std::collections::BTreeSet::new();
        let mut highest = std::collections::BTreeSet::new();
        for a in 0..64_u32 {
            for b in 0..64_u32 {
                let mut hasher = Fast::default();
                (3_isize, a, b).hash(&mut hasher);
                lowest.insert(hasher.finish() & 0xFFF);
                highest.insert(hasher.finish() >> 57);
            }
        }
        // 4096 keys thrown into 4096 places fill 63 % of them.
        assert!(lowest.len() > 2300 && highest.len() == 128, "{} {}", lowest.len(), highest.len());
    }
}

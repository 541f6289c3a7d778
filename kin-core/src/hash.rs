//! A fast hash for small keys, and a hash table of indices.
//!
//! Macros are compiled without optimisation, where the keyed hash and the SIMD-style tables of the standard library
//! take a considerable part of the time of a macro expansion. Resistance against chosen keys is not needed: the keys
//! are ids and instructions of a mechanism that its author compiles. The maps are never iterated, so their order does
//! not matter.

use core::hash::{BuildHasherDefault, Hash, Hasher};
use std::collections::HashMap;

/// A map with a fast hash.
pub(crate) type FastMap<K, V> = HashMap<K, V, BuildHasherDefault<Fast>>;

/// A hasher that rotates and multiplies word by word.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Fast(u64);

impl Fast {
    fn add(&mut self, word: u64) {
        // 2⁶⁴ divided by the golden ratio, an odd constant without regular structure.
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}

impl Hasher for Fast {
    fn finish(&self) -> u64 {
        // A map uses the lowest bits, which the multiplication mixes least.
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

/// The hash of a key; its upper half, which [`Table`] uses, is mixed best.
pub(crate) fn hash_of(key: &impl Hash) -> u64 {
    let mut hasher = Fast::default();
    key.hash(&mut hasher);
    hasher.0
}

/// A hash table that finds the indices of objects stored elsewhere, with open addressing and linear probing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// Each slot holds the upper half of the hash and the index plus one; 0 is a free slot. The number of slots is a
    /// power of two, and at least half of them are free.
    slots: Vec<u64>,
    len: usize,
}

impl Table {
    /// The index that has this hash and for which `same` holds.
    pub(crate) fn find(&self, hash: u64, same: impl Fn(usize) -> bool) -> Option<usize> {
        if self.slots.is_empty() {
            return None;
        }
        let mask = self.slots.len() - 1;
        let mut at = (hash >> 32) as usize & mask;
        loop {
            let slot = self.slots[at];
            if slot == 0 {
                return None;
            }
            if (slot ^ hash) >> 32 == 0 {
                let place = (slot & 0xFFFF_FFFF) as usize - 1;
                if same(place) {
                    return Some(place);
                }
            }
            at = (at + 1) & mask;
        }
    }

    /// Inserts an index that `find` did not find.
    pub(crate) fn insert(&mut self, hash: u64, index: usize) {
        self.len += 1;
        if 2 * self.len > self.slots.len() {
            let wider = vec![0; (2 * self.slots.len()).max(64)];
            let slots = std::mem::replace(&mut self.slots, wider);
            let mut k = 0;
            while k < slots.len() {
                if slots[k] != 0 {
                    self.put(slots[k]);
                }
                k += 1;
            }
        }
        self.put((hash >> 32 << 32) | (index as u64 + 1));
    }

    fn put(&mut self, slot: u64) {
        let mask = self.slots.len() - 1;
        let mut at = (slot >> 32) as usize & mask;
        while self.slots[at] != 0 {
            at = (at + 1) & mask;
        }
        self.slots[at] = slot;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_finds_what_was_put_in_and_nothing_else() {
        let keys: Vec<u64> = (0..1000).map(|k| k * k % 1009 + 5000 * k).collect();
        let mut table = Table::default();
        for (index, key) in keys.iter().enumerate() {
            // Some keys have equal hashes, and most share their first slot.
            let hash = hash_of(&(*key % 400));
            assert_eq!(table.find(hash, |other| keys[other] == *key), None);
            table.insert(hash, index);
        }
        for (index, key) in keys.iter().enumerate() {
            assert_eq!(table.find(hash_of(&(*key % 400)), |other| keys[other] == *key), Some(index));
        }
        assert_eq!(table.find(hash_of(&401_u64), |_| true), None);
    }

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
        // 4096 random keys in 4096 slots occupy 63 % of them.
        assert!(lowest.len() > 2300 && highest.len() == 128, "{} {}", lowest.len(), highest.len());
    }
}

//! Results at memory addresses that are chosen at random in every round.
//!
//! A load after a store to an address with the same last twelve bits is delayed, and two arrays in the same sets of a
//! cache evict one another. Whether a contender suffers from this depends on the addresses that the allocator happens
//! to choose; over many addresses the effect averages out.

use crate::paired::round;
use crate::random::Draws;
use std::hint::black_box;

/// The number of addresses for each result.
const PLACES: usize = 48;
/// Largest gap between two addresses: one page, so that the last twelve bits are random.
const GAP: usize = 4096;

/// A result of a contender, at another address in every round of [`compare`](crate::paired::compare).
pub struct Placed<T> {
    places: Vec<Box<T>>,
    /// Allocations that separate the places.
    _gaps: Vec<Vec<u8>>,
    draws: Draws,
    round: usize,
    here: usize,
}

impl<T> Placed<T> {
    /// Creates one result per place.
    pub fn new(mut make: impl FnMut() -> T) -> Self {
        // The allocator maps the first large allocation directly, at the start of a page; after freeing one, later
        // allocations of this size come from the heap.
        drop(black_box(make()));
        let mut draws = Draws::new(round() as u64 + 1);
        let mut gaps = Vec::with_capacity(PLACES);
        let places = (0..PLACES)
            .map(|_| {
                gaps.push(black_box(Vec::with_capacity(1 + draws.below(GAP))));
                Box::new(make())
            })
            .collect();
        Self { places, _gaps: gaps, draws, round: round(), here: 0 }
    }

    /// The place of the current round, with arbitrary contents from an earlier round.
    pub fn here(&mut self) -> &mut T {
        if self.round != round() {
            self.round = round();
            self.here = self.draws.below(PLACES);
        }
        &mut self.places[self.here]
    }

    /// The place of the current round, with the contents moved from the place of the last round, so that a state
    /// continues. Contents behind pointers do not move.
    pub fn carried(&mut self) -> &mut T {
        let before = self.here;
        self.here();
        if let Ok([from, to]) = self.places.get_disjoint_mut([before, self.here]) {
            std::mem::swap(&mut **from, &mut **to);
        }
        &mut self.places[self.here]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paired::{Contender, compare};
    use std::collections::HashSet;

    /// In every round a result has a single address, and a state continues.
    #[test]
    fn places_change_with_the_rounds_and_states_go_with_them() {
        let (mut out, mut state) = (Placed::new(|| [0_u64; 9]), Placed::new(|| [0_u64; 9]));
        let (mut places, mut offsets, mut runs) = (HashSet::new(), HashSet::new(), 0);
        let mut work = || {
            let address = std::ptr::from_ref(out.here()).addr();
            assert_eq!(address, std::ptr::from_ref(out.here()).addr(), "one place in one round");
            places.insert(address);
            offsets.insert(address % GAP / 64);
            let state = state.carried();
            assert_eq!(*state, [runs; 9]);
            runs += 1;
            *state = [runs; 9];
        };
        compare("places", 1, &mut [Contender { name: "only one", work: Box::new(&mut work) }]);
        assert!(places.len() > PLACES / 2, "{} places", places.len());
        assert!(offsets.len() > 16, "{} of the 64 cache lines of a page", offsets.len());
    }
}

//! Results at addresses that are chosen at random in every round.
//!
//! A store and a later load whose addresses agree in their last twelve bits wait for one another, and two arrays that
//! share the sets of a cache drive one another out. Which contender has that luck is decided where the allocator
//! happened to put its results; over many places it averages out.

use crate::paired::round;
use crate::random::Draws;
use std::hint::black_box;

/// Places for each of a contender's results.
const PLACES: usize = 48;
/// Room between two places, at most: a page, so that the last twelve bits of their addresses are anyone's.
const GAP: usize = 4096;

/// A result of a contender, in another place in every round of [`compare`](crate::paired::compare).
pub struct Placed<T> {
    places: Vec<Box<T>>,
    /// What keeps the places apart.
    _gaps: Vec<Vec<u8>>,
    draws: Draws,
    round: usize,
    here: usize,
}

impl<T> Placed<T> {
    /// As many of them as there are places.
    pub fn new(mut make: impl FnMut() -> T) -> Self {
        // What the allocator takes from the system directly starts on a page; freed once, that size comes from its heap.
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

    /// The place of this round, with whatever an earlier round left there.
    pub fn here(&mut self) -> &mut T {
        if self.round != round() {
            self.round = round();
            self.here = self.draws.below(PLACES);
        }
        &mut self.places[self.here]
    }

    /// The place of this round, with what stood in the place of the last one: a state goes on from there. What it holds
    /// behind pointers does not move.
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

    /// Runs through all rounds, in each of which a result stands in one place, and a state goes on.
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

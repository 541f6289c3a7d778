//! Detects loops: parts of a stream that repeat with a fixed period while all addresses advance by fixed steps.
//!
//! At every item, the distances to later items of the same kind (and followed by the same kinds) are candidates for the
//! period. The candidate that saves the most items is taken, and the search continues after its loop.

use super::stream::{ItemOperand, Stream};
use crate::hash::{Table, hash_of};

/// A loop: `count` iterations of `period` items each, starting at item `start`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: usize,
    pub(super) period: usize,
    pub(super) count: usize,
}

impl Span {
    pub(super) const fn end(self) -> usize {
        self.start + self.period * self.count
    }

    /// Number of items that the loop saves.
    pub(super) const fn saved(self) -> usize {
        self.period * (self.count - 1)
    }
}

/// Maximum number of periods that are tried at each item.
const CANDIDATES: usize = 40;

/// The loops of a stream, in order, with at least `fewest` iterations each.
pub(super) fn loops(stream: &Stream, fewest: usize) -> Vec<Span> {
    let mut search =
        LoopSearch { stream, fewest, next: next_alike(stream), loops: Vec::new(), loop_of: vec![None; stream.len()] };
    let mut at = 0;
    while at < stream.len() {
        match search.best(at) {
            Some(span) => {
                let number = search.loops.len();
                search.loop_of[span.start..span.end()].fill(Some(number));
                search.loops.push(span);
                at = span.end();
            }
            None => at += 1,
        }
    }
    search.loops
}

/// For every item, the next item of the same kind that is followed by two items of the same kinds as well.
fn next_alike(stream: &Stream) -> Vec<Option<usize>> {
    let kind = |item: usize| stream.kinds.get(item).copied();
    let alike = |a: usize, b: usize| (0..3).all(|k| kind(a + k) == kind(b + k));
    let (mut places, mut latest) = (Table::default(), Vec::new());
    let mut next = vec![None; stream.len()];
    for at in (0..stream.len()).rev() {
        let hash = hash_of(&[0, 1, 2].map(|k| kind(at + k)));
        match places.find(hash, |index| alike(latest[index], at)) {
            Some(index) => next[at] = Some(std::mem::replace(&mut latest[index], at)),
            None => {
                places.insert(hash, latest.len());
                latest.push(at);
            }
        }
    }
    next
}

struct LoopSearch<'s> {
    stream: &'s Stream,
    fewest: usize,
    next: Vec<Option<usize>>,
    loops: Vec<Span>,
    /// The loop that contains each item.
    loop_of: Vec<Option<usize>>,
}

impl LoopSearch<'_> {
    /// The loop starting at `start` that saves the most items.
    fn best(&self, start: usize) -> Option<Span> {
        let mut found: Vec<Span> = Vec::new();
        let mut other = self.next[start];
        let mut candidates = 0;
        while let Some(at) = other
            && candidates < CANDIDATES
        {
            other = self.next[at];
            let period = at - start;
            // A multiple of a period that has been tried ends at the same item.
            if found.iter().any(|span| period.is_multiple_of(span.period) && at < span.end()) {
                continue;
            }
            candidates += 1;
            if start + self.fewest * period > self.stream.len() {
                break;
            }
            let count = 1 + self.run(start, period) / period;
            if count >= self.fewest {
                found.push(Span { start, period, count });
            }
        }
        // Among loops that save the same number of items, the shortest period is preferred.
        found.sort_by_key(|span| (core::cmp::Reverse(span.saved()), span.period));
        found
            .into_iter()
            .find_map(|span| self.addressable(self.with_fewest_crossings(span)).or_else(|| self.addressable(span)))
    }

    /// Number of items from `start` on that are repeated `period` items later with constant steps of their addresses.
    fn run(&self, start: usize, period: usize) -> usize {
        let Stream { kinds, starts, addresses, .. } = self.stream;
        let mut at = start;
        while at + period < kinds.len() && kinds[at] == kinds[at + period] {
            if at >= start + period {
                let [before, current, after] = [starts[at - period], starts[at], starts[at + period]];
                for k in 0..starts[at + 1] - current {
                    if addresses[before + k] + addresses[after + k] != 2 * addresses[current + k] {
                        return at - start;
                    }
                }
            }
            at += 1;
        }
        at - start
    }

    /// Shifts the start of a loop within its first iteration such that the fewest values cross from one iteration to
    /// the next.
    fn with_fewest_crossings(&self, span: Span) -> Span {
        let Span { start, period, count } = span;
        let mut crossing = vec![0_i64; period + 1];
        for (index, item) in (start + period..start + 2 * period).enumerate() {
            for operand in self.stream.operands(item) {
                if let ItemOperand::Item(at, _) = *operand
                    && at >= start
                    && at < item
                {
                    // A cut between item `at` and this item makes the value cross an iteration boundary.
                    let length = (item - at).min(period);
                    let first = (index + period + 1 - length) % period;
                    for k in 0..length {
                        crossing[(first + k) % period] += 1;
                    }
                }
            }
        }
        let cut = (0..period).min_by_key(|k| crossing[*k]).unwrap_or_default();
        if cut == 0 { span } else { Span { start: start + cut, period, count: count - 1 } }
    }

    /// The loop, shortened to the iterations whose operands can be addressed; `None` if too few remain.
    fn addressable(&self, mut span: Span) -> Option<Span> {
        // The first iterations may read values of another loop at irregular addresses; these iterations remain straight
        // code.
        for _ in 0..3 {
            if span.count < self.fewest {
                return None;
            }
            match self.addressable_iterations(span) {
                Some(count) if count >= self.fewest => return Some(Span { count, ..span }),
                _ => span = Span { start: span.start + span.period, count: span.count - 1, ..span },
            }
        }
        None
    }

    /// Number of iterations whose operands are at addresses that a loop can express.
    fn addressable_iterations(&self, span: Span) -> Option<usize> {
        let mut count = span.count;
        for item in span.start..span.start + span.period {
            let (first, second) = (self.stream.addresses(item), self.stream.addresses(item + span.period));
            for (k, operand) in self.stream.operands(item).iter().enumerate() {
                if !matches!(operand, ItemOperand::Item(..)) {
                    continue;
                }
                let step = second[k] - first[k];
                count = self.readable_iterations(span, first[k], step, count)?;
            }
        }
        Some(count)
    }

    /// How many of the items `first`, `first + step`, … belong to one loop, or are straight code at the addresses that
    /// iterations of this loop would have.
    fn readable_iterations(&self, span: Span, first: i64, step: i64, count: usize) -> Option<usize> {
        let start = span.start as i64;
        if step == 0 {
            return (first < start).then_some(count);
        }
        let at = |k: usize| first + k as i64 * step;
        if at(count - 1) >= start {
            // The values are computed by this loop; those of the first iterations may be computed before it.
            let before = (0..count).take_while(|k| at(*k) < start);
            let straight = |index: i64| index >= 0 && self.loop_of[index as usize].is_none();
            return (step == span.period as i64 && before.map(at).all(straight)).then_some(count);
        }
        let loop_at = |k: usize| self.loop_of.get(at(k) as usize).copied().flatten();
        let source = (0..count).find_map(loop_at)?;
        if step % self.loops[source].period as i64 != 0 {
            return None;
        }
        Some((0..count).take_while(|k| loop_at(*k).is_none_or(|other| other == source)).count())
    }
}

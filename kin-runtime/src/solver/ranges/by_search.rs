//! Ranges of motion where groups close by iteration: all folds are found, and sweeps connect the closures between them.
//!
//! Between two neighbouring folds no closure begins or ends, so that the closures at one t between them stand for all
//! closures of that interval. A sweep connects each of them with one on the other side of a fold, or ends at it.

use super::super::any_solver::{AnySolver, SweepEnd};
use super::super::assemblies::{difference, is_length, region};
use super::driven;
use crate::assembly::Assembly;
use crate::certificate::Uncertified;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::planned::{Limit, LimitKind, Sign};
use crate::proof::{Fold, folds};
use crate::ranges::{Range, RangeLimit, Ranges};
use crate::scalar::Interval;
use crate::signal::{Instant, Signal};

/// Configurations that differ by less than this, relative to a radian and to the size of the mechanism, are the same:
/// the first for closures and proven folds, the second for undecided places.
const SAME_CONFIGURATION: [f64; 2] = [1e-7, 1e-3];

/// How far from the ends of a gap its closures are followed, relative to half of the gap.
const FOLLOWED_FROM_END: f64 = 1e-3;

/// If the configuration at the end of a motion is not known, the one this far before the end of the gap is used,
/// relative to half of the gap.
const BEFORE_END: f64 = 1e-6;
/// The nearest place is the limit of a motion if its distance is below this fraction of the distance of the second
/// nearest.
const NEAREST_RATIO: f64 = 0.2;

/// A place at which closures come together, or something is undecided.
struct FoldPlace {
    t: Interval,
    q: Vec<f64>,
    proven: bool,
}

/// An interval of t without a fold, and all closures at its midpoint.
struct Gap {
    from: f64,
    to: f64,
    closures: Vec<Assembly>,
    /// Whether it is proven that this list is complete, and that each of its closures exists on the whole gap.
    complete: bool,
}

/// A closure by the indices of its gap and in the list of this gap.
type ClosureIndex = (usize, usize);

/// A range under construction.
struct OpenRange {
    closures: Vec<ClosureIndex>,
    /// The places at its beginning and at its end.
    ends: [Option<usize>; 2],
}

/// A motion that has ended: the place if it is known, the closure from which it came, and the limit that the motion
/// found.
struct Ended {
    place: Option<usize>,
    closure: ClosureIndex,
    limit: Option<Limit>,
}

impl dyn AnySolver + '_ {
    /// The ranges of all closures.
    pub(super) fn ranges_by_search(&self, start: &Instant<'_>, to: f64, guess: &[f64]) -> Result<Ranges, SolveError> {
        let refuse = |why| SolveError::NotCertified { t: start.t, why };
        let (model, length) = (self.model(), Scale::around(&mut self.equations_at(start)?, guess).length);
        let square = self.square(start, guess).map_err(refuse)?;
        if let Some(row) = square.left_out().first() {
            return Err(refuse(Uncertified::Redundant { row }));
        }
        let way = Interval::new(start.t.min(to), start.t.max(to));
        let sizes: Vec<f64> = (0..guess.len()).map(|k| if is_length(model, k) { length } else { 1.0 }).collect();
        let mut system = self.boxes(start);
        let [region, wide] = region(model, guess, length);
        let all = folds(&square, &mut *system, [&region, &wide], &sizes, way).map_err(refuse)?;
        let mut places: Vec<FoldPlace> = Vec::new();
        let place = |proven: bool| {
            move |Fold { q, t }: Fold| FoldPlace { t, q: q.iter().map(|x| x.midpoint()).collect(), proven }
        };
        for place in all.found.into_iter().map(place(true)).chain(all.undecided.into_iter().map(place(false))) {
            // A place is found twice where an angle is half a turn from its guess, and in several boxes if it is
            // undecided.
            let most = SAME_CONFIGURATION[usize::from(!place.proven)];
            let same = |other: &&mut FoldPlace| {
                other.t.intersection(place.t).is_some() && difference(model, &other.q, &place.q, length) < most
            };
            match places.iter_mut().find(same) {
                Some(other) => (other.t, other.proven) = (other.t.hull(place.t), other.proven && place.proven),
                None => places.push(place),
            }
        }
        places.sort_by(|a, b| a.t.lower().total_cmp(&b.t.lower()));
        let gaps = self.gaps(start, way, &places)?;
        let (chains, ended) = (Vec::new(), Vec::new());
        let mut search = RangeSearch { solver: self, start, length, places, gaps, bounded: all.bounded, chains, ended };
        search.pass_gaps();
        search.connect();
        Ok(search.finish())
    }

    /// The gaps between places, with their closures.
    fn gaps(&self, start: &Instant<'_>, way: Interval, places: &[FoldPlace]) -> Result<Vec<Gap>, SolveError> {
        let (mut from, mut gaps) = (way.lower(), Vec::new());
        let ends = places.iter().map(|place| [place.t.lower(), place.t.upper()]);
        let gap = |from: f64, to: f64| {
            let middle = 0.5 * from + 0.5 * to;
            let inputs: Vec<Signal> = start.inputs.iter().map(|u| u.after(middle - start.t)).collect();
            let all = self.closures(&Instant { t: middle, inputs: &inputs })?;
            Ok::<_, SolveError>(Gap { from, to, complete: all.is_complete(), closures: all.found })
        };
        for [to, next] in ends.chain([[way.upper(), way.upper()]]) {
            let middle = 0.5 * from + 0.5 * to;
            if from < middle && middle < to {
                gaps.push(gap(from, to)?);
            }
            from = from.max(next);
        }
        if places.is_empty() && gaps.is_empty() {
            // A single instant, or one and the next number.
            let [from, to] = [way.lower(), way.upper()];
            gaps.push(gap(from, to)?);
        }
        Ok(gaps)
    }

    /// q at the end of a motion from a configuration.
    fn moved_from(&self, start: &Instant<'_>, q: &[f64], way: [f64; 2]) -> Result<Vec<f64>, SweepEnd> {
        self.moved(start, way, &q.iter().copied().enumerate().collect::<Vec<_>>(), &[])
    }
}

impl Gap {
    fn middle(&self) -> f64 {
        0.5 * self.from + 0.5 * self.to
    }
}

/// The state of the search: gaps, and the chains of closures that become ranges.
struct RangeSearch<'s> {
    solver: &'s dyn AnySolver,
    start: &'s Instant<'s>,
    length: f64,
    places: Vec<FoldPlace>,
    gaps: Vec<Gap>,
    /// Coordinates that are searched only in a bounded interval, and their intervals.
    bounded: Vec<(usize, Interval)>,
    chains: Vec<OpenRange>,
    ended: Vec<Ended>,
}

impl RangeSearch<'_> {
    /// Follows every closure to both ends of its gap, if some coordinate is searched only in a bounded interval:
    /// outside of it a closure can meet another at a place that was not found.
    fn pass_gaps(&mut self) {
        for gap in self.gaps.iter_mut().filter(|_| !self.bounded.is_empty()) {
            let ends = [gap.from, gap.to].map(|end| end + FOLLOWED_FROM_END * (gap.middle() - end));
            let is_inside = |q: &Vec<f64>| self.bounded.iter().all(|&(k, region)| region.contains(q[k]));
            let mut ways = gap.closures.iter().flat_map(|closure| ends.map(|end| (closure, end)));
            gap.complete &= ways.all(|(closure, end)| {
                self.solver.moved_from(self.start, &closure.q, [gap.middle(), end]).is_ok_and(|q| is_inside(&q))
            });
        }
    }

    /// Connects the closures of neighbouring gaps.
    fn connect(&mut self) {
        for gap in 0..self.gaps.len() {
            let count = self.gaps[gap].closures.len();
            let mut is_new = vec![true; count];
            if gap > 0 {
                for before in 0..self.gaps[gap - 1].closures.len() {
                    let from = (gap - 1, before);
                    let chain = self.chains.iter().position(|chain| chain.closures.last() == Some(&from));
                    let Some(chain) = chain else { continue };
                    match self.follow(from, gap) {
                        // Two motions never lead to the same closure.
                        Ok(Some(next)) if is_new[next] => {
                            self.chains[chain].closures.push((gap, next));
                            is_new[next] = false;
                        }
                        Ok(_) => self.chains[chain].ends[1] = self.ended(from, gap, SweepEnd::default()),
                        Err(end) => self.chains[chain].ends[1] = self.ended(from, gap, end),
                    }
                }
            }
            for closure in (0..count).filter(|&closure| is_new[closure]) {
                let first = (gap, closure);
                let begins = gap.checked_sub(1).and_then(|before| {
                    let end = self.follow(first, before).err().unwrap_or_default();
                    self.ended(first, before, end)
                });
                self.chains.push(OpenRange { closures: vec![first], ends: [begins, None] });
            }
        }
    }

    /// The closure of another gap to which a motion leads from a closure; `None` if it is not one of those.
    fn follow(&self, (gap, closure): ClosureIndex, other: usize) -> Result<Option<usize>, SweepEnd> {
        let (from, to) = (&self.gaps[gap], &self.gaps[other]);
        let q = &from.closures[closure].q;
        let reached = self.solver.moved_from(self.start, q, [from.middle(), to.middle()])?;
        let same =
            |other: &Assembly| difference(self.solver.model(), &other.q, &reached, self.length) < SAME_CONFIGURATION[0];
        Ok(to.closures.iter().position(same))
    }

    /// Records that a motion to another gap has ended, and finds its place: the only one between the two gaps, or the
    /// one whose configuration is that of the limit.
    fn ended(&mut self, closure: ClosureIndex, other: usize, end: SweepEnd) -> Option<usize> {
        let [a, b] = [closure.0.min(other), closure.0.max(other)];
        let (from, to) = (self.gaps[a].to, self.gaps[b].from);
        let between = |place: &usize| self.places[*place].t.lower() >= from && self.places[*place].t.upper() <= to;
        let all: Vec<usize> = (0..self.places.len()).filter(between).collect();
        let place = match all[..] {
            [only] => Some(only),
            _ => self.nearest(&all, &self.before(closure, other, end.q)),
        };
        self.ended.push(Ended { place, closure, limit: end.limit });
        place
    }

    /// q at the end of a motion, or shortly before it if the motion has not found it.
    fn before(&self, (gap, closure): ClosureIndex, other: usize, found: Vec<f64>) -> Vec<f64> {
        if !found.is_empty() {
            return found;
        }
        let is_later = other > gap;
        let gap = &self.gaps[gap];
        let end = if is_later { gap.to } else { gap.from };
        let q = &gap.closures[closure].q;
        self.solver
            .moved_from(self.start, q, [gap.middle(), end + BEFORE_END * (gap.middle() - end)])
            .unwrap_or_default()
    }

    /// The place whose configuration is much nearer than those of the others.
    fn nearest(&self, among: &[usize], q: &[f64]) -> Option<usize> {
        let away = |place: usize| difference(self.solver.model(), &self.places[place].q, q, self.length);
        let mut all: Vec<(f64, usize)> = among.iter().map(|&place| (away(place), place)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        match all[..] {
            [(least, place), (next, _), ..] if !q.is_empty() && least < NEAREST_RATIO * next => Some(place),
            _ => None,
        }
    }

    /// The ranges in the order of t, with circuits, and the limits.
    fn finish(self) -> Ranges {
        let mut circuit: Vec<usize> = (0..self.chains.len()).collect();
        let mut limits = Vec::new();
        for (number, place) in self.places.iter().enumerate() {
            let ends: Vec<&Ended> = self.ended.iter().filter(|ended| ended.place == Some(number)).collect();
            // Two closures end at a fold, from the same side.
            let proven = place.proven && matches!(ends[..], [a, b] if a.closure.0 == b.closure.0);
            if proven {
                let joined: Vec<usize> = self
                    .chains
                    .iter()
                    .enumerate()
                    .filter(|(_, chain)| chain.ends.contains(&Some(number)))
                    .map(|(chain, _)| circuit[chain])
                    .collect();
                if let Some(&least) = joined.iter().min() {
                    circuit.iter_mut().filter(|root| joined.contains(root)).for_each(|root| *root = least);
                }
            }
            let kind = proven.then_some(LimitKind::DeadCentre);
            if ends.is_empty() {
                limits.push(self.limit(place.t, &place.q, None, None, kind, false));
            }
            for Ended { closure, limit, .. } in ends {
                limits.push(self.limit(place.t, &place.q, Some(*closure), limit.as_ref(), kind, proven));
            }
        }
        for Ended { closure, limit, .. } in self.ended.iter().filter(|ended| ended.place.is_none()) {
            let t = limit.as_ref().and_then(Limit::at).unwrap_or(self.gaps[closure.0].middle());
            limits.push(self.limit(Interval::from(t), &[], Some(*closure), limit.as_ref(), None, false));
        }
        for gap in self.gaps.iter().filter(|gap| !gap.complete) {
            limits.push(self.limit(Interval::new(gap.from, gap.to), &[], None, None, None, false));
        }
        limits.sort_by(|a, b| a.t.lower().total_cmp(&b.t.lower()));
        let mut order: Vec<usize> = (0..self.chains.len()).collect();
        order.sort_by(|&a, &b| self.way(&self.chains[a])[0].total_cmp(&self.way(&self.chains[b])[0]));
        let mut numbers: Vec<usize> = Vec::new();
        let ranges = order.into_iter().map(|k| {
            let root = circuit[k];
            let number = numbers.iter().position(|&other| other == root).unwrap_or_else(|| {
                numbers.push(root);
                numbers.len() - 1
            });
            self.range(&self.chains[k], number)
        });
        let ranges = ranges.collect();
        let name = |&(k, region): &(usize, Interval)| (self.solver.model().coordinates[k].name, region);
        let searched = self.bounded.iter().map(name).collect();
        Ranges { ranges, limits, circuits: numbers.len(), searched }
    }

    /// Where a range begins and ends.
    fn way(&self, chain: &OpenRange) -> [f64; 2] {
        let gap = |closure: Option<&ClosureIndex>| closure.map(|&(gap, _)| &self.gaps[gap]);
        let time_of_end = |end: usize| chain.ends[end].map(|place| self.places[place].t);
        let from = time_of_end(0).map(|t| t.upper()).or(gap(chain.closures.first()).map(|gap| gap.from));
        let to = time_of_end(1).map(|t| t.lower()).or(gap(chain.closures.last()).map(|gap| gap.to));
        [from, to].map(|t| t.unwrap_or(self.start.t))
    }

    fn range(&self, chain: &OpenRange, circuit: usize) -> Range {
        let [from, to] = self.way(chain);
        let middle = 0.5 * from + 0.5 * to;
        let away = |(gap, _): &&ClosureIndex| (self.gaps[*gap].middle() - middle).abs();
        let nearest = chain.closures.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        let closure = nearest.map(|&(gap, closure)| (&self.gaps[gap], &self.gaps[gap].closures[closure]));
        let q = closure.map(|(gap, closure)| {
            let moved = self.solver.moved_from(self.start, &closure.q, [gap.middle(), middle]);
            moved.unwrap_or_else(|_| closure.q.clone())
        });
        let modes = closure.map_or_else(Vec::new, |(_, closure)| closure.modes.clone());
        Range { modes, from, to, q: q.unwrap_or_default(), circuit }
    }

    fn limit(
        &self,
        t: Interval,
        q: &[f64],
        closure: Option<ClosureIndex>,
        limit: Option<&Limit>,
        kind: Option<LimitKind>,
        proven: bool,
    ) -> RangeLimit {
        let modes: Vec<(&'static str, Sign)> =
            closure.map_or_else(Vec::new, |(gap, closure)| self.gaps[gap].closures[closure].modes.clone());
        let drivers = limit.into_iter().flat_map(Limit::drivers);
        RangeLimit {
            t,
            modes,
            joints: limit.into_iter().flat_map(Limit::joints).collect(),
            drivers: drivers.map(|name| (name, driven(self.solver.model(), name, q))).collect(),
            kind: kind.or(limit.and_then(Limit::kind)),
            q: q.to_vec(),
            proven,
        }
    }
}

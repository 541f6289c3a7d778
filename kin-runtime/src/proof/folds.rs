//! All folds over an interval of t, by branch and prune.
//!
//! A box of u and t ([`ClosureEquations`]) is dropped if an equation has no zero in it, or if f_u is regular on all of it:
//! then no closures come together there. Along the curves of closures a box is made smaller by the interval Newton method
//! in all directions but the one of the curve; what remains is cut in two. For a small box, the proof of the fold in it
//! ([`Proven`]) covers a region that contains the box.
//!
//! Closures may also enter or leave the region through the bounds of coordinates with which the equations do not repeat.
//! On such a bound the same search finds the places at which a closure crosses it.

use super::closure_equations::{ClosureEquations, EvaluatedEquations};
use super::contraction::Preconditioner;
use super::enclosures::Enclosures;
use super::fold::{Proven, null_vector, prove};
use super::krawczyk::Square;
use super::newton_step::{NewtonStep, Shrunk};
use super::turns::turns;
use crate::certificate::Uncertified;
use crate::scalar::Interval;

/// Largest number of examined boxes, and of undecided ones: more undecided boxes than that are a curve of singular places.
const MAX_BOXES: usize = 200_000;
const MAX_UNDECIDED: usize = 200;
/// In boxes narrower than this a fold is sought.
const FOLD_WIDTH: f64 = 0.003;
/// Boxes narrower than this are not divided any further.
const MIN_WIDTH: f64 = 1e-8;
/// How far from the middle of a box its fold may be found, relative to its width.
const MAX_FOLD_OFFSET: f64 = 4.0;

/// A fold: q over the intervals of the proof, and t.
pub(crate) struct Fold {
    pub(crate) q: Vec<Interval>,
    pub(crate) t: Interval,
}

/// What a search for folds has found.
#[derive(Default)]
pub(crate) struct Folds {
    /// In no order; a fold where an angle is just half a turn from its guess may occur twice.
    pub(crate) found: Vec<Fold>,
    /// Intervals of t in which something is undecided or a closure may cross a bound, each with the approximate
    /// configuration there.
    pub(crate) undecided: Vec<Fold>,
    /// The coordinates in which the search is bounded, with their intervals: all but angles with which the equations
    /// repeat after a whole turn.
    pub(crate) bounded: Vec<(usize, Interval)>,
}

/// Searches `region`, which has an interval for every coordinate, and another for coordinates with which the equations do
/// not repeat after a turn, over the interval `way` of t.
///
/// # Errors
/// If rows have no enclosure over any interval of t.
pub(crate) fn folds(
    square: &Square,
    system: &mut dyn Enclosures,
    region: [&[Interval]; 2],
    sizes: &[f64],
    way: Interval,
) -> Result<Folds, Uncertified> {
    system.set_time(way);
    let mut equations = ClosureEquations::new(square, system, region[0]);
    let places: Vec<usize> = equations.places().collect();
    let sizes = places.iter().map(|&k| sizes[k]).chain([way.upper() - way.lower()]).collect();
    // A supplied function has no enclosure over any interval, however short.
    let middle: Vec<Interval> = places.iter().map(|&k| Interval::from(region[0][k].midpoint())).collect();
    equations.at(Interval::around(way.midpoint(), MIN_WIDTH * (way.upper() - way.lower())));
    equations.closure(&middle, true)?;
    // At a single instant a factor of an angle may be an integer by chance.
    let turns = [0.5, 0.382].map(|share| {
        equations.at(Interval::from(way.lower() + share * (way.upper() - way.lower())));
        turns(&mut equations, &middle)
    });
    let is_bounded = |u: &usize| !turns.iter().all(|turns| turns[*u]);
    let interval = |u: usize| region[usize::from(is_bounded(&u))][places[u]];
    let start: Vec<Interval> = (0..places.len()).map(interval).chain([way]).collect();
    let bounded = (0..places.len()).filter(is_bounded).map(|u| (places[u], start[u])).collect();
    let step = NewtonStep::new(places.len(), sizes, MIN_WIDTH);
    let mut search = FoldSearch { equations, step, bound: None, proven: Vec::new(), undecided: Vec::new() };
    search.examine(start.clone());
    for u in (0..places.len()).filter(is_bounded) {
        for bound in [start[u].lower(), start[u].upper()] {
            let mut on_bound = start.clone();
            on_bound[u] = Interval::from(bound);
            search.bound = Some(u);
            search.examine(on_bound);
        }
    }
    Ok(Folds { bounded, ..search.finish(way) })
}

/// The state of a search.
struct FoldSearch<'s> {
    equations: ClosureEquations<'s>,
    /// With the sizes of u and t.
    step: NewtonStep,
    /// The coordinate u that is at a bound; `None` for the search of folds.
    bound: Option<usize>,
    proven: Vec<Proven>,
    undecided: Vec<Vec<Interval>>,
}

impl FoldSearch<'_> {
    /// Examines a box and all that it is cut into.
    fn examine(&mut self, start: Vec<Interval>) {
        let (mut boxes, mut seen) = (vec![start], 0);
        let before = self.undecided.len();
        while let Some(now) = boxes.pop() {
            seen += 1;
            if seen > MAX_BOXES || self.undecided.len() > before + MAX_UNDECIDED {
                // What is left is reported as one box around all of it.
                let undecided = boxes.drain(..).chain(self.undecided.drain(before..));
                let hull =
                    |all: Vec<Interval>, other: Vec<Interval>| all.iter().zip(other).map(|(x, y)| x.hull(y)).collect();
                let hull = undecided.fold(now, hull);
                return self.undecided.push(hull);
            }
            self.look(now, &mut boxes);
        }
    }

    fn finish(mut self, way: Interval) -> Folds {
        let mut folds = Folds::default();
        let m = self.equations.count();
        for place in self.proven.iter().map(|proven| &proven.place).filter(|place| place[m].intersection(way).is_some())
        {
            self.equations.at(place[m]);
            if let Some(q) = self.equations.complete(&place[..m]) {
                folds.found.push(Fold { q, t: place[m] });
            }
        }
        for place in &self.undecided {
            let middle: Vec<Interval> = place.iter().map(|x| Interval::from(x.midpoint())).collect();
            self.equations.at(middle[m]);
            let q = self.equations.complete(&middle[..m]).unwrap_or_default();
            folds.undecided.push(Fold { q, t: place[m] });
        }
        folds
    }

    /// Examines a box: it has no fold, is divided, has a proven fold, or stays undecided.
    fn look(&mut self, mut now: Vec<Interval>, boxes: &mut Vec<Vec<Interval>>) {
        let mut smear = Vec::new();
        loop {
            match self.shrink(&mut now, &mut smear) {
                Shrunk::Empty => return,
                Shrunk::Further => {}
                Shrunk::Enough => break,
            }
        }
        let width = self.step.width(&now);
        if self.bound.is_none() && width < FOLD_WIDTH && self.is_covered(&now, width) {
            return;
        }
        if width < MIN_WIDTH {
            return self.undecided.push(now);
        }
        boxes.extend(self.step.halves(now, &smear).into_iter().flatten());
    }

    /// True if a proven fold is the only singular place that the box can contain.
    fn is_covered(&mut self, now: &[Interval], width: f64) -> bool {
        if self.proven.iter().any(|proven| proven.covers(&mut self.equations, now)) {
            return true;
        }
        let near: Vec<f64> = now.iter().map(|x| x.midpoint()).collect();
        let Some(proven) = prove(&mut self.equations, &near, MAX_FOLD_OFFSET * width, &self.step.sizes) else {
            return false;
        };
        let is_covered = proven.covers(&mut self.equations, now);
        let same = |other: &Proven| other.place.iter().zip(&proven.place).all(|(a, b)| a.intersection(*b).is_some());
        if !self.proven.iter().any(same) {
            self.proven.push(proven);
        }
        is_covered
    }

    /// One step of the interval Newton method across the curve of closures; writes the sums of the sizes of the
    /// derivatives with respect to each of u and t to `smear`.
    fn shrink(&mut self, now: &mut [Interval], smear: &mut Vec<f64>) -> Shrunk {
        let m = self.equations.count();
        self.equations.at(now[m]);
        // A box without an enclosure can still be divided.
        let EvaluatedEquations { mut f_u, f_t, .. } = match self.equations.possible_closure(&now[..m], true) {
            Ok(Some(closure)) if self.bound.is_some() || !self.is_regular(&closure.f_u) => closure,
            Ok(_) => return Shrunk::Empty,
            Err(_) => return Shrunk::Enough,
        };
        f_u.iter_mut().zip(f_t).for_each(|(row, by_t)| row.push(by_t));
        let a = f_u;
        *smear = (0..=m).map(|k| a.iter().map(|row| row[k].magnitude()).sum()).collect();
        let centre: Vec<Interval> = now.iter().map(|x| Interval::from(x.midpoint())).collect();
        self.equations.at(centre[m]);
        let Ok(f) = self.equations.values(&centre[..m]) else { return Shrunk::Enough };
        let bound = self.bound;
        self.step.step(now, [&centre, &f], &a, |sizes| bound.or_else(|| direction(sizes, &a)))
    }

    /// True if f_u is regular over a box: then |I − C f_u| < 1 in the maximum norm, relative to the sizes.
    fn is_regular(&self, f_u: &[Vec<Interval>]) -> bool {
        let m = f_u.len();
        let entries: Vec<(usize, usize)> = (0..m).flat_map(|i| (0..m).map(move |k| (i, k))).collect();
        let values: Vec<Interval> = f_u.iter().flatten().copied().collect();
        let middle = values.iter().map(|a| a.midpoint());
        let Some(mut inverse) = Preconditioner::new(m, &entries, middle) else { return false };
        let (sizes, mut rest) = (&self.step.sizes[..m], vec![0.0; m]);
        inverse.rest(&entries, &values, sizes, &mut rest);
        rest.iter().zip(sizes).all(|(rest, size)| (rest / size).next_up() < 1.0)
    }
}

/// Which of u and t changes most along the curve, relative to the sizes.
fn direction(sizes: &[f64], a: &[Vec<Interval>]) -> Option<usize> {
    let sized = |row: &Vec<Interval>| row.iter().zip(sizes).map(|(&a, &size)| a * Interval::from(size)).collect();
    null_vector(&a.iter().map(sized).collect::<Vec<Vec<Interval>>>()).map(|v| v.iamax())
}

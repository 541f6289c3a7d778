//! All solutions in a region, by branch and prune.
//!
//! A box of the coordinates u of [`ClosureEquations`] is dropped if an equation has no zero in it, and made smaller by
//! the interval Newton method of E. R. Hansen and S. Sengupta (Bounding solutions of systems of equations using
//! interval analysis, BIT 21 (1981)); what remains is cut in two. No solution is ever lost. For a small box, the
//! certificate of the solution in it proves that there is no other in a region that contains the box.

use super::closure_equations::{ClosureEquations, EvaluatedEquations};
use super::enclosures::Enclosures;
use super::krawczyk::Square;
use super::newton_step::{NewtonStep, Shrunk};
use super::turns::turns;
use crate::certificate::{Certificate, Uncertified};
use crate::scalar::Interval;

/// Largest number of examined boxes, and of undecided ones: more undecided boxes than that are a curve of solutions.
const MAX_BOXES: usize = 400_000;
const MAX_UNDECIDED: usize = 1000;
/// In boxes narrower than this a certificate is tried.
const CERTIFIED_WIDTH: f64 = 1e-6;
/// Boxes narrower than this are not divided any further.
const MIN_WIDTH: f64 = 1e-11;

/// q, q̇, q̈ and the certificate of a solution.
pub(crate) type Certified = ([Vec<f64>; 3], Certificate);

/// What a search has found.
#[derive(Default)]
pub(crate) struct SearchOutcome {
    pub(crate) found: Vec<Certified>,
    /// Boxes, by the coordinates that were searched.
    pub(crate) undecided: Vec<Vec<Interval>>,
    /// How many boxes were examined, if the search ended because there were too many.
    pub(crate) unfinished: Option<usize>,
    /// The coordinates that were searched, each with its interval.
    pub(crate) searched: Vec<(usize, Interval)>,
}

/// Searches `region`, which has an interval for every coordinate of the mechanism, and another for coordinates with which the
/// equations do not repeat after a turn; those of eliminated coordinates are not used. `prove` certifies the solution near q.
///
/// # Errors
/// If rows have no enclosure at all.
pub(crate) fn search(
    square: &Square,
    system: &mut dyn Enclosures,
    region: [&[Interval]; 2],
    prove: &mut dyn FnMut(&[f64]) -> Result<Certified, Uncertified>,
) -> Result<SearchOutcome, Uncertified> {
    let mut equations = ClosureEquations::new(square, system, region[0]);
    let places: Vec<usize> = equations.places().collect();
    let middle: Vec<Interval> = places.iter().map(|&k| Interval::from(region[0][k].midpoint())).collect();
    let turns = if region[0] == region[1] { Vec::new() } else { turns(&mut equations, &middle) };
    let start = |(u, &k): (usize, &usize)| region[usize::from(turns.get(u) == Some(&false))][k];
    let start: Vec<Interval> = places.iter().enumerate().map(start).collect();
    let searched = places.into_iter().zip(start.iter().copied()).collect();
    let count = equations.count();
    let mut search = BoxSearch { equations, step: NewtonStep::new(count, vec![1.0; count], MIN_WIDTH) };
    let mut outcome = SearchOutcome { searched, ..SearchOutcome::default() };
    let (mut boxes, mut seen) = (vec![start], 0);
    while let Some(now) = boxes.pop() {
        seen += 1;
        if seen > MAX_BOXES || outcome.undecided.len() > MAX_UNDECIDED {
            outcome.unfinished = Some(seen);
            outcome.undecided.push(now);
            outcome.undecided.append(&mut boxes);
            break;
        }
        search.look(now, &mut boxes, &mut outcome, prove);
    }
    Ok(outcome)
}

/// The state of a search.
struct BoxSearch<'s> {
    equations: ClosureEquations<'s>,
    step: NewtonStep,
}

impl BoxSearch<'_> {
    /// Examines a box: it is empty, divided, has a certified solution, or stays undecided.
    fn look(
        &mut self,
        mut now: Vec<Interval>,
        boxes: &mut Vec<Vec<Interval>>,
        outcome: &mut SearchOutcome,
        prove: &mut dyn FnMut(&[f64]) -> Result<Certified, Uncertified>,
    ) {
        let mut smear = Vec::new();
        loop {
            match self.shrink(&mut now, &mut smear) {
                Shrunk::Empty => return,
                Shrunk::Further => {}
                Shrunk::Enough => break,
            }
        }
        if self.step.width(&now) < CERTIFIED_WIDTH {
            match self.solution(&now, outcome, prove) {
                true => return,
                false if self.step.width(&now) < MIN_WIDTH => return outcome.undecided.push(now),
                false => {}
            }
        }
        boxes.extend(self.step.halves(now, &smear).into_iter().flatten());
    }

    /// One step of the interval Newton method; writes the sums of the sizes of the derivatives with respect to every
    /// coordinate to `smear`.
    fn shrink(&mut self, now: &mut [Interval], smear: &mut Vec<f64>) -> Shrunk {
        // A box without an enclosure can still be divided.
        let EvaluatedEquations { f_u: a, .. } = match self.equations.possible_closure(now, false) {
            Ok(Some(closure)) => closure,
            Ok(None) => return Shrunk::Empty,
            Err(_) => return Shrunk::Enough,
        };
        let count = self.equations.count();
        smear.clear();
        smear.extend((0..count).map(|k| a.iter().map(|row| row[k].magnitude()).sum::<f64>()));
        let centre: Vec<Interval> = now.iter().map(|x| Interval::from(x.midpoint())).collect();
        let Ok(f) = self.equations.values(&centre) else { return Shrunk::Enough };
        self.step.step(now, [&centre, &f], &a, |_| None)
    }

    /// True if the box contains exactly one solution, which has a certificate.
    fn solution(
        &mut self,
        now: &[Interval],
        outcome: &mut SearchOutcome,
        prove: &mut dyn FnMut(&[f64]) -> Result<Certified, Uncertified>,
    ) -> bool {
        let Some(full) = self.equations.complete(now) else { return false };
        let within = |certificate: &Certificate, all: &[Interval]| {
            certificate
                .unique
                .iter()
                .zip(all)
                .all(|(unique, x)| unique.lower() <= x.lower() && x.upper() <= unique.upper())
        };
        if outcome.found.iter().any(|(_, certificate)| within(certificate, &full)) {
            return true;
        }
        let q: Vec<f64> = full.iter().map(|x| x.midpoint()).collect();
        let Ok(certified) = prove(&q) else { return false };
        let alone = within(&certified.1, &full);
        let inside = outcome.searched.iter().all(|&(k, region)| certified.1.q[k].intersection(region).is_some());
        let known = outcome.found.iter().any(|(_, other)| within(other, &certified.1.q));
        if inside && !known {
            outcome.found.push(certified);
        }
        alone
    }
}

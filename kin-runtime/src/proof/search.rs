//! All solutions in a region, by branch and prune.
//!
//! A box of the coordinates u of [`ClosureEquations`] is dropped if an equation has no zero in it, and made smaller by
//! the interval Newton method of E. R. Hansen and S. Sengupta (Bounding solutions of systems of equations using
//! interval analysis, BIT 21 (1981)); what remains is cut in two. No solution is ever lost. For a small box, the
//! certificate of the solution in it proves that there is no other in a region that contains the box.

use super::closure_equations::{ClosureEquations, EvaluatedEquations};
use super::contraction::Preconditioner;
use super::enclosures::Enclosures;
use super::krawczyk::Square;
use crate::certificate::{Certificate, Uncertified};
use crate::scalar::Interval;

/// Largest number of examined boxes, and of undecided ones: more undecided boxes than that are a curve of solutions.
const MOST: usize = 400_000;
const UNDECIDED: usize = 1000;
/// In boxes narrower than this a certificate is tried.
const NARROW: f64 = 1e-6;
/// Boxes narrower than this are not divided any further.
const NARROWEST: f64 = 1e-11;
/// After a step that leaves less than this share of a box, another step is taken.
const WORTHWHILE: f64 = 0.7;

/// q, q̇, q̈ and the certificate of a solution.
pub(crate) type Certified = ([Vec<f64>; 3], Certificate);

/// What a search has found.
#[derive(Default)]
pub(crate) struct Outcome {
    pub(crate) found: Vec<Certified>,
    /// Boxes, by the coordinates that were searched.
    pub(crate) undecided: Vec<Vec<Interval>>,
    /// How many boxes were examined, if the search ended because there were too many.
    pub(crate) unfinished: Option<usize>,
    /// The coordinates that were searched, each with its interval.
    pub(crate) searched: Vec<(usize, Interval)>,
}

/// Searches `region`, which has an interval for every coordinate of the mechanism; those of eliminated coordinates are
/// not used. `prove` certifies the solution near q.
///
/// # Errors
/// If rows have no enclosure at all.
pub(crate) fn search(
    square: &Square,
    system: &mut dyn Enclosures,
    region: &[Interval],
    prove: &mut dyn FnMut(&[f64]) -> Result<Certified, Uncertified>,
) -> Result<Outcome, Uncertified> {
    let equations = ClosureEquations::new(square, system, region);
    let places: Vec<usize> = equations.places().collect();
    let start: Vec<Interval> = places.iter().map(|&k| region[k]).collect();
    let searched = places.into_iter().zip(start.iter().copied()).collect();
    let count = equations.count();
    let entries = (0..count).flat_map(|i| (0..count).map(move |k| (i, k))).collect();
    let inverse = Preconditioner::with_room(count);
    let exchanges = Vec::with_capacity(count);
    let [newton, columns, column] = [count, count * count, count].map(|length| vec![Interval::ZERO; length]);
    let mut search = Search { equations, entries, inverse, exchanges, newton, columns, column };
    let mut outcome = Outcome { searched, ..Outcome::default() };
    let (mut boxes, mut seen) = (vec![start], 0);
    while let Some(now) = boxes.pop() {
        seen += 1;
        if seen > MOST || outcome.undecided.len() > UNDECIDED {
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
struct Search<'s> {
    equations: ClosureEquations<'s>,
    /// (row, column) of all derivatives of the equations.
    entries: Vec<(usize, usize)>,
    /// Buffers.
    inverse: Preconditioner,
    exchanges: Vec<usize>,
    newton: Vec<Interval>,
    columns: Vec<Interval>,
    column: Vec<Interval>,
}

impl Search<'_> {
    /// Examines a box: it is empty, divided, has a certified solution, or stays undecided.
    fn look(
        &mut self,
        mut now: Vec<Interval>,
        boxes: &mut Vec<Vec<Interval>>,
        outcome: &mut Outcome,
        prove: &mut dyn FnMut(&[f64]) -> Result<Certified, Uncertified>,
    ) {
        let mut smear = Vec::new();
        loop {
            let before = width(&now);
            match self.shrink(&mut now, &mut smear) {
                Shrunk::Empty => return,
                Shrunk::Unknown => break,
                Shrunk::To if width(&now) > WORTHWHILE * before || width(&now) < NARROWEST => break,
                Shrunk::To => {}
            }
        }
        if width(&now) < NARROW {
            match self.solution(&now, outcome, prove) {
                true => return,
                false if width(&now) < NARROWEST => return outcome.undecided.push(now),
                false => {}
            }
        }
        let weight = |k: usize| smear.get(k).copied().unwrap_or(1.0) * (now[k].upper() - now[k].lower());
        // A coordinate that hardly changes the equations is cut, too, once all others are narrow.
        let wide = (0..now.len()).filter(|&k| now[k].upper() - now[k].lower() >= NARROWEST);
        let Some(cut) = wide.max_by(|&a, &b| weight(a).total_cmp(&weight(b))) else { return };
        let middle = now[cut].midpoint();
        let (mut lower, mut upper) = (now.clone(), now);
        lower[cut] = Interval::new(lower[cut].lower(), middle);
        upper[cut] = Interval::new(middle, upper[cut].upper());
        boxes.extend([lower, upper]);
    }

    /// One step of the interval Newton method; writes the sums of the sizes of the derivatives with respect to every
    /// coordinate to `smear`.
    fn shrink(&mut self, now: &mut [Interval], smear: &mut Vec<f64>) -> Shrunk {
        // A box without an enclosure can still be divided.
        let EvaluatedEquations { f_u: a, .. } = match self.equations.possible_closure(now, false) {
            Ok(Some(closure)) => closure,
            Ok(None) => return Shrunk::Empty,
            Err(_) => return Shrunk::Unknown,
        };
        let count = self.equations.count();
        smear.clear();
        smear.extend((0..count).map(|k| a.iter().map(|row| row[k].magnitude()).sum::<f64>()));
        let centre: Vec<Interval> = now.iter().map(|x| Interval::from(x.midpoint())).collect();
        let Ok(f) = self.equations.values(&centre) else { return Shrunk::Unknown };
        let away: Vec<Interval> = now.iter().zip(&centre).map(|(&x, &c)| x - c).collect();
        let sum = |terms: &mut dyn Iterator<Item = Interval>| terms.fold(Interval::from(0.0), |sum, term| sum + term);
        let mean = |(&f, row): (&Interval, &Vec<Interval>)| f + sum(&mut row.iter().zip(&away).map(|(&a, &x)| a * x));
        if f.iter().zip(&a).map(mean).any(Interval::excludes_zero) {
            return Shrunk::Empty;
        }
        let Self { inverse, entries, exchanges, newton, columns, column, .. } = self;
        if !inverse.set(entries, a.iter().flatten().map(|a| a.midpoint()), exchanges) {
            return Shrunk::Unknown;
        }
        inverse.times_to(&f, newton);
        for (k, product) in columns.chunks_exact_mut(count.max(1)).enumerate() {
            column.clear();
            column.extend(a.iter().map(|row| row[k]));
            inverse.times_to(column, product);
        }
        for i in 0..count {
            let of = |k: usize| columns[k * count + i];
            if of(i).contains(0.0) {
                continue;
            }
            let others = &mut (0..count).filter(|&k| k != i).map(|k| of(k) * (now[k] - centre[k]));
            let newton = centre[i] - (newton[i] + sum(others)) / of(i);
            match now[i].intersection(newton) {
                Some(smaller) => now[i] = smaller,
                None if newton.is_defined() => return Shrunk::Empty,
                None => {}
            }
        }
        Shrunk::To
    }

    /// True if the box contains exactly one solution, which has a certificate.
    fn solution(
        &mut self,
        now: &[Interval],
        outcome: &mut Outcome,
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

/// The result of a step on a box.
enum Shrunk {
    /// There is no solution in it.
    Empty,
    /// The step gives no information.
    Unknown,
    /// It was intersected with the enclosure of the step.
    To,
}

/// The largest width.
fn width(all: &[Interval]) -> f64 {
    all.iter().fold(0.0, |most, x| (x.upper() - x.lower()).max(most))
}

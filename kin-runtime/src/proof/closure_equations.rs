//! The equations that are left when everything that follows by sums and single rows is taken out of a mechanism.

use super::eliminated::{self, EliminatedAngle};
use super::enclosures::Enclosures;
use super::krawczyk::Square;
use super::reduced::Reduced;
use crate::certificate::Uncertified;
use crate::scalar::Interval;
use crate::workspace::Subset;
use core::f64::consts::FRAC_PI_2;

const ZERO: Interval = Interval::new(0.0, 0.0);
/// Derivatives are constant if their bounds are this close, relative to their size.
const CONSTANT: f64 = 1e-12;
/// Angles at which derivatives are compared.
const ANGLES: [f64; 5] = [0.7, 1.9, 2.6, 4.1, 5.3];

/// f(u, t) = 0: the closure equations f of the coordinates u that no single row determines.
///
/// [`Reduced`] takes out the x and y of bodies. Of the coordinates that remain, *known* ones follow one after another from
/// equations with constant factors: driven angles, and angles that gears couple with them. Angles of pinned bodies that occur
/// in one loop only are [eliminated](EliminatedAngle).
pub(super) struct ClosureEquations<'s> {
    square: &'s Square,
    system: &'s mut dyn Enclosures,
    reduced: Reduced,
    /// Known coordinates among the remaining ones in the order in which they follow, each with its equation, and the factors
    /// of that equation by all remaining coordinates.
    determined: Vec<(usize, usize, Vec<Interval>)>,
    /// The intervals of known coordinates, and those of their rates.
    known: Vec<Option<Interval>>,
    /// Eliminated angles, each with the middle of its interval.
    eliminated: Vec<(EliminatedAngle, f64)>,
    /// The indices of u among the remaining coordinates.
    unknown: Vec<usize>,
    /// The equations f among those of [`Reduced`]; the ones of eliminated angles come after them.
    rows: Vec<usize>,
    /// Buffers: zeros, and what the mechanism's rows are.
    still: Vec<Interval>,
    of_rows: Vec<Interval>,
}

/// f, its derivatives by u, and the one by t.
pub(super) struct Closure {
    pub(super) f: Vec<Interval>,
    /// By u, row by row.
    pub(super) f_u: Vec<Vec<Interval>>,
    /// By t, known coordinates moving with it; empty unless asked for.
    pub(super) f_t: Vec<Interval>,
    /// g of every eliminated angle, and its derivatives.
    vectors: Vec<Vector>,
}

/// g of an eliminated angle, its derivatives by u, and the one by t; 0 unless asked for.
struct Vector {
    g: [Interval; 2],
    by_u: Vec<[Interval; 2]>,
    by_t: [Interval; 2],
}

impl<'s> ClosureEquations<'s> {
    /// The equations over a region, which has an interval for every coordinate of the mechanism.
    pub(super) fn new(square: &'s Square, system: &'s mut dyn Enclosures, region: &[Interval]) -> Self {
        let reduced = Reduced::new(square);
        let m = reduced.left.len();
        let (known, unknown, rows) = (vec![None; m], (0..m).collect(), (0..m).collect());
        let (determined, eliminated) = (Vec::new(), Vec::new());
        let (still, of_rows) = (vec![ZERO; square.coordinates()], Vec::new());
        let mut equations =
            Self { square, system, reduced, determined, known, eliminated, unknown, rows, still, of_rows };
        equations.determine(region);
        equations.eliminate(region);
        equations
    }

    /// Finds the known coordinates.
    fn determine(&mut self, region: &[Interval]) {
        let m = self.reduced.left.len();
        let everywhere = everywhere(region);
        let Ok(Values { phi_q, .. }) = self.evaluate(&everywhere, Subset::JACOBIAN) else { return };
        let mut jacobian: Vec<Vec<Interval>> = self.rows.iter().map(|&i| self.reduced.gradient(&phi_q, i)).collect();
        let number = |entry: &Interval| entry.lower() == entry.upper();
        let mut is_known = vec![false; m];
        loop {
            let open = |row: &[Interval]| {
                let mut left = (0..m).filter(|&k| row[k] != ZERO && !is_known[k]);
                match (left.next(), left.next()) {
                    (Some(k), None) if row.iter().all(number) => Some(k),
                    _ => None,
                }
            };
            let Some((i, k)) = self.rows.iter().find_map(|&i| Some((i, open(&jacobian[i])?))) else { break };
            is_known[k] = true;
            self.determined.push((k, i, std::mem::take(&mut jacobian[i])));
            self.rows.retain(|&row| row != i);
        }
        self.unknown.retain(|&k| !is_known[k]);
        self.follow();
    }

    /// Eliminates angles that occur in two equations only.
    fn eliminate(&mut self, region: &[Interval]) {
        for k in self.unknown.clone() {
            let column = self.reduced.left[k];
            let own = self.rows.iter().copied().filter(|&i| self.reduced.depends(i, k)).collect::<Vec<_>>();
            let &[a, b] = own.as_slice() else { continue };
            if !self.square.is_pinned_angle(column) || self.unknown.len() == 1 {
                continue;
            }
            let Some(found) = self.eliminated_angle(k, [a, b], region) else { continue };
            self.eliminated.push((found, region[column].midpoint()));
            self.unknown.retain(|&unknown| unknown != k);
            self.rows.retain(|row| ![a, b].contains(row));
        }
    }

    /// The angle with these two equations, if their derivatives by it are those of M (cos φ, sin φ) wherever the other
    /// coordinates are.
    fn eliminated_angle(&mut self, k: usize, rows: [usize; 2], region: &[Interval]) -> Option<EliminatedAngle> {
        let column = self.reduced.left[k];
        let everywhere = everywhere(region);
        let mut derivatives = |angle: Interval| {
            let mut q =
                self.coordinates(&self.unknown.iter().map(|&k| everywhere[self.reduced.left[k]]).collect::<Vec<_>>());
            q[column] = angle;
            let phi_q = self.evaluate(&q, Subset::JACOBIAN).ok()?.phi_q;
            Some(rows.map(|i| self.reduced.derivative(&phi_q, i, k)))
        };
        let quarter = Interval::new(FRAC_PI_2, FRAC_PI_2.next_up());
        let (at_zero, at_quarter) = (derivatives(ZERO)?, derivatives(quarter)?);
        let size = at_zero.iter().chain(&at_quarter).fold(0.0, |most: f64, x| most.max(x.magnitude()));
        let is_narrow = |x: &Interval| x.radius() <= CONSTANT * size;
        let found = EliminatedAngle::new(k, rows, at_zero, at_quarter)?;
        // Points of a pin do not depend on the angle of their body, unless somebody writes it.
        let is_same = ANGLES.into_iter().all(|angle| {
            let angle = Interval::from(angle);
            let own = found.derivatives(angle);
            derivatives(angle)
                .is_some_and(|all| all.iter().zip(own).all(|(x, own)| is_narrow(x) && x.intersection(own).is_some()))
        });
        (is_same && at_zero.iter().chain(&at_quarter).all(is_narrow)).then_some(found)
    }

    /// The vectors g of eliminated angles, given the values of all equations.
    fn vectors(&self, values: &[Interval]) -> Vec<[Interval; 2]> {
        self.eliminated.iter().map(|(angle, _)| angle.vector(angle.rows.map(|i| values[i]))).collect()
    }

    /// Sets the instant, by its t, and computes the known coordinates there.
    pub(super) fn at(&mut self, t: Interval) {
        self.system.set_time(t);
        self.follow();
    }

    /// Computes the known coordinates: their equations are linear in them, and have no others.
    fn follow(&mut self) {
        self.known.fill(None);
        let q = self.coordinates(&[]);
        let values = self.evaluate(&q, Subset::PHI).map(|values| values.phi);
        for (k, row, factors) in &self.determined {
            // Where there are no values, nothing is known of them.
            let value = values.as_ref().map_or(Interval::ENTIRE, |values| values[*row]);
            self.known[*k] = Some(-self.with_known(value, factors, &self.known) / factors[*k]);
        }
    }

    /// `value` + Σ factor · number over the coordinates that have a number.
    fn with_known(&self, value: Interval, factors: &[Interval], numbers: &[Option<Interval>]) -> Interval {
        let terms = factors.iter().zip(numbers).filter_map(|(&factor, number)| Some(factor * (*number)?));
        terms.fold(value, |sum, term| sum + term)
    }

    /// How many numbers u has.
    pub(super) fn count(&self) -> usize {
        self.unknown.len()
    }

    /// The coordinates u by their places in q.
    pub(super) fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.unknown.iter().map(|&k| self.reduced.left[k])
    }

    /// f and its derivatives over a box, the one by t if `with_time`.
    pub(super) fn closure(&mut self, u: &[Interval], with_time: bool) -> Result<Closure, Uncertified> {
        self.closure_of(u, with_time, false)?.ok_or(Uncertified::Malformed)
    }

    /// The same; none where an equation, those of known coordinates included, has no zero.
    pub(super) fn possible_closure(&mut self, u: &[Interval], with_time: bool) -> Result<Option<Closure>, Uncertified> {
        self.closure_of(u, with_time, true)
    }

    /// f and its derivatives over a box; none if `only_possible` and an equation has no zero.
    fn closure_of(
        &mut self,
        u: &[Interval],
        with_time: bool,
        only_possible: bool,
    ) -> Result<Option<Closure>, Uncertified> {
        let q = self.coordinates(u);
        let Values { phi: values, phi_q, phi_t } =
            self.evaluate(&q, Subset { phi_t: with_time, ..Subset::POSITION })?;
        let vectors = self.vectors(&values);
        let angles = vectors.iter().map(|&g| eliminated::closure(g));
        let f: Vec<Interval> = self.rows.iter().map(|&i| values[i]).chain(angles).collect();
        let known = self.determined.iter().map(|(_, row, _)| values[*row]);
        if only_possible && known.chain(f.iter().copied()).any(Interval::excludes_zero) {
            return Ok(None);
        }
        let derivative = |i: usize, k: usize| self.reduced.derivative(&phi_q, i, k);
        let rates = if with_time { self.rates(&phi_t) } else { Vec::new() };
        let by_t = |i: usize| self.with_known(phi_t[i], &self.reduced.gradient(&phi_q, i), &rates);
        let vector = |((angle, _), g): (&(EliminatedAngle, f64), [Interval; 2])| Vector {
            g,
            by_u: self.unknown.iter().map(|&k| angle.change(angle.rows.map(|i| derivative(i, k)))).collect(),
            by_t: if with_time { angle.change(angle.rows.map(by_t)) } else { [ZERO; 2] },
        };
        let vectors: Vec<Vector> = self.eliminated.iter().zip(vectors).map(vector).collect();
        let mut f_u: Vec<Vec<Interval>> =
            self.rows.iter().map(|&i| self.unknown.iter().map(|&k| derivative(i, k)).collect()).collect();
        let mut f_t: Vec<Interval> = self.rows.iter().filter(|_| with_time).map(|&i| by_t(i)).collect();
        for Vector { g, by_u, by_t } in &vectors {
            f_u.push(by_u.iter().map(|&dg| eliminated::derivative(*g, dg)).collect());
            f_t.extend(with_time.then(|| eliminated::derivative(*g, *by_t)));
        }
        Ok(Some(Closure { f, f_u, f_t, vectors }))
    }

    /// Whether the equations are the same after a whole turn of each number of u: not those of lengths, and not those of
    /// angles that gears couple in a ratio.
    pub(super) fn turns(&mut self, u: &[Interval]) -> Vec<bool> {
        let turn = Interval::new(std::f64::consts::TAU, std::f64::consts::TAU.next_up());
        let of = |equations: &mut Self, u: &[Interval]| {
            let q = equations.coordinates(u);
            equations.evaluate(&q, Subset::PHI).map(|values| values.phi).unwrap_or_default()
        };
        let here = of(self, u);
        let is_same = |k: usize| {
            let mut turned = u.to_vec();
            turned[k] = turned[k] + turn;
            let there = of(self, &turned);
            !here.is_empty()
                && here.len() == there.len()
                && here.iter().zip(there).all(|(a, b)| a.intersection(b).is_some())
        };
        (0..u.len()).map(is_same).collect()
    }

    /// f over a box.
    pub(super) fn values(&mut self, u: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        let q = self.coordinates(u);
        let phi = self.evaluate(&q, Subset::PHI)?.phi;
        let angles = self.vectors(&phi).into_iter().map(eliminated::closure);
        Ok(self.rows.iter().map(|&i| phi[i]).chain(angles).collect())
    }

    /// The rates of known coordinates, given the derivatives of the equations by t.
    fn rates(&self, phi_t: &[Interval]) -> Vec<Option<Interval>> {
        let mut rates = vec![None; self.known.len()];
        for (k, row, factors) in &self.determined {
            rates[*k] = Some(-self.with_known(phi_t[*row], factors, &rates) / factors[*k]);
        }
        rates
    }

    /// The rates of the known coordinates over a box, among all coordinates of the mechanism.
    pub(super) fn known_rates(&mut self, u: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        let q = self.coordinates(u);
        let phi_t = self.evaluate(&q, Subset::TIME_DERIVATIVE)?.phi_t;
        let mut of_all = vec![ZERO; q.len()];
        for (&column, rate) in self.reduced.left.iter().zip(self.rates(&phi_t)) {
            of_all[column] = rate.unwrap_or(ZERO);
        }
        Ok(of_all)
    }

    /// −(f_uu w w + 2 f_ut w + f_tt), along rates w of u and `rates` of the known coordinates: γ of the mechanism. `closure`
    /// is that of the box, by t as well.
    pub(super) fn gamma(
        &mut self,
        closure: &Closure,
        (u, rates): (&[Interval], &[Interval]),
        w: &[Interval],
    ) -> Result<Vec<Interval>, Uncertified> {
        let q = self.coordinates(u);
        let mut q_dot = rates.to_vec();
        for (&k, &w) in self.unknown.iter().zip(w) {
            q_dot[self.reduced.left[k]] = w;
        }
        let evaluated = self.system.evaluate(Subset::GAMMA, &q, &q_dot).map_err(|_| Uncertified::Malformed)?;
        self.square.kept(evaluated.gamma, &mut self.of_rows)?;
        let gamma = self.reduced.values(&self.of_rows);
        let mut of_all: Vec<Interval> = self.rows.iter().map(|&i| gamma[i]).collect();
        for ((angle, _), Vector { g, by_u, by_t }) in self.eliminated.iter().zip(&closure.vectors) {
            let along = |i: usize| by_u.iter().zip(w).fold(by_t[i], |sum, (by, &w)| sum + by[i] * w);
            let second = angle.change(angle.rows.map(|i| -gamma[i]));
            of_all.push(-eliminated::second_derivative(*g, [along(0), along(1)], second));
        }
        Ok(of_all)
    }

    /// True if the derivatives f_u are proven to have no jumps over a box.
    pub(super) fn is_smooth(&self, u: &[Interval]) -> bool {
        self.system.is_smooth(&self.coordinates(u))
    }

    /// All coordinates over a box, the eliminated ones included.
    pub(super) fn complete(&mut self, u: &[Interval]) -> Option<Vec<Interval>> {
        let mut q = self.coordinates(u);
        if !self.eliminated.is_empty() {
            let phi = self.evaluate(&q, Subset::PHI).ok()?.phi;
            for ((angle, near), g) in self.eliminated.iter().zip(self.vectors(&phi)) {
                q[self.reduced.left[angle.angle]] = EliminatedAngle::direction(g, *near);
            }
        }
        let evaluated = self.system.evaluate(Subset::PHI, &q, &self.still).ok()?;
        self.square.phi(evaluated.phi, &q, &mut self.of_rows).ok()?;
        self.reduced.complete(&self.of_rows, &mut q);
        Some(q)
    }

    /// All coordinates, with 0 for the eliminated ones.
    fn coordinates(&self, u: &[Interval]) -> Vec<Interval> {
        let mut q = vec![ZERO; self.square.coordinates()];
        for (&column, known) in self.reduced.left.iter().zip(&self.known) {
            q[column] = known.unwrap_or(ZERO);
        }
        for (&k, &x) in self.unknown.iter().zip(u) {
            q[self.reduced.left[k]] = x;
        }
        q
    }

    /// The equations over a box of all coordinates; lists that are not in the subset are empty.
    fn evaluate(&mut self, q: &[Interval], subset: Subset) -> Result<Values, Uncertified> {
        let Self { system, reduced, square, still, of_rows, .. } = self;
        let rows = system.evaluate(subset, q, still).map_err(|_| Uncertified::Malformed)?;
        let mut values = Values::default();
        if subset.phi {
            square.phi(rows.phi, q, of_rows)?;
            values.phi = reduced.values(of_rows);
        }
        if subset.phi_q {
            square.matrix(rows.phi_q, &mut values.phi_q)?;
        }
        if subset.phi_t {
            square.kept(rows.phi_t, of_rows)?;
            values.phi_t = reduced.values(of_rows);
        }
        Ok(values)
    }
}

/// A very large region, over which only constants are single numbers.
fn everywhere(region: &[Interval]) -> Vec<Interval> {
    region.iter().map(|x| x.hull(Interval::new(-1e6, 1e6))).collect()
}

/// The equations of [`Reduced`] and their derivatives by t, and the entries of the rows from which those by coordinates follow.
#[derive(Default)]
struct Values {
    phi: Vec<Interval>,
    phi_q: Vec<Interval>,
    phi_t: Vec<Interval>,
}

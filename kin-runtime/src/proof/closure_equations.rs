//! The closure equations of a mechanism: those that remain when all coordinates that follow from sums of rows or from
//! single rows have been eliminated.

use super::eliminated::{EliminatedAngle, dot};
use super::enclosures::{Enclosures, everywhere};
use super::krawczyk::{Square, Unbounded};
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
/// [`Reduced`] eliminates the x and y of bodies. Of the coordinates that remain, *known* ones are computed in turn,
/// each from one linear equation with constant factors: driven angles, and angles that gears couple with them. Angles
/// of pinned bodies that occur in one loop only are [eliminated](EliminatedAngle).
pub(super) struct ClosureEquations<'s> {
    square: &'s Square,
    system: &'s mut dyn Enclosures,
    reduced: Reduced,
    /// Known coordinates among the remaining ones in the order of their computation, each with its equation, and the
    /// factors of all remaining coordinates in it.
    determined: Vec<(usize, usize, Vec<Interval>)>,
    /// The intervals of known coordinates, and those of their rates.
    known: Vec<Option<Interval>>,
    /// Eliminated angles, each with the middle of its interval.
    eliminated: Vec<(EliminatedAngle, f64)>,
    /// The indices of u among the remaining coordinates.
    unknown: Vec<usize>,
    /// The equations f among those of [`Reduced`]; the ones of eliminated angles come after them.
    rows: Vec<usize>,
    /// Buffers: zeros, all coordinates over the current box, and the values of the mechanism's rows and of the
    /// equations there.
    still: Vec<Interval>,
    q: Vec<Interval>,
    of_rows: Vec<Interval>,
    values: Values,
}

/// f with ∂f/∂u and ∂f/∂t.
pub(super) struct EvaluatedEquations {
    pub(super) f: Vec<Interval>,
    /// ∂f/∂u, row by row.
    pub(super) f_u: Vec<Vec<Interval>>,
    /// ∂f/∂t, with known coordinates moving; empty unless requested.
    pub(super) f_t: Vec<Interval>,
    /// The constant parts of eliminated angles, with their derivatives.
    constant_parts: Vec<ConstantPart>,
}

/// 2 N a of an eliminated angle, and the derivatives of a with respect to u and to t; the latter is 0 unless requested.
struct ConstantPart {
    slope: [Interval; 2],
    by_u: Vec<[Interval; 2]>,
    by_t: [Interval; 2],
}

impl<'s> ClosureEquations<'s> {
    /// The equations over a region, which has an interval for every coordinate of the mechanism.
    pub(super) fn new(square: &'s Square, system: &'s mut dyn Enclosures, region: &[Interval]) -> Self {
        let reduced = Reduced::new(square);
        let m = reduced.remaining.len();
        let (known, unknown, rows) = (vec![None; m], (0..m).collect(), (0..m).collect());
        let (determined, eliminated) = (Vec::new(), Vec::new());
        let [still, q] = [const { ZERO }; 2].map(|zero| vec![zero; square.coordinates()]);
        let (of_rows, values) = (Vec::new(), Values::default());
        let mut equations =
            Self { square, system, reduced, determined, known, eliminated, unknown, rows, still, q, of_rows, values };
        equations.determine(region);
        equations.eliminate(region);
        equations
    }

    /// Finds the known coordinates.
    fn determine(&mut self, region: &[Interval]) {
        let m = self.reduced.remaining.len();
        self.q = everywhere(region);
        if self.evaluate(Subset::JACOBIAN, Unbounded::Infinite).is_err() {
            return;
        }
        let gradient = |&i: &usize| self.reduced.gradient(&self.values.phi_q, i);
        let mut jacobian: Vec<Vec<Interval>> = self.rows.iter().map(gradient).collect();
        let number = |entry: &Interval| entry.lower() == entry.upper();
        let mut is_known = vec![false; m];
        loop {
            let open = |row: &[Interval]| {
                let mut unsolved = (0..m).filter(|&k| row[k] != ZERO && !is_known[k]);
                match (unsolved.next(), unsolved.next()) {
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

    /// Eliminates angles that occur in two equations only, those of angles eliminated before included: the closures of
    /// these depend on all coordinates in their equations.
    fn eliminate(&mut self, region: &[Interval]) {
        let all = self.rows.clone();
        for k in self.unknown.clone() {
            let column = self.reduced.remaining[k];
            let rows_with_angle = all.iter().copied().filter(|&i| self.reduced.depends(i, k)).collect::<Vec<_>>();
            let &[a, b] = rows_with_angle.as_slice() else { continue };
            let are_left = self.rows.contains(&a) && self.rows.contains(&b);
            if !are_left || !self.square.is_pinned_angle(column) || self.unknown.len() == 1 {
                continue;
            }
            let Some(found) = self.eliminated_angle(k, [a, b], region) else { continue };
            self.eliminated.push((found, region[column].midpoint()));
            self.unknown.retain(|&unknown| unknown != k);
            self.rows.retain(|row| ![a, b].contains(row));
        }
    }

    /// The angle with these two equations, if their derivatives with respect to it are those of M (cos φ, sin φ) for
    /// all values of the other coordinates.
    fn eliminated_angle(&mut self, k: usize, rows: [usize; 2], region: &[Interval]) -> Option<EliminatedAngle> {
        let column = self.reduced.remaining[k];
        let everywhere = everywhere(region);
        let other_unknowns: Vec<Interval> =
            self.unknown.iter().map(|&k| everywhere[self.reduced.remaining[k]]).collect();
        let mut derivatives = |angle: Interval| {
            self.go_to(&other_unknowns);
            self.q[column] = angle;
            self.evaluate(Subset::JACOBIAN, Unbounded::Refused).ok()?;
            Some(rows.map(|i| self.reduced.derivative(&self.values.phi_q, i, k)))
        };
        let quarter = Interval::new(FRAC_PI_2, FRAC_PI_2.next_up());
        let (at_zero, at_quarter) = (derivatives(ZERO)?, derivatives(quarter)?);
        let size = at_zero.iter().chain(&at_quarter).fold(0.0, |most: f64, x| most.max(x.magnitude()));
        let is_narrow = |x: &Interval| x.radius() <= CONSTANT * size;
        let found = EliminatedAngle::new(k, rows, at_zero, at_quarter)?;
        // The local points of a pin do not depend on the angle of their body, unless their formulas contain it.
        let is_same = ANGLES.into_iter().all(|angle| {
            let angle = Interval::from(angle);
            let predicted = found.derivatives(angle);
            derivatives(angle).is_some_and(|all| {
                all.iter().zip(predicted).all(|(x, predicted)| is_narrow(x) && x.intersection(predicted).is_some())
            })
        });
        (is_same && at_zero.iter().chain(&at_quarter).all(is_narrow)).then_some(found)
    }

    /// Eliminated angles with the constant parts of their equations, from the current values of all equations.
    fn constant_parts(&self) -> impl Iterator<Item = (&EliminatedAngle, [Interval; 2])> {
        self.eliminated.iter().map(|(angle, _)| (angle, angle.constant_part(angle.rows.map(|i| self.values.phi[i]))))
    }

    /// Sets t and computes the known coordinates there.
    pub(super) fn at(&mut self, t: Interval) {
        self.system.set_time(t);
        self.follow();
    }

    /// Computes the known coordinates: their equations are linear in them and contain no other coordinates.
    fn follow(&mut self) {
        self.known.fill(None);
        self.go_to(&[]);
        // Known coordinates do not depend on rows without bounds.
        let has_values = self.evaluate(Subset::PHI, Unbounded::Infinite).is_ok();
        for (k, row, factors) in &self.determined {
            // Without values their bounds are infinite.
            let value = if has_values { self.values.phi[*row] } else { Interval::ENTIRE };
            self.known[*k] = Some(-self.with_known(value, factors, &self.known) / factors[*k]);
        }
    }

    /// `value` + Σ factor · number over the coordinates that have a number.
    fn with_known(&self, value: Interval, factors: &[Interval], numbers: &[Option<Interval>]) -> Interval {
        let terms = factors.iter().zip(numbers).filter_map(|(&factor, number)| Some(factor * (*number)?));
        terms.fold(value, |sum, term| sum + term)
    }

    /// The number of coordinates u.
    pub(super) fn count(&self) -> usize {
        self.unknown.len()
    }

    /// The indices of u in q.
    pub(super) fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.unknown.iter().map(|&k| self.reduced.remaining[k])
    }

    /// f and its derivatives over a box, including the one with respect to t if `with_time`.
    pub(super) fn closure(&mut self, u: &[Interval], with_time: bool) -> Result<EvaluatedEquations, Uncertified> {
        self.closure_of(u, with_time, false)?.ok_or(Uncertified::Malformed)
    }

    /// The same; none where an equation, those of known coordinates included, has no zero.
    pub(super) fn possible_closure(
        &mut self,
        u: &[Interval],
        with_time: bool,
    ) -> Result<Option<EvaluatedEquations>, Uncertified> {
        self.closure_of(u, with_time, true)
    }

    /// f and its derivatives over a box; `None` if `only_possible` and an equation has no zero.
    fn closure_of(
        &mut self,
        u: &[Interval],
        with_time: bool,
        only_possible: bool,
    ) -> Result<Option<EvaluatedEquations>, Uncertified> {
        let evaluated = self.over(u, Subset { phi_t: with_time, ..Subset::POSITION });
        // Where derivatives have no bound, as around points that coincide, the values may have one.
        if let (Err(error), true) = (&evaluated, only_possible) {
            let is_open = self.over(u, Subset::PHI).is_ok() && self.excludes_zero();
            return if is_open { Ok(None) } else { Err(error.clone()) };
        }
        evaluated?;
        if only_possible && self.excludes_zero() {
            return Ok(None);
        }
        let f = self.f();
        let Values { phi_q, phi_t, .. } = &self.values;
        let derivative = |i: usize, k: usize| self.reduced.derivative(phi_q, i, k);
        let rates = if with_time { self.rates() } else { Vec::new() };
        let by_t = |i: usize| self.with_known(phi_t[i], &self.reduced.gradient(phi_q, i), &rates);
        let part = |(angle, a): (&EliminatedAngle, [Interval; 2])| ConstantPart {
            slope: angle.slope(a),
            by_u: self.unknown.iter().map(|&k| angle.rows.map(|i| derivative(i, k))).collect(),
            by_t: if with_time { angle.rows.map(by_t) } else { [ZERO; 2] },
        };
        let constant_parts: Vec<ConstantPart> = self.constant_parts().map(part).collect();
        let mut f_u: Vec<Vec<Interval>> =
            self.rows.iter().map(|&i| self.unknown.iter().map(|&k| derivative(i, k)).collect()).collect();
        let mut f_t: Vec<Interval> = self.rows.iter().filter(|_| with_time).map(|&i| by_t(i)).collect();
        for ConstantPart { slope, by_u, by_t } in &constant_parts {
            f_u.push(by_u.iter().map(|&da| dot(*slope, da)).collect());
            f_t.extend(with_time.then(|| dot(*slope, *by_t)));
        }
        Ok(Some(EvaluatedEquations { f, f_u, f_t, constant_parts }))
    }

    /// True if an equation, those of known coordinates included, has no zero over the box that was evaluated last.
    fn excludes_zero(&self) -> bool {
        let known = self.determined.iter().map(|(_, row, _)| self.values.phi[*row]);
        known.chain(self.f()).any(Interval::excludes_zero)
    }

    /// The values of all equations over a box, those of eliminated angles included; none if one is undefined.
    pub(super) fn all_values(&mut self, u: &[Interval]) -> Option<Vec<Interval>> {
        self.over(u, Subset::PHI).ok().map(|()| self.values.phi.clone())
    }

    /// Whole turns of the coordinates u, in their units.
    pub(super) fn whole_turns(&self) -> Vec<Interval> {
        self.places().map(|k| self.square.turn(k)).collect()
    }

    /// f over a box.
    pub(super) fn values(&mut self, u: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        self.over(u, Subset::PHI)?;
        Ok(self.f())
    }

    /// f, from the current values of all equations.
    fn f(&self) -> Vec<Interval> {
        let mut f = Vec::with_capacity(self.rows.len() + self.eliminated.len());
        f.extend(self.rows.iter().map(|&i| self.values.phi[i]));
        f.extend(self.constant_parts().map(|(angle, a)| angle.closure(a)));
        f
    }

    /// The rates of known coordinates, from the current derivatives of the equations with respect to t.
    fn rates(&self) -> Vec<Option<Interval>> {
        let mut rates = vec![None; self.known.len()];
        for (k, row, factors) in &self.determined {
            rates[*k] = Some(-self.with_known(self.values.phi_t[*row], factors, &rates) / factors[*k]);
        }
        rates
    }

    /// The rates of the known coordinates over a box, among all coordinates of the mechanism.
    pub(super) fn known_rates(&mut self, u: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        self.over(u, Subset::TIME_DERIVATIVE)?;
        let mut of_all = vec![ZERO; self.q.len()];
        for (&column, rate) in self.reduced.remaining.iter().zip(self.rates()) {
            of_all[column] = rate.unwrap_or(ZERO);
        }
        Ok(of_all)
    }

    /// −(f_uu w w + 2 f_ut w + f_tt), along rates w of u and `rates` of the known coordinates: γ of the mechanism.
    /// `closure` is that of the box, with the derivatives with respect to t.
    pub(super) fn gamma(
        &mut self,
        closure: &EvaluatedEquations,
        (u, rates): (&[Interval], &[Interval]),
        w: &[Interval],
    ) -> Result<Vec<Interval>, Uncertified> {
        self.go_to(u);
        let mut q_dot = rates.to_vec();
        for (&k, &w) in self.unknown.iter().zip(w) {
            q_dot[self.reduced.remaining[k]] = w;
        }
        let evaluated = self.system.evaluate(Subset::GAMMA, &self.q, &q_dot).map_err(|_| Uncertified::Malformed)?;
        self.square.kept(evaluated.gamma, &mut self.of_rows)?;
        let mut gamma = Vec::with_capacity(self.of_rows.len());
        self.reduced.values(&self.of_rows, &mut gamma);
        let mut of_all: Vec<Interval> = self.rows.iter().map(|&i| gamma[i]).collect();
        for ((angle, _), part) in self.eliminated.iter().zip(&closure.constant_parts) {
            let ConstantPart { slope, by_u, by_t } = part;
            let along = |i: usize| by_u.iter().zip(w).fold(by_t[i], |sum, (by, &w)| sum + by[i] * w);
            let second = angle.rows.map(|i| -gamma[i]);
            of_all.push(-angle.second_derivative(*slope, [along(0), along(1)], second));
        }
        Ok(of_all)
    }

    /// True if the derivatives f_u are proven to have no jumps over a box.
    pub(super) fn is_smooth(&mut self, u: &[Interval]) -> bool {
        self.go_to(u);
        self.system.is_smooth(&self.q)
    }

    /// All coordinates over a box, the eliminated ones included.
    pub(super) fn complete(&mut self, u: &[Interval]) -> Option<Vec<Interval>> {
        self.go_to(u);
        let mut q = self.q.clone();
        if !self.eliminated.is_empty() {
            self.evaluate(Subset::PHI, Unbounded::Refused).ok()?;
            for ((angle, a), (_, near)) in self.constant_parts().zip(&self.eliminated) {
                q[self.reduced.remaining[angle.angle]] = angle.direction(a, *near);
            }
        }
        let evaluated = self.system.evaluate(Subset::PHI, &q, &self.still).ok()?;
        self.square.phi(evaluated.phi, &q, &mut self.of_rows, Unbounded::Refused).ok()?;
        self.reduced.complete(&self.of_rows, &mut q);
        Some(q)
    }

    /// Writes all coordinates over a box of u, 0 for eliminated ones.
    fn go_to(&mut self, u: &[Interval]) {
        self.q.fill(ZERO);
        for (&column, known) in self.reduced.remaining.iter().zip(&self.known) {
            self.q[column] = known.unwrap_or(ZERO);
        }
        for (&k, &x) in self.unknown.iter().zip(u) {
            self.q[self.reduced.remaining[k]] = x;
        }
    }

    /// Evaluates the equations over a box of u.
    fn over(&mut self, u: &[Interval], subset: Subset) -> Result<(), Uncertified> {
        self.go_to(u);
        self.evaluate(subset, Unbounded::Refused)
    }

    /// Evaluates the equations over the box of all coordinates; lists that are not in the subset remain unchanged.
    fn evaluate(&mut self, subset: Subset, unbounded: Unbounded) -> Result<(), Uncertified> {
        let Self { system, reduced, square, still, q, of_rows, values, .. } = self;
        let rows = system.evaluate(subset, q, still).map_err(|_| Uncertified::Malformed)?;
        if subset.phi {
            square.phi(rows.phi, q, of_rows, unbounded)?;
            reduced.values(of_rows, &mut values.phi);
        }
        if subset.phi_q {
            square.matrix(rows.phi_q, &mut values.phi_q, unbounded)?;
        }
        if subset.phi_t {
            square.kept(rows.phi_t, of_rows)?;
            reduced.values(of_rows, &mut values.phi_t);
        }
        Ok(())
    }
}

/// The equations of [`Reduced`] and their derivatives with respect to t, and the entries of Φ_q from which those with
/// respect to coordinates follow.
#[derive(Default)]
struct Values {
    phi: Vec<Interval>,
    phi_q: Vec<Interval>,
    phi_t: Vec<Interval>,
}

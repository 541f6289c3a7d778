//! Certificates: position by Krawczyk's operator, velocity and acceleration by enclosures of linear systems.

use super::contraction::Preconditioner;
use super::enclosures::Enclosures;
use super::left_out::violated;
use super::located::{NearSolution, SolutionBox};
use super::sizes::write_sizes;
use crate::certificate::{Certificate, SINGULAR_CONDITION, Uncertified};
use crate::mechanism::LengthError;
use crate::model::{JointKind, Level, Model};
use crate::scalar::Interval;
use crate::signal::Signal;
use crate::workspace::Subset;
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Sizes of the boxes that are tried, relative to a radian and to the size of the mechanism, largest first: a larger
/// box is a stronger statement, and a smaller one may succeed if another solution is close.
const BOXES: [f64; 4] = [1e-6, 1e-8, 1e-10, 1e-12];
/// A state with an error above this, relative to a radian or to the size of the mechanism, is not a solution.
const WRONG: f64 = 1e-6;
const ONE: Interval = Interval::new(1.0, 1.0);

/// What becomes of a number without an enclosure.
#[derive(Clone, Copy)]
pub(super) enum Unbounded {
    /// It is an error.
    Refused,
    /// Its bounds are infinite.
    Infinite,
}

/// A square system: as many rows as coordinates.
pub(crate) struct Square {
    model: &'static Model,
    left_out: Vec<&'static str>,
    left_out_rows: Vec<usize>,
    /// Prescribed coordinates, whose rows come last.
    given: Vec<(usize, Signal)>,
    /// (row, column) of the entries of Φ_q in this system.
    entries: Cow<'static, [(usize, usize)]>,
    /// Their indices in the pattern, unless all are the same; none for the entry 1 of a prescribed coordinate.
    sources: Option<Vec<Option<usize>>>,
}

impl Square {
    /// All rows but those that are left out, and prescribed coordinates.
    ///
    /// # Errors
    /// If there are not as many rows as coordinates, or if some rows are of velocity level.
    pub(crate) fn new(
        model: &'static Model,
        left_out: Vec<usize>,
        given: &[(usize, Signal)],
    ) -> Result<Self, Uncertified> {
        if model.rows.iter().any(|row| row.level == Level::Velocity) {
            return Err(Uncertified::VelocityLevel);
        }
        let rows = (0..model.rows.len()).filter(|row| !left_out.contains(row)).count();
        match model.coordinates.len().checked_sub(rows + given.len()) {
            Some(0) => {}
            Some(degrees_of_freedom) => return Err(Uncertified::Open { degrees_of_freedom }),
            // Too many rows depend on one another.
            None => return Err(Uncertified::Singular { nearness: 0.0 }),
        }
        let (mut entries, mut sources) = (Cow::Borrowed(model.constraint_pattern.entries), None);
        if !(left_out.is_empty() && given.is_empty()) {
            let index = |row: usize| {
                (!left_out.contains(&row)).then(|| row - left_out.iter().filter(|&&other| other < row).count())
            };
            let pattern = entries.iter().enumerate();
            let remaining = pattern.filter_map(|(k, &(row, column))| Some(((index(row)?, column), Some(k))));
            let given_rows = given.iter().enumerate().map(|(k, &(column, _))| ((rows + k, column), None));
            let (remaining, indices): (Vec<_>, Vec<_>) = remaining.chain(given_rows).unzip();
            (entries, sources) = (Cow::Owned(remaining), Some(indices));
        }
        let names = left_out.iter().filter_map(|&row| model.rows.get(row)).map(|row| row.name).collect();
        Ok(Self { model, left_out: names, left_out_rows: left_out, given: given.to_vec(), entries, sources })
    }

    /// The number of coordinates, which is that of rows.
    pub(super) const fn coordinates(&self) -> usize {
        self.model.coordinates.len()
    }

    /// A whole turn in the unit of a coordinate. That of degrees holds the rounding error of the factor π/180, too.
    pub(super) fn turn(&self, column: usize) -> Interval {
        match self.model.turn(column) {
            TAU => Interval::new(TAU, TAU.next_up()),
            turn => Interval::around(turn, 4.0 * f64::EPSILON * turn),
        }
    }

    /// The names of the redundant rows that are left out.
    pub(crate) fn left_out(&self) -> &[&'static str] {
        &self.left_out
    }

    /// (row, column) of the entries of Φ_q.
    pub(super) fn entries(&self) -> &[(usize, usize)] {
        &self.entries
    }

    /// The entries of Φ_q that are literal constants.
    pub(super) fn constants(&self) -> impl Iterator<Item = Option<f64>> {
        let constants = self.model.constraint_pattern.constants;
        let value = move |k: usize| constants.iter().find(|(index, _)| *index == k).map(|(_, value)| *value);
        (0..self.entries.len()).map(move |entry| self.source(entry).map_or(Some(1.0), value))
    }

    /// True for the angle of a body that occurs in rows of pins (revolute joints) only.
    pub(super) fn is_pinned_angle(&self, column: usize) -> bool {
        let is_revolute = |entry: usize| {
            let row = self.model.rows.get(self.model.constraint_pattern.entries[self.source(entry)?].0)?;
            Some(self.model.joints.get(row.joint)?.kind == JointKind::Revolute)
        };
        let mut rows = self.entries.iter().enumerate().filter(|(_, (_, is_revolute))| *is_revolute == column);
        self.model.coordinates[column].kind.is_angle() && rows.all(|(entry, _)| is_revolute(entry) == Some(true))
    }

    /// Writes Φ, prescribed coordinates included.
    pub(super) fn phi(
        &self,
        values: &[Interval],
        q: &[Interval],
        phi: &mut Vec<Interval>,
        unbounded: Unbounded,
    ) -> Result<(), Uncertified> {
        self.rows(values.iter().copied(), |&(k, signal)| q[k] - Interval::from(signal.value), phi, unbounded)
    }

    /// Writes the entries of Φ_q, in the order of `entries`.
    pub(super) fn matrix(
        &self,
        phi_q: &[Interval],
        matrix: &mut Vec<Interval>,
        unbounded: Unbounded,
    ) -> Result<(), Uncertified> {
        matrix.clear();
        match &self.sources {
            None => matrix.extend_from_slice(phi_q),
            Some(sources) => matrix.extend(sources.iter().map(|source| source.map_or(ONE, |k| phi_q[k]))),
        }
        for (entry, value) in matrix.iter_mut().enumerate().filter(|(_, value)| !value.is_bounded()) {
            match unbounded {
                Unbounded::Refused => {
                    let row = self.source(entry).map_or(0, |k| self.model.constraint_pattern.entries[k].0);
                    return Err(self.unbounded(row));
                }
                Unbounded::Infinite => *value = Interval::ENTIRE,
            }
        }
        Ok(())
    }

    /// Writes the numbers of the rows that are not left out, and 0 for prescribed coordinates.
    pub(super) fn kept(&self, values: &[Interval], rows: &mut Vec<Interval>) -> Result<(), Uncertified> {
        self.rows(values.iter().copied(), |_| Interval::ZERO, rows, Unbounded::Refused)
    }

    /// Writes the numbers of the rows that are not left out, and those of prescribed coordinates.
    fn rows(
        &self,
        values: impl Iterator<Item = Interval>,
        given: impl Fn(&(usize, Signal)) -> Interval,
        rows: &mut Vec<Interval>,
        unbounded: Unbounded,
    ) -> Result<(), Uncertified> {
        rows.clear();
        for (row, value) in values.enumerate().filter(|&(row, _)| !self.is_left_out(row)) {
            rows.push(match unbounded {
                _ if value.is_bounded() => value,
                Unbounded::Refused => return Err(self.unbounded(row)),
                Unbounded::Infinite => Interval::ENTIRE,
            });
        }
        rows.extend(self.given.iter().map(given));
        Ok(())
    }

    /// Replaces `b` by b − A x.
    fn subtract(&self, b: &mut [Interval], matrix: &[Interval], x: &[f64]) {
        for (&(row, column), &entry) in self.entries.iter().zip(matrix).filter(|((_, column), _)| x[*column] != 0.0) {
            b[row] = b[row] - entry * Interval::from(x[column]);
        }
    }

    fn is_left_out(&self, row: usize) -> bool {
        self.left_out_rows.contains(&row)
    }

    /// The index in the pattern of an entry; none for the entry 1 of a prescribed coordinate.
    fn source(&self, entry: usize) -> Option<usize> {
        self.sources.as_ref().map_or(Some(entry), |sources| sources[entry])
    }

    fn unbounded(&self, row: usize) -> Uncertified {
        Uncertified::Unbounded { row: self.model.rows.get(row).map_or("", |row| row.name) }
    }

    /// Whether all corrections of the list `what` are proven to be small.
    ///
    /// # Errors
    /// If one of them is proven to be large.
    fn judge(
        &self,
        what: &'static str,
        corrections: &[Interval],
        sizes: &[f64],
        most: f64,
    ) -> Result<bool, Uncertified> {
        // Both are false for NaN, too.
        let is_small = |(correction, size): (&Interval, &f64)| correction.magnitude() <= most * size;
        let is_large =
            |k: &usize| corrections[*k].lower() > most * sizes[*k] || corrections[*k].upper() < -most * sizes[*k];
        if corrections.iter().zip(sizes).all(is_small) {
            return Ok(true);
        }
        let relative = |k: &usize| corrections[*k].midpoint().abs() / sizes[*k];
        let large = (0..sizes.len()).filter(is_large).max_by(|a, b| relative(a).total_cmp(&relative(b)));
        match large {
            Some(k) => Err(Uncertified::NotASolution {
                what,
                coordinate: self.model.coordinates[k].name,
                by: corrections[k].midpoint().abs(),
            }),
            None => Ok(false),
        }
    }
}

/// Certificates of one system, one after the other.
pub(crate) struct Prover<'s> {
    square: &'s Square,
    inverse: Preconditioner,
    /// Buffers, so that a proof allocates hardly more than what it returns.
    exchanges: Vec<usize>,
    sizes: Vec<f64>,
    still: Vec<Interval>,
    point: Vec<Interval>,
    rows: Vec<Interval>,
    newton: Vec<Interval>,
    matrix: Vec<Interval>,
    over_box: Vec<Interval>,
}

impl<'s> Prover<'s> {
    pub(crate) fn new(square: &'s Square) -> Self {
        let (n, entries) = (square.coordinates(), square.entries.len());
        let numbers = || vec![Interval::ZERO; n];
        let [matrix, over_box] = [const { Vec::<Interval>::new() }; 2].map(|mut list| {
            list.reserve(entries);
            list
        });
        Self {
            square,
            inverse: Preconditioner::with_room(n),
            exchanges: Vec::with_capacity(n),
            sizes: Vec::with_capacity(n),
            still: numbers(),
            point: numbers(),
            rows: numbers(),
            newton: numbers(),
            matrix,
            over_box,
        }
    }

    /// The box with one solution around q, n finite numbers.
    fn locate(&mut self, system: &mut dyn Enclosures, q: &[f64]) -> Result<SolutionBox, Uncertified> {
        let Self { square, inverse, exchanges, sizes, still, point, rows, newton, matrix, over_box } = self;
        if !is_list(square.coordinates(), q) {
            return Err(Uncertified::Malformed);
        }
        point.clear();
        point.extend(q.iter().map(|&x| Interval::from(x)));
        let at_point = system.evaluate(Subset::POSITION, point, still).map_err(malformed)?;
        square.phi(at_point.phi, point, rows, Unbounded::Refused)?;
        square.matrix(at_point.phi_q, matrix, Unbounded::Refused)?;
        write_sizes(square.model, (&square.entries, matrix), q, sizes);
        if !inverse.set(&square.entries, matrix.iter().map(|entry| entry.midpoint()), exchanges) {
            return Err(Uncertified::Singular { nearness: 0.0 });
        }
        inverse.times_to(rows, newton);
        let judged = square.judge("q", newton, sizes, WRONG);
        if judged != Ok(true) {
            // Near a singular configuration a large correction does not show that the state is wrong.
            let nearness = inverse.inverse_condition(&square.entries, matrix, sizes);
            return Err(match judged {
                Err(wrong) if nearness >= SINGULAR_CONDITION => wrong,
                _ => Uncertified::Singular { nearness },
            });
        }
        let mut over = |q: &[Interval], matrix: &mut Vec<Interval>| {
            let evaluated = system.evaluate(Subset::JACOBIAN, q, still).map_err(malformed)?;
            square.matrix(evaluated.phi_q, matrix, Unbounded::Refused)
        };
        let trial = NearSolution { boxes: &BOXES, entries: &square.entries, centre: q, sizes, newton };
        let located = trial.locate(inverse, &mut over, over_box)?;
        let located = located.ok_or_else(|| Uncertified::Singular {
            nearness: inverse.inverse_condition(&square.entries, matrix, sizes),
        })?;
        violated(square.model, &square.left_out_rows, system, &located.q).map_or(Ok(located), Err)
    }

    /// The certificate of q, n finite numbers, without rates.
    pub(crate) fn position(&mut self, system: &mut dyn Enclosures, q: &[f64]) -> Result<Certificate, Uncertified> {
        let located = self.locate(system, q)?;
        let (unique, left_out) = (located.unique(q), self.square.left_out.clone());
        Ok(Certificate { q: located.q, q_dot: Vec::new(), q_ddot: Vec::new(), unique, left_out })
    }

    /// The certificate of q, q̇ and q̈, n finite numbers each.
    pub(crate) fn certify(
        &mut self,
        system: &mut dyn Enclosures,
        [q, q_dot, q_ddot]: [&[f64]; 3],
    ) -> Result<Certificate, Uncertified> {
        if ![q_dot, q_ddot].into_iter().all(|list| is_list(self.square.coordinates(), list)) {
            return Err(Uncertified::Malformed);
        }
        let located = self.locate(system, q)?;
        let Self { square, inverse, sizes, still, rows, matrix, .. } = self;
        // The linear equations A q̇ = −Φ_t and A q̈ = γ for all matrices over the enclosure.
        let over = system.evaluate(Subset::VELOCITY, &located.q, still).map_err(malformed)?;
        square.matrix(over.phi_q, matrix, Unbounded::Refused)?;
        let nu = over.phi_t.iter().map(|&phi_t| -phi_t);
        square.rows(nu, |(_, signal)| Interval::from(signal.rate), rows, Unbounded::Refused)?;
        square.subtract(rows, matrix, q_dot);
        let mut rates = located.solve(inverse, rows);
        let nearness = |inverse: &Preconditioner| inverse.inverse_condition(&square.entries, matrix, sizes);
        if !square.judge("q̇", &rates, sizes, WRONG * (1.0 + size_of(q_dot, sizes)))? {
            return Err(Uncertified::Singular { nearness: nearness(inverse) });
        }
        rates.iter_mut().zip(q_dot).for_each(|(d, &x)| *d = Interval::from(x) + *d);
        let over = system.evaluate(Subset::GAMMA, &located.q, &rates).map_err(malformed)?;
        square.rows(
            over.gamma.iter().copied(),
            |(_, signal)| Interval::from(signal.acceleration),
            rows,
            Unbounded::Refused,
        )?;
        square.subtract(rows, matrix, q_ddot);
        let mut accelerations = located.solve(inverse, rows);
        if !square.judge("q̈", &accelerations, sizes, WRONG * (1.0 + size_of(q_ddot, sizes)))? {
            return Err(Uncertified::Singular { nearness: nearness(inverse) });
        }
        accelerations.iter_mut().zip(q_ddot).for_each(|(d, &x)| *d = Interval::from(x) + *d);
        let unique = located.unique(q);
        let left_out = square.left_out.clone();
        Ok(Certificate { q: located.q, q_dot: rates, q_ddot: accelerations, unique, left_out })
    }
}

/// True for a list of n finite numbers.
fn is_list(n: usize, list: &[f64]) -> bool {
    list.len() == n && list.iter().all(|x| x.is_finite())
}

/// The error of an evaluation with lists of wrong lengths.
fn malformed(_: LengthError) -> Uncertified {
    Uncertified::Malformed
}

/// The largest number relative to the sizes.
fn size_of(list: &[f64], sizes: &[f64]) -> f64 {
    list.iter().zip(sizes).fold(0.0, |most, (x, size)| most.max(x.abs() / size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::PlannedFourBar;
    use crate::mechanism::Mechanism;

    /// A correction that may be small as well as large proves neither that a state is a solution nor that it is none.
    #[test]
    fn a_wide_correction_does_not_show_that_a_state_is_wrong() {
        let square = Square::new(PlannedFourBar::model(), Vec::new(), &[]).expect("as many rows as coordinates");
        let judged = |correction: Interval| {
            let mut corrections = [Interval::ZERO; 9];
            corrections[4] = correction;
            square.judge("q̇", &corrections, &[2.0; 9], 1e-3)
        };
        assert_eq!(Ok(true), judged(Interval::new(-1e-3, 2e-3)));
        assert_eq!(Ok(false), judged(Interval::new(-1.0, 1.0)));
        assert_eq!(Ok(false), judged(Interval::ENTIRE));
        for (bounds, by) in [([2.1e-3, 2.3e-3], 2.2e-3), ([-3.0, -1.0], 2.0)] {
            let Err(Uncertified::NotASolution { what: "q̇", by: found, .. }) =
                judged(Interval::new(bounds[0], bounds[1]))
            else {
                panic!("{bounds:?}")
            };
            assert!((found - by).abs() < 1e-12, "{found}");
        }
    }
}

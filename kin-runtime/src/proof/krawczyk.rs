//! Certificates: position by Krawczyk's operator, velocity and acceleration by enclosures of linear systems.

use super::contraction::Preconditioner;
use super::enclosures::Enclosures;
use super::located::Trial;
use crate::certificate::{Certificate, Uncertified};
use crate::model::{Component, CoordinateKind, JointKind, Level, Model};
use crate::scalar::Interval;
use crate::workspace::{Signal, Subset};

/// Sizes of the boxes that are tried, relative to a radian and to the size of the mechanism, largest first: a larger
/// box is a stronger statement, and a smaller one may succeed if another solution is close.
const BOXES: [f64; 4] = [1e-6, 1e-8, 1e-10, 1e-12];
/// A state with an error above this, relative to a radian or to the size of the mechanism, is not a solution.
const WRONG: f64 = 1e-6;
/// With an inverse condition number below this, a large correction is reported as a singular configuration.
const SINGULAR: f64 = 1e-6;
/// A square system: as many rows as coordinates.
pub(crate) struct Square {
    model: &'static Model,
    /// The index of every row of the mechanism in this system; none for rows that are left out.
    place: Vec<Option<usize>>,
    left_out: Vec<&'static str>,
    /// Prescribed coordinates, whose rows come last.
    given: Vec<(usize, Signal)>,
    /// (row, column) of the entries of Φ_q in this system, and their indices in the pattern; none for the entry 1 of a
    /// prescribed coordinate.
    entries: Vec<(usize, usize)>,
    sources: Vec<Option<usize>>,
}

impl Square {
    /// All rows but those that are left out, and prescribed coordinates.
    ///
    /// # Errors
    /// If there are not as many rows as coordinates, or if some rows are of velocity level.
    pub(crate) fn new(
        model: &'static Model,
        left_out: &[usize],
        given: &[(usize, Signal)],
    ) -> Result<Self, Uncertified> {
        if model.rows.iter().any(|row| row.level == Level::Velocity) {
            return Err(Uncertified::VelocityLevel);
        }
        let mut rows = 0;
        let place = (0..model.rows.len()).map(|row| {
            let kept = !left_out.contains(&row);
            kept.then(|| {
                rows += 1;
                rows - 1
            })
        });
        let place: Vec<Option<usize>> = place.collect();
        let n = model.coordinates.len();
        match n.checked_sub(rows + given.len()) {
            Some(0) => {}
            Some(degrees_of_freedom) => return Err(Uncertified::Open { degrees_of_freedom }),
            // Too many rows depend on one another.
            None => return Err(Uncertified::Singular { nearness: 0.0 }),
        }
        let own = model.constraint_pattern.entries.iter().enumerate();
        let kept = own.filter_map(|(k, &(row, column))| Some(((place[row]?, column), Some(k))));
        let given_rows = given.iter().enumerate().map(|(k, &(column, _))| ((rows + k, column), None));
        let (entries, sources) = kept.chain(given_rows).unzip();
        let left_out = left_out.iter().filter_map(|&row| model.rows.get(row)).map(|row| row.name).collect();
        Ok(Self { model, place, left_out, given: given.to_vec(), entries, sources })
    }

    /// The number of coordinates, which is that of rows.
    pub(super) const fn coordinates(&self) -> usize {
        self.model.coordinates.len()
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
        let value = |k: usize| constants.iter().find(|(place, _)| *place == k).map(|(_, value)| *value);
        self.sources.iter().map(move |source| source.map_or(Some(1.0), value))
    }

    /// True for the angle of a body in whose rows there are only pins.
    pub(super) fn is_pinned_angle(&self, column: usize) -> bool {
        let of = |source: &Option<usize>| {
            let row = self.model.rows.get(self.model.constraint_pattern.entries[(*source)?].0)?;
            Some(self.model.joints.get(row.joint)?.kind == JointKind::Revolute)
        };
        let mut rows = self.entries.iter().zip(&self.sources).filter(|((_, of), _)| *of == column);
        let kind = self.model.coordinates[column].kind;
        matches!(kind, CoordinateKind::Pose { component: Component::Phi, .. })
            && rows.all(|(_, source)| of(source) == Some(true))
    }

    /// Φ, prescribed coordinates included.
    pub(super) fn phi(&self, values: &[Interval], q: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        self.rows(values, |&(k, signal)| q[k] - Interval::from(signal.value))
    }

    /// The entries of Φ_q, in the order of `entries`.
    pub(super) fn matrix(&self, phi_q: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        let value = |source: &Option<usize>| source.map_or(Interval::from(1.0), |k| phi_q[k]);
        let values: Vec<Interval> = self.sources.iter().map(value).collect();
        match self.sources.iter().zip(&values).find(|(_, value)| !value.is_bounded()) {
            None => Ok(values),
            Some((source, _)) => {
                let row = source.map_or(0, |k| self.model.constraint_pattern.entries[k].0);
                Err(Uncertified::Unbounded { row: self.model.rows.get(row).map_or("", |row| row.name) })
            }
        }
    }

    /// The numbers of the rows that are not left out, and 0 for prescribed coordinates.
    pub(super) fn kept(&self, values: &[Interval]) -> Result<Vec<Interval>, Uncertified> {
        self.rows(values, |_| Interval::from(0.0))
    }

    /// The numbers of the rows that are not left out, and those of prescribed coordinates.
    fn rows(
        &self,
        values: &[Interval],
        given: impl Fn(&(usize, Signal)) -> Interval,
    ) -> Result<Vec<Interval>, Uncertified> {
        let kept = || values.iter().zip(&self.place).enumerate().filter(|(_, (_, place))| place.is_some());
        if let Some((row, _)) = kept().find(|(_, (value, _))| !value.is_bounded()) {
            return Err(Uncertified::Unbounded { row: self.model.rows.get(row).map_or("", |row| row.name) });
        }
        Ok(kept().map(|(_, (value, _))| *value).chain(self.given.iter().map(given)).collect())
    }

    /// `b` − A x.
    fn residual(&self, mut b: Vec<Interval>, matrix: &[Interval], x: &[f64]) -> Vec<Interval> {
        for (&(row, column), &entry) in self.entries.iter().zip(matrix) {
            b[row] = b[row] - entry * Interval::from(x[column]);
        }
        b
    }

    /// The scale of every coordinate: a radian, or the size of the mechanism.
    fn sizes(&self, q: &[f64]) -> Vec<f64> {
        let is_length = |k: usize| {
            matches!(
                self.model.coordinates[k].kind,
                CoordinateKind::Pose { component: Component::X | Component::Y, .. }
            )
        };
        let length = (0..q.len()).filter(|&k| is_length(k)).fold(0.0, |most: f64, k| most.max(q[k].abs()));
        let size = |k: usize| if is_length(k) && length > 0.0 { length } else { 1.0 };
        (0..q.len()).map(size).collect()
    }

    /// An error that names the list `what` if one of its corrections is too large.
    fn judge(&self, what: &'static str, corrections: &[Interval], sizes: &[f64], most: f64) -> Result<(), Uncertified> {
        let relative = |k: usize| corrections[k].magnitude() / sizes[k];
        let worst = (0..sizes.len()).max_by(|&a, &b| relative(a).total_cmp(&relative(b)));
        match worst {
            Some(k) if relative(k) > most || relative(k).is_nan() => Err(Uncertified::NotASolution {
                what,
                coordinate: self.model.coordinates[k].name,
                by: corrections[k].midpoint().abs(),
            }),
            _ => Ok(()),
        }
    }
}

/// The certificate of q, q̇ and q̈, n finite numbers each.
pub(crate) fn certify(
    square: &Square,
    system: &mut dyn Enclosures,
    [q, q_dot, q_ddot]: [&[f64]; 3],
) -> Result<Certificate, Uncertified> {
    let n = square.model.coordinates.len();
    let malformed = |_| Uncertified::Malformed;
    if [q, q_dot, q_ddot].iter().any(|list| list.len() != n || list.iter().any(|x| !x.is_finite())) {
        return Err(Uncertified::Malformed);
    }
    let still = vec![Interval::from(0.0); n];
    let point: Vec<Interval> = q.iter().map(|&x| Interval::from(x)).collect();
    let at_point = system.evaluate(Subset::POSITION, &point, &still).map_err(malformed)?;
    let phi = square.phi(at_point.phi, &point)?;
    let matrix = square.matrix(at_point.phi_q)?;
    let sizes = square.sizes(q);
    let middle = matrix.iter().map(|entry| entry.midpoint());
    let Some(inverse) = Preconditioner::new(n, &square.entries, middle) else {
        return Err(Uncertified::Singular { nearness: 0.0 });
    };
    let nearness = || inverse.inverse_condition(&square.entries, &matrix, &sizes);
    let newton = inverse.times(&phi);
    // Near a singular configuration a large correction does not show that the state is wrong.
    square.judge("q", &newton, &sizes, WRONG).map_err(|wrong| match nearness() {
        nearness if nearness < SINGULAR => Uncertified::Singular { nearness },
        _ => wrong,
    })?;
    let mut over = |q: &[Interval]| {
        let evaluated = system.evaluate(Subset::JACOBIAN, q, &still).map_err(malformed)?;
        square.matrix(evaluated.phi_q)
    };
    let trial = Trial { boxes: &BOXES, entries: &square.entries, centre: q, sizes: &sizes, newton: &newton };
    let located = trial.locate(&inverse, &mut over)?.ok_or_else(|| Uncertified::Singular { nearness: nearness() })?;

    // The linear equations A q̇ = −Φ_t and A q̈ = γ for all matrices over the enclosure.
    let over = system.evaluate(Subset::VELOCITY, &located.q, &still).map_err(malformed)?;
    let matrix = square.matrix(over.phi_q)?;
    let nu: Vec<Interval> = over.phi_t.iter().map(|&phi_t| -phi_t).collect();
    let nu = square.rows(&nu, |(_, signal)| Interval::from(signal.rate))?;
    let rates = located.solve(&square.residual(nu, &matrix, q_dot));
    square.judge("q̇", &rates, &sizes, WRONG * (1.0 + size_of(q_dot, &sizes)))?;
    let rates: Vec<Interval> = q_dot.iter().zip(rates).map(|(&x, d)| Interval::from(x) + d).collect();
    let over = system.evaluate(Subset::GAMMA, &located.q, &rates).map_err(malformed)?;
    let gamma = square.rows(over.gamma, |(_, signal)| Interval::from(signal.acceleration))?;
    let accelerations = located.solve(&square.residual(gamma, &matrix, q_ddot));
    square.judge("q̈", &accelerations, &sizes, WRONG * (1.0 + size_of(q_ddot, &sizes)))?;
    let accelerations = q_ddot.iter().zip(accelerations).map(|(&x, d)| Interval::from(x) + d).collect();
    let unique = located.unique(q);
    Ok(Certificate { q: located.q, q_dot: rates, q_ddot: accelerations, unique, left_out: square.left_out.clone() })
}

/// The largest number relative to the sizes.
fn size_of(list: &[f64], sizes: &[f64]) -> f64 {
    list.iter().zip(sizes).fold(0.0, |most, (x, size)| most.max(x.abs() / size))
}

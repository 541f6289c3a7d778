//! Some rows of a mechanism as functions of some coordinates, to be closed by Newton's iteration.

use crate::equations::Equations;
use crate::equations::factorisation::Purpose;
use crate::linear::{Factorization, Ordered};
use crate::nonlinear::newton::{self, Iteration, NewtonSettings, Residual};
use crate::workspace::Subset;
use nalgebra::{DMatrix, DVector};

/// Rows to close and coordinates to move; the others are held.
struct SubsystemResidual<'e, 'a> {
    equations: &'e mut Equations<'a>,
    rows: &'e [usize],
    columns: &'e [usize],
    sizes: Vec<f64>,
    q: Vec<f64>,
    part: EntryPositions,
}

/// How the entries of these rows and columns are found in Φ_q.
enum EntryPositions {
    /// The subsystem is the whole system.
    All,
    /// The indices of the entries in Φ_q, and the pattern of the subsystem.
    Some(Vec<usize>, Ordered),
}

impl EntryPositions {
    fn new(equations: &Equations<'_>, rows: &[usize], columns: &[usize]) -> Self {
        let (s, n) = (equations.rows(), equations.coordinates());
        if rows.iter().copied().eq(0..s) && columns.iter().copied().eq(0..n) {
            return Self::All;
        }
        let among = |length: usize, wanted: &[usize]| {
            let mut place = vec![None; length];
            wanted.iter().enumerate().for_each(|(k, &index)| place[index] = Some(k));
            place
        };
        let (of_row, of_column) = (among(s, rows), among(n, columns));
        let entries = equations.ordered.entries().iter().enumerate();
        let (places, entries_of_subsystem) =
            entries.filter_map(|(k, &(i, j))| Some((k, (of_row[i]?, of_column[j]?)))).unzip::<_, _, Vec<_>, Vec<_>>();
        Self::Some(places, Ordered::new(rows.len(), entries_of_subsystem))
    }
}

impl Residual for SubsystemResidual<'_, '_> {
    fn evaluate(&mut self, part: &[f64]) -> bool {
        self.columns.iter().zip(part).for_each(|(&k, &x)| self.q[k] = x);
        self.equations.evaluate(Subset::POSITION, &self.q, None).is_ok()
    }

    fn residual(&self) -> DVector<f64> {
        let equations = &*self.equations;
        DVector::from_iterator(
            self.rows.len(),
            self.rows.iter().map(|&row| equations.phi[row] * equations.scale.rows[row]),
        )
    }

    fn jacobian(&self) -> DMatrix<f64> {
        let equations = &*self.equations;
        let mut matrix = DMatrix::zeros(self.rows.len(), self.columns.len());
        let mut set = |place: usize, i: usize, j: usize| {
            matrix[(i, j)] = equations.phi_q[place] * equations.scale.rows[self.rows[i]];
        };
        match &self.part {
            EntryPositions::All => {
                (equations.ordered.entries().iter().enumerate()).for_each(|(place, &(i, j))| set(place, i, j))
            }
            EntryPositions::Some(places, ordered) => {
                places.iter().zip(ordered.entries()).for_each(|(&place, &(i, j))| set(place, i, j));
            }
        }
        matrix
    }

    fn times(&self, x: &DVector<f64>) -> DVector<f64> {
        let equations = &*self.equations;
        let mut product = match &self.part {
            EntryPositions::All => equations.times(x.as_slice()),
            EntryPositions::Some(places, ordered) => {
                let mut product = DVector::zeros(self.rows.len());
                for (&place, &(i, j)) in places.iter().zip(ordered.entries()) {
                    product[i] += equations.phi_q[place] * x[j];
                }
                product
            }
        };
        product.iter_mut().zip(self.rows).for_each(|(p, &row)| *p *= equations.scale.rows[row]);
        product
    }

    fn factorise(&mut self, tolerance: f64) -> Factorization {
        let sparse = match &mut self.part {
            EntryPositions::All => self.equations.factorise_sparse(Purpose::Solutions, None),
            EntryPositions::Some(places, ordered) if self.rows.len() == self.columns.len() => {
                self.equations.factorise_part(places, ordered, self.rows, &self.sizes)
            }
            EntryPositions::Some(..) => None,
        };
        sparse.unwrap_or_else(|| Factorization::quick(&self.jacobian(), &self.sizes, tolerance))
    }

    fn columns(&self) -> &[f64] {
        &self.sizes
    }
}

/// Closes `rows` by moving the coordinates `columns` of `q`; the outcome numbers its worst row as in the mechanism.
pub(crate) fn close(equations: &mut Equations<'_>, rows: &[usize], columns: &[usize], q: &mut [f64]) -> Iteration {
    let options = equations.options;
    let settings = NewtonSettings {
        max_iterations: options.max_iterations,
        tolerance: options.tolerance,
        trust_radius: options.trust_radius,
        rank_tolerance: 0.1 * options.rank_tolerance,
    };
    let sizes = columns.iter().map(|&k| equations.scale.columns[k]).collect();
    let mut moved: Vec<f64> = columns.iter().map(|&k| q[k]).collect();
    let part = EntryPositions::new(equations, rows, columns);
    let mut closure = SubsystemResidual { equations, rows, columns, sizes, q: q.to_vec(), part };
    let mut outcome = newton::solve(&mut closure, &mut moved, &settings);
    columns.iter().zip(moved).for_each(|(&k, x)| q[k] = x);
    outcome.worst = rows.get(outcome.worst).copied().unwrap_or(0);
    outcome
}

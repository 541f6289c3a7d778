//! Places on the solution curve: Newton's correction orthogonal to a direction, the tangent, and the sign that
//! distinguishes branches.

use crate::equations::Equations;
use crate::error::SolveError;
use crate::linear::{Factorization, independent_rows, null_space, positive_determinant, scale_columns};
use crate::workspace::Subset;
use nalgebra::{DMatrix, DVector};

/// Largest number of corrections.
const CORRECTIONS: usize = 8;
/// Largest ratio of the length of a correction to the length of the one before.
const CONTRACTION: f64 = 0.3;
/// A correction shorter than this is the last; Newton's iteration then is at the level of rounding.
const LAST_CORRECTION: f64 = 1e-9;
/// Corrections that do not contract any more are due to rounding up to this length.
const ROUNDING: f64 = 1e-7;
/// Smallest relative pivot at which the sign of the determinant is above rounding.
const SIGN_TRUST: f64 = 1e-13;

/// Branch values up to this have no sign at the start of a curve.
const NO_SIGN: f64 = 1e-6;

/// A place on the solution curve.
#[derive(Clone, Debug)]
pub(super) struct ArcNode {
    /// The length of the arc from the start.
    pub(super) s: f64,
    /// q, followed by t.
    pub(super) z: Vec<f64>,
    /// dz/ds.
    pub(super) tangent: Vec<f64>,
    /// The sign of the determinant with this tangent.
    sign: DeterminantSign,
    /// The branch value of every group of the plan; empty if the motion may pass limits of groups (with redundant rows).
    groups: Vec<f64>,
}

/// The sign of a determinant that vanishes only where branches cross.
#[derive(Clone, Debug)]
struct DeterminantSign {
    /// The rows that form it: as many as there are coordinates, if there are more rows than that; `None` for all rows.
    rows: Option<Vec<usize>>,
    positive: bool,
}

impl ArcNode {
    /// q.
    pub(super) fn q(&self) -> &[f64] {
        &self.z[..self.z.len() - 1]
    }

    /// t.
    pub(super) fn t(&self) -> f64 {
        self.z[self.z.len() - 1]
    }

    /// dt/ds.
    pub(super) fn t_rate(&self) -> f64 {
        self.tangent[self.z.len() - 1]
    }

    /// The same place, with this length of the arc.
    pub(super) fn at(self, s: f64) -> Self {
        Self { s, ..self }
    }

    /// The start of a curve, where groups at their limits have no sign yet.
    pub(super) fn start(mut self) -> Self {
        self.groups.iter_mut().filter(|w| w.abs() <= NO_SIGN).for_each(|w| *w = f64::NAN);
        self
    }

    /// The same place with the opposite direction of the curve.
    pub(super) fn reversed(mut self) -> Self {
        self.tangent.iter_mut().for_each(|x| *x = -*x);
        self.s = -self.s;
        // One row of the determinant has the other sign.
        self.sign.positive = !self.sign.positive;
        self
    }
}

/// The equations with t as one more unknown, and a border.
pub(super) struct Bordered {
    /// The size of every coordinate, and that of t: the time in which the driven coordinates change by about their
    /// size.
    pub(super) columns: Vec<f64>,
}

impl Bordered {
    /// The equations around a start, at its instant.
    pub(super) fn new(equations: &mut Equations<'_>, q: &[f64]) -> Result<Self, SolveError> {
        equations.evaluate(Subset::VELOCITY, q, None)?;
        let driven = equations.phi_t.iter().zip(&equations.scale.rows).map(|(phi_t, scale)| (phi_t * scale).abs());
        let fastest = driven.fold(0.0, f64::max);
        let time = if fastest > 0.0 { 1.0 / fastest } else { 1.0 };
        let columns = equations.scale.columns.iter().copied().chain([time]).collect();
        Ok(Self { columns })
    }

    /// The scalar product on the common scale.
    pub(super) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.columns).map(|((a, b), d)| (a / d) * (b / d)).sum()
    }

    /// The length of a displacement on the common scale.
    pub(super) fn norm(&self, a: &[f64]) -> f64 {
        self.dot(a, a).sqrt()
    }

    /// The independent directions in which (q, t) can go, of length 1.
    pub(super) fn directions(&self, equations: &mut Equations<'_>, z: &[f64]) -> Result<Vec<Vec<f64>>, SolveError> {
        let border = vec![0.0; z.len()];
        let matrix = scale_columns(self.matrix(equations, z, &border)?, &self.columns);
        let rows = matrix.nrows() - 1;
        let basis = null_space(&matrix.rows(0, rows).into_owned(), equations.options.rank_tolerance);
        Ok(basis.column_iter().map(|y| y.iter().zip(&self.columns).map(|(y, d)| y * d).collect()).collect())
    }

    /// True where the rows of [Φ_q Φ_t] lose rank within this tolerance.
    pub(super) fn is_singular(&self, equations: &mut Equations<'_>, z: &[f64], tolerance: f64) -> bool {
        let border = vec![0.0; z.len()];
        let matrix = self.matrix(equations, z, &border).map(|matrix| scale_columns(matrix, &self.columns));
        matrix.is_ok_and(|matrix| {
            let rows = matrix.nrows() - 1;
            null_space(&matrix.rows(0, rows).into_owned(), tolerance).ncols() > 1
        })
    }

    /// The place on the curve to which corrections orthogonal to `direction` lead from a prediction, no farther away
    /// than `allowed`; its tangent points in that direction. `None` where there is no such place.
    pub(super) fn node(
        &self,
        equations: &mut Equations<'_>,
        predicted: &[f64],
        direction: &[f64],
        allowed: f64,
    ) -> Option<ArcNode> {
        let mut z = predicted.to_vec();
        self.correct(equations, &mut z, direction, allowed)?;
        let mut matrix = self.matrix(equations, &z, direction).ok()?;
        let (last, open) = (matrix.nrows() - 1, equations.options.tolerance);
        let gap = equations.phi.iter().zip(&equations.scale.rows).map(|(phi, scale)| (phi * scale).abs());
        // False for NaN, too.
        let rounding = 64.0 * f64::EPSILON * equations.scale.size(&z[..z.len() - 1]);
        let is_closed = gap.fold(0.0, f64::max) <= open.max(rounding);
        if !is_closed {
            return None;
        }
        let factor = Factorization::quick(&matrix, &self.columns, 0.1 * equations.options.rank_tolerance);
        let mut along = DVector::zeros(matrix.nrows());
        along[last] = 1.0;
        let tangent = factor.solve(&along);
        let length = self.norm(tangent.as_slice());
        if factor.rank < z.len() || !length.is_finite() || length == 0.0 {
            return None;
        }
        let tangent: Vec<f64> = tangent.iter().map(|x| x / length).collect();
        self.write_border(&mut matrix, &tangent);
        let scaled = scale_columns(matrix, &self.columns);
        let rows = (last >= z.len()).then(|| independent_rows(&scaled.rows(0, last).into_owned(), z.len() - 1));
        let positive = sign(&scaled, rows.as_deref())?;
        let mut groups = Vec::new();
        if !equations.model.plan.has_redundant_rows() {
            equations.write_branch_values(&z[..z.len() - 1], &mut groups);
        }
        Some(ArcNode { s: 0.0, z, tangent, sign: DeterminantSign { rows, positive }, groups })
    }

    /// True where no other branch crosses between two neighbouring places: the determinant has the same sign, and no
    /// groups have changed theirs but the one that turns back at a dead centre. Where two groups cross their limits at
    /// the same place, the determinant changes its sign twice.
    pub(super) fn on_one_branch(&self, equations: &mut Equations<'_>, from: &ArcNode, to: &ArcNode) -> bool {
        let has_changed = |(from, to): &(&f64, &f64)| !from.is_nan() && (**from > 0.0) != (**to > 0.0);
        let changes = from.groups.iter().zip(&to.groups).filter(has_changed).count();
        let turns_back = (from.t_rate() > 0.0) != (to.t_rate() > 0.0);
        if changes > usize::from(turns_back) {
            return false;
        }
        let same = match &from.sign.rows {
            None => Some(to.sign.positive),
            Some(rows) => {
                let matrix = self.matrix(equations, &to.z, &to.tangent).ok();
                matrix.and_then(|matrix| sign(&scale_columns(matrix, &self.columns), Some(rows)))
            }
        };
        same == Some(from.sign.positive)
    }

    /// Newton's iteration with corrections orthogonal to a direction.
    fn correct(&self, equations: &mut Equations<'_>, z: &mut [f64], direction: &[f64], allowed: f64) -> Option<()> {
        let predicted = z.to_vec();
        let mut before = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let matrix = self.matrix(equations, z, direction).ok()?;
            let factor = Factorization::quick(&matrix, &self.columns, 0.1 * equations.options.rank_tolerance);
            let residuals = equations.phi.iter().zip(&equations.scale.rows).map(|(phi, scale)| phi * scale);
            let right = DVector::from_iterator(matrix.nrows(), residuals.chain([0.0]));
            let step = factor.solve(&right);
            z.iter_mut().zip(step.iter()).for_each(|(z, step)| *z -= step);
            let length = self.norm(step.as_slice());
            let travel: Vec<f64> = z.iter().zip(&predicted).map(|(a, b)| a - b).collect();
            let is_near = self.norm(&travel) <= allowed;
            if !is_near {
                return None;
            }
            if length <= LAST_CORRECTION {
                return Some(());
            }
            if length > CONTRACTION * before {
                return (length <= ROUNDING).then_some(());
            }
            before = length;
        }
        None
    }

    /// [Φ_q Φ_t] with rows on the common scale, and the direction as the border below it.
    fn matrix(&self, equations: &mut Equations<'_>, z: &[f64], direction: &[f64]) -> Result<DMatrix<f64>, SolveError> {
        let n = z.len() - 1;
        equations.move_to(z[n])?;
        equations.evaluate(Subset { phi: true, ..Subset::VELOCITY }, &z[..n], None)?;
        let rows = equations.rows();
        let mut matrix = DMatrix::zeros(rows + 1, n + 1);
        for ((row, column), value) in equations.entries() {
            matrix[(row, column)] += value * equations.scale.rows[row];
        }
        for row in 0..rows {
            matrix[(row, n)] = equations.phi_t[row] * equations.scale.rows[row];
        }
        self.write_border(&mut matrix, direction);
        Ok(matrix)
    }

    /// The last row: its product with a displacement is the scalar product with the direction.
    fn write_border(&self, matrix: &mut DMatrix<f64>, direction: &[f64]) {
        let last = matrix.nrows() - 1;
        for (k, (x, d)) in direction.iter().zip(&self.columns).enumerate() {
            matrix[(last, k)] = x / d / d;
        }
    }
}

/// Whether the determinant of these rows and the border is positive; `None` where it vanishes.
fn sign(matrix: &DMatrix<f64>, rows: Option<&[usize]>) -> Option<bool> {
    let last = matrix.nrows() - 1;
    let mut square = match rows {
        None => matrix.clone(),
        Some(rows) => matrix.select_rows(&rows.iter().copied().chain([last]).collect::<Vec<_>>()),
    };
    if !square.is_square() {
        return None;
    }
    positive_determinant(&mut square, SIGN_TRUST)
}

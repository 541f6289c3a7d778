//! Proofs of folds: places at which two closures come together and end.
//!
//! At a singular place of f(u, t) = 0, m equations for m coordinates u, the matrix f_u has a null vector v ≠ 0, scaled to
//! have one entry v_p = 1. So u, t and the other entries of v solve
//!
//! ```text
//! f(u, t) = 0        f_u(u, t) v = 0
//! ```
//!
//! 2m equations for as many unknowns, whose matrix is regular exactly at simple folds (G. Moore, A. Spence, The calculation
//! of turning points of nonlinear equations, SIAM J. Numer. Anal. 17 (1980)): on one side of t two closures meet there, on
//! the other side there are none of them. So Krawczyk's test proves a fold.
//!
//! The second derivatives in this matrix follow from γ(w) = −(f_uu w w + 2 f_ut w + f_tt), which is generated:
//!
//! ```text
//! f_ut w = −¼ (γ(w) − γ(−w))        f_uu v w = −¼ (γ(v + w) − γ(v − w)) − f_ut w
//! ```
//!
//! In both, v and w are multiplied by s, about the rate of the driven coordinates, so that f_uu s² and f_ut s are of the
//! same order whatever the unit of time is.

use super::closure_equations::ClosureEquations;
use super::contraction::Preconditioner;
use super::located::NearSolution;
use crate::certificate::Uncertified;
use crate::scalar::Interval;
use nalgebra::{DMatrix, DVector};

/// Sizes of the boxes that are tried: a larger box leaves less to search, and a smaller one has narrower bounds.
const COARSE_BOXES: [f64; 6] = [3e-2, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
const FINE_BOXES: [f64; 4] = [1e-12, 1e-10, 1e-8, 1e-6];
/// Largest number of steps of Newton's method, and the relative correction after which it has converged.
const STEPS: usize = 12;
const CONVERGED: f64 = 1e-12;

const ZERO: Interval = Interval::new(0.0, 0.0);
const ONE: Interval = Interval::new(1.0, 1.0);
const QUARTER: Interval = Interval::new(0.25, 0.25);

/// A proven fold.
pub(super) struct Proven {
    /// The entry of the null vector that is 1.
    pub(super) unit_entry: usize,
    /// u and t, enclosed.
    pub(super) place: Vec<Interval>,
    /// The box of u, t and the null vector's other entries in which there is no other singular place.
    pub(super) unique: Vec<Interval>,
}

/// Values F of the 2m equations and the entries of their matrix, row by row.
type Bordered = (Vec<Interval>, Vec<Interval>);

/// About the largest rate, rounded to a power of two; 1 if nothing is driven.
fn rate_of(rates: &[Interval]) -> f64 {
    let largest = rates.iter().fold(0.0, |most: f64, rate| most.max(rate.magnitude()));
    // Far from overflow, so that its inverse and its square are finite.
    if largest > 0.0 { largest.clamp(1e-60, 1e60).log2().round().exp2() } else { 1.0 }
}

/// F and its matrix over a box of u, t and v without its entry `unit_entry`.
fn bordered(equations: &mut ClosureEquations<'_>, y: &[Interval], unit_entry: usize) -> Result<Bordered, Uncertified> {
    let m = equations.count();
    let (u, t) = (&y[..m], y[m]);
    let mut v = y[m + 1..].to_vec();
    v.insert(unit_entry, ONE);
    equations.at(t);
    let closure = equations.closure(u, true)?;
    let rates = equations.known_rates(u)?;
    let speed = rate_of(&rates);
    let inverse = ONE / Interval::from(speed);
    // −¼ (γ(s w) − γ(s w′))/s.
    let mut mixed = |w: &[Interval], other: &[Interval]| -> Result<Vec<Interval>, Uncertified> {
        let mut gamma = |w: &[Interval]| {
            let scaled: Vec<Interval> = w.iter().map(|&w| Interval::from(speed) * w).collect();
            equations.gamma(&closure, (u, &rates), &scaled)
        };
        let (a, b) = (gamma(w)?, gamma(other)?);
        Ok(a.into_iter().zip(b).map(|(a, b)| inverse * (QUARTER * (b - a))).collect())
    };
    let negative = |w: &[Interval]| w.iter().map(|&w| -w).collect::<Vec<_>>();
    let along_t = mixed(&v, &negative(&v))?;
    let mut along_u = Vec::new();
    for k in 0..m {
        let moved = |by: Interval| {
            let mut w = v.clone();
            w[k] = w[k] + by;
            w
        };
        let mut alone = vec![ZERO; m];
        alone[k] = ONE;
        let u_and_time = mixed(&moved(ONE), &moved(-ONE))?;
        let of_time = mixed(&alone, &negative(&alone))?;
        let only_u = u_and_time.into_iter().zip(of_time).map(|(u_and_time, of_time)| inverse * (u_and_time - of_time));
        along_u.push(only_u.collect::<Vec<_>>());
    }
    let product = |row: &Vec<Interval>| row.iter().zip(&v).fold(ZERO, |sum, (&a, &v)| sum + a * v);
    let values = closure.f.iter().copied().chain(closure.f_u.iter().map(product)).collect();
    let mut matrix = Vec::with_capacity(4 * m * m);
    for (row, &by_t) in closure.f_u.iter().zip(&closure.f_t) {
        matrix.extend(row.iter().copied().chain([by_t]).chain((1..m).map(|_| ZERO)));
    }
    for (i, row) in closure.f_u.iter().enumerate() {
        matrix.extend(along_u.iter().map(|column| column[i]).chain([along_t[i]]));
        matrix.extend(row.iter().enumerate().filter(|&(k, _)| k != unit_entry).map(|(_, &a)| a));
    }
    Ok((values, matrix))
}

/// The fold near a place, given by u and t, and its proof; `None` if Newton's method goes further than `reach` from there, and
/// if there is no proof. `sizes` are those of u and t, to which `reach` is relative.
pub(super) fn prove(equations: &mut ClosureEquations<'_>, near: &[f64], reach: f64, sizes: &[f64]) -> Option<Proven> {
    let m = equations.count();
    let points = |list: &[f64]| list.iter().map(|&x| Interval::from(x)).collect::<Vec<_>>();
    equations.at(Interval::from(near[m]));
    let f_u = equations.closure(&points(&near[..m]), false).ok()?.f_u;
    let v = null_vector(&f_u)?;
    let unit_entry = (0..m).max_by(|&a, &b| v[a].abs().total_cmp(&v[b].abs()))?;
    let mut y: Vec<f64> = near.to_vec();
    y.extend((0..m).filter(|&k| k != unit_entry).map(|k| v[k] / v[unit_entry]));
    let n = 2 * m;
    let entries: Vec<(usize, usize)> = (0..n).flat_map(|i| (0..n).map(move |k| (i, k))).collect();
    let sizes: Vec<f64> = sizes.iter().copied().chain((1..m).map(|_| 1.0)).collect();
    for step in 0..=STEPS {
        let (values, matrix) = bordered(equations, &points(&y), unit_entry).ok()?;
        let mut inverse = Preconditioner::new(n, &entries, matrix.iter().map(|a| a.midpoint()))?;
        let newton = inverse.times(&values);
        let moved = newton.iter().zip(&sizes).fold(0.0, |most: f64, (d, size)| most.max(d.magnitude() / size));
        if moved > CONVERGED && step < STEPS {
            y.iter_mut().zip(&newton).for_each(|(y, d)| *y -= d.midpoint());
            let away = |((y, near), size): ((&f64, &f64), &f64)| (y - near).abs() / size;
            if !y.iter().zip(near).zip(&sizes).map(away).all(|away| away <= reach) {
                return None;
            }
            continue;
        }
        let over = &mut |all: &[Interval], matrix: &mut Vec<Interval>| {
            *matrix = bordered(equations, all, unit_entry)?.1;
            // The test holds for equations whose matrix is that of their derivatives.
            if equations.is_smooth(&all[..m]) { Ok(()) } else { Err(Uncertified::Singular { nearness: 0.0 }) }
        };
        let mut locate = |boxes: &[f64]| {
            let trial = NearSolution { boxes, entries: &entries, centre: &y, sizes: &sizes, newton: &newton };
            trial.locate(&mut inverse, over, &mut Vec::new()).ok()?
        };
        let unique = locate(&COARSE_BOXES)?.unique(&y);
        let place = locate(&FINE_BOXES)?.q[..=m].to_vec();
        return Some(Proven { unit_entry, place, unique });
    }
    None
}

impl Proven {
    /// True if any singular place in a box of u and t can only be this one.
    pub(super) fn covers(&self, equations: &mut ClosureEquations<'_>, all: &[Interval]) -> bool {
        let m = equations.count();
        let within = |inner: &[Interval], outer: &[Interval]| {
            inner.iter().zip(outer).all(|(x, y)| y.lower() <= x.lower() && x.upper() <= y.upper())
        };
        if !within(all, &self.unique[..=m]) {
            return false;
        }
        equations.at(all[m]);
        let Ok(closure) = equations.closure(&all[..m], false) else { return false };
        null_vectors(&closure.f_u, self.unit_entry).is_some_and(|v| within(&v, &self.unique[m + 1..]))
    }
}

/// The midpoints of a matrix.
fn middle(a: &[Vec<Interval>]) -> DMatrix<f64> {
    DMatrix::from_fn(a.len(), a.first().map_or(0, Vec::len), |i, k| a[i][k].midpoint())
}

/// The unit vector v with the smallest |M v|, where M has the midpoints as entries.
pub(super) fn null_vector(a: &[Vec<Interval>]) -> Option<DVector<f64>> {
    let middle = middle(a);
    if middle.is_empty() || middle.iter().any(|x| !x.is_finite()) {
        return None;
    }
    // Rows of zeros make the matrix square, so that there is a vector for every column.
    let columns = middle.ncols();
    let square = middle.resize_vertically(columns, 0.0);
    let svd = square.try_svd(false, true, f64::EPSILON, 200)?;
    let least = svd.singular_values.imin();
    Some(svd.v_t?.row(least).transpose())
}

/// Bounds of all null vectors with the entry 1 at `unit_entry`, for all matrices in A, without that entry; `None` if
/// there may be null vectors whose entry there is 0.
///
/// With the other columns B and the column b, B w = −b. With an approximate pseudoinverse C of B, w = −C b + (I − C B)
/// w, and so
/// |w| ≤ |C b| / (1 − |I − C B|) in the maximum norm.
fn null_vectors(a: &[Vec<Interval>], unit_entry: usize) -> Option<Vec<Interval>> {
    let m = a.len();
    let other_columns: Vec<usize> = (0..m).filter(|&k| k != unit_entry).collect();
    if other_columns.is_empty() {
        return Some(Vec::new());
    }
    let b = DMatrix::from_fn(m, m - 1, |i, k| a[i][other_columns[k]].midpoint());
    if b.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let inverse = b.pseudo_inverse(1e-9).ok()?;
    let times = |i: usize, k: usize| (0..m).fold(ZERO, |sum, row| sum + Interval::from(inverse[(i, row)]) * a[row][k]);
    let first: Vec<Interval> = (0..m - 1).map(|i| -times(i, unit_entry)).collect();
    let rests: Vec<Vec<Interval>> = (0..m - 1)
        .map(|i| {
            other_columns
                .iter()
                .enumerate()
                .map(|(j, &k)| if i == j { ONE - times(i, k) } else { -times(i, k) })
                .collect()
        })
        .collect();
    let sum = |row: &Vec<Interval>| row.iter().fold(0.0, |sum: f64, x| (sum + x.magnitude()).next_up());
    let norm = rests.iter().map(sum).fold(0.0, f64::max);
    let contraction = (1.0 - norm).next_down();
    if contraction <= 0.0 || contraction.is_nan() {
        return None;
    }
    let largest = first.iter().fold(0.0, |most: f64, x| most.max(x.magnitude()));
    let bound = (largest / contraction).next_up();
    Some(
        first
            .iter()
            .zip(&rests)
            .map(|(&x, row)| {
                let rest = (sum(row) * bound).next_up();
                x + Interval::new(-rest, rest)
            })
            .collect(),
    )
}

//! C² interpolation through a table by cubic splines.

#[cfg(test)]
mod tests;
mod tridiagonal;

use super::{ScalarFunction, enclose_periodic, enclose_pieces, enclose_straight, polynomial};
use crate::function::FunctionError;
use crate::scalar::{Interval, Scalar};
use crate::text::counted;
use alloc::vec::Vec;
use core::fmt;
use tridiagonal::Tridiagonal;

/// A cubic spline through the points (x_i, y_i): a cubic polynomial between neighbours, with f, f′ and f″ continuous
/// everywhere.
///
/// With h_i = x_{i+1} − x_i and m_i = f″(x_i) the conditions at the inner points are (de Boor, *A Practical Guide to
/// Splines*, 1978, chapter IV)
///
/// h_{i−1} m_{i−1} + 2(h_{i−1} + h_i) m_i + h_i m_{i+1} = 6((y_{i+1} − y_i)/h_i − (y_i − y_{i−1})/h_{i−1}),
///
/// and two more conditions come from the ends:
///
/// | constructor | ends | outside of the table |
/// |---|---|---|
/// | [`natural`](Self::natural) | f″ = 0 | continues straight, with the slope of the end |
/// | [`clamped`](Self::clamped) | f′ given | continues with the cubic of the end |
/// | [`periodic`](Self::periodic) | f′ and f″ of both ends agree | repeats |
///
/// All three continuations keep f″ continuous, so that no acceleration jumps where a mechanism leaves the table. The
/// data say nothing about values outside of the table; compare with [`domain`](Self::domain) where that matters. An
/// argument of NaN gives NaN.
///
/// For smooth data the error falls with the fourth power of the spacing (with natural ends: with the second power near
/// an end at which the true f″ is not 0).
///
/// ```
/// use kin_runtime::{ScalarFunction, function::CubicSpline};
///
/// # fn main() -> Result<(), kin_runtime::function::FunctionError> {
/// // A cam's lift over one turn, every 60°.
/// let angle: Vec<f64> = (0..=6).map(|k| f64::from(k) * std::f64::consts::TAU / 6.0).collect();
/// let lift = CubicSpline::periodic(&angle, &[0.0, 2.5e-3, 7.5e-3, 10e-3, 7.5e-3, 2.5e-3, 0.0])?;
/// let [s, s_1, s_2] = lift.evaluate(angle[3]);
/// assert_eq!(s, 10e-3);
/// assert!(s_1.abs() < 1e-15 && s_2 < 0.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CubicSpline {
    knots: Vec<f64>,
    /// The coefficients of (x − x_i)^k, k = 0 … 3, of every piece.
    pieces: Vec<[f64; 4]>,
    outside: Outside,
}

/// The continuation of a spline outside of its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outside {
    Straight,
    Cubic,
    Periodic,
}

impl CubicSpline {
    /// The spline with f″ = 0 at both ends.
    ///
    /// # Errors
    /// The table does not consist of two or more finite points with increasing abscissae.
    pub fn natural(x: &[f64], y: &[f64]) -> Result<Self, FunctionError> {
        let h = spacings(x, y, 2)?;
        let (mut system, mut right) = inner(&h, y);
        let last = h.len();
        (system.diagonal[0], system.upper[0], right[0]) = (1.0, 0.0, 0.0);
        (system.lower[last], system.diagonal[last], right[last]) = (0.0, 1.0, 0.0);
        Self::new(x, y, &h, &system.solve(&right), Outside::Straight)
    }

    /// The spline with the slopes `start` and `end` at its ends.
    ///
    /// # Errors
    /// As [`natural`](Self::natural), and where a slope is not finite.
    pub fn clamped(x: &[f64], y: &[f64], start: f64, end: f64) -> Result<Self, FunctionError> {
        let h = spacings(x, y, 2)?;
        finite("slopes", &[start, end])?;
        let (mut system, mut right) = inner(&h, y);
        let last = h.len();
        (system.diagonal[0], system.upper[0]) = (2.0 * h[0], h[0]);
        right[0] = 6.0 * ((y[1] - y[0]) / h[0] - start);
        (system.lower[last], system.diagonal[last]) = (h[last - 1], 2.0 * h[last - 1]);
        right[last] = 6.0 * (end - (y[last] - y[last - 1]) / h[last - 1]);
        Self::new(x, y, &h, &system.solve(&right), Outside::Cubic)
    }

    /// The spline that repeats with the period x_n − x_0; the last point has the value of the first.
    ///
    /// # Errors
    /// As [`natural`](Self::natural), where there are fewer than three points, and where the last value differs from
    /// the first by more than rounding.
    pub fn periodic(x: &[f64], y: &[f64]) -> Result<Self, FunctionError> {
        let h = spacings(x, y, 3)?;
        let n = h.len();
        let (first, last) = (y[0], y[n]);
        let largest = y.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if (last - first).abs() > 1e-12 * largest {
            return Err(FunctionError::NotPeriodic { first, last });
        }
        let mut y = y.to_vec();
        y[n] = first;
        let before = |i: usize| if i == 0 { n - 1 } else { i - 1 };
        let slope = |i: usize| (y[i + 1] - y[i]) / h[i];
        let mut system = Tridiagonal {
            lower: (0..n).map(|i| h[before(i)]).collect(),
            diagonal: (0..n).map(|i| 2.0 * (h[before(i)] + h[i])).collect(),
            upper: h.clone(),
        };
        let right: Vec<f64> = (0..n).map(|i| 6.0 * (slope(i) - slope(before(i)))).collect();
        let mut m = if n == 2 {
            // With two pieces both neighbours of a point are the same point, so their coefficients add up.
            let off = h[0] + h[1];
            (system.lower, system.upper) = (alloc::vec![0.0, off], alloc::vec![off, 0.0]);
            system.solve(&right)
        } else {
            system.solve_cyclic(&right)
        };
        m.push(m[0]);
        Self::new(x, &y, &h, &m, Outside::Periodic)
    }

    /// First and last abscissa of the table; the struct's documentation describes the continuation beyond them.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.pieces.len()])
    }

    /// The abscissae of the table.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    fn new(x: &[f64], y: &[f64], h: &[f64], m: &[f64], outside: Outside) -> Result<Self, FunctionError> {
        let piece = |i: usize| {
            let slope = (y[i + 1] - y[i]) / h[i] - h[i] * (2.0 * m[i] + m[i + 1]) / 6.0;
            [y[i], slope, 0.5 * m[i], (m[i + 1] - m[i]) / (6.0 * h[i])]
        };
        let pieces: Vec<[f64; 4]> = (0..h.len()).map(piece).collect();
        match pieces.iter().position(|piece| piece.iter().any(|c| !c.is_finite())) {
            Some(index) => Err(FunctionError::NonFinite { what: "coefficients", index }),
            None => Ok(Self { knots: x.to_vec(), pieces, outside }),
        }
    }

    /// The value and derivatives by the piece at `x`.
    fn at(&self, x: f64) -> [f64; 3] {
        let i = self.piece_at(x);
        super::polynomial::horner(&self.pieces[i], x - self.knots[i])
    }

    /// The index of the piece at `x`.
    fn piece_at(&self, x: f64) -> usize {
        let last = self.pieces.len() - 1;
        self.knots[1..=last].partition_point(|knot| *knot <= x)
    }
}

impl ScalarFunction for CubicSpline {
    /// Writes derivatives of any order: f‴ is constant within a piece, and higher ones are 0. At a knot, where f‴
    /// jumps, the value is that of the later piece, and at the end of a spline that does not repeat that of the last
    /// one.
    fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
        let (start, end) = self.domain();
        let inside = match self.outside {
            Outside::Cubic => x,
            Outside::Straight if x < start || x > end => {
                out.fill(0.0);
                out.iter_mut().zip(self.evaluate(x)).for_each(|(index, value)| *index = value);
                return out.len();
            }
            Outside::Straight => x,
            Outside::Periodic => super::wrapped(x, start, end),
        };
        let i = self.piece_at(inside);
        super::polynomial::all_derivatives(&self.pieces[i], inside - self.knots[i], out)
    }

    fn enclose(&self, x: Interval) -> Interval {
        let (start, end) = self.domain();
        let of_piece =
            |i: usize, x: Interval| enclose_cubic(&self.pieces[i], [x.lower(), x.upper()].map(|x| x - self.knots[i]));
        let inside = |x: Interval| {
            let ends = [x.lower(), x.upper()].map(|x| self.piece_at(x));
            enclose_pieces(x, ends, &|i| self.knots[i], &of_piece)
        };
        match self.outside {
            _ if !x.is_bounded() => Interval::UNDEFINED,
            Outside::Cubic => inside(x),
            Outside::Straight => enclose_straight(x, [start, end], &inside, &|x| self.evaluate(x)[0]),
            Outside::Periodic => enclose_periodic(x, [start, end], &inside),
        }
    }

    fn evaluate(&self, x: f64) -> [f64; 3] {
        let (start, end) = self.domain();
        match self.outside {
            Outside::Cubic => self.at(x),
            Outside::Straight if x < start || x > end => {
                let from = if x < start { start } else { end };
                let [f, slope, _] = self.at(from);
                [f + slope * (x - from), slope, 0.0]
            }
            Outside::Straight => self.at(x),
            Outside::Periodic => self.at(super::wrapped(x, start, end)),
        }
    }
}

/// The values of c₀ + c₁ u + c₂ u² + c₃ u³ between two arguments: the least and the largest of those at both and where
/// c₁ + 2 c₂ u + 3 c₃ u² = 0.
fn enclose_cubic(&[c0, c1, c2, c3]: &[f64; 4], [from, to]: [f64; 2]) -> Interval {
    let root = Scalar::sqrt(c2 * c2 - 3.0 * c1 * c3);
    let sum = -(c2 + if c2 < 0.0 { -root } else { root });
    let inside = [sum / (3.0 * c3), c1 / sum].into_iter().filter(|u| (from..=to).contains(u));
    let value = |u: f64| Interval::from(polynomial::horner(&[c0, c1, c2, c3], u)[0]);
    inside.map(value).fold(value(from).hull(value(to)), Interval::hull)
}

/// The distances between abscissae, after checking the table.
fn spacings(x: &[f64], y: &[f64], needed: usize) -> Result<Vec<f64>, FunctionError> {
    if x.len() != y.len() {
        return Err(FunctionError::Lengths { abscissae: x.len(), values: y.len() });
    }
    if x.len() < needed {
        return Err(FunctionError::TooFewPoints { found: x.len(), needed });
    }
    finite("abscissae", x)?;
    finite("values", y)?;
    if let Some(index) = (1..x.len()).find(|&i| x[i] <= x[i - 1]) {
        return Err(FunctionError::NotIncreasing { index, before: x[index - 1], found: x[index] });
    }
    Ok(x.windows(2).map(|pair| pair[1] - pair[0]).collect())
}

fn finite(what: &'static str, values: &[f64]) -> Result<(), FunctionError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(FunctionError::NonFinite { what, index }),
        None => Ok(()),
    }
}

/// The conditions at the inner points; the first and the last row are left to the caller.
fn inner(h: &[f64], y: &[f64]) -> (Tridiagonal, Vec<f64>) {
    let n = h.len() + 1;
    let zeros = || alloc::vec![0.0; n];
    let mut system = Tridiagonal { lower: zeros(), diagonal: zeros(), upper: zeros() };
    let mut right = zeros();
    for i in 1..n - 1 {
        (system.lower[i], system.diagonal[i], system.upper[i]) = (h[i - 1], 2.0 * (h[i - 1] + h[i]), h[i]);
        right[i] = 6.0 * ((y[i + 1] - y[i]) / h[i] - (y[i] - y[i - 1]) / h[i - 1]);
    }
    (system, right)
}

/// For example `cubic spline through 7 knots from 0 to 6`.
impl fmt::Display for CubicSpline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("cubic spline through ")?;
        counted(f, self.knots.len(), "knot")?;
        if let [first, .., last] = self.knots[..] {
            write!(f, " from {first} to {last}")?;
        }
        f.write_str(if self.outside == Outside::Periodic { ", periodic" } else { "" })
    }
}

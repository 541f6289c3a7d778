//! Small linear systems M x = b as expressions: Cramer's rule, which has no pivots that could be 0, as long as it
//! takes few products (see [`minors`]), and elimination in a fixed order otherwise.

use super::minors::{self, Minors};
use super::scales::squared_scales;
use super::sizes::DENOMINATOR_FLOOR;
use crate::constraint::Coordinate;
use crate::expr::{ExprId, Graph};
use crate::vocabulary::{Function, UnknownKind};

/// The result of [`solve`].
pub(super) struct DenseSolution {
    /// The solution x for every right-hand side b.
    pub(super) solutions: Vec<Vec<ExprId>>,
    /// A number that is 0 where M is singular; `None` for a single unknown.
    pub(super) margin: Option<ExprId>,
    /// A number whose square is the margin and whose sign is that of det M or always its opposite; `None` for a single
    /// unknown.
    pub(super) orientation: Option<ExprId>,
}

/// Solves M x = b for every b, with a margin that is 0 where M is singular. For two and three unknowns the margin is
/// (det M)² over the product of the squared norms of the rows, for more it is the inverse of the mean of the squared
/// norms of the columns of M⁻¹, where the rows of M have the norm 1; for two unknowns both are the same. The margin of a
/// constant M is that of `margin_of_constants`. By elimination it is n/Σ 1/sᵢ², where sᵢ is the size of pivot i relative
/// to its row of M: the harmonic mean of sᵢ², which is of the order of the smallest sᵢ² for any n. A single unknown has
/// no margin.
///
/// Columns of lengths and of scalars are scaled (see [`scales`](super::scales)), so that the margin does not depend on
/// their units.
pub(super) fn solve(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    rights: &[Vec<ExprId>],
    kinds: &[UnknownKind],
) -> DenseSolution {
    match matrix.len() {
        0 => alone(rights.iter().map(|_| Vec::new()).collect()),
        1 => {
            let one = graph.number(1.0);
            let inverse = graph.div(one, matrix[0][0]);
            let inverse = graph.opaque(inverse);
            alone(rights.iter().map(|b| vec![graph.mul(b[0], inverse)]).collect())
        }
        2 | 3 => cramer(graph, matrix, rights, kinds),
        _ if has_few_minors(graph, matrix) => invert(graph, matrix, rights, kinds),
        _ => eliminate(graph, matrix, rights, kinds),
    }
}

/// [`solve`] without a margin: the product of the adjugate and one right-hand side takes more operations than Cramer's
/// rule.
pub(super) fn solution(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    right: &[ExprId],
    kinds: &[UnknownKind],
) -> Vec<ExprId> {
    if matrix.len() < 4 || !has_few_minors(graph, matrix) {
        return solve(graph, matrix, &[right.to_vec()], kinds).solutions.into_iter().flatten().collect();
    }
    let scales = squared_scales(graph, matrix, kinds);
    let Scaled { rows, factors, .. } = scaled_rows(graph, matrix, &scales);
    let right: Vec<ExprId> = right.iter().zip(&factors).map(|(&b, &factor)| graph.mul(factor, b)).collect();
    let mut minors = Minors::new(&rows, graph);
    let (det, one) = (minors.determinant(graph), graph.number(1.0));
    let inverse = graph.div(one, det);
    let inverse = graph.opaque(inverse);
    minors.replaced(graph, &right).into_iter().map(|top| graph.mul(top, inverse)).collect()
}

/// Rows multiplied by factors.
struct Scaled {
    rows: Vec<Vec<ExprId>>,
    factors: Vec<ExprId>,
    /// The squared norms of the rows after that.
    norms: Vec<ExprId>,
}

/// The rows of a matrix divided by their norms, so that minors do not leave the range of small floating-point numbers.
/// Rows of numbers stay as they are.
fn scaled_rows(graph: &mut Graph, matrix: &[Vec<ExprId>], scales: &[Option<ExprId>]) -> Scaled {
    let (one, least) = (graph.number(1.0), graph.number(DENOMINATOR_FLOOR));
    let mut scaled = Scaled { rows: Vec::new(), factors: Vec::new(), norms: Vec::new() };
    for row in matrix {
        let norm = squared_norm(graph, row, scales);
        let (factor, norm) = if row.iter().all(|&entry| graph.literal(entry).is_some()) {
            (one, norm)
        } else {
            let norm = graph.add(norm, least);
            let root = graph.call(Function::Sqrt, norm);
            let inverse = graph.div(one, root);
            (graph.opaque(inverse), one)
        };
        scaled.rows.push(row.iter().map(|&entry| graph.mul(factor, entry)).collect());
        scaled.factors.push(factor);
        scaled.norms.push(norm);
    }
    scaled
}

/// The squared norm of a row, in which columns are scaled.
fn squared_norm(graph: &mut Graph, row: &[ExprId], scales: &[Option<ExprId>]) -> ExprId {
    let mut norm = graph.zero();
    for (&entry, scale) in row.iter().zip(scales) {
        let mut square = graph.square(entry);
        if let Some(scale) = scale {
            square = graph.mul(*scale, square);
        }
        norm = graph.add(norm, square);
    }
    norm
}

/// Solves by the adjugate, from which the margin is computed, too.
fn invert(graph: &mut Graph, matrix: &[Vec<ExprId>], rights: &[Vec<ExprId>], kinds: &[UnknownKind]) -> DenseSolution {
    let scales = squared_scales(graph, matrix, kinds);
    let Scaled { rows, factors, norms } = scaled_rows(graph, matrix, &scales);
    let mut minors = Minors::new(&rows, graph);
    let (det, adjugate) = (minors.determinant(graph), minors.adjugate(graph));
    let one = graph.number(1.0);
    let inverse = graph.div(one, det);
    let inverse = graph.opaque(inverse);
    let solution = |b: &Vec<ExprId>| {
        let b: Vec<ExprId> = b.iter().zip(&factors).map(|(&b, &factor)| graph.mul(factor, b)).collect();
        let tops = adjugate.iter().map(|row| {
            let top = sum(graph, row.iter().copied().zip(b.iter().copied()));
            graph.mul(top, inverse)
        });
        tops.collect()
    };
    let solutions = rights.iter().map(solution).collect();
    let margin = if graph.depends(det).is_static() {
        margin_of_constants(graph, &rows, det)
    } else {
        // The squared norms of the columns of adj M; in those of M⁻¹ rows are divided by the scales of the unknowns.
        let mut norms_of_columns = graph.number(DENOMINATOR_FLOOR);
        for (row, scale) in adjugate.iter().zip(&scales) {
            let mut squares = graph.zero();
            for (&entry, &norm) in row.iter().zip(&norms) {
                let square = graph.square(entry);
                let square = graph.mul(norm, square);
                squares = graph.add(squares, square);
            }
            if let Some(scale) = scale {
                squares = graph.div(squares, *scale);
            }
            norms_of_columns = graph.add(norms_of_columns, squares);
        }
        // Slightly less than n, so that the margin does not exceed 1 after rounding.
        let (count, square) = (graph.number(matrix.len() as f64 * (1.0 - 1e-14)), graph.square(det));
        let top = graph.mul(count, square);
        graph.div(top, norms_of_columns)
    };
    let orientation = Some(signed_root(graph, det, margin));
    DenseSolution { solutions, margin: Some(margin), orientation }
}

/// Whether a matrix is solved by its minors.
fn has_few_minors(graph: &Graph, matrix: &[Vec<ExprId>]) -> bool {
    let filled = matrix.iter().map(|row| row.iter().map(|&entry| !graph.is_zero(entry)).collect());
    minors::are_few(&filled.collect::<Vec<_>>())
}

/// The kinds of the given coordinates.
pub(super) fn kinds(coordinates: &[Coordinate], indices: &[u32]) -> Vec<UnknownKind> {
    indices.iter().map(|&k| coordinates[k as usize].unknown_kind()).collect()
}

/// A result without margin and orientation, for at most one unknown.
fn alone(solutions: Vec<Vec<ExprId>>) -> DenseSolution {
    DenseSolution { solutions, margin: None, orientation: None }
}

/// Solves for two or three unknowns by Cramer's rule.
fn cramer(graph: &mut Graph, matrix: &[Vec<ExprId>], rights: &[Vec<ExprId>], kinds: &[UnknownKind]) -> DenseSolution {
    let mut minors = Minors::new(matrix, graph);
    let det = minors.determinant(graph);
    let one = graph.number(1.0);
    let inverse = graph.div(one, det);
    let inverse = graph.opaque(inverse);
    let mut solution = |b: &Vec<ExprId>| {
        let tops = minors.replaced(graph, b);
        tops.into_iter().map(|top| graph.mul(top, inverse)).collect()
    };
    let solutions = rights.iter().map(&mut solution).collect();
    if graph.depends(det).is_static() {
        let margin = margin_of_constants(graph, matrix, det);
        let orientation = Some(signed_root(graph, det, margin));
        return DenseSolution { solutions, margin: Some(margin), orientation };
    }
    let mut product = one;
    let scales = squared_scales(graph, matrix, kinds);
    for row in matrix {
        let norm = squared_norm(graph, row, &scales);
        product = graph.mul(product, norm);
    }
    let mut square = graph.square(det);
    for (column, scale) in scales.iter().enumerate() {
        // All columns of lengths have one scale, which is taken to their number.
        let Some(squared) = scale.filter(|_| !scales[..column].contains(scale)) else { continue };
        let count = scales.iter().filter(|other| *other == scale).count();
        let all = graph.powi(squared, i32::try_from(count).unwrap_or(0));
        square = graph.mul(all, square);
    }
    let margin = graph.div(square, product);
    let orientation = Some(signed_root(graph, det, margin));
    DenseSolution { solutions, margin: Some(margin), orientation }
}

/// The margin of a matrix of constants: (det M)²/(n! Σ p²) over the products p of which det M is the sum. It does not
/// depend on the units of rows and columns, and is 0 where the products cancel.
fn margin_of_constants(graph: &mut Graph, matrix: &[Vec<ExprId>], det: ExprId) -> ExprId {
    let rows = matrix.iter().map(|row| row.iter().map(|&entry| graph.square(entry)).collect());
    let rows: Vec<Vec<ExprId>> = rows.collect();
    let (products, least) = (minors::permanent(graph, &rows), graph.number(DENOMINATOR_FLOOR));
    let squares = graph.add(least, products);
    // Slightly more than n!, so that the margin does not exceed 1 after rounding.
    let count: f64 = (1..=matrix.len()).map(|k| k as f64).product();
    let (count, square) = (graph.number(count * (1.0 + 1e-14)), graph.square(det));
    let whole = graph.mul(count, squares);
    graph.div(square, whole)
}

/// √margin with the sign of another expression.
fn signed_root(graph: &mut Graph, signed: ExprId, margin: ExprId) -> ExprId {
    let (sign, root) = (graph.sign(signed), graph.call(Function::Sqrt, margin));
    graph.mul(sign, root)
}

fn sum(graph: &mut Graph, products: impl Iterator<Item = (ExprId, ExprId)>) -> ExprId {
    let mut sum = graph.zero();
    for (a, b) in products {
        let product = graph.mul(a, b);
        sum = graph.add(sum, product);
    }
    sum
}

/// Gaussian elimination. Numeric entries are preferred as pivots, then the entry with the least fill-in (Markowitz
/// 1957).
fn eliminate(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    rights: &[Vec<ExprId>],
    kinds: &[UnknownKind],
) -> DenseSolution {
    let scales = squared_scales(graph, matrix, kinds);
    let scales: Vec<_> = scales.iter().map(|scale| scale.map(|square| graph.call(Function::Sqrt, square))).collect();
    let magnitude = |graph: &mut Graph, entry: ExprId, column: usize| {
        let magnitude = graph.call(Function::Abs, entry);
        match scales[column] {
            Some(scale) => graph.mul(scale, magnitude),
            None => magnitude,
        }
    };
    let n = matrix.len();
    let mut m = matrix.to_vec();
    let mut b: Vec<Vec<ExprId>> = rights.to_vec();
    let (mut rows, mut columns): (Vec<usize>, Vec<usize>) = ((0..n).collect(), (0..n).collect());
    let mut order = Vec::new();
    let mut losses = graph.zero();
    // det M has the sign of this product, up to the parity of the fixed row and column permutations.
    let mut sign = graph.number(1.0);
    while !rows.is_empty() {
        let filled = |graph: &Graph, i: usize, j: usize| !graph.is_zero(m[i][j]);
        let score = |i: usize, j: usize| {
            let in_row = columns.iter().filter(|&&c| filled(graph, i, c)).count();
            let in_column = rows.iter().filter(|&&r| filled(graph, r, j)).count();
            (graph.literal(m[i][j]).is_none(), (in_row - 1) * (in_column - 1), i, j)
        };
        let entries = rows.iter().flat_map(|&i| columns.iter().map(move |&j| (i, j)));
        let best = entries.filter(|&(i, j)| filled(graph, i, j)).map(|(i, j)| score(i, j)).min();
        // No non-zero entry is left: the matrix is singular for all values, which a margin of 0 reports.
        let Some((_, _, i, j)) = best else {
            let solutions = rights.iter().map(|_| vec![graph.zero(); n]).collect();
            return DenseSolution { solutions, margin: Some(graph.zero()), orientation: Some(graph.zero()) };
        };
        // The pivot is compared with its row of the original matrix: after the subtractions the whole row may be small,
        // and the last pivot is the only entry left in its row.
        let mut size = graph.zero();
        for (c, &entry) in matrix[i].iter().enumerate() {
            let magnitude = magnitude(graph, entry, c);
            size = graph.add(size, magnitude);
        }
        let pivot = magnitude(graph, m[i][j], j);
        let own_sign = graph.sign(m[i][j]);
        sign = graph.mul(sign, own_sign);
        let loss = graph.div(size, pivot);
        let loss = graph.square(loss);
        losses = graph.add(losses, loss);
        rows.retain(|&r| r != i);
        columns.retain(|&c| c != j);
        let one = graph.number(1.0);
        let inverse = graph.div(one, m[i][j]);
        let inverse = graph.opaque(inverse);
        for &r in &rows {
            if graph.is_zero(m[r][j]) {
                continue;
            }
            let factor = graph.mul(m[r][j], inverse);
            for &c in &columns {
                let term = graph.mul(factor, m[i][c]);
                m[r][c] = graph.sub(m[r][c], term);
            }
            for b in &mut b {
                let term = graph.mul(factor, b[i]);
                b[r] = graph.sub(b[r], term);
            }
        }
        order.push((i, j, inverse, columns.clone()));
    }
    let solutions = b
        .iter()
        .map(|b| {
            let mut x = vec![graph.zero(); n];
            for (i, j, inverse, later) in order.iter().rev() {
                let mut rest = b[*i];
                for &c in later {
                    let term = graph.mul(m[*i][c], x[c]);
                    rest = graph.sub(rest, term);
                }
                x[*j] = graph.mul(rest, *inverse);
            }
            x
        })
        .collect();
    let count = graph.number(n as f64);
    let margin = graph.div(count, losses);
    let orientation = Some(signed_root(graph, sign, margin));
    DenseSolution { solutions, margin: Some(margin), orientation }
}

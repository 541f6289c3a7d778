//! Determinants as expressions, by Laplace's expansion along the rows. A minor of the first rows is written once,
//! whatever it is a part of, so that a determinant of n rows takes at most n 2ⁿ⁻¹ products. Unlike an elimination, it
//! divides by nothing.

use crate::expr::{ExprId, Graph};
use std::collections::{BTreeMap, BTreeSet};

/// Largest number of products that a solution may take; six unknowns of which every row contains all take 434.
const MOST_PRODUCTS: usize = 500;

/// Largest number of unknowns for which an order of the rows is searched.
const MOST_UNKNOWNS: usize = 12;

/// True if a system whose rows contain the given unknowns is solved with few products.
pub(super) fn are_few(filled: &[Vec<bool>]) -> bool {
    order_of_rows(filled).is_some()
}

/// An order of the rows in which there are few minors; `None` if a solution takes too many products. A minor is 0 unless
/// its rows can be matched with its columns. The next row is always the one that leads to the fewest minors.
fn order_of_rows(filled: &[Vec<bool>]) -> Option<Vec<usize>> {
    let n = filled.len();
    if n > MOST_UNKNOWNS {
        return None;
    }
    // Every row also contains the column of the right-hand side.
    let columns = |row: &Vec<bool>| (0..n).filter(|&j| row[j]).map(|j| 1 << j).chain([1 << n]).collect();
    let rows: Vec<Vec<u32>> = filled.iter().map(columns).collect();
    let (mut order, mut remaining): (Vec<usize>, Vec<usize>) = (Vec::new(), (0..n).collect());
    let (mut minors, mut products) = (BTreeSet::from([0]), 0);
    while !remaining.is_empty() {
        let with = |&row: &usize| {
            let larger = |minor: &u32| {
                let minor = *minor;
                rows[row].iter().filter(move |&&column| minor & column == 0).map(move |column| minor | column)
            };
            let pairs: Vec<u32> = minors.iter().flat_map(larger).collect();
            (row, pairs.len(), pairs.into_iter().collect::<BTreeSet<u32>>())
        };
        let (row, count, larger) =
            remaining.iter().map(with).min_by_key(|(row, count, larger)| (larger.len(), *count, *row))?;
        products += count;
        if products > MOST_PRODUCTS {
            return None;
        }
        minors = larger;
        remaining.retain(|&other| other != row);
        order.push(row);
    }
    Some(order)
}

/// The minors of a square matrix M, and of M with one column replaced.
pub(super) struct Minors {
    /// The rows of M, in the order of their expansion.
    rows: Vec<Vec<ExprId>>,
    /// For each row, its row in M.
    order: Vec<usize>,
    /// The minors of the first rows that are known, by the set of their columns (bit j for column j).
    known: BTreeMap<u32, ExprId>,
    /// Whether the signs alternate, as those of a determinant do.
    alternates: bool,
}

/// The sum of the products of which det M is made, each with a positive sign (the permanent of M).
pub(super) fn permanent(graph: &mut Graph, matrix: &[Vec<ExprId>]) -> ExprId {
    let mut minors = Minors { alternates: false, ..Minors::new(matrix, graph) };
    let all = minors.all();
    minors.minor(graph, all, &[])
}

impl Minors {
    pub(super) fn new(matrix: &[Vec<ExprId>], graph: &Graph) -> Self {
        let filled = matrix.iter().map(|row| row.iter().map(|&entry| !graph.is_zero(entry)).collect());
        let order = order_of_rows(&filled.collect::<Vec<_>>()).unwrap_or_else(|| (0..matrix.len()).collect());
        Self {
            rows: order.iter().map(|&i| matrix[i].clone()).collect(),
            order,
            known: BTreeMap::new(),
            alternates: true,
        }
    }

    /// det M.
    pub(super) fn determinant(&mut self, graph: &mut Graph) -> ExprId {
        let all = self.all();
        let det = self.minor(graph, all, &[]);
        self.signed(graph, det)
    }

    /// For every column of M, the determinant of M with that column replaced by `right`.
    pub(super) fn replaced(&mut self, graph: &mut Graph, right: &[ExprId]) -> Vec<ExprId> {
        let n = self.rows.len();
        let right: Vec<ExprId> = self.order.iter().map(|&i| right[i]).collect();
        let known_before = self.known.clone();
        let found = (0..n).map(|j| {
            // The new column stands last instead of in column j.
            let columns = self.all() & !(1 << j) | 1 << n;
            let minor = self.minor(graph, columns, &right);
            let minor = if (n - 1 - j).is_multiple_of(2) { minor } else { graph.neg(minor) };
            self.signed(graph, minor)
        });
        let found = found.collect();
        self.known = known_before;
        found
    }

    /// The adjugate of M: the product of adj M and b solves M x = det(M) b.
    pub(super) fn adjugate(&mut self, graph: &mut Graph) -> Vec<Vec<ExprId>> {
        let n = self.rows.len();
        let (zero, one) = (graph.zero(), graph.number(1.0));
        let columns = (0..n).map(|i| {
            let unit: Vec<ExprId> = (0..n).map(|k| if k == i { one } else { zero }).collect();
            self.replaced(graph, &unit)
        });
        let columns: Vec<Vec<ExprId>> = columns.collect();
        (0..n).map(|j| columns.iter().map(|column| column[j]).collect()).collect()
    }

    /// The set of all columns of M.
    fn all(&self) -> u32 {
        (1 << self.rows.len()) - 1
    }

    /// A determinant of all rows, with the sign that it has in the order of the rows in M.
    fn signed(&self, graph: &mut Graph, det: ExprId) -> ExprId {
        let pairs = self.order.iter().enumerate().map(|(k, i)| self.order[..k].iter().filter(|j| *j > i).count());
        if pairs.sum::<usize>().is_multiple_of(2) { det } else { graph.neg(det) }
    }

    /// The determinant of the first rows and as many columns, expanded along the last of these rows. Column n is
    /// `right`.
    fn minor(&mut self, graph: &mut Graph, columns: u32, right: &[ExprId]) -> ExprId {
        let size = columns.count_ones() as usize;
        if size == 0 {
            return graph.number(1.0);
        }
        if let Some(&known) = self.known.get(&columns) {
            return known;
        }
        let n = self.rows.len();
        let mut minor = graph.zero();
        let places = (0..=n).filter(|j| columns & 1 << j != 0);
        for (index, j) in places.enumerate() {
            let entry = if j < n { self.rows[size - 1][j] } else { right[size - 1] };
            if graph.is_zero(entry) {
                continue;
            }
            let rest = self.minor(graph, columns & !(1 << j), right);
            let product = graph.mul(entry, rest);
            let adds = !self.alternates || (size - 1 + index).is_multiple_of(2);
            minor = if adds { graph.add(minor, product) } else { graph.sub(minor, product) };
        }
        self.known.insert(columns, minor);
        minor
    }
}

#[cfg(test)]
mod tests {
    use super::{Minors, are_few, permanent};
    use crate::expr::{ExprId, Graph};

    /// Rows of integers as constants of a graph.
    fn constants(graph: &mut Graph, rows: &[[i32; 5]; 5]) -> Vec<Vec<ExprId>> {
        rows.iter().map(|row| row.iter().map(|&entry| graph.number(f64::from(entry))).collect()).collect()
    }

    #[test]
    fn the_replaced_determinants_are_the_solution_times_the_determinant() {
        // The product of two triangular matrices, so that the determinant is the product of the diagonals, 2·3·(−1)·5·1,
        // with the first two rows exchanged.
        let lower = [[1, 0, 0, 0, 0], [2, 1, 0, 0, 0], [0, -1, 1, 0, 0], [3, 0, 0, 1, 0], [0, 0, 2, -2, 1]];
        let upper = [[2, 0, 1, 0, 4], [0, 3, 0, 0, -1], [0, 0, -1, 2, 0], [0, 0, 0, 5, 1], [0, 0, 0, 0, 1]];
        let product = |i: usize, j: usize| (0..5).map(|k| lower[i][k] * upper[k][j]).sum::<i32>();
        let mut rows: [[i32; 5]; 5] = std::array::from_fn(|i| std::array::from_fn(|j| product(i, j)));
        rows.swap(0, 1);
        let x = [3, -1, 4, 1, -5];
        let mut graph = Graph::new();
        let matrix = constants(&mut graph, &rows);
        let right: Vec<i32> = rows.iter().map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
        let right: Vec<ExprId> = right.into_iter().map(|b| graph.number(f64::from(b))).collect();
        let mut minors = Minors::new(&matrix, &graph);
        let det = minors.determinant(&mut graph);
        assert_eq!(graph.literal(det), Some(30.0));
        let tops = minors.replaced(&mut graph, &right);
        let adjugate = minors.adjugate(&mut graph);
        for (row, top) in adjugate.iter().zip(&tops) {
            let product = row.iter().zip(&right).fold(graph.zero(), |sum, (&a, &b)| {
                let product = graph.mul(a, b);
                graph.add(sum, product)
            });
            assert_eq!(graph.literal(product), graph.literal(*top));
        }
        assert_eq!(
            tops.iter().map(|&top| graph.literal(top)).collect::<Vec<_>>(),
            x.map(|x| Some(30.0 * f64::from(x)))
        );
    }

    #[test]
    fn the_permanent_of_ones_counts_the_products() {
        let mut graph = Graph::new();
        let ones = constants(&mut graph, &[[1; 5]; 5]);
        let products = permanent(&mut graph, &ones);
        assert_eq!(graph.literal(products), Some(120.0));
    }

    #[test]
    fn full_matrices_have_few_minors_up_to_six_rows_and_sparse_ones_beyond() {
        let full = |n: usize| vec![vec![true; n]; n];
        assert!(are_few(&full(6)) && !are_few(&full(7)));
        let row = |n: usize, i: usize| (0..n).map(|j| i.abs_diff(j) < 2).collect();
        let band = |n: usize, order: &[usize]| order.iter().map(|&i| row(n, i)).collect::<Vec<_>>();
        assert!(are_few(&band(8, &[0, 1, 2, 3, 4, 5, 6, 7])) && !are_few(&full(40)));
        // In the order of this list the minors of the first five rows would already be too many.
        assert!(are_few(&band(10, &[0, 2, 4, 6, 8, 1, 3, 5, 7, 9])));
    }
}

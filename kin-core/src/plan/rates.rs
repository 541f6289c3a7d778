//! Solves Φ_q x = b along the tree of a plan: velocities, accelerations and any other system with the matrix Φ_q.
//!
//! The eliminations are the derivatives of those at position level. A pivot eliminates its coordinate from the other
//! rows. A pair of rows (p x_k + …) and (q x_k + …) is combined into q times the first minus p times the second, in
//! which x_k is missing; back substitution then gives x_k = (p b₁ + q b₂)/(p² + q²). Cores are small dense systems.
//! Expressions that depend on Φ_q alone are the same for every b, so all levels share them.

use super::dense;
use super::sizes::{DENOMINATOR_FLOOR, larger, squared_size, squared_size_anywhere};
use super::tree::{Block, BlockPart, Core, Pair, PairValue, SolutionMethod};
use crate::constraint::Coordinate;
use crate::expr::{ExprId, Graph};
use crate::hash::FastMap;
use crate::vocabulary::{Function, UnknownKind};
use std::collections::BTreeMap;

/// Depth to which the terms of a divisor are examined.
const DEPTH: usize = 8;

/// A linear system that is solved along a tree.
pub(super) struct Rates<'g> {
    pub(super) graph: &'g mut Graph,
    /// The rows of Φ_q: entries by column.
    entries: Vec<BTreeMap<u32, ExprId>>,
    right: Vec<ExprId>,
    pub(super) coordinates: &'g [Coordinate],
    /// The entries of x that are already solved.
    pub(super) solution: Vec<Option<ExprId>>,
    /// The margins of cores, by the first row of the core.
    pub(super) margins: BTreeMap<usize, ExprId>,
    /// The branch values of cores, by first row; see [`dense::DenseSolution::orientation`].
    pub(super) orientations: BTreeMap<usize, ExprId>,
    /// For every division by an expression that varies, a value that is 0 where the divisor is 0: the square of the
    /// divisor divided by the squared size of its terms, or the margin of a core.
    pub(super) regular: Vec<ExprId>,
    /// The single unknowns that are iterated on. Margins and orientations of angles are not known yet.
    pub(super) single_unknowns: Vec<SingleUnknown>,
    /// An angle whose entry of x is given as 1, while those of all other cores are 0.
    pub(super) turning: Option<u32>,
    /// The values of expressions of the tree; an expression that is missing has itself as its value.
    known: FastMap<ExprId, ExprId>,
}

/// A single unknown that a core iterates on.
pub(super) struct SingleUnknown {
    /// The row of the core.
    pub(super) row: usize,
    pub(super) unknown: u32,
    pub(super) kind: UnknownKind,
    /// The entry of the row after all eliminations.
    pub(super) coefficient: ExprId,
    /// The row as a function of the unknown.
    pub(super) residual: ExprId,
}

impl<'g> Rates<'g> {
    pub(super) fn new(
        graph: &'g mut Graph,
        entries: Vec<BTreeMap<u32, ExprId>>,
        right: Vec<ExprId>,
        coordinates: &'g [Coordinate],
        known: FastMap<ExprId, ExprId>,
    ) -> Self {
        Self {
            graph,
            entries,
            right,
            solution: vec![None; coordinates.len()],
            coordinates,
            margins: BTreeMap::new(),
            orientations: BTreeMap::new(),
            regular: Vec::new(),
            single_unknowns: Vec::new(),
            turning: None,
            known,
        }
    }

    /// Solves the rows of a block for its unknowns.
    pub(super) fn block(&mut self, block: &Block) {
        let mut rows = rows_of(block);
        rows.iter().for_each(|&row| self.fold(row));
        for pivot in &block.pivots {
            rows.retain(|&row| row != pivot.row);
            let Some(&coefficient) = self.entries[pivot.row].get(&pivot.coordinate) else { continue };
            for &row in &rows {
                if let Some(entry) = self.entries[row].remove(&pivot.coordinate) {
                    let factor = self.graph.div(entry, coefficient);
                    self.subtract(row, factor, pivot.row, pivot.coordinate);
                }
            }
        }
        for part in &block.parts {
            match part {
                BlockPart::Core(core) => self.core(core),
                BlockPart::Block(block) => self.block(block),
                BlockPart::Pair(pair) => self.pair(pair),
            }
        }
        for pivot in block.pivots.iter().rev() {
            let Some(coefficient) = self.entries[pivot.row].remove(&pivot.coordinate) else { continue };
            self.fold(pivot.row);
            // The inverse is one value that the solutions for all right-hand sides b share.
            let one = self.graph.number(1.0);
            let inverse = self.graph.div(one, coefficient);
            let inverse = self.graph.opaque(inverse);
            let value = self.graph.mul(self.right[pivot.row], inverse);
            let value = self.graph.opaque(value);
            self.solution[pivot.coordinate as usize] = Some(value);
        }
    }

    /// Moves the terms of unknowns that are already solved to the right-hand side.
    fn fold(&mut self, row: usize) {
        let (mut right, graph) = (self.right[row], &mut *self.graph);
        self.entries[row].retain(|&k, entry| match self.solution[k as usize] {
            Some(value) => {
                let product = graph.mul(*entry, value);
                right = graph.sub(right, product);
                false
            }
            None => true,
        });
        self.right[row] = right;
    }

    /// Subtracts `factor` times the row `other` from `row` in all columns except `but`.
    fn subtract(&mut self, row: usize, factor: ExprId, other: usize, but: u32) {
        let zero = self.graph.zero();
        for (k, entry) in self.entries[other].clone() {
            if k != but {
                let product = self.graph.mul(factor, entry);
                let entry_of_row = self.entries[row].entry(k).or_insert(zero);
                *entry_of_row = self.graph.sub(*entry_of_row, product);
            }
        }
        let product = self.graph.mul(factor, self.right[other]);
        let right = self.graph.sub(self.right[row], product);
        self.right[row] = self.graph.opaque(right);
    }

    /// The value of an expression of the tree.
    fn value(&self, id: ExprId) -> ExprId {
        self.known.get(&id).copied().unwrap_or(id)
    }

    fn core(&mut self, core: &Core) {
        if self.turning.is_some() {
            for &k in &core.coordinates {
                let rate = self.graph.number(if self.turning == Some(k) { 1.0 } else { 0.0 });
                self.solution[k as usize] = Some(rate);
            }
            return;
        }
        core.rows.iter().for_each(|&row| self.fold(row));
        let zero = self.graph.zero();
        let entry = |row: usize, k: u32| self.entries[row].get(&k).copied().unwrap_or(zero);
        let matrix: Vec<Vec<ExprId>> =
            core.rows.iter().map(|&row| core.coordinates.iter().map(|&k| entry(row, k)).collect()).collect();
        let right: Vec<ExprId> = core.rows.iter().map(|&row| self.right[row]).collect();
        let kinds = dense::kinds(self.coordinates, &core.coordinates);
        let dense::DenseSolution { solutions, margin, orientation } =
            dense::solve(self.graph, &matrix, &[right], &kinds);
        for (&k, value) in core.coordinates.iter().zip(solutions.into_iter().flatten()) {
            self.solution[k as usize] = Some(self.graph.opaque(value));
        }
        let iterates = matches!(core.method, SolutionMethod::Newton { .. });
        if let (Some(mut margin), Some(&row)) = (margin, core.rows.first()) {
            self.regular.push(margin);
            if let (true, Some(orientation)) = (iterates, orientation) {
                // The margin of `dense` is relative to the current rows, so it does not show where a whole row
                // vanishes.
                let share = self.row_regularity(&matrix);
                let root = self.graph.call(Function::Sqrt, share);
                let orientation = self.graph.mul(orientation, root);
                self.orientations.insert(row, orientation);
                margin = self.graph.mul(margin, share);
            }
            self.margins.insert(row, margin);
        }
        let ([row], &[unknown], &[of_row]) = (matrix.as_slice(), &core.coordinates[..], &core.rows[..]) else { return };
        let (coefficient, kind) = (row[0], kinds[0]);
        if let SolutionMethod::Newton { residuals } = &core.method
            && let &[residual] = residuals.as_slice()
        {
            self.single_unknowns.push(SingleUnknown { row: of_row, unknown, kind, coefficient, residual });
            if kind == UnknownKind::Angle {
                return;
            }
            let size = squared_size_anywhere(self.graph, coefficient, DEPTH);
            self.record_single(of_row, coefficient, size);
        }
        let (square, size) = (self.graph.square(coefficient), squared_size(self.graph, coefficient, DEPTH));
        self.record_regularity(square, size);
    }

    /// Records the margin and the orientation of a single unknown from its coefficient, whose sign is the orientation, and
    /// the square of what the coefficient is compared with.
    pub(super) fn record_single(&mut self, row: usize, coefficient: ExprId, size: ExprId) {
        let square = self.graph.square(coefficient);
        let size = larger(self.graph, size, square);
        let (margin, root) = (self.graph.div(square, size), self.graph.call(Function::Sqrt, size));
        let orientation = self.graph.div(coefficient, root);
        self.margins.insert(row, margin);
        self.orientations.insert(row, orientation);
    }

    /// A dimensionless measure of the cancellation in the rows of a matrix, 0 where a row vanishes: the harmonic mean over
    /// the rows of the mean of (entry² / squared size of the entry's terms).
    fn row_regularity(&mut self, matrix: &[Vec<ExprId>]) -> ExprId {
        // The product of the means of all rows so far, and the sum of the products of all but one of them.
        let (mut product, mut sum_of_products) = (self.graph.number(1.0), self.graph.zero());
        for row in matrix {
            let (mut sum, mut count) = (self.graph.zero(), 0.0);
            for &entry in row {
                if !self.graph.is_zero(entry) {
                    let (square, size) = (self.graph.square(entry), squared_size_anywhere(self.graph, entry, DEPTH));
                    let size = larger(self.graph, size, square);
                    let share = self.graph.div(square, size);
                    sum = self.graph.add(sum, share);
                    count += 1.0;
                }
            }
            let inverse = self.graph.number(1.0 / f64::max(count, 1.0));
            let mean = self.graph.mul(sum, inverse);
            let sum_with_mean = self.graph.mul(sum_of_products, mean);
            sum_of_products = self.graph.add(sum_with_mean, product);
            product = self.graph.mul(product, mean);
        }
        // Slightly less, so that the mean does not exceed 1 after rounding.
        let (count, least) =
            (self.graph.number((1.0 - 1e-14) * matrix.len() as f64), self.graph.number(DENOMINATOR_FLOOR));
        let (top, bottom) = (self.graph.mul(count, product), self.graph.add(sum_of_products, least));
        self.graph.div(top, bottom)
    }

    /// Records the regularity of a divisor, its square divided by `size`, unless the divisor is a non-zero constant.
    fn record_regularity(&mut self, square: ExprId, size: ExprId) {
        if !self.graph.depends(square).is_static() || self.graph.is_zero(square) {
            let margin = self.graph.div(square, size);
            self.regular.push(margin);
        }
    }

    fn pair(&mut self, pair: &Pair) {
        pair.rows.iter().for_each(|&row| self.fold(row));
        let zero = self.graph.zero();
        let [first, second] = pair.rows;
        for exchange in &pair.exchanges {
            self.fold(exchange.row);
            for (factor, row) in exchange.factors.into_iter().zip(pair.rows) {
                let factor = self.value(factor);
                if !self.graph.is_zero(factor) {
                    self.subtract(exchange.row, factor, row, pair.coordinate);
                }
            }
            self.entries[exchange.row].remove(&pair.coordinate);
        }
        let before = pair.rows.map(|row| (self.entries[row].clone(), self.right[row]));
        let [p, q] = pair.rows.map(|row| self.entries[row].remove(&pair.coordinate).unwrap_or(zero));
        let scaled = |graph: &mut Graph, row: &mut BTreeMap<u32, ExprId>, factor: ExprId| {
            row.values_mut().for_each(|entry| *entry = graph.mul(factor, *entry));
        };
        scaled(self.graph, &mut self.entries[first], q);
        self.right[first] = self.graph.mul(q, self.right[first]);
        self.subtract(first, p, second, pair.coordinate);
        self.block(&pair.inner);
        let square = match &pair.value {
            PairValue::Angle { square: Some(square), .. } | PairValue::Linear { square: Some(square), .. } => {
                self.value(*square)
            }
            _ => self.graph.plain_dot([p, q], [p, q]),
        };
        let mut rights = [zero; 2];
        for ((right, row), (mut entries, right_before)) in rights.iter_mut().zip(pair.rows).zip(before) {
            entries.remove(&pair.coordinate);
            (self.entries[row], self.right[row]) = (entries, right_before);
            self.fold(row);
            *right = self.right[row];
        }
        let [of_p, of_q] = [p, q].map(|part| squared_size(self.graph, part, DEPTH));
        let size = self.graph.add(of_p, of_q);
        self.record_regularity(square, size);
        let top = self.graph.plain_dot([p, q], rights);
        let one = self.graph.number(1.0);
        let inverse = self.graph.div(one, square);
        let inverse = self.graph.opaque(inverse);
        let value = self.graph.mul(top, inverse);
        self.solution[pair.coordinate as usize] = Some(self.graph.opaque(value));
    }
}

/// All rows of a block.
pub(super) fn rows_of(block: &Block) -> Vec<usize> {
    let of_part = |part: &BlockPart| match part {
        BlockPart::Core(core) => core.rows.clone(),
        BlockPart::Block(block) => rows_of(block),
        BlockPart::Pair(pair) => {
            let mut rows = rows_of(&pair.inner);
            rows.extend(pair.rows);
            rows.sort_unstable();
            rows.dedup();
            rows
        }
    };
    block.pivots.iter().map(|pivot| pivot.row).chain(block.parts.iter().flat_map(of_part)).collect()
}

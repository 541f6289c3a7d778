//! Checks the redundant rows, which a plan does not use: a margin says whether the solution satisfies each of them.
//!
//! ```text
//! margin = 1 − (ρ/τ)² − (ρ̇/τ̇)² − (ρ̈/τ̈)²
//! ρ² = Φᵣ²/Σ Φᵣₖ² wₖ,  ρ̇² = (Σ Φᵣₖ q̇ₖ + Φᵣₜ)²/(Σ Φᵣₖ² wₖ · V²),  ρ̈² = (Σ Φᵣₖ q̈ₖ − γᵣ)²/(Σ Φᵣₖ² wₖ · A²),
//! each denominator also has a small multiple of the squared terms of Φᵣ, Φᵣₜ or γᵣ,
//! V² = Σ q̇ₖ²/wₖ,  A² = Σ q̈ₖ²/wₖ + V⁴
//! ```
//!
//! √wₖ is the characteristic size of coordinate k: one radian for an angle; for x and y a length taken from the rows
//! that contain both lengths and angles; √(1 + q²) for a scalar. So ρ is dimensionless, and is roughly the misfit of
//! the joint relative to the size of the mechanism. The tolerance τ is [`TOLERANCE`], enlarged near limits, where the
//! solution is less accurate.

use super::closures::TERM_WEIGHT;
use super::reduce::PairedRows;
use super::sizes::{squared_size_anywhere, sum_of_squared_terms};
use super::state::{Build, RedundantRow, Sizes};
use crate::constraint::CoordinateKind;
use crate::expr::{ExprId, Symbol};
use crate::program::Slot;
use crate::vocabulary::Function;

/// A row whose residual ρ is less than this counts as satisfied.
pub const TOLERANCE: f64 = 3e-11;

/// Rounding error of a solution far from limits. It grows by a factor 1/√margin near a limit, and by another for each
/// derivative.
const ROUNDING: f64 = 1e-13;

/// Added to denominators, so that 0/0 becomes 0. Rows are often satisfied exactly, so that this number must be greater
/// than 0 in f32 as well.
const DENOMINATOR_FLOOR: f64 = f32::MIN_POSITIVE as f64;

impl Build<'_> {
    /// Adds a margin for every redundant row.
    pub(super) fn add_redundant_rows(&mut self, left_out: &[usize], paired: &[PairedRows]) {
        let steps = self.listed.redundant_steps(&self.system.set, left_out);
        for (&row, step) in left_out.iter().zip(steps) {
            let place = self.listed.margin(step);
            let paired = paired.iter().find(|paired| paired.rows[1] == row).copied();
            let margin = self.graph.number(1.0);
            self.redundant.push(RedundantRow { row, paired, place, margin, sizes: Vec::new() });
        }
    }

    /// Subtracts the position residual from the margins, once q and the margins of all steps are known.
    pub(super) fn check_positions(&mut self) {
        if self.redundant.is_empty() {
            return;
        }
        let sizes = self.sizes();
        let tolerance = self.tolerance(sizes.nearness, 1);
        for mut redundant in std::mem::take(&mut self.redundant) {
            let rows = redundant.paired.map_or(vec![redundant.row], |paired| paired.rows.to_vec());
            redundant.sizes = rows.iter().map(|&row| self.size(row, &sizes.weights)).collect();
            let (miss, size) = match redundant.paired {
                // The angle already minimises the residuals of both rows, so that only the lengths |F| and |s| show
                // whether the rows are consistent.
                Some(PairedRows { difference, square, .. }) => {
                    let [difference, square] = [difference, square].map(|e| self.known_value(e));
                    (difference, self.graph.square(square))
                }
                None => {
                    let phi = self.system.equations[redundant.row].phi;
                    let terms = sum_of_squared_terms(&mut self.graph, phi, 6);
                    let [phi, terms] = [phi, terms].map(|e| self.known_value(e));
                    let share = self.graph.number(TERM_WEIGHT);
                    let terms = self.graph.mul(share, terms);
                    (phi, self.graph.add(redundant.sizes[0], terms))
                }
            };
            let square = self.graph.square(miss);
            self.subtract_residual(&mut redundant, square, size, tolerance);
            self.redundant.push(redundant);
        }
        self.redundant_sizes = Some(sizes);
    }

    /// Subtracts the residual of q̇ (`order` 0) or q̈ (`order` 1) from the margins; `solution` solves Φ_q x = `right`.
    pub(super) fn check_rates(&mut self, order: usize, right: &[ExprId], solution: &[ExprId]) {
        let Some(mut sizes) = self.redundant_sizes.take() else { return };
        let mut all = self.graph.zero();
        for (&x, &weight) in solution.iter().zip(&sizes.weights) {
            let square = self.graph.square(x);
            let square = self.graph.div(square, weight);
            all = self.graph.add(all, square);
        }
        if order == 0 {
            sizes.velocity = self.graph.opaque(all);
        } else {
            let turning = self.graph.square(sizes.velocity);
            all = self.graph.add(all, turning);
        }
        let all = self.graph.opaque(all);
        let tolerance = self.tolerance(sizes.nearness, 2 + order as i32);
        for mut redundant in std::mem::take(&mut self.redundant) {
            let rows = redundant.paired.map_or(vec![redundant.row], |paired| paired.rows.to_vec());
            for (index, row) in rows.into_iter().enumerate() {
                let mut rest = self.graph.neg(right[row]);
                for (k, entry) in self.system.equations[row].phi_q.clone() {
                    let entry = self.known_value(entry);
                    let term = self.graph.mul(entry, solution[k as usize]);
                    rest = self.graph.add(rest, term);
                }
                // Where Φₜ is a small difference of large terms (a driver that reverses), its rounding error is that of
                // the terms.
                let (terms, share) =
                    (sum_of_squared_terms(&mut self.graph, right[row], 6), self.graph.number(TERM_WEIGHT));
                let (terms, size) = (self.graph.mul(share, terms), self.graph.mul(redundant.sizes[index], all));
                let (square, size) = (self.graph.square(rest), self.graph.add(size, terms));
                self.subtract_residual(&mut redundant, square, size, tolerance);
            }
            self.redundant.push(redundant);
        }
        self.redundant_sizes = Some(sizes);
    }

    /// Subtracts (`square`/`size`)/`tolerance` from the margin and writes it.
    fn subtract_residual(&mut self, redundant: &mut RedundantRow, square: ExprId, size: ExprId, tolerance: ExprId) {
        let least = self.graph.number(DENOMINATOR_FLOOR);
        let size = self.graph.add(size, least);
        let share = self.graph.div(square, size);
        let share = self.graph.div(share, tolerance);
        let margin = self.graph.sub(redundant.margin, share);
        redundant.margin = self.graph.opaque(margin);
        self.write(Slot::Margin(redundant.place), redundant.margin);
    }

    /// τ² at a level, (TOLERANCE² + ROUNDING² · nearness^level) for `f64`, scaled to the precision of the scalar type.
    fn tolerance(&mut self, nearness: ExprId, level: i32) -> ExprId {
        let graph = &mut self.graph;
        let (tolerance, rounding) = (graph.number(TOLERANCE * TOLERANCE), graph.number(ROUNDING * ROUNDING));
        let power = graph.powi(nearness, level);
        let rounding = graph.mul(rounding, power);
        let sum = graph.add(tolerance, rounding);
        let coarseness = graph.symbol(Symbol::Coarseness);
        let sum = graph.mul(coarseness, sum);
        graph.opaque(sum)
    }

    fn sizes(&mut self) -> Sizes {
        let length = self.squared_length();
        let one = self.graph.number(1.0);
        let mut weights = Vec::new();
        for (k, coordinate) in self.system.set.coordinates.iter().enumerate() {
            weights.push(match coordinate.kind {
                kind if kind.is_length() => length,
                CoordinateKind::Pose(..) => one,
                CoordinateKind::Scalar => {
                    let q = self.value_of(k as u32);
                    let square = self.graph.square(q);
                    self.graph.add(one, square)
                }
            });
        }
        let mut nearness = one;
        for margin in self.margins.clone() {
            let magnitude = self.graph.call(Function::Abs, margin);
            let inverse = self.graph.div(one, magnitude);
            nearness = self.graph.add(nearness, inverse);
        }
        let nearness = self.graph.opaque(nearness);
        Sizes { weights, nearness, velocity: one }
    }

    /// The square of a length taken from the rows that contain both lengths and angles; if there are no such rows, the
    /// sum of the squares of all coordinates that are lengths.
    fn squared_length(&mut self) -> ExprId {
        let coordinates = &self.system.set.coordinates;
        let mut sums = [self.graph.zero(); 2];
        for equation in &self.system.equations {
            let kind = |k: u32| match coordinates[k as usize].kind {
                CoordinateKind::Pose(..) => Some(usize::from(coordinates[k as usize].kind.is_length())),
                CoordinateKind::Scalar => None,
            };
            let holds = |wanted| equation.phi_q.iter().any(|(k, _)| kind(*k) == Some(wanted));
            if !(holds(0) && holds(1)) {
                continue;
            }
            for (k, entry) in equation.phi_q.clone() {
                let Some(kind) = kind(k) else { continue };
                // The arms of a row, and not their components at this pose, which may all be 0.
                let square = match kind {
                    0 => squared_size_anywhere(&mut self.graph, entry, 6),
                    _ => self.graph.square(entry),
                };
                let square = self.known_value(square);
                sums[kind] = self.graph.add(sums[kind], square);
            }
        }
        let least = self.graph.number(DENOMINATOR_FLOOR);
        let square = if self.graph.is_zero(sums[0]) {
            let lengths = (0..).zip(coordinates).filter(|(_, coordinate)| coordinate.kind.is_length());
            let mut sum = self.graph.zero();
            for (k, _) in lengths {
                let value = self.value_of(k);
                let square = self.graph.square(value);
                sum = self.graph.add(sum, square);
            }
            sum
        } else {
            self.graph.div(sums[0], sums[1])
        };
        let square = self.graph.add(square, least);
        self.graph.opaque(square)
    }

    /// Σ Φᵣₖ² wₖ of a row r.
    fn size(&mut self, row: usize, weights: &[ExprId]) -> ExprId {
        let mut size = self.graph.zero();
        for (k, entry) in self.system.equations[row].phi_q.clone() {
            let entry = self.known_value(entry);
            let square = self.graph.square(entry);
            let square = self.graph.mul(square, weights[k as usize]);
            size = self.graph.add(size, square);
        }
        self.graph.opaque(size)
    }
}

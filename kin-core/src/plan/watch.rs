//! Rows that a plan does without, and whether what it gives satisfies them all the same.
//!
//! ```text
//! margin = 1 − (ρ/τ)² − (ρ̇/τ̇)² − (ρ̈/τ̈)²
//! ρ² = Φᵣ²/Σ Φᵣₖ² wₖ,  ρ̇² = (Σ Φᵣₖ q̇ₖ + Φᵣₜ)²/(Σ Φᵣₖ² wₖ · V²),  ρ̈² = (Σ Φᵣₖ q̈ₖ − γᵣ)²/(Σ Φᵣₖ² wₖ · A²),
//! all of them with a little of the squared terms of Φᵣ, Φᵣₜ and γᵣ beside the sums,
//! V² = Σ q̇ₖ²/wₖ,  A² = Σ q̈ₖ²/wₖ + V⁴
//! ```
//!
//! √wₖ is what counts as a coordinate of size one: a radian; for x and y the length that the rows hold between lengths and
//! angles; for a scalar 1 or more. So ρ has no unit, and is about by how much the row's joint is apart beside the size of
//! the mechanism. τ is [`TOLERANCE`], and more beside limits, where what is solved is known less well.

use super::build::{Build, Sizes, Watched};
use super::closures::{SHARE, squared_terms};
use super::reduce::Agreeing;
use crate::constraint::CoordinateKind;
use crate::expr::{ExprId, Symbol};
use crate::mechanism::Function;
use crate::program::Slot;

/// Misses below this are no contradiction.
pub const TOLERANCE: f64 = 3e-11;

/// What rounding makes of a solution far from limits; 1/√margin times that beside one, and once more for every order.
const ROUNDING: f64 = 1e-13;

/// What no size is smaller than, so that 0 of 0 is 0.
const LEAST: f64 = f32::MIN_POSITIVE as f64;

impl Build<'_> {
    /// The rows to watch, with a margin each.
    pub(super) fn watch(&mut self, left_out: &[usize], agreeing: &[Agreeing]) {
        let steps = self.listed.watched(&self.system.set, left_out);
        for (&row, step) in left_out.iter().zip(steps) {
            let place = self.listed.margin(step);
            let agreeing = agreeing.iter().find(|agreeing| agreeing.rows[1] == row).copied();
            let margin = self.graph.number(1.0);
            self.watched.push(Watched { row, agreeing, place, margin, sizes: Vec::new() });
        }
    }

    /// The margins as far as they belong to q, once it is known with the margins of all steps.
    pub(super) fn watch_positions(&mut self) {
        if self.watched.is_empty() {
            return;
        }
        let sizes = self.sizes();
        let tolerance = self.tolerance(sizes.nearness, 1);
        for mut watched in std::mem::take(&mut self.watched) {
            let rows = watched.agreeing.map_or(vec![watched.row], |agreeing| agreeing.rows.to_vec());
            watched.sizes = rows.iter().map(|&row| self.size(row, &sizes.weights)).collect();
            let (miss, size) = match watched.agreeing {
                // The angle that both give makes the most of them: it is the length that says whether they agree.
                Some(Agreeing { difference, square, .. }) => {
                    let [difference, square] = [difference, square].map(|e| self.known_value(e));
                    (difference, self.graph.square(square))
                }
                None => {
                    let phi = self.system.equations[watched.row].phi;
                    let terms = squared_terms(&mut self.graph, phi, 6);
                    let [phi, terms] = [phi, terms].map(|e| self.known_value(e));
                    let share = self.graph.number(SHARE);
                    let terms = self.graph.mul(share, terms);
                    (phi, self.graph.add(watched.sizes[0], terms))
                }
            };
            let square = self.graph.square(miss);
            self.take_away(&mut watched, square, size, tolerance);
            self.watched.push(watched);
        }
        self.sizes_of_watched = Some(sizes);
    }

    /// The margins with what belongs to q̇ (`order` 0) or q̈ (`order` 1): `solution` of Φ_q x = `right`.
    pub(super) fn watch_rates(&mut self, order: usize, right: &[ExprId], solution: &[ExprId]) {
        let Some(mut sizes) = self.sizes_of_watched.take() else { return };
        let mut all = self.graph.zero();
        for (&x, &weight) in solution.iter().zip(&sizes.weights) {
            let square = self.graph.square(x);
            let square = self.graph.div(square, weight);
            all = self.graph.add(all, square);
        }
        if order == 0 {
            sizes.velocity = self.graph.whole(all);
        } else {
            let turning = self.graph.square(sizes.velocity);
            all = self.graph.add(all, turning);
        }
        let all = self.graph.whole(all);
        let tolerance = self.tolerance(sizes.nearness, 2 + order as i32);
        for mut watched in std::mem::take(&mut self.watched) {
            let rows = watched.agreeing.map_or(vec![watched.row], |agreeing| agreeing.rows.to_vec());
            for (place, row) in rows.into_iter().enumerate() {
                let mut rest = self.graph.neg(right[row]);
                for (k, entry) in self.system.equations[row].phi_q.clone() {
                    let entry = self.known_value(entry);
                    let term = self.graph.mul(entry, solution[k as usize]);
                    rest = self.graph.add(rest, term);
                }
                // Where Φₜ is a small difference of large terms, as a motion turns round, rounding is that of the terms.
                let (terms, share) = (squared_terms(&mut self.graph, right[row], 6), self.graph.number(SHARE));
                let (terms, size) = (self.graph.mul(share, terms), self.graph.mul(watched.sizes[place], all));
                let (square, size) = (self.graph.square(rest), self.graph.add(size, terms));
                self.take_away(&mut watched, square, size, tolerance);
            }
            self.watched.push(watched);
        }
        self.sizes_of_watched = Some(sizes);
    }

    /// Takes `square`/`size` over `tolerance` from the margin, and writes it.
    fn take_away(&mut self, watched: &mut Watched, square: ExprId, size: ExprId, tolerance: ExprId) {
        let least = self.graph.number(LEAST);
        let size = self.graph.add(size, least);
        let share = self.graph.div(square, size);
        let share = self.graph.div(share, tolerance);
        let margin = self.graph.sub(watched.margin, share);
        watched.margin = self.graph.whole(margin);
        self.write(Slot::Margin(watched.place), watched.margin);
    }

    /// τ² at a level, for the scalar at hand: TOLERANCE² + ROUNDING² · nearness^level of an `f64`.
    fn tolerance(&mut self, nearness: ExprId, level: i32) -> ExprId {
        let graph = &mut self.graph;
        let (tolerance, rounding) = (graph.number(TOLERANCE * TOLERANCE), graph.number(ROUNDING * ROUNDING));
        let power = graph.powi(nearness, level);
        let rounding = graph.mul(rounding, power);
        let sum = graph.add(tolerance, rounding);
        let coarseness = graph.symbol(Symbol::Coarseness);
        let sum = graph.mul(coarseness, sum);
        graph.whole(sum)
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
        let nearness = self.graph.whole(nearness);
        Sizes { weights, nearness, velocity: one }
    }

    /// The square of the length that rows hold between lengths and angles; where none holds both, that of all lengths.
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
                if let Some(kind) = kind(k) {
                    let entry = self.known_value(entry);
                    let square = self.graph.square(entry);
                    sums[kind] = self.graph.add(sums[kind], square);
                }
            }
        }
        let least = self.graph.number(LEAST);
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
        self.graph.whole(square)
    }

    /// Σ Φᵣₖ² wₖ.
    fn size(&mut self, row: usize, weights: &[ExprId]) -> ExprId {
        let mut size = self.graph.zero();
        for (k, entry) in self.system.equations[row].phi_q.clone() {
            let entry = self.known_value(entry);
            let square = self.graph.square(entry);
            let square = self.graph.mul(square, weights[k as usize]);
            size = self.graph.add(size, square);
        }
        self.graph.whole(size)
    }
}

//! Builds expressions from the tree of a plan: q step by step, then q̇ and q̈ as solutions of Φ_q x = b along the same
//! tree.
//!
//! An angle closure gives cosine and sine; the angle itself is needed for the result only (atan2, plus the number of
//! whole turns that brings it nearest to its start value). Every root is multiplied by the sign of the mode and taken
//! of the magnitude of its argument, so that no result is NaN; the margin shows whether the result is valid.

use super::closures::{self, angle_branch_value, circle_branch_value, inverse, quadratic_branch_value};
use super::dense;
use super::known::turned;
use super::rates::Rates;
use super::reduce::PairedRows;
use super::rewrite::Turned;
use super::state::{Build, Divisor, SignedStep, Stage};
use super::step::StepId;
use super::tree::{Block, BlockPart, Core, Pair, PairValue, Pivot, SolutionMethod};
use crate::expr::{ExprId, Symbol, total_derivatives};
use crate::hash::FastMap;
use crate::program::Slot;
use std::collections::BTreeMap;

/// The indices of the first stages of q̇ and of q̈.
pub(super) struct FirstStages {
    pub(super) velocity: usize,
    pub(super) acceleration: usize,
}

/// Expressions for the solution x of Φ_q x = b at a given q.
pub(super) struct LinearSolution {
    /// The entries of x.
    pub(super) solution: Vec<(Slot, ExprId)>,
    /// Values that are 0 where a divisor is 0.
    pub(super) regular: Vec<ExprId>,
    /// The margins of cores, by their first row.
    pub(super) margins: BTreeMap<usize, ExprId>,
    /// The values whose signs are the orientations of cores, by their first row; see
    /// [`dense::DenseSolution::orientation`].
    pub(super) orientations: BTreeMap<usize, ExprId>,
}

impl Build<'_> {
    /// Writes all stages of q, q̇ and q̈ and the margins of the redundant rows. `linear` is the solution of Φ_q x = b at a
    /// given q.
    pub(super) fn write_levels(
        &mut self,
        tree: &Block,
        (left_out, paired): (&[usize], &[PairedRows]),
        linear: &LinearSolution,
    ) -> FirstStages {
        self.block(tree);
        self.divisor_margins();
        self.add_redundant_rows(left_out, paired);
        let mut starts = [0; 2];
        for (order, start) in starts.iter_mut().enumerate() {
            let right: Vec<ExprId> = (self.system.equations.iter())
                .map(|equation| if order == 0 { equation.phi_t } else { equation.gamma })
                .collect();
            let right: Vec<ExprId> = right.into_iter().map(|e| self.known_value(e)).collect();
            let right = if order == 0 { right.into_iter().map(|e| self.graph.neg(e)).collect() } else { right };
            let (solution, margins) = self.rates(tree, right.clone());
            if order == 0 {
                self.iteration_margins([&margins, &linear.margins]);
                self.check_positions();
            }
            *start = self.stages.len();
            let slot = |k| if order == 0 { Slot::Velocity(k) } else { Slot::Acceleration(k) };
            self.stages.push(Stage::Closed(solution.iter().enumerate().map(|(k, e)| (slot(k), *e)).collect()));
            let solution: Vec<ExprId> = solution.into_iter().map(|e| self.graph.opaque(e)).collect();
            self.check_rates(order, &right, &solution);
            self.known.rates = (0..).zip(solution).collect();
        }
        self.number_margins();
        let [velocity, acceleration] = starts;
        FirstStages { velocity, acceleration }
    }

    /// The solution x of Φ_q x = `right` and the margins of its cores, once all coordinates are known.
    fn rates(&mut self, tree: &Block, right: Vec<ExprId>) -> (Vec<ExprId>, BTreeMap<usize, ExprId>) {
        let mut entries = Vec::new();
        for equation in &self.system.equations {
            let row: Vec<(u32, ExprId)> = equation.phi_q.clone();
            entries.push(row.into_iter().map(|(k, e)| (k, self.known_value(e))).collect());
        }
        let known = constants(tree).into_iter().map(|e| (e, self.known_value(e))).collect();
        let mut rates = Rates::new(&mut self.graph, entries, right, &self.system.set.coordinates, known);
        rates.block(tree);
        let zero = rates.graph.zero();
        (rates.solution.iter().map(|value| value.unwrap_or(zero)).collect(), rates.margins)
    }

    /// Records the value of a coordinate, and its cosine and sine if they were found without the angle.
    fn record_solution(&mut self, k: u32, value: ExprId, turned: Option<Turned>) {
        let value = self.graph.opaque(value);
        self.known.values.insert(k, value);
        self.known.turns.insert(k, turned.unwrap_or(Turned::Angle(value)));
        self.write(Slot::Position(k as usize), value);
    }

    fn block(&mut self, block: &Block) {
        for part in &block.parts {
            match part {
                BlockPart::Core(core) => self.core(core),
                BlockPart::Block(block) => self.block(block),
                BlockPart::Pair(pair) => {
                    self.block(&pair.inner);
                    self.pair(pair);
                }
            }
        }
        for &Pivot { row, coordinate, coefficient, value } in block.pivots.iter().rev() {
            let step = self.listed.giving(coordinate);
            let known = self.known_value(coefficient);
            self.divide_by_coefficient(step, (vec![row], coordinate), [known, coefficient]);
            let known = self.known_value(value);
            let turned = turned(&mut self.graph, &self.known.turns, &self.known.rewritten, value);
            self.record_solution(coordinate, known, Some(turned));
        }
    }

    fn pair(&mut self, pair: &Pair) {
        let step = self.listed.giving(pair.coordinate);
        match &pair.value {
            PairValue::Linear { value, by, square } => {
                if square.is_none() {
                    let by = by.map(|e| self.known_value(e));
                    let square = self.graph.plain_dot(by, by);
                    self.divide(step, pair, square, by.to_vec());
                }
                let value = self.known_value(*value);
                self.record_solution(pair.coordinate, value, None);
            }
            PairValue::Angle { turn, cos, sin, size, vectors, .. } => {
                if !self.graph.depends(*size).is_static() || vectors.is_some() {
                    let size = self.known_value(*size);
                    match vectors.map(|vectors| vectors.map(|e| self.known_value(e))) {
                        Some(vectors) if self.graph.literal(size).is_none() => {
                            let margin = closures::squared_sine(&mut self.graph, size, vectors);
                            _ = self.write_margin(step, margin);
                        }
                        Some(_) => {}
                        None => self.divide(step, pair, size, Vec::new()),
                    }
                }
                let found = [*cos, *sin].map(|e| self.known_value(e)).map(|e| self.graph.opaque(e));
                let size = self.known_value(*size);
                let inverse = inverse(&mut self.graph, size);
                self.angle(pair.coordinate, turn, found, inverse);
            }
        }
    }

    fn divide(&mut self, step: StepId, pair: &Pair, square: ExprId, parts: Vec<ExprId>) {
        let (rows, unknown) = (pair.rows.to_vec(), pair.coordinate);
        self.divisors.push(Divisor { step, rows, unknown, square, parts, signed: None });
    }

    /// An angle from the cosine and sine of `turn`, a sum of integer multiples of angles; `x` and `y` are these
    /// multiplied by a positive number whose inverse is `scale`. The sum is determined up to whole turns, and the
    /// unknown angle up to whole turns divided by its multiple; the value nearest to the start value is taken.
    fn angle(&mut self, k: u32, turn: &[(u32, i32)], [x, y]: [ExprId; 2], scale: ExprId) {
        let graph = &mut self.graph;
        let [cos, sin] = [x, y].map(|e| graph.mul(e, scale)).map(|e| graph.opaque(e));
        let (mut start, mut other_angles) = (graph.zero(), graph.zero());
        let (mut pair, mut multiple) = ([cos, sin], 1);
        for &(other, n) in turn {
            let factor = graph.number(f64::from(n));
            if other == k {
                multiple = n;
                let symbol = graph.symbol(Symbol::Start(k));
                start = graph.mul(factor, symbol);
                continue;
            }
            let value = self.known.values.get(&other).copied().unwrap_or(factor);
            let term = graph.mul(factor, value);
            other_angles = graph.add(other_angles, term);
            if let Some(turn) = self.known.turns.get(&other).copied() {
                // The rotation by each of the other angles is undone.
                let (c, s) = (turn.cos(graph), turn.sin(graph));
                let s = if n > 0 { graph.neg(s) } else { s };
                for _ in 0..n.unsigned_abs() {
                    let [x, y] = pair;
                    pair = [graph.plain_cross([c, s], [y, x]), graph.plain_dot([s, c], [x, y])];
                }
            }
        }
        let (angle, near) = (graph.atan2(y, x), graph.add(start, other_angles));
        let angle = graph.nearest(angle, near);
        let rest = graph.sub(angle, other_angles);
        let part = graph.number(1.0 / f64::from(multiple));
        let value = graph.mul(part, rest);
        let sin = if multiple < 0 { graph.neg(pair[1]) } else { pair[1] };
        // The cosine and sine of a multiple of the angle are not those of the angle.
        self.record_solution(k, value, (multiple.abs() == 1).then_some(Turned::Pair([pair[0], sin])));
    }

    fn core(&mut self, core: &Core) {
        let step = self.listed.giving(core.coordinates[0]);
        match &core.method {
            SolutionMethod::Linear { matrix: given, constant } => {
                let matrix: Vec<Vec<ExprId>> =
                    given.iter().map(|row| row.iter().map(|&e| self.known_value(e)).collect()).collect();
                let right: Vec<ExprId> = constant.iter().map(|&e| self.known_value(e)).collect();
                let right = right.into_iter().map(|e| self.graph.neg(e)).collect();
                let kinds = dense::kinds(&self.system.set.coordinates, &core.coordinates);
                let dense::DenseSolution { solutions, margin, .. } =
                    dense::solve(&mut self.graph, &matrix, &[right], &kinds);
                match (matrix.as_slice(), margin) {
                    ([row], _) => {
                        let rows = self.listed.step(step).rows.iter().copied().collect();
                        let coefficients = [row[0], given[0][0]];
                        self.divide_by_coefficient(step, (rows, core.coordinates[0]), coefficients);
                    }
                    (_, Some(margin)) => {
                        let margin = self.write_margin(step, margin);
                        let orientation = dense::solve(&mut self.graph, given, &[], &kinds).orientation;
                        if let Some(value) = orientation.filter(|&value| !self.graph.depends(value).is_static()) {
                            self.signed.push(SignedStep { value, step, margin });
                        }
                    }
                    (_, None) => {}
                }
                for (&k, value) in core.coordinates.iter().zip(solutions.into_iter().flatten()) {
                    self.record_solution(k, value, None);
                }
            }
            SolutionMethod::Newton { residuals } => self.newton(step, core, residuals),
            SolutionMethod::Angle { times, a, b, c } => {
                let k = core.coordinates[0];
                let value = angle_branch_value(&mut self.graph, (k, *times), [*a, *b]);
                let (mode, index) = self.closure(step, value);
                let [a, b, c] = [*a, *b, *c].map(|e| self.known_value(e)).map(|e| self.graph.opaque(e));
                let (turned, inverse, margin) = closures::angle(&mut self.graph, mode, [a, b, c]);
                self.write(Slot::Margin(index), margin);
                self.angle(k, &[(k, *times)], turned, inverse);
            }
            SolutionMethod::Quadratic { a, b, c } => {
                let k = core.coordinates[0];
                let value = quadratic_branch_value(&mut self.graph, k, [*a, *b, *c]);
                let (mode, index) = self.closure(step, value);
                let known = [*a, *b, *c].map(|e| self.known_value(e));
                let (value, margin) = closures::quadratic(&mut self.graph, mode, known);
                self.write(Slot::Margin(index), margin);
                self.record_solution(k, value, None);
            }
            SolutionMethod::Circle { e, l, k, n, m, second } => {
                let at = [core.coordinates[0], core.coordinates[1]];
                let value = circle_branch_value(&mut self.graph, at, [*e, l[0], l[1], *k, n[0], n[1]]);
                let (mode, index) = self.closure(step, value);
                let known = [*e, l[0], l[1], *k, n[0], n[1], *m].map(|e| self.known_value(e));
                let second = second.map(|f| self.known_value(f));
                let ([x, y], margin) = closures::circle(&mut self.graph, mode, known, second);
                self.write(Slot::Margin(index), margin);
                self.record_solution(at[0], x, None);
                self.record_solution(at[1], y, None);
            }
        }
    }

    /// Adds a mode and its margin to a step. `value` is the branch value, whose sign is the mode of a known
    /// configuration.
    fn closure(&mut self, step: StepId, value: ExprId) -> (ExprId, usize) {
        self.branch_values.push(value);
        let place = self.listed.margin(step);
        let mode = self.listed.mode(self.system, step, place);
        (self.graph.symbol(Symbol::Mode(mode as u32)), place)
    }

    fn newton(&mut self, step: StepId, core: &Core, residuals: &[ExprId]) {
        let jets = total_derivatives(&mut self.graph, residuals);
        for &k in &core.coordinates {
            let unknown = self.graph.symbol(Symbol::Unknown(k));
            self.record_solution(k, unknown, None);
        }
        // The outputs of the unknowns are moved to a stage after the iteration.
        let written = match self.stages.last_mut() {
            Some(Stage::Closed(outputs)) => outputs.split_off(outputs.len() - core.coordinates.len()),
            _ => Vec::new(),
        };
        let right: Vec<ExprId> = residuals.iter().map(|&e| self.known_value(e)).collect();
        let mut matrix = Vec::new();
        for jet in jets {
            let zero = self.graph.zero();
            let entry = |k: u32| jet.gradient.iter().find(|(other, _)| *other == k).map_or(zero, |(_, e)| *e);
            let row: Vec<ExprId> = core.coordinates.iter().map(|&k| entry(k)).collect();
            matrix.push(row.into_iter().map(|e| self.known_value(e)).collect::<Vec<_>>());
        }
        let kinds = dense::kinds(&self.system.set.coordinates, &core.coordinates);
        let corrections = dense::solution(&mut self.graph, &matrix, &right, &kinds);
        let (unknowns, converged) = (core.coordinates.clone(), self.iterations);
        self.stages.push(Stage::Newton { unknowns, corrections, converged });
        self.stages.push(Stage::Closed(written));
        self.iterations += 1;
        let place = self.listed.margin(step);
        self.pending.push((core.rows[0], place, converged));
        self.iterated.push((core.rows[0], step, place));
    }

    /// The solution x of Φ_q x = b at a given q, where the entries of b are symbols.
    pub(super) fn linear_solution(&mut self, tree: &Block) -> LinearSolution {
        let right = (0..self.system.equations.len()).map(|row| self.graph.symbol(Symbol::Right(row as u32))).collect();
        let entries: Vec<BTreeMap<u32, ExprId>> =
            self.system.equations.iter().map(|equation| equation.phi_q.iter().copied().collect()).collect();
        let coordinates = &self.system.set.coordinates;
        let mut rates = Rates::new(&mut self.graph, entries.clone(), right, coordinates, FastMap::default());
        rates.block(tree);
        rates.record_single_unknowns(tree, &entries);
        let zero = rates.graph.zero();
        let solution = rates.solution.iter().enumerate().map(|(k, value)| (Slot::Entry(k), value.unwrap_or(zero)));
        let solution = solution.collect();
        let Rates { regular, margins, orientations, .. } = rates;
        LinearSolution { solution, regular, margins, orientations }
    }
}

/// The expressions of the tree that the solution of Φ_q x = b uses: squared lengths of rotated vectors, factors of
/// exchanges.
fn constants(block: &Block) -> Vec<ExprId> {
    let (mut out, mut open) = (Vec::new(), vec![block]);
    while let Some(block) = open.pop() {
        for part in &block.parts {
            match part {
                BlockPart::Core(_) => {}
                BlockPart::Block(block) => open.push(block),
                BlockPart::Pair(pair) => {
                    if let PairValue::Angle { square: Some(square), .. }
                    | PairValue::Linear { square: Some(square), .. } = pair.value
                    {
                        out.push(square);
                    }
                    out.extend(pair.exchanges.iter().flat_map(|exchange| exchange.factors));
                    open.push(&pair.inner);
                }
            }
        }
    }
    out
}

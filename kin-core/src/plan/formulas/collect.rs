//! Lists the parts of a tree in order of solution, and collects the expressions whose derivatives are needed.

use crate::expr::{ExprId, Graph, Symbol};
use crate::plan::step::StepId;
use crate::plan::steps::StepList;
use crate::plan::tree::{Block, BlockPart, Core, PairValue, SolutionMethod};

/// A part that is solved at once. Its expressions are given as indices of the list of roots.
pub(super) struct Item {
    pub(super) step: StepId,
    pub(super) method: PartSolution,
}

/// The method of solution of a part.
pub(super) enum PartSolution {
    /// A coordinate is given by an expression.
    Explicit { k: u32, value: usize },
    /// A linear system; its residuals are differentiated.
    Linear { unknowns: Vec<u32>, residuals: Vec<usize>, matrix: Vec<Vec<ExprId>>, right: Vec<ExprId> },
    /// Residuals that Newton's iteration brings to zero.
    Newton { unknowns: Vec<u32>, residuals: Vec<usize> },
    /// The equation a cos nφ + b sin nφ = c.
    Angle { k: u32, times: i32, coefficients: [usize; 3] },
    /// The equation a x² + b x + c = 0.
    Quadratic { k: u32, coefficients: [usize; 3] },
    /// A circle e(x² + y²) + l·(x, y) + k = 0 and a line n·(x, y) + m = 0, with their residuals.
    Circle { at: [u32; 2], coefficients: [usize; 7], residuals: [usize; 2] },
    /// The cosine and sine of a sum of multiples of angles, both multiplied by a positive number.
    Turn { k: u32, turn: Vec<(u32, i32)>, cos: usize, sin: usize },
}

struct Collector<'a> {
    graph: &'a mut Graph,
    listed: &'a StepList,
    items: Vec<Item>,
    roots: Vec<ExprId>,
}

pub(super) fn collect(graph: &mut Graph, listed: &StepList, tree: &Block) -> (Vec<Item>, Vec<ExprId>) {
    let mut collector = Collector { graph, listed, items: Vec::new(), roots: Vec::new() };
    collector.block(tree);
    (collector.items, collector.roots)
}

impl Collector<'_> {
    fn block(&mut self, block: &Block) {
        for part in &block.parts {
            match part {
                BlockPart::Core(core) => self.core(core),
                BlockPart::Block(block) => self.block(block),
                BlockPart::Pair(pair) => {
                    self.block(&pair.inner);
                    let k = pair.coordinate;
                    let step = self.listed.giving(k);
                    let method = match &pair.value {
                        PairValue::Linear { value, .. } => PartSolution::Explicit { k, value: self.root(*value) },
                        PairValue::Angle { turn, cos, sin, .. } => {
                            PartSolution::Turn { k, turn: turn.clone(), cos: self.root(*cos), sin: self.root(*sin) }
                        }
                    };
                    self.items.push(Item { step, method });
                }
            }
        }
        for pivot in block.pivots.iter().rev() {
            let step = self.listed.giving(pivot.coordinate);
            let method = PartSolution::Explicit { k: pivot.coordinate, value: self.root(pivot.value) };
            self.items.push(Item { step, method });
        }
    }

    fn root(&mut self, id: ExprId) -> usize {
        self.roots.push(id);
        self.roots.len() - 1
    }

    fn core(&mut self, core: &Core) {
        let step = self.listed.giving(core.coordinates[0]);
        let unknowns = core.coordinates.clone();
        let method = match &core.method {
            SolutionMethod::Linear { matrix, constant } => {
                let right = constant.iter().map(|&e| self.graph.neg(e)).collect();
                let rows = matrix.iter().zip(constant);
                let residuals = rows.map(|(row, &constant)| self.affine(row, &unknowns, constant)).collect();
                PartSolution::Linear { unknowns, residuals, matrix: matrix.clone(), right }
            }
            SolutionMethod::Newton { residuals } => {
                PartSolution::Newton { unknowns, residuals: residuals.iter().map(|&e| self.root(e)).collect() }
            }
            SolutionMethod::Angle { times, a, b, c } => {
                let coefficients = [*a, *b, *c].map(|e| self.root(e));
                PartSolution::Angle { k: unknowns[0], times: *times, coefficients }
            }
            SolutionMethod::Quadratic { a, b, c } => {
                let coefficients = [*a, *b, *c].map(|e| self.root(e));
                PartSolution::Quadratic { k: unknowns[0], coefficients }
            }
            SolutionMethod::Circle { e, l, k, n, m, .. } => {
                let at = [unknowns[0], unknowns[1]];
                let [x, y] = at.map(|k| self.graph.symbol(Symbol::Coordinate(k)));
                let squares = self.graph.plain_dot([x, y], [x, y]);
                let round = self.graph.mul(*e, squares);
                let circle = self.affine(l, &at, *k);
                let whole = self.graph.add(round, self.roots[circle]);
                self.roots[circle] = whole;
                let line = self.affine(n, &at, *m);
                let coefficients = [*e, l[0], l[1], *k, n[0], n[1], *m].map(|e| self.root(e));
                PartSolution::Circle { at, coefficients, residuals: [circle, line] }
            }
        };
        self.items.push(Item { step, method });
    }

    /// Adds the expression row · unknowns + constant to the roots.
    fn affine(&mut self, row: &[ExprId], unknowns: &[u32], constant: ExprId) -> usize {
        let mut sum = constant;
        for (&k, &entry) in unknowns.iter().zip(row) {
            let x = self.graph.symbol(Symbol::Coordinate(k));
            let term = self.graph.mul(entry, x);
            sum = self.graph.add(sum, term);
        }
        self.root(sum)
    }
}

//! State of a solution while its expressions are built: stages, known coordinates, divisors, margins, redundant rows.

use super::known::Known;
use super::reduce::PairedRows;
use super::step::StepId;
use super::steps::StepList;
use crate::expr::{ExprId, Graph, Symbol};
use crate::program::Slot;
use crate::system::KinematicSystem;

/// A stage of the solution: expressions to compute, or an iteration.
pub(super) enum Stage {
    /// The outputs: each slot with the expression that is stored there.
    Closed(Vec<(Slot, ExprId)>),
    /// Newton's iteration: the unknowns; for each the correction that is subtracted from its current value; the index
    /// of the saved value that is 1 if the iteration has converged and 0 otherwise.
    Newton { unknowns: Vec<u32>, corrections: Vec<ExprId>, converged: u32 },
}

/// A divisor of a step: the step, its rows, the unknown that is found, the square of the divisor, and the expressions
/// from which the divisor is formed.
pub(super) struct Divisor {
    pub(super) step: StepId,
    pub(super) rows: Vec<usize>,
    pub(super) unknown: u32,
    pub(super) square: ExprId,
    pub(super) parts: Vec<ExprId>,
    /// The divisor of a linear step at a given q, whose sign changes where the step is singular.
    pub(super) signed: Option<ExprId>,
}

/// A linear step that is singular for some configurations.
pub(super) struct SignedStep {
    /// Its branch value, whose sign changes where it is singular.
    pub(super) value: ExprId,
    pub(super) step: StepId,
    /// The index of its margin, which is 0 where the branch value is 0.
    pub(super) margin: usize,
}

/// A redundant row, with which the solution is checked.
pub(super) struct RedundantRow {
    pub(super) row: usize,
    /// The kept row that gives an angle together with this row, if there is one.
    pub(super) paired: Option<PairedRows>,
    /// The index of the row's margin.
    pub(super) place: usize,
    /// The margin so far; each level (position, velocity, acceleration) subtracts its residual.
    pub(super) margin: ExprId,
    /// Σ Φᵣₖ² wₖ of the row r, or of both rows in `paired`.
    pub(super) sizes: Vec<ExprId>,
}

/// Sizes that the margins of all redundant rows share.
pub(super) struct Sizes {
    /// The weights wₖ.
    pub(super) weights: Vec<ExprId>,
    /// 1 + Σ 1/|margin| over the margins of all steps, which estimates the inverse squared distance from the nearest
    /// limit.
    pub(super) nearness: ExprId,
    /// V², the squared size of the velocity.
    pub(super) velocity: ExprId,
}

/// Builds the stages of the solution from the tree.
pub(super) struct Build<'a> {
    pub(super) system: &'a KinematicSystem,
    pub(super) graph: Graph,
    pub(super) known: Known,
    pub(super) stages: Vec<Stage>,
    /// The steps with their modes and margins.
    pub(super) listed: StepList,
    /// Number of iterations; for each, one saved value shows whether it has converged.
    pub(super) iterations: u32,
    /// For every iteration whose margin is still to be written: its first row, the index of its margin, and the index
    /// of the saved value that shows whether it has converged.
    pub(super) pending: Vec<(usize, usize, u32)>,
    /// For every iteration: its first row, its step and the index of its margin.
    pub(super) iterated: Vec<(usize, StepId, usize)>,
    /// The linear steps that are singular for some configurations.
    pub(super) signed: Vec<SignedStep>,
    /// The divisors whose margins are still to be written.
    pub(super) divisors: Vec<Divisor>,
    /// The branch values of all closures at a given q.
    pub(super) branch_values: Vec<ExprId>,
    /// All margins written so far.
    pub(super) margins: Vec<ExprId>,
    /// The redundant rows, and the sizes that their margins share.
    pub(super) redundant: Vec<RedundantRow>,
    pub(super) redundant_sizes: Option<Sizes>,
}

impl<'a> Build<'a> {
    pub(super) fn new(system: &'a KinematicSystem, graph: Graph, listed: StepList) -> Self {
        let known = Known::default();
        let (stages, pending, branch_values) = (vec![Stage::Closed(Vec::new())], Vec::new(), Vec::new());
        let (margins, redundant, redundant_sizes) = (Vec::new(), Vec::new(), None);
        Self {
            system,
            graph,
            known,
            stages,
            listed,
            iterations: 0,
            pending,
            iterated: Vec::new(),
            signed: Vec::new(),
            divisors: Vec::new(),
            branch_values,
            margins,
            redundant,
            redundant_sizes,
        }
    }

    /// Rewrites an expression of the system in terms of the known coordinates.
    pub(super) fn known_value(&mut self, id: ExprId) -> ExprId {
        self.known.value(&mut self.graph, id)
    }

    /// The expression of a known coordinate.
    pub(super) fn value_of(&mut self, k: u32) -> ExprId {
        let symbol = self.graph.symbol(Symbol::Coordinate(k));
        self.known_value(symbol)
    }

    pub(super) fn write(&mut self, slot: Slot, value: ExprId) {
        if let Slot::Margin(_) = slot {
            self.margins.push(value);
        }
        match self.stages.last_mut() {
            Some(Stage::Closed(outputs)) => outputs.push((slot, value)),
            _ => self.stages.push(Stage::Closed(vec![(slot, value)])),
        }
    }
}

//! The solution of a plan while it is written: stages so far, what is known, what was divided by, rows that are watched.

use super::known::Known;
use super::reduce::Agreeing;
use super::step::StepId;
use super::steps::Listed;
use crate::expr::{ExprId, Graph, Symbol};
use crate::program::Slot;
use crate::system::KinematicSystem;

/// A stretch of the solution: expressions to compute, or an iteration.
pub(super) enum Stage {
    /// What is written where.
    Closed(Vec<(Slot, ExprId)>),
    /// Unknowns, and what is subtracted from each of them, for their current values; the place of what says whether the
    /// iteration has converged.
    Newton { unknowns: Vec<u32>, corrections: Vec<ExprId>, converged: u32 },
}

/// What a step divides by on its way to an unknown: its square, and what it is made of.
pub(super) struct Divisor {
    pub(super) step: StepId,
    pub(super) rows: Vec<usize>,
    pub(super) unknown: u32,
    pub(super) square: ExprId,
    pub(super) parts: Vec<ExprId>,
}

/// A row that is left out.
pub(super) struct Watched {
    pub(super) row: usize,
    /// What it says together with the row beside it.
    pub(super) agreeing: Option<Agreeing>,
    /// The place of its margin.
    pub(super) place: usize,
    /// Its margin so far.
    pub(super) margin: ExprId,
    /// Σ Φᵣₖ² wₖ, of the row and of the one beside it.
    pub(super) sizes: Vec<ExprId>,
}

/// Sizes that all watched rows share.
pub(super) struct Sizes {
    /// wₖ.
    pub(super) weights: Vec<ExprId>,
    /// Σ 1/|margin| of what is solved, which is the inverse of the square of its distance from the nearest limit.
    pub(super) nearness: ExprId,
    /// V².
    pub(super) velocity: ExprId,
}

/// Builds the solution of a plan.
pub(super) struct Build<'a> {
    pub(super) system: &'a KinematicSystem,
    pub(super) graph: Graph,
    pub(super) known: Known,
    pub(super) stages: Vec<Stage>,
    /// Margins as far as they belong to positions, and those of iterations by their first row.
    pub(super) listed: Listed,
    /// Places that say whether iterations have converged.
    pub(super) iterations: u32,
    /// (row, place of the margin, place that says whether it has converged) of every iteration.
    pub(super) pending: Vec<(usize, usize, u32)>,
    /// (first row, step, place of the margin) of every iteration.
    pub(super) iterated: Vec<(usize, StepId, usize)>,
    /// What was divided by.
    pub(super) divisors: Vec<Divisor>,
    /// The closures' indicators at a given q.
    pub(super) closures: Vec<ExprId>,
    /// All margins so far.
    pub(super) margins: Vec<ExprId>,
    /// Rows that are left out, and sizes for them.
    pub(super) watched: Vec<Watched>,
    pub(super) sizes_of_watched: Option<Sizes>,
}

impl<'a> Build<'a> {
    pub(super) fn new(system: &'a KinematicSystem, graph: Graph, listed: Listed) -> Self {
        let known = Known::default();
        let (stages, pending, closures) = (vec![Stage::Closed(Vec::new())], Vec::new(), Vec::new());
        let (margins, watched, sizes_of_watched) = (Vec::new(), Vec::new(), None);
        Self {
            system,
            graph,
            known,
            stages,
            listed,
            iterations: 0,
            pending,
            iterated: Vec::new(),
            divisors: Vec::new(),
            closures,
            margins,
            watched,
            sizes_of_watched,
        }
    }

    /// An expression of the description in terms of what is known.
    pub(super) fn known_value(&mut self, id: ExprId) -> ExprId {
        self.known.value(&mut self.graph, id)
    }

    /// The value of a coordinate.
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

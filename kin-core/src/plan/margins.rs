//! Margins of divisors and iterations, and the numbering of all margins.

use super::closures;
use super::state::{Build, Divisor, SignedStep, Stage};
use super::step::StepId;
use crate::constraint::CoordinateKind;
use crate::expr::{ExprId, Symbol};
use crate::mechanism::Component;
use crate::program::Slot;
use crate::vocabulary::Function;
use std::collections::BTreeMap;

impl Build<'_> {
    /// Writes a margin of a step; returns its index.
    pub(super) fn write_margin(&mut self, step: StepId, margin: ExprId) -> usize {
        let place = self.listed.margin(step);
        self.write(Slot::Margin(place), margin);
        place
    }

    /// Records the coefficient of a single unknown as a divisor. `given` is the coefficient at a given q.
    pub(super) fn divide_by_coefficient(
        &mut self,
        step: StepId,
        (rows, unknown): (Vec<usize>, u32),
        [coefficient, given]: [ExprId; 2],
    ) {
        match self.graph.literal(coefficient) {
            None => {
                let square = self.graph.square(coefficient);
                let signed = Some(given).filter(|&given| !self.graph.depends(given).is_static());
                self.divisors.push(Divisor { step, rows, unknown, square, parts: vec![coefficient], signed });
            }
            // A coefficient that is identically 0: the step is always singular.
            Some(0.0) => _ = self.write_margin(step, coefficient),
            Some(_) => {}
        }
    }

    /// Writes the margins of the divisors, once all coordinates are known. The square of a divisor is compared with the
    /// squared entries of Φ_q for other coordinates of the same kind (lengths or angles) in its rows, and with the
    /// terms of which the divisor is a sum.
    pub(super) fn divisor_margins(&mut self) {
        let system = self.system;
        let is_length = |k: u32| match system.set.coordinates[k as usize].kind {
            CoordinateKind::Pose(_, component) => Some(component != Component::Phi),
            CoordinateKind::Scalar => None,
        };
        for Divisor { step, rows, unknown, square, parts, signed } in std::mem::take(&mut self.divisors) {
            let mut others = Vec::new();
            if let Some(kind) = is_length(unknown) {
                let entries = rows.iter().flat_map(|&row| &system.equations[row].phi_q);
                let entries = entries.filter(|(k, _)| *k != unknown && is_length(*k) == Some(kind));
                others = entries.map(|(_, entry)| *entry).collect();
            }
            let known: Vec<ExprId> = others.iter().map(|&entry| self.known_value(entry)).collect();
            let whole = match (closures::whole_of_divisor(&mut self.graph, square, &known, &parts), signed, &parts[..])
            {
                (Some(whole), ..) => whole,
                // A divisor with a sign that has nothing else to be compared with is compared with its own size.
                (None, Some(_), &[part]) => closures::whole_of_varying(&mut self.graph, square, part),
                (None, ..) => continue,
            };
            let margin = self.graph.div(square, whole);
            let margin = self.write_margin(step, margin);
            let Some(divisor) = signed else { continue };
            let square = self.graph.square(divisor);
            let whole = closures::whole_of_divisor(&mut self.graph, square, &others, &[divisor])
                .unwrap_or_else(|| closures::whole_of_varying(&mut self.graph, square, divisor));
            let root = self.graph.call(Function::Sqrt, whole);
            let value = self.graph.div(divisor, root);
            self.signed.push(SignedStep { value, step, margin });
        }
    }

    /// Writes the margins of iterations. A margin is 0 unless the iteration has converged and its block of Φ_q is
    /// regular.
    pub(super) fn iteration_margins(&mut self, margins: &BTreeMap<usize, ExprId>) {
        for (row, place, converged) in std::mem::take(&mut self.pending) {
            let mut margin = self.graph.symbol(Symbol::Saved(converged));
            if let Some(&regular) = margins.get(&row) {
                margin = self.graph.mul(margin, regular);
            }
            self.write(Slot::Margin(place), margin);
        }
    }

    /// Renumbers the margins in the order of the steps.
    pub(super) fn number_margins(&mut self) {
        let places = self.listed.number_margins();
        for stage in &mut self.stages {
            let Stage::Closed(outputs) = stage else { continue };
            for (slot, _) in outputs {
                if let Slot::Margin(index) = slot {
                    *index = places[*index];
                }
            }
        }
    }
}

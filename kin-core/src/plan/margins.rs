//! Margins of divisors and iterations, and the numbering of all margins.

use super::closures;
use super::state::{Build, Divisor, Stage};
use super::step::StepId;
use crate::constraint::CoordinateKind;
use crate::expr::{ExprId, Symbol};
use crate::mechanism::Component;
use crate::program::Slot;
use std::collections::BTreeMap;

impl Build<'_> {
    pub(super) fn write_margin(&mut self, step: StepId, margin: ExprId) {
        let place = self.listed.margin(step);
        self.write(Slot::Margin(place), margin);
    }

    /// Records the coefficient of a single unknown as a divisor.
    pub(super) fn divide_by_coefficient(&mut self, step: StepId, rows: Vec<usize>, unknown: u32, coefficient: ExprId) {
        match self.graph.literal(coefficient) {
            None => {
                let square = self.graph.square(coefficient);
                self.divisors.push(Divisor { step, rows, unknown, square, parts: vec![coefficient] });
            }
            // A coefficient that is identically 0: the step is always singular.
            Some(0.0) => self.write_margin(step, coefficient),
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
        for Divisor { step, rows, unknown, square, parts } in std::mem::take(&mut self.divisors) {
            let mut others = Vec::new();
            if let Some(kind) = is_length(unknown) {
                let entries = rows.iter().flat_map(|&row| &system.equations[row].phi_q);
                let entries = entries.filter(|(k, _)| *k != unknown && is_length(*k) == Some(kind));
                others = entries.map(|(_, entry)| self.known_value(*entry)).collect();
            }
            if let Some(margin) = closures::share(&mut self.graph, square, &others, &parts) {
                self.write_margin(step, margin);
            }
        }
    }

    /// Writes the margins of iterations. A margin is 0 unless the iteration has converged and its block of Φ_q is
    /// regular.
    pub(super) fn iteration_margins(&mut self, margins: &BTreeMap<usize, ExprId>) {
        for (row, place, converged) in std::mem::take(&mut self.pending) {
            let mut margin = self.graph.symbol(Symbol::Held(converged));
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
                if let Slot::Margin(place) = slot {
                    *place = places[*place];
                }
            }
        }
    }
}

//! Margins of divisors and iterations, and the numbering of all margins.

use super::closures;
use super::sizes::smaller;
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
            let mut other_entries = Vec::new();
            if let Some(kind) = is_length(unknown) {
                let entries = rows.iter().flat_map(|&row| &system.equations[row].phi_q);
                let entries = entries.filter(|(k, _)| *k != unknown && is_length(*k) == Some(kind));
                other_entries = entries.map(|(_, entry)| *entry).collect();
            }
            let known: Vec<ExprId> = other_entries.iter().map(|&entry| self.known_value(entry)).collect();
            // The sign of a divisor is that of the divisor relative to its size at a given q.
            let of_sign = signed.map(|divisor| {
                let square = self.graph.square(divisor);
                let whole = closures::whole_of_divisor(&mut self.graph, square, &other_entries, &[divisor])
                    .unwrap_or_else(|| closures::whole_of_varying(&mut self.graph, square, divisor));
                (divisor, square, whole)
            });
            let margin = match (closures::whole_of_divisor(&mut self.graph, square, &known, &parts), of_sign) {
                (Some(whole), _) => self.graph.div(square, whole),
                // A divisor that has nothing else to be compared with is compared with its own size, as entries of
                // iterations are (see `iteration_margins`).
                (None, Some((_, given, whole))) => {
                    let given = self.graph.div(given, whole);
                    let given = self.known_value(given);
                    let whole = closures::whole_of_varying(&mut self.graph, square, parts[0]);
                    let known = self.graph.div(square, whole);
                    smaller(&mut self.graph, known, given)
                }
                (None, None) => continue,
            };
            let margin = self.write_margin(step, margin);
            if let Some((divisor, _, whole)) = of_sign {
                let root = self.graph.call(Function::Sqrt, whole);
                let value = self.graph.div(divisor, root);
                self.signed.push(SignedStep { value, step, margin });
            }
        }
    }

    /// Writes the margins of iterations: those of their blocks of Φ_q, by first row, with known coordinates and at a given
    /// q, whichever are smaller; of single angles only at a given q. A margin is 0 unless the iteration has converged and
    /// its block is regular.
    ///
    /// An entry is small if it is much smaller than its terms. At a given q the terms are rotated vectors, which have a
    /// length; of known coordinates they are products of cosines and sines, which all vanish where bars lie along an axis.
    pub(super) fn iteration_margins(&mut self, [known, given]: [&BTreeMap<usize, ExprId>; 2]) {
        for (row, place, converged) in std::mem::take(&mut self.pending) {
            let mut margin = self.graph.symbol(Symbol::Saved(converged));
            if let Some(&given) = given.get(&row) {
                let given = self.known_value(given);
                let regular = known.get(&row).map_or(given, |&known| smaller(&mut self.graph, known, given));
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

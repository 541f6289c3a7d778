//! Unilateral conditions.
//!
//! ```text
//! left > right:  g = left − right        left < right:  g = right − left
//! ```
//! The condition is satisfied while g > 0. g is an observable with ġ = g_q q̇ + g_t and g̈ = g_q q̈ − γ_g, in the unit
//! of the two sides; it is not a row of Φ (lecture, slides 27–34: bilateral and unilateral constraints).
//!
//! Where g contains |u|, it has a corner at u = 0. Every such u is an observable, too, so that corners are located like zeros
//! of g, and g is watched between them, where it is smooth.

use super::assembly::Assembly;
use super::layout::indexed;
use super::set::{ConditionInstance, ConstraintSet, ObservableKind};
use crate::expr::{ExprId, Node};
use crate::mechanism::{Function, Relation};

impl Assembly<'_> {
    /// Writes all conditions, one for every index of a range.
    pub(crate) fn conditions(&mut self, set: &mut ConstraintSet) {
        for (family, condition) in self.mechanism.conditions.iter().enumerate() {
            for (shown, index) in Self::instances(condition.range) {
                self.index = index;
                let (left, right) = (self.formula(&condition.left), self.formula(&condition.right));
                let value = match condition.relation {
                    Relation::Greater => self.graph.sub(left, right),
                    Relation::Less => self.graph.sub(right, left),
                };
                let name = indexed(&condition.name, shown.is_some(), index);
                // This happens only for some members of a family; a condition that is constant for all indices has
                // been rejected by a rule.
                if self.graph.depends(value).is_static() {
                    let message = format!(
                        "unilateral `{name}` depends on parameters alone, so that no motion changes it; one of its \
                         sides must vary"
                    );
                    self.error_once(condition.keyword, message);
                }
                let observable = self.observe(set, ObservableKind::Condition(set.conditions.len()), value);
                let corners = self.corners(value);
                for corner in &corners {
                    self.observe(set, ObservableKind::Condition(set.conditions.len()), *corner);
                }
                set.conditions.push(ConditionInstance {
                    name,
                    family: (family, index),
                    text: condition.text.clone(),
                    observable,
                    corners: corners.len(),
                    rheonomic: self.graph.depends(value).is_rheonomic(),
                    origin: condition.origin,
                });
            }
        }
    }

    /// The arguments of the absolute values in an expression that a motion changes; those inside of others come first.
    fn corners(&self, value: ExprId) -> Vec<ExprId> {
        let inside = self.graph.reachable([value]).into_iter().filter_map(|id| match self.graph.node(id) {
            Node::Call(Function::Abs, inside) => Some(inside),
            _ => None,
        });
        inside.filter(|inside| !self.graph.depends(*inside).is_static()).collect()
    }
}

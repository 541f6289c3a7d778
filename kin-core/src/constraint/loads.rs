//! Sizes of masses and springs that become numbers by constant folding; literal ones have been checked by a rule
//! before.

use super::assembly::Assembly;
use super::layout::indexed;
use crate::error::Origin;
use crate::mechanism::{Operand, Statement};
use crate::vocabulary::{LoadKind, StatementKind};

impl Assembly<'_> {
    /// Reports masses and moments of inertia that are negative, and springs that do nothing. The loads are not part of
    /// Φ, whose graph is not changed.
    pub(crate) fn check_loads(&mut self) {
        let graph = self.graph.clone();
        for load in &self.mechanism.loads {
            match load.operands.kind() {
                StatementKind::Load(LoadKind::Mass) => self.check_mass(load),
                StatementKind::Load(LoadKind::Spring | LoadKind::TorsionSpring) => self.check_spring(load),
                _ => {}
            }
        }
        self.graph = graph;
    }

    fn check_mass(&mut self, load: &Statement) {
        for (shown, index) in Self::instances(load.range) {
            self.index = index;
            self.member = shown.map(|_| indexed(&load.name, true, index));
            for (key, quantity) in [("mass", "this mass"), ("inertia", "this moment of inertia")] {
                if let Some((value, origin)) = self.size(load, key)
                    && value < 0.0
                {
                    self.degenerate(origin, quantity, format_args!("is {value}; it must not be negative"));
                }
            }
        }
        self.member = None;
    }

    /// A spring does something if one of its members does.
    fn check_spring(&mut self, load: &Statement) {
        let does_nothing = Self::instances(load.range).into_iter().all(|(_, index)| {
            self.index = index;
            ["stiffness", "damping"].iter().all(|key| self.size(load, key).is_some_and(|(value, _)| value == 0.0))
        });
        if does_nothing {
            let (keyword, name) = (load.operands.keyword(), &load.name);
            let message = format!("the stiffness and the damping of {keyword} `{name}` are 0, so that it does nothing");
            self.error_once(load.keyword, message);
        }
    }

    /// The operand `key` of a load, if it is a number.
    fn size(&mut self, load: &Statement, key: &str) -> Option<(f64, Origin)> {
        let (_, operand) = load.operands.iter().find(|(slot, _)| slot.key == key)?;
        let Operand::Value(value) = operand else { return None };
        let formula = self.formula(&value.value);
        Some((self.graph.literal(formula)?, value.origin))
    }
}

//! From the parts of a row to its kind and the operands in its slots. Where several kinds share a keyword, the options
//! determine the kind.

use super::parts::Parts;
use crate::ast::OperandExpr;
use kin_core::mechanism::{Slot, StatementForm, Takes, Written};

/// The required options that no other kind of the keyword has.
fn own_options(kinds: &[&'static StatementForm], form: &'static StatementForm) -> Vec<&'static str> {
    let others = || kinds.iter().filter(|other| **other != form).flat_map(|other| other.slots);
    let required = form.written(Written::Option).filter(|slot| !slot.or_zero && slot.takes != Takes::Carrier);
    required.map(|slot| slot.key).filter(|key| others().all(|slot| slot.key != *key)).collect()
}

impl Parts<'_> {
    /// The kind of the row, and the operands in its slots.
    pub(super) fn operands(mut self) -> (&'static StatementForm, Vec<OperandExpr>) {
        self.kind = self.meant();
        let kind = self.kind;
        let operands = kind.slots.iter().map(|slot| self.operand(slot)).collect();
        (kind, operands)
    }

    fn operand(&mut self, slot: &Slot) -> OperandExpr {
        let key = slot.key;
        match (slot.written, slot.takes) {
            (Written::Operand, Takes::Point) => OperandExpr::Point(self.point()),
            (Written::Operand, Takes::Points) => OperandExpr::Points(self.points()),
            (Written::Operand, Takes::Body | Takes::Carrier) => OperandExpr::Body(self.body()),
            (Written::Operand, Takes::Bodies) => OperandExpr::Bodies(self.bodies()),
            (Written::Operand, Takes::Vector) => OperandExpr::Vector(self.vector()),
            (Written::Operand, _) => OperandExpr::Value(self.expr()),
            (Written::Right, _) => OperandExpr::Value(self.right()),
            (Written::Option, Takes::Axis) => OperandExpr::Axis(self.axis(key)),
            (Written::Option, Takes::Radii) => OperandExpr::Radii(self.radii(key)),
            (Written::Option, Takes::Body) => OperandExpr::Body(self.named_body(key)),
            (Written::Option, Takes::Carrier) => OperandExpr::Body(self.carrier(key)),
            (Written::Option, Takes::Scalar(_)) => OperandExpr::Scalar(self.name(key)),
            (Written::Option, Takes::Curve) => OperandExpr::Curve(self.curve()),
            (Written::Option, _) if slot.or_zero => OperandExpr::Value(self.or_zero(key)),
            (Written::Option, _) => OperandExpr::Value(self.required(key)),
        }
    }

    /// Determines the kind of the row: where several kinds share the keyword, by the options.
    fn meant(&mut self) -> &'static StatementForm {
        let kinds: &'static [&'static StatementForm] = &self.form.kinds;
        let [first, _, ..] = kinds else { return kinds[0] };
        let given = |form: &'static StatementForm| self.given(&own_options(kinds, form));
        let mut meant: Vec<(&'static StatementForm, &syn::Ident)> =
            kinds.iter().filter_map(|form| Some((*form, given(form)?))).collect();
        // If options of several kinds are given, the first option determines the kind.
        let place = |key: &syn::Ident| self.options.iter().position(|(given, _)| given == key);
        meant.sort_by_key(|(_, key)| place(key));
        let message = match meant.as_slice() {
            [] if self.lost_option => None,
            [] => Some((self.keyword.span(), first.choice.to_owned())),
            [_] => None,
            [_, (_, wrong), ..] => {
                let message = format!("`{wrong}` belongs to the other form of `{}`: {}", self.keyword, first.choice);
                Some((wrong.span(), message))
            }
        };
        let kind = meant.first().map_or(*first, |(form, _)| *form);
        if let Some((span, message)) = message {
            self.report.error(span, message);
            self.lost_option = true;
        }
        kind
    }
}

//! Joints, drivers and equations: how each is written, and what its parts become.
//!
//! The kinds and their forms are kin-core's ([`forms`]); kinds that share a keyword are told apart by their options.

use super::parts::{OperandForm, OptionForm, Parts};
use crate::ast::OperandExpr;
use kin_core::joints::forms;
use kin_core::mechanism::{JointForm, Slot, Takes, Written};
use std::sync::LazyLock;

/// How the rows of a keyword are written.
pub(super) struct RowForm {
    /// The attribute.
    pub(super) keyword: &'static str,
    /// The kinds that share it: they have the same operands, and options of their own.
    kinds: Vec<&'static JointForm>,
    /// What stands behind the name, in order.
    pub(super) operands: Vec<OperandForm>,
    /// What can follow as `key = value`.
    pub(super) options: Vec<(&'static str, OptionForm)>,
}

/// Every row of the language, in the order of the guide.
pub(super) static FORMS: LazyLock<Vec<RowForm>> = LazyLock::new(|| {
    let mut rows: Vec<RowForm> = Vec::new();
    for form in forms() {
        let options = form.written(Written::Option).flat_map(options_of);
        match rows.last_mut().filter(|row| row.keyword == form.kind.keyword()) {
            Some(row) => {
                row.kinds.push(form);
                let new: Vec<_> =
                    options.filter(|(key, _)| row.options.iter().all(|(known, _)| known != key)).collect();
                row.options.extend(new);
            }
            None => rows.push(RowForm {
                keyword: form.kind.keyword(),
                kinds: vec![form],
                operands: form.written(Written::Operand).map(operand_of).collect(),
                options: options.collect(),
            }),
        }
    }
    rows
});

fn operand_of(slot: &Slot) -> OperandForm {
    match slot.takes {
        Takes::Point => OperandForm::Point,
        Takes::Points => OperandForm::Points,
        Takes::Body | Takes::Carrier => OperandForm::Body,
        _ => OperandForm::Expression,
    }
}

/// The options that a slot is written with.
fn options_of(slot: &Slot) -> Vec<(&'static str, OptionForm)> {
    let form = match slot.takes {
        Takes::Axis => OptionForm::Axis,
        Takes::Radii => OptionForm::Radii,
        Takes::Body | Takes::Carrier => OptionForm::Body,
        Takes::Scalar(_) => OptionForm::Scalar,
        Takes::Support => OptionForm::Curve(&["theta"]),
        Takes::Curve => {
            return vec![
                ("polar", OptionForm::Curve(&["theta"])),
                ("implicit", OptionForm::Curve(&["X", "Y"])),
                ("parametric", OptionForm::Path),
                ("roller", OptionForm::Expression),
            ];
        }
        _ => OptionForm::Expression,
    };
    vec![(slot.key, form)]
}

impl RowForm {
    /// A row as the user writes it.
    pub(super) fn example(&self) -> &'static str {
        self.kinds.first().map_or("", |form| form.example)
    }

    /// What would be right, for a message: the ways in which the kinds are told apart, or else the example.
    pub(super) fn right(&self) -> String {
        match self.kinds.first().map(|form| form.choice) {
            Some(choice) if !choice.is_empty() => choice.to_owned(),
            _ => format!("`{}`", self.example()),
        }
    }

    /// True when `= expression` follows the last operand.
    pub(super) fn is_equation(&self) -> bool {
        self.kinds.iter().any(|form| form.is_equation())
    }
}

impl core::fmt::Debug for RowForm {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.keyword)
    }
}

/// The options that must be given, and that no other kind of the keyword has.
fn own_options(kinds: &[&'static JointForm], form: &'static JointForm) -> Vec<&'static str> {
    let others = || kinds.iter().filter(|other| **other != form).flat_map(|other| other.slots);
    let required = form.written(Written::Option).filter(|slot| !slot.or_zero && slot.takes != Takes::Carrier);
    required.map(|slot| slot.key).filter(|key| others().all(|slot| slot.key != *key)).collect()
}

impl Parts<'_> {
    /// What the row is, and what stands in its slots.
    pub(super) fn operands(mut self) -> (&'static JointForm, Vec<OperandExpr>) {
        let kind = self.kind();
        let operands = kind.slots.iter().map(|slot| self.operand(slot)).collect();
        (kind, operands)
    }

    fn operand(&mut self, slot: &Slot) -> OperandExpr {
        let key = slot.key;
        match (slot.written, slot.takes) {
            (Written::Operand, Takes::Point) => OperandExpr::Point(self.point()),
            (Written::Operand, Takes::Points) => OperandExpr::Points(self.points()),
            (Written::Operand, Takes::Body | Takes::Carrier) => OperandExpr::Body(self.body()),
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

    /// The kind that is meant: where several share the keyword, the options tell which.
    fn kind(&mut self) -> &'static JointForm {
        let kinds: &'static [&'static JointForm] = &self.form.kinds;
        let [first, _, ..] = kinds else { return kinds[0] };
        let given = |form: &'static JointForm| self.given(&own_options(kinds, form));
        let mut meant: Vec<(&'static JointForm, &syn::Ident)> =
            kinds.iter().filter_map(|form| Some((*form, given(form)?))).collect();
        // What comes first says what is meant.
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

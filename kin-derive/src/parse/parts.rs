//! The parts of a statement: operands in order, followed by `key = value` in any order; and from them the form of the
//! statement and the operands in its slots. Where several forms share a keyword, the options determine the form.

use super::forms::{KeywordForm, OptionForm};
use crate::ast::{BodyExpr, Expr, OperandExpr, text};
use crate::report::Report;
use kin_core::mechanism::{OperandSlot, OperandType, StatementForm, Written};
use std::collections::VecDeque;
use syn::Ident;

/// The parts that were read of a statement; a missing part becomes a hole.
pub(super) struct Parts<'a> {
    pub(super) keyword: &'a Ident,
    pub(super) keyword_form: &'static KeywordForm,
    /// The form of the statement; the first form of its keyword until the options have been read.
    pub(super) form: &'static StatementForm,
    pub(super) report: &'a Report,
    /// The operands one by one, also those that fill one slot together.
    pub(super) operands: VecDeque<OperandExpr>,
    pub(super) right: Option<Expr>,
    /// The options; `None` for a value that could not be read, which is reported.
    pub(super) options: Vec<(Ident, Option<OperandExpr>)>,
    /// True if an option could not be read, which is reported; it may be the one that is missing.
    pub(super) lost_option: bool,
    /// True if the number of operands is wrong, which is reported.
    pub(super) miscounted: bool,
    /// The number of errors before this statement.
    pub(super) errors_before: usize,
}

/// The required options that no other kind of the keyword has.
fn own_options(kinds: &[&'static StatementForm], form: &'static StatementForm) -> Vec<&'static str> {
    let other_slots = || kinds.iter().filter(|other| **other != form).flat_map(|other| other.slots);
    let required = form.written(Written::Option).filter(|slot| !slot.or_zero && slot.takes != OperandType::Carrier);
    required.map(|slot| slot.key).filter(|key| other_slots().all(|slot| slot.key != *key)).collect()
}

impl Parts<'_> {
    /// The form of the statement, and the operands in its slots.
    pub(super) fn operands(mut self) -> (&'static StatementForm, Vec<OperandExpr>) {
        self.form = self.chosen_form();
        let form = self.form;
        let operands = form.slots.iter().map(|slot| self.operand(slot)).collect();
        (form, operands)
    }

    fn operand(&mut self, slot: &OperandSlot) -> OperandExpr {
        let span = self.keyword.span();
        match (slot.written, slot.takes) {
            (Written::Operand, OperandType::Points) => {
                let point = |operand| if let OperandExpr::Point(point) = operand { Some(point) } else { None };
                OperandExpr::Points(self.operands.drain(..).filter_map(point).collect())
            }
            (Written::Operand, OperandType::Bodies) => {
                let body = |operand| if let OperandExpr::Body(body) = operand { Some(body) } else { None };
                OperandExpr::Bodies(self.operands.drain(..).filter_map(body).collect())
            }
            (Written::Operand, takes) => self.operands.pop_front().unwrap_or(OperandExpr::hole(takes, span)),
            (Written::Right, _) => OperandExpr::Value(self.right.take().unwrap_or(Expr::hole(span))),
            (Written::Option, OperandType::Curve) => OperandExpr::Curve(self.curve()),
            (Written::Option, _) => self.option(slot),
        }
    }

    /// The value of an option, with its default if it is not given; it is reported if there is no default.
    fn option(&mut self, slot: &OperandSlot) -> OperandExpr {
        let span = self.keyword.span();
        let hole = OperandExpr::hole(slot.takes, span);
        match self.take(slot.key) {
            Some(value) => value.unwrap_or(hole),
            None if slot.takes == OperandType::Carrier => OperandExpr::Body(BodyExpr::NotGiven),
            // A load with an unreadable option gets a hole, so that it does not seem to be zero.
            None if slot.or_zero && self.lost_option && self.form.kind.is_load() => hole,
            None if slot.or_zero => OperandExpr::Value(Expr::number(0.0, span)),
            None => {
                self.missing(slot.key);
                hole
            }
        }
    }

    pub(super) fn take(&mut self, key: &str) -> Option<Option<OperandExpr>> {
        let place = self.options.iter().position(|(given, _)| text(given) == key)?;
        Some(self.options.remove(place).1)
    }

    fn missing(&self, key: &str) {
        if self.lost_option {
            return;
        }
        let variables = match self.keyword_form.options.iter().find(|(option, _)| *option == key) {
            Some((_, OptionForm::Curve(variables))) => format!("({})", variables.join(", ")),
            _ => String::new(),
        };
        let message =
            format!("`{}` needs `{key}{variables} = …`: {}", self.keyword, self.keyword_form.right(self.form));
        self.report.error(self.keyword.span(), message);
    }

    /// Determines the form of the statement: where several forms share the keyword, by the options.
    fn chosen_form(&mut self) -> &'static StatementForm {
        let kinds: &'static [&'static StatementForm] = &self.keyword_form.kinds;
        let [first, _, ..] = kinds else { return kinds[0] };
        // If options of several kinds are given, the first option determines the kind.
        let place = |form| {
            let options_of_form = own_options(kinds, form);
            self.options.iter().position(|(key, _)| options_of_form.contains(&text(key).as_str()))
        };
        let mut chosen: Vec<_> = kinds.iter().filter_map(|form| Some((place(form)?, *form))).collect();
        chosen.sort_by_key(|(place, _)| *place);
        let message = match chosen.as_slice() {
            [] if self.lost_option => None,
            [] => Some((self.keyword.span(), first.choice.to_owned())),
            [_] => None,
            [_, (wrong, _), ..] => {
                let (wrong, _) = &self.options[*wrong];
                let message = format!("`{wrong}` belongs to the other form of `{}`: {}", self.keyword, first.choice);
                Some((wrong.span(), message))
            }
        };
        if let Some((span, message)) = message {
            self.report.error(span, message);
            self.lost_option = true;
        }
        chosen.first().map_or(*first, |(_, form)| *form)
    }
}

//! The parts of a row: operands in order, followed by `key = value` in any order.

use super::forms::{OptionForm, RowForm};
use crate::ast::{AxisExpr, BodyExpr, Expr, NameUse, PointExpr, RadiiExpr, text};
use crate::report::Report;
use kin_core::mechanism::StatementForm;
use proc_macro2::Span;
use std::collections::VecDeque;
use syn::Ident;

/// An operand that was read, or a hole.
pub(super) enum Operand {
    Point(PointExpr),
    Body(Option<NameUse>),
    Vector(AxisExpr),
    Expression(Expr),
}

/// The value of an option.
pub(super) enum Value {
    Axis(AxisExpr),
    Expression(Expr),
    Path { parameter: NameUse, x: Expr, y: Expr, span: Span },
    Radii(RadiiExpr),
    Name(NameUse),
}

/// The parts that were read of a row; the accessor of a missing part returns a hole.
pub(super) struct Parts<'a> {
    pub(super) keyword: &'a Ident,
    pub(super) form: &'static RowForm,
    /// The kind of the row; the first kind of its keyword until the options have been read.
    pub(super) kind: &'static StatementForm,
    pub(super) report: &'a Report,
    pub(super) operands: VecDeque<Operand>,
    pub(super) right: Option<Expr>,
    pub(super) options: Vec<(Ident, Option<Value>)>,
    /// True if an option could not be read, which is reported; it may be the one that is missing.
    pub(super) lost_option: bool,
    /// True if the number of operands is wrong, which is reported.
    pub(super) miscounted: bool,
    /// The number of errors before this row.
    pub(super) errors_before: usize,
}

impl Parts<'_> {
    /// The next operand, which is a point.
    pub(super) fn point(&mut self) -> PointExpr {
        match self.operands.pop_front() {
            Some(Operand::Point(point)) => point,
            _ => PointExpr::Hole,
        }
    }

    /// All remaining operands, which are points.
    pub(super) fn points(&mut self) -> Vec<PointExpr> {
        let count = self.operands.len();
        (0..count).map(|_| self.point()).collect()
    }

    /// The next operand, which is a body.
    pub(super) fn body(&mut self) -> BodyExpr {
        match self.operands.pop_front() {
            Some(Operand::Body(Some(body))) => BodyExpr::Named(body),
            _ => BodyExpr::Hole,
        }
    }

    /// All remaining operands, which are bodies.
    pub(super) fn bodies(&mut self) -> Vec<BodyExpr> {
        let count = self.operands.len();
        (0..count).map(|_| self.body()).collect()
    }

    /// The next operand, which is a pair.
    pub(super) fn vector(&mut self) -> AxisExpr {
        match self.operands.pop_front() {
            Some(Operand::Vector(vector)) => vector,
            _ => AxisExpr::hole(self.keyword.span()),
        }
    }

    /// The next operand, which is an expression.
    pub(super) fn expr(&mut self) -> Expr {
        match self.operands.pop_front() {
            Some(Operand::Expression(expr)) => expr,
            _ => Expr::hole(self.keyword.span()),
        }
    }

    /// The right-hand side.
    pub(super) fn right(&mut self) -> Expr {
        self.right.take().unwrap_or_else(|| Expr::hole(self.keyword.span()))
    }

    /// The axis in a required option.
    pub(super) fn axis(&mut self, key: &str) -> AxisExpr {
        match self.take(key) {
            Some(Some(Value::Axis(axis))) => axis,
            given => {
                self.missing(key, given.is_some());
                AxisExpr::hole(self.keyword.span())
            }
        }
    }

    /// The pair of radii in a required option.
    pub(super) fn radii(&mut self, key: &str) -> RadiiExpr {
        match self.take(key) {
            Some(Some(Value::Radii(radii))) => radii,
            given => {
                self.missing(key, given.is_some());
                let span = self.keyword.span();
                RadiiExpr { i: Expr::hole(span), j: Expr::hole(span), span }
            }
        }
    }

    /// The name in a required option.
    pub(super) fn name(&mut self, key: &str) -> Option<NameUse> {
        match self.take(key) {
            Some(Some(Value::Name(name))) => Some(name),
            given => {
                self.missing(key, given.is_some());
                None
            }
        }
    }

    /// The body in a required option.
    pub(super) fn named_body(&mut self, key: &str) -> BodyExpr {
        self.name(key).map_or(BodyExpr::Hole, BodyExpr::Named)
    }

    /// The body that carries the axles: the ground, unless the option names another one.
    pub(super) fn carrier(&mut self, key: &str) -> BodyExpr {
        match self.take(key) {
            None => BodyExpr::NotGiven,
            Some(Some(Value::Name(name))) => BodyExpr::Named(name),
            Some(_) => BodyExpr::Hole,
        }
    }

    /// The first option that is one of `keys`.
    pub(super) fn given(&self, keys: &[&str]) -> Option<&Ident> {
        self.options.iter().map(|(key, _)| key).find(|key| keys.contains(&text(key).as_str()))
    }

    /// The expression in a required option.
    pub(super) fn required(&mut self, key: &str) -> Expr {
        match self.take(key) {
            Some(Some(Value::Expression(expr))) => expr,
            given => {
                self.missing(key, given.is_some());
                Expr::hole(self.keyword.span())
            }
        }
    }

    /// The expression in an option with default 0.
    pub(super) fn or_zero(&mut self, key: &str) -> Expr {
        match self.take(key) {
            // A load with an unreadable option gets a hole, so that it does not seem to be zero.
            None if self.lost_option && self.kind.kind.is_load() => Expr::hole(self.keyword.span()),
            None => Expr::number(0.0, self.keyword.span()),
            Some(Some(Value::Expression(expr))) => expr,
            Some(_) => Expr::hole(self.keyword.span()),
        }
    }

    pub(super) fn take(&mut self, key: &str) -> Option<Option<Value>> {
        let place = self.options.iter().position(|(given, _)| text(given) == key)?;
        Some(self.options.remove(place).1)
    }

    fn missing(&self, key: &str, given: bool) {
        if !given && !self.lost_option {
            let variables = match self.form.options.iter().find(|(option, _)| *option == key) {
                Some((_, OptionForm::Curve(variables))) => format!("({})", variables.join(", ")),
                _ => String::new(),
            };
            let message = format!("`{}` needs `{key}{variables} = …`: {}", self.keyword, self.form.right(self.kind));
            self.report.error(self.keyword.span(), message);
        }
    }
}

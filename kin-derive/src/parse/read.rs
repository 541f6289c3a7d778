//! Parsing of the parts of a statement, with recovery from errors.

use super::curve::{self, is_bracketed};
use super::expr::{end_of_expr, expr};
use super::forms::{KeywordForm, OptionForm};
use super::index::identifier;
use super::list::{comma, end_of_part, skip_part, skip_to};
use super::parts::Parts;
use super::point::operand;
use super::reject::{self, here};
use crate::ast::{OperandExpr, text};
use crate::report::Report;
use crate::suggest::{did_you_mean, quoted};
use kin_core::mechanism::OperandType;
use std::collections::VecDeque;
use syn::parse::ParseStream;
use syn::{Error, Ident, Result, Token, token};

impl<'a> Parts<'a> {
    /// Parses everything after `name:`.
    pub(super) fn read(input: ParseStream, keyword: &'a Ident, form: &'static KeywordForm, report: &'a Report) -> Self {
        let mut parts = Self {
            keyword,
            keyword_form: form,
            form: form.kinds[0],
            report,
            operands: VecDeque::new(),
            right: None,
            options: Vec::new(),
            lost_option: false,
            miscounted: false,
            errors_before: report.count(),
        };
        parts.read_operands(input);
        parts.read_options(input);
        parts
    }

    fn read_operands(&mut self, input: ParseStream) {
        match self.keyword_form.operands[..] {
            [OperandType::Points] => return self.read_points(input),
            [OperandType::Bodies] => return self.read_bodies(input),
            _ => {}
        }
        let count = self.keyword_form.operands.len();
        for (k, takes) in self.keyword_form.operands.iter().enumerate() {
            let last = k + 1 == count;
            if input.is_empty() || !self.keyword_form.is_equation() && self.begins_option(input) {
                return self.too_few();
            }
            let read = self.read_operand(input, *takes);
            if !read {
                skip_to(input, |input| {
                    input.peek(Token![,]) || last && self.keyword_form.is_equation() && is_equals(input)
                });
            }
            if last && self.keyword_form.is_equation() {
                self.read_right(input, read);
            } else if last && is_equals(input) {
                let message = format!("`{}` is no equation: `{}`", self.keyword, self.keyword_form.example());
                self.finish_part(Err(here(input, message)), input);
            } else if self.keyword_form.is_equation() && is_equals(input) {
                return self.too_few();
            } else {
                self.finish_part(end_of_part(input), input);
            }
        }
    }

    /// Parses points until the options begin, at least two.
    fn read_points(&mut self, input: ParseStream) {
        while !input.is_empty() && !self.begins_option(input) {
            if self.read_operand(input, OperandType::Points) {
                self.finish_part(end_of_part(input), input);
            } else {
                skip_to(input, |input| input.peek(Token![,]));
                comma(input);
            }
        }
        if self.operands.len() < 2 {
            self.too_few();
        }
    }

    /// Parses one or two bodies, and the right-hand side.
    fn read_bodies(&mut self, input: ParseStream) {
        let mut read = true;
        while !input.is_empty() && !is_equals(input) {
            if !self.read_operand(input, OperandType::Bodies) {
                read = false;
                skip_to(input, |input| input.peek(Token![,]) || is_equals(input));
            }
            if is_equals(input) || !input.peek(Token![,]) {
                break;
            }
            comma(input);
            if !input.is_empty() && !input.peek(Ident) && !is_equals(input) {
                read = false;
                self.report.push(here(input, format!("a value follows an `=`: `{}`", self.keyword_form.example())));
                skip_to(input, is_equals);
            }
        }
        if !(1..=2).contains(&self.operands.len()) {
            read = false;
            self.too_few();
        }
        self.read_right(input, read);
    }

    /// Parses an operand; false if it becomes a hole.
    fn read_operand(&mut self, input: ParseStream, takes: OperandType) -> bool {
        let read = self.report.ok(operand(input, takes));
        let is_read = read.is_some();
        self.operands.push_back(read.unwrap_or(OperandExpr::hole(takes, self.keyword.span())));
        is_read
    }

    /// Parses the right-hand side; a missing `=` is not reported if the left side has an error.
    fn read_right(&mut self, input: ParseStream, left_is_read: bool) {
        if is_equals(input) {
            let right = input.parse::<Token![=]>().and_then(|_| expr(input));
            self.right = self.report.ok(right);
            if self.right.is_none() {
                skip_part(input);
            }
            let end = end_of_expr(input)
                .and_then(|()| if is_equals(input) { Err(reject::after_expr(input)) } else { Ok(()) });
            self.finish_part(end, input);
        } else {
            if left_is_read {
                self.report.push(no_equals(input, self.keyword_form.example()));
            }
            // The rest is skipped, because tokens after a comma would be taken for an option.
            skip_to(input, |_| false);
        }
    }

    fn read_options(&mut self, input: ParseStream) {
        while !input.is_empty() {
            if self.begins_option(input) {
                let result = self.read_option(input);
                self.finish_part(result, input);
                continue;
            }
            // Too many operands are reported once; one of them may be an option without its key.
            let option = self.option_without_equals(input);
            if let Some(key) = option {
                self.report.push(here(input, format!("`{key}` is given with `=`: `{}`", self.keyword_form.example())));
            } else if !self.miscounted {
                self.miscounted = true;
                self.report.push(here(input, self.count_message()));
            }
            self.lost_option = true;
            skip_part(input);
            comma(input);
        }
    }

    /// The option of this statement that follows without `=`.
    fn option_without_equals(&self, input: ParseStream) -> Option<&'static str> {
        let word = text(&input.fork().parse::<Ident>().ok()?);
        self.keyword_form.options.iter().map(|(option, _)| *option).find(|option| *option == word)
    }

    /// True if `key =` or `key(…) =` follows, or the key of an option that is written with parentheses.
    fn begins_option(&self, input: ParseStream) -> bool {
        let has_brackets = |form| matches!(form, OptionForm::Curve(_) | OptionForm::Path);
        let is_known = |word: &Ident| {
            self.keyword_form.options.iter().any(|(option, form)| has_brackets(*form) && *option == text(word))
        };
        is_option(input)
            || is_bracketed(input)
            || input.peek2(token::Paren) && input.fork().parse::<Ident>().is_ok_and(|word| is_known(&word))
    }

    fn read_option(&mut self, input: ParseStream) -> Result<()> {
        let key = identifier(input)?;
        let name = text(&key);
        let known = self.keyword_form.options.iter().find(|(option, _)| *option == name);
        if self.options.iter().any(|(given, _)| text(given) == name) {
            self.report.error(key.span(), format!("`{name}` is given twice; one value is enough"));
            skip_part(input);
            return Ok(());
        }
        let Some((_, form)) = known else {
            self.lost_option = true;
            self.report.error(key.span(), self.unknown_option(&name));
            skip_part(input);
            return Ok(());
        };
        // The option counts as given, even if its value cannot be read.
        self.options.push((key.clone(), None));
        if !matches!(form, OptionForm::Curve(_) | OptionForm::Path) {
            input.parse::<Token![=]>().map_err(|_| here(input, format!("`{key}` is given as `{key} = …`")))?;
        }
        let value = match form {
            OptionForm::Curve(variables) => curve::formula(input, &key, variables)?,
            OptionForm::Path => curve::path(input, &key)?,
            OptionForm::Value(takes) => operand(input, *takes)?,
        };
        if let Some((_, slot)) = self.options.last_mut() {
            *slot = Some(value);
        }
        end_of_part(input)
    }

    fn finish_part(&mut self, result: Result<()>, input: ParseStream) {
        if self.report.ok(result).is_none() {
            self.lost_option = true;
            skip_part(input);
        }
        comma(input);
    }

    fn unknown_option(&self, name: &str) -> String {
        let options = || self.keyword_form.options.iter().map(|(option, _)| *option);
        let suggestion = did_you_mean(name, options());
        let keyword = self.keyword;
        let list = quoted(options(), "and");
        match self.keyword_form.options.len() {
            0 => format!("`{keyword}` has no options; it is written `{}`", self.keyword_form.example()),
            1 => format!("`{keyword}` has no option `{name}`; its option is {list}{suggestion}"),
            _ => format!("`{keyword}` has no option `{name}`; its options are {list}{suggestion}"),
        }
    }

    /// Reports that there are too few operands, unless an earlier error in the statement may be the reason.
    fn too_few(&mut self) {
        self.miscounted = true;
        if self.report.count() == self.errors_before {
            self.report.error(self.keyword.span(), self.count_message());
        }
    }

    fn count_message(&self) -> String {
        let points = format!("{} points", self.keyword_form.operands.len());
        let operands = match self.keyword_form.operands[..] {
            [OperandType::Points, ..] => "two points or more",
            [OperandType::Bodies] => "one body or two, then `=` and an expression",
            [OperandType::Point, OperandType::Vector] => "a point and a pair of components",
            [OperandType::Point] => "one point",
            [OperandType::Point, OperandType::Point] => "two points",
            [OperandType::Point, ..] => points.as_str(),
            [OperandType::Body | OperandType::Carrier] => "one body",
            [OperandType::Body | OperandType::Carrier, ..] => "two bodies",
            [_, _] => "two components",
            _ => "one expression on each side of `=`",
        };
        let then = if self.keyword_form.options.is_empty() { "" } else { ", then options as `key = value`" };
        format!("`{}` takes {operands}{then}: `{}`", self.keyword, self.keyword_form.example())
    }
}

/// True if `key =` follows.
pub(super) fn is_option(input: ParseStream) -> bool {
    input.peek(Ident) && input.peek2(Token![=]) && !input.peek2(Token![==])
}

/// The error if no single `=` follows where one is required.
pub(super) fn no_equals(input: ParseStream, form: &str) -> Error {
    if input.peek(Token![==]) {
        return here(input, format!("a single `=` stands here: `{form}`"));
    }
    here(input, format!("expected `=` and a value: `{form}`"))
}

fn is_equals(input: ParseStream) -> bool {
    input.peek(Token![=]) && !input.peek(Token![==]) && !input.peek(Token![=>])
}

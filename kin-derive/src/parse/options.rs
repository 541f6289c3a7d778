//! Parsing of options after the names that an attribute declares, which apply to all of these names: `unit = "m"`,
//! `default = 0.3`.

use super::expr::{end_of_expr, expr};
use super::fold::constant;
use super::list::end_of_part;
use super::node::no_unit_in_default;
use super::reject::here;
use super::unit::unit;
use crate::ast::{Item, text};
use crate::report::Report;
use crate::suggest::{did_you_mean, nearest, quoted};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Ident, LitStr, Result, Token};

/// The options of an attribute that declares names.
pub(super) struct Options<'k> {
    keyword: &'k Ident,
    allowed: &'static [&'static str],
    unit: Option<String>,
    default: Option<f64>,
    any: bool,
}

/// Words that are taken for an option where a name cannot have a value.
const LIKE_OPTIONS: [&str; 9] = ["value", "initial", "init", "start", "min", "max", "units", "dimension", "label"];

impl<'k> Options<'k> {
    pub(super) fn of(keyword: &'k Ident, allowed: &'static [&'static str]) -> Self {
        Self { keyword, allowed, unit: None, default: None, any: false }
    }

    /// Parses an option; false where a name follows.
    pub(super) fn read(&mut self, input: ParseStream) -> Result<bool> {
        let ahead = input.fork();
        let key = ahead.call(Ident::parse_any).ok().filter(|_| ahead.peek(Token![=]) && !ahead.peek(Token![==]));
        let is_text = ahead.parse::<Token![=]>().is_ok() && ahead.peek(LitStr);
        let Some(key) = key.filter(|key| self.is_option(&text(key), is_text)) else {
            return match self.any && !input.is_empty() {
                true => Err(here(input, "options are written after all names, and apply to all of them")),
                false => Ok(false),
            };
        };
        let (name, keyword) = (text(&key), self.keyword);
        input.call(Ident::parse_any)?;
        input.parse::<Token![=]>()?;
        let again = || Error::new(key.span(), format!("`{name}` is given twice; once is enough"));
        self.any = true;
        match name.as_str() {
            "unit" if self.unit.is_some() => return Err(again()),
            "unit" => self.unit = Some(unit(input)?),
            "default" if self.default.is_some() => return Err(again()),
            "default" if self.allowed.contains(&"default") => {
                no_unit_in_default(input)?;
                let value = expr(input)?;
                end_of_expr(input)?;
                self.default = Some(constant(&value, "a default")?);
            }
            _ => {
                let options = quoted(self.allowed.iter().copied(), "and");
                let suggestion = self.suggestion(&name);
                let message = format!("`{keyword}` has no option `{name}`; it has {options}{suggestion}");
                return Err(Error::new(key.span(), message));
            }
        }
        end_of_part(input)?;
        Ok(true)
    }

    fn suggestion(&self, name: &str) -> String {
        if matches!(name, "value" | "initial" | "init" | "start") && !self.allowed.contains(&"default") {
            return "; a start is given with `#[guess(u = 0)]`".to_owned();
        }
        match name {
            "value" | "initial" | "init" | "start" => "; did you mean `default`?".to_owned(),
            _ => did_you_mean(name, self.allowed.iter().copied()),
        }
    }

    /// True if `key = …` is an option, or is meant as one: a define has a value of its own, other names have none.
    fn is_option(&self, key: &str, is_text: bool) -> bool {
        let resembles = LIKE_OPTIONS.contains(&key) || nearest(key, self.allowed.iter().copied()).is_some();
        match self.keyword == "define" {
            true => is_text && (key == "unit" || resembles),
            false => self.allowed.contains(&key) || resembles,
        }
    }

    /// Reports options that apply to no name; false if there are any.
    pub(super) fn have_names(&self, declared: &[Item], form: &str, report: &Report) -> bool {
        if !self.any || !declared.is_empty() {
            return true;
        }
        let keyword = self.keyword;
        let message = format!("`{keyword}` declares no name; names come before the options: `{form}`");
        report.error(keyword.span(), message);
        false
    }

    /// Assigns the options to all items that the attribute has declared.
    pub(super) fn give(self, items: &mut [Item], first: usize) {
        for item in items.iter_mut().skip(first) {
            match item {
                Item::Scalar(decl) => decl.unit = self.unit.clone(),
                Item::Define(decl) => decl.unit = self.unit.clone(),
                Item::Input(decl) => (decl.unit, decl.default) = (self.unit.clone(), self.default),
                _ => {}
            }
        }
    }
}

//! Parsing of options after the names that an attribute declares, which apply to all of these names: `unit = "m"`,
//! `default = 0.3`.

use super::expr::{end_of_expr, expr};
use super::fold::constant;
use super::list::end_of_part;
use super::reject::here;
use crate::ast::{Item, text};
use crate::suggest::{did_you_mean, listed};
use kin_core::units;
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

impl<'k> Options<'k> {
    pub(super) fn of(keyword: &'k Ident, allowed: &'static [&'static str]) -> Self {
        Self { keyword, allowed, unit: None, default: None, any: false }
    }

    /// Parses an option; false where a name follows.
    pub(super) fn read(&mut self, input: ParseStream) -> Result<bool> {
        let ahead = input.fork();
        let key = ahead.call(Ident::parse_any).ok().filter(|_| ahead.peek(Token![=]) && !ahead.peek(Token![==]));
        let is_text = ahead.parse::<Token![=]>().is_ok() && ahead.peek(LitStr);
        let Some(key) = key.filter(|key| is_text || text(key) != "unit" && self.allowed.contains(&text(key).as_str()))
        else {
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
                let value = expr(input)?;
                end_of_expr(input)?;
                self.default = Some(constant(&value, "a default")?);
            }
            _ => {
                let options = listed(self.allowed.iter().copied(), "and");
                let suggestion = did_you_mean(&name, self.allowed.iter().copied());
                let message = format!("`{keyword}` has no option `{name}`; it has {options}{suggestion}");
                return Err(Error::new(key.span(), message));
            }
        }
        end_of_part(input)?;
        Ok(true)
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

/// Parses a known unit, such as `"m"`.
pub(super) fn unit(input: ParseStream) -> Result<String> {
    let unit: LitStr = input
        .parse()
        .map_err(|error: Error| Error::new(error.span(), "a unit is written in quotes: `unit = \"m\"`"))?;
    units::parse(&unit.value()).map_err(|units::UnknownUnit(part)| {
        let forms =
            "units are written as in `m`, `mm`, `rad/s`, `m/s^2` or `N*m`; leave `unit` out for other quantities";
        Error::new(unit.span(), format!("no unit `{part}` is known; {forms}"))
    })?;
    Ok(unit.value())
}

//! Parsing of declarations: bodies, coordinates, inputs, points and defines; and of guesses.

use super::expr::{end_of_expr, expr};
use super::index::{identifier, name_or_family, new_name};
use super::list::{comma, end_of_part, list, skip_part};
use super::options::Options;
use super::point::point;
use super::read::{is_option, no_equals};
use super::reject::here;
use crate::ast::{
    BodyDecl, DefineDecl, Expr, FunctionDecl, GuessDecl, InputDecl, Item, PointDecl, PointExpr, ScalarDecl, text,
};
use crate::report::Report;
use crate::suggest::did_you_mean;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Ident, Result, Token, token};

/// Parses `crank, link[10]`; false when a name could not be read.
pub(super) fn bodies(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    let any = nonempty(input, keyword, "#[bodies(crank, coupler)]", report);
    any && list(input, report, |input| {
        let name = new_name(input, report)?;
        items.push(Item::Body(BodyDecl { name, held: Vec::new(), carried: None }));
        if input.peek(Token![=]) {
            return Err(here(
                input,
                "coordinates given for a body are written in an attribute of its own: `#[body(crank, x = 0, y = 0)]`",
            ));
        }
        Ok(())
    })
}

/// Parses `phi1, u[3], unit = "rad"`.
pub(super) fn coordinates(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    const FORM: &str = "#[coordinates(phi1, phi2)]";
    let any = nonempty(input, keyword, FORM, report);
    let (mut options, first) = (Options::of(keyword, &["unit"]), items.len());
    let complete = list(input, report, |input| {
        if options.read(input)? {
            return Ok(());
        }
        let name = new_name(input, report)?;
        if name.ident == "default" && input.peek(Token![=]) {
            let first_scalar = items[first..].iter().find_map(|item| match item {
                Item::Scalar(scalar) => Some(text(&scalar.name.ident)),
                _ => None,
            });
            let message = format!(
                "`coordinates` has no option `default`; the start of a coordinate is given with `#[guess({} = 0)]`",
                first_scalar.as_deref().unwrap_or("s")
            );
            return Err(Error::new(name.ident.span(), message));
        }
        let start = format!("a coordinate is a name; its start is given with `#[guess({} = 0)]`", name.ident);
        items.push(Item::Scalar(ScalarDecl { name, unit: None }));
        if input.peek(Token![=]) {
            return Err(here(input, start));
        }
        Ok(())
    });
    let complete = any && complete && options.have_names(&items[first..], FORM, report);
    options.give(items, first);
    complete
}

/// Parses `boom_length, u[3], default = 0.3, unit = "m"`.
pub(super) fn inputs(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    const FORM: &str = "#[input(boom_length, stick_length)]";
    let any = nonempty(input, keyword, FORM, report);
    let (mut options, first) = (Options::of(keyword, &["default", "unit"]), items.len());
    let complete = list(input, report, |input| {
        if options.read(input)? {
            return Ok(());
        }
        let name = new_name(input, report)?;
        let caller = format!(
            "an input is declared by its name alone; its value is given at run time, and a default with \
             `#[input({}, default = …)]`",
            name.ident
        );
        items.push(Item::Input(InputDecl { name, unit: None, default: None }));
        if input.peek(Token![=]) {
            return Err(here(input, caller));
        }
        Ok(())
    });
    let complete = any && complete && options.have_names(&items[first..], FORM, report);
    options.give(items, first);
    complete
}

/// Parses `tip = coupler @ (0, 0.1)`.
pub(super) fn points(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    const FORM: &str = "#[point(tip = coupler @ (0, 0.1))]";
    let any = nonempty(input, keyword, FORM, report);
    any && list(input, report, |input| {
        let name = new_name(input, report)?;
        let place = report.ok(equals(input, FORM).and_then(|()| point(input))).unwrap_or(PointExpr::Hole);
        items.push(Item::Point(PointDecl { name, place }));
        Ok(())
    })
}

/// Parses `stroke = slider.x - d1, unit = "m"`.
pub(super) fn defines(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    const FORM: &str = "#[define(stroke = slider.x - d1)]";
    let any = nonempty(input, keyword, FORM, report);
    let (mut options, first) = (Options::of(keyword, &["unit"]), items.len());
    let complete = list(input, report, |input| {
        if options.read(input)? {
            return Ok(());
        }
        let name = new_name(input, report)?;
        let value = equals(input, FORM).and_then(|()| value(input));
        let value = report.ok(value).unwrap_or(Expr::hole(name.ident.span()));
        items.push(Item::Define(DefineDecl { name, value, unit: None }));
        Ok(())
    });
    let complete = any && complete && options.have_names(&items[first..], FORM, report);
    options.give(items, first);
    complete
}

/// An example of `function`.
pub(super) const FUNCTION: &str = "#[function(profile)]";

/// Parses `profile, lift`; false when a name could not be read.
pub(super) fn functions(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    let any = nonempty(input, keyword, FUNCTION, report);
    any && list(input, report, |input| {
        let name = new_name(input, report)?;
        items.push(Item::Function(FunctionDecl { name }));
        if input.peek(Token![=]) {
            return Err(here(
                input,
                format!("a function is a field of the struct, which the caller fills; it is declared `{FUNCTION}`"),
            ));
        }
        if input.peek(token::Paren) {
            return Err(here(
                input,
                format!("a function is declared by its name alone, `{FUNCTION}`, and called in formulas"),
            ));
        }
        Ok(())
    })
}

/// Parses `coupler.phi = 0.9, u = 0.3, link[i in 0..10].phi = 0`.
pub(super) fn guess(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) {
    const FORM: &str = "#[guess(coupler.phi = 0.9)]";
    nonempty(input, keyword, FORM, report);
    list(input, report, |input| {
        let (target, range) = name_or_family(input)?;
        let component = if input.peek(Token![.]) {
            input.parse::<Token![.]>()?;
            if !input.peek(Ident::peek_any) {
                return Err(here(input, "expected `x`, `y` or `phi` after the dot"));
            }
            Some(input.call(Ident::parse_any)?)
        } else {
            None
        };
        let value = report.ok(equals(input, FORM).and_then(|()| value(input)));
        let value = value.unwrap_or(Expr::hole(target.ident.span()));
        items.push(Item::Guess(GuessDecl { target, range, component, value }));
        Ok(())
    });
}

/// Parses `b, x = e, y = e, phi = e` or `b, origin = a @ (ex, ey)`; false when the name could not be read.
pub(super) fn body(input: ParseStream, keyword: &Ident, report: &Report, items: &mut Vec<Item>) -> bool {
    const FORM: &str = "#[body(crank, x = 0, y = 0)]";
    if !nonempty(input, keyword, FORM, report) {
        return false;
    }
    let name = match new_name(input, report) {
        Ok(name) => name,
        Err(error) => {
            report.push(error);
            return false;
        }
    };
    let mut decl = BodyDecl { name, held: Vec::new(), carried: None };
    let mut complete = true;
    finish(end_of_part(input), input, report);
    while !input.is_empty() {
        if !is_option(input) {
            report.push(here(
                input,
                format!("`body` declares one body; what is given follows as `key = value`: `{FORM}`"),
            ));
            // A further name is probably meant as a body.
            complete &= !input.peek(Ident);
            skip_part(input);
            comma(input);
            continue;
        }
        finish(given(input, &mut decl), input, report);
    }
    items.push(Item::Body(decl));
    complete
}

fn given(input: ParseStream, decl: &mut BodyDecl) -> Result<()> {
    const KEYS: [&str; 4] = ["x", "y", "phi", "origin"];
    let key = identifier(input)?;
    input.parse::<Token![=]>()?;
    let name = text(&key);
    let twice = decl.held.iter().any(|(given, _)| text(given) == name) || name == "origin" && decl.carried.is_some();
    if twice {
        return Err(Error::new(key.span(), format!("`{name}` is given twice; one value is enough")));
    }
    match name.as_str() {
        "origin" => {
            // The option counts as given, even if its value cannot be read.
            let (_, slot) = decl.carried.insert((key, PointExpr::Hole));
            *slot = point(input)?;
        }
        "x" | "y" | "phi" => {
            let span = key.span();
            decl.held.push((key, Expr::hole(span)));
            let value = value(input)?;
            if let Some((_, slot)) = decl.held.last_mut() {
                *slot = value;
            }
        }
        _ => {
            let suggestion = did_you_mean(&name, KEYS);
            let message =
                format!("`body` has no option `{name}`; its options are `x`, `y`, `phi` and `origin`{suggestion}");
            return Err(Error::new(key.span(), message));
        }
    }
    end_of_part(input)
}

fn finish(result: Result<()>, input: ParseStream, report: &Report) {
    if report.ok(result).is_none() {
        skip_part(input);
    }
    comma(input);
}

fn value(input: ParseStream) -> Result<Expr> {
    let value = expr(input)?;
    end_of_expr(input)?;
    Ok(value)
}

fn equals(input: ParseStream, form: &str) -> Result<()> {
    if input.peek(Token![=]) && !input.peek(Token![==]) {
        input.parse::<Token![=]>()?;
        return Ok(());
    }
    Err(no_equals(input, form))
}

/// False for an empty attribute, which is reported.
fn nonempty(input: ParseStream, keyword: &Ident, form: &str, report: &Report) -> bool {
    if input.is_empty() {
        report.error(keyword.span(), format!("`{keyword}` is empty; it is written `{form}`"));
        return false;
    }
    true
}

//! Parsing of options that name the variables of a curve: `polar(theta) = e`, `implicit(X, Y) = e`, `parametric(u) =
//! (ex, ey)`.

use super::expr::{end_of_expr, expr, pair};
use super::index::name_use;
use super::list::comma;
use super::parts::Parts;
use super::reject::here;
use crate::ast::{CurveExpr, Expr, OperandExpr, PathExpr, text};
use crate::suggest::quoted;
use proc_macro2::TokenTree;
use syn::parse::ParseStream;
use syn::{Error, Ident, Result, Token, parenthesized, token};

/// The options of `on_curve` that define a curve; a statement has exactly one of them.
const CURVES: [&str; 3] = ["polar", "implicit", "parametric"];

/// True for `word(…) =`, followed by anything.
pub(super) fn is_bracketed(input: ParseStream) -> bool {
    let ahead = input.fork();
    input.peek(Ident)
        && input.peek2(token::Paren)
        && ahead.parse::<Ident>().is_ok()
        && ahead.parse::<TokenTree>().is_ok()
        && ahead.peek(Token![=])
        && !ahead.peek(Token![==])
}

/// Parses `(theta) = e` after the key; `variables` are the fixed names in the parentheses.
pub(super) fn formula(input: ParseStream, key: &Ident, variables: &[&str]) -> Result<OperandExpr> {
    let form = format!("{key}({}) = …", variables.join(", "));
    let content = brackets(input, key, &form)?;
    let are = if variables.len() == 1 { "variable of" } else { "variables of" };
    let verb = if variables.len() == 1 { "is" } else { "are" };
    let wrong = format!("the {are} `{key}` {verb} called {}: `{form}`", quoted(variables.iter().copied(), "and"));
    for (k, variable) in variables.iter().enumerate() {
        if k > 0 {
            content.parse::<Token![,]>().map_err(|error| Error::new(error.span(), &wrong))?;
        }
        let word: Ident = content.parse().map_err(|error: Error| Error::new(error.span(), &wrong))?;
        if text(&word) != *variable {
            return Err(Error::new(word.span(), &wrong));
        }
    }
    ends(&content, &wrong)?;
    equals(input, &form)?;
    let value = expr(input)?;
    end_of_expr(input)?;
    Ok(OperandExpr::Value(value))
}

/// Parses `(u) = (ex, ey)` after the key.
pub(super) fn path(input: ParseStream, key: &Ident) -> Result<OperandExpr> {
    let form = format!("{key}(u) = (…, …)");
    let content = brackets(input, key, &form)?;
    let wrong = format!("`{key}` names its parameter, a scalar coordinate: `{form}`");
    if content.is_empty() {
        return Err(Error::new(key.span(), wrong));
    }
    let parameter = name_use(&content)?;
    ends(&content, &wrong)?;
    equals(input, &form)?;
    let (x, y, span) = pair(input, 0, &format!("a parametric curve is a pair in the frame of its body: `{form}`"))?;
    let path = PathExpr { parameter, x, y, span, roller: None };
    Ok(OperandExpr::Curve(CurveExpr::Parametric(Box::new(path))))
}

fn brackets<'i>(input: ParseStream<'i>, key: &Ident, form: &str) -> Result<syn::parse::ParseBuffer<'i>> {
    if !input.peek(token::Paren) {
        return Err(Error::new(key.span(), format!("`{key}` is written with brackets: `{form}`")));
    }
    let content;
    parenthesized!(content in input);
    Ok(content)
}

fn ends(content: ParseStream, wrong: &str) -> Result<()> {
    comma(content);
    if content.is_empty() { Ok(()) } else { Err(here(content, wrong)) }
}

fn equals(input: ParseStream, form: &str) -> Result<()> {
    if input.peek(Token![=]) && !input.peek(Token![==]) {
        input.parse::<Token![=]>()?;
        return Ok(());
    }
    Err(here(input, format!("expected `=` and the curve: `{form}`")))
}

impl Parts<'_> {
    /// The curve of `on_curve` and its roller.
    pub(super) fn curve(&mut self) -> CurveExpr {
        let keys = || self.options.iter().map(|(key, _)| key);
        let given: Vec<Ident> = keys().filter(|key| CURVES.contains(&text(key).as_str())).cloned().collect();
        let roller_key = keys().find(|key| text(key) == "roller").cloned();
        let roller = self.take("roller").map(|value| match value {
            Some(OperandExpr::Value(expr)) => expr,
            _ => Expr::hole(self.keyword.span()),
        });
        let values: Vec<Option<OperandExpr>> = CURVES.iter().filter_map(|key| self.take(key)).collect();
        let [key] = &given[..] else {
            match given.get(1) {
                Some(second) => {
                    let message = format!("a curve is written in one way; this row has `{}` already", given[0]);
                    self.report.error(second.span(), message);
                }
                None if !self.lost_option => {
                    let message = format!(
                        "`{}` needs its curve: `polar(theta) = …`, `implicit(X, Y) = …` or `parametric(u) = (…, …)`",
                        self.keyword
                    );
                    self.report.error(self.keyword.span(), message);
                }
                None => {}
            }
            return CurveExpr::Hole;
        };
        if let (Some(roller), true) = (roller_key, key != "parametric") {
            let message = format!(
                "a `roller` needs the direction in which its curve runs, which `{key}` does not tell; \
                 write it as a parametric one: `parametric(u) = (…, …), roller = …`"
            );
            self.report.error(roller.span(), message);
        }
        match values.into_iter().next().flatten() {
            Some(OperandExpr::Curve(CurveExpr::Parametric(path))) => {
                CurveExpr::Parametric(Box::new(PathExpr { roller, ..*path }))
            }
            Some(OperandExpr::Value(value)) if key == "polar" => CurveExpr::Polar(value),
            Some(OperandExpr::Value(value)) => CurveExpr::Implicit(value),
            _ => CurveExpr::Hole,
        }
    }
}

//! Parsing of the fields of the struct and of `#[param(default, unit = "m")]`.

use super::docs::first_paragraph;
use super::expr::{end_of_expr, expr};
use super::fold::constant;
use super::generics::scalar_parameter;
use super::index::letters;
use super::keyword::{self, Keyword};
use super::list::{comma, end_of_part, inside, skip_part};
use super::read::is_option;
use super::reject::here;
use super::unit::unit;
use crate::ast::{FieldDecl, text};
use crate::report::Report;
use crate::suggest::did_you_mean;
use kin_core::check::MAX_MEMBERS;
use proc_macro2::{Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::spanned::Spanned;
use syn::{Attribute, Error, Expr, ExprLit, Field, Ident, Lit, Meta, Result, Token, Type, bracketed, token};

const FORM: &str = "#[param(0.1, unit = \"m\")]";

/// A default as written: one number for all elements, or one number for each element.
enum Default {
    One(f64),
    Each(Vec<f64>, Span),
}

#[derive(Default)]
struct Param {
    default: Option<Default>,
    unit: Option<String>,
}

/// Removes the attributes of kin from a field and reads the field. The flag `names_missing` is set when an attribute
/// that declares names could not be used. `types` are the type parameters of the struct, `functions` the names of the
/// fields that hold functions.
pub(super) fn field(
    field: &mut Field,
    types: &[Ident],
    functions: &[String],
    report: &Report,
    names_missing: &mut bool,
) -> Option<FieldDecl> {
    let mut is_function = field.ident.as_ref().is_some_and(|ident| functions.contains(&text(ident)));
    let mut param: Option<Param> = None;
    let attributes = std::mem::take(&mut field.attrs);
    for attribute in attributes {
        let Some(word) = attribute.path().get_ident().cloned() else {
            field.attrs.push(attribute);
            continue;
        };
        let name = text(&word);
        match keyword::find(&name) {
            Some(Keyword::Param) if is_function => {
                let name = field.ident.as_ref().map(text).unwrap_or_default();
                let message = format!(
                    "`{name}` is declared as a function; a function has no default and no unit, leave `param` away"
                );
                report.error(word.span(), message);
            }
            Some(Keyword::Param) if param.is_some() => {
                report.error(word.span(), "`param` is given twice; one default and one unit are enough");
            }
            Some(Keyword::Param) => param = Some(read_param(&attribute, report)),
            Some(Keyword::Function) => {
                // The field counts as a declared function, so that its type is not reported as another error.
                (*names_missing, is_function) = (true, true);
                let field = field.ident.as_ref().map(text).unwrap_or_default();
                let message = format!("`function` stands above the struct and names the field: `#[function({field})]`");
                report.error(word.span(), message);
            }
            Some(other) => {
                *names_missing |= other.declares();
                let message = format!("`{name}` stands above the struct; a field takes `{FORM}`");
                report.error(word.span(), message);
            }
            None if name == "cfg" => {
                let message = "a parameter cannot depend on `cfg`; the whole mechanism can";
                report.error(word.span(), message);
            }
            None if name == "cfg_attr" && holds_param(&attribute) => {
                report.error(word.span(), format!("`param` stands alone, not inside `cfg_attr`: `{FORM}`"));
            }
            None => match keyword::near_miss(&name) {
                Some((message, declares)) => {
                    *names_missing |= declares;
                    report.error(word.span(), message);
                }
                None => field.attrs.push(attribute),
            },
        }
    }
    let ident = field.ident.clone()?;
    report.ok(letters(&ident));
    if is_function {
        let len = report.ok(function_len(&field.ty));
        let doc = first_paragraph(&field.attrs);
        let ty = field.ty.clone();
        let (is_len_unknown, len) = (len.is_none() && is_array(&ty), len.flatten());
        let (scalar, default, unit) = (None, None, None);
        return Some(FieldDecl { ident, ty, is_function, len, is_len_unknown, scalar, default, unit, doc });
    }
    let len = report.ok(array_len(&field.ty, types));
    let scalar = len.and_then(|_| report.ok(scalar_parameter(&field.ty, types))).flatten();
    let Param { default, unit } = param.unwrap_or_default();
    let default = match (default, len) {
        (Some(default), Some(len)) => report.ok(elements(default, len, &text(&ident))),
        _ => None,
    };
    let doc = first_paragraph(&field.attrs);
    let (is_len_unknown, len) = (len.is_none() && is_array(&field.ty), len.flatten());
    let ty = field.ty.clone();
    Some(FieldDecl { ident, ty, is_function, len, is_len_unknown, scalar, default, unit, doc })
}

/// True for `#[cfg_attr(…, param(…))]`.
fn holds_param(attribute: &Attribute) -> bool {
    let Meta::List(list) = &attribute.meta else { return false };
    list.tokens.clone().into_iter().any(|tree| matches!(tree, TokenTree::Ident(word) if word == "param"))
}

fn read_param(attribute: &Attribute, report: &Report) -> Param {
    let mut param = Param::default();
    // `#[param]` marks a parameter without a default.
    if matches!(attribute.meta, Meta::Path(_)) {
        return param;
    }
    let Some(word) = attribute.path().get_ident() else { return param };
    inside(attribute, word, FORM, report, |input| {
        let mut first = true;
        while !input.is_empty() {
            if report.ok(part(input, first, &mut param)).is_none() {
                skip_part(input);
            }
            comma(input);
            first = false;
        }
        Ok(())
    });
    param
}

fn part(input: ParseStream, first: bool, param: &mut Param) -> Result<()> {
    if is_option(input) {
        let key = input.call(Ident::parse_any)?;
        input.parse::<Token![=]>()?;
        let name = text(&key);
        if name != "unit" {
            let suggestion = did_you_mean(&name, ["unit"]);
            let message = format!("`param` has no option `{name}`; it is written `{FORM}`{suggestion}");
            return Err(Error::new(key.span(), message));
        }
        if param.unit.is_some() {
            return Err(Error::new(key.span(), "`unit` is given twice; one is enough"));
        }
        param.unit = Some(unit(input)?);
        return end_of_part(input);
    }
    if !first {
        return Err(here(input, format!("a parameter has one default, then its unit: `{FORM}`")));
    }
    param.default = Some(if input.peek(token::Bracket) { each(input)? } else { Default::One(number(input)?) });
    end_of_part(input)
}

fn each(input: ParseStream) -> Result<Default> {
    let content;
    let brackets = bracketed!(content in input);
    let mut values = Vec::new();
    while !content.is_empty() {
        values.push(expr(&content).and_then(|value| {
            if content.peek(Token![;]) {
                return Err(here(&content, "one number stands for all elements: `#[param(0.1)]`"));
            }
            end_of_expr(&content)?;
            constant(&value, "a default")
        })?);
        if !content.is_empty() {
            content.parse::<Token![,]>()?;
        }
    }
    Ok(Default::Each(values, brackets.span.join()))
}

fn number(input: ParseStream) -> Result<f64> {
    let value = expr(input)?;
    end_of_expr(input)?;
    constant(&value, "a default")
}

/// The default values of all elements.
fn elements(default: Default, len: Option<usize>, name: &str) -> Result<Vec<f64>> {
    match (default, len) {
        (Default::One(value), len) => Ok(vec![value; len.unwrap_or(1)]),
        (Default::Each(_, span), None) => {
            Err(Error::new(span, format!("`{name}` is a single number; its default is one number")))
        }
        (Default::Each(values, span), Some(len)) if values.len() != len => {
            let given = values.len();
            Err(Error::new(
                span,
                format!("`{name}` has {len} elements and {given} defaults; give one for each, or one number for all"),
            ))
        }
        (Default::Each(values, _), Some(_)) => Ok(values),
    }
}

/// Types that are known not to be parameters; other types are checked by the compiler.
const NO_NUMBERS: [&str; 22] = [
    "bool", "char", "i8", "i16", "i32", "i64", "i128", "isize", "str", "u8", "u16", "u32", "u64", "u128", "usize",
    "Arc", "Box", "Rc", "HashMap", "Option", "String", "Vec",
];

/// Types that contain another type, which may be a function.
const HOLDERS: [&str; 3] = ["Arc", "Box", "Rc"];

fn no_number(ty: &Type) -> Error {
    let is_holder = match ty {
        Type::Path(path) => path.path.segments.last().is_some_and(|s| HOLDERS.contains(&text(&s.ident).as_str())),
        Type::Reference(_) => true,
        _ => false,
    };
    let function = if is_holder {
        "; a field that holds a function is declared with `#[function(name)]` above the struct"
    } else {
        ""
    };
    let message = format!("a parameter is a number such as `f64` or an array of numbers such as `[f64; 10]`{function}");
    Error::new_spanned(ty, message)
}

fn is_array(ty: &Type) -> bool {
    match ty {
        Type::Group(group) => is_array(&group.elem),
        Type::Paren(paren) => is_array(&paren.elem),
        ty => matches!(ty, Type::Array(_)),
    }
}

/// The length of an array of functions; `None` for a single function of any type.
fn function_len(ty: &Type) -> Result<Option<usize>> {
    match ty {
        Type::Group(group) => function_len(&group.elem),
        Type::Paren(paren) => function_len(&paren.elem),
        Type::Array(array) => match &*array.elem {
            Type::Array(inner) => Err(Error::new(inner.span(), "an array of functions has one index: `[Spline; 3]`")),
            _ => literal_len(&array.len).map(Some),
        },
        _ => Ok(None),
    }
}

/// The length of an array type; `None` for a single number.
fn array_len(ty: &Type, types: &[Ident]) -> Result<Option<usize>> {
    match ty {
        Type::Group(group) => array_len(&group.elem, types),
        Type::Paren(paren) => array_len(&paren.elem, types),
        Type::Path(path) if path.path.get_ident().is_some_and(|ident| types.contains(ident)) => Ok(None),
        Type::Path(path)
            if path.path.segments.last().is_some_and(|s| NO_NUMBERS.contains(&text(&s.ident).as_str())) =>
        {
            Err(no_number(ty))
        }
        Type::Path(_) | Type::Macro(_) => Ok(None),
        Type::Array(array) => {
            if array_len(&array.elem, types)?.is_some() {
                return Err(Error::new(array.elem.span(), "an array parameter has one index: `[f64; 10]`"));
            }
            literal_len(&array.len).map(Some)
        }
        _ => Err(no_number(ty)),
    }
}

fn literal_len(len: &Expr) -> Result<usize> {
    let wrong = || Error::new(len.span(), "the length of an array field is an integer literal: `[f64; 10]`");
    match len {
        Expr::Group(group) => literal_len(&group.expr),
        Expr::Lit(ExprLit { lit: Lit::Int(int), .. }) => match int.base10_parse::<usize>() {
            Ok(n) if n <= MAX_MEMBERS => Ok(n),
            _ => Err(Error::new(int.span(), format!("an array field has at most {MAX_MEMBERS} elements"))),
        },
        _ => Err(wrong()),
    }
}

//! From tokens to [`Description`]: parses the attributes and reports all syntax errors, without resolving names.

mod call;
mod condition;
mod curve;
mod declare;
mod docs;
mod expr;
mod field;
mod flags;
mod flatten;
mod fold;
mod forms;
mod generics;
mod guessed;
mod index;
mod keyword;
mod list;
mod node;
mod options;
mod parts;
mod point;
mod read;
mod reject;
mod row_name;
mod strip;
mod unit;
mod written;

pub(crate) use generics::mentioned;
#[cfg(test)]
pub(crate) use keyword::vocabulary;
pub(crate) use strip::without_ours;

use crate::ast::{Description, FieldDecl, Flags, Item, Statement, text};
use crate::report::Report;
use crate::suggest::quoted;
use forms::KeywordForm;
use keyword::Keyword;
use list::inside;
use parts::Parts;
use proc_macro2::{Span, TokenStream};
use row_name::{row_name, row_name_or_keyword};
use syn::parse::ParseStream;
use syn::spanned::Spanned;
use syn::{Attribute, Error, Fields, Ident, ItemStruct, Meta, Result, Token};

/// Returns the struct without the attributes of kin, and the description in these attributes and its fields.
///
/// There is no description if the item is not a struct with named fields.
pub(crate) fn parse(
    args: TokenStream,
    item: TokenStream,
    report: &Report,
) -> (Option<ItemStruct>, Option<Description>) {
    for tokens in [&args, &item] {
        if let Some(span) = flatten::too_deep(tokens) {
            report.error(span, format!("brackets are nested more than {} deep", flatten::MAX_NESTING));
            return (None, None);
        }
    }
    if let Some(span) = flatten::too_tangled(&item) {
        report.error(span, "this is nested too deep; the fields of a mechanism are numbers and arrays of numbers");
        return (None, None);
    }
    let flags = flags::flags(args, report);
    let Some(mut item) = report.ok(parse_struct(item)) else { return (None, None) };
    if generics::reserved(&item, report) {
        return (None, None);
    }
    let description = describe(&mut item, flags, report);
    (Some(item), description)
}

fn parse_struct(item: TokenStream) -> Result<ItemStruct> {
    let wrong = "a mechanism is a struct; its fields are the parameters";
    match syn::parse2::<syn::Item>(item)? {
        syn::Item::Struct(item) => Ok(item),
        syn::Item::Enum(item) => Err(Error::new(item.enum_token.span, wrong)),
        syn::Item::Union(item) => Err(Error::new(item.union_token.span, wrong)),
        syn::Item::Fn(item) => Err(Error::new(item.sig.fn_token.span, wrong)),
        // The span of other items begins at their attributes.
        syn::Item::Mod(item) => Err(Error::new(item.mod_token.span, wrong)),
        syn::Item::Trait(item) => Err(Error::new(item.trait_token.span, wrong)),
        syn::Item::Impl(item) => Err(Error::new(item.impl_token.span, wrong)),
        syn::Item::Type(item) => Err(Error::new(item.type_token.span, wrong)),
        syn::Item::Const(item) => Err(Error::new(item.const_token.span, wrong)),
        syn::Item::Static(item) => Err(Error::new(item.static_token.span, wrong)),
        other => Err(Error::new(other.span(), wrong)),
    }
}

fn describe(item: &mut ItemStruct, flags: Flags, report: &Report) -> Option<Description> {
    report.ok(index::letters(&item.ident));
    let mut names_missing = false;
    let mut items = Vec::new();
    let mut other_attributes = Vec::new();
    let has_others = item.attrs.iter().any(guessed::derives_of_others);
    for attribute in std::mem::take(&mut item.attrs) {
        let Some(word) = attribute.path().get_ident().cloned() else {
            other_attributes.push(attribute);
            continue;
        };
        let name = text(&word);
        if let Some(keyword) = keyword::find(&name) {
            let complete = read(&attribute, &word, keyword, report, &mut items);
            names_missing |= keyword.declares() && !complete;
        } else if let Some((message, declares)) =
            guessed::guessed(&name).filter(|_| !has_others).or_else(|| keyword::near_miss(&name))
        {
            report.error(word.span(), message);
            names_missing |= declares;
        } else {
            other_attributes.push(attribute);
        }
    }
    item.attrs = other_attributes;
    let functions: Vec<String> = (items.iter())
        .filter_map(|item| match item {
            Item::Function(decl) => Some(text(&decl.name.ident)),
            _ => None,
        })
        .collect();
    let fields = fields(item, &functions, report, &mut names_missing)?;
    let derived = item.attrs.iter().find_map(derived_default);
    if let Some(default) = derived {
        keeps_defaults(default, &fields, report);
    }
    if flags.cross_check {
        generics::testable(item, &fields, report);
    }
    Some(Description {
        name: item.ident.clone(),
        items,
        fields,
        flags,
        doc: docs::first_paragraph(&item.attrs),
        derives_default: derived.is_some(),
        names_missing,
    })
}

/// Parses one attribute of kin; false when it could not be read completely.
fn read(attribute: &Attribute, word: &Ident, keyword: Keyword, report: &Report, items: &mut Vec<Item>) -> bool {
    let form = match keyword {
        Keyword::Bodies => "#[bodies(crank, coupler)]",
        Keyword::Body => "#[body(crank, x = 0, y = 0)]",
        Keyword::Coordinates => "#[coordinates(phi1, phi2)]",
        Keyword::Input => "#[input(boom_length, stick_length)]",
        Keyword::Point => "#[point(tip = coupler @ (0, 0.1))]",
        Keyword::Define => "#[define(stroke = slider.x - d1)]",
        Keyword::Guess => "#[guess(coupler.phi = 0.9)]",
        Keyword::Function => declare::FUNCTION,
        Keyword::Statement(form) => form.example(),
        Keyword::Condition => condition::EXAMPLE,
        Keyword::Param => {
            report.error(word.span(), "`param` stands on a field of the struct: `#[param(0.1, unit = \"m\")] l1: f64`");
            return true;
        }
        Keyword::Mechanism => {
            report.error(word.span(), "`mechanism` stands above the struct once, before its other attributes");
            return true;
        }
    };
    let complete = inside(attribute, word, form, report, |input| {
        Ok(match keyword {
            Keyword::Bodies => declare::bodies(input, word, report, items),
            Keyword::Body => declare::body(input, word, report, items),
            Keyword::Coordinates => declare::coordinates(input, word, report, items),
            Keyword::Input => declare::inputs(input, word, report, items),
            Keyword::Point => declare::points(input, word, report, items),
            Keyword::Define => declare::defines(input, word, report, items),
            Keyword::Guess => {
                declare::guess(input, word, report, items);
                true
            }
            Keyword::Function => declare::functions(input, word, report, items),
            Keyword::Statement(form) => {
                items.push(Item::Statement(Box::new(statement(input, word, form, report)?)));
                true
            }
            Keyword::Condition => {
                items.push(Item::Condition(Box::new(condition::condition(input, word, report)?)));
                true
            }
            Keyword::Param | Keyword::Mechanism => true,
        })
    });
    // Names declared before the error are known; later ones may be missing.
    complete.unwrap_or(false)
}

fn statement(
    input: ParseStream,
    keyword: &Ident,
    keyword_form: &'static KeywordForm,
    report: &Report,
) -> Result<Statement> {
    let name = match keyword_form.is_named() {
        true => row_name(input, keyword, keyword_form.example(), report)?,
        false => row_name_or_keyword(input, keyword, report)?,
    };
    let (form, operands) = Parts::read(input, keyword, keyword_form, report).operands();
    Ok(Statement { keyword: keyword.clone(), name, form, operands })
}

fn fields(
    item: &mut ItemStruct,
    functions: &[String],
    report: &Report,
    names_missing: &mut bool,
) -> Option<Vec<FieldDecl>> {
    let span = item.fields.span();
    let named = !matches!(item.fields, Fields::Unnamed(_));
    let types = generics::type_parameters(&item.generics);
    let mut read = |field| field::field(field, &types, functions, report, names_missing);
    let read = item.fields.iter_mut().map(&mut read).collect::<Vec<_>>();
    if !named {
        report.error(span, "the parameters of a mechanism have names: `struct FourBar { l1: f64 }`");
        return None;
    }
    Some(read.into_iter().flatten().collect())
}

/// True for `#[param(…)]` and its misspellings.
pub(crate) fn near_param(attribute: &Attribute) -> bool {
    attribute.path().get_ident().is_some_and(|word| keyword::is_nearly(&text(word), "param"))
}

/// An error if a derived `Default` would discard the defaults of fields, because it sets all numbers to 0.
fn keeps_defaults(default: Span, fields: &[FieldDecl], report: &Report) {
    let given: Vec<String> =
        fields.iter().filter(|field| field.default.is_some()).map(|field| text(&field.ident)).collect();
    if given.is_empty() {
        return;
    }
    let (noun, them) = if given.len() == 1 { ("default", "it") } else { ("defaults", "them") };
    let names = given.iter().map(String::as_str);
    let right = match fields.iter().find(|field| field.default.is_none()) {
        None => format!("kin implements `Default` with {them}"),
        Some(field) => {
            format!("kin implements `Default` if every field has a default, and `{}` has none", text(&field.ident))
        }
    };
    let message = format!(
        "a derived `Default` sets every number to 0 and ignores the {noun} of {}; remove it: {right}",
        quoted(names, "and")
    );
    report.error(default, message);
}

/// The place of `Default` among the traits of a `derive`.
pub(crate) fn derived_default(attribute: &Attribute) -> Option<Span> {
    let Meta::List(list) = &attribute.meta else { return None };
    let paths = syn::punctuated::Punctuated::<syn::Path, Token![,]>::parse_terminated;
    if !attribute.path().is_ident("derive") {
        return None;
    }
    let traits = list.parse_args_with(paths).ok()?;
    traits.iter().filter_map(|path| path.segments.last()).find(|s| s.ident == "Default").map(|s| s.ident.span())
}

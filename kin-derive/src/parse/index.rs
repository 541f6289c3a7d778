//! Parsing of names with brackets: `link[10]`, `N[i in 0..10]`, and of indices such as `link[2*i + 1]`.

use super::docs::inner_doc;
use super::reject::here;
use crate::ast::{Bracket, IndexExpr, NameUse, NewName, RangeDecl, text};
use crate::report::Report;
use kin_core::check::MAX_MEMBERS;
use proc_macro2::{Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Ident, LitInt, Result, Token, bracketed, token};

/// The largest number in an index; families are much smaller.
const MAX_NUMBER: i64 = 1_000_000;

/// Parses the name in a declaration with its doc comment. Brackets that cannot be read are reported and become a hole,
/// so that the name is known nevertheless.
pub(super) fn new_name(input: ParseStream, report: &Report) -> Result<NewName> {
    let doc = inner_doc(input)?;
    let ident = identifier(input)?;
    if !input.peek(token::Bracket) {
        return Ok(NewName { ident, bracket: None, doc });
    }
    let mut words: Vec<String> = first_word(input).into_iter().collect();
    let mut read = report.ok(bracket(input));
    while input.peek(token::Bracket) {
        words.extend(first_word(input));
        let group: TokenTree = input.parse()?;
        report.error(group.span(), "members of a family are counted by one index: `N[i in 0..10]`");
        read = None;
    }
    Ok(NewName { ident, bracket: Some(read.unwrap_or(Bracket::Hole(words))), doc })
}

/// The word at the beginning of the brackets that follow.
fn first_word(input: ParseStream) -> Option<String> {
    let ahead = input.fork();
    let in_brackets = |ahead: ParseStream| {
        let content;
        bracketed!(content in ahead);
        let word = content.call(Ident::parse_any)?;
        while content.parse::<TokenTree>().is_ok() {}
        Ok(word)
    };
    in_brackets(&ahead).ok().map(|word| text(&word))
}

/// Parses a use of a name, or of all members of a family: `link[i in 0..10]`.
pub(super) fn name_or_family(input: ParseStream) -> Result<(NameUse, Option<RangeDecl>)> {
    let ident = identifier(input)?;
    if !input.peek(token::Bracket) {
        return Ok((NameUse { ident, index: None }, None));
    }
    let content;
    let brackets = bracketed!(content in input);
    let span = brackets.span.join();
    if !is_range(&content) {
        return Ok((NameUse { ident, index: Some(linear(&content, span)?) }, None));
    }
    let range = range(&content, span)?;
    let index = IndexExpr { scale: 1, variable: Some(range.variable.clone()), offset: 0, span };
    Ok((NameUse { ident, index: Some(index) }, Some(range)))
}

fn is_range(content: ParseStream) -> bool {
    content.peek(Ident::peek_any) && content.peek2(Token![in])
}

/// Parses a use of a name.
pub(super) fn name_use(input: ParseStream) -> Result<NameUse> {
    let ident = identifier(input)?;
    let index = if input.peek(token::Bracket) { Some(index(input)?) } else { None };
    if input.peek(token::Bracket) {
        return Err(here(input, "a member of a family has one index: `link[3]`, `link[i + 1]`"));
    }
    Ok(NameUse { ident, index })
}

/// Parses an identifier; for a keyword of Rust the error says how to write it as a raw identifier.
pub(super) fn identifier(input: ParseStream) -> Result<Ident> {
    if !input.peek(Ident) && input.peek(Ident::peek_any) {
        let word = Ident::parse_any(input)?;
        let name = text(&word);
        let message = match name.as_str() {
            "self" | "Self" if input.peek(Token![.]) => "names stand alone: `l1`, not `self.l1`".to_owned(),
            "self" | "Self" => format!("`{name}` is a keyword of Rust and cannot be a name; choose another one"),
            "super" | "crate" | "_" => format!("expected a name, found `{name}`"),
            _ => format!("`{name}` is a keyword of Rust; as a name it is written `r#{name}`"),
        };
        return Err(Error::new(word.span(), message));
    }
    let name = input.parse().map_err(|error: Error| Error::new(error.span(), "expected a name"))?;
    letters(&name).map(|()| name)
}

/// An error unless a word can be a name of Rust: the compiler passes emoji to macros as if they were names.
pub(super) fn letters(word: &Ident) -> Result<()> {
    let name = text(word);
    let mut letters = name.chars();
    let is_name = letters.next().is_some_and(|first| first == '_' || unicode_ident::is_xid_start(first))
        && letters.all(unicode_ident::is_xid_continue);
    if is_name {
        return Ok(());
    }
    Err(Error::new(word.span(), format!("`{name}` is no name; a name is made of letters, digits and `_`")))
}

fn bracket(input: ParseStream) -> Result<Bracket> {
    let content;
    let brackets = bracketed!(content in input);
    let span = brackets.span.join();
    if is_range(&content) {
        return range(&content, span).map(Bracket::Range);
    }
    if content.peek(LitInt) && content.peek2(Token![..]) {
        return Err(here(&content, "a range names its index: `N[i in 0..10]`"));
    }
    let len = whole_number(&content).map_err(|error| {
        let right =
            "brackets of a new name hold a length, `link[10]`, or a range, `N[i in 0..10]`; both are integer literals";
        Error::new(error.span(), right)
    })?;
    nothing_left(&content, "a length is one integer literal, `link[10]`")?;
    match usize::try_from(len.0) {
        Ok(0) | Err(_) if len.0 <= 0 => Err(Error::new(len.1, "a family has at least one member")),
        Ok(n) if n <= MAX_MEMBERS => Ok(Bracket::Len(n, span)),
        _ => Err(Error::new(len.1, format!("a family has at most {MAX_MEMBERS} members"))),
    }
}

fn range(content: ParseStream, span: Span) -> Result<RangeDecl> {
    let variable = identifier(content)?;
    content.parse::<Token![in]>()?;
    let literal = |input: ParseStream| {
        whole_number(input)
            .map_err(|error| Error::new(error.span(), "bounds of a range are integer literals: `N[i in 0..10]`"))
    };
    let (start, start_span) = literal(content)?;
    if content.peek(Token![..=]) || content.peek(Token![...]) {
        return Err(here(content, "a range is written `start..end` and ends before `end`"));
    }
    content
        .parse::<Token![..]>()
        .map_err(|error| Error::new(error.span(), "a range is written `i in start..end`: `N[i in 0..10]`"))?;
    let (end, end_span) = literal(content)?;
    nothing_left(content, "a range is written `i in start..end`: `N[i in 0..10]`")?;
    if start < 0 {
        return Err(Error::new(start_span, "a range begins at 0 or later"));
    }
    if end > MAX_MEMBERS as i64 {
        return Err(Error::new(end_span, format!("a range ends at {MAX_MEMBERS} at the latest")));
    }
    if start >= end {
        return Err(Error::new(
            end_span,
            format!("the range {start}..{end} is empty; its second bound is not included"),
        ));
    }
    Ok(RangeDecl { variable, start, end, span })
}

/// Parses `[2*i + 1]`.
fn index(input: ParseStream) -> Result<IndexExpr> {
    let content;
    let brackets = bracketed!(content in input);
    linear(&content, brackets.span.join())
}

fn linear(content: ParseStream, span: Span) -> Result<IndexExpr> {
    if content.is_empty() {
        return Err(Error::new(span, "an index is missing: `link[3]`, `link[i + 1]`"));
    }
    if is_range(content) {
        let message = "a range is written after the name of the row: `N[i in 0..10]: link[i] @ (0, 0), …`";
        return Err(Error::new(span, message));
    }
    let sum = sum(content)?;
    nothing_left(content, "an index is linear in the index variable: `3`, `i + 1`, `2*i`")?;
    Ok(IndexExpr { scale: sum.scale, variable: sum.variable, offset: sum.offset, span })
}

/// An index expression during parsing: `scale * variable + offset`.
struct Linear {
    scale: i64,
    variable: Option<Ident>,
    offset: i64,
}

impl Linear {
    fn add(self, other: Self, sign: i64, span: Span) -> Result<Self> {
        if let (Some(a), Some(b)) = (&self.variable, &other.variable)
            && text(a) != text(b)
        {
            return Err(Error::new(b.span(), "an index has one variable"));
        }
        Self {
            scale: self.scale.saturating_add(other.scale.saturating_mul(sign)),
            variable: self.variable.or(other.variable),
            offset: self.offset.saturating_add(other.offset.saturating_mul(sign)),
        }
        .bounded(span)
    }

    fn mul(self, other: Self, span: Span) -> Result<Self> {
        let (factor, linear) = match (&self.variable, &other.variable) {
            (None, _) => (self.offset, other),
            (_, None) => (other.offset, self),
            _ => return Err(Error::new(span, "an index is linear in the index variable: `3`, `i + 1`, `2*i`")),
        };
        Self {
            scale: linear.scale.saturating_mul(factor),
            variable: linear.variable,
            offset: linear.offset.saturating_mul(factor),
        }
        .bounded(span)
    }

    fn bounded(self, span: Span) -> Result<Self> {
        if self.scale.abs() > MAX_NUMBER || self.offset.abs() > MAX_NUMBER {
            return Err(Error::new(span, format!("numbers in an index are at most {MAX_NUMBER}")));
        }
        Ok(self)
    }
}

fn sum(input: ParseStream) -> Result<Linear> {
    let mut total = product(input)?;
    loop {
        let sign = match () {
            () if input.peek(Token![+]) => input.parse::<Token![+]>().map(|_| 1)?,
            () if input.peek(Token![-]) => input.parse::<Token![-]>().map(|_| -1)?,
            () => return Ok(total),
        };
        let span = input.span();
        total = total.add(product(input)?, sign, span)?;
    }
}

fn product(input: ParseStream) -> Result<Linear> {
    let mut total = factor(input)?;
    while input.peek(Token![*]) {
        input.parse::<Token![*]>()?;
        let span = input.span();
        total = total.mul(factor(input)?, span)?;
    }
    Ok(total)
}

fn factor(input: ParseStream) -> Result<Linear> {
    let mut sign = 1;
    while input.peek(Token![-]) {
        input.parse::<Token![-]>()?;
        sign = -sign;
    }
    let span = input.span();
    let value = if input.peek(token::Paren) {
        let content;
        syn::parenthesized!(content in input);
        let inner = sum(&content)?;
        nothing_left(&content, "an index is linear in the index variable: `3`, `i + 1`, `2*i`")?;
        inner
    } else if input.peek(Ident::peek_any) {
        Linear { scale: 1, variable: Some(identifier(input)?), offset: 0 }
    } else {
        let (offset, _) = whole_number(input)?;
        Linear { scale: 0, variable: None, offset }
    };
    value.mul(Linear { scale: 0, variable: None, offset: sign }, span)
}

/// Parses an integer literal without sign and suffix.
fn whole_number(input: ParseStream) -> Result<(i64, Span)> {
    let wrong = "an index is made of integers and the index variable: `3`, `i + 1`, `2*i`";
    let literal: LitInt = input.parse().map_err(|error: Error| Error::new(error.span(), wrong))?;
    match literal.base10_parse::<i64>() {
        Ok(value) if literal.suffix().is_empty() => Ok((value.min(2 * MAX_NUMBER), literal.span())),
        Ok(_) => Err(Error::new(literal.span(), "an integer here has no suffix")),
        Err(_) => Err(Error::new(literal.span(), format!("numbers in an index are at most {MAX_NUMBER}"))),
    }
}

fn nothing_left(content: ParseStream, right: &str) -> Result<()> {
    if content.is_empty() { Ok(()) } else { Err(here(content, right)) }
}

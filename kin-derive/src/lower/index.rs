//! Lowering of indices: `link[2*i + 1]` in an item that is repeated over `i`.

use super::lowerer::Lowerer;
use super::names::{Declared, Shape};
use super::range::IndexRange;
use crate::ast::{IndexExpr, NameUse, text};
use kin_core::mechanism::Index;
use std::ops::Range;

impl Lowerer<'_> {
    /// The index in a use of `declared`; `None` for an error, which is reported.
    pub(super) fn member(&self, used: &NameUse, declared: &Declared, range: &IndexRange) -> Option<Index> {
        let (name, noun) = (&declared.name, declared.symbol.noun());
        match (&declared.shape, &used.index) {
            (Shape::Unknown, _) => None,
            (Shape::Single, None) => Some(Index::default()),
            (Shape::Single, Some(index)) => {
                self.refuse(index.span, format!("`{name}` is {noun}, not a family; it takes no index"))
            }
            (Shape::Family(members), None) => {
                let (first, last) = (members.start, members.end - 1);
                let message = if members.is_empty() {
                    format!("`{name}` has no elements")
                } else {
                    format!("`{name}` is a family; one of its members is written `{name}[{first}]` to `{name}[{last}]`")
                };
                self.refuse(used.ident.span(), message)
            }
            (Shape::Family(members), Some(used)) => {
                let index = self.index(used, range)?;
                self.within(index, members, name, used, range)
            }
        }
    }

    /// The index, if it is within the range of the family at both ends of the variable's range, and therefore between
    /// them.
    fn within(
        &self,
        index: Index,
        members: &Range<i64>,
        name: &str,
        used: &IndexExpr,
        range: &IndexRange,
    ) -> Option<Index> {
        let ends = match range {
            IndexRange::Over(range) => [range.start, range.end - 1],
            IndexRange::None | IndexRange::Counted(..) | IndexRange::Unknown(_) => [0, 0],
        };
        let at = |i: i64| index.scale.saturating_mul(i).saturating_add(index.offset);
        let Some(i) = ends.into_iter().find(|&i| !members.contains(&at(i))) else { return Some(index) };
        let value = at(i);
        let step =
            used.variable.as_ref().map_or(String::new(), |variable| format!(" (where `{}` is {i})", text(variable)));
        let message = if members.is_empty() {
            format!("`{name}` has no elements, so that `{name}[{value}]` does not exist")
        } else {
            let (first, last) = (members.start, members.end - 1);
            format!("`{name}[{value}]` does not exist{step}; there are `{name}[{first}]` to `{name}[{last}]`")
        };
        self.refuse(used.span, message)
    }

    /// True for an unknown name in a formula that is meant as the index variable of a family; unless the brackets of the
    /// family have been reported, this is.
    pub(super) fn is_unnamed_index(&self, used: &NameUse, range: &IndexRange) -> bool {
        let name = used.text();
        if self.names_missing || self.names.find(&name).is_some() {
            return false;
        }
        match range {
            // A longer name is more likely a misspelt one.
            IndexRange::Unknown(words) if words.is_empty() => name.chars().count() == 1,
            IndexRange::Unknown(words) => words.contains(&name),
            IndexRange::Counted(family, len) if name.chars().count() == 1 => {
                self.report.error(used.ident.span(), unnamed(&name, family, *len));
                true
            }
            IndexRange::None | IndexRange::Counted(..) | IndexRange::Over(_) => false,
        }
    }

    fn index(&self, index: &IndexExpr, range: &IndexRange) -> Option<Index> {
        let constant = Some(Index::constant(index.offset));
        let Some(variable) = &index.variable else { return constant };
        let name = text(variable);
        match range {
            IndexRange::Unknown(_) => None,
            // If the range has a single element, the variable is replaced by a number, which keeps later compositions
            // small.
            IndexRange::Over(range) if text(&range.variable) == name && range.end - range.start == 1 => {
                Some(Index::constant(index.scale * range.start + index.offset))
            }
            IndexRange::Over(range) if text(&range.variable) == name => {
                Some(Index { scale: index.scale, offset: index.offset })
            }
            _ if self.names_missing => None,
            IndexRange::Over(range) => {
                let message = format!("no index variable `{name}` here; it is called `{}`", range.variable);
                self.refuse(variable.span(), message)
            }
            IndexRange::Counted(family, len) if self.names.find(&name).is_none() => {
                self.refuse(variable.span(), unnamed(&name, family, *len))
            }
            IndexRange::None | IndexRange::Counted(..) => {
                let message = match self.names.find(&name) {
                    Some(found) => format!(
                        "`{name}` is {}; an index is made of integers and the index variable",
                        found.symbol.noun()
                    ),
                    None => {
                        format!("no index variable `{name}` here; a repeated row names it: `N[{name} in 0..10]: …`")
                    }
                };
                self.refuse(variable.span(), message)
            }
        }
    }
}

/// The message for an index variable that the brackets of the family do not name.
pub(super) fn unnamed(variable: &str, family: &str, len: usize) -> String {
    format!(
        "no index variable `{variable}` here; the brackets of the family name it: `{family}[{variable} in 0..{len}]`"
    )
}

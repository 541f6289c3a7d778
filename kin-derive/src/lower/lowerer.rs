//! The state of lowering.

use super::curve_scope::Inside;
use super::mention::{Mention, MentionKind};
use super::names::Names;
use crate::ast::Description;
use crate::report::Report;
use kin_core::error::Origin;
use kin_core::mechanism::{Define, NamedPoint};
use proc_macro2::Span;
use std::collections::BTreeSet;
use syn::Ident;

/// What a formula depends on, from nothing to everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Class {
    /// Numbers and parameters.
    Constant,
    /// Also t and inputs.
    Signal,
    /// Also coordinates.
    Coordinate,
}

/// The state of lowering.
pub(super) struct Lowerer<'a> {
    pub(super) report: &'a Report,
    pub(super) names: Names,
    /// A declaration could not be read: an unknown name may be one that it declares.
    pub(super) names_missing: bool,
    pub(super) spans: Vec<Span>,
    pub(super) mentions: Vec<Mention>,
    pub(super) completing: bool,
    /// Families whose brackets could not be read.
    pub(super) boundless: BTreeSet<String>,
    /// The highest class that the formula at hand has reached.
    pub(super) reached: Class,
    /// The curve whose formula is at hand.
    pub(super) inside: Inside,
    /// Points by number; `None` for one with a mistake.
    pub(super) points: Vec<Option<NamedPoint>>,
    /// Defines by number with their classes; `None` for one with a mistake.
    pub(super) defines: Vec<Option<(Define, Class)>>,
}

impl<'a> Lowerer<'a> {
    pub(super) fn new(description: &Description, report: &'a Report) -> Self {
        Self {
            report,
            names: Names::default(),
            names_missing: description.names_missing,
            spans: Vec::new(),
            mentions: Vec::new(),
            completing: false,
            boundless: BTreeSet::new(),
            reached: Class::Constant,
            inside: Inside::default(),
            points: Vec::new(),
            defines: Vec::new(),
        }
    }

    /// The origin of a token.
    pub(super) fn origin(&mut self, span: Span) -> Origin {
        // More tokens than fit into 32 bits do not fit into a source file either.
        let origin = Origin(u32::try_from(self.spans.len()).unwrap_or(u32::MAX));
        self.spans.push(span);
        origin
    }

    pub(super) fn mention(&mut self, kind: MentionKind, ident: &Ident) {
        self.mentions.push(Mention { kind, ident: ident.clone() });
    }
}

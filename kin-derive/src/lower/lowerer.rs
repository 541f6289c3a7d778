//! The state of lowering.

use super::curve_scope::Inside;
use super::mention::{Mention, MentionKind};
use super::names::Names;
use super::row_names::RowNames;
use crate::ast::Description;
use crate::report::Report;
use kin_core::error::Origin;
use kin_core::mechanism::{Define, NamedPoint};
use proc_macro2::Span;
use std::collections::BTreeSet;
use std::fmt::Display;
use syn::Ident;

/// The dependence of a formula, in increasing order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Class {
    /// Numbers and parameters only.
    Constant,
    /// In addition t and inputs.
    Signal,
    /// In addition scalar coordinates.
    Scalar,
    /// In addition coordinates of bodies.
    Coordinate,
}

/// The state of lowering.
pub(super) struct Lowerer<'a> {
    pub(super) report: &'a Report,
    pub(super) names: Names,
    pub(super) row_names: RowNames,
    /// True if a declaration could not be read, so that an unknown name may be one that it declares.
    pub(super) names_missing: bool,
    pub(super) spans: Vec<Span>,
    pub(super) mentions: Vec<Mention>,
    pub(super) completing: bool,
    /// Families whose brackets could not be read.
    pub(super) boundless: BTreeSet<String>,
    /// The highest class in the current formula.
    pub(super) reached: Class,
    /// The names of the current curve.
    pub(super) inside: Inside,
    /// Points by index; `None` for one with errors.
    pub(super) points: Vec<Option<NamedPoint>>,
    /// Defines by index, with their classes; `None` for one with errors.
    pub(super) defines: Vec<Option<(Define, Class)>>,
    /// The values of constant defines by index, so that each is computed once.
    pub(super) constants: Vec<Option<f64>>,
}

impl<'a> Lowerer<'a> {
    pub(super) fn new(description: &Description, report: &'a Report) -> Self {
        Self {
            report,
            names: Names::default(),
            row_names: RowNames::of(&description.items),
            names_missing: description.names_missing,
            spans: Vec::new(),
            mentions: Vec::new(),
            completing: false,
            boundless: BTreeSet::new(),
            reached: Class::Constant,
            inside: Inside::default(),
            points: Vec::new(),
            defines: Vec::new(),
            constants: Vec::new(),
        }
    }

    /// A new origin for a token.
    pub(super) fn origin(&mut self, span: Span) -> Origin {
        // A source file cannot contain more tokens than fit into 32 bits.
        let origin = Origin(u32::try_from(self.spans.len()).unwrap_or(u32::MAX));
        self.spans.push(span);
        origin
    }

    /// Reports an error and returns `None`.
    pub(super) fn refuse<T>(&self, span: Span, message: impl Display) -> Option<T> {
        self.report.error(span, message);
        None
    }

    pub(super) fn mention(&mut self, kind: MentionKind, ident: &Ident) {
        self.mentions.push(Mention { kind, ident: ident.clone() });
    }
}

//! The table of names, and the messages for unknown names.

use super::mention::MentionKind;
use crate::suggest::{nearest, quoted};
use std::collections::{BTreeMap, BTreeSet};

/// The thing that a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symbol {
    Parameter(usize),
    Body(usize),
    Scalar(usize),
    Input(usize),
    Point(usize),
    Define(usize),
    Function(usize),
}

impl Symbol {
    /// The kind of thing for messages, with its article.
    pub(super) const fn noun(self) -> &'static str {
        match self {
            Self::Parameter(_) => "a parameter",
            Self::Body(_) => "a body",
            Self::Scalar(_) => "a coordinate",
            Self::Input(_) => "an input",
            Self::Point(_) => "a point",
            Self::Define(_) => "a define",
            Self::Function(_) => "a function",
        }
    }

    /// The kind of its mentions.
    pub(super) const fn mention(self) -> MentionKind {
        match self {
            Self::Parameter(_) => MentionKind::Parameter,
            Self::Body(_) => MentionKind::Body,
            Self::Scalar(_) => MentionKind::Scalar,
            Self::Input(_) => MentionKind::Input,
            Self::Point(_) => MentionKind::Point,
            Self::Define(_) => MentionKind::Define,
            Self::Function(_) => MentionKind::Function,
        }
    }
}

/// The number of things that a name stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// A single thing, which takes no index.
    Single,
    /// The members with these indices.
    Family(std::ops::Range<i64>),
    /// A family whose brackets could not be read.
    Unknown,
}

/// A declared name.
#[derive(Clone, Debug)]
pub(super) struct Declared {
    pub(super) name: String,
    pub(super) symbol: Symbol,
    pub(super) shape: Shape,
}

/// All names; of two equal names the first is used.
#[derive(Debug, Default)]
pub(super) struct Names {
    all: Vec<Declared>,
    by_name: BTreeMap<String, usize>,
    ambiguous: BTreeSet<String>,
}

impl Names {
    /// Adds a name.
    pub(super) fn insert(&mut self, declared: Declared) {
        if let Some(first) = self.find(&declared.name)
            && std::mem::discriminant(&first.symbol) != std::mem::discriminant(&declared.symbol)
        {
            self.ambiguous.insert(declared.name.clone());
        }
        self.by_name.entry(declared.name.clone()).or_insert(self.all.len());
        self.all.push(declared);
    }

    /// True for a name of two different kinds of things, whose uses are therefore not checked.
    pub(super) fn is_ambiguous(&self, name: &str) -> bool {
        self.ambiguous.contains(name)
    }

    /// The names of all supplied functions.
    pub(super) fn functions(&self) -> impl Iterator<Item = &str> {
        let is_function = |declared: &&Declared| matches!(declared.symbol, Symbol::Function(_));
        self.all.iter().filter(is_function).map(|declared| declared.name.as_str())
    }

    /// The declaration of `name`.
    pub(super) fn find(&self, name: &str) -> Option<&Declared> {
        self.by_name.get(name).and_then(|&k| self.all.get(k))
    }

    /// The message for an unknown name, where one of the `wanted` kinds is expected.
    pub(super) fn unknown(&self, name: &str, noun: &str, wanted: fn(Symbol) -> bool) -> String {
        if wanted(Symbol::Parameter(0)) {
            match name {
                "T" | "time" => return format!("no {noun} named `{name}`; time is `t`"),
                "PI" | "Pi" | "π" => return format!("no {noun} named `{name}`; the number π is `pi`"),
                _ => {}
            }
        }
        let fitting = || self.all.iter().filter(|d| wanted(d.symbol)).map(|d| d.name.as_str());
        // `ground` is a body without a declaration.
        let ground = wanted(Symbol::Body(0)).then_some("ground");
        if let Some(best) = nearest(name, fitting().chain(ground)) {
            return format!("no {noun} named `{name}`; did you mean `{best}`?");
        }
        if wanted(Symbol::Body(0))
            && matches!(name, "world" | "base" | "frame" | "fixed" | "origin" | "earth" | "inertial")
        {
            return format!("no {noun} named `{name}`; the fixed body is called `ground`");
        }
        let of_other_kinds = self.all.iter().filter(|d| !wanted(d.symbol));
        if let Some(best) = nearest(name, of_other_kinds.map(|d| d.name.as_str())).and_then(|best| self.find(best)) {
            return format!("no {noun} named `{name}`; there is {} `{}`", best.symbol.noun(), best.name);
        }
        if fitting().next().is_none() {
            let right = match () {
                () if wanted(Symbol::Parameter(0)) => "",
                () if wanted(Symbol::Body(0)) => "; bodies are declared with `#[bodies(crank, …)]`",
                () if wanted(Symbol::Point(0)) => {
                    "; points are declared with `#[point(tip = body @ (x, y))]` or written in place"
                }
                () => "; coordinates are declared with `#[coordinates(u, …)]`",
            };
            return format!("no {noun} named `{name}`; none is declared{right}");
        }
        format!("no {noun} named `{name}`; there are {}", quoted(fitting(), "and"))
    }
}

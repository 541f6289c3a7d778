//! [`Description`] to [`Mechanism`]: names become ids, tokens become [`Origin`]s.

mod body;
mod constant;
mod curve;
mod curve_scope;
mod declare;
mod formula;
mod index;
mod index_variable;
mod lowerer;
mod mention;
mod names;
mod place;
mod range;
mod row;
mod row_names;
mod scope;
mod substitute;

use crate::ast::{Description, Flags, Item, text};
use crate::report::Report;
use kin_core::error::Origin;
use kin_core::mechanism::Mechanism;
use lowerer::Lowerer;
pub(crate) use mention::{Mention, MentionKind};
use proc_macro2::Span;
use std::collections::BTreeSet;
use syn::{Ident, ItemStruct, Type};

/// The lowered description, from which expansion starts.
pub(crate) struct Lowered {
    /// The model.
    pub(crate) mechanism: Mechanism,
    /// The span of every [`Origin`]: that of `Origin(k)` is `spans[k]`.
    pub(crate) spans: Vec<Span>,
    /// The struct without the attributes of kin.
    pub(crate) item: ItemStruct,
    /// All uses and declarations of the user's names in the attributes of kin.
    pub(crate) mentions: Vec<Mention>,
    /// The fields of the struct, in order.
    pub(crate) fields: Vec<Field>,
    /// The flags of `#[mechanism(…)]`.
    pub(crate) flags: Flags,
    /// True if the struct derives `Default`.
    pub(crate) derives_default: bool,
    /// The documentation of names.
    pub(crate) docs: Docs,
    /// Families whose brackets could not be read.
    pub(crate) boundless: BTreeSet<String>,
}

impl Lowered {
    /// The span of an [`Origin`].
    pub(crate) fn span(&self, origin: Origin) -> Span {
        self.spans.get(origin.0 as usize).copied().unwrap_or_else(Span::call_site)
    }
}

/// A field of the struct.
#[derive(Clone)]
pub(crate) struct Field {
    pub(crate) ident: Ident,
    pub(crate) ty: Type,
    /// The number of elements of an array field.
    pub(crate) len: Option<usize>,
    /// The type parameter of the struct that is the type of the field's numbers.
    pub(crate) scalar: Option<Ident>,
    pub(crate) role: FieldRole,
}

/// The role of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FieldRole {
    /// An entry of `Mechanism::parameters`.
    Parameter(usize),
    /// An entry of `Mechanism::functions`.
    Function(usize),
}

/// The first paragraphs of doc comments; undocumented names are not listed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Docs {
    /// That of the struct.
    pub(crate) mechanism: String,
    /// Those of bodies, coordinates, inputs, points and defines, by name.
    pub(crate) names: Vec<(String, String)>,
    /// Those of statements and conditions, by name.
    pub(crate) rows: Vec<(String, String)>,
}

/// The result of lowering.
pub(crate) struct Outcome {
    pub(crate) lowered: Lowered,
    /// True if an editor requests completions at its marker; then the errors of this expansion are not shown.
    pub(crate) completing: bool,
}

/// Resolves the names of `description`; an item with an error is reported and is missing in the model.
pub(crate) fn lower(description: Description, item: ItemStruct, report: &Report) -> Outcome {
    let mut lowerer = Lowerer::new(&description, report);
    let mut mechanism = Mechanism {
        name: text(&description.name),
        origin: lowerer.origin(description.name.span()),
        ..Mechanism::default()
    };
    let (names, ranges) = lowerer.declare(&description, &mut mechanism);
    lowerer.names = names;
    lowerer.index_variables_differ(&description.items);
    lowerer.points_and_defines(&description.items, &ranges, &mut mechanism);
    lowerer.bodies(&description.items, &ranges, &mut mechanism);
    lowerer.rows(&description.items, &ranges, &mut mechanism);
    if lowerer.completing {
        skeleton(&mut mechanism);
    }
    let (fields, docs) = (fields(&description, &mechanism), docs(&description));
    let Lowerer { spans, mentions, completing, boundless, .. } = lowerer;
    let lowered = Lowered {
        mechanism,
        spans,
        item,
        mentions,
        fields,
        flags: description.flags,
        derives_default: description.derives_default,
        docs,
        boundless,
    };
    Outcome { lowered, completing }
}

/// Keeps the names of a mechanism and drops their contents, so that an unfinished description has a valid expansion.
fn skeleton(mechanism: &mut Mechanism) {
    mechanism.joints.clear();
    mechanism.conditions.clear();
    mechanism.guesses.clear();
    for body in &mut mechanism.bodies {
        body.origin_at = body::FREE;
        body.phi = None;
    }
    let origin = mechanism.origin;
    mechanism.points.iter_mut().for_each(|point| point.place = place::placeholder(origin));
    mechanism.defines.iter_mut().for_each(|define| define.formula = kin_core::mechanism::Formula::ZERO);
}

fn fields(description: &Description, mechanism: &Mechanism) -> Vec<Field> {
    let mut parameters = 0;
    let read = description.fields.iter().map(|field| {
        let name = text(&field.ident);
        let function = if field.is_function { mechanism.functions.iter().position(|f| f.name == name) } else { None };
        let role = function.map_or_else(|| FieldRole::Parameter(parameters), FieldRole::Function);
        parameters += usize::from(function.is_none());
        let (ident, ty, scalar) = (field.ident.clone(), field.ty.clone(), field.scalar.clone());
        Field { ident, ty, len: field.len, scalar, role }
    });
    read.collect()
}

fn docs(description: &Description) -> Docs {
    let mut docs = Docs { mechanism: description.doc.clone(), ..Docs::default() };
    for item in &description.items {
        let (name, list) = match item {
            Item::Body(decl) => (&decl.name, &mut docs.names),
            Item::Scalar(decl) => (&decl.name, &mut docs.names),
            Item::Input(decl) => (&decl.name, &mut docs.names),
            Item::Point(decl) => (&decl.name, &mut docs.names),
            Item::Define(decl) => (&decl.name, &mut docs.names),
            Item::Statement(row) => (&row.name, &mut docs.rows),
            Item::Condition(decl) => (&decl.name, &mut docs.rows),
            Item::Function(decl) => (&decl.name, &mut docs.names),
            Item::Guess(_) => continue,
        };
        if !name.doc.is_empty() {
            list.push((text(&name.ident), name.doc.clone()));
        }
    }
    docs
}

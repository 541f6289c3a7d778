//! Declarations: every declared name gets an index, in the order of the source.

use super::lowerer::Lowerer;
use super::mention::MentionKind;
use super::names::{Declared, Names, Shape, Symbol};
use super::range::IndexRange;
use super::{body, place};
use crate::ast::{Bracket, Description, FieldDecl, FunctionDecl, Item, NewName, RangeDecl, text};
use crate::suggest::did_you_mean;
use kin_core::error::Origin;
use kin_core::mechanism::{Body, Define, Formula, Input, Mechanism, NamedPoint, Parameter, Scalar, SuppliedFunction};

impl Lowerer<'_> {
    /// Gives an index to everything that has a name. Returns also the index ranges of the items, in their order.
    pub(super) fn declare(&mut self, description: &Description, mechanism: &mut Mechanism) -> (Names, Vec<IndexRange>) {
        let mut names = Names::default();
        let mut ranges = Vec::new();
        for item in &description.items {
            let range = match item {
                Item::Body(decl) => {
                    let (shape, range) = self.length(&decl.name, "#[bodies(link[10])]");
                    let symbol = Symbol::Body(mechanism.bodies.len());
                    let origin = self.name(&decl.name, symbol, &shape, &mut names);
                    let (name, len) = (text(&decl.name.ident), len_of(&shape));
                    mechanism.bodies.push(Body { name, len, origin_at: body::FREE, phi: None, origin });
                    range
                }
                Item::Scalar(decl) => {
                    let (shape, range) = self.length(&decl.name, "#[coordinates(u[3])]");
                    let symbol = Symbol::Scalar(mechanism.scalars.len());
                    let origin = self.name(&decl.name, symbol, &shape, &mut names);
                    let (name, len) = (text(&decl.name.ident), len_of(&shape));
                    mechanism.scalars.push(Scalar { name, len, origin, unit: decl.unit.clone() });
                    range
                }
                Item::Input(decl) => {
                    let (shape, range) = self.length(&decl.name, "#[input(u[3])]");
                    let symbol = Symbol::Input(mechanism.inputs.len());
                    let origin = self.name(&decl.name, symbol, &shape, &mut names);
                    let (name, len) = (text(&decl.name.ident), len_of(&shape));
                    let (unit, default) = (decl.unit.clone(), decl.default);
                    mechanism.inputs.push(Input { name, len, origin, unit, default });
                    range
                }
                Item::Point(decl) => {
                    let (shape, range) = self.repetition(&decl.name, "#[point(p[i in 0..3] = link[i] @ (0, 0))]");
                    let symbol = Symbol::Point(mechanism.points.len());
                    let origin = self.name(&decl.name, symbol, &shape, &mut names);
                    let (name, place) = (text(&decl.name.ident), place::placeholder(origin));
                    mechanism.points.push(NamedPoint { name, range: range.model(), place, origin });
                    range
                }
                Item::Define(decl) => {
                    let (shape, range) = self.repetition(&decl.name, "#[define(s[i in 0..3] = link[i].phi)]");
                    let symbol = Symbol::Define(mechanism.defines.len());
                    let origin = self.name(&decl.name, symbol, &shape, &mut names);
                    let name = text(&decl.name.ident);
                    let (unit, formula) = (decl.unit.clone(), Formula::ZERO);
                    mechanism.defines.push(Define { name, range: range.model(), formula, origin, unit });
                    range
                }
                Item::Function(decl) => {
                    self.function(decl, description, mechanism, &mut names);
                    IndexRange::None
                }
                Item::Statement(row) => self.repetition(&row.name, "N[i in 0..3]: …").1,
                Item::Condition(decl) => self.repetition(&decl.name, "N[i in 0..3]: …").1,
                Item::Guess(guess) => guess.range.clone().map_or(IndexRange::None, IndexRange::Over),
            };
            ranges.push(range);
        }
        self.parameters(description, mechanism, &mut names);
        (names, ranges)
    }

    /// Declares a supplied function, which is a field of the struct; its length is that of the field.
    fn function(
        &mut self,
        decl: &FunctionDecl,
        description: &Description,
        mechanism: &mut Mechanism,
        names: &mut Names,
    ) {
        let (ident, name) = (&decl.name.ident, text(&decl.name.ident));
        match &decl.name.bracket {
            None | Some(Bracket::Hole(_)) => {}
            Some(Bracket::Len(_, span) | Bracket::Range(RangeDecl { span, .. })) => {
                let message = format!(
                    "the number of functions `{name}` follows from the type of the field; write the name alone: \
                     `#[function({name})]`"
                );
                self.report.error(*span, message);
            }
        }
        let field = description.fields.iter().find(|field| text(&field.ident) == name);
        let symbol = Symbol::Function(mechanism.functions.len());
        let len = field.and_then(|field| field.len);
        let shape = field.map_or(Shape::Unknown, shape_of);
        if field.is_some() {
            self.mention(MentionKind::Function, ident);
        } else {
            let fields: Vec<String> = description.fields.iter().map(|field| text(&field.ident)).collect();
            let suggestion = did_you_mean(&name, fields.iter().map(String::as_str));
            let message = format!(
                "no field named `{name}`; a function is a field of the struct whose type implements `ScalarFunction`{suggestion}"
            );
            self.report.error(ident.span(), message);
        }
        names.insert(Declared { name: name.clone(), symbol, shape });
        let origin = self.origin(ident.span());
        mechanism.functions.push(SuppliedFunction { name, len, origin });
    }

    fn parameters(&mut self, description: &Description, mechanism: &mut Mechanism, names: &mut Names) {
        for field in description.fields.iter().filter(|field| !field.is_function) {
            let name = text(&field.ident);
            let symbol = Symbol::Parameter(mechanism.parameters.len());
            let shape = shape_of(field);
            names.insert(Declared { name: name.clone(), symbol, shape });
            let origin = self.origin(field.ident.span());
            mechanism.parameters.push(Parameter {
                name,
                len: field.len,
                unit: field.unit.clone(),
                default: field.default.clone(),
                doc: field.doc.clone(),
                origin,
            });
        }
    }

    fn name(&mut self, name: &NewName, symbol: Symbol, shape: &Shape, names: &mut Names) -> Origin {
        if *shape == Shape::Unknown {
            self.boundless.insert(text(&name.ident));
        }
        names.insert(Declared { name: text(&name.ident), symbol, shape: shape.clone() });
        self.mention(symbol.mention(), &name.ident);
        self.origin(name.ident.span())
    }

    /// Reads the brackets of a family with a length; `[i in 0..10]` also names the index variable.
    fn length(&self, name: &NewName, form: &str) -> (Shape, IndexRange) {
        match &name.bracket {
            None => (Shape::Single, IndexRange::None),
            Some(Bracket::Len(len, _)) => {
                let range = IndexRange::Counted(text(&name.ident), *len);
                (Shape::Family(0..i64::try_from(*len).unwrap_or(0)), range)
            }
            Some(Bracket::Range(range)) if range.start == 0 => {
                (Shape::Family(0..range.end), IndexRange::Over(range.clone()))
            }
            Some(Bracket::Range(range)) => {
                self.report.error(range.span, format!("the members of a family are counted from 0: `{form}`"));
                (Shape::Unknown, IndexRange::Unknown(vec![text(&range.variable)]))
            }
            Some(Bracket::Hole(words)) => (Shape::Unknown, IndexRange::Unknown(words.clone())),
        }
    }

    /// Reads the brackets of an item that is repeated over a range.
    fn repetition(&self, name: &NewName, form: &str) -> (Shape, IndexRange) {
        match &name.bracket {
            None => (Shape::Single, IndexRange::None),
            Some(Bracket::Range(range)) => (Shape::Family(range.start..range.end), IndexRange::Over(range.clone())),
            Some(Bracket::Len(_, span)) => {
                self.report.error(*span, format!("a family needs an index variable with its range: `{form}`"));
                (Shape::Unknown, IndexRange::Unknown(Vec::new()))
            }
            Some(Bracket::Hole(words)) => (Shape::Unknown, IndexRange::Unknown(words.clone())),
        }
    }
}

fn shape_of(field: &FieldDecl) -> Shape {
    match field.len {
        _ if field.is_len_unknown => Shape::Unknown,
        Some(len) => Shape::Family(0..i64::try_from(len).unwrap_or(0)),
        None => Shape::Single,
    }
}

fn len_of(shape: &Shape) -> Option<usize> {
    match shape {
        Shape::Family(members) => usize::try_from(members.end).ok(),
        Shape::Single | Shape::Unknown => None,
    }
}

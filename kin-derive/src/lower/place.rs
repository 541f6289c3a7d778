//! Lowering of bodies, scalar coordinates and points at the places of their use.

use super::lowerer::Lowerer;
use super::mention::{MentionKind, is_completion_marker};
use super::names::{Declared, Symbol};
use super::range::IndexRange;
use super::scope::{Allow, Scope};
use super::substitute;
use crate::ast::{NameUse, PointExpr};
use kin_core::error::Origin;
use kin_core::mechanism::{BodyRef, Formula, Member, Place};

/// A placeholder for a point that could not be read.
pub(super) const fn placeholder(origin: Origin) -> Place {
    Place { body: BodyRef::Ground(origin), x: Formula::ZERO, y: Formula::ZERO, origin }
}

impl Lowerer<'_> {
    /// The declaration of a used name; for an unknown name an error that says what is expected.
    pub(super) fn resolve(&mut self, used: &NameUse, noun: &str, wanted: fn(Symbol) -> bool) -> Option<Declared> {
        let name = used.text();
        if self.names.is_ambiguous(&name) {
            return None;
        }
        if let Some(declared) = self.names.find(&name).cloned() {
            self.mention(declared.symbol.mention(), &used.ident);
            return Some(declared);
        }
        if is_completion_marker(&used.ident) {
            self.completing = true;
            // Parameters are members of `self`, all other names are constants of `Self`; in expressions an editor
            // offers parameters.
            let kind = if wanted(Symbol::Parameter(0)) { MentionKind::Parameter } else { MentionKind::Body };
            self.mention(kind, &used.ident);
        } else if !self.names_missing {
            // Points stand alone in operands; in formulas their coordinates are meant.
            let is_formula = wanted(Symbol::Parameter(0)) || wanted(Symbol::Body(0)) && wanted(Symbol::Point(0));
            let row = self.row_names.used_as(&name, noun, is_formula);
            let message = row.unwrap_or_else(|| self.names.unknown(&name, noun, wanted));
            self.report.error(used.ident.span(), message);
        }
        None
    }

    /// Lowers a body.
    pub(super) fn body(&mut self, used: &NameUse, range: &IndexRange) -> Option<BodyRef> {
        if used.text() == "ground" {
            if let Some(index) = &used.index {
                return self.refuse(index.span, "there is one ground; it takes no index");
            }
            return Some(BodyRef::Ground(self.origin(used.ident.span())));
        }
        let declared = self.resolve(used, "body", |symbol| matches!(symbol, Symbol::Body(_)))?;
        let Symbol::Body(family) = declared.symbol else {
            let message = format!("`{}` is {}; a body is needed here", declared.name, declared.symbol.noun());
            return self.refuse(used.ident.span(), message);
        };
        let index = self.member(used, &declared, range)?;
        let origin = self.origin(used.ident.span());
        Some(BodyRef::Body { family, index, origin })
    }

    /// Lowers a scalar coordinate that an option names; `right` is the part of the message that says what is expected.
    pub(super) fn scalar_operand(&mut self, used: &NameUse, right: &str, range: &IndexRange) -> Option<Member> {
        let declared = self.resolve(used, "coordinate", |symbol| matches!(symbol, Symbol::Scalar(_)))?;
        let Symbol::Scalar(family) = declared.symbol else {
            let message = format!("`{}` is {}; {right}", declared.name, declared.symbol.noun());
            return self.refuse(used.ident.span(), message);
        };
        let index = self.member(used, &declared, range)?;
        let origin = self.origin(used.ident.span());
        Some(Member { family, index, origin })
    }

    /// Lowers a point.
    pub(super) fn place(&mut self, point: &PointExpr, range: &IndexRange) -> Option<Place> {
        match point {
            PointExpr::Hole => None,
            PointExpr::Named(used) => self.named_point(used, range),
            PointExpr::At { body, x, y } => {
                let origin = self.origin(body.ident.span());
                let scope = Scope { place: "a body-fixed point", allow: Allow::Parameters, range };
                let body = self.body(body, range);
                let x = self.formula(x, &scope);
                let y = self.formula(y, &scope);
                Some(Place { body: body?, x: x?, y: y?, origin })
            }
        }
    }

    fn named_point(&mut self, used: &NameUse, range: &IndexRange) -> Option<Place> {
        let name = used.text();
        if name == "ground" {
            return self.refuse(used.ident.span(), "`ground` is a body; a point of it is written `ground @ (0, 0)`");
        }
        let declared = self.resolve(used, "point", |symbol| matches!(symbol, Symbol::Point(_)))?;
        match declared.symbol {
            Symbol::Point(k) => self.point_member(k, &declared, used, range),
            Symbol::Body(_) => {
                let message = format!("`{name}` is a body; a point of it is written `{name} @ (0, 0)`");
                self.refuse(used.ident.span(), message)
            }
            other => {
                let message =
                    format!("`{name}` is {}; a point is needed here: `body @ (x, y)` or a named point", other.noun());
                self.refuse(used.ident.span(), message)
            }
        }
    }

    /// The place of a member of point `k`, expressed in the index variable of its use.
    pub(super) fn point_member(
        &mut self,
        k: usize,
        declared: &Declared,
        used: &NameUse,
        range: &IndexRange,
    ) -> Option<Place> {
        let index = self.member(used, declared, range)?;
        let place = substitute::place(&self.points.get(k)?.as_ref()?.place, index);
        // What is wrong with the body of a point, here, is not wrong where the point is declared.
        let origin = self.origin(used.ident.span());
        Some(Place { body: place.body.at(origin), origin, ..place })
    }
}

//! The parts of gears, belts and rolling discs.

use super::Lowerer;
use super::declare::IndexRange;
use super::formula::{Allow, Scope};
use super::names::Symbol;
use crate::ast::{CarrierExpr, Expr, NameUse, PairExpr, RadiiExpr};
use kin_core::mechanism::{BodyRef, Formula, Member, Radii, Radius};

/// Two bodies that gears or a belt couple.
pub(super) struct Pair {
    pub(super) a: BodyRef,
    pub(super) b: BodyRef,
    pub(super) radii: Radii,
    pub(super) carrier: BodyRef,
    pub(super) offset: Formula,
}

impl Lowerer<'_> {
    pub(super) fn pair(&mut self, pair: &PairExpr, range: &IndexRange) -> Option<Pair> {
        let (a, b) = (self.operand(pair.a.as_ref(), range), self.operand(pair.b.as_ref(), range));
        let radii = self.radii(&pair.radii, range);
        let carrier = match &pair.carrier {
            CarrierExpr::Ground => Some(BodyRef::Ground(self.origin(pair.radii.span))),
            CarrierExpr::Body(body) => self.body(body, range),
            CarrierExpr::Hole => None,
        };
        let offset = self.signal(&pair.offset, "`offset`", range);
        Some(Pair { a: a?, b: b?, radii: radii?, carrier: carrier?, offset: offset? })
    }

    pub(super) fn radii(&mut self, radii: &RadiiExpr, range: &IndexRange) -> Option<Radii> {
        let origin = self.origin(radii.span);
        let (i, j) = (self.radius(&radii.i, "`radii`", range), self.radius(&radii.j, "`radii`", range));
        Some(Radii { i: i?, j: j?, origin })
    }

    pub(super) fn radius(&mut self, expr: &Expr, what: &'static str, range: &IndexRange) -> Option<Radius> {
        let origin = self.origin(expr.span);
        let value = self.formula(expr, &Scope { what, allow: Allow::Parameters, range })?;
        Some(Radius { value, origin })
    }

    /// A scalar coordinate that an option names; `right` says so.
    pub(super) fn scalar_operand(&mut self, used: &NameUse, right: &str, range: &IndexRange) -> Option<Member> {
        let declared = self.resolve(used, "coordinate", |symbol| matches!(symbol, Symbol::Scalar(_)))?;
        let Symbol::Scalar(family) = declared.symbol else {
            let message = format!("`{}` is {}; {right}", declared.name, declared.symbol.noun());
            self.report.error(used.ident.span(), message);
            return None;
        };
        let index = self.member(used, &declared, range)?;
        let origin = self.origin(used.ident.span());
        Some(Member { family, index, origin })
    }
}

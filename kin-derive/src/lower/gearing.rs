//! Lowering of radii, and of scalar coordinates that options name.

use super::lowerer::Lowerer;
use super::names::Symbol;
use super::range::IndexRange;
use super::scope::{Allow, Scope};
use crate::ast::{Expr, NameUse, RadiiExpr};
use kin_core::mechanism::{Member, Radii, Value};

impl Lowerer<'_> {
    /// Lowers a pair of radii.
    pub(super) fn radii(&mut self, radii: &RadiiExpr, range: &IndexRange) -> Option<Radii> {
        let origin = self.origin(radii.span);
        let (i, j) = (self.radius(&radii.i, "`radii`", range), self.radius(&radii.j, "`radii`", range));
        Some(Radii { i: i?, j: j?, origin })
    }

    fn radius(&mut self, expr: &Expr, what: &'static str, range: &IndexRange) -> Option<Value> {
        let origin = self.origin(expr.span);
        let value = self.formula(expr, &Scope { what, allow: Allow::Parameters, range })?;
        Some(Value { value, origin })
    }

    /// Lowers a scalar coordinate that an option names; `right` is the part of the message that says what is expected.
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

//! Lowering of curves. Their variables are known inside their formulas only, where they shadow other names.

use super::curve_scope::Inside;
use super::lowerer::{Class, Lowerer};
use super::range::IndexRange;
use super::scope::{Allow, Scope};
use crate::ast::{CurveExpr, Expr, NameUse, PathExpr};
use crate::suggest::{nearest, quoted};
use kin_core::mechanism::{Curve, CurveVariable, Formula, Member};

const THETA: &[CurveVariable] = &[CurveVariable::Theta];
const POINT: &[CurveVariable] = &[CurveVariable::X, CurveVariable::Y];

impl Lowerer<'_> {
    /// Lowers the curve of a statement.
    pub(super) fn curve(&mut self, curve: &CurveExpr, range: &IndexRange) -> Option<Curve> {
        match curve {
            CurveExpr::Hole => None,
            CurveExpr::Polar(radius) => {
                let origin = self.origin(radius.span);
                let radius = self.inside(radius, THETA, range)?;
                Some(Curve::Polar { radius, origin })
            }
            CurveExpr::Implicit(value) => {
                let origin = self.origin(value.span);
                let value = self.inside(value, POINT, range)?;
                Some(Curve::Implicit { value, origin })
            }
            CurveExpr::Parametric(path) => {
                let PathExpr { parameter, x, y, span, roller } = &**path;
                let origin = self.origin(*span);
                let member = self.parameter(parameter, range);
                if let Some(member) = member {
                    let word = (member.family, member.index, written(parameter));
                    self.inside = Inside { parameter: Some(word), ..Inside::default() };
                }
                let scope = Scope { place: "a curve", allow: Allow::Signals, range };
                // Without its parameter, every use of the parameter would be reported as another error.
                let components = member.map(|_| [x, y].map(|component| self.formula(component, &scope)));
                self.inside = Inside::default();
                let scope = Scope { place: "`roller`", allow: Allow::Parameters, range };
                let roller = roller.as_ref().map(|roller| self.formula(roller, &scope));
                let [x, y] = components?;
                let roller = match roller {
                    None => None,
                    Some(roller) => Some(roller?),
                };
                Some(Curve::Parametric { parameter: member?, x: x?, y: y?, roller, origin })
            }
        }
    }

    /// Lowers a support function.
    pub(super) fn support(&mut self, support: &Expr, range: &IndexRange) -> Option<Formula> {
        self.inside(support, THETA, range)
    }

    fn inside(&mut self, expr: &Expr, variables: &'static [CurveVariable], range: &IndexRange) -> Option<Formula> {
        self.inside = Inside { variables, parameter: None };
        let formula = self.formula(expr, &Scope { place: "a curve", allow: Allow::Signals, range });
        self.inside = Inside::default();
        formula
    }

    /// Lowers the scalar coordinate that is the parameter of a parametric curve.
    fn parameter(&mut self, used: &NameUse, range: &IndexRange) -> Option<Member> {
        let right = "the parameter of a curve is a scalar coordinate, `#[coordinates(u)]`";
        self.scalar_operand(used, right, range)
    }

    /// A use of a variable of the current curve.
    pub(super) fn curve_variable(
        &mut self,
        variable: CurveVariable,
        used: &NameUse,
        scope: &Scope<'_>,
    ) -> Option<Formula> {
        let (name, span) = (variable.name(), used.ident.span());
        if let Some(index) = &used.index {
            return self.refuse(index.span, format!("`{name}` is the variable of this curve; it takes no index"));
        }
        if scope.allow == Allow::Parameters {
            let found = format!("`{name}` is the variable of the curve");
            self.require(Class::Coordinate, &found, (span, span), scope)?;
        }
        Some(Formula::Curve(variable))
    }

    /// True for a variable of curves that is used outside of its curve, which is reported.
    pub(super) fn is_variable_of_another_curve(&mut self, used: &NameUse) -> bool {
        let name = used.text();
        if self.names_missing || self.names.find(&name).is_some() {
            return false;
        }
        let explanation = match name.as_str() {
            "theta" => {
                "`theta` is the variable of a polar curve or a support function, and is used after `polar(theta) =` or \
                 `support(theta) =` only"
            }
            "X" | "Y" => {
                &format!("`{name}` is a variable of an implicit curve, and is used after `implicit(X, Y) =` only")
            }
            _ => return false,
        };
        let words = self.inside.words();
        let own_variables = match words.len() {
            0 => String::new(),
            1 => format!("; the variable of this curve is {}", quoted(words, "and")),
            _ => format!("; the variables of this curve are {}", quoted(words, "and")),
        };
        self.report.error(used.ident.span(), format!("{explanation}{own_variables}"));
        true
    }

    /// True for a misspelt word of the current curve, which is reported.
    pub(super) fn is_slip_of_the_curve(&mut self, used: &NameUse) -> bool {
        let name = used.text();
        if self.names.find(&name).is_some() {
            return false;
        }
        let Some(best) = nearest(&name, self.inside.words()) else { return false };
        self.report.error(used.ident.span(), format!("no name `{name}` in this curve; did you mean `{best}`?"));
        true
    }
}

/// The text of a use of a name.
fn written(used: &NameUse) -> String {
    let name = used.text();
    match &used.index {
        None => name,
        Some(index) => match (&index.variable, index.offset) {
            (None, offset) => format!("{name}[{offset}]"),
            (Some(variable), 0) if index.scale == 1 => format!("{name}[{variable}]"),
            (Some(_), _) => format!("{name}[…]"),
        },
    }
}

//! The rule for index variables: their names stand for nothing else in the description.

use super::lowerer::Lowerer;
use crate::ast::{Bracket, CurveExpr, Item, OperandExpr, RangeDecl, text};
use kin_core::check::meaning_of_reserved;
use kin_core::mechanism::{CurveVariable, OperandType};

impl Lowerer<'_> {
    /// Rule: an index variable has a name of its own. With the name of a parameter, for example, the same word would
    /// mean the index in brackets and the parameter in formulas.
    pub(super) fn index_variables_differ(&self, items: &[Item]) {
        for item in items {
            let Some(range) = range(item) else { continue };
            let name = text(&range.variable);
            let message = if let Some(meaning) = meaning_of_reserved(&name) {
                format!("`{name}` is {meaning} in every mechanism; an index variable needs another name")
            } else if let Some(declared) = self.names.find(&name) {
                let noun = declared.symbol.noun();
                format!("`{name}` is {noun} already, and here an index variable, which needs another name")
            } else if curve_variables(item).any(|variable| variable.name() == name) {
                format!("`{name}` is a variable of this curve; an index variable needs another name")
            } else {
                continue;
            };
            self.report.error(range.variable.span(), message);
        }
    }
}

/// The range over which an item is repeated.
fn range(item: &Item) -> Option<&RangeDecl> {
    let name = match item {
        Item::Body(decl) => &decl.name,
        Item::Scalar(decl) => &decl.name,
        Item::Input(decl) => &decl.name,
        Item::Point(decl) => &decl.name,
        Item::Define(decl) => &decl.name,
        Item::Statement(row) => &row.name,
        Item::Condition(decl) => &decl.name,
        Item::Guess(guess) => return guess.range.as_ref(),
        // Brackets after the name of a function are an error, whatever they hold.
        Item::Function(_) => return None,
    };
    if let Some(Bracket::Range(range)) = &name.bracket { Some(range) } else { None }
}

/// The variables of the curves and support functions of an item.
fn curve_variables(item: &Item) -> impl Iterator<Item = CurveVariable> {
    let statement = if let Item::Statement(row) = item { Some(row) } else { None };
    let operands = statement.into_iter().flat_map(|row| row.form.slots.iter().zip(&row.operands));
    operands.flat_map(|(slot, operand)| match operand {
        OperandExpr::Curve(CurveExpr::Polar(_)) => vec![CurveVariable::Theta],
        OperandExpr::Curve(CurveExpr::Implicit(_)) => vec![CurveVariable::X, CurveVariable::Y],
        OperandExpr::Value(_) if slot.takes == OperandType::Support => vec![CurveVariable::Theta],
        _ => Vec::new(),
    })
}

//! Lowering of statements, conditions and guesses.

use super::lowerer::Lowerer;
use super::names::Symbol;
use super::range::IndexRange;
use super::scope::{Allow, Scope};
use crate::ast::{BodyExpr, ConditionDecl, Expr, GuessDecl, Item, OperandExpr, PairExpr, Statement, text};
use kin_core::mechanism::{
    Axis, BodyRef, Condition, Formula, Guess, GuessTarget, Mechanism, Member, Operand, OperandSlot, OperandType,
    Operands, Radii, Value, Vector, Written,
};
use kin_core::vocabulary::StatementKind;

impl Lowerer<'_> {
    /// Lowers all statements, conditions and guesses in order; those with errors are left out.
    pub(super) fn rows(&mut self, items: &[Item], ranges: &[IndexRange], mechanism: &mut Mechanism) {
        for (item, range) in items.iter().zip(ranges) {
            match item {
                Item::Statement(row) => {
                    let (keyword, origin) = (self.origin(row.keyword.span()), self.origin(row.name.ident.span()));
                    if let Some(operands) = self.operands(row, range) {
                        let name = text(&row.name.ident);
                        let list = match operands.kind() {
                            StatementKind::Joint(_) => &mut mechanism.joints,
                            StatementKind::Load(_) => &mut mechanism.loads,
                        };
                        list.push(kin_core::mechanism::Statement {
                            name,
                            range: range.model(),
                            operands,
                            keyword,
                            origin,
                        });
                    }
                }
                Item::Condition(decl) => mechanism.conditions.extend(self.condition(decl, range)),
                Item::Guess(guess) => mechanism.guesses.extend(self.guess(guess, range)),
                Item::Body(_)
                | Item::Scalar(_)
                | Item::Input(_)
                | Item::Function(_)
                | Item::Point(_)
                | Item::Define(_) => {}
            }
        }
    }

    /// Lowers all operands, even after one has failed, so that all errors are reported.
    fn operands(&mut self, row: &Statement, range: &IndexRange) -> Option<Operands> {
        let slots = row.form.slots.iter().zip(&row.operands);
        let lowered: Vec<Option<Operand>> = slots.map(|(slot, expr)| self.operand(row, slot, expr, range)).collect();
        Operands::new(row.form, lowered.into_iter().collect::<Option<_>>()?)
    }

    fn operand(
        &mut self,
        row: &Statement,
        slot: &OperandSlot,
        expr: &OperandExpr,
        range: &IndexRange,
    ) -> Option<Operand> {
        Some(match expr {
            OperandExpr::Point(point) => Operand::Point(self.place(point, range)?),
            // The parser has reported that there are too few points.
            OperandExpr::Points(points) if points.len() < 2 => return None,
            OperandExpr::Points(points) => {
                let places: Vec<_> = points.iter().map(|point| self.place(point, range)).collect();
                Operand::Points(places.into_iter().collect::<Option<_>>()?)
            }
            OperandExpr::Body(BodyExpr::Named(body)) => Operand::Body(self.body(body, range)?),
            OperandExpr::Body(BodyExpr::NotGiven) => Operand::Body(BodyRef::Ground(self.origin(row.keyword.span()))),
            OperandExpr::Body(BodyExpr::Hole) | OperandExpr::Scalar(None) => return None,
            OperandExpr::Scalar(Some(name)) => {
                let right = if let OperandType::Scalar(right) = slot.takes { right } else { "" };
                Operand::Scalar(self.scalar_operand(name, right, range)?)
            }
            OperandExpr::Bodies(bodies) if bodies.is_empty() => return None,
            OperandExpr::Bodies(bodies) => {
                let bodies: Vec<_> = bodies.iter().map(|body| self.named_body(body, range)).collect();
                Operand::Bodies(bodies.into_iter().collect::<Option<_>>()?)
            }
            OperandExpr::Pair(pair) => self.pair(slot.takes, pair, range)?,
            OperandExpr::Curve(curve) => Operand::Curve(self.curve(curve, range)?),
            OperandExpr::Value(expr) => {
                let origin = self.origin(expr.span);
                Operand::Value(Value { value: self.value_of(row, slot, expr, range)?, origin })
            }
        })
    }

    fn value_of(&mut self, row: &Statement, slot: &OperandSlot, expr: &Expr, range: &IndexRange) -> Option<Formula> {
        let place = match slot.written {
            Written::Right => format!("the right-hand side of `{}`", row.keyword),
            _ => format!("`{}`", slot.key),
        };
        let scope = match slot.takes {
            OperandType::Support => return self.support(expr, range),
            OperandType::Side if slot.written == Written::Option => {
                Scope { place: &place, allow: Allow::Everything, range }
            }
            OperandType::Side => Scope { place: "an equation", allow: Allow::Everything, range },
            OperandType::SideOfRates if row.form.kind.is_load() => {
                Scope { place: "a couple", allow: Allow::Rates, range }
            }
            OperandType::SideOfRates => Scope { place: "an equation", allow: Allow::Rates, range },
            OperandType::Radius | OperandType::Constant => Scope { place: &place, allow: Allow::Parameters, range },
            _ if slot.written == Written::Right => Scope { place: &place, allow: Allow::RightSide, range },
            _ => Scope { place: &place, allow: Allow::Signals, range },
        };
        self.formula(expr, &scope)
    }

    fn named_body(&mut self, body: &BodyExpr, range: &IndexRange) -> Option<BodyRef> {
        if let BodyExpr::Named(body) = body { self.body(body, range) } else { None }
    }

    fn condition(&mut self, decl: &ConditionDecl, range: &IndexRange) -> Option<Condition> {
        let (keyword, origin) = (self.origin(decl.keyword.span()), self.origin(decl.name.ident.span()));
        let scope = Scope { place: "a condition", allow: Allow::Everything, range };
        let (left, right) = (self.formula(&decl.left, &scope), self.formula(&decl.right, &scope));
        Some(Condition {
            name: text(&decl.name.ident),
            range: range.model(),
            text: decl.text.clone(),
            left: left?,
            relation: decl.relation?,
            right: right?,
            keyword,
            origin,
        })
    }

    fn pair(&mut self, takes: OperandType, pair: &PairExpr, range: &IndexRange) -> Option<Operand> {
        let (place, allow) = match takes {
            OperandType::Vector => ("a force", Allow::Rates),
            OperandType::Radii => ("`radii`", Allow::Parameters),
            _ => ("an axis", Allow::Parameters),
        };
        let origin = self.origin(pair.span);
        let mut component = |expr: &Expr| {
            let origin = self.origin(expr.span);
            Some(Value { value: self.formula(expr, &Scope { place, allow, range })?, origin })
        };
        let (x, y) = (component(&pair.x), component(&pair.y));
        let (x, y) = (x?, y?);
        Some(match takes {
            OperandType::Vector => Operand::Vector(Vector { x: x.value, y: y.value, origin }),
            OperandType::Radii => Operand::Radii(Radii { i: x, j: y, origin }),
            _ => Operand::Axis(Axis { x: x.value, y: y.value, origin }),
        })
    }

    fn guess(&mut self, guess: &GuessDecl, range: &IndexRange) -> Option<Guess> {
        let origin = self.origin(guess.target.ident.span());
        let target = self.target(guess, range);
        let scope = Scope { place: "a guess", allow: Allow::Parameters, range };
        let value = self.formula(&guess.value, &scope);
        Some(Guess { target: target?, value: value?, range: range.model(), origin })
    }

    fn target(&mut self, guess: &GuessDecl, range: &IndexRange) -> Option<GuessTarget> {
        let used = &guess.target;
        let name = used.text();
        if let Some(component) = &guess.component {
            let which = self.body_component(component, &name);
            let body = self.body(used, range);
            return Some(GuessTarget::Pose(body?, which?));
        }
        if name == "ground" {
            return self
                .refuse(used.ident.span(), "the ground does not move; a guess is for a coordinate: `crank.phi = 0.9`");
        }
        let declared = self.resolve(used, "coordinate", |symbol| matches!(symbol, Symbol::Scalar(_)))?;
        match declared.symbol {
            Symbol::Scalar(family) => {
                let index = self.member(used, &declared, range)?;
                let origin = self.origin(used.ident.span());
                Some(GuessTarget::Scalar(Member { family, index, origin }))
            }
            Symbol::Body(_) => {
                let message = format!("`{name}` is a body; a guess is for one coordinate of it: `{name}.phi = 0.9`");
                self.refuse(used.ident.span(), message)
            }
            other => {
                let message = format!("`{name}` is {}; a guess is for a coordinate", other.noun());
                self.refuse(used.ident.span(), message)
            }
        }
    }
}

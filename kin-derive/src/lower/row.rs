//! Rows and guesses.

use super::Lowerer;
use super::declare::IndexRange;
use super::formula::{Allow, Scope};
use super::gearing::Pair;
use super::names::Symbol;
use crate::ast::{AxisExpr, ConditionDecl, Expr, GuessDecl, Item, NameUse, RowKind, text};
use kin_core::mechanism::{
    Axis, BodyRef, Component, Condition, Formula, Guess, GuessTarget, Joint, JointKind, Mechanism, Member,
};

impl Lowerer<'_> {
    /// All rows and guesses in order; one with a mistake is left out.
    pub(super) fn rows(&mut self, items: &[Item], ranges: &[IndexRange], mechanism: &mut Mechanism) {
        for (item, range) in items.iter().zip(ranges) {
            match item {
                Item::Row(row) => {
                    let (keyword, origin) = (self.origin(row.keyword.span()), self.origin(row.name.ident.span()));
                    if let Some(kind) = self.row(&row.kind, range) {
                        let name = text(&row.name.ident);
                        mechanism.joints.push(Joint { name, range: range.model(), kind, keyword, origin });
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

    /// Every part is lowered before one that failed ends it, so that all mistakes are told.
    fn row(&mut self, kind: &RowKind, range: &IndexRange) -> Option<JointKind> {
        Some(match kind {
            RowKind::Revolute { p, q } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                JointKind::Revolute { p: p?, q: q? }
            }
            RowKind::Translational { p, q, axis, angle } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let (axis, angle) = (self.axis(axis, range), self.signal(angle, "`angle`", range));
                JointKind::Translational { p: p?, q: q?, axis: axis?, angle: angle? }
            }
            RowKind::Fixed { p, q, angle } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let angle = self.signal(angle, "`angle`", range);
                JointKind::Fixed { p: p?, q: q?, angle: angle? }
            }
            RowKind::PointOnLine { p, q, axis, offset } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let (axis, offset) = (self.axis(axis, range), self.signal(offset, "`offset`", range));
                JointKind::PointOnLine { p: p?, q: q?, axis: axis?, offset: offset? }
            }
            RowKind::Distance { p, q, length } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let length_origin = self.origin(length.span);
                let length = self.signal(length, "`length`", range);
                JointKind::Distance { p: p?, q: q?, length: length?, length_origin }
            }
            RowKind::X { p, value } => {
                let (p, value) = (self.place(p, range), self.signal(value, "the right-hand side of `x`", range));
                JointKind::Coordinate { p: p?, component: Component::X, value: value? }
            }
            RowKind::Y { p, value } => {
                let (p, value) = (self.place(p, range), self.signal(value, "the right-hand side of `y`", range));
                JointKind::Coordinate { p: p?, component: Component::Y, value: value? }
            }
            RowKind::Angle { body, value } => {
                let body = self.operand(body.as_ref(), range);
                let value = self.signal(value, "the right-hand side of `angle`", range);
                JointKind::Angle { body: body?, value: value? }
            }
            RowKind::RelativeAngle { a, b, value } => {
                let (a, b) = (self.operand(a.as_ref(), range), self.operand(b.as_ref(), range));
                let value = self.signal(value, "the right-hand side of `relative_angle`", range);
                JointKind::RelativeAngle { a: a?, b: b?, value: value? }
            }
            RowKind::OnCurve { p, q, curve } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let curve = self.curve(curve, range);
                JointKind::OnCurve { p: p?, q: q?, curve: curve? }
            }
            RowKind::FlatFollower { p, q, axis, support } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let (axis, support) = (self.axis(axis, range), self.support(support, range));
                JointKind::FlatFollower { p: p?, q: q?, axis: axis?, support: support? }
            }
            RowKind::Gear(pair) => {
                let Pair { a, b, radii, carrier, offset } = self.pair(pair, range)?;
                JointKind::Gear { a, b, radii, carrier, offset }
            }
            RowKind::Belt(pair) => {
                let Pair { a, b, radii, carrier, offset } = self.pair(pair, range)?;
                JointKind::Belt { a, b, radii, carrier, offset }
            }
            RowKind::RackPinion { p, q, axis, pinion, radius, offset } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let (axis, pinion) = (self.axis(axis, range), self.operand(pinion.as_ref(), range));
                let (radius, offset) = (self.radius(radius, "`radius`", range), self.signal(offset, "`offset`", range));
                let (p, q, axis, pinion) = (p?, q?, axis?, pinion?);
                JointKind::RackPinion { p, q, axis, pinion, radius: radius?, offset: offset? }
            }
            RowKind::RollingOnLine { p, q, axis, radius, offset } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let axis = self.axis(axis, range);
                let (radius, offset) = (self.radius(radius, "`radius`", range), self.signal(offset, "`offset`", range));
                JointKind::RollingOnLine { p: p?, q: q?, axis: axis?, radius: radius?, offset: offset? }
            }
            RowKind::RollingOnDisc { p, q, radii, along, offset } => {
                let (p, q) = (self.place(p, range), self.place(q, range));
                let radii = self.radii(radii, range);
                let right = "`along` names a scalar coordinate, `#[coordinates(psi)]`";
                let along = along.as_ref().and_then(|along| self.scalar_operand(along, right, range));
                let offset = self.signal(offset, "`offset`", range);
                JointKind::RollingOnDisc { p: p?, q: q?, radii: radii?, along: along?, offset: offset? }
            }
            RowKind::Constraint { left, right } => {
                let (left, right) = (self.anything(left, range), self.anything(right, range));
                JointKind::Constraint { left: left?, right: right? }
            }
            RowKind::KnifeEdge { p, angle } => {
                let (p, angle) = (self.place(p, range), self.signal(angle, "`angle`", range));
                JointKind::KnifeEdge { p: p?, angle: angle? }
            }
            RowKind::Speed { p, angle, value } => {
                let (p, angle) = (self.place(p, range), self.signal(angle, "`angle`", range));
                let value = self.signal(value, "`value`", range);
                JointKind::Speed { p: p?, angle: angle?, value: value? }
            }
            RowKind::Nonholonomic { left, right } => {
                let scope = Scope { what: "an equation", allow: Allow::Rates, range };
                let (left, right) = (self.formula(left, &scope), self.formula(right, &scope));
                JointKind::Nonholonomic { left: left?, right: right? }
            }
            RowKind::Driver { left, right } => {
                let right_origin = self.origin(right.span);
                let (left, right) = (self.anything(left, range), self.anything(right, range));
                JointKind::Driver { left: left?, right: right?, right_origin }
            }
        })
    }

    fn condition(&mut self, decl: &ConditionDecl, range: &IndexRange) -> Option<Condition> {
        let (keyword, origin) = (self.origin(decl.keyword.span()), self.origin(decl.name.ident.span()));
        let scope = Scope { what: "a condition", allow: Allow::Everything, range };
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

    pub(super) fn operand(&mut self, body: Option<&NameUse>, range: &IndexRange) -> Option<BodyRef> {
        body.and_then(|body| self.body(body, range))
    }

    fn axis(&mut self, axis: &AxisExpr, range: &IndexRange) -> Option<Axis> {
        let origin = self.origin(axis.span);
        let scope = Scope { what: "an axis", allow: Allow::Parameters, range };
        let (x, y) = (self.formula(&axis.x, &scope), self.formula(&axis.y, &scope));
        Some(Axis { x: x?, y: y?, origin })
    }

    pub(super) fn signal(&mut self, expr: &Expr, what: &'static str, range: &IndexRange) -> Option<Formula> {
        self.formula(expr, &Scope { what, allow: Allow::Signals, range })
    }

    fn anything(&mut self, expr: &Expr, range: &IndexRange) -> Option<Formula> {
        self.formula(expr, &Scope { what: "an equation", allow: Allow::Everything, range })
    }

    fn guess(&mut self, guess: &GuessDecl, range: &IndexRange) -> Option<Guess> {
        let origin = self.origin(guess.target.ident.span());
        let target = self.target(guess, range);
        let scope = Scope { what: "a guess", allow: Allow::Parameters, range };
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
            self.report
                .error(used.ident.span(), "the ground does not move; a guess is for a coordinate: `crank.phi = 0.9`");
            return None;
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
                self.report.error(used.ident.span(), message);
                None
            }
            other => {
                let message = format!("`{name}` is {}; a guess is for a coordinate", other.noun());
                self.report.error(used.ident.span(), message);
                None
            }
        }
    }
}

//! Lowering of points, defines and bodies.

use super::lowerer::{Class, Lowerer};
use super::names::Symbol;
use super::range::IndexRange;
use super::scope::{Allow, Scope};
use crate::ast::{BodyDecl, Expr, ExprKind, Item, NewName, PointExpr, text};
use kin_core::check::{chain, cycle};
use kin_core::mechanism::{BodyOrigin, Mechanism};

/// A body without prescribed components.
pub(super) const FREE: BodyOrigin = BodyOrigin::Free { x: None, y: None };

/// A point or a define with its index among those of its kind.
enum Named<'d> {
    Point(usize, &'d crate::ast::PointDecl),
    Define(usize, &'d crate::ast::DefineDecl),
}

impl Named<'_> {
    const fn name(&self) -> &NewName {
        match self {
            Self::Point(_, decl) => &decl.name,
            Self::Define(_, decl) => &decl.name,
        }
    }
}

impl Lowerer<'_> {
    /// Lowers points and defines, each after those on which it depends; cyclic dependencies are reported.
    pub(super) fn points_and_defines(&mut self, items: &[Item], ranges: &[IndexRange], mechanism: &mut Mechanism) {
        let (mut points, mut defines) = (Vec::new(), Vec::new());
        let (mut named, mut ranges_of_named) = (Vec::new(), Vec::new());
        for (item, range) in items.iter().zip(ranges) {
            match item {
                Item::Point(decl) => {
                    points.push(named.len());
                    named.push(Named::Point(points.len() - 1, decl));
                    ranges_of_named.push(range);
                }
                Item::Define(decl) => {
                    defines.push(named.len());
                    named.push(Named::Define(defines.len() - 1, decl));
                    ranges_of_named.push(range);
                }
                Item::Body(_)
                | Item::Scalar(_)
                | Item::Input(_)
                | Item::Statement(_)
                | Item::Condition(_)
                | Item::Function(_)
                | Item::Guess(_) => {}
            }
        }
        self.points = vec![None; points.len()];
        self.defines = vec![None; defines.len()];
        self.constants = vec![None; defines.len()];
        let place_of = |symbol| match symbol {
            Symbol::Point(k) => points.get(k).copied(),
            Symbol::Define(k) => defines.get(k).copied(),
            Symbol::Parameter(_) | Symbol::Body(_) | Symbol::Scalar(_) | Symbol::Input(_) | Symbol::Function(_) => None,
        };
        let edges: Vec<Vec<usize>> =
            named.iter().map(|decl| self.parts(decl).into_iter().filter_map(place_of).collect()).collect();
        let order = cycle::order(&edges);
        let mut in_circle = vec![false; named.len()];
        for circle in &order.cycles {
            circle.iter().for_each(|&k| in_circle[k] = true);
            let names: Vec<String> = circle.iter().map(|&k| text(&named[k].name().ident)).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            if let Some(&first) = circle.first() {
                let message = format!("{}; a define must not depend on itself", chain(&names, "uses", "uses itself"));
                self.report.error(named[first].name().ident.span(), message);
            }
        }
        for k in order.order {
            if in_circle[k] {
                continue;
            }
            let range = ranges_of_named[k];
            match &named[k] {
                Named::Point(number, decl) => {
                    if let Some(place) = self.place(&decl.place, range) {
                        mechanism.points[*number].place = place;
                        self.points[*number] = Some(mechanism.points[*number].clone());
                    }
                }
                Named::Define(number, decl) => {
                    self.reached = Class::Constant;
                    let scope = Scope { place: "a define", allow: Allow::Everything, range };
                    if let Some(formula) = self.formula(&decl.value, &scope) {
                        self.constants[*number] = self.constant(&formula);
                        mechanism.defines[*number].formula = formula;
                        self.defines[*number] = Some((mechanism.defines[*number].clone(), self.reached));
                    }
                }
            }
        }
    }

    /// The names on which a point or a define depends.
    fn parts(&self, decl: &Named) -> Vec<Symbol> {
        let mut used = Vec::new();
        match decl {
            Named::Point(_, decl) => names_in_point(&decl.place, &mut used),
            Named::Define(_, decl) => names_in(&decl.value, &mut used),
        }
        used.iter().filter_map(|name| self.names.find(name)).map(|declared| declared.symbol).collect()
    }

    /// Lowers the held components and origins of bodies.
    pub(super) fn bodies(&mut self, items: &[Item], ranges: &[IndexRange], mechanism: &mut Mechanism) {
        let decls = items.iter().zip(ranges).filter_map(|(item, range)| match item {
            Item::Body(decl) => Some((decl, range)),
            _ => None,
        });
        for (k, (decl, range)) in decls.enumerate() {
            self.body_decl(decl, range, &mut mechanism.bodies[k]);
        }
    }

    fn body_decl(&mut self, decl: &BodyDecl, range: &IndexRange, body: &mut kin_core::mechanism::Body) {
        let carried = decl.carried.as_ref().map(|(key, point)| (key, self.place(point, range)));
        let (mut x, mut y) = (None, None);
        for (key, value) in &decl.held {
            let scope = Scope { place: "a held coordinate", allow: Allow::Scalars, range };
            let formula = self.formula(value, &scope);
            match text(key).as_str() {
                "phi" => body.phi = formula,
                name if carried.is_some() => {
                    let body = &body.name;
                    let message = format!(
                        "`{body}` has its origin carried; {name} of `{body}` follows from it and cannot be held, too"
                    );
                    self.report.error(key.span(), message);
                }
                "x" => x = formula,
                _ => y = formula,
            }
        }
        body.origin_at = match carried {
            Some((_, Some(place))) => BodyOrigin::Carried(place),
            Some((_, None)) | None => BodyOrigin::Free { x, y },
        };
    }
}

fn names_in_point(point: &PointExpr, names: &mut Vec<String>) {
    match point {
        PointExpr::At { x, y, .. } => {
            names_in(x, names);
            names_in(y, names);
        }
        PointExpr::Named(used) => names.push(used.text()),
        PointExpr::Hole => {}
    }
}

fn names_in(expr: &Expr, names: &mut Vec<String>) {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Hole => {}
        ExprKind::Name(used) | ExprKind::Component(used, _) => names.push(used.text()),
        ExprKind::Distance(p, q) => {
            names_in_point(p, names);
            names_in_point(q, names);
        }
        ExprKind::Neg(a) | ExprKind::Pow(a, _) | ExprKind::Call(_, a) | ExprKind::Dot(_, a) => names_in(a, names),
        ExprKind::Binary(_, a, b) | ExprKind::Atan2(a, b) => {
            names_in(a, names);
            names_in(b, names);
        }
        ExprKind::Apply(_, arguments) => arguments.iter().for_each(|argument| names_in(argument, names)),
    }
}

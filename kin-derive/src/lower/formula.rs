//! Lowering of expressions: resolves names, and checks that everything may be used at this place.

use super::lowerer::{Class, Lowerer};
use super::mention::{MentionKind, is_completion_marker};
use super::names::{Declared, Shape, Symbol};
use super::range::IndexRange;
use super::scope::{Allow, Scope};
use crate::ast::{Expr, ExprKind, NameUse, Operator, text};
use crate::function::{function_of_places, other_function};
use crate::suggest::{did_you_mean, is_rate, quoted, rate_of_a_component};
use kin_core::check::is_reserved;
use kin_core::mechanism::{BodyRef, Component, Formula, Function, Index, Member};
use proc_macro2::Span;
use syn::Ident;

impl Lowerer<'_> {
    /// Lowers an expression; `None` if it has errors, all of which are reported.
    pub(super) fn formula(&mut self, expr: &Expr, scope: &Scope) -> Option<Formula> {
        Some(match &expr.kind {
            ExprKind::Hole => return None,
            ExprKind::Number(value) => Formula::Number(*value),
            ExprKind::Name(used) => return self.value(used, scope),
            ExprKind::Component(used, component) => return self.component(used, component, scope),
            ExprKind::Distance(p, q) => {
                let (p, q) = (self.place(p, scope.range), self.place(q, scope.range));
                let (p, q) = (p?, q?);
                let class = if p.body.is_ground() && q.body.is_ground() { Class::Constant } else { Class::Coordinate };
                self.require(class, "this distance contains coordinates", (expr.span, expr.span), scope)?;
                Formula::Distance(Box::new(p), Box::new(q))
            }
            ExprKind::Neg(a) => Formula::Neg(Box::new(self.formula(a, scope)?)),
            ExprKind::Binary(operator, a, b) => {
                let (left, right) = (self.formula(a, scope), self.formula(b, scope));
                if *operator == Operator::Div && right.as_ref().and_then(Formula::literal) == Some(0.0) {
                    // Reported here, because a later check does not see a statement that is left out of the model
                    // on account of another error.
                    return self.refuse(b.span, "this divides by 0; a divisor is never a literal 0");
                }
                let (left, right) = (Box::new(left?), Box::new(right?));
                let result = match operator {
                    Operator::Add => Formula::Add(left, right),
                    Operator::Sub => Formula::Sub(left, right),
                    Operator::Mul => Formula::Mul(left, right),
                    Operator::Div => Formula::Div(left, right, self.origin(b.span)),
                };
                self.with_value(result, expr.span)?
            }
            ExprKind::Pow(a, n) => {
                let power = Formula::Pow(Box::new(self.formula(a, scope)?), *n);
                self.with_values(power, expr.span, scope.range)?
            }
            ExprKind::Call(function, a) => {
                let call = Formula::Call(*function, Box::new(self.formula(a, scope)?));
                self.with_values(call, expr.span, scope.range)?
            }
            ExprKind::Atan2(y, x) => {
                let (y, x) = (self.formula(y, scope), self.formula(x, scope));
                Formula::Atan2(Box::new(y?), Box::new(x?))
            }
            ExprKind::Dot(name, a) => {
                let inside = Scope { place: "`dot`", allow: Allow::InsideDot, range: scope.range };
                let a = self.formula(a, &inside);
                match scope.allow {
                    Allow::Rates => Formula::Dot(Box::new(a?), self.origin(name.span())),
                    Allow::InsideDot => {
                        let message =
                            "`dot` inside `dot` is an acceleration; rates are allowed here, accelerations are not";
                        return self.refuse(name.span(), message);
                    }
                    Allow::Parameters | Allow::Signals | Allow::RightSide | Allow::Scalars | Allow::Everything => {
                        let message = format!(
                            "`dot` is a rate, and {} cannot contain rates; `dot(…)` is allowed only in `nonholonomic`, \
                             `force` and `torque`: `#[nonholonomic(N: dot(a.x) = v)]`",
                            scope.place
                        );
                        return self.refuse(name.span(), message);
                    }
                }
            }
            ExprKind::Apply(used, arguments) => {
                // The arguments of a function that does not exist are bodies or points, which are no numbers.
                if let Some(message) = function_of_places(&used.text())
                    && self.names.find(&used.text()).is_none()
                {
                    return if self.names_missing { None } else { self.refuse(used.ident.span(), message) };
                }
                // The arguments are lowered first, so that errors in them are reported, too.
                let arguments: Vec<_> = arguments.iter().map(|argument| self.formula(argument, scope)).collect();
                return self.supplied(used, arguments, scope);
            }
        })
    }

    /// Lowers a name that stands for a number.
    fn value(&mut self, used: &NameUse, scope: &Scope) -> Option<Formula> {
        let name = used.text();
        if let Some(variable) = self.inside.variable(&name) {
            return self.curve_variable(variable, used, scope);
        }
        // If anything else has the name of the index variable, an error has been reported, and most uses mean the index.
        if let IndexRange::Over(range) = scope.range
            && text(&range.variable) == name
        {
            if let Some(index) = &used.index {
                return self.refuse(index.span, format!("`{name}` is the index variable; it takes no index"));
            }
            return Some(Formula::Index(Index { scale: 1, offset: 0 }));
        }
        if is_reserved(&name) {
            return self.reserved(&name, used, scope);
        }
        let is_value: fn(Symbol) -> bool =
            |symbol| matches!(symbol, Symbol::Parameter(_) | Symbol::Scalar(_) | Symbol::Input(_) | Symbol::Define(_));
        if self.is_variable_of_another_curve(used) || self.is_slip_of_the_curve(used) {
            return None;
        }
        if self.is_unnamed_index(used, scope.range) {
            return None;
        }
        let declared = self.resolve(used, "parameter, coordinate or define", is_value)?;
        let span = used.ident.span();
        match declared.symbol {
            Symbol::Body(_) => {
                let message =
                    format!("`{name}` is a body; its coordinates are `{name}.x`, `{name}.y` and `{name}.phi`");
                return self.refuse(span, message);
            }
            Symbol::Point(_) => {
                let message = format!("`{name}` is a point; its coordinates are `{name}.x` and `{name}.y`");
                return self.refuse(span, message);
            }
            Symbol::Function(_) => {
                let index = if matches!(declared.shape, Shape::Family(_)) { "[i]" } else { "" };
                let message = format!(
                    "`{name}` is a function; its argument stands in parentheses, `{name}{index}(t)`; if `{name}` is \
                     meant as a number, remove it from `#[function(…)]`"
                );
                return self.refuse(span, message);
            }
            _ => {}
        }
        let index = self.member(used, &declared, scope.range)?;
        let origin = self.origin(span);
        match declared.symbol {
            Symbol::Parameter(family) => Some(Formula::Parameter(Member { family, index, origin })),
            Symbol::Input(family) => {
                self.require(Class::Signal, &format!("`{name}` is an input"), (span, span), scope)?;
                Some(Formula::Input(Member { family, index, origin }))
            }
            Symbol::Scalar(family) if self.inside.is_parameter(family, index) && scope.allow == Allow::Signals => {
                Some(Formula::Scalar(Member { family, index, origin }))
            }
            Symbol::Scalar(family) => {
                self.require(Class::Scalar, &format!("`{name}` is a coordinate"), (span, span), scope)?;
                Some(Formula::Scalar(Member { family, index, origin }))
            }
            Symbol::Define(family) => {
                // A define with errors has been reported.
                let class = self.defines.get(family)?.as_ref()?.1;
                let depends = match class {
                    Class::Coordinate if scope.allow == Allow::Scalars => "coordinates of bodies",
                    Class::Coordinate | Class::Scalar => "coordinates",
                    Class::Signal | Class::Constant => "`t` or inputs",
                };
                self.require(class, &format!("the define `{name}` contains {depends}"), (span, span), scope)?;
                Some(Formula::Define(Member { family, index, origin }))
            }
            Symbol::Body(_) | Symbol::Point(_) | Symbol::Function(_) => None,
        }
    }

    /// Lowers `f(e)` or `f[i](e)`, a supplied function at an argument; it may be used wherever its argument may be
    /// used.
    fn supplied(&mut self, used: &NameUse, arguments: Vec<Option<Formula>>, scope: &Scope) -> Option<Formula> {
        let name = used.text();
        let declared = match self.names.find(&name) {
            Some(declared) if matches!(declared.symbol, Symbol::Function(_)) => declared.clone(),
            _ if self.names.is_ambiguous(&name) => return None,
            _ => {
                if let (Some(index), true) = (&used.index, is_reserved(&name)) {
                    return self.refuse(index.span, format!("`{name}` takes no index"));
                }
                self.no_function(&used.ident, scope);
                return None;
            }
        };
        let Symbol::Function(family) = declared.symbol else { return None };
        self.mention_function(used, &declared.shape);
        let index = self.member(used, &declared, scope.range);
        let given = arguments.len();
        let Ok([argument]) = <[Option<Formula>; 1]>::try_from(arguments) else {
            let values = if given == 0 { "is nothing".to_owned() } else { format!("are {given} values") };
            let message = format!("a supplied function has one argument, `{name}(e)`; here {values} in its brackets");
            return self.refuse(used.ident.span(), message);
        };
        let origin = self.origin(used.ident.span());
        Some(Formula::Supplied(Member { family, index: index?, origin }, Box::new(argument?)))
    }

    /// Records a mention of a function, except where its field is missing.
    fn mention_function(&mut self, used: &NameUse, shape: &Shape) {
        if *shape != Shape::Unknown {
            self.mention(MentionKind::Function, &used.ident);
        }
    }

    fn reserved(&mut self, name: &str, used: &NameUse, scope: &Scope) -> Option<Formula> {
        if let Some(index) = &used.index {
            return self.refuse(index.span, format!("`{name}` takes no index"));
        }
        let span = used.ident.span();
        match name {
            "pi" => Some(Formula::Pi),
            "t" => self.require(Class::Signal, "`t` is time", (span, span), scope).map(|()| Formula::Time),
            "ground" => self.refuse(span, "`ground` is a body; an expression has numbers"),
            _ => self.refuse(span, format!("`{name}` is a function; its argument stands in parentheses, `{name}(…)`")),
        }
    }

    /// Lowers a component: `crank.phi`, `tip.x`.
    fn component(&mut self, used: &NameUse, component: &Ident, scope: &Scope) -> Option<Formula> {
        let name = used.text();
        let is_ground = name == "ground";
        if !is_ground && is_reserved(&name) {
            let message = format!("`{name}` has no components; bodies and points have");
            return self.refuse(component.span(), message);
        }
        // The position of a joint is that of a point.
        if matches!(text(component).as_str(), "x" | "y")
            && !self.names_missing
            && self.names.find(&name).is_none()
            && let Some(message) = self.row_names.used_as(&name, "body or point", false)
        {
            return self.refuse(used.ident.span(), message);
        }
        let has_components: fn(Symbol) -> bool = |symbol| matches!(symbol, Symbol::Body(_) | Symbol::Point(_));
        let declared = if is_ground { None } else { Some(self.resolve(used, "body or point", has_components)?) };
        let whole = format!("`{name}.{}` is a coordinate", text(component));
        match declared.as_ref().map(|d| d.symbol) {
            None | Some(Symbol::Body(_)) => {
                let which = self.body_component(component, &name);
                let body = match declared {
                    None => self.body(used, scope.range),
                    Some(declared) => {
                        let Symbol::Body(family) = declared.symbol else { return None };
                        let index = self.member(used, &declared, scope.range);
                        let origin = self.origin(used.ident.span());
                        index.map(|index| BodyRef::Body { family, index, origin })
                    }
                }?;
                let class = if body.is_ground() { Class::Constant } else { Class::Coordinate };
                self.require(class, &whole, (used.ident.span(), component.span()), scope)?;
                Some(Formula::Pose(body, which?))
            }
            Some(Symbol::Point(k)) => {
                let which = self.point_component(component);
                let declared = declared?;
                let place = self.point_member(k, &declared, used, scope.range)?;
                let class = if place.body.is_ground() { Class::Constant } else { Class::Coordinate };
                self.require(class, &whole, (used.ident.span(), component.span()), scope)?;
                Some(Formula::PointCoordinate(Box::new(place), which?))
            }
            Some(Symbol::Input(_)) => {
                let message = format!(
                    "`{name}` is an input; write `{name}` alone: its rate and acceleration are used automatically"
                );
                self.refuse(component.span(), message)
            }
            Some(other) => {
                let noun = other.noun();
                let message = match Function::from_name(&text(component)) {
                    Some(function) => {
                        let function = function.name();
                        format!("`{name}` is {noun}; a function is called with brackets: `{name}.{function}()`")
                    }
                    None => format!("`{name}` is {noun} and has no components; bodies and points have"),
                };
                self.refuse(component.span(), message)
            }
        }
    }

    /// The component x, y or phi of a body.
    pub(super) fn body_component(&mut self, component: &Ident, body: &str) -> Option<Component> {
        let name = text(component);
        let found = Component::ALL.into_iter().find(|c| c.name() == name);
        if found.is_none() && !self.is_completed(component) {
            let right = rate_of_a_component(&name);
            let message = format!("a body has `x`, `y` and `phi`; `{body}.{name}` does not exist{right}");
            self.report.error(component.span(), message);
        }
        found
    }

    fn point_component(&mut self, component: &Ident) -> Option<Component> {
        match text(component).as_str() {
            "x" => Some(Component::X),
            "y" => Some(Component::Y),
            name => {
                if !self.is_completed(component) {
                    let message = match rate_of_a_component(name) {
                        "" => format!("a point has `x` and `y`; `{name}` would belong to its body"),
                        rate => format!("a point has `x` and `y`; `{name}` does not exist{rate}"),
                    };
                    self.report.error(component.span(), message);
                }
                None
            }
        }
    }

    fn is_completed(&mut self, ident: &Ident) -> bool {
        let is_marker = is_completion_marker(ident);
        self.completing |= is_marker;
        is_marker
    }

    fn no_function(&self, name: &Ident, scope: &Scope) {
        let word = text(name);
        let message = match self.names.find(&word) {
            Some(Declared { symbol: Symbol::Parameter(_), .. }) => format!(
                "`{word}` is a parameter, not a function; a product is written with `*`, and a field that holds a function is declared with `#[function({word})]`"
            ),
            Some(found) => {
                format!("`{word}` is {}, not a function; a product is written with `*`", found.symbol.noun())
            }
            None if matches!(word.as_str(), "t" | "pi" | "ground") => {
                format!("`{word}` is no function; a product is written with `*`")
            }
            None if self.names_missing => return,
            None if other_function(&word).is_some() => other_function(&word).unwrap_or_default(),
            None => {
                let has_rates = matches!(scope.allow, Allow::Rates | Allow::InsideDot);
                let more_functions = ["atan2", "pow", "distance"].into_iter().chain(has_rates.then_some("dot"));
                let known = Function::ALL.iter().map(|f| f.name()).chain(more_functions).chain(self.names.functions());
                let suggestion = match word.as_str() {
                    "log" => "; the natural logarithm is `ln`".to_owned(),
                    rate if is_rate(rate) && has_rates => "; a rate is written `dot(…)`".to_owned(),
                    rate if is_rate(rate) => {
                        "; a rate is written `dot(…)`, in `nonholonomic`, `force` and `torque` only".to_owned()
                    }
                    _ => did_you_mean(&word, known),
                };
                let last = if has_rates { ", pow, distance and dot" } else { ", pow and distance" };
                format!(
                    "no function `{word}`; there are sin, cos, tan, asin, acos, atan, atan2, sqrt, exp, ln, abs{last}{suggestion}"
                )
            }
        };
        self.report.error(name.span(), message);
    }

    /// Records the class of a part of the formula, and reports it if it is not allowed at this place.
    pub(super) fn require(
        &mut self,
        class: Class,
        found: &str,
        (first, last): (Span, Span),
        scope: &Scope,
    ) -> Option<()> {
        self.reached = self.reached.max(class);
        if class <= scope.allow.class() {
            return Some(());
        }
        let words = self.inside.words();
        let right = match scope.allow {
            Allow::Parameters => "numbers and parameters only".to_owned(),
            Allow::Scalars => "numbers, parameters, `t`, inputs and scalar coordinates only".to_owned(),
            _ if words.is_empty() => "numbers, parameters, `t` and inputs only".to_owned(),
            _ => {
                format!("numbers, parameters, `t`, inputs and {} only", quoted(words, "and"))
            }
        };
        let equation = match scope.allow {
            Allow::RightSide => "; `constraint(N: left = right)` is an equation of coordinates",
            _ => "",
        };
        self.report.error_between(first, last, format!("{found}; {} takes {right}{equation}", scope.place));
        None
    }
}

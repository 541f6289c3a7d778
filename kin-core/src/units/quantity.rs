//! The units of formulas, from the units of the names in them.

use super::checker::{
    Checker, Named,
    QuantityUnit::{self, Any, Clock, MultipleOfAngle, Of, Plain},
    WrittenUnit, name_alone,
};
use super::conversion::conversion;
use super::unit::Unit;
use crate::error::{ModelError, Origin};
use crate::mechanism::{Component, CurveVariable, Formula, Function, Place};

/// What a unit measures, in words.
fn kind(unit: Unit) -> String {
    let words = match unit.powers.map(|power| power.round() as i32) {
        [1, 0, 0] => "a length",
        [0, 1, 0] => "a time",
        [0, 0, 1] => "a mass",
        [2, 0, 1] => "a moment of inertia",
        [1, -1, 0] => "a speed",
        [1, -2, 0] => "an acceleration",
        [1, -2, 1] => "a force",
        [2, -2, 1] => "a couple",
        [0, -2, 1] => "a force per length",
        [0, -1, 1] => "a force per speed",
        [2, -1, 1] => "a couple per angular speed",
        _ => return unit.to_string(),
    };
    words.to_owned()
}

/// The unit, in any scale, by which `found` is multiplied to become `unit`.
fn factor_of(unit: Unit, found: Unit) -> Unit {
    Unit { scale: None, ..unit.times(found.power(-1.0)) }
}

impl Checker<'_> {
    pub(super) fn place(&mut self, place: &Place) {
        for value in [&place.x, &place.y] {
            self.expect(value, self.length, place.origin);
        }
    }

    /// Checks that `formula` is an angle in rad.
    pub(super) fn expect_angle(&mut self, formula: &Formula, at: Origin) {
        self.at = at;
        let quantity = self.quantity(formula);
        self.report_turns(formula, quantity);
        self.expect(formula, Unit::NUMBER, at);
    }

    /// Checks that `formula` has `unit`. An error points at the first name in the formula, or at `at` if there is none.
    pub(super) fn expect(&mut self, formula: &Formula, unit: Unit, at: Origin) {
        self.at = at;
        let found = match self.quantity(formula) {
            Of(found) => found,
            MultipleOfAngle if unit.is_number() => Unit::NUMBER,
            _ => return self.take(formula, unit, 1.0),
        };
        if unit == Unit::NUMBER {
            self.report_turns(formula, Of(found));
        }
        if !found.agrees(unit) {
            // Where no mass has a unit, forces and couples have no scale of their own.
            let follows = unit.powers[2] != 0.0 && !self.mass_is_written;
            let is_open = unit.scale.is_none() || follows && !found.is_like(unit);
            let wanted = match is_open {
                true => kind(unit),
                false if unit == Unit::NUMBER => "an angle in rad".to_owned(),
                false => unit.to_string(),
            };
            let like = match &self.first_length {
                Some(first_length) if unit == self.length && found.is_like(unit) => format!(", {first_length},"),
                _ => String::new(),
            };
            // A number before a rate is no coefficient of damping.
            let is_load = is_open && unit.powers[1] == -2.0;
            let hint = match is_load && found.powers[2] == 0.0 {
                true => {
                    format!("; a number has no unit: let a parameter or a factor be {}", kind(factor_of(unit, found)))
                }
                false => conversion(found, unit),
            };
            let message = format!("the units do not agree: this is {found}, but {wanted}{like} is expected here{hint}");
            self.errors.push(ModelError::new(first_origin(formula).unwrap_or(at), message));
        }
    }

    /// Records that a name without a unit stands where `unit` is expected. If it has been compared with another unit, that
    /// is an error at the name.
    fn take(&mut self, formula: &Formula, unit: Unit, angle: f64) {
        if let Some(before) = self.meets(formula, unit, angle) {
            let (name, hint) = (self.name_of(formula), conversion(before, unit));
            let message = format!(
                "the units do not agree: `{name}` is {before} in another place, but {unit} is expected here{hint}"
            );
            self.errors.push(ModelError::new(first_origin(formula).unwrap_or(self.at), message));
        }
    }

    /// The name of the scalar coordinate or the input that a formula consists of, with its index.
    fn name_of(&self, formula: &Formula) -> String {
        let m = self.mechanism;
        let Some((named, member)) = name_alone(formula) else { return String::new() };
        let found = match named {
            Named::Scalar => m.scalars.get(member.family).map(|scalar| (&scalar.name, scalar.len)),
            _ => m.inputs.get(member.family).map(|input| (&input.name, input.len)),
        };
        match found {
            Some((name, Some(_))) => format!("{name}[{}]", member.index.offset),
            Some((name, None)) => name.clone(),
            None => String::new(),
        }
    }

    /// Checks that both formulas have one unit, and returns it. An error points at the second if it contains a name.
    pub(super) fn same(&mut self, a: &Formula, b: &Formula) -> QuantityUnit {
        let (left, right) = (self.quantity(a), self.quantity(b));
        for ((formula, quantity, quantity_of_formula), other) in [((a, right, left), b), ((b, left, right), a)] {
            let angle = self.angle(other);
            let is_in_radians =
                matches!(quantity, MultipleOfAngle) || matches!(quantity, Of(unit) if unit == Unit::NUMBER);
            if angle == 1.0 && (is_in_radians || matches!(quantity_of_formula, Of(_))) {
                self.report_turns(formula, quantity_of_formula);
            }
            // A number times an angle, as in `s = 0.05*crank.phi`, need not be an angle.
            if let Of(unit) = quantity
                && let Some(before) = self.meets(formula, unit, angle)
            {
                let origin = first_origin(other).or_else(|| first_origin(formula)).unwrap_or(self.at);
                let (name, hint) = (self.name_of(formula), conversion(unit, before));
                let message =
                    format!("the units do not agree: this is {unit}, but `{name}` is {before} in another place{hint}");
                self.errors.push(ModelError::new(origin, message));
            }
        }
        // A multiple of an angle takes any unit but another unit of angles.
        let beside = |quantity, other| match (quantity, other) {
            (MultipleOfAngle, Of(unit)) if unit.is_number() && !unit.agrees(Unit::NUMBER) => Of(Unit::NUMBER),
            _ => quantity,
        };
        match (beside(left, right), beside(right, left)) {
            (Of(one), Of(other)) if !one.agrees(other) => {
                let (found, found_in_other, origin) = match (first_origin(a), first_origin(b)) {
                    (_, Some(origin)) => (other, one, origin),
                    (Some(origin), None) => (one, other, origin),
                    (None, None) => (other, one, self.at),
                };
                let hint = conversion(found, found_in_other);
                let message = format!(
                    "the units do not agree: this is {found}, but the other quantity is {found_in_other}{hint}"
                );
                self.errors.push(ModelError::new(origin, message));
                // `Any` agrees with every unit, so that no further errors follow.
                Any
            }
            (Of(one), Of(other)) => Of(if one.scale.is_some() { one } else { other }),
            (Of(unit), _) | (_, Of(unit)) => Of(unit),
            (Clock(one), Clock(other)) if !one.agrees(other) => Any,
            (Any, _) | (_, Any) => Any,
            (Clock(unit), _) | (_, Clock(unit)) => Clock(unit),
            (MultipleOfAngle, _) | (_, MultipleOfAngle) => MultipleOfAngle,
            (Plain, Plain) => Plain,
        }
    }

    /// The quantity of a define, and its exponent of angles.
    pub(super) fn define(&mut self, k: usize) -> (QuantityUnit, f64) {
        if let Some(known) = self.defines.get(k).copied().flatten() {
            return known;
        }
        let Some(define) = self.mechanism.defines.get(k) else { return (Any, 0.0) };
        let before = std::mem::replace(&mut self.at, define.origin);
        let known = match self.written(Named::Define, k) {
            Some(WrittenUnit { unit, angle }) => {
                if unit == Unit::NUMBER && angle == 1.0 {
                    self.expect_angle(&define.formula, define.origin);
                } else {
                    self.expect(&define.formula, unit, define.origin);
                }
                (Of(unit), angle)
            }
            None => (self.quantity(&define.formula), self.angle(&define.formula)),
        };
        self.at = before;
        self.defines[k] = Some(known);
        known
    }

    pub(super) fn quantity(&mut self, formula: &Formula) -> QuantityUnit {
        match formula {
            Formula::Number(_) | Formula::Pi | Formula::Index(_) => Plain,
            Formula::Time => Clock(self.time),
            Formula::Parameter(member) => self.of(Named::Parameter, member.family),
            Formula::Input(member) => self.of(Named::Input, member.family),
            Formula::Scalar(member) => self.of(Named::Scalar, member.family),
            Formula::Pose(_, Component::Phi) => Of(Unit::NUMBER),
            Formula::Pose(..) => Of(self.length),
            Formula::PointCoordinate(place, _) => {
                self.place(place);
                Of(self.length)
            }
            Formula::Distance(p, q) => {
                [p, q].into_iter().for_each(|place| self.place(place));
                Of(self.length)
            }
            Formula::Define(member) => self.define(member.family).0,
            Formula::Curve(CurveVariable::Theta) => Of(Unit::NUMBER),
            Formula::Curve(_) => Of(self.length),
            Formula::Neg(a) => self.quantity(a),
            Formula::Add(a, b) | Formula::Sub(a, b) => self.same(a, b),
            Formula::Mul(a, b) => {
                let factors = [(self.quantity(a), &**a), (self.quantity(b), &**b)];
                self.product(factors, formula)
            }
            Formula::Div(a, b, _) => {
                let inverse = match self.quantity(b) {
                    Of(unit) => Of(unit.power(-1.0)),
                    Clock(unit) => Clock(unit.power(-1.0)),
                    MultipleOfAngle => Plain,
                    other => other,
                };
                let factors = [(self.quantity(a), &**a), (inverse, &**b)];
                self.product(factors, formula)
            }
            Formula::Pow(a, n) => match self.quantity(a) {
                Of(unit) => Of(unit.power(*n)),
                Clock(unit) => Clock(unit.power(*n)),
                MultipleOfAngle => Plain,
                other => other,
            },
            Formula::Call(function, a) => self.call(*function, a),
            Formula::Atan2(y, x) => {
                self.same(y, x);
                Of(Unit::NUMBER)
            }
            Formula::Supplied(_, a) => {
                self.quantity(a);
                Any
            }
            Formula::Dot(a, _) => match self.quantity(a) {
                Of(unit) => Of(unit.times(self.time.power(-1.0))),
                Clock(_) => Any,
                MultipleOfAngle => Plain,
                other => other,
            },
        }
    }

    /// The exponent of angles in the unit of a formula.
    pub(super) fn angle(&mut self, formula: &Formula) -> f64 {
        let written = |checker: &Self, named, k| checker.written(named, k).map_or(0.0, |written| written.angle);
        match formula {
            Formula::Parameter(member) => written(self, Named::Parameter, member.family),
            Formula::Input(member) => written(self, Named::Input, member.family),
            Formula::Scalar(member) => written(self, Named::Scalar, member.family),
            Formula::Define(member) => self.define(member.family).1,
            Formula::Pose(_, Component::Phi) | Formula::Curve(CurveVariable::Theta) | Formula::Atan2(..) => 1.0,
            Formula::Call(Function::Asin | Function::Acos | Function::Atan, _) => 1.0,
            Formula::Call(Function::Abs, a) | Formula::Neg(a) | Formula::Dot(a, _) => self.angle(a),
            Formula::Add(a, b) | Formula::Sub(a, b) => {
                let angle = self.angle(a);
                if angle == 0.0 { self.angle(b) } else { angle }
            }
            Formula::Mul(a, b) => self.angle(a) + self.angle(b),
            Formula::Div(a, b, _) => self.angle(a) - self.angle(b),
            Formula::Pow(a, n) => n * self.angle(a),
            _ => 0.0,
        }
    }

    fn call(&mut self, function: Function, a: &Formula) -> QuantityUnit {
        match function {
            Function::Abs => self.quantity(a),
            Function::Sqrt => match self.quantity(a) {
                Of(unit) => Of(unit.power(0.5)),
                Clock(unit) => Clock(unit.power(0.5)),
                MultipleOfAngle => Plain,
                other => other,
            },
            _ => {
                let argument = self.quantity(a);
                if matches!(function, Function::Sin | Function::Cos | Function::Tan) {
                    self.report_turns(a, argument);
                }
                if let Any = argument {
                    let is_of_angles = matches!(function, Function::Sin | Function::Cos | Function::Tan);
                    self.take(a, Unit::NUMBER, f64::from(u8::from(is_of_angles)));
                }
                if let Of(unit) = argument
                    && !unit.agrees(Unit::NUMBER)
                {
                    let name = function.name();
                    let hint = conversion(unit, Unit::NUMBER);
                    let message =
                        format!("the units do not agree: this is {unit}, and `{name}` takes a number or rad{hint}");
                    self.errors.push(ModelError::new(first_origin(a).unwrap_or(self.at), message));
                }
                // A function of a literal number takes any unit, as a literal number does.
                if a.literal().is_some() { Plain } else { Of(Unit::NUMBER) }
            }
        }
    }
}

/// The origin of the first name in a formula.
pub(super) fn first_origin(formula: &Formula) -> Option<Origin> {
    match formula {
        Formula::Number(_) | Formula::Pi | Formula::Time | Formula::Index(_) | Formula::Curve(_) => None,
        Formula::Parameter(member) | Formula::Input(member) | Formula::Scalar(member) | Formula::Define(member) => {
            Some(member.origin)
        }
        Formula::Pose(body, _) => Some(body.origin()),
        Formula::PointCoordinate(place, _) => Some(place.origin),
        Formula::Distance(p, _) => Some(p.origin),
        Formula::Neg(a) | Formula::Pow(a, _) | Formula::Call(_, a) => first_origin(a),
        Formula::Add(a, b) | Formula::Sub(a, b) | Formula::Mul(a, b) | Formula::Div(a, b, _) | Formula::Atan2(a, b) => {
            first_origin(a).or_else(|| first_origin(b))
        }
        Formula::Supplied(member, _) => Some(member.origin),
        Formula::Dot(_, origin) => Some(*origin),
    }
}

//! The units of formulas, from those of what stands in them.

use super::unit::{Unit, near};
use crate::error::{ModelError, Origin};
use crate::mechanism::{Component, CurveVariable, Formula, Function, Mechanism, Place};
use Quantity::{Any, Of, Plain};

/// What is known of a quantity.
#[derive(Clone, Copy, Debug)]
pub(super) enum Quantity {
    /// Anything.
    Any,
    /// A plain number, of whatever unit is wanted.
    Plain,
    /// Of this unit.
    Of(Unit),
}

/// The state of checking units.
pub(super) struct Checker<'m> {
    pub(super) mechanism: &'m Mechanism,
    /// Of the parameters, where they have one.
    pub(super) units: Vec<Option<Unit>>,
    /// Of positions.
    pub(super) length: Unit,
    /// Of t.
    pub(super) time: Unit,
    /// Of masses.
    pub(super) mass: Unit,
    /// Of the defines that have been looked at.
    pub(super) defines: Vec<Option<Quantity>>,
    /// Where the formula at hand stands.
    pub(super) at: Origin,
    pub(super) errors: Vec<ModelError>,
}

impl Checker<'_> {
    pub(super) fn place(&mut self, place: &Place) {
        for value in [&place.x, &place.y] {
            self.expect(value, self.length, place.origin);
        }
    }

    /// `formula` is in `unit`; `at` is where it stands when none of its names does.
    pub(super) fn expect(&mut self, formula: &Formula, unit: Unit, at: Origin) {
        self.at = at;
        if let Of(found) = self.quantity(formula)
            && !found.agrees(unit)
        {
            let wanted = match unit.scale {
                None => "a length".to_owned(),
                Some(_) if unit.is_number() => "an angle in rad".to_owned(),
                Some(_) => unit.to_string(),
            };
            let message = format!("the units do not agree: this is {found}, and {wanted} is wanted");
            self.errors.push(ModelError::new(first_origin(formula).unwrap_or(at), message));
        }
    }

    /// Both are in one unit, which they give; the second is to blame, if it has a name.
    pub(super) fn same(&mut self, a: &Formula, b: &Formula) -> Quantity {
        let (left, right) = (self.quantity(a), self.quantity(b));
        match (left, right) {
            (Of(one), Of(other)) if !one.agrees(other) => {
                let (this, that, origin) = match (first_origin(a), first_origin(b)) {
                    (_, Some(origin)) => (other, one, origin),
                    (Some(origin), None) => (one, other, origin),
                    (None, None) => (other, one, self.at),
                };
                let message = format!("the units do not agree: this is {this}, and what it meets is {that}");
                self.errors.push(ModelError::new(origin, message));
                // Said once.
                Any
            }
            (Of(one), Of(other)) => Of(if one.scale.is_some() { one } else { other }),
            (Of(unit), _) | (_, Of(unit)) => Of(unit),
            (Any, _) | (_, Any) => Any,
            (Plain, Plain) => Plain,
        }
    }

    pub(super) fn define(&mut self, k: usize) -> Quantity {
        if let Some(known) = self.defines.get(k).copied().flatten() {
            return known;
        }
        let Some(define) = self.mechanism.defines.get(k) else { return Any };
        let before = std::mem::replace(&mut self.at, define.origin);
        let quantity = self.quantity(&define.formula);
        self.at = before;
        self.defines[k] = Some(quantity);
        quantity
    }

    pub(super) fn quantity(&mut self, formula: &Formula) -> Quantity {
        match formula {
            Formula::Number(_) | Formula::Pi | Formula::Index(_) => Plain,
            Formula::Time => Of(self.time),
            Formula::Parameter(member) => self.units.get(member.family).copied().flatten().map_or(Any, Of),
            Formula::Input(_) | Formula::Scalar(_) => Any,
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
            Formula::Define(member) => self.define(member.family),
            Formula::Curve(CurveVariable::Theta) => Of(Unit::NUMBER),
            Formula::Curve(_) => Of(self.length),
            Formula::Neg(a) => self.quantity(a),
            Formula::Add(a, b) | Formula::Sub(a, b) => self.same(a, b),
            Formula::Mul(a, b) => {
                let (left, right) = (self.quantity(a), self.quantity(b));
                product([(left, a), (right, b)])
            }
            Formula::Div(a, b, _) => {
                let (left, right) = (self.quantity(a), self.quantity(b));
                let inverse = match right {
                    Of(unit) => Of(unit.power(-1.0)),
                    other => other,
                };
                product([(left, a), (inverse, b)])
            }
            Formula::Pow(a, n) => match self.quantity(a) {
                Of(unit) => Of(unit.power(*n)),
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
                other => other,
            },
        }
    }

    fn call(&mut self, function: Function, a: &Formula) -> Quantity {
        match function {
            Function::Abs => self.quantity(a),
            Function::Sqrt => match self.quantity(a) {
                Of(unit) => Of(unit.power(0.5)),
                other => other,
            },
            _ => {
                if let Of(unit) = self.quantity(a)
                    && !unit.agrees(Unit::NUMBER)
                {
                    let name = function.name();
                    let message = format!("the units do not agree: this is {unit}, and `{name}` takes a number or rad");
                    self.errors.push(ModelError::new(first_origin(a).unwrap_or(self.at), message));
                }
                // A number of a number is as free as that.
                if a.literal().is_some() { Plain } else { Of(Unit::NUMBER) }
            }
        }
    }
}

/// A product: a plain number keeps what it multiplies, but a conversion opens its scale; times a number it is as free as
/// before, and times time it may be a rate, so that nothing is known.
fn product(factors: [(Quantity, &Formula); 2]) -> Quantity {
    match factors.map(|(quantity, _)| quantity) {
        [Of(a), Of(b)] => Of(a.times(b)),
        [Any, _] | [_, Any] => Any,
        [Plain, Plain] => Plain,
        [Plain, Of(unit)] | [Of(unit), Plain] => {
            let plain = factors.iter().find(|(quantity, _)| matches!(quantity, Plain)).map(|(_, formula)| *formula);
            if unit.is_time() {
                Any
            } else if unit.agrees(Unit::NUMBER) {
                Plain
            } else if plain.is_some_and(converts) {
                Of(Unit { scale: None, ..unit })
            } else {
                Of(unit)
            }
        }
    }
}

/// True for a number with a factor of a conversion in it.
fn converts(formula: &Formula) -> bool {
    const FACTORS: [f64; 8] = [12.0, 25.4, 2.54, 30.0, 60.0, 180.0, 360.0, 3600.0];
    match formula {
        Formula::Number(v) => {
            let large = if *v < 1.0 { 1.0 / v } else { *v };
            let is_ten = large > 1.5 && near(large.log10(), large.log10().round());
            is_ten || FACTORS.iter().any(|factor| near(*factor, large)) || near(0.3048, *v)
        }
        Formula::Neg(a) | Formula::Pow(a, _) => converts(a),
        Formula::Mul(a, b) | Formula::Div(a, b, _) => converts(a) || converts(b),
        _ => false,
    }
}

/// The first name in a formula.
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

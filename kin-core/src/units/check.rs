//! Finds where the units of a mechanism do not agree.

use super::checker::{
    Checker,
    QuantityUnit::{MultipleOfAngle, Of, Plain},
};
use super::quantity::first_origin;
use super::unit::Unit;
use crate::check::order_of_defines;
use crate::error::ModelError;
use crate::mechanism::{
    Axis, BodyOrigin, Component, Curve, Dimension, Formula, GuessTarget, Mechanism, Operand, OperandSlot, Statement,
    Value,
};

/// An error for every place where quantities of different units are added, compared or equated. The mechanism must have
/// passed the other checks: indices are valid, and defines are not circular.
pub fn check(mechanism: &Mechanism) -> Vec<ModelError> {
    let mut checker = Checker::new(mechanism);
    checker.mechanism();
    let mut errors = checker.errors;
    errors.sort_by_key(|error| error.origin);
    errors.dedup_by_key(|error| error.origin);
    errors
}

impl Checker<'_> {
    pub(super) fn mechanism(&mut self) {
        let m = self.mechanism;
        // Defines are visited before those that use them, so that a long chain of defines causes no deep recursion.
        for k in order_of_defines(m).order {
            self.define(k);
        }
        for body in &m.bodies {
            match &body.origin_at {
                BodyOrigin::Carried(place) => self.place(place),
                BodyOrigin::Free { x, y } => {
                    for value in [x, y].into_iter().flatten() {
                        self.expect(value, self.length, body.origin);
                    }
                }
            }
            if let Some(phi) = &body.phi {
                self.expect_angle(phi, body.origin);
            }
        }
        m.points.iter().for_each(|point| self.place(&point.place));
        m.joints.iter().chain(&m.loads).for_each(|joint| self.joint(joint));
        for condition in &m.conditions {
            self.at = condition.origin;
            self.same(&condition.left, &condition.right);
        }
        for guess in &m.guesses {
            match guess.target {
                GuessTarget::Pose(_, Component::Phi) => self.expect_angle(&guess.value, guess.origin),
                GuessTarget::Pose(..) => self.expect(&guess.value, self.length, guess.origin),
                GuessTarget::Scalar(member) => {
                    self.at = guess.origin;
                    self.same(&Formula::Scalar(member), &guess.value);
                }
            }
        }
    }

    fn joint(&mut self, joint: &Statement) {
        self.at = joint.origin;
        let agreed = self.agreed(joint);
        for (slot, operand) in joint.operands.iter() {
            let wanted = match slot.dimension {
                Dimension::Length => Some(self.length),
                Dimension::LengthPerTurn => Some(self.per_turn(operand)),
                Dimension::Angle => Some(Unit::NUMBER),
                Dimension::Speed => Some(self.length.times(self.time.power(-1.0))),
                Dimension::Derived([mass, length, time]) => {
                    let powers = [(self.mass, mass), (self.length, length), (self.time, time)];
                    let unit = powers.into_iter().map(|(unit, power)| unit.power(f64::from(power)));
                    Some(unit.fold(Unit::NUMBER, Unit::times))
                }
                Dimension::Common => None,
                Dimension::CommonLength => match operand {
                    Operand::Radii(_) => agreed.filter(|unit| *unit != Unit::NUMBER).map(|_| self.length),
                    Operand::Value(offset) => agreed.or_else(|| self.beside_teeth(joint, offset)),
                    _ => agreed,
                },
            };
            match operand {
                Operand::Point(place) => self.place(place),
                Operand::Points(places) => places.iter().for_each(|place| self.place(place)),
                Operand::Body(_) | Operand::Bodies(_) => {}
                Operand::Vector(vector) => {
                    for value in [&vector.x, &vector.y] {
                        self.expect(value, wanted.unwrap_or(Unit::NUMBER), vector.origin);
                    }
                }
                Operand::Scalar(member) => {
                    if let Some(unit) = wanted {
                        self.expect(&Formula::Scalar(*member), unit, joint.origin);
                    }
                }
                Operand::Axis(axis) => self.axis(axis),
                Operand::Value(value) if slot.dimension == Dimension::Angle => {
                    self.expect_angle(&value.value, value.origin);
                }
                Operand::Value(value) => self.measured(value, wanted),
                Operand::Radii(radii) => {
                    for radius in [&radii.i, &radii.j] {
                        self.radius(radius);
                        self.measured(radius, wanted);
                    }
                }
                Operand::Curve(curve) => self.curve(curve),
            }
        }
    }

    /// The common unit of the operands that must agree; that of the first if they do not.
    fn agreed(&mut self, joint: &Statement) -> Option<Unit> {
        let common = |slot: &OperandSlot| matches!(slot.dimension, Dimension::Common | Dimension::CommonLength);
        let together = |operand: &Operand| matches!(operand, Operand::Radii(_));
        let operands: Vec<&Operand> =
            joint.operands.iter().filter(|(slot, _)| common(slot)).map(|(_, operand)| operand).collect();
        // Radii must agree with one another, and the other operands with the radii.
        let values = match operands.iter().find(|operand| together(operand)) {
            Some(Operand::Radii(radii)) => {
                self.at = radii.j.origin;
                vec![&radii.i.value, &radii.j.value]
            }
            _ => operands.iter().flat_map(|operand| operand.formulas()).collect(),
        };
        let (first, second) = (values.first()?, values.get(1)?);
        match self.same(first, second) {
            Of(unit) => Some(unit),
            _ => match self.quantity(first) {
                Of(unit) => Some(unit),
                _ => None,
            },
        }
    }

    /// The unit of an offset in degrees or turns beside radii that are plain numbers: it must be in rad.
    fn beside_teeth(&mut self, joint: &Statement, offset: &Value) -> Option<Unit> {
        let radii = joint.operands.iter().find_map(|(_, operand)| match operand {
            Operand::Radii(radii) => Some([&radii.i, &radii.j]),
            _ => None,
        })?;
        let Of(unit) = self.quantity(&offset.value) else { return None };
        let is_counted = unit.is_number() && !unit.agrees(Unit::NUMBER);
        let are_plain = radii.into_iter().all(|radius| matches!(self.quantity(&radius.value), Plain));
        (is_counted && are_plain).then_some(Unit::NUMBER)
    }

    fn measured(&mut self, value: &Value, wanted: Option<Unit>) {
        if let Some(unit) = wanted {
            self.expect(&value.value, unit, value.origin);
        }
    }

    /// The unit of a length that is covered in one turn. Written per revolution it is a length by 2π radians; written per
    /// radian it is a mistake, and per degree, too.
    fn per_turn(&mut self, operand: &Operand) -> Unit {
        let Operand::Value(value) = operand else { return self.length };
        if self.angle(&value.value) != -1.0 {
            return self.length;
        }
        let turn = Unit { scale: Some(0.5 * core::f64::consts::FRAC_1_PI), ..Unit::NUMBER };
        let Of(found) = self.quantity(&value.value) else { return self.length };
        if found.agrees(self.length.times(turn)) || !found.is_like(self.length) {
            return self.length.times(turn);
        }
        let message = "this is a length per turn: its unit is a length or a length per `rev`, as `mm` or `mm/rev`";
        self.errors.push(ModelError::new(first_origin(&value.value).unwrap_or(value.origin), message));
        found
    }

    /// Checks that a radius is a length or a number of teeth, and not an angle.
    fn radius(&mut self, radius: &Value) {
        let number = match self.quantity(&radius.value) {
            Of(unit) => unit.is_number(),
            Plain | MultipleOfAngle => true,
            _ => false,
        };
        if number && self.angle(&radius.value) != 0.0 {
            let message = "radii are lengths or numbers of teeth, and this is an angle; teeth have no unit";
            self.errors.push(ModelError::new(first_origin(&radius.value).unwrap_or(radius.origin), message));
        }
    }

    fn axis(&mut self, axis: &Axis) {
        self.at = axis.origin;
        self.same(&axis.x, &axis.y);
    }

    fn curve(&mut self, curve: &Curve) {
        match curve {
            Curve::Polar { radius, origin } => self.expect(radius, self.length, *origin),
            Curve::Implicit { value, origin } => {
                self.at = *origin;
                self.quantity(value);
            }
            Curve::Parametric { x, y, roller, origin, .. } => {
                for value in [x, y].into_iter().chain(roller) {
                    self.expect(value, self.length, *origin);
                }
            }
        }
    }
}

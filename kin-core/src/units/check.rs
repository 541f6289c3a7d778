//! Where the units of a mechanism do not agree.

use super::parse::parse;
use super::quantity::{Checker, Quantity::Of};
use super::unit::{Unit, near};
use crate::check::order_of_defines;
use crate::error::{ModelError, Origin};
use crate::mechanism::{
    Axis, BodyOrigin, Component, Curve, Dimension, GuessTarget, Joint, Mechanism, Operand, Slot, Value,
};

/// Every place where quantities of different units are added, compared or equated. The mechanism is sound: indices
/// exist and defines end somewhere.
pub fn check(mechanism: &Mechanism) -> Vec<ModelError> {
    let units: Vec<Option<Unit>> =
        mechanism.parameters.iter().map(|p| p.unit.as_deref().and_then(|unit| parse(unit).ok())).collect();
    let first = |kind: usize| (mechanism.parameters.iter()).find_map(|p| base(p.unit.as_deref()?, kind));
    let mut checker = Checker {
        mechanism,
        units,
        length: Unit { powers: [1.0, 0.0, 0.0], scale: first(0) },
        time: Unit { powers: [0.0, 1.0, 0.0], scale: Some(first(1).unwrap_or(1.0)) },
        mass: Unit { powers: [0.0, 0.0, 1.0], scale: first(2) },
        defines: vec![None; mechanism.defines.len()],
        at: Origin::default(),
        errors: Vec::new(),
    };
    checker.mechanism();
    let mut errors = checker.errors;
    errors.sort_by_key(|error| error.origin);
    errors.dedup_by_key(|error| error.origin);
    errors
}

/// The scale of the first symbol of a length (0), time (1) or mass (2) in a unit, as in `mm/s`.
fn base(unit: &str, kind: usize) -> Option<f64> {
    let symbols = unit.split(|c: char| !c.is_alphabetic());
    let mut bases = symbols.filter_map(|symbol| parse(symbol).ok()).filter(|unit| near(unit.powers[kind], 1.0));
    bases.find(|unit| unit.powers.iter().sum::<f64>() == 1.0).and_then(|unit| unit.scale)
}

impl Checker<'_> {
    fn mechanism(&mut self) {
        let m = self.mechanism;
        // What others use comes first: a long chain of defines must not become deep recursion.
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
                self.expect(phi, Unit::NUMBER, body.origin);
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
                GuessTarget::Pose(_, Component::Phi) => self.expect(&guess.value, Unit::NUMBER, guess.origin),
                GuessTarget::Pose(..) => self.expect(&guess.value, self.length, guess.origin),
                GuessTarget::Scalar(_) => {
                    self.at = guess.origin;
                    self.quantity(&guess.value);
                }
            }
        }
    }

    fn joint(&mut self, joint: &Joint) {
        self.at = joint.origin;
        let agreed = self.agreed(joint);
        for (slot, operand) in joint.operands.iter() {
            let wanted = match slot.dimension {
                Dimension::Length => Some(self.length),
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
                    _ => agreed,
                },
            };
            match operand {
                Operand::Point(place) => self.place(place),
                Operand::Points(places) => places.iter().for_each(|place| self.place(place)),
                Operand::Body(_) | Operand::Bodies(_) | Operand::Scalar(_) => {}
                Operand::Vector(vector) => {
                    for value in [&vector.x, &vector.y] {
                        self.expect(value, wanted.unwrap_or(Unit::NUMBER), vector.origin);
                    }
                }
                Operand::Axis(axis) => self.axis(axis),
                Operand::Value(value) => self.measured(value, wanted),
                Operand::Radii(radii) => [&radii.i, &radii.j].into_iter().for_each(|r| self.measured(r, wanted)),
                Operand::Curve(curve) => self.curve(curve),
            }
        }
    }

    /// The unit that the operands of one unit agree on, the first where they do not.
    fn agreed(&mut self, joint: &Joint) -> Option<Unit> {
        let common = |slot: &Slot| matches!(slot.dimension, Dimension::Common | Dimension::CommonLength);
        let together = |operand: &Operand| matches!(operand, Operand::Radii(_));
        let operands: Vec<&Operand> =
            joint.operands.iter().filter(|(slot, _)| common(slot)).map(|(_, operand)| operand).collect();
        // Radii agree with one another, and the rest with them.
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

    fn measured(&mut self, value: &Value, wanted: Option<Unit>) {
        if let Some(unit) = wanted {
            self.expect(&value.value, unit, value.origin);
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

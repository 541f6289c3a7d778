//! The units of products.

use super::checker::{
    Checker,
    QuantityUnit::{self, Any, Clock, MultipleOfAngle, Of, Plain},
};
use super::conversion::{converts, converts_angles, has_pi};
use super::unit::Unit;
use crate::mechanism::{Formula, contains_signal};

impl Checker<'_> {
    /// The product of two factors, of which `formula` consists. A plain number does not change the unit of the other
    /// factor, but a typical factor of conversions leaves its scale open. Number times number is a plain number, and number
    /// times t may have any unit, since the number may be a rate.
    pub(super) fn product(&mut self, factors: [(QuantityUnit, &Formula); 2], formula: &Formula) -> QuantityUnit {
        let [(left, a), (right, b)] = factors;
        match [left, right] {
            [Of(a), Of(b) | Clock(b)] | [Clock(a), Of(b)] => Of(a.times(b)),
            [Clock(a), Clock(b)] => Clock(a.times(b)),
            [Any, _] | [_, Any] | [Plain | MultipleOfAngle, Clock(_)] | [Clock(_), Plain | MultipleOfAngle] => Any,
            [Plain, Plain] | [MultipleOfAngle, MultipleOfAngle] => Plain,
            [Plain, MultipleOfAngle] => self.number(a, formula),
            [MultipleOfAngle, Plain] => self.number(b, formula),
            [Plain | MultipleOfAngle, Of(unit)] => self.multiple(a, (unit, b), formula),
            [Of(unit), Plain | MultipleOfAngle] => self.multiple(b, (unit, a), formula),
        }
    }

    /// The product `formula` of a number and a quantity with a unit.
    fn multiple(&mut self, number: &Formula, (unit, quantity): (Unit, &Formula), formula: &Formula) -> QuantityUnit {
        if unit == Unit::NUMBER {
            self.number(number, formula)
        } else if unit.agrees(Unit::NUMBER) {
            Plain
        } else if unit.is_time() && contains_signal(self.mechanism, quantity) {
            // 2 (t − t₀) may have any unit, as 2 t.
            Any
        } else if converts(number) || !unit.has_length() && has_pi(number) {
            Of(Unit { scale: None, ..unit })
        } else {
            Of(unit)
        }
    }

    /// The product `formula` of a plain number and a number, which may be an angle.
    fn number(&mut self, number: &Formula, formula: &Formula) -> QuantityUnit {
        if self.angle(formula) == 1.0 && !converts_angles(number) { MultipleOfAngle } else { Plain }
    }
}

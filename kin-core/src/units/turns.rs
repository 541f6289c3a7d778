//! Turns that are taken for radians: the product of a frequency in Hz and a time.
//!
//! Hz is 1/s, and so is rad/s. Where an angle is needed, f t with f in Hz is therefore a number of the right unit, but it
//! counts turns. A factor π, as in 2π f t, converts it.

use super::checker::{Checker, Named, QuantityUnit};
use super::conversion::{converts_angles, converts_turns};
use super::parse::hertz;
use super::quantity::first_origin;
use super::unit::Unit;
use crate::error::ModelError;
use crate::mechanism::{Formula, Mechanism};

impl Checker<'_> {
    /// Reports an error if a formula counts turns where an angle in radians is needed; `quantity` is what it measures.
    pub(super) fn report_turns(&mut self, formula: &Formula, quantity: QuantityUnit) {
        // In `f*t*360` or `f*t/57.3` a plain number may convert turns to another unit.
        let converts: Converts = match quantity {
            QuantityUnit::Of(unit) if unit == Unit::NUMBER => converts_turns,
            QuantityUnit::Plain => converts_angles,
            _ => return,
        };
        if self.angle(formula) != 0.0 || turns(self.mechanism, formula, (converts, DEPTH)) != 1.0 {
            return;
        }
        let message = "this is a number of turns, a frequency in Hz times a time, and an angle in rad is expected here; \
                       times 2*pi it is rad";
        self.errors.push(ModelError::new(first_origin(formula).unwrap_or(self.at), message));
    }
}

/// Defines that contain others are looked into down to this depth.
const DEPTH: usize = 4;

/// True for a number that converts turns.
type Converts = fn(&Formula) -> bool;

/// The exponent of Hz in the unit of a formula; 0 for a product with a factor that `converts` turns. `depth` is how many
/// more defines inside one another are looked into.
fn turns(mechanism: &Mechanism, formula: &Formula, (converts, depth): (Converts, usize)) -> f64 {
    let m = mechanism;
    let written = |unit: &Option<String>| unit.as_deref().map_or(0.0, hertz);
    let turns_of_name = |named: Named, k: usize| match named {
        Named::Parameter => m.parameters.get(k).map_or(0.0, |p| written(&p.unit)),
        Named::Scalar => m.scalars.get(k).map_or(0.0, |s| written(&s.unit)),
        Named::Input => m.inputs.get(k).map_or(0.0, |u| written(&u.unit)),
        Named::Define => m.defines.get(k).map_or(0.0, |define| match (&define.unit, depth.checked_sub(1)) {
            (None, Some(depth)) => turns(m, &define.formula, (converts, depth)),
            (unit, _) => written(unit),
        }),
    };
    let turns_of = |formula: &Formula| turns(m, formula, (converts, depth));
    match formula {
        Formula::Parameter(member) => turns_of_name(Named::Parameter, member.family),
        Formula::Scalar(member) => turns_of_name(Named::Scalar, member.family),
        Formula::Input(member) => turns_of_name(Named::Input, member.family),
        Formula::Define(member) => turns_of_name(Named::Define, member.family),
        Formula::Neg(a) => turns_of(a),
        Formula::Add(a, b) | Formula::Sub(a, b) => {
            Some(turns_of(a)).filter(|turns| *turns != 0.0).unwrap_or_else(|| turns_of(b))
        }
        Formula::Mul(a, b) if converts(a) || converts(b) => 0.0,
        Formula::Div(a, b, _) if converts(a) || converts(b) => 0.0,
        Formula::Mul(a, b) => turns_of(a) + turns_of(b),
        Formula::Div(a, b, _) => turns_of(a) - turns_of(b),
        Formula::Pow(a, n) => n * turns_of(a),
        _ => 0.0,
    }
}

//! The units of a mechanism: those that are written, and those that follow from them.

use super::checker::{Checker, Named, QuantityUnit::Of, WrittenUnit, base, texts};
use super::parse::symbol_of;
use super::unit::{Unit, near};
use crate::mechanism::Mechanism;

/// The units of the results of a mechanism, as text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// The unit of x and y, if a unit of length is written.
    pub length: Option<String>,
    /// The unit of t; s if units are written but none of them is a time.
    pub time: Option<String>,
    /// The known units of scalar coordinates, inputs and defines, by their names without index.
    pub named: Vec<(String, String)>,
}

/// True if the description has units.
pub fn are_written(mechanism: &Mechanism) -> bool {
    texts(mechanism).next().is_some()
}

/// The units of a mechanism that has passed all checks.
pub fn derive(mechanism: &Mechanism) -> Units {
    let mut checker = Checker::new(mechanism);
    checker.mechanism();
    let any = are_written(mechanism);
    let symbol = |kind| base(mechanism, kind).map(|base| base.symbol.to_owned());
    let mut units = Units { length: symbol(0), time: symbol(1).or(any.then(|| "s".to_owned())), named: Vec::new() };
    let named_unit = |name: &str, written: &Option<String>, derived: Option<String>| {
        written.clone().or(derived).map(|unit| (name.to_owned(), unit))
    };
    let compared_unit = |named, k| {
        let WrittenUnit { unit, angle } = checker.compared(named, k)?;
        text(&units, &checker, unit, angle)
    };
    let mut named = Vec::new();
    let scalars = mechanism.scalars.iter().zip(0..);
    named.extend(scalars.filter_map(|(s, k)| named_unit(&s.name, &s.unit, compared_unit(Named::Scalar, k))));
    let inputs = mechanism.inputs.iter().zip(0..);
    named.extend(inputs.filter_map(|(u, k)| named_unit(&u.name, &u.unit, compared_unit(Named::Input, k))));
    for (k, define) in mechanism.defines.iter().enumerate() {
        let derived = match checker.defines.get(k).copied().flatten() {
            Some((Of(unit), angle)) => text(&units, &checker, unit, angle),
            _ => None,
        };
        named.extend(named_unit(&define.name, &define.unit, derived));
    }
    units.named = named;
    units
}

/// A unit as text in the units of the mechanism; `None` for a number, and for an open scale: `1000*slider.x` may be in m
/// or in mm.
fn text(units: &Units, checker: &Checker<'_>, unit: Unit, angle: f64) -> Option<String> {
    let [length, time, mass] = unit.powers;
    let scale = checker.length.scale.unwrap_or(1.0).powf(length) * checker.time.scale.unwrap_or(1.0).powf(time);
    let is_in_base_units = mass.abs() < 1e-9 && near(unit.scale?, scale);
    if !is_in_base_units {
        return Some(symbol_of(unit).map_or_else(|| unit.to_string(), str::to_owned));
    }
    let is_angle = !unit.has_length() && near(angle, 1.0);
    let (mut above, mut below) = (Vec::new(), Vec::new());
    above.extend(is_angle.then(|| "rad".to_owned()));
    for (symbol, power) in [(&units.length, length), (&units.time, time)] {
        if power.abs() > 1e-9 {
            let powered = format!("{}{}", symbol.as_ref()?, superscript(power.abs())?);
            if power > 0.0 { above.push(powered) } else { below.push(powered) }
        }
    }
    match (above.is_empty(), below.is_empty()) {
        (true, true) => None,
        (false, true) => Some(above.join("·")),
        (true, false) => Some(format!("1/{}", below.join("/"))),
        (false, false) => Some(format!("{}/{}", above.join("·"), below.join("/"))),
    }
}

fn superscript(power: f64) -> Option<String> {
    let whole = near(power, power.round()).then_some(power.round() as usize)?;
    let digit = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10)? as usize);
    if whole == 1 { Some(String::new()) } else { whole.to_string().chars().map(digit).collect() }
}

#[cfg(test)]
mod tests {
    use super::superscript;
    use crate::units::angle_factor;

    #[test]
    fn angles_are_factors_of_units() {
        for (text, count) in [("rad", 1.0), ("deg/s", 1.0), ("rpm", 1.0), ("mrad", 1.0), ("1/s", 0.0), ("m", 0.0)] {
            assert_eq!(angle_factor(text).exponent, count, "{text}");
        }
        assert_eq!(angle_factor("N*m/rad").exponent, -1.0);
        assert_eq!([1.0, 2.0, 12.0].map(|p| superscript(p).unwrap_or_default()), ["", "²", "¹²"]);
    }
}

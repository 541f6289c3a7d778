//! Numbers as people write them: `0.25`, `pi/2`, `2*(1 + 0.5)`, `60deg`, `200mm`, `1turn`, `3m/s`.
//!
//! A number with a unit is converted to the unit of its quantity; a number without one is in that unit already. kin
//! reads these itself because crates for expressions do not support units.

use crate::measure::Dimension;
use crate::model::Model;
use crate::present::units::ResultUnits;
use kin_core::units::{AngleFactor, Unit, UnknownUnit, angle_factor, parse};

/// The quantity that a number is a value of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Measured<'a> {
    /// Its name; empty if the option names it.
    pub(super) name: &'a str,
    /// Its unit, if one is known.
    pub(super) unit: Option<&'a str>,
    /// The order of its derivative by time, and the unit of time.
    pub(super) rate: (u8, Option<&'a str>),
}

impl<'a> Measured<'a> {
    /// The value of a parameter.
    pub(super) fn parameter(model: &Model, name: &'a str) -> Self {
        let unit = model.parameters.iter().find(|parameter| parameter.name == name).and_then(|p| p.unit);
        Self { name, unit, ..Self::default() }
    }

    /// The value of a coordinate or an input.
    pub(super) fn quantity(model: &Model, name: &'a str) -> Self {
        let unit = match ResultUnits::of(model).dimension(name) {
            Dimension::Length => model.units.length,
            Dimension::Angle => Some("rad"),
            Dimension::In(unit) => Some(unit),
            Dimension::Unknown => None,
        };
        Self { name, unit, rate: (0, ResultUnits::of(model).time()) }
    }
}

/// A number and the unit that is written after it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Amount {
    pub(super) value: f64,
    pub(super) unit: Option<Unit>,
    /// The angle in the unit.
    pub(super) angle: AngleFactor,
}

/// Largest depth of brackets inside one another.
const DEPTH: usize = 32;

/// Reads an expression.
///
/// # Errors
/// The mistake, if the text looks like an expression; `None` if it does not.
pub(super) fn amount(text: &str) -> Result<Amount, Option<String>> {
    let mut reader = Reader { rest: text.trim(), depth: 0 };
    let amount = reader.sum()?;
    if reader.rest.is_empty() { Ok(amount) } else { Err(None) }
}

/// The value of `amount` in the unit of its quantity.
///
/// # Errors
/// The units are of different kinds, or the quantity has none.
pub(super) fn converted(amount: Amount, measured: Measured<'_>) -> Result<f64, String> {
    let Some(unit) = amount.unit else { return Ok(amount.value) };
    let name = if measured.name.is_empty() { "it".to_owned() } else { format!("`{}`", measured.name) };
    let (Some(text), Some(own_unit)) = (measured.unit, unit_in_rate(measured)) else {
        return Err(format!("{name} has no unit here; write the number alone"));
    };
    let per = match measured.rate {
        (0, _) => String::new(),
        (1, time) => format!(" by {}", time.unwrap_or("s")),
        (_, time) => format!(" by {0} twice", time.unwrap_or("s")),
    };
    match unit.scale.zip(own_unit.scale) {
        // A number of turns per second is not one of radians, nor is a travel per turn a travel.
        Some(_) if unit.is_like(own_unit) && !own_unit.is_number() && !amount.angle.agrees(angle_factor(text)) => {
            let has = if amount.angle.exponent == 0.0 { "no angle" } else { "an angle" };
            Err(format!("{name} is in {text}{per}, and this has {has} in its unit; write it in {text}{per}"))
        }
        Some((from, to)) if unit.is_like(own_unit) => Ok(scaled(amount.value, from / to)),
        _ => Err(format!("{name} is in {text}{per}, and this is {unit}")),
    }
}

/// The unit of a quantity, or of its derivative.
fn unit_in_rate(measured: Measured<'_>) -> Option<Unit> {
    let time = parse(measured.rate.1.unwrap_or("s")).ok()?;
    Some(parse(measured.unit?).ok()?.times(time.power(-f64::from(measured.rate.0))))
}

/// The product, correctly rounded if the factor or its inverse is a whole number apart from rounding: 700 times 0.001 is
/// 0.7.
fn scaled(value: f64, factor: f64) -> f64 {
    let whole = |x: f64| (x - x.round()).abs() < 8.0 * f64::EPSILON * x;
    match factor {
        factor if whole(factor) => value * factor.round(),
        factor if whole(1.0 / factor) => value / (1.0 / factor).round(),
        factor => value * factor,
    }
}

struct Reader<'t> {
    rest: &'t str,
    depth: usize,
}

impl Reader<'_> {
    fn sum(&mut self) -> Result<Amount, Option<String>> {
        let mut left = self.product()?;
        loop {
            let sign = if self.take('+') {
                1.0
            } else if self.take('-') {
                -1.0
            } else {
                return Ok(left);
            };
            let right = self.product()?;
            left = add(left, Amount { value: sign * right.value, ..right })?;
        }
    }

    fn product(&mut self) -> Result<Amount, Option<String>> {
        let mut left = self.signed()?;
        loop {
            let (inverse, bracketed, right) = if self.take('*') {
                (false, false, self.signed()?)
            } else if self.take('/') {
                let bracketed = self.rest.trim_start().starts_with('(');
                (true, bracketed, self.signed()?)
            } else {
                return Ok(left);
            };
            // `1/2 turn` is half a turn; the inverse of two turns is written `1/(2 turn)`.
            let fraction = left.unit.is_none() && !bracketed;
            let unit = right.unit.map(|unit| if inverse && !fraction { unit.power(-1.0) } else { unit });
            left = Amount {
                value: if inverse { left.value / right.value } else { left.value * right.value },
                unit: match (left.unit, unit) {
                    (Some(a), Some(b)) => Some(a.times(b)),
                    (a, b) => a.or(b),
                },
                angle: left.angle.times(right.angle, if inverse && !fraction { -1.0 } else { 1.0 }),
            };
        }
    }

    fn signed(&mut self) -> Result<Amount, Option<String>> {
        if self.take('-') {
            let amount = self.factor()?;
            return Ok(Amount { value: -amount.value, ..amount });
        }
        self.take('+');
        self.factor()
    }

    /// A number, π or brackets, and the unit after it.
    fn factor(&mut self) -> Result<Amount, Option<String>> {
        let amount = if self.take('(') {
            self.depth += 1;
            if self.depth > DEPTH {
                return Err(None);
            }
            let inner = self.sum()?;
            if !self.take(')') {
                return Err(Some("a bracket is not closed".to_owned()));
            }
            self.depth -= 1;
            inner
        } else if self.word("pi") || self.word("π") {
            Amount { value: std::f64::consts::PI, ..Amount::default() }
        } else {
            let value = self.literal().ok_or(None)?;
            // A number may be written directly before π: `2pi`.
            let times = if self.word("pi") || self.word("π") { std::f64::consts::PI } else { 1.0 };
            Amount { value: value * times, ..Amount::default() }
        };
        self.unit(amount)
    }

    fn unit(&mut self, amount: Amount) -> Result<Amount, Option<String>> {
        self.rest = self.rest.trim_start();
        let end = unit_end(self.rest);
        let (text, rest) = self.rest.split_at(end);
        if text.is_empty() {
            return Ok(amount);
        }
        let unit = parse(text).map_err(|UnknownUnit(part)| {
            Some(format!("no unit `{part}` is known; there are m, mm, in, s, min, rad, deg, turn, rpm and others"))
        })?;
        self.rest = rest;
        match amount.unit {
            None => Ok(Amount { unit: Some(unit), angle: angle_factor(text), ..amount }),
            Some(_) => Err(None),
        }
    }

    fn literal(&mut self) -> Option<f64> {
        let text = self.rest.trim_start();
        let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let mut end = digits(text);
        if text[end..].starts_with('.') {
            end += 1 + digits(&text[end + 1..]);
        }
        let exponent = text[end..].strip_prefix(['e', 'E']);
        if let Some(rest) = exponent {
            let sign = usize::from(rest.starts_with(['+', '-']));
            let count = digits(&rest[sign..]);
            if count > 0 {
                end += 1 + sign + count;
            }
        }
        let value = text[..end].parse().ok()?;
        self.rest = &text[end..];
        Some(value)
    }

    fn take(&mut self, c: char) -> bool {
        let rest = self.rest.trim_start();
        // The typographic minus sign is accepted, too.
        let found = rest.strip_prefix(c).or_else(|| rest.strip_prefix('−').filter(|_| c == '-'));
        self.rest = found.unwrap_or(self.rest);
        found.is_some()
    }

    fn word(&mut self, word: &str) -> bool {
        let found = self.rest.trim_start().strip_prefix(word).filter(|rest| !rest.starts_with(char::is_alphabetic));
        self.rest = found.unwrap_or(self.rest);
        found.is_some()
    }
}

/// Where a unit at the beginning of a text ends: `m/s` in `m/s*2`, `deg` in `deg/2`.
fn unit_end(text: &str) -> usize {
    let letter = |c: char| c.is_alphabetic() || c == '°';
    let exponent = |c: char| "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c);
    let word = |text: &str| text.find(|c| !letter(c)).unwrap_or(text.len());
    let (mut end, mut rest) = (0, text);
    loop {
        let length = word(rest);
        if length == 0 || matches!(&rest[..length], "pi" | "π") {
            return end;
        }
        let start = text.len() - rest.len();
        let mut stop = length;
        stop += rest[stop..].find(|c| !exponent(c)).unwrap_or(rest.len() - stop);
        if let Some(power) = rest[stop..].strip_prefix('^') {
            let digits = power.find(|c: char| !c.is_ascii_digit() && c != '-').unwrap_or(power.len());
            stop += 1 + digits;
        }
        end = start + stop;
        let Some(next) = text[end..].strip_prefix(['/', '*', '·', '.']) else { return end };
        rest = next;
    }
}

fn add(a: Amount, b: Amount) -> Result<Amount, Option<String>> {
    match (a.unit, b.unit) {
        (None, None) => Ok(Amount { value: a.value + b.value, ..a }),
        (Some(one), Some(_)) if !one.is_number() && !a.angle.agrees(b.angle) => {
            Err(Some("a number with an angle in its unit cannot be added to one without".to_owned()))
        }
        (Some(one), Some(other)) if one.is_like(other) => {
            let factor = other.scale.unwrap_or(1.0) / one.scale.unwrap_or(1.0);
            Ok(Amount { value: a.value + scaled(b.value, factor), ..a })
        }
        (Some(one), Some(other)) => Err(Some(format!("{one} and {other} cannot be added"))),
        (Some(unit), None) | (None, Some(unit)) => {
            Err(Some(format!("a number without a unit cannot be added to one in {unit}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn read(text: &str, unit: Option<&str>) -> Result<f64, String> {
        let amount = amount(text).map_err(|message| message.unwrap_or_else(|| "no expression".to_owned()))?;
        converted(amount, Measured { name: "r", unit, rate: (0, None) })
    }

    #[test]
    fn expressions_are_computed() {
        for (text, value) in [
            ("0.25", 0.25),
            ("-1e-3", -1e-3),
            (".5", 0.5),
            ("pi/2", PI / 2.0),
            ("-π", -PI),
            ("2*(1 + 0.5) - 3/4", 2.25),
            ("2pi", 2.0 * PI),
            ("1 - -1", 2.0),
            ("2*-3", -6.0),
        ] {
            assert_eq!(read(text, None), Ok(value), "{text}");
        }
    }

    #[test]
    fn units_are_converted_exactly() {
        for (text, unit, value) in [
            ("200mm", "m", 0.2),
            ("700 mm", "m", 0.7),
            ("0.7m", "mm", 700.0),
            ("60deg", "rad", 60.0 * (PI / 180.0)),
            ("1turn", "deg", 360.0),
            ("90°/2", "deg", 45.0),
            ("1turn/4", "rad", PI / 2.0),
            ("1/4turn", "rad", PI / 2.0),
            ("-2/3 turn", "deg", -240.0),
            ("1/2*3deg", "deg", 1.5),
            ("1/(4 s)", "1/s", 0.25),
            ("2m/4s", "m/s", 0.5),
            ("3m/s", "mm/s", 3000.0),
            ("60 rpm", "rev/s", 1.0),
            ("2*(1in + 1in)", "in", 4.0),
            ("1m + 5mm", "mm", 1005.0),
            ("9.81m/s^2", "m·s⁻²", 9.81),
            ("2e3mm", "m", 2.0),
            ("36 m²/pi", "m^2", 36.0 / PI),
            ("10mm*2mm", "mm²", 20.0),
            ("7", "mm", 7.0),
            ("10mm/(2 rev)", "mm/rev", 5.0),
            ("360deg/s", "rev/s", 1.0),
            ("5N*m", "N*mm/rad", 5000.0),
            ("2/(1s)", "rad/s", 2.0),
            ("2Hz", "1/s", 2.0),
            ("180deg", "1", PI),
        ] {
            let found = read(text, Some(unit)).unwrap_or_else(|what| panic!("{text}: {what}"));
            assert!((found - value).abs() <= 2e-16 * value.abs(), "{text}: {found}");
        }
        assert_eq!(read("700mm", Some("m")), Ok(0.7));
    }

    #[test]
    fn what_is_wrong_is_said() {
        let bad = |text, unit| read(text, unit).err().unwrap_or_default();
        assert_eq!(bad("2s", Some("m")), "`r` is in m, and this is s");
        assert_eq!(bad("2mm", None), "`r` has no unit here; write the number alone");
        assert!(bad("60dge", Some("rad")).starts_with("no unit `dge` is known; there are m, mm"));
        assert_eq!(bad("1/4s", Some("1/s")), "`r` is in 1/s, and this is s");
        assert_eq!(bad("1m + 2s", Some("m")), "m and s cannot be added");
        let none = |unit: &str| format!("`r` is in {unit}, and this has no angle in its unit; write it in {unit}");
        for (text, unit) in
            [("4mm", "mm/rev"), ("1Hz", "rpm"), ("2Hz", "rad/s"), ("2/(1s)", "rev/s"), ("2/(1s)", "rpm")]
        {
            assert_eq!(bad(text, Some(unit)), none(unit), "{text}");
        }
        let some = |unit: &str| format!("`r` is in {unit}, and this has an angle in its unit; write it in {unit}");
        for (text, unit) in [("4mm/rev", "mm"), ("60rpm", "Hz"), ("3deg/s", "1/s"), ("2turns*1mm", "mm")] {
            assert_eq!(bad(text, Some(unit)), some(unit), "{text}");
        }
        assert_eq!(
            bad("1mm + 1mm/rev", Some("mm")),
            "a number with an angle in its unit cannot be added to one without"
        );
        assert_eq!(bad("1m + 2", Some("m")), "a number without a unit cannot be added to one in m");
        assert_eq!(bad("(1 + 2", Some("m")), "a bracket is not closed");
        for none in ["", "x", "1 2", "1m m", "2**3", "pi2", "1..2", "--1"] {
            assert!(read(none, Some("m")).is_err(), "{none}");
        }
        assert!(read(&"(".repeat(100_000), None).is_err());
    }
}

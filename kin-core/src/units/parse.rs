//! Units as they are written: `m`, `rad/s`, `mm`, `m/s^2`, `m·s⁻¹`, `kg*m/s²`, `deg`, `rpm`.

use super::unit::Unit;
use core::f64::consts::PI;

/// The first part of a text that is not a known unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownUnit(pub String);

const LENGTH: Unit = Unit::base(0, 1.0);
const TIME: Unit = Unit::base(1, 1.0);

/// Symbols that take no prefix.
fn whole(symbol: &str) -> Option<Unit> {
    let scaled = |unit: Unit, scale: f64| Unit { scale: Some(scale), ..unit };
    Some(match symbol {
        "1" | "rad" => Unit::NUMBER,
        "deg" | "°" => scaled(Unit::NUMBER, PI / 180.0),
        "rev" | "turn" | "turns" => scaled(Unit::NUMBER, 2.0 * PI),
        "rpm" => Unit { powers: [0.0, -1.0, 0.0], scale: Some(2.0 * PI / 60.0) },
        "in" => scaled(LENGTH, 0.0254),
        "ft" => scaled(LENGTH, 0.3048),
        "min" => scaled(TIME, 60.0),
        "h" => scaled(TIME, 3600.0),
        _ => return None,
    })
}

/// Symbols that take a prefix.
fn prefixed(symbol: &str) -> Option<Unit> {
    let si = |powers: [f64; 3]| Unit { powers, scale: Some(1.0) };
    Some(match symbol {
        "m" => LENGTH,
        "s" => TIME,
        "g" => Unit::base(2, 1e-3),
        "rad" => Unit::NUMBER,
        "Hz" => si([0.0, -1.0, 0.0]),
        "N" => si([1.0, -2.0, 1.0]),
        "Pa" => si([-1.0, -2.0, 1.0]),
        "J" => si([2.0, -2.0, 1.0]),
        "W" => si([2.0, -3.0, 1.0]),
        _ => return None,
    })
}

const PREFIXES: [(char, f64); 10] = [
    ('G', 1e9),
    ('M', 1e6),
    ('k', 1e3),
    ('d', 1e-1),
    ('c', 1e-2),
    ('m', 1e-3),
    ('u', 1e-6),
    ('µ', 1e-6),
    ('μ', 1e-6),
    ('n', 1e-9),
];

fn symbol(text: &str) -> Option<Unit> {
    if let Some(unit) = whole(text).or_else(|| prefixed(text)) {
        return Some(unit);
    }
    let mut rest = text.chars();
    let first = rest.next()?;
    let (_, factor) = PREFIXES.iter().find(|(prefix, _)| *prefix == first)?;
    let unit = prefixed(rest.as_str())?;
    Some(Unit { scale: unit.scale.map(|scale| scale * factor), ..unit })
}

/// The symbol of a common unit.
pub(super) fn symbol_of(unit: Unit) -> Option<&'static str> {
    const COMMON: [&str; 33] = [
        "m", "mm", "cm", "km", "in", "ft", "um", "s", "ms", "min", "h", "rad/s", "rpm", "m/s", "mm/s", "rad/s^2",
        "m/s^2", "kg", "g", "deg", "rev", "N", "kN", "mN", "MN", "N·m", "kN·m", "N·mm", "N/m", "N/mm", "W", "kW", "mW",
    ];
    COMMON.into_iter().find(|symbol| unit.scale.is_some() && parse(symbol).is_ok_and(|known| known.agrees(unit)))
}

/// Reads a unit: factors joined by `*`, `·`, `.` or a space, divided by the factor after a `/`; powers as `^2`
/// or `²`.
///
/// # Errors
/// The first part that is not a known unit.
pub fn parse(text: &str) -> Result<Unit, UnknownUnit> {
    let is_joint = |c: char| matches!(c, '*' | '·' | '⋅' | '.' | ' ');
    let mut unit = Unit::NUMBER;
    for (k, quotient) in text.trim().split('/').enumerate() {
        // In `m/s·kg` only s is a divisor.
        for (n, factor) in quotient.trim().split(is_joint).enumerate() {
            let (name, power) = powered(factor)?;
            let known = symbol(name).ok_or_else(|| UnknownUnit(factor.to_owned()))?;
            unit = unit.times(known.power(if k > 0 && n == 0 { -power } else { power }));
        }
    }
    Ok(unit)
}

/// The angle in a unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AngleFactor {
    /// Its exponent: 1 in rad and deg/s, −1 in mm/rev, 0 in m and 1/s.
    pub exponent: f64,
    /// True for degrees and turns, and for Hz, which may mean turns per second: a unit without an angle is not in
    /// radians here.
    pub is_counted: bool,
}

impl AngleFactor {
    /// That of a product of units; `exponent` is that of the other one in it.
    pub fn times(self, other: Self, exponent: f64) -> Self {
        Self { exponent: self.exponent + exponent * other.exponent, is_counted: self.is_counted || other.is_counted }
    }

    /// True if a quantity with this angle in its unit can be converted to a unit with another one.
    pub fn agrees(self, other: Self) -> bool {
        self.exponent == other.exponent || !self.is_counted && !other.is_counted
    }
}

/// The angle in a valid unit.
pub fn angle_factor(text: &str) -> AngleFactor {
    factors(text).fold(AngleFactor::default(), |angle, (name, power)| {
        let is_counted = matches!(name, "deg" | "°" | "rev" | "turn" | "turns" | "rpm");
        let exponent = f64::from(u8::from(is_counted || name.ends_with("rad")));
        angle.times(AngleFactor { exponent, is_counted: is_counted || name.ends_with("Hz") }, power)
    })
}

/// A unit with radians in place of its degrees and turns: N*m/rad for N*m/deg.
#[cfg(feature = "compiler")]
pub(super) fn in_radians(text: &str) -> Result<Unit, UnknownUnit> {
    let size = |name| match name {
        "deg" | "°" => PI / 180.0,
        "rev" | "turn" | "turns" | "rpm" => 2.0 * PI,
        _ => 1.0,
    };
    let counted: f64 = factors(text).map(|(name, power)| f64::powf(size(name), power)).product();
    parse(text).map(|unit| Unit { scale: unit.scale.map(|scale| scale / counted), ..unit })
}

/// The exponent of Hz in a valid unit.
#[cfg(feature = "compiler")]
pub(super) fn hertz(text: &str) -> f64 {
    factors(text).filter(|(name, _)| name.ends_with("Hz")).map(|(_, power)| power).sum()
}

/// The symbols in a valid unit, with their powers.
pub(super) fn factors(text: &str) -> impl Iterator<Item = (&str, f64)> {
    text.trim().split('/').enumerate().flat_map(|(k, quotient)| {
        quotient.trim().split(['*', '·', '⋅', '.', ' ']).enumerate().map(move |(n, factor)| {
            let (name, power) = powered(factor).unwrap_or((factor, 0.0));
            (name, if k > 0 && n == 0 { -power } else { power })
        })
    })
}

/// A symbol and its power.
fn powered(factor: &str) -> Result<(&str, f64), UnknownUnit> {
    let unknown = || UnknownUnit(factor.to_owned());
    let digit = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c);
    let (name, digits) = match factor.split_once('^') {
        Some((name, digits)) => (name, digits.to_owned()),
        None => {
            let end = factor.find(|c| c == '⁻' || digit(c).is_some()).unwrap_or(factor.len());
            let plain = |c: char| if c == '⁻' { Some('-') } else { char::from_digit(digit(c)? as u32, 10) };
            let digits = factor[end..].chars().map(plain).collect::<Option<String>>().ok_or_else(unknown)?;
            (&factor[..end], digits)
        }
    };
    if digits.is_empty() && name.len() == factor.len() {
        return Ok((name, 1.0));
    }
    let power: i8 = digits.parse().map_err(|_| unknown())?;
    Ok((name, f64::from(power)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read() {
        for (text, powers, scale) in [
            ("m", [1.0, 0.0, 0.0], 1.0),
            ("mm", [1.0, 0.0, 0.0], 1e-3),
            ("µm", [1.0, 0.0, 0.0], 1e-6),
            ("rad/s", [0.0, -1.0, 0.0], 1.0),
            ("m/s^2", [1.0, -2.0, 0.0], 1.0),
            ("m/s/s", [1.0, -2.0, 0.0], 1.0),
            ("m·s⁻¹", [1.0, -1.0, 0.0], 1.0),
            ("kg*m/s²", [1.0, -2.0, 1.0], 1.0),
            ("N m", [2.0, -2.0, 1.0], 1.0),
            ("1/s", [0.0, -1.0, 0.0], 1.0),
            ("deg", [0.0; 3], PI / 180.0),
            ("rpm", [0.0, -1.0, 0.0], PI / 30.0),
            ("1/min", [0.0, -1.0, 0.0], 1.0 / 60.0),
            ("kN/mm", [0.0, -2.0, 1.0], 1e6),
        ] {
            let unit = parse(text).unwrap();
            assert!(unit.agrees(Unit { powers, scale: Some(scale) }), "{text}: {unit:?}");
        }
    }

    #[cfg(feature = "compiler")]
    #[test]
    fn degrees_and_turns_are_replaced_by_radians() {
        for (text, expected) in [("N*m/deg", "N*m"), ("mm/rev", "mm"), ("deg/s^2", "rad/s^2"), ("rpm", "1/min")] {
            assert!(in_radians(text).unwrap().agrees(parse(expected).unwrap()), "{text}");
        }
    }

    #[test]
    fn what_is_no_unit_is_named() {
        let cases = [
            ("metre", "metre"),
            ("m/sec", "sec"),
            ("m^x", "m^x"),
            ("m^", "m^"),
            ("", ""),
            ("m//s", ""),
            ("kin", "kin"),
        ];
        for (text, part) in cases {
            assert_eq!(Err(UnknownUnit(part.to_owned())), parse(text), "{text}");
        }
        assert!(parse("m^99999").is_err());
    }

    #[test]
    fn units_are_shown() {
        for text in ["m", "mm", "rad/s", "rpm", "m/s", "m^2", "m^2/s", "1/s^3"] {
            assert_eq!(text, parse(text).unwrap().to_string());
        }
        for (text, shown) in
            [("N*m/deg", "N·m/deg"), ("mm/rev", "mm/rev"), ("deg^2", "0.000305 rad"), ("mrad", "0.00100 rad")]
        {
            assert_eq!(shown, parse(text).unwrap().to_string());
        }
    }
}

//! Factors that convert one unit into another: those that formulas may contain, and the hint that names one.

use super::unit::{Unit, near};
use crate::mechanism::Formula;
use core::f64::consts::PI;

/// Numbers that are typical of conversions, besides powers of ten.
const FACTORS: [f64; 8] = [12.0, 25.4, 2.54, 30.0, 60.0, 180.0, 360.0, 3600.0];

/// Numbers that differ from a factor with π by less than this share are taken for it.
const MAX_DEVIATION: f64 = 0.01;

/// Factors from which hints are composed, besides powers of ten; [`converts`] accepts every product that contains one.
const PARTS: [(f64, &str); 8] = [
    (1.0, ""),
    (60.0, "60"),
    (3600.0, "3600"),
    (12.0, "12"),
    (25.4, "25.4"),
    (360.0, "360"),
    (144.0, "12*12"),
    (12.0 * 25.4, "12*25.4"),
];

/// True for a number that contains a typical factor of conversions.
pub(super) fn converts(formula: &Formula) -> bool {
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

/// True for a number with a factor π, which converts revolutions into radians.
pub(super) fn has_pi(formula: &Formula) -> bool {
    match formula {
        Formula::Pi => true,
        Formula::Neg(a) | Formula::Pow(a, _) => has_pi(a),
        Formula::Mul(a, b) | Formula::Div(a, b, _) => has_pi(a) || has_pi(b),
        _ => false,
    }
}

/// True for a number that may convert an angle into degrees or turns, or back.
pub(super) fn converts_angles(formula: &Formula) -> bool {
    let is_near = |v: f64| {
        let known = [180.0 / PI, PI, 2.0 * PI].into_iter().flat_map(|known| [known, 1.0 / known]);
        known.into_iter().any(|known| (v.abs() / known - 1.0).abs() < MAX_DEVIATION)
    };
    let is_number = formula.literal().is_some_and(is_near);
    is_number
        || converts(formula)
        || has_pi(formula)
        || match formula {
            Formula::Neg(a) => converts_angles(a),
            Formula::Mul(a, b) | Formula::Div(a, b, _) => converts_angles(a) || converts_angles(b),
            _ => false,
        }
}

/// True for a number with a factor π, and for one that is about π or 2π: it converts turns into radians.
pub(super) fn converts_turns(formula: &Formula) -> bool {
    let is_near = |v: f64| [PI, 2.0 * PI].into_iter().any(|known| (v.abs() / known - 1.0).abs() < MAX_DEVIATION);
    has_pi(formula) || formula.literal().is_some_and(is_near)
}

/// A hint how to convert one unit to the other; empty if no typical factor does it. A formula that follows the hint has
/// units that agree.
pub(super) fn conversion(from: Unit, to: Unit) -> String {
    let (Some(a), Some(b)) = (from.scale, to.scale) else { return String::new() };
    if !from.is_like(to) {
        return String::new();
    }
    let of_angles = with_pi(a / b, from.has_length()).map(str::to_owned);
    let Some(how) = of_angles.or_else(|| without_pi(a / b)) else { return String::new() };
    format!("; {how} it is {}", if to == Unit::NUMBER { "rad".to_owned() } else { to.to_string() })
}

/// The words for a factor of angles. 2π alone is a typical factor only where no length is converted: 2π r is a
/// circumference.
fn with_pi(factor: f64, has_length: bool) -> Option<&'static str> {
    let factors = [
        (PI / 180.0, "times pi/180"),
        (180.0 / PI, "times 180/pi"),
        (PI / 30.0, "times 2*pi/60"),
        (30.0 / PI, "times 60/(2*pi)"),
        (2.0 * PI, if has_length { "times 360*pi/180" } else { "times 2*pi" }),
        (0.5 / PI, if has_length { "times 180/(360*pi)" } else { "divided by (2*pi)" }),
    ];
    factors.into_iter().find(|(known, _)| near(factor, *known)).map(|(_, how)| how)
}

/// The words for a factor a/b·10ⁿ, the simplest if there are several.
fn without_pi(factor: f64) -> Option<String> {
    let pairs = PARTS.iter().flat_map(|above| PARTS.iter().map(move |below| (above, below)));
    let fits = |((a, above), (b, below)): (&(f64, &str), &(f64, &str))| {
        let power = (factor * b / a).log10().round();
        let is_factor = power.abs() <= 9.0 && near(factor, a / b * 10_f64.powf(power));
        let ten = |power: f64| if power > 0.0 { format!("{}", 10_f64.powf(power).round()) } else { String::new() };
        let product =
            |parts: [&str; 2]| parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("*");
        is_factor.then(|| [product([above, &ten(power)]), product([below, &ten(-power)])])
    };
    // 360, the degrees of a turn, is no part of lengths and times: km/h is 1000/3600 m/s rather than 100/360.
    let turns = |[above, below]: &[String; 2]| {
        [above, below].into_iter().filter(|part| part.split('*').any(|factor| factor == "360")).count()
    };
    let length = |parts: &[String; 2]| {
        let [above, below] = parts;
        above.len() + below.len() + usize::from(!above.is_empty()) + 4 * turns(parts)
    };
    let [above, below] = pairs.filter_map(fits).min_by_key(length)?;
    let bracketed = if below.contains('*') { format!("({below})") } else { below };
    match (above.is_empty(), bracketed.is_empty()) {
        (true, true) => None,
        (true, false) => Some(format!("divided by {bracketed}")),
        (false, true) => Some(format!("times {above}")),
        (false, false) => Some(format!("times {above}/{bracketed}")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse::parse;
    use super::*;

    #[test]
    fn a_hint_names_the_factor() {
        for (from, to, how) in [
            ("mm", "m", "divided by 1000 it is m"),
            ("m", "mm", "times 1000 it is mm"),
            ("mm/min", "m/s", "divided by (60*1000) it is m/s"),
            ("cm/min", "m/s", "divided by (60*100) it is m/s"),
            ("km/h", "m/s", "times 1000/3600 it is m/s"),
            ("in", "mm", "times 25.4 it is mm"),
            ("mm", "in", "divided by 25.4 it is in"),
            ("in", "m", "times 25.4/1000 it is m"),
            ("ft", "in", "times 12 it is in"),
            ("ft", "m", "times 12*25.4/1000 it is m"),
            ("ft^2", "in^2", "times 12*12 it is "),
            ("deg", "rad", "times pi/180 it is rad"),
            ("rad", "deg", "times 180/pi it is deg"),
            ("rpm", "rad/s", "times 2*pi/60 it is rad/s"),
            ("rad/s", "rpm", "times 60/(2*pi) it is rpm"),
            ("rpm", "deg/s", "times 60/10 it is "),
            ("rev", "rad", "times 2*pi it is rad"),
            ("rad", "rev", "divided by (2*pi) it is rev"),
            ("mm/rad", "mm/rev", "times 360*pi/180 it is "),
        ] {
            let [from_unit, to_unit] = [from, to].map(|text| parse(text).unwrap());
            let hint = conversion(from_unit, to_unit);
            assert!(hint.starts_with(&format!("; {how}")), "{from} to {to}: {hint}");
        }
        for (from, to) in [("mm", "s"), ("mm", "mm")] {
            assert_eq!("", conversion(parse(from).unwrap(), parse(to).unwrap()), "{from} to {to}");
        }
    }

    /// Every hint contains a factor that leaves the scale of a product open.
    #[test]
    fn every_part_of_a_hint_is_a_typical_factor() {
        for (value, text) in PARTS.iter().filter(|(_, text)| !text.is_empty()) {
            let factors: Vec<f64> = text.split('*').map(|factor| factor.parse().unwrap()).collect();
            assert!(near(*value, factors.iter().product()), "{text}");
            assert!(factors.iter().all(|factor| converts(&Formula::Number(*factor))), "{text}");
        }
    }
}

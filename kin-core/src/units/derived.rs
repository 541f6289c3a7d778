//! What the units of a mechanism are: those that are written, and those that follow from them.

use super::parse::{angles, parse, symbol_of};
use super::quantity::{
    Checker,
    Quantity::{Any, Of, Plain},
};
use super::unit::{Unit, near};
use crate::error::Origin;
use crate::mechanism::{Component, CurveVariable, Formula, Function, Mechanism};

/// A unit as it is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Written {
    pub(super) unit: Unit,
    /// How often an angle is a factor of it.
    pub(super) angle: f64,
}

/// What a name without a unit meets in equations.
#[derive(Clone, Copy, Debug, Default)]
pub(super) enum Met {
    #[default]
    Nothing,
    One(Written),
    /// Units that do not agree with one another.
    Several,
}

/// What may have a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    Parameter,
    Scalar,
    Input,
    Define,
}

/// The units of what a mechanism reports, as people write them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Of x and y, where a unit of length is written.
    pub length: Option<String>,
    /// Of t; s where units are written, and none of them is a time.
    pub time: Option<String>,
    /// Of scalar coordinates, inputs and defines, by their names without index, where they are known.
    pub named: Vec<(String, String)>,
}

/// True where a unit is written.
pub fn are_written(mechanism: &Mechanism) -> bool {
    texts(mechanism).next().is_some()
}

/// The units of a mechanism without mistakes.
pub fn derive(mechanism: &Mechanism) -> Units {
    let mut checker = Checker::new(mechanism);
    checker.mechanism();
    let any = are_written(mechanism);
    let symbol = |kind| texts(mechanism).find_map(|(_, text)| base(text, kind)).map(|(_, symbol)| symbol.to_owned());
    let mut units = Units { length: symbol(0), time: symbol(1).or(any.then(|| "s".to_owned())), named: Vec::new() };
    let of = |name: &str, own: &Option<String>, derived: Option<String>| {
        own.clone().or(derived).map(|unit| (name.to_owned(), unit))
    };
    let met = |met: Option<&Met>| match met {
        Some(Met::One(Written { unit, angle })) => text(&units, &checker, *unit, *angle),
        _ => None,
    };
    let mut named = Vec::new();
    named.extend(
        mechanism.scalars.iter().zip(0..).filter_map(|(s, k)| of(&s.name, &s.unit, met(checker.met[0].get(k)))),
    );
    named
        .extend(mechanism.inputs.iter().zip(0..).filter_map(|(u, k)| of(&u.name, &u.unit, met(checker.met[1].get(k)))));
    for (k, define) in mechanism.defines.iter().enumerate() {
        let derived = match checker.defines.get(k).copied().flatten() {
            Some((Of(unit), angle)) => text(&units, &checker, unit, angle),
            Some((Plain, 1.0)) => Some("rad".to_owned()),
            _ => None,
        };
        named.extend(of(&define.name, &define.unit, derived));
    }
    units.named = named;
    units
}

/// A unit in the units of the mechanism; none for a number.
fn text(units: &Units, checker: &Checker<'_>, unit: Unit, angle: f64) -> Option<String> {
    let [length, time, mass] = unit.powers;
    let scale = checker.length.scale.unwrap_or(1.0).powf(length) * checker.time.scale.unwrap_or(1.0).powf(time);
    let own = mass.abs() < 1e-9 && unit.scale.is_none_or(|found| near(found, scale));
    if !own {
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

/// Everything that is written, with what has it.
fn texts(mechanism: &Mechanism) -> impl Iterator<Item = (&str, &str)> {
    let m = mechanism;
    let parameters = m.parameters.iter().map(|p| (&p.name, &p.unit));
    let others = m.scalars.iter().map(|s| (&s.name, &s.unit)).chain(m.inputs.iter().map(|u| (&u.name, &u.unit)));
    let all = parameters.chain(others).chain(m.defines.iter().map(|d| (&d.name, &d.unit)));
    all.filter_map(|(name, unit)| Some((name.as_str(), unit.as_deref()?)))
}

/// The scale of the first symbol of a length (0) or time (1) in a unit, as in `mm/s`, and the symbol.
fn base(unit: &str, kind: usize) -> Option<(f64, &str)> {
    let symbols = unit.split(|c: char| !c.is_alphabetic());
    let mut bases = symbols
        .filter_map(|symbol| parse(symbol).ok().map(|unit| (unit, symbol)))
        .filter(|(unit, _)| near(unit.powers[kind], 1.0));
    let (unit, symbol) = bases.find(|(unit, _)| unit.powers.iter().sum::<f64>() == 1.0)?;
    unit.scale.map(|scale| (scale, symbol))
}

impl<'m> Checker<'m> {
    pub(super) fn new(mechanism: &'m Mechanism) -> Self {
        let m = mechanism;
        let written = |unit: &Option<String>| {
            let text = unit.as_deref()?;
            Some(Written { unit: parse(text).ok()?, angle: angles(text) })
        };
        let first = |kind: usize| texts(m).find_map(|(name, text)| base(text, kind).map(|(scale, s)| (name, scale, s)));
        Self {
            mechanism,
            written: [
                m.parameters.iter().map(|p| written(&p.unit)).collect(),
                m.scalars.iter().map(|s| written(&s.unit)).collect(),
                m.inputs.iter().map(|u| written(&u.unit)).collect(),
                m.defines.iter().map(|d| written(&d.unit)).collect(),
            ],
            met: [vec![Met::Nothing; m.scalars.len()], vec![Met::Nothing; m.inputs.len()]],
            length: Unit { powers: [1.0, 0.0, 0.0], scale: first(0).map(|(_, scale, _)| scale) },
            first_length: first(0).map(|(name, _, _)| name.to_owned()),
            time: Unit { powers: [0.0, 1.0, 0.0], scale: Some(first(1).map_or(1.0, |(_, scale, _)| scale)) },
            defines: vec![None; m.defines.len()],
            at: Origin::default(),
            errors: Vec::new(),
        }
    }

    /// What is written of a name.
    pub(super) fn written(&self, named: Named, k: usize) -> Option<Written> {
        self.written[named as usize].get(k).copied().flatten()
    }

    /// The quantity of a name that has a unit, or none.
    pub(super) fn of(&self, named: Named, k: usize) -> super::quantity::Quantity {
        self.written(named, k).map_or(Any, |written| Of(written.unit))
    }

    /// A name without a unit that stands alone is of the unit that it meets.
    pub(super) fn meets(&mut self, formula: &Formula, unit: Unit, angle: f64) {
        let (named, member) = match formula {
            Formula::Neg(a) => return self.meets(a, unit, angle),
            Formula::Scalar(member) => (Named::Scalar, member),
            Formula::Input(member) => (Named::Input, member),
            _ => return,
        };
        if let Some(met) = self.met[named as usize - 1].get_mut(member.family) {
            *met = match *met {
                Met::Nothing => Met::One(Written { unit, angle }),
                Met::One(other) if other.unit.agrees(unit) => {
                    Met::One(Written { angle: other.angle.max(angle), ..other })
                }
                _ => Met::Several,
            };
        }
    }

    /// How often an angle is a factor of a formula.
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_factors_of_units() {
        for (text, count) in [("rad", 1.0), ("deg/s", 1.0), ("rpm", 1.0), ("mrad", 1.0), ("1/s", 0.0), ("m", 0.0)] {
            assert_eq!(angles(text), count, "{text}");
        }
        assert_eq!(angles("N*m/rad"), -1.0);
        assert_eq!([1.0, 2.0, 12.0].map(|p| superscript(p).unwrap_or_default()), ["", "²", "¹²"]);
    }
}
